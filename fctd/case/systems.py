"""The systems of units: one line a kind of quantity, with its units, their digits, and the units of a bare number.

In memory and in files quantities are SI; screen, pictures and reports show them in the units of a system.  A column of
an SI table has the unit of its kind at the end of its name, so that a new kind or unit is one line here.
"""

import re
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple, get_args

from fctd.case import units
from fctd.case.errors import InputError
from fctd.case.message import Message, Numbers
from fctd.case.units import Dimension

System = Literal["si", "field"]
SYSTEMS: Final[tuple[System, ...]] = get_args(System)
SIGNS: Final = {"*": "·", "^2": "²", "^3": "³", "hsqft": "(100 ft²)", "degF": "°F"}


def system_named(word: object) -> System:
    """The system of units that a word is of, in small letters or capitals; "metric" units are those of SI.

    Raises InputError for another.
    """
    plain = word.strip().lower() if isinstance(word, str) else word
    if plain in ("si", "metric"):
        return "si"
    if plain == "field":
        return "field"
    raise InputError('"si" or "metric" (m, kN, kN·m), or "field" (ft, klbf, kft·lbf)', value=word)


class Shown(NamedTuple):
    """How the screen and pictures show an SI value: it times ``factor``, in the unit ``label``."""

    factor: float
    label: str


@dataclass(frozen=True, eq=False)
class Kind:
    """A kind of quantity.

    dimension : with its SI unit, that of tables.  units : in which people read it, metric and of the field; digits :
    after the point in these.  bare : units of a bare number that a user types, by default the same; None where a number
    must have its unit.  also : other metric units of cases, which become that of the field too.
    """

    dimension: Dimension
    units: tuple[str, str]
    digits: tuple[int, int] = (3, 3)
    bare: tuple[str | None, str | None] | None = None
    also: tuple[str, ...] = ()

    def unit(self, system: System) -> str:
        """The unit in which a system shows it, as people type it: "kN*m"."""
        return self.units[SYSTEMS.index(system)]

    def bare_unit(self, system: System) -> str | None:
        """The unit of a bare number; None where a number must have its unit."""
        return (self.bare or self.units)[SYSTEMS.index(system)]

    def digits_in(self, system: System) -> int:
        """Digits after the point in the unit of a system."""
        return self.digits[SYSTEMS.index(system)]

    def si(self, system: System) -> float:
        """How many SI units one unit of a system is."""
        return self.dimension.factor(self.unit(system))

    def shown(self, system: System) -> Shown:
        """How a system shows an SI value."""
        return Shown(self.dimension.factor(self.unit(system), back=True), self.label(system))

    def label(self, system: System) -> str:
        """The unit in which a system shows it, as it is printed: "kN·m"."""
        return signed(self.unit(system))


def signed(unit: str) -> str:
    """A unit as it is printed: "kN·m", "kg/m³"."""
    for plain, sign in SIGNS.items():
        unit = unit.replace(plain, sign)
    return unit


def ending(unit: str) -> str:
    """The unit as the end of a column's name: "_N_m", "_m3_s"."""
    return "_" + unit.replace("*", "_").replace("/", "_").replace("^", "")


