"""The case: `load_case` reads a TOML file, applies overrides and validates; every float of a `Case` is SI."""

import hashlib
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Self

from pydantic import Field, PrivateAttr, field_validator, model_validator

from fctd.case.datum import DatumSpec
from fctd.case.doubts import warnings_of
from fctd.case.drilling import BitSpec
from fctd.case.errors import MISSING, InputError, Table, naming, show
from fctd.case.file_names import FileName
from fctd.case.fluids import TemperatureSpec, check_downwards
from fctd.case.friction import FrictionChoice, changed, friction_sets
from fctd.case.from_python import as_written
from fctd.case.hole import WellboreSpec
from fctd.case.input_file import read_toml
from fctd.case.input_warnings import InputWarning
from fctd.case.limits import LimitsSpec
from fctd.case.message import quantity, within
from fctd.case.operation_names import read_kind
from fctd.case.operations import KINDS, Operation
from fctd.case.raw_case import (
    apply_override,
    bare_lengths,
    checked,
    look_up,
    split_key,
    with_bare_lengths,
    without_stations,
)
from fctd.case.rig import MudSpec, RigSpec
from fctd.case.solver import RESOLVING, RecordSpec, SolverSpec
from fctd.case.string import StringSpec
from fctd.case.systems import System, system_named
from fctd.case.wall import ContactSpec, check_friction

_OF_SURVEYS: Final = (".csv", ".txt", ".tsv", ".dat", ".xlsx", ".xml")
# Other keys in a message, whose values are shown.
_OTHERS: Final = re.compile(r"wellbore\.intervals\[\d+\]\.diameter")
SAME_DEPTH: Final = 1e-6  # m: one depth written in two units


@dataclass(frozen=True)
class _Written:
    """The case as the user wrote it, without stations; all are equal, so that cases compare by keys."""

    raw: Mapping[str, Any] = field(default_factory=dict, compare=False)
    bare_lengths: list[str] = field(default_factory=list, compare=False)


