"""The schedule of the rig: the operations of a case as phases of constant or ramped feed and rotation."""

import math
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np

from fctd.case.errors import InputError, nearest
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.case.operations import KINDS, Operation, Stay
from fctd.case.rig import RigSpec
from fctd.case.units import FASTEST, FLOW, MOST_RPM, ROTATION, SPEED, argument
from fctd.mechanics.topdrive import Motion

# Shortest operation [s]; a shorter one would end before the first step, with no load to record.
SHORTEST = 1e-3


class Phase(NamedTuple):
    """A phase of the schedule: the top drive's motion, and the index of its operation."""

    motion: Motion
    operation: int


# Duration [s], feed speed downwards at the start and at the end [m/s] of a part of an operation.
Part = tuple[float, float, float]


def rad_per_s(rpm: float) -> float:
    """Rotation speed [rad/s] from revolutions per minute."""
    return rpm * np.pi / 30


def schedule(operations: Sequence[Operation]) -> list[Phase]:
    """Phases of the operations in order, starting from rest.

    Each operation ramps speed, rotation and flow within its ramp time.  It comes to rest at its end depth, except the
    last one, which ends in motion so that its end is a steady state.  Raises InputError for an operation shorter
    than ``SHORTEST``.
    """
    phases: list[Phase] = []
    clock, turning, loaded, pumped = 0.0, 0.0, False, 0.0
    for k, operation in enumerate(operations):
        rate = rad_per_s(operation.rpm)
        stops = k + 1 < len(operations)
        parts = _feed(operation, stops)
        check_duration(k, sum(duration for duration, _, _ in parts))
        unloads = stops and not operations[k + 1].on_bottom
        for duration, feed_from, feed_to in parts:
            load = operation.on_bottom and not (unloads and feed_to == 0)
            motion = Motion(
                clock, duration, feed_from, feed_to, turning, rate, bit_from=float(loaded), bit_to=float(load),
                flow_from=pumped, flow_to=operation.flow,
            )  # fmt: skip
            phases.append(Phase(motion, k))
            clock += duration
            turning, loaded, pumped = rate, load, operation.flow
    return phases


def check_duration(k: int, lasts: float) -> None:
    """Raise InputError where operation k, which lasts so long [s], is shorter than ``SHORTEST``."""
    if lasts < SHORTEST:
        raise InputError(
            f"an operation that lasts at least {1e3 * SHORTEST:g} ms", key=f"operations[{k}]", value=f"{lasts:.3g} s"
        )


def _feed(operation: Operation, stops: bool) -> list[Part]:
    """The parts of an operation."""
    if isinstance(operation, Stay):
        return staying(operation)
    return travelling(operation.end_md - operation.start_md, operation.speed, operation.ramp_time, stops=stops)


def staying(operation: Stay) -> list[Part]:
    """The parts of an operation that feeds nothing."""
    ramp = min(operation.ramp_time, operation.duration)
    return _present([(ramp, 0.0, 0.0), (operation.duration - ramp, 0.0, 0.0)])


def travelling(travel: float, speed: float, ramp_time: float, *, stops: bool) -> list[Part]:
    """The parts of a move by ``travel`` [m], downwards above 0; stops : whether it ends at rest."""
    distance, feed = abs(travel), float(np.copysign(speed, travel))
    # A smooth ramp covers half its time at full speed; a short trip has shorter ramps.
    ramps = 2 if stops else 1
    ramp = min(ramp_time, 2 * distance / (speed * ramps))
    cruise = distance / speed - 0.5 * ramps * ramp
    return _present([(ramp, 0.0, feed), (cruise, feed, feed)] + [(ramp, feed, 0.0)] * stops)


def _present(parts: list[Part]) -> list[Part]:
    """The parts that last."""
    return [part for part in parts if part[0] > 1e-9]


def depth_range(case: Case) -> tuple[float, float, float]:
    """Bit depth at the start, shallowest and deepest of the schedule [m]."""
    depths = [d for operation in case.operations for d in (operation.start_md, operation.end_md)]
    return depths[0], min(depths), max(depths)


def weight_indicator(rig: RigSpec, direction: Any, hookload: Any) -> Any:
    """Reading of the weight indicator [N] for a hook load of the string [N]; scalars, or series of one shape.

    direction : of the string, 1 down, −1 up, 0 at rest.  Friction of the sheaves lowers the dead line's tension while
    the block is hoisted, and raises it while the block is lowered, as in drilling; friction of the block's guides acts
    against its motion.
    """
    return (hookload + rig.block_weight - direction * rig.guide_friction) * rig.sheave_efficiency ** (-direction)


def string_load(rig: RigSpec, direction: Any, indicator: Any) -> Any:
    """The hook load of the string [N] at a reading of the weight indicator [N]: the inverse of it."""
    return indicator * rig.sheave_efficiency**direction - rig.block_weight + direction * rig.guide_friction


def drive_torque(rig: RigSpec, spin: float, torque: float) -> float:
    """Reading of the top drive's torque [N m] for a surface torque [N m] at a rotation [rad/s]."""
    return torque + rig.torque_offset + rig.torque_per_rpm * spin / rad_per_s(1.0)


