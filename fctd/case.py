"""A case file: TOML to a frozen, validated `Case` in which every float is SI.

The models are the tables of the file; `load_case` reads, overrides and validates.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final, Literal, Self, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, StrictBool, ValidationError, ValidationInfo, field_validator, model_validator

from fctd import units
from fctd.errors import MISSING, InputError, Table, exclusive, explain, known_keys, look_up, nearest, set_key
from fctd.survey_file import StationKey, check_stations, read_stations

_SAME_DEPTH: Final = 1e-6  # m: one depth written in two units


class IntervalSpec(Table):
    """A stretch of hole of one size, from the end of the one above to `to_md` [m]."""

    to_md: units.PositiveLength
    diameter: units.PositiveLength
    friction: units.Friction
    name: str | None = None
    stiffness: units.PositiveStiffness | None = None
    stiffness_per_length: units.PositiveStiffnessPerLength | None = None


class WellboreSpec(Table):
    """Where the hole runs, how wide it is, and how its wall answers.

    One of `survey` and `stations` is set; so is one of `cylinder_length` [m] and `chord_tolerance` [m],
    and one of `stiffness` [N/m, a contact point] and `stiffness_per_length` [N/m/m].
    """

    survey: Path | None = None
    stations: tuple[tuple[units.Bare, units.Bare, units.Bare], ...] | None = None
    columns: dict[StationKey, str] | None = None
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

    @field_validator("columns", mode="before")
    @classmethod
    def _check_columns(cls, raw: Any) -> Any:
        return known_keys(raw, get_args(StationKey)) if isinstance(raw, Mapping) else raw

    @field_validator("survey")
    @classmethod
    def _find_survey(cls, survey: Path | None, info: ValidationInfo) -> Path | None:
        """The survey, relative to the folder of the case file while one is loaded."""
        if survey is None or info.context is None:
            return survey
        path: Path = info.context["folder"] / survey
        if not os.path.isfile(path):  # Path.is_file raises on names too long for the file system
            raise InputError(f"a survey file that exists, looked for {path}")
        return path

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "survey", "stations", required=True)
        exclusive(self, "cylinder_length", "chord_tolerance")
        exclusive(self, "stiffness", "stiffness_per_length")
        if self.columns is not None and self.survey is None:
            raise InputError("columns only beside survey", key="columns")
        if self.geometry == "arcs" and self.survey_method != "minimum_curvature":
            raise InputError("cylinders, since arcs need survey_method minimum_curvature", key="geometry")
        if self.stations is not None:
            self.read_stations()
        if not self.intervals:
            raise InputError("at least one", key="intervals")
        kinds = ("stiffness", "stiffness_per_length")
        kind, other = kinds if self.stiffness is not None else reversed(kinds)
        for i, interval in enumerate(self.intervals):
            if getattr(interval, other) is not None:
                raise InputError(f"{kind}, the kind of the whole wellbore", key=f"intervals[{i}].{other}")
        for i, (above, here) in enumerate(pairwise(self.intervals), start=1):
            if here.to_md <= above.to_md:
                raise InputError("a depth below the interval above", key=f"intervals[{i}].to_md")
        return self

    def read_stations(self) -> NDArray[np.float64]:
        """Stations (n, 3) of survey file or case: measured depth [m], inclination [deg], azimuth [deg]."""
        if self.survey is not None:
            return read_stations(self.survey, self.columns)
        stations = np.array(self.stations or (), dtype=float).reshape(-1, 3)
        try:
            return check_stations(stations, lambda row, column: (f"[{row}][{column}]", MISSING))
        except InputError as error:
            raise error.at("stations") from None


class ComponentSpec(Table):
    """A run of equal pipe. One of `segments` and `segment_length` [m] sets how finely it is cut."""

    name: str = Field(description="a name in quotes")
    length: units.PositiveLength | None = None
    outer_diameter: units.PositiveLength
    inner_diameter: units.Length
    contact_diameter: units.PositiveLength = Field(default_factory=lambda given: given["outer_diameter"])
    segments: units.Count | None = None
    segment_length: units.PositiveLength | None = None
    linear_mass: units.PositiveLinearMass | None = None
    youngs_modulus: units.PositiveStress = 206.8e9
    poisson_ratio: units.PoissonRatio = 0.3
    density: units.PositiveDensity = 7850.0
    axial_stiffness: units.PositiveAxialStiffness | None = None  # EA
    bending_stiffness: units.PositiveBendingStiffness | None = None  # EI
    torsional_stiffness: units.PositiveBendingStiffness | None = None  # GJ
    shear_stiffness: units.PositiveAxialStiffness | None = None  # κGA

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "segments", "segment_length", required=True)
        if self.inner_diameter >= self.outer_diameter:
            raise InputError("a diameter below outer_diameter", key="inner_diameter")
        if self.contact_diameter < self.outer_diameter:
            raise InputError("at least outer_diameter", key="contact_diameter")
        return self


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
                raise InputError("a length, which only the last may omit", key=f"components[{i}].length")
        return self


class MudSpec(Table):
    """Density [kg/m^3] and what the mud resists per metre of string: [N*s/m^2], rotation [N*s]."""

    density: units.Density = 0.0
    axial_damping: units.DampingPerLength = 0.0
    lateral_damping: units.DampingPerLength = 0.0
    rotational_damping: units.RotationalDamping = 0.0


class RigSpec(Table):
    """What the rig's sensors see beside the string: block weight [N], torque offset [N*m]."""

    block_weight: units.Force = 0.0
    sheave_efficiency: units.Efficiency = 1.0
    torque_offset: units.Torque = 0.0


