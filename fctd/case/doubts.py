"""Probable mistakes of a case: input that can be used and is probably not what the user meant, a function for each.

Every bound lies beyond what wells and rigs have, so that a warning is worth reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import Final, NamedTuple, Protocol

import numpy as np

from fctd.case.drilling import BitSpec, DriveSpec
from fctd.case.friction import FrictionSet
from fctd.case.input_warnings import InputWarning
from fctd.case.operations import KINDS, Operation
from fctd.case.specs import ComponentSpec, MudSpec, RigSpec, SolverSpec, StringSpec, WellboreSpec
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


class Range(NamedTuple):
    """Values that a key has in practice, as SI numbers and in words, and what others look like."""

    unit: str
    low: float
    high: float
    usual: str
    slips: tuple[Slip, ...]


DEEP: Final = 500.0  # [m]: a string this long hangs in mud, unless the case says that it does not
# Foam and the lightest oil to mud weighted with barite or galena.
SLIPS_OF_MUD: Final = (Slip(0.6, 2.6, " sg"), Slip(5, 22, " ppg"), Slip(37, 165, " lb/ft^3"))
MUD: Final = Range("kg/m^3", 600, 2600, "0.6 to 2.6 sg", SLIPS_OF_MUD)
# Composite, aluminium, titanium, steel; tungsten weights.
PIPE: Final = Range("kg/m^3", 1200, 20_000, "1.2 to 20 g/cm^3", (Slip(1.2, 20, " g/cm^3"),))
YOUNG: Final = Range("Pa", 10e9, 450e9, "10 to 450 GPa", (Slip(10, 450, " GPa"), Slip(10e3, 450e3, " MPa")))
YIELD: Final = Range("Pa", 50e6, 3e9, "50 to 3000 MPa", (Slip(50, 3000, " MPa"),))
# Below, a weight in kN or t or a torque in kN*m was written as a bare number; above, in a unit a thousand times too
# large.  Blocks weigh up to 100 t, bits carry up to 60 t and 60 kN*m.
BIT_LOAD: Final = Range("N", 1e3, 2e6, "1 to 2000 kN", (Slip(1, 999, " kN"), Slip(1, 99, " klbf")))
BIT_TORQUE: Final = Range("N*m", 20, 200e3, "0.02 to 200 kN·m", (Slip(0.5, 19.99, " kN*m"),))
WEAR: Final = Range("m", 1e-4, 0.05, "0.1 to 50 mm", (Slip(0.1, 50, " mm"),))
BLOCK: Final = Range("N", 1e3, 5e6, "1 to 5000 kN", (Slip(10, 999, " kN"), Slip(5, 250, " klbf")))
GUIDES: Final = Range("N", 100, 200e3, "0.1 to 200 kN", (Slip(0.1, 99, " kN"),))
OFFSET: Final = Range("N*m", 5, 50e3, "0.005 to 50 kN·m", (Slip(0.1, 4.99, " kN*m"),))
# A segment on its wall spring is damped critically by 1e5 N*s/m; mud of 2 Pa*s damps a metre of string by 1e3 N*s/m^2
# and its rotation by 1 N*s; 3 ms of the shape end all chatter.
AT_CONTACTS: Final = Range("N*s/m", 0, 1e7, "up to 10 MN*s/m", ())
IN_MUD: Final = Range("N*s/m^2", 0, 1e4, "up to 10 kN*s/m^2", ())
TURNING: Final = Range("N*s", 0, 10, "up to 10 N*s", ())
IN_JOINTS: Final = Range("s", 0, 0.1, "up to 100 ms", (Slip(0.1, 100, " ms"),))
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
        *mud_density(case.mud),
        *dampings(case.contact, case.mud, case.solver),
        *materials(case.string),
        *light_string(case.string, case.mud),
        *bit_size(case.string, case.wellbore, float(stations[-1, 0])),
        *bent_along_gauge(case.string, case.wellbore),
        *does_not_drift(case.string, case.wellbore, min(float(stations[-1, 0]), case.wellbore.intervals[-1].to_md)),
        *bare_lengths(case.bare_lengths),
        *bit_load(case, {*kinds, *(operation.kind for operation in case.operations)}),
        *rig_loads(case.rig),
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
    factors |= {
        f"wellbore.intervals[{i}].rotational_friction": interval.friction_around
        for i, interval in enumerate(hole.intervals)
        if interval.rotational_friction is not None
    }
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


def mud_density(mud: MudSpec) -> Doubts:
    """A density that no mud has."""
    yield from _outside("mud_density", "mud.density", mud.density, "a mud", MUD)


def dampings(contact: ContactSpec, mud: MudSpec, solver: SolverSpec) -> Doubts:
    """Dampings far above what walls, mud and joints have, or in a wrong unit."""
    yield from _outside("damping", "contact.damping", contact.damping, "a damping", AT_CONTACTS)
    yield from _outside("damping", "mud.axial_damping", mud.axial_damping or 0.0, "a damping", IN_MUD)
    yield from _outside("damping", "mud.lateral_damping", mud.lateral_damping or 0.0, "a damping", IN_MUD)
    yield from _outside("damping", "mud.rotational_damping", mud.rotational_damping or 0.0, "a damping", TURNING)
    yield from _outside("damping", "solver.joint_damping", solver.joint_damping, "a damping", IN_JOINTS)
    yield from _outside("damping", "solver.shape_damping", solver.shape_damping, "a damping", IN_JOINTS)


def materials(string: StringSpec) -> Doubts:
    """Properties that no pipe has."""
    for i, component in enumerate(string.components):
        key = f"string.components[{i}]"
        yield from _outside("pipe_density", f"{key}.density", component.density, "a pipe", PIPE)
        yield from _outside("youngs_modulus", f"{key}.youngs_modulus", component.youngs_modulus, "a modulus", YOUNG)
        yield from _outside("yield_strength", f"{key}.yield_strength", component.yield_strength, "a strength", YIELD)


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


def bit_load(case: Well, kinds: set[str]) -> Doubts:
    """Drilling without weight on bit, and bit loads in a wrong unit."""
    drilling = sorted(kind for kind in kinds if kind in KINDS and KINDS[kind].on_bottom)
    if drilling and case.bit.weight_on_bit == 0:
        yield InputWarning(
            "no_bit_load", "bit.weight_on_bit", f"{' and '.join(drilling)} without weight on bit",
            'give bit.weight_on_bit, such as "80 kN"',
        )  # fmt: skip
    yield from _outside("bit_load", "bit.weight_on_bit", case.bit.weight_on_bit, "a weight on bit", BIT_LOAD)
    yield from _outside("bit_load", "bit.torque", case.bit.torque, "a bit torque", BIT_TORQUE)
    if case.bit.rock is not None:
        yield from _outside("wear_flat", "bit.rock.wear_flat", case.bit.rock.wear_flat, "wear flats", WEAR)


def rig_loads(rig: RigSpec) -> Doubts:
    """Block weight, friction and torque offset in a wrong unit, sheaves that lose too much, a drive without a motor."""
    yield from _outside("rig_load", "rig.block_weight", rig.block_weight, "a block weight", BLOCK)
    yield from _outside("rig_load", "rig.guide_friction", rig.guide_friction, "friction of the guides", GUIDES)
    yield from _outside("rig_load", "rig.torque_offset", abs(rig.torque_offset), "a torque offset", OFFSET)
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


def _outside(code: str, key: str, value: float, what: str, usual: Range) -> Doubts:
    """A warning for a value other than 0 outside its usual range."""
    if value != 0 and not usual.low <= value <= usual.high:
        guess = looks_like(value, usual.slips)
        text = f"{what} of {value:g} {usual.unit}{guess}"
        yield InputWarning(code, key, text, f"write it with its unit; usual is {usual.usual}")


def _name(component: ComponentSpec) -> str:
    return f'"{component.name}"'


def _is_bit(component: ComponentSpec) -> bool:
    """Whether a component is named as a bit, and not as the sub above one."""
    name = component.name.lower()
    return re.search(r"\bbit\b", name) is not None and "sub" not in name