class Case(Table):
    """A case: hole, string, rig and operations.

    units : in which its results are shown where nobody asks for others; it changes none of them.  file : the case file
    that it was read from, or None.
    """

    name: str = Field(description="a name in quotes")
    units: System | None = Field(default=None, exclude_if=lambda named: named is None)
    datum: DatumSpec = DatumSpec()
    wellbore: WellboreSpec = Field(description="a table [wellbore]")
    string: StringSpec = Field(description="a table [string]")
    mud: MudSpec = MudSpec()
    temperature: tuple[TemperatureSpec, ...] = Field(default=(), description="tables [[temperature]]")
    rig: RigSpec = RigSpec()
    limits: LimitsSpec = LimitsSpec()
    bit: BitSpec = BitSpec()
    contact: ContactSpec = ContactSpec()
    solver: SolverSpec = Field(default_factory=SolverSpec)
    record: RecordSpec = RecordSpec()
    operations: tuple[Annotated[Operation, Field(discriminator="kind")], ...] = ()
    file: FileName | None = None
    _written: _Written = PrivateAttr(default_factory=lambda: _Written())

    def __repr__(self) -> str:
        return f"Case({self.name!r})" if self.file is None else f"Case({self.name!r}, file={str(self.file)!r})"

    __str__ = __repr__

    @field_validator("units", mode="before", json_schema_input_type=Literal["si", "metric", "field"] | None)
    @classmethod
    def _read_units(cls, raw: Any) -> Any:
        return None if raw is None else system_named(raw)

    @field_validator("operations", mode="before")
    @classmethod
    def _fill_in_starts(cls, raw: Any) -> Any:
        """Give an operation the kind that its name is of, and the start that it omits: the end of the one before."""
        if not isinstance(raw, list | tuple):
            return raw  # pydantic reports the wrong type
        filled = []
        end: object = MISSING
        for i, operation in enumerate(raw):
            if isinstance(operation, Mapping):
                try:
                    name = read_kind(look_up(operation, "kind"))
                except InputError as error:
                    raise error.at(f"[{i}].kind") from None
                operation, kind = {**operation, "kind": name}, KINDS[name]
                if end is not MISSING and look_up(operation, kind.start_key) is MISSING:
                    operation = {**operation, kind.start_key: end}
                end = look_up(operation, kind.end_key)
            filled.append(operation)
        return filled

    @model_validator(mode="after")
    def _check(self) -> Self:
        for i, (before, here) in enumerate(pairwise(self.operations), start=1):
            if abs(here.start_md - before.end_md) > SAME_DEPTH:
                raise InputError(
                    f"{quantity(before.end_md, 'm')}, where the operation before ends (or leave it out)",
                    key=f"operations[{i}].{here.start_key}",
                )
        densities = [component.density for component in self.string.components]
        lightest = min(densities)
        fluids = {"mud.density": self.mud.density}
        for name, rows in (("inside", self.mud.inside), ("outside", self.mud.outside)):
            fluids |= {f"mud.{name}[{i}].density": row.density for i, row in enumerate(rows)}
        for key, density in fluids.items():
            if density >= lightest:
                of = f"string.components[{densities.index(lightest)}].density"
                raise InputError(f"a density below the string's, {quantity(lightest, 'kg/m^3')} ({of})", key=key)
        bed, end = self.datum.sea_bed, self.wellbore.intervals[-1].to_md
        if bed is not None and bed >= end:
            expected = (
                f"a sea bed above the end of the hole, {quantity(end, 'm')}, not {quantity(bed, 'm')} below the "
                "rotary table"
            )
            raise InputError(expected, key="datum.water_depth", value=quantity(self.datum.water_depth or 0.0, "m"))
        check_downwards(self.temperature, "temperature")
        check_downwards(self.wellbore.window, "wellbore.window")
        if self.mud.float and self.bit.end not in (None, "float"):
            raise InputError('"float", or mud.float = false', key="bit.end", value=self.bit.end)
        pumping = [i for i, operation in enumerate(self.operations) if operation.flow]
        if pumping and self.end == "closed":
            raise InputError("0 with bit.end closed", key=f"operations[{pumping[0]}].flow")
        if pumping and self.mud.packer_bore is not None:
            expected = "0 beside mud.packer_bore, as no mud returns past the packer"
            raise InputError(expected, key=f"operations[{pumping[0]}].flow")
        if self.mud.packer_bore is not None and self.end != "open":
            raise InputError('"open" beside mud.packer_bore', key="bit.end", value=self.end)
        self._check_fittings()
        check_friction(self.contact, self.wellbore.intervals, self.mud.cake)
        if self.contact.helical_force == "analytic" and self.solver.buckling in RESOLVING:
            raise InputError(
                f'"none" with solver.buckling = "{self.solver.buckling}", whose segments bend into the helix (or '
                'solver.buckling = "detect")',
                key="contact.helical_force",
                value="analytic",
            )
        return self

    def _check_fittings(self) -> None:
        """Raise InputError where bow springs or a swivel meet what they are not modelled with."""
        parts = self.string.components
        if any(part.has_bows for part in parts):
            if self.contact.law != "linear":
                raise InputError('"linear" beside bow springs', key="contact.law", value=self.contact.law)
            if self.wellbore.geometry == "sampled":
                expected = '"arcs" or "cylinders" beside bow springs'
                raise InputError(expected, key="wellbore.geometry", value=self.wellbore.geometry)
        if any(part.swivel for part in parts):
            for key, given in (("torque", self.bit.torque), ("rock", self.bit.rock)):
                if given:
                    raise InputError("none below a swivel, which no torque passes", key=f"bit.{key}")

    @property
    def system(self) -> System:
        """The system of units in which its results are shown."""
        return self.units or "si"

    @property
    def end(self) -> str:
        """What the lower end lets through: it is "open", "closed", or has a "float"."""
        return self.bit.end or ("float" if self.mud.float else "open")

    @property
    def depths(self) -> tuple[float, float]:
        """Top of the string and greatest bit depth within survey and intervals [m]; reads the survey."""
        deepest = min(float(self.wellbore.trajectory[-1, 0]), self.wellbore.intervals[-1].to_md)
        return self.string.top_md, deepest

    @property
    def deepest(self) -> float:
        """Greatest bit depth [m] that the string reaches within survey and intervals; reads the survey."""
        top, bottom = self.depths
        lengths = [part.length for part in self.string.components]
        return bottom if None in lengths else min(bottom, top + sum(length or 0.0 for length in lengths))

    @property
    def end_as_written(self) -> str:
        """The greatest bit depth that the string reaches, as the case has it where that is the end of its hole."""
        written = look_up(self._written.raw, "wellbore", "intervals", -1, "to_md")
        deepest = self.deepest
        whole = deepest == self.wellbore.intervals[-1].to_md
        return written if whole and isinstance(written, str) else f"{deepest:.10g} m"

    @property
    def shoes(self) -> list[float]:
        """Depths [m] of the casing shoes: the ends of cased intervals (of all, without kinds) above the end of the
        hole; reads the survey."""
        bottom, intervals = self.depths[1], self.wellbore.intervals
        kinds = {interval.kind for interval in intervals}
        cased = [interval for interval in intervals if kinds == {None} or interval.kind == "cased"]
        return [interval.to_md for interval in cased if interval.to_md < bottom]

    @property
    def digest(self) -> str:
        """A hash of all that the case says, with stations and caliper in place of the names of their files.

        It reads survey and caliper; the same well has the same one on every machine, whatever its file is called.
        """
        of_files: Any = {"survey": True, "columns": True, "sheet": True, "stations": True, "caliper": {"log": True}}
        told = self.model_dump_json(exclude={"file": True, "units": True, "wellbore": of_files}, warnings=False)
        caliper = self.wellbore.calipers
        parts = [told.encode(), self.wellbore.trajectory.tobytes()]
        parts += [] if caliper is None else [caliper.md.tobytes(), caliper.radii.tobytes()]
        return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]

    @property
    def warnings(self) -> tuple[InputWarning, ...]:
        """Probable mistakes of the case and of its operations (`doubts`); reads the survey."""
        return warnings_of(self)

    @property
    def bare_lengths(self) -> list[str]:
        """Keys of lengths that are written as bare numbers, where most lengths are in feet and inches and none in SI.

        Empty where the case was not read from a file.
        """
        return self._written.bare_lengths

    @property
    def written(self) -> Mapping[str, Any]:
        """The tables as the user wrote them, without stations; of a case from no file those that were given."""
        return self._written.raw or self.model_dump(exclude_unset=True, exclude={"file"})

    def text_of(self, key: str) -> str | None:
        """The text that the user wrote for a key, None for a bare number and for a key that he left out."""
        written = look_up(self._written.raw, *split_key(key))
        return written if isinstance(written, str) else None

    def quoting(self, error: InputError) -> InputError:
        """The error with the value as the user wrote it, where the error is about a key that he wrote."""
        others = (".contact_diameter", ".joint.tool_joint_diameter", ".pipe", ".outer_diameter")
        for key in (error.key, *(error.key.replace(".contact_diameter", other) for other in others)):
            try:
                written = look_up(self._written.raw, *split_key(key))
            except InputError:
                return error  # about no key of a case
            if isinstance(written, str | int | float) and error.file is None:
                of_pipe = key.endswith(".pipe") and key != error.key
                expected = _OTHERS.sub(self._as_written, within(error.expected))
                expected = f"a diameter of {expected}, not {error.value}" if of_pipe else expected
                return InputError(expected, key=key, value=written, more=error.more)
        return error

    def _as_written(self, key: re.Match[str]) -> str:
        for name in (key[0], key[0].replace(".diameter", ".casing")):  # a casing by name has its diameter
            if (written := look_up(self._written.raw, *split_key(name))) is not MISSING:
                return f"{name} = {show(written)}"
        return key[0]

    def check_depths(self) -> None:
        """Raise InputError for a bit depth above the top of the string, or below the end of survey or intervals.

        It reads the survey, so it is not part of validation: a stored case can be read without its files.
        """
        top, bottom = self.depths
        for i, operation in enumerate(self.operations):
            for key in (operation.start_key, operation.end_key):
                md = getattr(operation, key)
                check_bit_depth(md, top, bottom, f"operations[{i}].{key}", quantity(md, "m"))


