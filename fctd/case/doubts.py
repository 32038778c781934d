"""Probable mistakes of a case: input that can be used and is probably not what the user meant, a function for each.

Every bound lies beyond what wells and rigs have, so that a warning is worth reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import accumulate
from operator import attrgetter
from typing import Final, NamedTuple, Protocol

import numpy as np

from fctd.case.drilling import BitSpec, DriveSpec
from fctd.case.friction import FrictionSet
from fctd.case.hole import WellboreSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.operations import KINDS, Operation
from fctd.case.rig import MudSpec, RigSpec
from fctd.case.solver import SolverSpec
from fctd.case.string import ComponentSpec, StringSpec
from fctd.case.units import FASTEST, MOST_RPM, Slip, looks_like
from fctd.case.wall import ContactSpec

Doubts = Iterator[InputWarning]


class Well(Protocol):
    """What the checks read of a case."""

    @property
    def wellbore(self) -> WellboreSpec: ...
    @property
    def string(self) -> StringSpec: ...
    @property
    def mud(self) -> MudSpec: ...
    @property
    def contact(self) -> ContactSpec: ...
    @property
    def solver(self) -> SolverSpec: ...
    @property
    def rig(self) -> RigSpec: ...
    @property
    def bit(self) -> BitSpec: ...
    @property
    def operations(self) -> tuple[Operation, ...]: ...
    @property
    def bare_lengths(self) -> Sequence[str]: ...


class Usual(NamedTuple):
    """The values that a key has in practice, as SI numbers and in words, and what others look like.

    code, what : of the warning about another value.
    """

    code: str
    what: str
    unit: str
    low: float
    high: float
    words: str
    slips: tuple[Slip, ...] = ()


# Values other than 0.  A segment on its wall spring is damped critically by 1e5 N*s/m; mud of 2 Pa*s damps a metre of
# string by 1e3 N*s/m^2 and its rotation by 1 N*s; 3 ms of the shape end all chatter.
IN_MUD: Final = Usual("damping", "a damping", "N*s/m^2", 0, 1e4, "up to 10 kN*s/m^2")
IN_JOINTS: Final = Usual("damping", "a damping", "s", 0, 0.1, "up to 100 ms", (Slip(0.1, 100, " ms"),))
USUAL: Final = {
    # Foam and the lightest oil to mud weighted with barite or galena.
    "mud.density": Usual(
        "mud_density", "a mud", "kg/m^3", 600, 2600, "0.6 to 2.6 sg",
        (Slip(0.6, 2.6, " sg"), Slip(5, 22, " ppg"), Slip(37, 165, " lb/ft^3")),
    ),
    "contact.damping": Usual("damping", "a damping", "N*s/m", 0, 1e7, "up to 10 MN*s/m"),
    "mud.axial_damping": IN_MUD,
    "mud.lateral_damping": IN_MUD,
    "mud.rotational_damping": Usual("damping", "a damping", "N*s", 0, 10, "up to 10 N*s"),
    "solver.joint_damping": IN_JOINTS,
    "solver.shape_damping": IN_JOINTS,
    # Composite, aluminium, titanium, steel; tungsten weights.
    "string.components.density": Usual(
        "pipe_density", "a pipe", "kg/m^3", 1200, 20_000, "1.2 to 20 g/cm^3", (Slip(1.2, 20, " g/cm^3"),)
    ),
    "string.components.youngs_modulus": Usual(
        "youngs_modulus", "a modulus", "Pa", 10e9, 450e9, "10 to 450 GPa",
        (Slip(10, 450, " GPa"), Slip(10e3, 450e3, " MPa")),
    ),
    "string.components.yield_strength": Usual(
        "yield_strength", "a strength", "Pa", 50e6, 3e9, "50 to 3000 MPa", (Slip(50, 3000, " MPa"),)
    ),
    # Below, a weight in kN or t or a torque in kN*m was written as a bare number; above, in a unit a thousand times too
    # large.  Blocks weigh up to 100 t, bits carry up to 60 t and 60 kN*m.
    "bit.weight_on_bit": Usual(
        "bit_load", "a weight on bit", "N", 1e3, 2e6, "1 to 2000 kN", (Slip(1, 999, " kN"), Slip(1, 99, " klbf"))
    ),
    "bit.torque": Usual("bit_load", "a bit torque", "N*m", 20, 200e3, "0.02 to 200 kN·m", (Slip(0.5, 19.99, " kN*m"),)),
    "bit.rock.wear_flat": Usual("wear_flat", "wear flats", "m", 1e-4, 0.05, "0.1 to 50 mm", (Slip(0.1, 50, " mm"),)),
    "rig.block_weight": Usual(
        "rig_load", "a block weight", "N", 1e3, 5e6, "1 to 5000 kN", (Slip(10, 999, " kN"), Slip(5, 250, " klbf"))
    ),
    "rig.guide_friction": Usual(
        "rig_load", "friction of the guides", "N", 100, 200e3, "0.1 to 200 kN", (Slip(0.1, 99, " kN"),)
    ),
    "rig.torque_offset": Usual(
        "rig_load", "a torque offset", "N*m", 5, 50e3, "0.005 to 50 kN·m", (Slip(0.1, 4.99, " kN*m"),)
    ),
}  # fmt: skip
DEEP: Final = 500.0  # [m]: a string this long hangs in mud, unless the case says that it does not
ROUGH: Final = 0.6  # steel on rock without lubrication; casing has 0.15 to 0.3, open hole 0.2 to 0.5
NARROWEST, WIDEST = 0.05, 1.5  # [m]: coiled tubing in slim hole, conductor pipe
UNDERREAMED: Final = 1.5  # an under-reamer opens the hole below a shoe to some 1.3 times its diameter
LIGHT, HEAVY = 0.85, 2.5  # mass over that of the pipe body: spiral collars have 0.95, tool joints add up to 0.6
FASTEST_HOIST, FASTEST_DRILLING, FASTEST_ROTATION = 3.0, 0.1, 300.0  # [m/s], [m/s], [rev/min]
LEAST_EFFICIENCY: Final = 0.7  # of twelve lines over old sheaves
IN_GAUGE: Final = 0.9  # of the hole's diameter: a bit that drilled the hole, or runs in it
BELOW_TD: Final = 30.0  # [m]: the last station is some way above the bit
FOOT: Final = 0.3048


def warnings_of(
    case: Well,
    kinds: Sequence[str] = (),
    speed: float | None = None,
    rpm: float | None = None,
    frictions: Sequence[FrictionSet] = (),
    indicator: bool = False,
) -> tuple[InputWarning, ...]:
    """The probable mistakes of a case, and of what is asked for: kinds of operation, rates [m/s], [rev/min], friction.

    indicator : whether readings of the weight indicator are asked for, which include the block.  Reads the survey;
    raises InputError where it cannot be used.
    """
    stations = case.wellbore.trajectory
    return (
        *case.wellbore.survey_warnings,
        *shoe_below_td(case.wellbore, float(stations[-1, 0])),
        *hole_size(case.wellbore),
        *wider_below(case.wellbore),
        *rough_wall(case.wellbore, frictions),
        *no_mud(case.mud, float(stations[-1, 0])),
        *unusual(case),
        *light_string(case.string, case.mud),
        *bit_size(case.string, case.wellbore, float(stations[-1, 0])),
        *bent_along_gauge(case.string, case.wellbore),
        *does_not_drift(case.string, case.wellbore, min(float(stations[-1, 0]), case.wellbore.intervals[-1].to_md)),
        *bare_lengths(case.bare_lengths),
        *no_bit_load(case, {*kinds, *(operation.kind for operation in case.operations)}),
        *sheaves_and_drive(case.rig),
        *no_block(case.rig, indicator),
        *rates(case.operations, kinds, speed, rpm),
    )


def shoe_below_td(hole: WellboreSpec, td: float) -> Doubts:
    """A casing shoe or a change of hole size below the last station [m], or an end of the hole in feet."""
    last = len(hole.intervals) - 1
    feet = abs(hole.intervals[-1].to_md * FOOT / td - 1) < 0.02
    for i, interval in enumerate(hole.intervals):
        below = interval.to_md - td
        in_hole = below < 0 if i < last else below <= BELOW_TD or not (feet or interval.kind == "cased")
        if not in_hole:
            yield InputWarning(
                "shoe_below_td", f"wellbore.intervals[{i}].to_md",
                f"the interval ends at {interval.to_md:g} m, the survey at {td:g} m",
                f"write '{interval.to_md:g} ft' if these are feet" if feet else "check depth and unit of both",
            )  # fmt: skip


def hole_size(hole: WellboreSpec) -> Doubts:
    """A hole so wide or narrow that its diameter is probably in another unit."""
    inches = (Slip(WIDEST, 5, " in"),)
    for i, interval in enumerate(hole.intervals):
        if not NARROWEST <= interval.diameter <= WIDEST:
            yield InputWarning(
                "hole_size", f"wellbore.intervals[{i}].diameter",
                f"a hole of {interval.diameter:g} m" + looks_like(interval.diameter, inches),
                "write the diameter with its unit",
            )  # fmt: skip


def wider_below(hole: WellboreSpec) -> Doubts:
    """A hole that is far wider below a shoe than above it."""
    for i, (above, here) in enumerate(zip(hole.intervals[:-1], hole.intervals[1:], strict=True), start=1):
        if here.diameter > UNDERREAMED * above.diameter:
            yield InputWarning(
                "wider_below", f"wellbore.intervals[{i}].diameter",
                f"the hole widens downwards, from {1e3 * above.diameter:g} to {1e3 * here.diameter:g} mm",
                "list the intervals from the surface down",
            )  # fmt: skip


def rough_wall(hole: WellboreSpec, frictions: Sequence[FrictionSet]) -> Doubts:
    """A friction factor beyond that of dry rock: the largest of those asked for, or without them of the case."""
    factors = {f"wellbore.intervals[{i}].friction": interval.friction for i, interval in enumerate(hole.intervals)}
    if frictions:
        factors = {"friction": max(factor for one in frictions for factor in one.factors)}
    key = max(factors, key=lambda key: factors[key])
    if factors[key] > ROUGH:
        yield InputWarning(
            "friction", key,
            f"a friction factor of {factors[key]:g}, where casing has 0.15 to 0.3 and open hole 0.2 to 0.5",
            "check it; 30 % is written 0.3",
        )  # fmt: skip


def no_mud(mud: MudSpec, td: float) -> Doubts:
    """A deep hole without mud, where the case does not say so."""
    if td > DEEP and mud.density == 0 and "density" not in mud.model_fields_set:
        yield InputWarning(
            "no_mud", "mud.density", f"there is no mud, so the string hangs in air in a hole of {td:g} m",
            'give a density such as "1200 kg/m^3", or 0 for air',
        )  # fmt: skip


def unusual(case: Well) -> Doubts:
    """Values outside the range that is usual, most of them in a wrong unit."""
    for key, usual in USUAL.items():
        table, name = key.rsplit(".", 1)
        holders = [(table, attrgetter(table)(case))]
        if table == "string.components":
            holders = [(f"{table}[{i}]", part) for i, part in enumerate(case.string.components)]
        for place, holder in holders:
            value = abs(getattr(holder, name, None) or 0.0)  # there may be no rock, and no damping
            if value != 0 and not usual.low <= value <= usual.high:
                text = f"{usual.what} of {value:g} {usual.unit}{looks_like(value, usual.slips)}"
                remedy = f"write it with its unit; usual is {usual.words}"
                yield InputWarning(usual.code, f"{place}.{name}", text, remedy)


def light_string(string: StringSpec, mud: MudSpec) -> Doubts:
    """A linear mass that floats in the mud, or that does not go with the pipe's body."""
    for i, part in enumerate(string.components):
        area = 0.25 * np.pi * (part.outer_diameter**2 - part.inner_diameter**2)
        key, mass = f"string.components[{i}].linear_mass", part.linear_mass
        if mass is None:
            continue
        body, displaced = float(part.density * area), float(mud.density * area)
        if mass < displaced:
            text = f"{_name(part)} weighs {mass:.4g} kg/m, less than the mud in its place, {displaced:.4g} kg/m"
            yield InputWarning("floating_string", key, text, _REMEDY_OF_MASS)
        elif not LIGHT * body <= mass <= HEAVY * body:
            text = f"{_name(part)} weighs {mass:.4g} kg/m, its body alone {body:.4g} kg/m"
            yield InputWarning("linear_mass", key, text, _REMEDY_OF_MASS)


