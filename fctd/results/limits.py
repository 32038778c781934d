"""Limits of a string: of each, which share of it a place of the string uses, what its note says, and what helps.

A limit is one entry of ``LIMITS``.  Load and capacity are plain arithmetic of the loads in a place and of the section
there, compiled into one walk along the string (``find_shares``), which steady strings and the records of runs take.
Notes (notes.py), their headlines in charts, margins (steady/margins.py) and the probabilities of a sweep go through the
same table.
"""

import math
from collections.abc import Callable
from typing import Any, Final, Literal, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.limits import LimitsSpec
from fctd.case.message import quantity
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.model import capacity
from fctd.model.capacity import PSI
from fctd.model.drillstring import String
from fctd.model.section import Section
from fctd.results.hanging_body import ASSUMED, MOMENT, TAKEN, USUAL, beside
from fctd.results.profile import von_mises, von_mises_pressed

# The wall of the model is a spring.  Steel and rock yield by a millimetre or two; a contact point that is deeper in
# the wall than a quarter of the clearance changes the string's shape and its buckling limits (∝ 1/√clearance) by a
# tenth.  10 mm are 100 kN on one point of the default wall, ten times the force that wears casing; below 2 mm the share
# of a stabiliser's small clearance is no criterion.
SHARE_OF_CLEARANCE, LEAST_PENETRATION, MOST_PENETRATION = 0.25, 0.002, 0.010

# Pressures inside and outside that differ by less are the same [Pa]: at the table columns of two fluids differ by the
# rounding of a depth of 0.
SAME_PRESSURE: Final = 1.0


class Place(NamedTuple):
    """What the limits look at in one place, the top of a string or a contact point.

    tension (effective) [N], torque, bending [N m]; penetration of the wall and clearance [m], 0 at the top; hookload
    [N], 0 below the top; taken : by the body between tool joints, of its way to the wall; assumed [N m] : the bending
    with joints of usual length, 0 where their length is given (``hanging_body``); excess [Pa] : of the pressure inside
    over that outside.
    """

    tension: float
    torque: float
    bending: float
    penetration: float
    clearance: float
    hookload: float
    taken: float
    assumed: float
    excess: float


class Limit(NamedTuple):
    """A limit: a load of a place of the string, and what the place bears of it.

    code, headline, remedy : of its note.  load, capacity : of a place and its section, SI; compiled; a place uses the
    share load/capacity, above 1 beyond the limit.  unit : of both, empty for a ratio.  text : the note's sentence, by
    the share, the place, its section and where it is.  asked : the key of ``LimitsSpec`` that sets how much of the
    capacity may be used.  of_steel : whether the string fails there, so that it counts among its margins.
    """

    code: str
    headline: str
    remedy: str
    unit: str
    load: Callable[[Any, Any], Any]
    capacity: Callable[[Any, Any], Any]
    text: Callable[[float, Place, Section, str], str]
    asked: Literal["", "design_factor", "torque_share"] = ""
    of_steel: bool = False

    def scale(self, limits: LimitsSpec) -> float:
        """By how many times the share counts more, for how near to the limit the string may be loaded; at least 1."""
        if self.asked == "design_factor":
            return limits.design_factor
        return 1 / limits.torque_share if self.asked == "torque_share" else 1.0


unpressed, pressed, of_steel = inlined(von_mises), inlined(von_mises_pressed), inlined(capacity.collapse_of)


@inlined
def stress_of(at, bending, section):
    """Von Mises stress in a place with a bending moment there [Pa]."""
    if at.excess == 0:
        return unpressed(at.tension, at.torque, bending, section.worn_outer, section.inner)
    return pressed(at.tension, at.torque, bending, section.worn_outer, section.inner, at.excess)


# Share of the collapse pressure that is left at the yield strength, in place of none.
LEAST_LEFT: Final = 1e-9


@inlined
def collapse_of(at, section):
    """Pressure beyond that inside which the pipe bears from outside under its tension [Pa].

    The stress along it counts from the pressure inside: (T + (p_i - p_o) A_o)/A_s with the effective tension T.  An
    ellipse says what it leaves: of casing's yield strength, with which the regimes of TR 5C3 have another collapse
    pressure (2008, formula 42), and of the collapse pressure of other pipe, as RP 7G has it.
    """
    if at.excess >= 0:
        return section.collapse
    outer = section.worn_outer * section.worn_outer
    steel = math.pi * (outer - section.inner * section.inner)
    share = (at.tension + math.pi * outer * at.excess) / steel / section.yield_strength
    share = min(max(share, 0.0), 1.0)
    left = max(math.sqrt(1 - 0.75 * share * share) - 0.5 * share, LEAST_LEFT)
    if section.yields_earlier == 0:
        return section.collapse * left
    ratio = 2 * section.worn_outer / (section.worn_outer - section.inner)
    return PSI * of_steel(left * section.yield_strength / PSI, ratio)