def with_friction(case: Case, friction: FrictionChoice | None) -> Case:
    """The case with one kinetic friction factor in every interval, or with factors by kind; None for its own.

    Static factors are scaled along.  Raises InputError, which names the key ``friction``.
    """
    if friction is None:
        return case
    (chosen,), old = friction_sets([friction]), case.wellbore.intervals
    wellbore = case.wellbore.model_copy(update={"intervals": changed(old, chosen.of(old))})
    return case.model_copy(update={"wellbore": wellbore})


@contextmanager
def naming_file(case: Case) -> Iterator[None]:
    """Add the case's file to an InputError that is raised inside; InputError for what is no case, such as a path."""
    if not isinstance(case, Case):
        raise InputError("a case, which fctd.load_case reads from a file", key="case", value=case)
    try:
        yield
    except InputError as error:
        error = case.quoting(error)
        raise (error if case.file is None else error.in_file(case.file)) from None


def check_bit_depth(md: float, top: float, bottom: float, key: str, value: object) -> None:
    """Raise InputError unless a bit depth lies below the top of the string and in the hole, all [m]."""
    if not top < md <= bottom + SAME_DEPTH:
        raise InputError(
            f"a depth below string.top_md, {quantity(top, 'm')}, within survey and intervals, {quantity(bottom, 'm')}",
            key=key,
            value=value,
        )