class ContactSpec(Table):
    """The law of friction, and the damping of a contact point [N*s/m]; not `enabled`: no wall at all."""

    enabled: StrictBool = True
    friction_law: Literal["coulomb", "paper"] = "coulomb"
    damping: units.Damping = 1e4


class SolverSpec(Table):
    """The time step [s], and joint damping as a multiple of joint stiffness [s].

    The default damps like steel, a loss of 0.2 % at 30 Hz: enough to keep sliding segments from chattering.
    """

    step: float | Literal["auto"] = "auto"
    joint_damping: units.Time = 1e-5

    @field_validator("step", mode="before")
    @classmethod
    def _read_step(cls, raw: Any) -> Any:
        if raw == "auto":
            return raw
        try:
            return units.Quantity(dimension=units.TIME, above=0.0).parse(raw)
        except InputError as error:
            raise InputError(f'"auto" or {error.expected}', value=raw) from None


class RecordSpec(Table):
    """How often the history has a row [s], and the bit depths [m] at which a profile is kept."""

    interval: units.PositiveTime = 1.0
    profile_at: tuple[units.Length, ...] = ()


class _Operation(Table):
    """What all kinds of operation share; the class keys name its first and last depth in the file."""

    start_key: ClassVar[str]
    end_key: ClassVar[str]
    ramp_time: units.PositiveTime = 10.0

    @property
    def start_md(self) -> float:
        """Bit depth at the start [m]."""
        return float(getattr(self, self.start_key))

    @property
    def end_md(self) -> float:
        """Bit depth at the end [m]."""
        return float(getattr(self, self.end_key))


class _Move(_Operation):
    """The bit goes from one depth [m] to another at a speed [m/s]; the kind sets the direction."""

    start_key = "from_md"
    end_key = "to_md"
    downwards: ClassVar[bool] = False
    from_md: units.Length
    to_md: units.Length
    speed: units.PositiveSpeed

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.to_md == self.from_md or (self.to_md > self.from_md) != self.downwards:
            side = "below" if self.downwards else "above"
            raise InputError(f"a depth {side} from_md, {self.from_md:g} m", key="to_md")
        return self


class TripIn(_Move):
    """Into the hole: slack-off."""

    kind: Literal["trip_in"]
    downwards = True
    rpm: units.Rpm = 0.0


class TripOut(_Move):
    """Out of the hole: pick-up."""

    kind: Literal["trip_out"]
    rpm: units.Rpm = 0.0


class BackReam(_Move):
    """Out of the hole while rotating."""

    kind: Literal["back_ream"]
    rpm: units.PositiveRpm


class RotateOffBottom(_Operation):
    """Rotation in place for a duration [s]."""

    start_key = end_key = "at_md"
    kind: Literal["rotate_off_bottom"]
    at_md: units.Length
    duration: units.PositiveTime
    rpm: units.PositiveRpm
    speed: ClassVar[float] = 0.0


Operation = TripIn | TripOut | BackReam | RotateOffBottom
KINDS: Final[dict[str, type[Operation]]] = {
    "trip_in": TripIn,
    "trip_out": TripOut,
    "rotate_off_bottom": RotateOffBottom,
    "back_ream": BackReam,
}


