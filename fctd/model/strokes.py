"""The schedule of a rig that moves stands: strokes of the block, and connections between them."""

from collections.abc import Sequence
from typing import Final, NamedTuple

from fctd.case.operations import Operation, Stay
from fctd.case.rig import RigSpec
from fctd.mechanics.drive import BY_SPEED, TARING, Driller
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import Part, Phase, check_duration, rad_per_s, staying, travelling
from fctd.model.stands import Tally

# Depths and heights of a schedule agree within this [m].
SAME: Final = 1e-9
# An autodriller lifts the bit so far off bottom before a connection [m], and moves it so fast there [m/s].
PICK_UP, GENTLY = 0.5, 0.1


class Stroke(NamedTuple):
    """A stroke of the block, or a connection, during which the string hangs in the slips.

    start [s]; change : stands that are added (1) or racked back (-1) at the start; travel : downwards, without the
    stretch of the pipe [m], 0 in a connection; target : height of the block at the end, without that stretch [m];
    by_weight : an autodriller drills it down, which may take longer or shorter than planned.
    """

    start: float
    change: int
    travel: float
    target: float
    by_weight: bool = False

    @property
    def in_slips(self) -> bool:
        """Whether the string hangs in the slips."""
        return self.travel == 0


class ExpectedDrilling(NamedTuple):
    """What an autodriller is expected to do.

    rates : speed of the bit in each operation [m/s]; taring : for how long the hook load is averaged off bottom [s].
    """

    rates: Sequence[float]
    taring: float


