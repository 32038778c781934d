"""Guards: what is checked at every record of a run, within a few per cent of the time of its records.

- The state is finite, and no contact point lies deeper in the wall than the hole's radius: else the run ends
  (``faults.check``).
- Contact points that are deep in the wall, stress and hook load (``notes.string_notes``), and segments that cannot bend
  as the buckled string does (``notes.under_resolved``).
- Joints beyond the range of their law (``notes.beyond_joints``).
- The hook load: a string that is pushed down (``run_notes.pushes``), and one that flutters (``run_notes.flutters``).
- Sliding that is too slow for the step (``run_notes.slides_slowly``).
- The energy ledger so far, by which a run that ends early is judged.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from time import process_time
from typing import ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics import readings, state, topdrive
from fctd.mechanics.jit import entry
from fctd.mechanics.laws import CODES
from fctd.mechanics.query import WALL_COLUMNS, Walls, walls_in
from fctd.mechanics.state import (
    ARM_CONTACT,
    HELD_BACK,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    RADIUS,
)
from fctd.model.torsion import axial_period_of
from fctd.results.buckling import Buckling
from fctd.results.ledger import LOSSES
from fctd.results.notes import (
    LEAST_PENETRATION,
    MOST_PENETRATION,
    SHARE_OF_CLEARANCE,
    SMALL_SWING,
    Note,
    beyond_joints,
    could_have_notes,
    ledger_off,
    string_notes,
    under_resolved,
)
from fctd.results.profile import Loads
from fctd.results.run_notes import flutters, pushes, slides_slowly
from fctd.simulation.run import Run


@entry
def may_have_notes(offset, hole, radius, tension, torque, bending, bit_tension, bit_torque, sections, top, hookload):
    """Whether ``string_notes`` may find something: most records have no notes, and this takes two microseconds.

    offset (n, 3), hole (n,) : of the walls; radius (n,) : of the contact points [m]; loads (n,) as in ``Loads``;
    sections : a row for each component, the uppermost in row ``top``.
    """
    pull, twist, bend = 0.0, 0.0, 0.0
    for j in range(len(hole)):
        distance = math.sqrt(offset[j, 0] ** 2 + offset[j, 1] ** 2 + offset[j, 2] ** 2)
        most = min(max(SHARE_OF_CLEARANCE * (hole[j] - radius[j]), LEAST_PENETRATION), MOST_PENETRATION)
        if distance - hole[j] + radius[j] > 0.999 * most:  # string_notes, which rounds otherwise, decides
            return True
        pull, twist, bend = max(pull, abs(tension[j])), max(twist, abs(torque[j])), max(bend, bending[j])
    return could_have_notes(0.0, pull, bit_tension, twist, bit_torque, bend, sections, top, hookload)


# Time [s] over which the flutter of the hook load is read; it counts where it lasts for two such times, as the jolt of
# a start does not.
LISTEN = 1.0
COULOMB = CODES["coulomb"]
LOST = (*LOSSES, "lost_bit_J")
Array = NDArray[np.float64]
P = ParamSpec("P")
R = TypeVar("R")


class Guards:
    """The checks of a run: its notes so far by code, each where it was worst, and the time that they took.

    seconds : by the process's own clock.  residual, work : the largest so far of the ledger [J].  swing : amplitude [N]
    and frequency [Hz] of the fast part of the hook load when it was last read.
    """

    def __init__(self, run: Run) -> None:
        self.run = run
        self.notes: dict[str, Note] = {}
        self.seconds = self.residual = self.work = 0.0
        self.swing = 0.0, 0.0
        self._sections, self._of_sections = run.string.sections, run.string.table
        # Reading the compiled code from disk, or compiling it, is no part of the checks' time.
        walls, none = walls_in(np.zeros((2, WALL_COLUMNS))), np.zeros(2)
        may_have_notes(walls.offset, walls.radius, none, none, none, none, 0.0, 0.0, self._table(), 0, 0.0)
        could_have_notes(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, self._table(), 0, 0.0)

    def timed(self, check: Callable[P, R], *given: P.args, **more: P.kwargs) -> R:
        """Call one of the checks below, and add its time."""
        began = process_time()
        try:
            return check(*given, **more)
        finally:
            self.seconds += process_time() - began

    def check_state(self, bit_depth: float) -> None:
        """Raise UnstableError where the model cannot describe the state; bit_depth [m]."""
        worst = self.run.check()
        self._keep(beyond_joints(worst.bend, worst.twist, worst.joint), bit_depth)

    def check_record(
        self, bit_depth: float, pull: tuple[float, float], loads: Loads, walls: Walls, buckling: Buckling,
        row: Mapping[str, float],
    ) -> None:  # fmt: skip
        """Keep the notes of a record; loads are means over its interval, row is its row of the ledger.

        pull : mean hook load of the record, and the least of its steps [N].
        """
        run = self.run
        radius, in_hole, string = state.row(run.S, state.RADIUS, run.segments), run.case.contact.enabled, run.string
        if not in_hole or may_have_notes(
            walls.offset, walls.radius, radius, loads.tension, loads.torque, loads.bending, float(loads.bit_tension),
            float(loads.bit_torque), self._table(), int(string.component[0]), pull[0],
        ):  # fmt: skip
            for note in string_notes(string, loads, pull[0], walls, radius, in_hole=in_hole):
                self._keep(note, bit_depth)
        self._keep(under_resolved(buckling), bit_depth)
        self._check_hookload(bit_depth, *pull)
        lost = abs(sum([row[name] for name in LOST]))
        beyond = abs(row["top_drive_work_J"] - row["gravity_J"])
        self.work = max(self.work, lost, beyond)
        self.residual = max(self.residual, abs(row["residual_J"]))

    def _check_hookload(self, bit_depth: float, mean: float, least: float) -> None:
        """Keep the notes on the hook load of a record [N], and on its flutter since it was last judged."""
        run = self.run
        if least >= 0 and run.top[topdrive.PULL_TIME] < LISTEN:
            return
        S, n, long = run.S, run.segments, float(run.top[topdrive.TOP_LENGTH])
        weight = float(state.row(S, state.WEIGHT, n).sum()) + 0.5 * run.pipe.weight * long
        self._keep(pushes(mean, least, run.case.rig.block_weight, weight), bit_depth)
        if run.top[topdrive.PULL_TIME] < LISTEN:
            return
        long = run.top[topdrive.PULL_TIME] > 2 * LISTEN
        now = readings.drain_swing(run.top)
        amplitude, frequency = now if long else map(min, now, self.swing)
        self.swing = now
        if amplitude > SMALL_SWING * weight and (stiffness := state.row(S, state.K_WALL, n)).max() > 0:
            inverse = state.row(S, state.INVERSE_MASS, n) - state.row(S, state.HELD_BACK, n)
            on_wall = math.sqrt((stiffness * inverse)[stiffness > 0].min()) / (2 * math.pi)
            self._keep(flutters(amplitude, frequency, on_wall, 1 / axial_period_of(run.laid_out), weight), bit_depth)

    def check_sliding(self, bit_depth: float, speed: float, torque: Array, full: Array) -> None:
        """Keep the note on a string that slides along its hole and does not turn, by means over a record.

        speed [m/s]; torque (n,) : r F_t of friction around the hole; full (n,) : r μ F_n [N m].

        Law ``coulomb`` sets friction against the sliding before the step.  Where that of a step h from rest around the
        hole, μF_n h (m⁻¹ + a²/J_t + r²/J_a), exceeds the speed along it, friction can hold a force around the hole
        without any sliding there, and spends itself on that; no force is held across the sliding of real friction.
        """
        run, n = self.run, self.run.segments
        total = float(full.sum())
        if run.laws.friction != COULOMB or not total > 0:
            return
        rows = (INVERSE_MASS, HELD_BACK, ARM_CONTACT, INVERSE_JT, RADIUS, INVERSE_JA)
        mass, held, arm, across, radius, along = (state.row(run.S, offset, n) for offset in rows)
        slow = run.step * full * (mass - held + arm**2 * across + radius**2 * along) > speed * radius
        around = np.minimum(np.abs(torque[slow]) / full[slow], 1.0)
        lacking = float((full[slow] * (1 - np.sqrt(1 - around**2))).sum()) / total
        self._keep(slides_slowly(speed, lacking, run.step), bit_depth)

    def _table(self) -> NDArray[np.float64]:
        """The table of the string's sections, which are the same ones at most depths."""
        string = self.run.string
        if string.sections is not self._sections:
            self._sections, self._of_sections = string.sections, string.table
        return self._of_sections

    def of_the_ledger(self) -> Note | None:
        """The note on a ledger that is off so far, as far as the run has turned over energy."""
        return ledger_off(self.residual / self.work) if self.work > 0 else None

    def _keep(self, note: Note | None, bit_depth: float) -> None:
        """Keep a note that is new, or whose excess is larger than before."""
        if note is not None and (note.code not in self.notes or note.excess > self.notes[note.code].excess):
            self.notes[note.code] = replace(note, text=f"{note.text}, with the bit at {bit_depth:.0f} m")