LIMITS: Final[tuple[Limit, ...]] = (
    Limit(
        "penetration", "the string is pressed deep into the wall",
        "check friction factor, bends, a bent motor's room, and the wall's stiffness", "m",
        # Bow springs give way as far as they do.
        lambda at, section: at.penetration if section.bow_stiffness == 0 else 0.0,
        lambda at, section: min(max(SHARE_OF_CLEARANCE * at.clearance, LEAST_PENETRATION), MOST_PENETRATION),
        lambda share, at, section, where: (
            f"a contact point at {where} is {quantity(1e3 * at.penetration, 'mm', '.3g')} deep in the wall, "
            f"where the clearance is {quantity(1e3 * at.clearance, 'mm', '.3g')}"
        ),
    ),
    Limit(
        "yield", "the steel is stressed beyond its yield strength", "check friction factor, bends and yield_strength",
        "Pa",
        lambda at, section: stress_of(at, at.bending, section),
        lambda at, section: section.yield_strength,
        lambda share, at, section, where: (
            f"the stress at {where} is {quantity(share * section.yield_strength / 1e6, 'MPa', '.0f')}, "
            f"the yield strength {quantity(section.yield_strength / 1e6, 'MPa', '.0f')}"
        ),
        "design_factor", of_steel=True,
    ),
    Limit(
        "tool_joints", "tool joints may bend the steel beyond its yield strength, and their distance is not given",
        "give the component its joint, or a pipe of the catalogue", "Pa",
        lambda at, section: (
            stress_of(at, at.assumed, section)
            if at.assumed > at.bending
            else 0.0
        ),
        lambda at, section: section.yield_strength,
        lambda share, at, section, where: (
            f"with tool joints {quantity(USUAL, 'm')} apart the pipe at {where} bends by "
            f"{quantity(at.assumed / 1e3, 'kN·m', '.3g')} at its tool "
            f"joints, in place of {quantity(at.bending / 1e3, 'kN·m', '.3g')}, and is stressed by "
            f"{quantity(share * section.yield_strength / 1e6, 'MPa', '.0f')}, the yield strength is "
            f"{quantity(section.yield_strength / 1e6, 'MPa', '.0f')}"
        ),
        "design_factor",
    ),
    Limit(
        "body", "the pipe's body touches the wall between its tool joints, or buckles there",
        "give the component joint_segments, with which the bending and the wall force of its body are computed", "",
        lambda at, section: at.taken,
        lambda at, section: 1.0,
        lambda share, at, section, where: (
            f"the body between tool joints at {where} " + (
                "is compressed beyond its buckling load, which the closed form of its bending leaves out"
                if math.isinf(share)
                else f"touches the wall: free, it would come {share:.2f} times as far; "
                "its bending is that of a body on the wall"
            )
        ),
    ),
    Limit(
        "make_up", "the torque exceeds the make-up torque of the tool joints, which turn on",
        "check friction factor and bit torque, or use pipe with stronger tool joints", "N m",
        lambda at, section: abs(at.torque),
        lambda at, section: section.make_up,
        lambda share, at, section, where: (
            f"the torque at {where} is {quantity(abs(at.torque) / 1e3, 'kN·m', '.1f')}, the largest make-up torque "
            "of the tool joints "
            f"{quantity(section.make_up / 1e3, 'kN·m', '.1f')}"
        ),
        "torque_share", of_steel=True,
    ),
    Limit(
        "tensile_capacity", "the hook load exceeds the capacity of the uppermost pipe",
        "check friction factor, bends and yield_strength", "N",
        # Where pressures differ, the stress says how much of the strength is used.
        lambda at, section: at.hookload if abs(at.excess) < SAME_PRESSURE else 0.0,
        lambda at, section: section.yield_strength * np.pi * (section.worn_outer**2 - section.inner**2),
        lambda share, at, section, where: (
            f"the hook load is {quantity(at.hookload / 1e3, 'kN', '.0f')}, the uppermost pipe yields at "
            f"{quantity(at.hookload / share / 1e3, 'kN', '.0f')}"
        ),
        "design_factor", of_steel=True,
    ),
    Limit(
        "burst", "the pressure inside bursts the pipe", "lower mud.inside_pressure, or use stronger pipe", "Pa",
        lambda at, section: at.excess,
        lambda at, section: section.burst,
        lambda share, at, section, where: (
            f"the pressure inside at {where} is {quantity(at.excess / 1e5, 'bar', '.0f')} above that outside, the "
            "pipe bears "
            f"{quantity(section.burst / 1e5, 'bar', '.0f')}"
        ),
        "design_factor", of_steel=True,
    ),
    Limit(
        "collapse", "the pressure outside collapses the pipe", "fill the pipe, or use stronger pipe", "Pa",
        lambda at, section: -at.excess,
        lambda at, section: collapse_of(at, section),
        lambda share, at, section, where: (
            f"the pressure outside at {where} is {quantity(-at.excess / 1e5, 'bar', '.0f')} above that inside, the "
            "pipe bears "
            f"{quantity(-at.excess / share / 1e5, 'bar', '.0f')} under its tension"
        ),
        "design_factor", of_steel=True,
    ),
)  # fmt: skip
# A place farther down counts where its share is larger by more than rounding: a torque is the same along vertical hole.
FARTHER: Final = 1 + 1e-9
# Columns of the largest shares (len(LIMITS), WORST): the share, the row of its place, 0 for the top, and the place.  A
# row and a half is the upper end of the segment below the contact point of that row.
SHARE, ROW, PLACE = 0, 1, 2
UPPER: Final = 0.5
WORST = PLACE + len(Place._fields)