class _Plan:
    """A schedule that grows by one part after the other; the rig stands still at its start."""

    def __init__(self, tally: Tally, rig: RigSpec, depth: float, expected: ExpectedDrilling | None) -> None:
        self.tally, self.rig, self.depth, self.expected = tally, rig, depth, expected
        self.lifted = False
        self.stands = tally.stands_for(depth)
        self.clock, self.turning, self.loaded, self.pumped = 0.0, 0.0, 0.0, 0.0
        self.flow = 0.0  # of the present operation
        self.phases: list[Phase] = []
        self.strokes: list[Stroke] = []
        self.change = 0

    def add(
        self, k: int, parts: list[Part], spins: list[float], loads: list[float], driller: Driller = BY_SPEED,
        flows: list[float] | None = None,
    ) -> None:  # fmt: skip
        """Phases of operation k: duration [s] and feed at both ends [m/s] of each; rotation [rad/s], share of the
        loads on the bit and flow [m³/s] at its end, by default that of the operation."""
        flows = [self.flow] * len(parts) if flows is None else flows
        for (duration, feed_from, feed_to), spin, load, flow in zip(parts, spins, loads, flows, strict=True):
            motion = Motion(
                self.clock, duration, feed_from, feed_to, self.turning, spin, bit_from=self.loaded, bit_to=load,
                driller=driller, flow_from=self.pumped, flow_to=flow,
            )  # fmt: skip
            self.phases.append(Phase(motion, k))
            self.clock += duration
            self.turning, self.loaded, self.pumped = spin, load, flow

    def connect(self, k: int, operation: Operation, change: int) -> None:
        """Hang the string in the slips, pumps off, and add a stand afterwards, or rack one back before."""
        if self.turning or self.pumped:
            self.add(k, [(operation.ramp_time, 0.0, 0.0)], [0.0], [0.0], flows=[0.0])
        self.strokes.append(Stroke(self.clock, min(change, 0), 0.0, 0.0))
        self.add(k, [(self.rig.connection_time, 0.0, 0.0)], [0.0], [0.0], flows=[0.0])
        self.stands += change
        self.change = max(change, 0)

    def move(self, k: int, operation: Operation, last: bool, unloads: bool) -> None:
        """Strokes and connections of operation k; the last of a schedule ends in motion.

        unloads : whether the next operation is off bottom.
        """
        end, down = operation.end_md, operation.end_md > operation.start_md
        rate = rad_per_s(operation.rpm)
        connects = down and self.tally.reach[self.stands] + SAME < end
        while abs(end - self.depth) > SAME:
            low, high = self.tally.reach[self.stands - 1 : self.stands + 1].tolist()
            if down and high - self.depth <= SAME:
                self.connect(k, operation, 1)
                high = float(self.tally.reach[self.stands])
            elif not down and self.depth - low <= SAME:
                self.connect(k, operation, -1)
                low = float(self.tally.reach[self.stands - 1])
            goal = min(end, high) if down else max(end, low)
            ends_here = abs(end - goal) <= SAME
            if operation.on_bottom and connects and self.expected is not None:
                self.drill(k, operation, goal, self.expected, unloads=unloads or not ends_here, lifts=not ends_here)
                continue
            parts = travelling(goal - self.depth, operation.speed, operation.ramp_time, stops=not (ends_here and last))
            target = float(self.tally.reach[self.stands]) - goal
            self.strokes.append(Stroke(self.clock, self.change, goal - self.depth, target))
            self.change = 0
            spins, loads = [rate] * len(parts), [float(operation.on_bottom)] * len(parts)
            flows = [self.flow] * len(parts)
            if not ends_here:
                spins[-1] = loads[-1] = flows[-1] = 0.0
            elif unloads:
                loads[-1] = 0.0
            self.add(k, parts, spins, loads, flows=flows)
            self.depth = goal

    def drill(
        self, k: int, operation: Operation, goal: float, expected: ExpectedDrilling, *, unloads: bool, lifts: bool
    ) -> None:
        """A stroke of the autodriller down to the bit depth ``goal`` [m].

        Off bottom, where the last connection has left the bit, it takes the tare, and it lowers the bit.  unloads,
        lifts : whether it takes the weight off the bit and then lifts it, at the end of the stroke.
        """
        rate, ramp, way = rad_per_s(operation.rpm), operation.ramp_time, goal - self.depth
        lifted = PICK_UP if self.lifted else 0.0
        target = float(self.tally.reach[self.stands]) - goal
        self.strokes.append(Stroke(self.clock, self.change, way + lifted, target, by_weight=True))
        self.change = 0
        if self.lifted:
            self.add(k, [(ramp, 0.0, 0.0)], [rate], [0.0])
            self.add(k, [(expected.taring, 0.0, 0.0)], [rate], [0.0], TARING)
            self.lift(k, PICK_UP, rate)
        self.add(k, [(ramp, 0.0, 0.0), (way / expected.rates[k], 0.0, 0.0)], [rate] * 2, [1.0] * 2)
        if unloads:
            self.add(k, [(ramp, 0.0, 0.0)], [rate], [0.0])
        if lifts:
            self.lift(k, -PICK_UP, rate)
        self.lifted = lifts
        self.depth = goal

    def lift(self, k: int, way: float, rate: float) -> None:
        """Move the turning string off bottom, downwards above 0 [m]."""
        parts = travelling(way, GENTLY, 1.0, stops=True)
        self.add(k, parts, [rate] * len(parts), [0.0] * len(parts))


def stand_schedule(
    operations: Sequence[Operation], tally: Tally, rig: RigSpec, expected: ExpectedDrilling | None = None
) -> tuple[list[Phase], list[Stroke]]:
    """Phases and strokes of the operations in order, starting from rest; expected : of an autodriller.

    Every stroke ramps speed, rotation and flow within the ramp time of its operation, and comes to rest before a
    connection, pumps off.
    Raises InputError for an operation shorter than ``operations.SHORTEST``.
    """
    plan = _Plan(tally, rig, operations[0].start_md, expected)
    for k, operation in enumerate(operations):
        began, plan.flow = plan.clock, operation.flow
        if isinstance(operation, Stay):
            parts = staying(operation)
            plan.add(k, parts, [rad_per_s(operation.rpm)] * len(parts), [0.0] * len(parts))
        else:
            last = k + 1 == len(operations)
            plan.move(k, operation, last, unloads=not last and not operations[k + 1].on_bottom)
        check_duration(k, plan.clock - began)
    return plan.phases, plan.strokes