def load_case(
    source: str | os.PathLike[str] | Mapping[str, Any] | Case, overrides: Mapping[str, Any] | None = None
) -> Case:
    """The case of a TOML file or of a dict, validated after the overrides; raises InputError for bad input.

    source : path of the file; or its tables, in which the names of files are relative to the current folder; or a case,
    of which the overrides make another one.
    overrides: dotted keys ("operations[0].speed" or "operations.0.speed") to values as in a case
    file; None deletes a key. A component or an interval may have its name in place of an index. The key "friction" sets
    the friction of every interval, or with {"cased": 0.2, "open": 0.3}, as "friction.open" does, that of the intervals
    of these kinds; "0.3/0.2" in place of a factor is one along the hole and one around it. The key
    "rotational_friction" sets the factor around the hole alone, in the same ways.

    In a dict and in overrides the value of wellbore.stations may be a DataFrame, whose columns are named as those of a
    survey file are, and other lists of tables, such as wellbore.intervals, DataFrames with a row for each.

        >>> case = fctd.load_case("examples/my_well.toml", {"mud.density": "1.3 sg"})
        >>> case.mud.density
        1300.0
    """
    path = None if isinstance(source, Mapping | Case) else _path(source)
    with naming(path):
        raw = read_raw(path) if path is not None else as_written(source)
        for key, value in (overrides or {}).items():
            apply_override(raw, key, as_written(value, key))
        case = make_case(raw, (Path() if path is None else path.parent).absolute())
    return case if path is None else case.model_copy(update={"file": path})


def _path(source: object) -> Path:
    if not isinstance(source, str | os.PathLike):
        raise InputError("the path of a case file, a dict of its tables, or a case", key="source", value=source)
    return Path(source)


def make_case(raw: dict[str, Any], folder: Path | None, like: Case | None = None) -> Case:
    """The case of an unvalidated one; raises InputError, which names no file.

    folder : that survey files are relative to, None where they are paths already.  like : a case whose survey has been
    read; a case with the same keys of the survey shares its stations.
    """
    try:
        case = checked(Case, raw, None if folder is None else {"folder": folder})
    except InputError as error:
        raise with_bare_lengths(error, raw) from None
    case._written = _Written(without_stations(raw), bare_lengths(raw))
    if like is not None:
        case.wellbore.share_trajectory(like.wellbore)
    try:
        case.check_depths()
    except InputError as error:
        raise case.quoting(error) from error.__cause__
    return case


def read_raw(path: Path) -> dict[str, Any]:
    """The tables of a case file, unvalidated; raises InputError, which names no file."""
    try:
        return read_toml(path, "a case file")
    except InputError as error:
        if path.suffix.lower() in _OF_SURVEYS and path.is_file():
            raise InputError("a case file in TOML; of a survey, `fctd init` makes one") from error
        raise