_REMEDY_OF_MASS: Final = "write linear_mass with its unit, such as '19.5 lb/ft', and check diameters and density"


def bit_size(string: StringSpec, hole: WellboreSpec, td: float) -> Doubts:
    """A bit that is smaller than the string above it, or that is not the first component.

    A bit that fits the hole at the end of the well [m] is below pipe of any size that stays in the wider hole above.
    """
    first, *others = string.components
    bits = [_is_bit(part) for part in string.components]
    compared = list(string.components)
    if first.contact_diameter >= IN_GAUGE * hole.intervals[-1].diameter:
        above = hole.intervals[-2].to_md if len(hole.intervals) > 1 else 0.0
        below = accumulate((part.length or np.inf for part in string.components), initial=0.0)
        compared = [part for part, length in zip(compared, below, strict=False) if td - length > above or part is first]
    widest = max(compared, key=lambda part: part.contact_diameter)
    if bits[0] and widest.contact_diameter > first.contact_diameter:
        yield InputWarning(
            "bit_size", "string.components[0].outer_diameter",
            f"{_name(first)} has {1e3 * first.contact_diameter:.6g} mm, {_name(widest)} above it "
            f"{1e3 * widest.contact_diameter:.6g} mm",
            "check both diameters",
        )  # fmt: skip
    elif others and any(bits) and not bits[0]:
        yield InputWarning(
            "bit_not_first", f"string.components[{bits.index(True)}]",
            f"{_name(string.components[bits.index(True)])} is above {_name(first)}",
            "list the components from the bit up",
        )  # fmt: skip


