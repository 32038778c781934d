"""Wells to start from: path, casing, string and loads of each, in round numbers.

Depths and lengths are in metres; in field units every metre is written as 3 ft, so that the numbers stay round.
Pipe is named and sized in inches in both systems, as it is sold.  That of the catalogue is written by its name.
"""

from collections.abc import Mapping
from itertools import accumulate, pairwise
from typing import Final, Literal, NamedTuple


class Part(NamedTuple):
    """A component: name, the keys of the case that say what pipe it is, length [m].

    keys : `pipe` alone where the catalogue has it, else diameters, and mass with joints.  Masses are in kg/m.
    length : None for the last one, which reaches the surface, and 0 for one as long as the hole below the shoe.
    """

    name: str
    keys: Mapping[str, str | float]
    length: float | None = None


class Hole(NamedTuple):
    """A section of hole: name, diameter [in], friction factor."""

    name: str
    diameter: str
    friction: float


class Template(NamedTuple):
    """A well: title; courses (length [m], inclination at the end [deg]); azimuth [deg]; depth of the shoe [m].

    weight_on_bit [kN], bit_torque [kN m] : 0 for a string that does not drill; flotation : whether its case shows how
    the string would be run with air below a flotation collar.
    """

    title: str
    courses: tuple[tuple[float, float], ...]
    azimuth: float
    shoe: float
    cased: Hole
    open: Hole
    string: tuple[Part, ...]
    mud: float = 1250.0
    block_weight: float = 250.0
    weight_on_bit: float = 0.0
    bit_torque: float = 0.0
    flotation: bool = False

    @property
    def stations(self) -> list[tuple[float, float, float]]:
        """Measured depth [m], inclination and azimuth [deg]: the ends of the courses, and every 150 m in bends."""
        ends = list(accumulate(self.courses, lambda at, course: (at[0] + course[0], course[1]), initial=(0.0, 0.0)))
        found = []
        for (md, inclination), (to_md, to) in pairwise(ends):
            count = 1 if inclination == to else max(round((to_md - md) / STATION), 1)
            steps = [k / count for k in range(count)]
            found += [(md + s * (to_md - md), inclination + s * (to - inclination), self.azimuth) for s in steps]
        return [*found, (*ends[-1], self.azimuth)]


STATION: Final = 150.0
TemplateName = Literal["build-hold", "horizontal", "s-well", "extended-reach", "casing-run"]

CASING_9_5_8, HOLE_8_1_2 = "9 5/8 in casing, 47 lb/ft", "8 1/2 in hole"
PIPE_5 = Part("5 in drill pipe, 19.5 lb/ft", {"pipe": "5 in 19.5 S-135 NC50"})
PIPE_5_1_2 = Part("5 1/2 in drill pipe, 21.9 lb/ft", {"pipe": "5 1/2 in 21.9 S-135 HT55 7 1/8 x 3 7/8"})
# The catalogue has no heavy-weight pipe: no page was found that prints its geometry.
HEAVY = Part(
    "5 in heavy-weight pipe, 49.3 lb/ft",
    {"outer_diameter": "5 in", "inner_diameter": "3 in", "contact_diameter": "6.5 in", "linear_mass": 73.4},
)
COLLARS = Part("6 3/4 in drill collars", {"pipe": "6 3/4 x 2 13/16 NC50 collar"})
CASING = Part("9 5/8 in casing, 47 lb/ft", {"pipe": "9 5/8 in 47 L-80 casing"})

TEMPLATES: Final[dict[TemplateName, Template]] = {
    "build-hold": Template(
        "a build-and-hold well",
        ((600, 0), (750, 45), (1650, 45)),
        45.0,
        1500.0,
        Hole(CASING_9_5_8, "8.681", 0.20),
        Hole(HOLE_8_1_2, "8.5", 0.30),
        (COLLARS._replace(length=120.0), HEAVY._replace(length=150.0), PIPE_5),
        weight_on_bit=80.0,
        bit_torque=4.0,
    ),
    "horizontal": Template(
        "a horizontal well",
        ((1500, 0), (900, 90), (1200, 90)),
        90.0,
        2400.0,
        Hole(CASING_9_5_8, "8.681", 0.20),
        Hole(HOLE_8_1_2, "8.5", 0.30),
        (
            COLLARS._replace(length=30.0),
            PIPE_5._replace(length=0.0),
            HEAVY._replace(length=750.0),
            PIPE_5,
        ),
        weight_on_bit=60.0,
        bit_torque=4.0,
    ),
    "s-well": Template(
        "an S-shaped well",
        ((600, 0), (600, 30), (900, 30), (600, 6), (900, 6)),
        30.0,
        1500.0,
        Hole(CASING_9_5_8, "8.681", 0.20),
        Hole(HOLE_8_1_2, "8.5", 0.30),
        (COLLARS._replace(length=150.0), HEAVY._replace(length=150.0), PIPE_5),
        weight_on_bit=80.0,
        bit_torque=4.0,
    ),
    "extended-reach": Template(
        "an extended-reach well",
        ((300, 0), (1200, 72), (5100, 72)),
        60.0,
        3600.0,
        Hole(CASING_9_5_8, "8.681", 0.20),
        Hole(HOLE_8_1_2, "8.5", 0.25),
        (COLLARS._replace(length=30.0), HEAVY._replace(length=90.0), PIPE_5_1_2),
        weight_on_bit=60.0,
        bit_torque=4.0,
    ),
    "casing-run": Template(
        "9 5/8 in casing run into a build-and-hold well",
        ((600, 0), (900, 45), (1200, 45)),
        45.0,
        900.0,
        Hole("13 3/8 in casing, 68 lb/ft", "12.415", 0.25),
        Hole("12 1/4 in hole", "12.25", 0.35),
        (CASING,),
        flotation=True,
    ),
}
