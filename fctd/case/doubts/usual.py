"""What the checks read of a case, the values that its keys usually have, and warnings of others."""

import math
from collections.abc import Iterator, Sequence
from operator import attrgetter
from typing import Final, NamedTuple, Protocol

from fctd.case.drilling import BitSpec
from fctd.case.hole import WellboreSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity, span
from fctd.case.operations import Operation
from fctd.case.rig import MudSpec, RigSpec
from fctd.case.solver import SolverSpec
from fctd.case.string import StringSpec
from fctd.case.units import LikelyUnit, unit_hint
from fctd.case.wall import ContactSpec

Doubts = Iterator[InputWarning]


class Well(Protocol):
    """What the checks read of a case."""

    wellbore: WellboreSpec
    string: StringSpec
    mud: MudSpec
    contact: ContactSpec
    solver: SolverSpec
    rig: RigSpec
    bit: BitSpec

    @property
    def operations(self) -> tuple[Operation, ...]: ...
    @property
    def bare_lengths(self) -> Sequence[str]: ...
    @property
    def depths(self) -> tuple[float, float]: ...
    def text_of(self, key: str) -> str | None: ...


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
    likely_units: tuple[LikelyUnit, ...] = ()


# Values other than 0.  A segment on its wall spring is damped critically by 1e5 N*s/m; mud of 2 Pa*s damps a metre of
# string by 1e3 N*s/m^2 and its rotation by 1 N*s; 3 ms of the shape end all chatter.
IN_MUD: Final = Usual("damping", "a damping", "N*s/m^2", 0, 1e4, "up to 10 kN*s/m^2")
IN_JOINTS: Final = Usual("damping", "a damping", "s", 0, 0.1, "up to 100 ms", (LikelyUnit(0.1, 100, " ms"),))
# Foam and the lightest oil to mud weighted with barite or galena.
MUD: Final = Usual(
    "mud_density", "a mud", "kg/m^3", 600, 2600, span(600, 2600, "kg/m^3"),
    (LikelyUnit(0.6, 2.6, " sg"), LikelyUnit(5, 22, " ppg"), LikelyUnit(37, 165, " lb/ft^3")),
)  # fmt: skip
WINDOW: Final = Usual(
    "window",
    "a density of the window",
    "kg/m^3",
    500,
    3000,
    span(500, 3000, "kg/m^3"),
    (LikelyUnit(0.5, 3, " sg"), LikelyUnit(5, 25, " ppg")),
)
A_TURN: Final = Usual("angle", "an angle", "rad", 0, 2 * math.pi, "up to a turn", (LikelyUnit(6.28, 360, " deg"),))
USUAL: Final = {
    "string.components.toolface": A_TURN,
    "wellbore.caliper.first_arm": A_TURN,
    "mud.density": MUD,
    **{f"mud.{side}.density": MUD for side in ("inside", "outside")},
    "contact.damping": Usual("damping", "a damping", "N*s/m", 0, 1e7, "up to 10 MN*s/m"),
    "mud.axial_damping": IN_MUD,
    "mud.lateral_damping": IN_MUD,
    "mud.rotational_damping": Usual("damping", "a damping", "N*s", 0, 10, "up to 10 N*s"),
    "solver.joint_damping": IN_JOINTS,
    "solver.shape_damping": IN_JOINTS,
    # Composite, aluminium, titanium, steel; tungsten weights.
    "string.components.density": Usual(
        "pipe_density", "a pipe", "kg/m^3", 1200, 20_000, span(1.2, 20, "g/cm^3"),
        (LikelyUnit(1.2, 20, " g/cm^3"),)
    ),
    "string.components.youngs_modulus": Usual(
        "youngs_modulus", "a modulus", "Pa", 10e9, 450e9, span(10, 450, "GPa"),
        (LikelyUnit(10, 450, " GPa"), LikelyUnit(10e3, 450e3, " MPa")),
    ),
    "string.components.yield_strength": Usual(
        "yield_strength", "a strength", "Pa", 50e6, 3e9, span(50, 3000, "MPa"),
        (LikelyUnit(30, 250, " ksi"), LikelyUnit(250, 3000, " MPa")),
    ),
    # Below, a weight in kN or t or a torque in kN*m was written as a bare number; above, in a unit a thousand times too
    # large.  Blocks weigh up to 100 t, bits carry up to 60 t and 60 kN*m.
    "bit.weight_on_bit": Usual(
        "bit_load", "a weight on bit", "N", 1e3, 2e6, span(1, 2000, "kN"),
        (LikelyUnit(1, 999, " kN"), LikelyUnit(1, 99, " klbf")),
    ),
    "bit.torque": Usual(
        "bit_load", "a bit torque", "N*m", 20, 200e3, span(0.02, 200, "kN·m"),
        (LikelyUnit(0.5, 19.99, " kN*m"),),
    ),
    "bit.rock.wear_flat": Usual(
        "wear_flat", "wear flats", "m", 1e-4, 0.05, span(0.1, 50, "mm"),
        (LikelyUnit(0.1, 50, " mm"),),
    ),
    "rig.block_weight": Usual(
        "rig_load", "a block weight", "N", 1e3, 5e6, span(1, 5000, "kN"),
        (LikelyUnit(10, 999, " kN"), LikelyUnit(5, 250, " klbf")),
    ),
    "rig.hoist_capacity": Usual(
        "rig_load", "a hoist capacity", "N", 50e3, 30e6, span(50, 30000, "kN"), (LikelyUnit(49, 30e3, " kN"),)
    ),
    "rig.largest_torque": Usual(
        "rig_load", "a drive torque", "N*m", 500, 300e3, span(0.5, 300, "kN·m"), (LikelyUnit(1, 300, " kN*m"),)
    ),
    "rig.slip_length": Usual(
        "rig_load", "a length of slips", "m", 0.1, 1.5, span(0.1, 1.5, "m"), (LikelyUnit(4, 40, " in"),)
    ),
    # Singles of range 1 to stands of four joints of range 3.
    "rig.stand_length": Usual(
        "rig_load", "a stand", "m", 5, 60, span(5, 60, "m"), (LikelyUnit(60, 200, " ft"),)
    ),
    "rig.guide_friction": Usual(
        "rig_load", "friction of the guides", "N", 100, 200e3, span(0.1, 200, "kN"), (LikelyUnit(0.1, 99, " kN"),)
    ),
    "rig.torque_offset": Usual(
        "rig_load", "a torque offset", "N*m", 5, 50e3, span(0.005, 50, "kN·m"), (LikelyUnit(0.1, 4.99, " kN*m"),)
    ),
    "rig.surface_bore": Usual(
        "surface_bore", "a bore of surface lines", "m", 0.03, 0.25, span(30, 250, "mm"), (LikelyUnit(1.5, 10, " in"),)
    ),
    "string.components.pressure_drop": Usual(
        "pressure_drop", "a pressure drop of a tool", "Pa", 1e4, 5e7, span(0.1, 500, "bar"),
        (LikelyUnit(10, 7000, " psi"), LikelyUnit(1, 500, " bar")),
    ),
    "wellbore.window.pore": WINDOW,
    "wellbore.window.fracture": WINDOW,
}  # fmt: skip