def bent_along_gauge(string: StringSpec, hole: WellboreSpec) -> Doubts:
    """A bent component whose stabiliser is given as if it were as long as the component.

    The end of a straight tool of length L, tilted by β against the string above, lies βL aside.  Where its hole leaves
    less, and its body does not touch, the wall has to bend the tool straight.
    """
    wide = hole.intervals[-1].diameter
    for i, part in enumerate(string.components):
        gauge = part.contact_diameter > part.outer_diameter or part.contact_diameter >= IN_GAUGE * wide
        if part.contact != "sleeve" or part.length is None or not gauge:
            continue
        aside, room = part.bend * part.length, max(wide - part.contact_diameter, 0.0)
        if aside > room:
            yield InputWarning(
                "bent_along_gauge", f"string.components[{i}].contact_diameter",
                f"{_name(part)} touches along all of its {part.length:.4g} m, is bent by "
                f"{1e3 * aside:.3g} mm over this length, and has {1e3 * room:.3g} mm of room in the hole",
                "give its stabiliser sleeve, the part up to the bend and the body above it as components of their own",
            )  # fmt: skip


def does_not_drift(string: StringSpec, hole: WellboreSpec, deepest: float) -> Doubts:
    """A component that, with the bit at its greatest depth [m], is below a narrower part of the hole than it is."""
    below = accumulate((part.length or np.inf for part in string.components), initial=0.0)
    for i, (part, length) in enumerate(zip(string.components, below, strict=False)):
        passed = [interval for interval in hole.intervals if interval.to_md < deepest - length]
        tight = min(passed, key=lambda interval: interval.diameter, default=None)
        if tight is not None and part.contact_diameter > tight.diameter * (1 + 1e-9):
            key = "contact_diameter" if "contact_diameter" in part.model_fields_set else "outer_diameter"
            yield InputWarning(
                "does_not_drift", f"string.components[{i}].{key}",
                f"{_name(part)} has {1e3 * part.contact_diameter:.6g} mm and cannot have passed the hole of "
                f"{1e3 * tight.diameter:.6g} mm above {tight.to_md:g} m",
                "check both diameters; of a tool that opens below a shoe only the rows below are meant",
            )  # fmt: skip


