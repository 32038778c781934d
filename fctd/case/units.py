"""Quantities of the input: a string with its unit, or a bare SI number, becomes an SI float.

`Length`, `PositiveTime`, … are `float` to the type checker and, as fields of a pydantic model,
parse and check the user's value. All other code computes in SI.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from functools import cache
from numbers import Integral, Real
from typing import TYPE_CHECKING, Annotated, Any, Final

from pydantic_core import CoreSchema, core_schema

from fctd.case.errors import Expects, InputError

if TYPE_CHECKING:
    from pint import UnitRegistry
    from pydantic import GetCoreSchemaHandler

# Only text of this shape reaches pint: its parser evaluates arithmetic ("8 1/2 in" is 0.1 m to it,
# "1,2 m" is 12 m, and "10**10**10 m" never returns).
_FACTOR = r"[^\W\d_]+(?:(?:\^|\*\*)?-?[1-9]|[²³])?"
_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"\s*(?P<unit>{_FACTOR}(?:\s*[*/·]\s*{_FACTOR})*)\s*",
)


@dataclass(frozen=True)
class Dimension:
    """A physical dimension: its name with article, its SI unit and examples for messages."""

    noun: str
    unit: str
    example: str


LENGTH: Final = Dimension("a length", "m", "'12 m' or '40 ft'")
TIME: Final = Dimension("a time", "s", "'10 s' or '2 min'")
SPEED: Final = Dimension("a speed", "m/s", "'0.5 m/s' or '60 ft/min'")
FORCE: Final = Dimension("a force", "N", "'50 kN' or '12 klbf'")
TORQUE: Final = Dimension("a torque", "N*m", "'0.5 kN*m' or '400 ft*lbf'")
ANGLE: Final = Dimension("an angle", "rad", "'1.5 deg'")
STRESS: Final = Dimension("a stress", "Pa", "'206.8 GPa' or '30e6 psi'")
DENSITY: Final = Dimension("a density", "kg/m^3", "'1200 kg/m^3' or '10 ppg'")
LINEAR_MASS: Final = Dimension("a mass per length", "kg/m", "'36.8 kg/m' or '19.5 lb/ft'")
STIFFNESS: Final = Dimension("a stiffness", "N/m", "'1e7 N/m'")
STIFFNESS_PER_LENGTH: Final = Dimension("a stiffness per length", "N/m^2", "'1e6 N/m/m'")
AXIAL_STIFFNESS: Final = Dimension("an axial or shear stiffness", "N", "'1.2e9 N'")
BENDING_STIFFNESS: Final = Dimension("a bending or torsional stiffness", "N*m^2", "'2e6 N*m^2'")
DAMPING: Final = Dimension("a damping coefficient", "N*s/m", "'1e4 N*s/m'")
DAMPING_PER_LENGTH: Final = Dimension("a damping coefficient per length", "N*s/m^2", "'5 N*s/m^2'")
ROTATIONAL_DAMPING: Final = Dimension("a rotational damping per length", "N*s", "'0.1 N*s'")


@cache
def _registry() -> UnitRegistry[Any]:
    """The unit registry; built on first use, since importing pint takes half a second."""
    from pint import UnitRegistry

    registry: UnitRegistry[Any] = UnitRegistry()
    registry.define("pound_per_gallon = pound / gallon = ppg")
    registry.define("specific_gravity = 1000 kilogram / meter ** 3 = sg")
    return registry


@cache
def conversion(unit: str, target: str) -> float:
    """How many `target` units one `unit` is, e.g. conversion("ft", "m") = 0.3048.

    Raises ValueError for a unit that is unknown or of another dimension.
    """
    if unit == target:
        return 1.0
    registry = _registry()
    try:
        factor = registry.Quantity(1.0, unit).to(target).magnitude
    except Exception as error:  # pint's parser also raises assertion and token errors
        raise ValueError(f"{unit!r} cannot be converted to {target!r}") from error
    return float(f"{factor:.15g}")  # pint multiplies floats: its foot is 0.30479999999999996 m


@dataclass(frozen=True, kw_only=True)
class Number(Expects):
    """Pydantic annotation for a bare number within bounds; its error message gives the bounds."""

    noun: str = "a number"
    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None

    @property
    def bounded(self) -> str:
        """The noun with its bounds: "a length above 0", "a speed above 0 and at most 10 m/s"."""
        bounds = {"above": self.above, "at least": self.at_least, "at most": self.at_most}
        unit = f" {self.unit}" if self.unit else ""
        words = " and ".join(
            f"{word} {limit:g}{unit if limit else ''}" for word, limit in bounds.items() if limit is not None
        )
        return f"{self.noun} {words}".strip()

    @property
    def expected(self) -> str:
        """The accepted input, a noun phrase."""
        return self.bounded

    def read(self, value: object) -> float:
        """The value as a float; InputError unless it is a number (a boolean is not)."""
        if isinstance(value, bool) or not isinstance(value, Real):
            raise InputError(self.expected, value=value)
        try:
            return float(value)
        except OverflowError as error:  # an integer beyond the floats
            raise InputError(self.expected, value=value) from error

    def parse(self, value: object) -> float:
        """The value in SI, finite and within bounds, or an InputError."""
        number = self.read(value)
        if not math.isfinite(number):
            raise InputError(self.expected, value=value)
        within = (
            (self.above is None or number > self.above)
            and (self.at_least is None or number >= self.at_least)
            and (self.at_most is None or number <= self.at_most)
        )
        if not within:
            raise InputError(self.bounded, value=value)
        return number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.parse, handler(source))


@dataclass(frozen=True, kw_only=True)
class Whole(Number):
    """A whole number: 20, not 20.0."""

    noun: str = "a whole number"

    def read(self, value: object) -> float:
        if not isinstance(value, Integral):
            raise InputError(self.expected, value=value)
        return super().read(value)


@dataclass(frozen=True, kw_only=True)
class Quantity(Number):
    """A quantity of one dimension: a string with its unit, or a bare SI number."""

    dimension: Dimension
    noun: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "noun", self.dimension.noun)
        object.__setattr__(self, "unit", self.dimension.unit)

    @property
    def expected(self) -> str:
        return f"{self.noun} such as {self.dimension.example}"

    def read(self, value: object) -> float:
        if not isinstance(value, str):
            return super().read(value)
        match = _QUANTITY.fullmatch(value)
        if match is None:
            raise InputError(self.expected, value=value)
        try:
            factor = conversion(match["unit"], self.dimension.unit)
            # In decimals "102 mm" is 0.102 m; in binary floats it is 0.10200000000000001 m.
            return float(Decimal(match["number"]) * Decimal(repr(factor)))
        except (ValueError, ArithmeticError) as error:
            raise InputError(self.expected, value=value) from error


def bare(value: object, key: str, noun: str) -> float:
    """An argument of a call from Python as a float; InputError, which names it, for a text such as "2000 m"."""
    try:
        return Number(noun=noun).read(value)
    except InputError as error:
        raise error.at(key) from None


Bare = Annotated[float, Number(noun="a bare number")]
Count = Annotated[int, Whole(at_least=1, at_most=1e6)]  # far above state.MAX_SEGMENTS, whose check has a better message
FRICTION: Final = Number(noun="a friction factor", at_least=0.0, at_most=5.0)  # 20 is per cent
Friction = Annotated[float, FRICTION]
PoissonRatio = Annotated[float, Number(at_least=0.0, at_most=0.5)]
Efficiency = Annotated[float, Number(noun="an efficiency", above=0.0, at_most=1.0)]
# Hoists run at 1 to 3 m/s and top drives at up to 300 rev/min; a model at a thousandth of the size turns some thirty
# times as fast.  A larger number is in the wrong unit.
FASTEST: Final = 10.0  # [m/s]
MOST_RPM: Final = 10_000.0
Rpm = Annotated[float, Number(noun="a bare number of rev/min", at_least=0.0, at_most=MOST_RPM)]
PositiveRpm = Annotated[float, Number(noun="a bare number of rev/min", above=0.0, at_most=MOST_RPM)]
Length = Annotated[float, Quantity(dimension=LENGTH, at_least=0.0)]
PositiveLength = Annotated[float, Quantity(dimension=LENGTH, above=0.0)]
WIDEST: Final = 5.0  # [m]: no well is wider; 8.5 is in inches
Bore = Annotated[float, Quantity(dimension=LENGTH, at_least=0.0, at_most=WIDEST)]
Diameter = Annotated[float, Quantity(dimension=LENGTH, above=0.0, at_most=WIDEST)]
Time = Annotated[float, Quantity(dimension=TIME, at_least=0.0)]
PositiveTime = Annotated[float, Quantity(dimension=TIME, above=0.0)]
PositiveSpeed = Annotated[float, Quantity(dimension=SPEED, above=0.0, at_most=FASTEST)]
Force = Annotated[float, Quantity(dimension=FORCE, at_least=0.0)]
Torque = Annotated[float, Quantity(dimension=TORQUE)]
PositiveOrZeroTorque = Annotated[float, Quantity(dimension=TORQUE, at_least=0.0)]
Angle = Annotated[float, Quantity(dimension=ANGLE)]
Smoothing = Annotated[float, Quantity(dimension=ANGLE, above=0.0, at_most=0.02)]
Bend = Annotated[float, Quantity(dimension=ANGLE, at_least=0.0, at_most=0.1)]
PositiveStress = Annotated[float, Quantity(dimension=STRESS, above=0.0)]
Density = Annotated[float, Quantity(dimension=DENSITY, at_least=0.0)]
PositiveDensity = Annotated[float, Quantity(dimension=DENSITY, above=0.0)]
PositiveLinearMass = Annotated[float, Quantity(dimension=LINEAR_MASS, above=0.0)]
PositiveStiffness = Annotated[float, Quantity(dimension=STIFFNESS, above=0.0)]
PositiveStiffnessPerLength = Annotated[float, Quantity(dimension=STIFFNESS_PER_LENGTH, above=0.0)]
PositiveAxialStiffness = Annotated[float, Quantity(dimension=AXIAL_STIFFNESS, above=0.0)]
PositiveBendingStiffness = Annotated[float, Quantity(dimension=BENDING_STIFFNESS, above=0.0)]
Damping = Annotated[float, Quantity(dimension=DAMPING, at_least=0.0)]
DampingPerLength = Annotated[float, Quantity(dimension=DAMPING_PER_LENGTH, at_least=0.0)]
RotationalDamping = Annotated[float, Quantity(dimension=ROTATIONAL_DAMPING, at_least=0.0)]
