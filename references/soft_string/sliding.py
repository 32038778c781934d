"""Friction along and around a string that slides, rotates, or both: a set of factors for each law.

The wall carries the load across the hole q [N/m]: tension times curvature of the hole, plus the weight across it.
With the contact moving along the hole at V and around it at rΩ, tan ψ = rΩ/V:

- law ``coulomb``: one force μN opposite to the sliding velocity.  Its component around the hole, μN sin ψ, also acts
  across the hole, at right angles to the wall force N, so q² = N² + (μN sin ψ)²:
      N = q/√(1 + μ² sin²ψ),   drag = μ cos ψ N,   side friction = μ sin ψ N.
  Sliding gives N = q and drag μq; rotating in place N = q/√(1 + μ²) and torque r μq/√(1 + μ²).  With factors μ_a along
  and μ_r around the hole the force per N has the components f_a and f_r of `directions`, and
      N = q/√(1 + f_r²),   drag = f_a N,   side friction = f_r N.
- law ``paper`` (Eqs 15–16): N = q, drag μN when it slides and torque rμN when it rotates, both at once in full, with
  μ_a and μ_r.
"""

from typing import NamedTuple

import numpy as np

from fctd.case.errors import InputError, nearest
from fctd.case.load import Case
from fctd.case.operations import KINDS, Operation
from fctd.model.operations import rad_per_s
from references.soft_string.directions import Direction, associated


class Friction(NamedTuple):
    """Wall force and friction per load q across the hole.

    normal : wall force N; drag : axial friction, > 0 where it adds to tension upwards (pick-up);
    turning : friction around the hole, > 0, equal to torque over radius.
    """

    normal: float
    drag: float
    turning: float


class Motion(NamedTuple):
    """What the whole string does: drag_sign (+1: friction pulls down the hole), speed ≥ 0 [m/s], spin ≥ 0 [rad/s]."""

    drag_sign: float
    speed: float
    spin: float


def split_friction(
    law: str, factor: float, motion: Motion, radius: float, around: float | None = None,
    direction: Direction = associated,
) -> Friction:  # fmt: skip
    """Friction of a law (``coulomb`` or ``paper``) with a factor μ at a contact radius [m].

    around : factor around the hole, None where it is the same; direction : of friction with two factors, for law
    ``coulomb``.
    """
    around = factor if around is None else around
    turning = radius * motion.spin
    if law == "paper":
        return Friction(1.0, factor * motion.drag_sign, around * float(turning > 0))
    along, across = direction(factor, around, motion.speed, turning)
    normal = 1 / float(np.sqrt(1 + across**2))
    return Friction(normal, along * normal * motion.drag_sign, across * normal)


def motion_of(case: Case, operation: str, speed: float | None = None, rpm: float | None = None) -> Motion:
    """The motion of an operation, from the arguments or else from the case's first operation of that kind.

    speed [m/s]; rpm [1/min].  Friction depends only on the direction of sliding, so an operation that slides without
    rotation, or rotates without sliding, needs no value; a trip rotates only if the arguments or the case say so.
    Raises InputError for an unknown operation, and for a speed or rpm that is missing or does not fit the operation.
    """
    planned = next((o for o in case.operations if o.kind == operation), None)
    kind = _kind(operation)
    moves, turns = kind.direction != 0, kind.turns
    if speed is None:
        speed = planned.speed if planned else None if moves else 0.0
    if rpm is None:
        rpm = planned.rpm if planned else None if turns else 0.0
    if speed is None and rpm == 0:
        speed = 1.0
    if rpm is None and not moves:
        rpm = 1.0
    _check("rpm", rpm, needed=turns, allowed=kind.may_turn)
    _check("speed", speed, needed=moves, allowed=moves)
    assert speed is not None
    assert rpm is not None
    return Motion(float(-kind.direction), speed, rad_per_s(rpm))


def _kind(operation: str) -> type[Operation]:
    if operation not in KINDS:
        raise InputError(nearest(operation, KINDS, "operation"), key="operation", value=operation)
    return KINDS[operation]


def _check(key: str, value: float | None, *, needed: bool, allowed: bool) -> None:
    """Raise InputError for a speed or rpm that is missing, not finite, negative, or does not fit the operation."""
    expected = "0 for this operation" if not allowed else f"a number {'above' if needed else 'at least'} 0"
    if value is None:
        raise InputError(f"{expected}, as an argument or in an operation of the case", key=key)
    if not np.isfinite(value) or value < 0 or (needed and value == 0) or (value > 0 and not allowed):
        raise InputError(expected, key=key, value=value)


def loads_at_bit(case: Case, operation: str) -> tuple[float, float]:
    """Effective tension [N] and torque [N m] at the bit: −WOB and the bit torque on bottom, else none."""
    if _kind(operation).on_bottom:
        return -case.bit.weight_on_bit, case.bit.torque
    return 0.0, 0.0
