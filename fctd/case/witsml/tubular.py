"""A string of WITSML: its components from the bit up, with what the file has of each."""

from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Final, NamedTuple

from fctd.case.errors import InputError, naming
from fctd.case.pipes.names import CASING, COLLAR, DRILL_PIPE, HEAVY, TUBING
from fctd.case.units import ANGLE, AREA, DEEPEST, DIAMETER_UNITS, LENGTH, LINEAR_MASS, STRESS, WIDEST, Quantity, Whole
from fctd.case.witsml.objects import TUBULAR, Item, read_object

MOST_COMPONENTS: Final = 1000
BIT: Final = "bit"
# Kinds of pipe by `typeTubularComp`; what else there is are tools.
_KINDS: Final = {
    "drill pipe": DRILL_PIPE, "drill pipe lh": DRILL_PIPE, "drill pipe compressive": DRILL_PIPE,
    "heavy weight drill pipe": HEAVY, "heavy weight drill pipe lh": HEAVY,
    "drill collar": COLLAR, "drill collar short": COLLAR, "non-magnetic collar": COLLAR,
    "casing": CASING, "liner": CASING, "tubing": TUBING,
}  # fmt: skip
_LENGTH: Final = Quantity(dimension=LENGTH, at_least=0.0, at_most=DEEPEST)
DIAMETER: Final = Quantity(dimension=LENGTH, at_least=0.0, at_most=WIDEST, likely_units=DIAMETER_UNITS)
_MASS: Final = Quantity(dimension=LINEAR_MASS, at_least=0.0, at_most=1e4)
_STRESS: Final = Quantity(dimension=STRESS, at_least=0.0, at_most=5e9)
_AREA: Final = Quantity(dimension=AREA, at_least=0.0, at_most=0.03)
_NOZZLE: Final = Quantity(dimension=LENGTH, at_least=0.0, at_most=0.06)
_BEND: Final = Quantity(dimension=ANGLE, at_least=0.0, at_most=0.1)
_COUNT: Final = Whole(noun="a whole number", at_least=0, at_most=1e6)


class Bend(NamedTuple):
    """A bend of a component: angle [rad], and distance from its lower end [m], None where it is not given."""

    angle: float
    distance: float | None


class Blades(NamedTuple):
    """Blades of a stabiliser: diameter, distance of their lower end from that of the component, and length [m]."""

    diameter: float
    bottom: float | None
    length: float | None


@dataclass(frozen=True)
class TubularPart:
    """A component as the file has it: None is not given, and 0 is kept.

    number : of the component in the file; type : `typeTubularComp`; kind : of pipe, ``BIT``, or None for a tool;
    outer, inner : of the body [m]; widest : ``odMx`` [m]; joint : largest diameter of its connections and of a hole
    opener [m]; gauge : of the bit [m]; mass [kg/m]; strength [Pa]; joint_length [m], joints_of_stand : average length
    of a joint, and number in a stand; nozzles [m], flow_area [m^2] : of the bit.
    """

    number: int
    type: str
    kind: str | None
    description: str
    length: float | None
    outer: float | None
    inner: float | None
    widest: float | None
    joint: float | None
    gauge: float | None
    mass: float | None
    strength: float | None
    grade: str
    service: str
    connections: frozenset[str]
    material: str
    joint_length: float | None
    joints_of_stand: float | None
    bends: tuple[Bend, ...]
    blades: tuple[Blades, ...]
    nozzles: tuple[float, ...]
    flow_area: float | None

    @property
    def touching(self) -> float | None:
        """The largest of all diameters but that of the body [m], None without any."""
        blades = (one.diameter for one in self.blades)
        return max((one for one in (self.widest, self.joint, self.gauge, *blades) if one), default=None)


@dataclass(frozen=True)
class Tubular:
    """A string: name, wellbore, type of assembly, and parts from the bit up; reversed : whether the file has the bit
    last, so that its order is that from the surface down."""

    name: str
    wellbore: str
    assembly: str
    parts: tuple[TubularPart, ...]
    reversed: bool


