"""The tables of a case file: hole, string, mud, rig, bit, contact, solver, record.

Every float is SI once validated. Meaning and limits of each key are defined in this module.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, PrivateAttr, StrictBool, ValidationInfo, field_validator, model_validator

from fctd.case import units
from fctd.case.drilling import DriveSpec
from fctd.case.errors import MISSING, InputError, Table, exclusive, known_keys
from fctd.case.input_warnings import InputWarning
from fctd.case.surveys import doubts
from fctd.case.surveys.columns import Column, ColumnSpec, wanted
from fctd.case.surveys.headers import accepted_units, unit_of
from fctd.case.surveys.reading import read_survey
from fctd.case.surveys.smoothing import smooth
from fctd.case.surveys.stations import UNITS, StationKey, Survey, Written, check
from fctd.case.text import is_utf8
from fctd.case.wall import CakeSpec, IntervalSpec, TortuositySpec


def _as_path(raw: object) -> object:
    """A file name as a path; pydantic would refuse a string that is not UTF-8, which a file name may be."""
    return Path(raw) if isinstance(raw, str) and not is_utf8(raw) else raw


FileName = Annotated[Path, BeforeValidator(_as_path)]
# Viscosity of mud whose case gives none [Pa s]; it acts on motion that changes alone: steady loads do not depend on it.
UNSTEADY = 0.02
# A component is short, as stabilisers, reamers and bits are, up to so many times the diameter with which it touches.
SHORT = 12.0


@dataclass
class _Trajectory:
    """Stations and warnings, cached, and the keys they come from; all are equal, so that holes compare by keys."""

    source: tuple[object, ...] = field(default=(), compare=False)
    stations: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)), compare=False)
    warnings: tuple[InputWarning, ...] = field(default=(), compare=False)


class WellboreSpec(Table):
    """Path, diameter and wall stiffness of the hole.

    One of `survey` and `stations` is set; so is one of `cylinder_length` [m] and `chord_tolerance` [m],
    and one of `stiffness` [N/m per contact point] and `stiffness_per_length` [N/m/m].

    `columns` and `sheet` say what a survey file does not. With `survey_smoothing` the direction of each station may
    turn by that angle, so that rounded stations make no false dog-legs.

    With `geometry` "arcs" the hole follows the circular arcs between the stations. With "cylinders" it is cut into
    straight pieces of `cylinder_length`, or so short that their chords deviate from the arc by at most
    `chord_tolerance`; neighbouring cylinders overlap by `overlap` [m]. Where the diameter of the hole changes, arcs
    use `overlap` as the length of the shoe.
    """

    survey: FileName | None = Field(
        default=None, description="the name of a file, relative to the case file: text in columns, xlsx or WITSML"
    )
    stations: tuple[tuple[units.MeasuredDepth, units.Bare, units.Bare], ...] | None = Field(
        default=None, description="a list of [measured depth in m, or '40 ft', inclination in deg, azimuth in deg]"
    )
    columns: dict[StationKey, Column] | None = Field(
        default=None,
        description='headers of the survey, or their units: {md = {header = "DEPTH", unit = "m"}, inc = "I_deg"}',
    )
    sheet: str | None = Field(
        default=None, description="the sheet of a workbook, or the trajectory of a WITSML file, that has several"
    )
    survey_smoothing: units.Smoothing | None = None
    tortuosity: TortuositySpec | None = None
    survey_method: Literal["average_angle", "minimum_curvature"] = "minimum_curvature"
    geometry: Literal["cylinders", "arcs"] = "cylinders"
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
    _trajectory: _Trajectory = PrivateAttr(default_factory=_Trajectory)

    @field_validator("columns", mode="before")
    @classmethod
    def _check_columns(cls, raw: Any) -> Any:
        return known_keys(raw, get_args(StationKey)) if isinstance(raw, Mapping) else raw

    @field_validator("columns")
    @classmethod
    def _check_units(cls, columns: dict[StationKey, ColumnSpec] | None) -> dict[StationKey, ColumnSpec] | None:
        for key, column in (columns or {}).items():
            if column.unit is not None and unit_of(column.unit) not in UNITS[key]:
                raise InputError(accepted_units(key), key=f"{key}.unit", value=column.unit)
        return columns

    @field_validator("survey")
    @classmethod
    def _find_survey(cls, survey: Path | None, info: ValidationInfo) -> Path | None:
        """The survey, relative to the folder of the case file while one is loaded."""
        if survey is None or info.context is None:
            return survey
        path: Path = info.context["folder"] / survey
        if not os.path.exists(path):  # Path.exists raises on names too long for the file system
            raise InputError(f"a survey file that exists, looked for {path}")
        return path

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
        if self.geometry == "arcs" and self.survey_method != "minimum_curvature":
            raise InputError("cylinders, since arcs need survey_method minimum_curvature", key="geometry")
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
                raise InputError(f"a depth below the interval above, {above.to_md:g} m", key=f"intervals[{i}].to_md")
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

    def share_trajectory(self, other: WellboreSpec) -> None:
        """Take the stations that another hole has read, if it has; they count where the keys of both are the same."""
        self._trajectory = other._trajectory

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

    def _resolve(self) -> Survey:
        if self.survey is not None:
            columns = {key: wanted(column) for key, column in (self.columns or {}).items()}
            return read_survey(self.survey, columns, self.sheet)
        values = np.array(self.stations or (), dtype=float).reshape(-1, 3)
        place = Written(
            values,
            ("m", "deg", "deg"),
            lambda row, column: (f"[{row}][{column}]", MISSING),
            range(len(values)),
            "wellbore.stations[{}]",
            "wellbore.stations[{}] to [{}]",
        )
        try:
            return check(place)
        except InputError as error:
            raise error.at("stations") from None


class ComponentSpec(Table):
    """Pipe or a tool of one kind. `segments` or `segment_length` [m] sets the length of its segments; without either
    they are short in bends and near the bit, and longer elsewhere.

    `outer_diameter` and `inner_diameter` are those of the pipe body; `contact_diameter` is that of tool joints or
    stabilisers, which touch the wall first. `linear_mass` (with tool joints) and the stiffnesses EA
    (`axial_stiffness`), EI (`bending_stiffness`), GJ (`torsional_stiffness`) and κGA (`shear_stiffness`) are computed
    from the pipe body where they are not given. The default `yield_strength` is that of S-135.

    A "sleeve" touches with its `contact_diameter` along its length, both ends included; beside a narrower neighbour
    the joint has the larger diameter. A "point" touches at its middle, the bit at its end; elsewhere it is no wider
    than the sleeves beside it. Without `contact` a component is a point up to a length of 12 contact diameters. Its
    segments, and those of its neighbours, do not matter.

    A bent housing has its `bend` [rad] at the upper end, where the component is tilted against the one above
    it towards `toolface` [rad], which counts from the high side clockwise looking downhole.

    `eccentricity` [m] is the distance of the centre of mass from the axis; it acts in time alone.
    """

    name: str = Field(description="a name in quotes")
    length: units.PositiveLength | None = None
    outer_diameter: units.Diameter
    inner_diameter: units.Bore
    contact_diameter: units.Diameter = Field(default_factory=lambda given: given["outer_diameter"])
    contact: Literal["point", "sleeve"] = Field(
        default_factory=lambda given: (
            "point" if given["length"] and given["length"] <= SHORT * given["contact_diameter"] else "sleeve"
        )
    )
    segments: units.Count | None = None
    segment_length: units.PositiveLength | None = None
    linear_mass: units.PositiveLinearMass | None = None
    youngs_modulus: units.PositiveStress = 206.8e9
    poisson_ratio: units.PoissonRatio = 0.3
    density: units.PositiveDensity = 7850.0
    yield_strength: units.PositiveStress = 931e6  # of S-135, the strongest grade of API 5DP
    axial_stiffness: units.PositiveAxialStiffness | None = None  # EA
    bending_stiffness: units.PositiveBendingStiffness | None = None  # EI
    torsional_stiffness: units.PositiveBendingStiffness | None = None  # GJ
    shear_stiffness: units.PositiveAxialStiffness | None = None  # κGA
    bend: units.Bend = 0.0
    toolface: units.Angle = 0.0
    eccentricity: units.Length = 0.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "segments", "segment_length")
        if self.inner_diameter >= self.outer_diameter:
            raise InputError("a diameter below outer_diameter", key="inner_diameter")
        if self.eccentricity >= 0.5 * self.outer_diameter:
            raise InputError("less than half of outer_diameter", key="eccentricity")
        if self.contact_diameter < self.outer_diameter:
            raise InputError(f"at least outer_diameter, {self.outer_diameter:g} m", key="contact_diameter")
        if self.contact == "point" and self.length is None:
            raise InputError("sleeve, for a component without a length", key="contact", value=self.contact)
        return self

    @property
    def cut_by_default(self) -> bool:
        """Whether neither `segments` nor `segment_length` is given."""
        return self.segments is None and self.segment_length is None

    @property
    def long_segment(self) -> bool:
        """Whether the component is one segment up to the top of the string, the paper's long segment."""
        return self.length is None and self.segments == 1