def bare_lengths(keys: Sequence[str]) -> Doubts:
    """Lengths without a unit in a case whose other lengths are in feet and inches."""
    if keys:
        more = f", as {', '.join(keys[1:3])}{' and others' if len(keys) > 3 else ''}" if len(keys) > 1 else ""
        yield InputWarning(
            "bare_length", keys[0], f"a bare number is in metres{more}, the other lengths are in feet and inches",
            "write the length with its unit",
        )  # fmt: skip


def no_block(rig: RigSpec, indicator: bool) -> Doubts:
    """Readings of the weight indicator without a block, where the case does not say so."""
    if indicator and rig.block_weight == 0 and "block_weight" not in rig.model_fields_set:
        yield InputWarning(
            "no_block_weight", "rig.block_weight", "the weight indicator is asked for, and the block weighs nothing",
            "give the weight of block, hook and top drive, or 0 where the readings are without it",
        )  # fmt: skip


def no_bit_load(case: Well, kinds: set[str]) -> Doubts:
    """Drilling without weight on bit."""
    drilling = sorted(kind for kind in kinds if kind in KINDS and KINDS[kind].on_bottom)
    if drilling and case.bit.weight_on_bit == 0:
        yield InputWarning(
            "no_bit_load", "bit.weight_on_bit", f"{' and '.join(drilling)} without weight on bit",
            'give bit.weight_on_bit, such as "80 kN"',
        )  # fmt: skip


