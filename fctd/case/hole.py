"""The table of a case file for the hole: its path, of which the survey is read once, its size and its wall.

In all tables of a case every float is SI once validated.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, Self, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PrivateAttr, ValidationInfo, field_validator, model_validator

from fctd.case import units
from fctd.case.calipers.caliper import Caliper, CaliperSpec
from fctd.case.errors import InputError, Table, exclusive, known_keys
from fctd.case.file_names import FileName, beside_case
from fctd.case.fluids import WindowSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.surveys import doubts
from fctd.case.surveys.form import SURVEY, ColumnKey, ColumnSpec, check_units
from fctd.case.surveys.reading import read_survey
from fctd.case.surveys.smoothing import smooth
from fctd.case.surveys.stations import StationKey, Survey, check_listed
from fctd.case.tables.headers import Choice
from fctd.case.wall import IntervalSpec, TortuositySpec


@dataclass
class _Trajectory:
    """Stations and warnings, cached, and the keys they come from; all are equal, so that holes compare by keys."""

    source: tuple[object, ...] = field(default=(), compare=False)
    stations: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)), compare=False)
    warnings: tuple[InputWarning, ...] = field(default=(), compare=False)


@dataclass
class _Measured:
    """The caliper, cached, and the table it comes from; all are equal, so that holes compare by keys."""

    source: CaliperSpec | None = field(default=None, compare=False)
    caliper: Caliper | None = field(default=None, compare=False)


class WellboreSpec(Table):
    """Path, diameter and wall stiffness of the hole.

    One of `survey` and `stations` is set; so is one of `cylinder_length` [m] and `chord_tolerance` [m],
    and one of `stiffness` [N/m per contact point] and `stiffness_per_length` [N/m/m].

    `columns` and `sheet` say what a survey file does not. With `survey_smoothing` the direction of each station may
    turn by that angle, so that rounded stations make no false dog-legs.

    With `geometry` "arcs" the hole follows the circular arcs between the stations. With "cylinders" it is cut into
    straight pieces of `cylinder_length`, or so short that their chords deviate from the arc by at most
    `chord_tolerance`; neighbouring cylinders overlap by `overlap` [m]. Where the diameter of the hole changes, arcs
    use `overlap` as the length of the shoe. With "sampled" the wall lies on the arcs where `caliper` measured it, in
    cells of the length `cell` [m]; elsewhere the hole is that of arcs.
    """

    survey: FileName | None = Field(
        default=None, description="the name of a file, relative to the case file: text in columns, xlsx or WITSML"
    )
    stations: tuple[tuple[units.MeasuredDepth, units.Bare, units.Bare], ...] | None = Field(
        default=None, description="a list of [measured depth in m, or '40 ft', inclination in deg, azimuth in deg]"
    )
    columns: dict[StationKey, ColumnKey] | None = Field(
        default=None,
        description='headers of the survey, or their units: {md = {header = "DEPTH", unit = "m"}, inc = "I_deg"}',
    )
    sheet: str | None = Field(
        default=None, description="the sheet of a workbook, or the trajectory of a WITSML file, that has several"
    )
    survey_smoothing: units.Smoothing | None = None
    tortuosity: TortuositySpec | None = None
    survey_method: Literal["average_angle", "minimum_curvature"] = "minimum_curvature"
    geometry: Literal["cylinders", "arcs", "sampled"] = "cylinders"
    caliper: CaliperSpec | None = None
    cell: units.CellLength = 0.1
    cylinder_length: units.PositiveLength | None = None
    chord_tolerance: units.PositiveLength | None = Field(
        default_factory=lambda given: 0.002 if given["cylinder_length"] is None else None
    )
    overlap: units.Length = 0.2
    stiffness_per_length: units.PositiveStiffnessPerLength | None = None
    stiffness: units.PositiveStiffness | None = Field(
        default_factory=lambda given: 1e7 if given["stiffness_per_length"] is None else None
    )
    intervals: tuple[IntervalSpec, ...] = Field(description="tables [[wellbore.intervals]]")
    window: tuple[WindowSpec, ...] = Field(default=(), description="tables [[wellbore.window]]")
    _trajectory: _Trajectory = PrivateAttr(default_factory=_Trajectory)
    _measured: _Measured = PrivateAttr(default_factory=_Measured)

    @field_validator("columns", mode="before")
    @classmethod
    def _check_columns(cls, raw: Any) -> Any:
        return known_keys(raw, get_args(StationKey)) if isinstance(raw, Mapping) else raw

    @field_validator("columns")
    @classmethod
    def _check_units(cls, columns: dict[StationKey, ColumnSpec] | None) -> dict[StationKey, ColumnSpec] | None:
        check_units(columns, SURVEY)
        return columns

    @field_validator("survey")
    @classmethod
    def _find_survey(cls, survey: Path | None, info: ValidationInfo) -> Path | None:
        """The survey, relative to the folder of the case file while one is loaded."""
        return beside_case(survey, info, "a survey file")

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "survey", "stations", required=True)
        exclusive(self, "cylinder_length", "chord_tolerance")
        exclusive(self, "stiffness", "stiffness_per_length")
        for key in ("columns", "sheet"):
            if getattr(self, key) is not None and self.survey is None:
                raise InputError(f"{key} only beside survey", key=key)
        if self.tortuosity is not None and self.survey_method != "minimum_curvature":
            raise InputError("minimum_curvature beside tortuosity", key="survey_method", value=self.survey_method)
        if self.geometry != "cylinders" and self.survey_method != "minimum_curvature":
            raise InputError(f"cylinders, since {self.geometry} need survey_method minimum_curvature", key="geometry")
        for key in ("caliper", "cell"):
            if self.geometry != "sampled" and getattr(self, key) != type(self).model_fields[key].default:
                raise InputError(f'"sampled" beside {key}', key="geometry", value=self.geometry)
        if self.stations is not None:
            self._resolve()
        if not self.intervals:
            raise InputError("at least one", key="intervals")
        kinds = ("stiffness", "stiffness_per_length")
        kind, other = kinds if self.stiffness is not None else reversed(kinds)
        for i, interval in enumerate(self.intervals):
            if getattr(interval, other) is not None:
                raise InputError(f"{kind}, the kind of the whole wellbore", key=f"intervals[{i}].{other}")
        for i, (above, here) in enumerate(pairwise(self.intervals), start=1):
            if here.to_md <= above.to_md:
                expected = (
                    f"a depth below the interval above, {quantity(above.to_md, 'm')} "
                    f"(wellbore.intervals[{i - 1}].to_md)"
                )
                raise InputError(expected, key=f"intervals[{i}].to_md")
        return self

    @property
    def trajectory(self) -> NDArray[np.float64]:
        """Stations (n, 3) of survey file or case: measured depth [m], inclination and unwrapped azimuth [rad].

        The survey file is read once, at the first access, so that a stored case can be read without it; copies made
        afterwards share the stations.  Raises InputError for a file that cannot be used.
        """
        return self._read_trajectory().stations

    @property
    def survey_warnings(self) -> tuple[InputWarning, ...]:
        """Probable mistakes in the stations of survey file or case; read and kept as `trajectory` is."""
        return self._read_trajectory().warnings

    @property
    def calipers(self) -> Caliper | None:
        """The radii that were measured, None without a caliper; read and kept as `trajectory` is.

        Raises InputError for a file that cannot be used.
        """
        if self.caliper is None:
            return None
        if self._measured.source != self.caliper:
            try:
                self._measured = _Measured(self.caliper, self.caliper.read())
            except InputError as error:
                raise (error.at("wellbore.caliper") if error.file is None else error) from None
        return self._measured.caliper

    def share_trajectory(self, other: WellboreSpec) -> None:
        """Take the stations and the caliper that another hole has read; they count where the keys of both are equal."""
        self._trajectory, self._measured = other._trajectory, other._measured

    def _read_trajectory(self) -> _Trajectory:
        source = (self.survey, self.columns, self.sheet, self.stations, self.survey_smoothing)
        if self._trajectory.source != source:
            survey, angle = self._resolve(), self.survey_smoothing
            warnings = doubts.find(survey, smoothed=angle is not None)
            stations = survey.stations if angle is None else smooth(survey.stations, angle)
            stations.flags.writeable = False
            self._trajectory = _Trajectory(source, stations, warnings)
        return self._trajectory

    def read_from(self, copy: Path) -> Self:
        """The same hole, with the stations of a copy of its survey file."""
        read, here = self.model_copy(update={"survey": copy})._read_trajectory(), self.model_copy()
        here._trajectory = _Trajectory((self.survey, *read.source[1:]), read.stations, read.warnings)
        return here

    def caliper_from(self, copy: Path) -> Self:
        """The same hole, with the rows of a copy of its caliper file."""
        assert self.caliper is not None  # there is a copy of its file
        here = self.model_copy()
        here._measured = _Measured(self.caliper, self.caliper.model_copy(update={"log": copy}).read())
        return here

    def _resolve(self) -> Survey:
        if self.survey is not None:
            choices = {str(key): Choice(column.header, column.unit) for key, column in (self.columns or {}).items()}
            return read_survey(self.survey, choices, self.sheet)
        return check_listed(np.array(self.stations or (), dtype=float).reshape(-1, 3))