class StringSpec(Table):
    """The string, from the bit upwards. Without a length the last component reaches `top_md` [m]."""

    top_md: units.Length = 0.0
    components: tuple[ComponentSpec, ...] = Field(description="tables [[string.components]]")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.components:
            raise InputError("at least one", key="components")
        for i, component in enumerate(self.components[:-1]):
            if component.length is None:
                expected = "a length, which only the last may omit, as components run from the bit up"
                raise InputError(expected, key=f"components[{i}].length")
        return self


class MudSpec(Table):
    """Density [kg/m^3], viscosity [Pa*s]; damping per metre of string: axial and lateral [N*s/m^2], rotational [N*s].

    A string that moves in time takes mud along, and the mud damps its waves along itself and its motion sideways, by
    default with a viscosity of 20 mPa*s. A `viscosity` that is given damps the string along and around itself too, in
    steady states as well; 0 turns all of it off. A damping that is given replaces the one that follows from the
    viscosity.
    """

    density: units.Density = 0.0
    viscosity: units.Viscosity | None = None
    axial_damping: units.DampingPerLength | None = None
    lateral_damping: units.DampingPerLength | None = None
    rotational_damping: units.RotationalDamping | None = None
    cake: CakeSpec | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.viscosity and not self.density:
            raise InputError("0, or a mud.density above 0 beside it", key="viscosity")
        return self

    @property
    def unsteady(self) -> float:
        """The viscosity of motion that changes in time [Pa s], 0 where the string takes no mud along."""
        return (self.viscosity if self.viscosity is not None else UNSTEADY) if self.density else 0.0