class Case(Table):
    """A whole case. `file` is where it was read from, None when it was not."""

    name: str = Field(description="a name in quotes")
    wellbore: WellboreSpec = Field(description="a table [wellbore]")
    string: StringSpec = Field(description="a table [string]")
    mud: MudSpec = MudSpec()
    rig: RigSpec = RigSpec()
    contact: ContactSpec = ContactSpec()
    solver: SolverSpec = SolverSpec()
    record: RecordSpec = RecordSpec()
    operations: tuple[Annotated[Operation, Field(discriminator="kind")], ...] = ()
    file: Path | None = None

    @field_validator("operations", mode="before")
    @classmethod
    def _fill_in_starts(cls, raw: Any) -> Any:
        """An operation that does not say where it starts does so where the one before ended."""
        if not isinstance(raw, list | tuple):
            return raw  # pydantic says what it is not
        filled = []
        end: object = MISSING
        for i, operation in enumerate(raw):
            if isinstance(operation, Mapping):
                name = look_up(operation, "kind")
                kind = KINDS.get(str(name))
                if kind is None:
                    raise InputError(nearest(name, KINDS, "kind"), key=f"[{i}].kind", value=name)
                if end is not MISSING and look_up(operation, kind.start_key) is MISSING:
                    operation = {**operation, kind.start_key: end}
                end = look_up(operation, kind.end_key)
            filled.append(operation)
        return filled

    @model_validator(mode="after")
    def _check(self) -> Self:
        for i, (before, here) in enumerate(pairwise(self.operations), start=1):
            if abs(here.start_md - before.end_md) > _SAME_DEPTH:
                raise InputError(
                    f"{before.end_md:g} m, where the operation before ends (or leave it out)",
                    key=f"operations[{i}].{here.start_key}",
                )
        lightest = min(component.density for component in self.string.components)
        if self.mud.density >= lightest:
            raise InputError(f"a density below the string's, {lightest:g} kg/m^3", key="mud.density")
        return self

    def check_depths(self, raw: Mapping[str, Any] | None = None) -> None:
        """Refuse a bit above the top of the string, or deeper than survey or intervals.

        Reads the survey, so it is no part of validation: a stored case can be read without its files.
        raw: the case as it was written, to quote it.
        """
        top = self.string.top_md
        bottom = min(float(self.wellbore.read_stations()[-1, 0]), self.wellbore.intervals[-1].to_md)
        for i, operation in enumerate(self.operations):
            for key in (operation.start_key, operation.end_key):
                md = getattr(operation, key)
                if not top < md <= bottom + _SAME_DEPTH:
                    written = look_up(raw, "operations", i, key)
                    raise InputError(
                        f"a depth below string.top_md, {top:g} m, within survey and intervals, {bottom:g} m",
                        key=f"operations[{i}].{key}",
                        value=f"{md:g} m" if written is MISSING else written,
                    )


def load_case(path: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None) -> Case:
    """The case of a TOML file, validated after the overrides; raises InputError for whatever is wrong.

    overrides: dotted keys ("operations[0].speed" or "operations.0.speed") to values as a case file
    has them; None deletes a key. The key "friction" sets the friction of every interval.
    """
    path = Path(path)
    raw: dict[str, Any] = {}
    try:
        raw = _read(path)
        for key, value in (overrides or {}).items():
            _override(raw, key, value)
        case = Case.model_validate(raw, context={"folder": path.parent.absolute()})
        case.check_depths(raw)
    except ValidationError as failure:
        raise explain(failure, raw, branches=KINDS).in_file(path) from None
    except InputError as error:
        raise error.in_file(path) from error.__cause__
    return case.model_copy(update={"file": path})


def parse_override(text: str) -> tuple[str, Any]:
    """Key and value of "key=value": a TOML value, or else a plain string, or None for nothing at all."""
    key, sign, written = (part.strip() for part in text.partition("="))
    if not (key and sign):
        raise InputError("key=value", value=text)
    if not written:
        return key, None
    try:
        table = tomllib.loads(f"value = {written}")
    except (ValueError, RecursionError):
        return key, written
    return key, table["value"] if table.keys() == {"value"} else written


def _read(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"a case file that can be read ({error.strerror})") from error
    except (ValueError, RecursionError) as error:  # no text, no TOML, or nested without end
        raise InputError(f"a case file in TOML ({error})") from error


def _override(raw: dict[str, Any], key: str, value: Any) -> None:
    """Set or delete one dotted key of an unvalidated case."""
    if key == "friction":
        intervals = look_up(raw, "wellbore", "intervals")
        for i in range(len(intervals) if isinstance(intervals, list) else 0):
            set_key(raw, f"wellbore.intervals[{i}].friction", value)
    elif key == "wellbore.survey" and isinstance(value, str | os.PathLike) and os.path.isfile(value):
        set_key(raw, key, os.path.abspath(value))  # whoever types a path means it from where they are
    else:
        set_key(raw, key, value)