# Of kinds with one dimension the first is that of a column whose name says no more than the unit.
LENGTH: Final = Kind(units.LENGTH, ("m", "ft"), (1, 1), also=("km",))
ACROSS: Final = Kind(units.LENGTH, ("mm", "in"), (1, 3), bare=("m", "in"), also=("cm",))  # across the hole
AREA: Final = Kind(units.AREA, ("mm^2", "in^2"), (0, 3))
FORCE: Final = Kind(units.FORCE, ("kN", "klbf"), (1, 1), bare=(None, None), also=("t", "daN"))
SMALL_FORCE: Final = Kind(units.FORCE, ("N", "lbf"))
JOINT_FORCE: Final = Kind(units.FORCE, ("kN", "lbf"))  # on a joint of pipe
TORQUE: Final = Kind(units.TORQUE, ("kN*m", "kft*lbf"), (3, 3), bare=(None, None))
SMALL_TORQUE: Final = Kind(units.TORQUE, ("N*m", "ft*lbf"), also=("daN*m",))
BIT_TORQUE: Final = Kind(units.TORQUE, ("kN*m", "ft*lbf"))  # as a new case has it
FORCE_PER_LENGTH: Final = Kind(
    Dimension("a force per length", "N/m", "'1 kN/m'", ("N/m", "kN/m", "lbf/ft")), ("kN/m", "lbf/ft")
)
STIFFNESS: Final = Kind(units.STIFFNESS, ("N/m", "lbf/ft"))
STIFFNESS_PER_LENGTH: Final = Kind(units.STIFFNESS_PER_LENGTH, ("N/m/m", "lbf/ft/ft"))
STRESS: Final = Kind(units.STRESS, ("MPa", "ksi"), (1, 1), also=("GPa",))
PRESSURE: Final = Kind(units.PRESSURE, ("bar", "psi"), (1, 0), also=("Pa",))
STRENGTH: Final = Kind(units.PRESSURE, ("MPa", "psi"), (1, 0))  # pressures that a pipe of the catalogue bears
YIELD_STRESS: Final = Kind(units.YIELD_STRESS, ("Pa", "lbf/hsqft"))
VISCOSITY: Final = Kind(units.VISCOSITY, ("mPa*s", "cP"))
DENSITY: Final = Kind(units.DENSITY, ("kg/m^3", "ppg"), (0, 2), also=("sg", "g/cm^3"))
LINEAR_MASS: Final = Kind(units.LINEAR_MASS, ("kg/m", "lb/ft"), (1, 2))
FLOW: Final = Kind(units.FLOW, ("L/min", "gpm"), (0, 0), also=("L/s", "m^3/s"))
SPEED: Final = Kind(units.SPEED, ("m/s", "ft/min"), (3, 1))
ROP: Final = Kind(units.SPEED, ("m/h", "ft/h"), (1, 1))  # rate of penetration
JET: Final = Kind(units.SPEED, ("m/s", "ft/s"), (1, 1))
POWER: Final = Kind(Dimension("a power", "W", "'100 kW'", ("W", "kW", "hp")), ("kW", "hp"), (1, 1))
TIME: Final = Kind(units.TIME, ("s", "s"), (1, 1))
HOURS: Final = Kind(units.TIME, ("h", "h"))
ROTATION: Final = Kind(units.ROTATION, ("rev/min", "rev/min"), (1, 1))
ANGLE: Final = Kind(units.ANGLE, ("deg", "deg"), (1, 1))
TEMPERATURE: Final = Kind(units.TEMPERATURE, ("K", "degF"), (1, 1))
KINDS: Final = tuple(value for value in vars().copy().values() if isinstance(value, Kind))
SHOWN_APART: Final = tuple(kind for kind in KINDS if kind.units[0] != kind.units[1])  # in other units by each system
# Length of hole of a dog-leg [m], and the unit of one.
DOG_LEG: Final[dict[System, tuple[float, str]]] = {"si": (30.0, "°/30 m"), "field": (30.48, "°/100 ft")}


def kind_with(unit: str) -> Kind | None:
    """The kind of quantity that has a metric unit."""
    return next((kind for kind in KINDS if unit in (kind.units[0], *kind.also)), None)


_NUMBER: Final = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def told(text: object, system: System) -> str:
    """A sentence in a system of units; another text as it is."""
    if not isinstance(text, Message) or system == "si":
        return str(text)
    return "".join(part if isinstance(part, str) else _told(part, system) for part in text.parts)


def _told(numbers: Numbers, system: System) -> str:
    """Numbers of a sentence with their unit in a system of units."""
    (metric, plain), (course, dog_leg) = DOG_LEG["si"], DOG_LEG[system]
    if numbers.unit == plain:  # as large as before, so with as many digits
        return f"{numbers.values[0] * course / metric:.3g}{dog_leg}"
    unit, values = numbers.unit.replace("·", "*"), iter(numbers.values)
    if (kind := kind_with(unit)) is None:
        return str(numbers)
    factor = kind.dimension.factor(unit) * kind.shown(system).factor
    written = _NUMBER.sub(lambda number: _short(next(values) * factor, number[0]), numbers.written)
    return f"{written} {kind.label(system)}"


def _short(value: float, before: str) -> str:
    """A number with one digit more than it had before, three or four."""
    digits = len(before.split("e")[0].lstrip("-0.").replace(".", ""))
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.{min(max(digits + 1, 3), 4)}g}"
