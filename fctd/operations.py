"""What the rig does: the schedule of a case as stretches of constant or ramped feed and rotation."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fctd.case import Case, Operation
from fctd.topdrive import Motion


class Stretch(NamedTuple):
    """A piece of the schedule: the top drive's motion, and the index of the operation it belongs to."""

    motion: Motion
    operation: int


def rad_per_s(rpm: float) -> float:
    """Rotation speed [rad/s] from revolutions per minute."""
    return rpm * np.pi / 30


def schedule(operations: Sequence[Operation]) -> list[Stretch]:
    """Stretches of the operations one after the other, starting from rest.

    Each operation ramps speed and rotation within its ramp time.  One that another follows comes to rest at
    its end depth; the last one ends in motion, so that its end can be read as a steady state.
    """
    stretches: list[Stretch] = []
    clock, turning = 0.0, 0.0
    for k, operation in enumerate(operations):
        rate = rad_per_s(operation.rpm)
        stops = k + 1 < len(operations)
        for duration, feed_from, feed_to in _feed(operation, stops):
            motion = Motion(clock, duration, feed_from, feed_to, turning, rate)
            stretches.append(Stretch(motion, k))
            clock += duration
            turning = rate
    return stretches


def _feed(operation: Operation, stops: bool) -> list[tuple[float, float, float]]:
    """Duration [s], feed speed downwards at the start and at the end [m/s] of the parts of an operation."""
    if operation.kind == "rotate_off_bottom":
        ramp = min(operation.ramp_time, operation.duration)
        parts = [(ramp, 0.0, 0.0), (operation.duration - ramp, 0.0, 0.0)]
    else:
        distance = abs(operation.end_md - operation.start_md)
        feed = np.copysign(operation.speed, operation.end_md - operation.start_md)
        # A smooth ramp covers half its time at full speed; a short trip has shorter ramps.
        ramps = 2 if stops else 1
        ramp = min(operation.ramp_time, 2 * distance / (operation.speed * ramps))
        cruise = distance / operation.speed - 0.5 * ramps * ramp
        parts = [(ramp, 0.0, feed), (cruise, feed, feed)] + [(ramp, feed, 0.0)] * stops
    return [part for part in parts if part[0] > 1e-9]


def depth_range(case: Case) -> tuple[float, float, float]:
    """Bit depth at the start, shallowest and deepest of the schedule [m]."""
    depths = [d for operation in case.operations for d in (operation.start_md, operation.end_md)]
    return depths[0], min(depths), max(depths)