@kernel
def _keep(worst, k, share, row, at):
    """Write the largest share of limit k so far, and its place."""
    worst[k, SHARE], worst[k, ROW] = share, row
    for i in range(len(at)):
        worst[k, PLACE + i] = at[i]


def _comparison(first: int, end: int) -> Any:
    """A function that updates the largest shares of limits from ``first`` to ``end`` by those of a place.

    It is compiled into its caller, in halves: one limit after the other would be compiled as often as there are limits
    behind it.
    """
    if end - first > 1:
        middle = (first + end) // 2
        upper, lower = _comparison(first, middle), _comparison(middle, end)

        @inlined
        def compare_both(at, section, row, worst):
            upper(at, section, row, worst)
            lower(at, section, row, worst)

        return compare_both
    load_of, capacity_of = inlined(LIMITS[first].load), inlined(LIMITS[first].capacity)

    @inlined
    def compare_one(at, section, row, worst):
        load, capacity = load_of(at, section), capacity_of(at, section)
        # Multiplied, since most places are not the worst, and a division takes longer.
        if load > worst[first, SHARE] * FARTHER * capacity:
            _keep(worst, first, load / capacity, row, at)

    return compare_one


compare = _comparison(0, len(LIMITS))


@inlined
def _section(table, k):
    """Row k of a table of sections as a ``Section``, of which only what the limits use is read."""
    return Section(
        table[k, 0], table[k, 1], table[k, 2], table[k, 3], table[k, 4], table[k, 5], table[k, 6], table[k, 7],
        table[k, 8], table[k, 9], table[k, 10], table[k, 11], table[k, 12], table[k, 13], table[k, 14], table[k, 15],
        table[k, 16], table[k, 17], table[k, 18], table[k, 19], table[k, 20], table[k, 21], table[k, 22], table[k, 23],
        table[k, 24], table[k, 25], table[k, 26], table[k, 27], table[k, 28], table[k, 29], table[k, 30], table[k, 31],
        table[k, 32], table[k, 33],
    )  # fmt: skip


@entry
def find_shares(
    tension, torque, hanging, bit_tension, bit_torque, hookload, offset, hole, radius, in_hole, middle, component,
    sections, excess, worst,
):  # fmt: skip
    """Fill ``worst`` (limits, WORST) with the largest share of each limit along a string, 0 where it has none.

    Returns whether one is above 1: most strings have no notes.
    tension, torque (n,), bit_tension, bit_torque : of ``Loads``; hanging (n + 1, ...) : of ``find_hanging``; hookload
    [N]; offset (n, 3), hole (n,) : of the walls, radius (n,) : of the string at the contact points [m]; in_hole :
    whether there is a wall; middle, component (n,), sections : of the string; excess (n + 1,) : of the pressure inside
    over that outside [Pa].
    """
    worst[:] = 0.0
    top = Place(
        tension[0], torque[0], hanging[0, MOMENT], 0.0, 0.0, hookload, hanging[0, TAKEN], hanging[0, ASSUMED],
        excess[0],
    )  # fmt: skip
    compare(top, _section(sections, component[0]), 0.0, worst)  # one type of row, or all is compiled anew
    for j in range(len(hole)):
        if j and component[j] != component[j - 1]:  # the upper end of a weaker part bears most
            # What bends it there is the moment of the contact point above, as the part above has it.
            upper = Place(tension[j], torque[j], hanging[j, MOMENT], 0.0, 0.0, 0.0, 0.0, 0.0, excess[j])
            compare(upper, _section(sections, component[j]), j + UPPER, worst)
        clearance = hole[j] - radius[j]
        distance = math.sqrt(offset[j, 0] ** 2 + offset[j, 1] ** 2 + offset[j, 2] ** 2)
        here = Place(
            beside(tension, bit_tension, middle, j), beside(torque, bit_torque, middle, j), hanging[j + 1, MOMENT],
            distance - clearance if in_hole else 0.0, clearance, 0.0, hanging[j + 1, TAKEN], hanging[j + 1, ASSUMED],
            excess[j + 1],
        )  # fmt: skip
        compare(here, _section(sections, component[j]), j + 1.0, worst)
    beyond = False
    for share in worst[:, SHARE]:  # numba's own ``any`` imports SciPy's linear algebra
        beyond |= share > 1
    return beyond


def place_of(row: float, md: Array, string: String) -> tuple[float, int]:
    """Measured depth [m] and the number of the section of a row of the largest shares; md (n,) : of contact points."""
    k = int(row)
    return float(md[k - 1]) if k else string.top_md, int(string.component[k if row % 1 else max(k - 1, 0)])