def read_tubular(path: Path, name: str | None = None) -> Tubular:
    """The string of a WITSML file, of this name or uid where it has several.

    Raises InputError, which names file, element, value and what was expected, for what cannot be read.
    """
    with naming(path):
        item = read_object(path, TUBULAR, name)
        parts = _in_order([_part(number, found) for number, found in enumerate(item.items(TUBULAR.part), start=1)])
        # A bit is at the lower end: numbers that begin at the other end count from the surface down.
        upside_down = parts[0].kind != BIT and parts[-1].kind == BIT
        parts = tuple(reversed(parts)) if upside_down else parts
        return Tubular(item.text("name"), item.text("nameWellbore"), item.text("typeTubularAssy"), parts, upside_down)


def _in_order(found: list[tuple[float | None, TubularPart]]) -> tuple[TubularPart, ...]:
    """The components in the order of `sequence`, in which they entered the hole; without one, in that of the file.

    Raises InputError for numbers that some components lack, or that two have.
    """
    if len(found) > MOST_COMPONENTS:
        raise InputError(f"at most {MOST_COMPONENTS} components of a tubular")
    seen: set[float] = set()
    for sequence, part in found:
        if sequence is None and any(other is not None for other, _ in found):
            raise InputError("a number, as others have it", key=f"{TUBULAR.part} {part.number}, sequence")
        if sequence is not None and sequence in seen:
            expected = "a number that no component before it has"
            raise InputError(expected, key=f"{TUBULAR.part} {part.number}, sequence", value=f"{sequence:g}")
        seen |= set() if sequence is None else {sequence}
    return tuple(part for _, part in sorted(found, key=lambda one: inf if one[0] is None else one[0]))


def _part(number: int, item: Item) -> tuple[float | None, TubularPart]:
    """The `sequence` of a component, and the component."""
    kind_of_file = item.text("typeTubularComp")
    word = kind_of_file.casefold()
    connections = list(item.items("connection"))
    joints = [one.quantity("od", DIAMETER) for one in connections]
    joints += [one.quantity("diaHoleOpener", DIAMETER) for one in item.items("holeOpener")]
    gauges = [one.quantity("diaBit", DIAMETER) for one in item.items("bitRecord")]
    nozzles = [one.quantity("diaNozzle", _NOZZLE) for one in item.items("nozzle")]
    bends = [
        Bend(angle, one.quantity("distBendBot", _LENGTH))
        for one in item.items("bend")
        if (angle := one.quantity("angle", _BEND))
    ]
    blades = [
        Blades(wide, one.quantity("distBladeBot", _LENGTH), one.quantity("lenBlade", _LENGTH))
        for one in item.items("stabilizer")
        if (wide := one.quantity("odBladeMx", DIAMETER))
    ]
    part = TubularPart(
        number=number, type=kind_of_file, kind=BIT if word.split(" ")[0] == BIT else _KINDS.get(word),
        description=item.text("description"), length=item.quantity("len", _LENGTH), outer=item.quantity("od", DIAMETER),
        inner=item.quantity("id", DIAMETER), widest=item.quantity("odMx", DIAMETER),
        joint=max((one for one in joints if one), default=None),
        gauge=max((one for one in gauges if one), default=None), mass=item.quantity("wtPerLen", _MASS),
        strength=item.quantity("tensYield", _STRESS), grade=item.text("grade"), service=item.text("classService"),
        connections=frozenset(text for one in connections if (text := one.text("typeThread"))),
        material=item.text("typeMaterial"), joint_length=item.quantity("lenJointAv", _LENGTH),
        joints_of_stand=item.number("numJointStand", _COUNT), bends=tuple(bends), blades=tuple(blades),
        nozzles=tuple(one for one in nozzles if one), flow_area=item.quantity("areaNozzleFlow", _AREA),
    )  # fmt: skip
    return item.number("sequence", _COUNT), part
