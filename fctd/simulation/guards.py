"""Guards: what is checked at every record of a run, in a hundredth of its time: compiled looks (looks.py) come first.

- The state is finite, and no contact point lies deeper in the wall than the hole's radius: else the run ends
  (``faults.check``).
- Contact points that are deep in the wall, stress and hook load (``limits.find_shares``), and segments that cannot bend
  as the buckled string does (``notes.under_resolved``).
- Joints beyond the range of their law (``run_notes.beyond_joints``).
- The hook load: a string that is pushed down (``run_notes.pushes``), and one that flutters (``run_notes.flutters``).
- The torque that the joints' own damping takes of a turning string (``run_notes.brakes_turning``).
- The energy ledger so far, by which a run that ends early is judged.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from operator import itemgetter
from time import process_time
from typing import ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.message import quantity, within
from fctd.mechanics import state
from fctd.mechanics.query import WALL_COLUMNS, Walls, walls_in
from fctd.model.torsion import axial_period_of
from fctd.results.buckling import Buckling
from fctd.results.ledger import LOSSES
from fctd.results.limits import LIMITS, WORST, find_shares
from fctd.results.notes import Note, as_metadata, from_metadata, limit_notes, rig_notes, under_resolved
from fctd.results.profile import Loads, hanging_along
from fctd.results.run_notes import (
    OF_THE_WALL,
    SMALL_FLUTTER,
    beyond_joints,
    brakes_turning,
    flutters,
    ledger_off,
    pushes,
)
from fctd.simulation.looks import LISTEN, is_sound, listen
from fctd.simulation.run import Run
from fctd.store.facts import Facts, Restorable

lost_of = itemgetter(*LOSSES, "lost_bit_J")
P = ParamSpec("P")
R = TypeVar("R")


class Guards(Restorable):
    """The checks of a run: its notes so far by code, each where it was worst, and the time that they took.

    seconds : by the process's own clock.  residual, work : the largest so far of the ledger [J].  swing : amplitude [N]
    and frequency [Hz] of the fast part of the hook load when it was last read.
    """

    FACTS = ("seconds", "residual", "work", "swing")

    def __init__(self, run: Run) -> None:
        self.run = run
        self.notes: dict[str, Note] = {}
        self.seconds = self.residual = self.work = 0.0
        self.swing = 0.0, 0.0
        self._worst, self._judged = np.empty((len(LIMITS), WORST)), (run.string, run.flow_pressures, *self._constants())
        # Reading the compiled code from disk, or compiling it, is no part of the checks' time.
        n = run.segments
        is_sound(run.S, n)
        self._of_limits(Loads(*np.zeros((4, n))), walls_in(np.zeros((n, WALL_COLUMNS))), 0.0)
        listen(run.S, run.top.copy(), n, run.pipe.weight)

    def facts(self) -> Facts:
        return super().facts() | {"notes": as_metadata(self.notes.values())}

    def restore(self, facts: Facts) -> None:
        super().restore(facts)
        self.notes = {note.code: note for note in from_metadata(facts["notes"])}

    def timed(self, check: Callable[P, R], *given: P.args, **more: P.kwargs) -> R:
        """Call one of the checks below, and add its time."""
        began = process_time()
        try:
            return check(*given, **more)
        finally:
            self.seconds += process_time() - began

    def check_state(self, bit_depth: float) -> None:
        """Raise UnstableError where the model cannot describe the state; bit_depth [m]."""
        if not is_sound(self.run.S, self.run.segments):
            worst = self.run.check()
            self._keep(beyond_joints(worst.bend, worst.twist, worst.joint), bit_depth)

    def check_record(
        self, bit_depth: float, pull: tuple[float, float], loads: Loads, walls: Walls, buckling: Buckling,
        row: Mapping[str, float], turning: tuple[float, float] = (0.0, 0.0),
        readings: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:  # fmt: skip
        """Keep the notes of a record; loads are means over its interval, row is its row of the ledger.

        pull : mean hook load of the record, and the least of its steps [N]; turning : rotation at the top [rad/s] and
        mean torque [N m]; readings : of the weight indicator [N] and of the drive torque [N m], and what hangs in the
        slips [N].
        """
        run, (indicator, drive, hanging) = self.run, readings
        top = run.string.sections[run.string.component[0]]
        of_the_rig = rig_notes(run.case.rig, run.case.limits, indicator, drive, top, hanging)
        for note in (*self._of_limits(loads, walls, pull[0]), *of_the_rig):
            self._keep(note, bit_depth)
        self._keep(under_resolved(buckling), bit_depth)
        self._check_hookload(bit_depth, *pull)
        spin, torque = turning
        if spin > 0 and run.laws.joint_damping > 0:
            taken = run.laws.joint_damping * spin * (loads.bending**2 / state.row(run.S, state.K_BEND, run.segments))
            self._keep(brakes_turning(float(taken.sum()), torque), bit_depth)
        lost = abs(sum(lost_of(row)))
        beyond = abs(row["top_drive_work_J"] - row["gravity_J"])
        self.work = max(self.work, lost, beyond)
        self.residual = max(self.residual, abs(row["residual_J"]))

    def _check_hookload(self, bit_depth: float, mean: float, least: float) -> None:
        """Keep the notes on the hook load of a record [N], and on its flutter since it was last judged."""
        run = self.run
        weight, on_wall, heard, swing = listen(run.S, run.top, run.segments, run.pipe.weight)
        if least < 0:
            self._keep(pushes(mean, least, run.case.rig.block_weight, weight), bit_depth)
        if heard == 0:
            return
        (amplitude, frequency), before, self.swing = swing, self.swing, swing
        if heard <= 2 * LISTEN:
            amplitude, frequency = min(amplitude, before[0]), min(frequency, before[1])
        kept = self.notes["flutter"].excess if "flutter" in self.notes else 1.0
        # The period of the string takes longer than all other checks together.
        if amplitude > kept * SMALL_FLUTTER * weight and frequency > OF_THE_WALL * on_wall:
            self._keep(flutters(amplitude, frequency, on_wall, 1 / axial_period_of(run.laid_out), weight), bit_depth)

    def _of_limits(self, loads: Loads, walls: Walls, hookload: float) -> tuple[Note, ...]:
        """The notes on the string's limits."""
        run, string = self.run, self.run.string
        # Another string at each record where it hangs from a block, and another flow where mud flows; else never.
        if string is not self._judged[0] or run.flow_pressures is not self._judged[1]:
            self._judged = string, run.flow_pressures, *self._constants()
        hanging = hanging_along(run.hole, string, loads, walls.md, run.case.contact.enabled)
        beyond = find_shares(
            loads.tension, loads.torque, hanging, loads.bit_tension, loads.bit_torque, hookload, walls.offset,
            walls.radius, state.row(run.S, state.RADIUS, run.segments), *self._judged[2:], self._worst,
        )  # fmt: skip
        asked = run.case.limits
        return limit_notes(self._worst, string, walls, asked) if beyond or not asked.all_used else ()

    def _constants(self) -> tuple[bool, NDArray[np.bool_], NDArray[np.int64], Array, Array]:
        run, string = self.run, self.run.string
        excess = run.excess_pressure()
        return run.case.contact.enabled, string.mid_contact(), string.bodies, string.table, excess

    def of_the_ledger(self) -> Note | None:
        """The note on a ledger that is off so far, as far as the run has turned over energy."""
        return ledger_off(self.residual / self.work) if self.work > 0 else None

    def _keep(self, note: Note | None, bit_depth: float) -> None:
        """Keep a note that is new, or whose excess is larger than before."""
        if note is not None and (note.code not in self.notes or note.excess > self.notes[note.code].excess):
            self.notes[note.code] = replace(
                note, text=f"{within(note.text)}, with the bit at {quantity(bit_depth, 'm', '.0f')}"
            )