def sheaves_and_drive(rig: RigSpec) -> Doubts:
    """Sheaves that lose too much, a stiff drive with the settings of a motor."""
    if rig.sheave_efficiency < LEAST_EFFICIENCY:
        yield InputWarning(
            "sheave_efficiency", "rig.sheave_efficiency", f"an efficiency of {rig.sheave_efficiency:g}",
            "give that of all sheaves together, which is 0.8 to 1",
        )  # fmt: skip
    if rig.drive == "stiff" and rig.control != DriveSpec():  # a stored case has all keys, with their defaults
        yield InputWarning(
            "unused_control", "rig.control", "the settings of a motor, beside a stiff drive, which has none",
            'give rig.drive = "speed_control" or "impedance"',
        )  # fmt: skip


def rates(operations: Sequence[Operation], kinds: Sequence[str], speed: float | None, rpm: float | None) -> Doubts:
    """Speeds and rotations that no rig has, of the case's operations, and of the kinds and rates asked for."""
    for i, operation in enumerate(operations):
        yield from _rates(f"operations[{i}].", operation.kind, operation.speed, operation.rpm)
    moving = [kind for kind in kinds if kind in KINDS and KINDS[kind].direction]
    if moving and speed is not None:
        slowest = min(moving, key=lambda kind: not KINDS[kind].on_bottom)
        yield from _rates("", slowest, speed, 0.0)
    if rpm is not None:
        yield from _rates("", "rotate_off_bottom", 0.0, rpm)


def _rates(where: str, kind: str, speed: float, rpm: float) -> Doubts:
    fastest = FASTEST_DRILLING if KINDS[kind].on_bottom else FASTEST_HOIST
    if fastest < speed <= FASTEST:  # the case refuses a higher one
        doing = "drilling" if KINDS[kind].on_bottom else "moving the string"
        text = f"{doing} at {speed:g} m/s, which is {3600 * speed:.0f} m/h"
        yield InputWarning("speed", f"{where}speed", text, "write the speed with its unit, such as '20 m/h'")
    if FASTEST_ROTATION < rpm <= MOST_RPM:
        text = f"{rpm:g} rev/min, where top drives turn at up to {FASTEST_ROTATION:g}"
        yield InputWarning("rotation", f"{where}rpm", text, "check the rotation of the string")


def _name(component: ComponentSpec) -> str:
    return f'"{component.name}"'


def _is_bit(component: ComponentSpec) -> bool:
    """Whether a component is named as a bit, and not as the sub above one."""
    name = component.name.lower()
    return re.search(r"\bbit\b", name) is not None and "sub" not in name