class SteadyRates(NamedTuple):
    """A steady operation: speed along the hole, downwards [m/s], rotation [rad/s], and flow of the pumps [m³/s]."""

    speed: float
    spin: float
    flow: float = 0.0


# Kinds that have a speed, those that rotate, and those that pump what the case pumps; trips do neither unasked.
MOVING: Final = frozenset(name for name, kind in KINDS.items() if kind.direction)
TURNING: Final = frozenset(name for name, kind in KINDS.items() if kind.turns)
PUMPING: Final = frozenset(name for name, kind in KINDS.items() if kind.turns or kind.on_bottom)


class BitLoads(NamedTuple):
    """Weight on the bit [N], below 0 where a stuck bit holds the string, and torque at the bit [N m]."""

    weight: float
    torque: float


def bit_loads(case: Case, kind: str) -> BitLoads:
    """Loads of a case at the bit in an operation of a kind."""
    of, bit = KINDS[kind], case.bit
    if of.on_bottom:
        return BitLoads(bit.weight_on_bit, bit.torque)
    return BitLoads(0.0 - bit.overpull if of.direction < 0 else 0.0, 0.0)


def steady_rates(
    case: Case,
    kind: str,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
) -> SteadyRates:
    """Rates of one operation: as given, else those of the case's first operation of that kind, else the kind's
    defaults, which for what drills, rotates or reams are with the flow of the case (``flow_of``).

    speed [m/s], rpm and flow [m³/s], or texts with units, are not negative; the kind sets the direction.  A given rpm
    turns a trip, too: what options mean is ``rates_of_all``.  Raises InputError for an unknown kind, for rates that are
    not of its kind and for rates beyond ``units.FASTEST`` and ``units.MOST_RPM``.
    """
    if kind not in KINDS:
        raise InputError(nearest(kind, KINDS, "kind"), key="operation", value=kind)
    of = KINDS[kind]
    own = next((o for o in case.operations if o.kind == kind), None)
    own_speed, own_rpm = (of.default_speed, of.default_rpm) if own is None else (own.speed, own.rpm)
    if flow is not None:
        pumped = argument(flow, FLOW, "flow")
    elif own is not None:
        pumped = own.flow
    else:
        pumped = flow_of(case) if kind in PUMPING else 0.0
    speed, rpm = own_speed if speed is None else speed, own_rpm if rpm is None else rpm
    feed, turns = argument(speed, SPEED, "speed"), argument(rpm, ROTATION, "rpm")
    if not (0 < feed <= FASTEST if of.direction else feed == 0):
        wanted = f"above 0 and at most {quantity(FASTEST, 'm/s')}" if of.direction else "of 0"
        raise InputError(f"a speed {wanted} for {kind}", key="speed", value=speed)
    if not (0 <= turns <= MOST_RPM and (turns > 0 if of.turns else of.may_turn or turns == 0)):
        wanted = "above 0" if of.turns else "at least 0" if of.may_turn else "of 0"
        wanted += f" and at most {MOST_RPM:g}" if of.may_turn else ""
        raise InputError(f"rev/min {wanted} for {kind}", key="rpm", value=rpm)
    if not 0 <= pumped < math.inf:
        raise InputError("a flow of at least 0", key="flow", value=flow)
    return SteadyRates(of.direction * feed, rad_per_s(turns), pumped)


def flow_of(case: Case) -> float:
    """The flow of a case [m³/s]: the largest of its operations, 0 where none pumps."""
    return max((operation.flow for operation in case.operations), default=0.0)


def rates_of_all(
    case: Case,
    kinds: Sequence[str],
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
) -> dict[str, SteadyRates]:
    """Rates of operations as options mean them: a given speed applies to the kinds that move, a given rpm to those that
    rotate by their name, a flow to all.  No kind's rates depend on the kinds beside it.

    Raises InputError as ``steady_rates`` does, also for a rate that applies to none of the kinds.
    """
    moving, turning = ([k for k in kinds if k in having] for having in (MOVING, TURNING))
    if rpm is not None and not turning:
        _refuse_turning(kinds, rpm)

    def rates(kind: str) -> SteadyRates:
        # A rate that applies to no kind is passed on, so that ``steady_rates`` raises InputError.
        return steady_rates(
            case,
            kind,
            speed if kind in moving or not moving else None,
            rpm if kind in turning or not turning else None,
            flow,
        )

    return {kind: rates(kind) for kind in kinds}


def _refuse_turning(kinds: Sequence[str], rpm: float | str) -> None:
    """Raise InputError for a rotation of kinds that slide; 0 is none."""
    kind = next((kind for kind in kinds if kind in KINDS and KINDS[kind].may_turn), None)
    if kind is not None and argument(rpm, ROTATION, "rpm") > 0:
        turns = next(
            name for name, of in KINDS.items()
            if of.turns and not of.on_bottom and of.direction == KINDS[kind].direction
        )  # fmt: skip
        raise InputError(f"rev/min of 0 for {kind}: {turns} turns as it moves that way", key="rpm", value=rpm)