class RigSpec(Table):
    """What the rig's sensors read in addition to the loads of the string, and how the rig trips.

    Block weight [N], friction in the guides of the block [N], torque offset [N*m], and `torque_per_rpm`, a torque that
    grows with the rotation [N*m for each rev/min].  Friction in the guides acts against the block's motion: it adds to
    the weight indicator while the block is hoisted.  Friction in the sheaves divides the weight indicator by
    `sheave_efficiency` while the block is lowered, and multiplies it by `sheave_efficiency` while the block is hoisted.

    A simulation with `feed` "stands" moves the block: stands of `stand_length` [m], within `derrick_height` [m],
    are added and racked back, and the string hangs in the slips for `connection_time` [s] each time. With
    "long_segment" the upper end stands still and the top segment grows, as in the paper. "auto" is "long_segment" where
    a long segment fits: the hole is vertical along it, and it is of one component; elsewhere it is "stands".

    In a run in time a "stiff" `drive` turns the top as planned whatever the torque; "speed_control" and "impedance" are
    motors with inertia and a controller, whose settings are in `control`. With an `autodriller` the block follows
    `bit.weight_on_bit`, by the hook load, in place of the `speed` of a drilling operation, which gives its duration.
    """

    block_weight: units.Force = 0.0
    guide_friction: units.Force = 0.0
    sheave_efficiency: units.Efficiency = 1.0
    torque_offset: units.Torque = 0.0
    torque_per_rpm: units.Torque = 0.0
    feed: Literal["auto", "long_segment", "stands"] = "auto"
    stand_length: units.PositiveLength = 28.5
    connection_time: units.PositiveTime = 60.0
    derrick_height: units.PositiveLength = 40.0
    drive: Literal["stiff", "speed_control", "impedance"] = "stiff"
    control: DriveSpec = DriveSpec()
    autodriller: StrictBool = False

    @property
    def push(self) -> float:
        """The largest push on the string [N]: the block's weight without what its guides hold back."""
        return self.block_weight - self.guide_friction


class SolverSpec(Table):
    """The time step [s], and dampings of the joints as multiples of their stiffness [s].

    "largest" is the largest step that is certain to be stable, "auto" four fifths of it. `shape_damping` damps the
    change of the string's shape in space, which ends the chatter of segments on the wall; a bent string that turns
    steadily keeps its shape, and is not braked. `joint_damping` is that of the steel, a loss of 0.2 % at 30 Hz by
    default: it acts on what bends and stretches in the string's own frame, and brakes a bent string that turns.
    `loss_factor` is that of the string's torsion at its first torsional frequency, in addition; a large one makes the
    largest step smaller.

    Where a steady string is buckled, "detect" says whether its segments can bend that way, and "resolve" lays it out
    in segments that can. `resolve_work` is the work that a row may take for it, iterations times segments: the default
    is some twenty seconds. Kilometres of helix that slides with friction take three to ten times as much.
    """

    step: float | Literal["auto", "largest"] = Field(
        default="auto", description='"auto", "largest" or a time such as "2 ms"'
    )
    joint_damping: units.Time = 1e-5
    shape_damping: units.Time = 3e-3
    loss_factor: units.LossFactor = 0.0
    buckling: Literal["detect", "resolve"] = "detect"
    resolve_work: units.Work = 8e6

    @field_validator("step", mode="before", json_schema_input_type=float | str)
    @classmethod
    def _read_step(cls, raw: Any) -> Any:
        if raw in ("auto", "largest"):
            return raw
        try:
            return units.Quantity(dimension=units.TIME, above=0.0).parse(raw)
        except InputError as error:
            raise InputError(f'"auto", "largest" or {error.expected}', value=raw) from None


class RecordSpec(Table):
    """Time between rows of the history [s], and bit depths [m] at which a profile is recorded."""

    interval: units.PositiveTime = 1.0
    profile_at: tuple[units.Length, ...] = ()
