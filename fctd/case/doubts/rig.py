"""Probable mistakes in mud, rig, bit loads and rates."""

from collections.abc import Sequence
from typing import Final

from fctd.case.doubts.usual import Doubts, Well
from fctd.case.drilling import DriveSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.operations import KINDS, Operation
from fctd.case.rig import MudSpec, RigSpec
from fctd.case.units import FASTEST, MOST_RPM

DEEP: Final = 500.0  # [m]: a string this long hangs in mud, unless the case says that it does not
FASTEST_HOIST, FASTEST_DRILLING, FASTEST_ROTATION = 3.0, 0.1, 300.0  # [m/s], [m/s], [rev/min]
LEAST_EFFICIENCY: Final = 0.7  # of twelve lines over old sheaves


def no_mud(mud: MudSpec, td: float) -> Doubts:
    """A deep hole without mud, where the case does not say so."""
    if td > DEEP and mud.density == 0 and not mud.outside and "density" not in mud.model_fields_set:
        yield InputWarning(
            "no_mud", "mud.density", f"there is no mud, so the string hangs in air in a hole of {quantity(td, 'm')}",
            'give a density such as "1200 kg/m^3", or 0 for air',
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
        text = f"{doing} at {quantity(speed, 'm/s')}, which is {quantity(3600 * speed, 'm/h', '.0f')}"
        yield InputWarning("speed", f"{where}speed", text, "write the speed with its unit, such as '20 m/h'")
    if FASTEST_ROTATION < rpm <= MOST_RPM:
        text = f"{rpm:g} rev/min, where top drives turn at up to {FASTEST_ROTATION:g}"
        yield InputWarning("rotation", f"{where}rpm", text, "check the rotation of the string")