def unusual(case: Well) -> Doubts:
    """Values outside the range that is usual, most of them in a wrong unit."""
    for key, usual in USUAL.items():
        table, name = key.rsplit(".", 1)
        holders = [(table, attrgetter(table)(case))]
        if isinstance(holders[0][1], tuple):
            holders = [(f"{table}[{i}]", part) for i, part in enumerate(attrgetter(table)(case))]
        for place, holder in holders:
            value = abs(getattr(holder, name, None) or 0.0)  # there may be no rock, damping or caliper
            if value != 0 and not usual.low <= value <= usual.high:
                key = f"{place}.{name}"
                said = as_given(case, key, value, usual.unit, usual.likely_units)
                remedy = f"{'check it' if case.text_of(key) else 'write it with its unit'}; usual is {usual.words}"
                yield InputWarning(usual.code, key, f"{usual.what} of {said}", remedy)


def as_given(case: Well, key: str, value: float, unit: str, likely_units: Sequence[LikelyUnit]) -> str:
    """A value [SI] as the user wrote it, for an f-string, with the units that its number may be in."""
    written = case.text_of(key)
    if written is None:
        return quantity(value, unit) + unit_hint(value, likely_units)
    of_si = written.startswith(f"{value:g}")  # its number is the one in SI
    return written + (unit_hint(value, likely_units) if of_si else "")


def bare_lengths(keys: Sequence[str]) -> Doubts:
    """Lengths without a unit in a case whose other lengths are in feet and inches."""
    if keys:
        more = f", as {', '.join(keys[1:3])}{' and others' if len(keys) > 3 else ''}" if len(keys) > 1 else ""
        yield InputWarning(
            "bare_length", keys[0], f"a bare number is in metres{more}, the other lengths are in feet and inches",
            "write the length with its unit",
        )  # fmt: skip
