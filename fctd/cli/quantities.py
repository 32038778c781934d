"""Options that take quantities: one reader for all commands."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

import typer

from fctd.case import message
from fctd.case.errors import InputError
from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.spellings import split
from fctd.case.systems import FORCE, LENGTH, ROP, TORQUE, Kind, System
from fctd.case.units import LikelyUnit, typed, unit_hint
from fctd.model.depths import read_depth, read_depths

# Who types a bare number seldom means newtons: a force or a torque has its unit.
LOADS: Final = {FORCE: "'200 kN' or '40 klbf'", TORQUE: "'15 kN*m' or '11 kft*lbf'"}


@dataclass(frozen=True)
class QuantityOption:
    """An option that takes a quantity.

    name : with its dashes.  kind : with the units of a bare number.  above : 0 where 0 is refused.  at_most : largest
    value [SI].  likely_units : that a bare SI number beyond it may be in.
    """

    name: str
    kind: Kind
    above: float | None = None
    at_most: float | None = None
    likely_units: tuple[LikelyUnit, ...] = ()

    def parse(self, text: "str | Given") -> "Given":
        """What was typed; it is read once the system of units is known."""
        return text if isinstance(text, Given) else Given(text, self)

    def read(self, text: str, units: System) -> float:
        """A quantity of at least 0 [SI]; InputError names the option."""
        dimension, bare = self.kind.dimension, self.kind.bare_unit(units)
        if bare is None and is_number(text) and float(text) != 0:
            expected = f"{dimension.noun} with its unit, such as {LOADS[self.kind]}"
            raise InputError(expected, key=self.name, value=text)
        value = typed(text, dimension, self.name, bare or "")
        if self.above is not None and value <= self.above:
            raise InputError(f"{dimension.noun} above {self.above:g}", key=self.name, value=text)
        if self.at_most is not None and value > self.at_most:
            most = f"{dimension.noun} of at most {message.quantity(self.at_most, dimension.unit)}"
            if is_number(text) and bare == dimension.unit:
                most += unit_hint(float(text), self.likely_units)
            raise InputError(most, key=self.name, value=text)
        return value


@dataclass(frozen=True)
class Given:
    """The text of an option that takes a quantity."""

    text: str
    option: QuantityOption

    def __str__(self) -> str:
        return self.text

    def si(self, units: System) -> float:
        """The quantity [SI]; InputError names the option."""
        return self.option.read(self.text, units)

    def complete(self, units: System) -> str:
        """The text, in which each bare number of FROM:TO:STEP has its unit."""
        bare = self.option.kind.bare_unit(units)
        return ":".join(f"{part} {bare}" if bare and is_number(part) else part for part in self.text.split(":"))

    def depth(self, case: Case, units: System) -> float:
        """A depth [m], ``td`` or ``shoe`` too; InputError names the option."""
        return read_depth(self.text, case, self.option.name, self.option.kind.bare_unit(units) or "m")

    def depths(self, case: Case, units: System) -> list[float]:
        """One bit depth within the hole, or those of FROM:TO:STEP [m]; InputError names the option."""
        text, name = self.text, self.option.name
        if ":" in text:
            return read_depths(text, case, name, self.option.kind.bare_unit(units) or "m")
        try:
            found = self.depth(case, units)
        except InputError as error:
            if text.strip().lower() == "shoe" or ", written " in error.expected:
                raise
            expected = "a bit depth, or FROM:TO:STEP, such as 1750:2450:10, '5000 ft:8000 ft:30 ft' or shoe:td:50"
            raise InputError(expected, key=name, value=text) from error
        with naming_file(case):
            check_bit_depth(found, *case.depths, name, text)
        return [found]


BIT_DEPTH: Final = QuantityOption("--bit-depth", LENGTH)
TOTAL_DEPTH: Final = BIT_DEPTH.parse("td")
DEPTHS: Final = QuantityOption("--depths", LENGTH)
TO_TOTAL_DEPTH: Final = DEPTHS.parse("td")
PENETRATION: Final = QuantityOption("--penetration", ROP)


def si(given: Given | None, units: System) -> float | None:
    """The quantity of an option [SI]; None where it was not given."""
    return None if given is None else given.si(units)


def several(given: Iterable[Given], units: System) -> list[float]:
    """The quantities [SI] of an option that may be repeated, or have commas between its values."""
    return [each.option.read(part, units) for each in given for part in _parts(each)]


def _parts(given: Given) -> list[str]:
    """The values of an option.  What may also be one number with a comma is refused: "1,500", "1,5 m3/min"."""
    name = given.option.name
    if re.fullmatch(r"\s*[+-]?\d+(,\d+)+\s*", given.text):
        expected = f"{given.option.kind.dimension.noun} without a comma, or several with a unit each"
        raise InputError(expected, key=name, value=given.text)
    try:
        split(given.text)
    except InputError as error:
        more = "; of several values each has its unit" if "," in given.text else ""
        expected = f"{given.option.kind.dimension.noun}, written {error.expected}{more}"
        raise InputError(expected, key=name, value=given.text) from None
    return [part.strip() for part in given.text.split(",")]


def quantity(option: QuantityOption, metavar: str, what: str, **more: Any) -> Any:
    """The declaration of an option that takes a quantity, for a command's signature."""
    return typer.Option(option.name, parser=option.parse, metavar=metavar, help=what, **more)


def is_number(text: str) -> bool:
    """Whether a text is a bare number."""
    try:
        float(text)
    except ValueError:
        return False
    return True
