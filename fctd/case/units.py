"""Quantities of the input: a string with its unit, or a bare SI number, becomes an SI float.

`Length`, `PositiveTime`, … are `float` to the type checker and, as fields of a pydantic model,
parse and check the user's value. All other code computes in SI.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cached_property
from numbers import Integral, Real
from typing import TYPE_CHECKING, Annotated, Any, Final, NamedTuple

from pydantic_core import CoreSchema, core_schema

from fctd.case import spellings
from fctd.case.errors import Expects, InputError
from fctd.case.message import Message, quantity, within
from fctd.case.spellings import conversion as conversion  # results are converted back with it

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler


@dataclass(frozen=True)
class Dimension:
    """A physical dimension: its name with article, its SI unit, examples and accepted units for messages.

    words : further spellings in lower case, in pint's words.  gravity : 1 where a mass stands for its weight, −1 where
    a weight stands for its mass.  listed : whether no other units than these are read; pint takes angles for plain
    numbers, so that it would read 1 m/m as an angle.
    """

    noun: str
    unit: str
    example: str
    units: tuple[str, ...]
    words: Mapping[str, str] = field(default_factory=dict, hash=False)
    gravity: int = 0
    listed: bool = False

    @property
    def accepted(self) -> str:
        """The accepted units, for messages."""
        return f"units: {', '.join(self.units)}"

    @cached_property
    def spellings(self) -> dict[str, str]:
        """The words of the accepted units and the further ones, by their spelling in lower case."""
        own = {unit.lower(): unit for unit in self.units} if self.listed else {}
        letters = {word.lower(): word for unit in self.units for word in re.findall(r"[^\W\d_]+", unit)}
        return (own if self.listed else letters) | dict(self.words)

    def factor(self, unit: str, *, back: bool = False) -> float:
        """How many SI units one `unit`, as people write it, is; ValueError for one that is not of this dimension.

        back : how many of it one SI unit is.
        """
        return spellings.factor(unit, self.unit, self.spellings, self.gravity, listed=self.listed, back=back)

    def unit_of(self, text: str) -> str | None:
        """The unit that a text is, in the spelling of the accepted units where they are listed; None for another."""
        if self.listed:
            word = self.spellings.get("".join(text.split()).lower())
            return word if word in self.units or word is None else text
        try:
            written = spellings.split(f"1 {text}")
            self.factor("" if written is None else written.unit)
        except ValueError:
            return None
        return text


LENGTH: Final = Dimension("a length", "m", "'12 m' or '40 ft'", ("m", "cm", "mm", "km", "ft", "in"))
TIME: Final = Dimension("a time", "s", "'10 s' or '2 min'", ("s", "ms", "min", "h"))
SPEED: Final = Dimension(
    "a speed", "m/s", "'0.5 m/s' or '60 ft/min'", ("m/s", "m/min", "m/h", "ft/s", "ft/min", "ft/h")
)
FORCE: Final = Dimension(
    "a force", "N", "'50 kN' or '12 klbf'", ("N", "daN", "kN", "MN", "kgf", "t", "lbf", "klbf", "kip"), gravity=1
)
TORQUE: Final = Dimension(
    "a torque", "N*m", "'0.5 kN*m' or '400 ft*lbf'", ("N*m", "kN*m", "daN*m", "kgf*m", "ft*lbf", "kft*lbf"), gravity=1
)
ANGLE: Final = Dimension(
    "an angle", "rad", "'1.5 deg'", ("deg", "°", "rad"),
    {"degree": "deg", "degrees": "deg", "deg.": "deg", "°": "deg", "radian": "rad", "radians": "rad"}, listed=True,
)  # fmt: skip
ROTATION: Final = Dimension(
    "a rotation", "rpm", "60 or '60 rev/min'", ("rpm", "rev/min", "c/min", "rev/s", "rad/s"),
    {"rev/min": "rpm", "c/min": "rpm", "r/min": "rpm", "rev/s": "turn/s", "deg/s": "deg/s", "°/s": "deg/s"},
    listed=True,
)  # fmt: skip
STRESS: Final = Dimension("a stress", "Pa", "'206.8 GPa' or '30e6 psi'", ("Pa", "MPa", "GPa", "bar", "psi", "ksi"))
PRESSURE: Final = Dimension("a pressure", "Pa", "'50 bar' or '700 psi'", ("Pa", "kPa", "bar", "MPa", "psi", "ksi"))
TEMPERATURE: Final = Dimension(
    "a change of temperature", "K", "'30 K' or '20 degF'", ("K", "degC", "degF"),
    {"k": "K", "c": "K", "°c": "K", "degc": "K", "f": "degR", "°f": "degR", "degf": "degR"}, listed=True,
)  # fmt: skip
EXPANSION: Final = Dimension(
    "a thermal expansion", "K^-1", "'12.4e-6 K^-1' or '6.9e-6 degF^-1'", ("K^-1", "degC^-1", "degF^-1"),
    {"k^-1": "K**-1", "degc^-1": "K**-1", "degf^-1": "degR**-1"}, listed=True,
)  # fmt: skip
AREA: Final = Dimension("an area", "m^2", "'0.33 in^2' or '213 mm^2'", ("m^2", "cm^2", "mm^2", "in^2"))
DENSITY: Final = Dimension(
    "a density", "kg/m^3", "'1200 kg/m^3' or '10 ppg'", ("kg/m^3", "g/cm^3", "sg", "ppg", "lb/gal", "lb/ft^3")
)
LINEAR_MASS: Final = Dimension(
    "a mass per length", "kg/m", "'36.8 kg/m' or '19.5 lb/ft'", ("kg/m", "N/m", "lb/ft", "lbf/ft", "ppf"), gravity=-1
)
STIFFNESS: Final = Dimension("a stiffness", "N/m", "'1e7 N/m'", ("N/m", "kN/m", "MN/m", "lbf/in", "lbf/ft"))
STIFFNESS_PER_LENGTH: Final = Dimension(
    "a stiffness per length", "N/m^2", "'1e6 N/m/m'", ("N/m/m", "kN/m/m", "MN/m/m", "lbf/ft/ft")
)
AXIAL_STIFFNESS: Final = Dimension("an axial or shear stiffness", "N", "'1.2e9 N'", ("N", "kN", "MN", "lbf", "klbf"))
BENDING_STIFFNESS: Final = Dimension(
    "a bending or torsional stiffness", "N*m^2", "'2e6 N*m^2'", ("N*m^2", "kN*m^2", "lbf*ft^2", "lbf*in^2")
)
DAMPING: Final = Dimension("a damping coefficient", "N*s/m", "'1e4 N*s/m'", ("N*s/m", "kN*s/m", "lbf*s/ft"))
DAMPING_PER_LENGTH: Final = Dimension(
    "a damping coefficient per length", "N*s/m^2", "'5 N*s/m^2'", ("N*s/m^2", "lbf*s/ft^2")
)
VISCOSITY: Final = Dimension("a viscosity", "Pa*s", "'30 mPa*s' or '30 cP'", ("Pa*s", "mPa*s", "cP"))
YIELD_STRESS: Final = Dimension(
    "a yield stress", "Pa", "'3 Pa' or '6 lbf/(100 ft^2)'", ("Pa", "lbf/(100 ft^2)"), gravity=1
)
FLOW: Final = Dimension("a flow rate", "m^3/s", "'2000 L/min' or '500 gpm'", ("m^3/s", "L/s", "L/min", "gpm"),
                              {"gpm": "(gallon/minute)", "lpm": "(liter/minute)"})  # fmt: skip
MOST_FLOW: Final = 1.0  # of pumps [m³/s]
ANGULAR_DAMPING: Final = Dimension(
    "a torque per rotation speed", "N*m*s", "'400 N*m*s'", ("N*m*s", "kN*m*s", "ft*lbf*s")
)
INERTIA: Final = Dimension("a moment of inertia", "kg*m^2", "'2000 kg*m^2'", ("kg*m^2", "lb*ft^2"))
ROTATIONAL_DAMPING: Final = Dimension("a rotational damping per length", "N*s", "'0.1 N*s'", ("N*s", "lbf*s"))


class LikelyUnit(NamedTuple):
    """Bare numbers above `low` and up to `high` look like another unit: the number times `factor` in `unit`."""

    low: float
    high: float
    unit: str
    factor: float = 1.0


def unit_hint(number: float, likely_units: Iterable[LikelyUnit]) -> str:
    """What a number in a wrong unit looks like, as " (8.5 looks like '8.5 in')"; empty for other numbers."""
    fitting = [f"'{number * unit.factor:g}{unit.unit}'" for unit in likely_units if unit.low < number <= unit.high]
    return f" ({number:g} looks like {' or '.join(fitting)})" if fitting else ""


@dataclass(frozen=True, kw_only=True)
class Number(Expects):
    """Pydantic annotation for a bare number within bounds; its error message gives the bounds.

    likely_units : units that a bare number out of bounds may be in.
    """

    noun: str = "a number"
    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    likely_units: tuple[LikelyUnit, ...] = ()

    @property
    def bounded(self) -> str:
        """The noun with its bounds: "a length above 0", "a speed above 0 and at most 10 m/s"."""
        bounds = {"above": self.above, "at least": self.at_least, "at most": self.at_most}
        given = {word: limit for word, limit in bounds.items() if limit is not None}
        unit = self.unit
        words = " and ".join(f"{word} {quantity(of, unit) if of and unit else f'{of:g}'}" for word, of in given.items())
        return Message(f"{self.noun} {words}".strip())

    @property
    def expected(self) -> str:
        """The accepted input, a noun phrase."""
        return self.bounded

    def read(self, value: object) -> float:
        """The value as a float; InputError unless it is a number (a boolean is not)."""
        if isinstance(value, bool) or not isinstance(value, Real):
            number = isinstance(value, str) and re.fullmatch(r"\s*[+-]?[\d.]+\s*", value)
            raise InputError(f"{within(self.expected)}, without quotes" if number else self.expected, value=value)
        try:
            return float(value)
        except OverflowError as error:  # an integer beyond the floats
            raise InputError(self.expected, value=value) from error

    def parse(self, value: object) -> float:
        """The value in SI, finite and within bounds, or an InputError."""
        number = self.read(value)
        if not math.isfinite(number):
            raise InputError(self.expected, value=value)
        fits = (
            (self.above is None or number > self.above)
            and (self.at_least is None or number >= self.at_least)
            and (self.at_most is None or number <= self.at_most)
        )
        if not fits:
            guess = "" if isinstance(value, str) else unit_hint(number, self.likely_units)
            raise InputError(within(self.bounded) + guess, value=value)
        return number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.parse, handler(source))

    @property
    def json_schema(self) -> dict[str, Any]:
        """The accepted input as JSON Schema."""
        bounds = {"exclusiveMinimum": self.above, "minimum": self.at_least, "maximum": self.at_most}
        return {"type": "number"} | {name: limit for name, limit in bounds.items() if limit is not None}

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return self.json_schema | {"description": str(self.expected)}


@dataclass(frozen=True, kw_only=True)
class Whole(Number):
    """A whole number: 20, not 20.0."""

    noun: str = "a whole number"

    def read(self, value: object) -> float:
        if not isinstance(value, Integral):
            raise InputError(self.expected, value=value)
        return super().read(value)

    @property
    def json_schema(self) -> dict[str, Any]:
        return super().json_schema | {"type": "integer"}


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
        try:
            written = spellings.split(value)
        except InputError as error:
            raise InputError(f"{self.noun}, written {within(error.expected)}", value=value) from error
        except ArithmeticError as error:
            raise InputError(self.expected, value=value) from error
        try:
            if written is not None:
                # In decimals "102 mm" is 0.102 m; in binary floats it is 0.10200000000000001 m.
                return float(written.number * Decimal(repr(self.dimension.factor(written.unit))))
        except (ValueError, ArithmeticError):
            pass
        raise InputError(f"{self.expected} ({self.dimension.accepted})", value=value)

    @property
    def json_schema(self) -> dict[str, Any]:
        return {"anyOf": [super().json_schema, {"type": "string", "pattern": "[0-9]"}]}


def argument(value: object, dimension: Dimension, key: str) -> float:
    """An argument of a call from Python, a text with its unit or a bare SI number, in SI; InputError names it."""
    try:
        return Quantity(dimension=dimension).read(value)
    except InputError as error:
        raise error.at(key) from None


def bare(value: object, key: str, noun: str) -> float:
    """An argument of a call from Python as a float; InputError, which names it, for a text such as "2000 m"."""
    try:
        return Number(noun=noun).read(value)
    except InputError as error:
        raise error.at(key) from None


Bare = Annotated[float, Number(noun="a bare number")]
SeveralCount = Annotated[int, Whole(at_least=2, at_most=1e6)]
Count = Annotated[int, Whole(at_least=1, at_most=1e6)]  # far above state.MAX_SEGMENTS, whose check has a better message
Seed = Annotated[int, Whole(at_least=0, at_most=2**32)]
FRICTION: Final = Number(
    noun="a friction factor", at_least=0.0, at_most=5.0, likely_units=(LikelyUnit(5, 100, "", 0.01),)
)
Friction = Annotated[float, FRICTION]
Exponent = Annotated[float, Number(noun="an exponent", at_least=1.0, at_most=5.0)]
PoissonRatio = Annotated[float, Number(at_least=0.0, at_most=0.5)]
Share = Annotated[float, Number(noun="a share", at_least=0.0, at_most=1.0)]
Ratio = Annotated[float, Number(noun="a ratio", at_least=0.0, at_most=10.0)]
PositiveRatio = Annotated[float, Number(noun="a ratio", above=0.0, at_most=10.0)]
DesignFactor = Annotated[float, Number(noun="a design factor", at_least=1.0, at_most=10.0)]
LossFactor = Annotated[float, Number(noun="a loss factor", at_least=0.0, at_most=0.2)]
Work = Annotated[float, Number(noun="a number of iterations times segments", above=0.0)]
Efficiency = Annotated[float, Number(noun="an efficiency", above=0.0, at_most=1.0)]
PositiveShare = Annotated[float, Number(noun="a share", above=0.0, at_most=1.0)]
# Hoists run at 1 to 3 m/s and top drives at up to 300 rev/min; a model at a thousandth of the size turns some thirty
# times as fast.  A larger number is in the wrong unit.
FASTEST: Final = 10.0  # [m/s]
A_MINUTE: Final = (LikelyUnit(10, 120, " m/min"),)  # speeds beyond it
MOST_RPM: Final = 10_000.0
DEEPEST: Final = 50_000.0  # [m] measured depth: four times the deepest well drilled
Rpm = Annotated[float, Quantity(dimension=ROTATION, at_least=0.0, at_most=MOST_RPM)]
PositiveRpm = Annotated[float, Quantity(dimension=ROTATION, above=0.0, at_most=MOST_RPM)]
MeasuredDepth = Annotated[float, Quantity(dimension=LENGTH)]
Length = Annotated[float, Quantity(dimension=LENGTH, at_least=0.0)]
PositiveLength = Annotated[float, Quantity(dimension=LENGTH, above=0.0)]
# A joint of range 3 has up to 14 m.
CellLength = Annotated[float, Quantity(dimension=LENGTH, at_least=0.01, at_most=10.0)]
JointLength = Annotated[
    float, Quantity(dimension=LENGTH, above=0.0, at_most=20.0, likely_units=(LikelyUnit(20, 60, " ft"),))
]
WIDEST: Final = 5.0  # [m]: no well is wider
DIAMETER_UNITS: Final = (LikelyUnit(WIDEST, 60, " in"), LikelyUnit(60, 1500, " mm"))
Bore = Annotated[float, Quantity(dimension=LENGTH, at_least=0.0, at_most=WIDEST, likely_units=DIAMETER_UNITS)]
Diameter = Annotated[float, Quantity(dimension=LENGTH, above=0.0, at_most=WIDEST, likely_units=DIAMETER_UNITS)]
Time = Annotated[float, Quantity(dimension=TIME, at_least=0.0)]
PositiveTime = Annotated[float, Quantity(dimension=TIME, above=0.0)]
PositiveSpeed = Annotated[float, Quantity(dimension=SPEED, above=0.0, at_most=FASTEST)]
Force = Annotated[float, Quantity(dimension=FORCE, at_least=0.0)]
PositiveForce = Annotated[float, Quantity(dimension=FORCE, above=0.0)]
Torque = Annotated[float, Quantity(dimension=TORQUE)]
PositiveOrZeroTorque = Annotated[float, Quantity(dimension=TORQUE, at_least=0.0)]
PositiveTorque = Annotated[float, Quantity(dimension=TORQUE, above=0.0)]
Inertia = Annotated[float, Quantity(dimension=INERTIA, at_least=0.0)]
AngularDamping = Annotated[float, Quantity(dimension=ANGULAR_DAMPING, above=0.0)]
Angle = Annotated[float, Quantity(dimension=ANGLE)]
Smoothing = Annotated[float, Quantity(dimension=ANGLE, above=0.0, at_most=0.02)]
Bend = Annotated[float, Quantity(dimension=ANGLE, at_least=0.0, at_most=0.1)]
Pressure = Annotated[float, Quantity(dimension=PRESSURE, at_least=0.0)]
TemperatureChange = Annotated[float, Quantity(dimension=TEMPERATURE)]
Expansion = Annotated[float, Quantity(dimension=EXPANSION, at_least=0.0, at_most=1e-3)]
PositiveStress = Annotated[float, Quantity(dimension=STRESS, above=0.0)]
Density = Annotated[float, Quantity(dimension=DENSITY, at_least=0.0)]
PositiveDensity = Annotated[float, Quantity(dimension=DENSITY, above=0.0)]
PositiveLinearMass = Annotated[float, Quantity(dimension=LINEAR_MASS, above=0.0)]
PositiveStiffness = Annotated[float, Quantity(dimension=STIFFNESS, above=0.0)]
PositiveStiffnessPerLength = Annotated[float, Quantity(dimension=STIFFNESS_PER_LENGTH, above=0.0)]
PositiveAxialStiffness = Annotated[float, Quantity(dimension=AXIAL_STIFFNESS, above=0.0)]
PositiveBendingStiffness = Annotated[float, Quantity(dimension=BENDING_STIFFNESS, above=0.0)]
Damping = Annotated[float, Quantity(dimension=DAMPING, at_least=0.0)]
# Plastic viscosities of mud are 5 to 100 mPa*s; honey has 10 Pa*s.
Viscosity = Annotated[
    float, Quantity(dimension=VISCOSITY, at_least=0.0, at_most=2.0, likely_units=(LikelyUnit(2, 2000, " mPa*s"),))
]
DampingPerLength = Annotated[float, Quantity(dimension=DAMPING_PER_LENGTH, at_least=0.0)]
# Three pumps deliver up to 0.1 m^3/s.
FLOW_UNITS: Final = (LikelyUnit(1, 100, " L/s"), LikelyUnit(100, 2000, " gpm"), LikelyUnit(300, 8000, " L/min"))
Flow = Annotated[float, Quantity(dimension=FLOW, at_least=0.0, at_most=1.0, likely_units=FLOW_UNITS)]
PositiveFlow = Annotated[float, Quantity(dimension=FLOW, above=0.0, at_most=1.0, likely_units=FLOW_UNITS)]
# Gels are below 50 Pa; a stiff cement has 30 Pa.
YieldStress = Annotated[float, Quantity(dimension=YIELD_STRESS, at_least=0.0, at_most=200.0)]
FlowIndex = Annotated[float, Number(noun="a flow index", at_least=0.1, at_most=1.0)]
NozzleDiameter = Annotated[
    float, Quantity(dimension=LENGTH, above=0.0, at_most=0.06,
                    likely_units=(LikelyUnit(4, 48, "/32 in"), LikelyUnit(4, 48, " mm")))
]  # fmt: skip
FlowArea = Annotated[
    float, Quantity(dimension=AREA, above=0.0, at_most=0.03, likely_units=(LikelyUnit(0.03, 10, " in^2"),))
]
DischargeCoefficient = Annotated[float, Number(noun="a discharge coefficient", at_least=0.5, at_most=1.2)]
RotationalDamping = Annotated[float, Quantity(dimension=ROTATIONAL_DAMPING, at_least=0.0)]


def typed(text: str, dimension: Dimension, key: str, bare: str = "") -> float:
    """A quantity of at least 0 as it is typed, "1750 m" or a bare "1750", in SI; InputError names the key.

    bare : unit of a bare number, by default that of SI.
    """
    try:
        value: object = float(text)
    except ValueError:
        value = text
    else:
        value = f"{text} {bare}" if bare else value
    try:
        return Quantity(dimension=dimension, at_least=0.0).parse(value)
    except InputError as error:
        raise InputError(error.expected, key=key, value=text) from None


def in_steps(first: float, last: float, step: float) -> list[float]:
    """Numbers from the first in steps to the last, which is always among them.

    Rounding errors neither double the last one nor give 1750.3000000000002.
    """
    count = math.ceil((last - first) / step - 1e-6)
    return [*(round(first + k * step, 6) for k in range(count)), round(last, 6)]
