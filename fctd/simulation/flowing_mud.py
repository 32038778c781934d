"""Mud that flows past a moving string: its pull where the pipe rests, as given loads, and the drag that motion adds.

Flow is quasi-steady.  What the motion of a body adds is linear in its speed, with the drag that the planned speed of
the string has, and acts implicitly: at that speed all loads are those of the steady formula.  Its work is lost to the
mud, and the work of the pull an entry of the ledger.
"""

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.hydraulics.channel import channel_of, has_flow_curve
from fctd.hydraulics.circuit import Circuit, circulate
from fctd.mechanics import state
from fctd.mechanics.topdrive import Motion, smooth_step
from fctd.model.drillstring import String

if TYPE_CHECKING:
    from fctd.simulation.run import Run

# Speed of a string that rests or creeps, for the drag on its swings [m/s]: a yield stress would hold it without limit.
SLOWEST: Final = 0.05


def pumps(case: Case) -> bool:
    """Whether an operation of a case pumps mud."""
    return case.mud.densest > 0 and any(operation.flow for operation in case.operations)


def is_driven(case: Case) -> bool:
    """Whether mud that flows acts on the string along the hole: it is pumped, or has a flow curve and is displaced."""
    return pumps(case) or (case.mud.axial_damping is None and has_flow_curve(case))


def let_flow(run: "Run", motion: Motion, at: float) -> Circuit:
    """Write the loads of the flow at a time [s] into the state of a run; returns the flow."""
    feed, flow = (
        smooth_step(at, motion.start, motion.duration, *ends)
        for ends in ((motion.feed_from, motion.feed_to), (motion.flow_from, motion.flow_to))
    )
    string, case = run.laid_out, run.case
    channel = channel_of(case, string, run.hole)
    resting = circulate(channel, flow)
    drag = None
    if case.mud.axial_damping is None:
        speed = math.copysign(max(abs(feed), SLOWEST), feed)
        moving = circulate(channel, flow, speed)
        drag = (resting.given - moving.given) / speed
    _write(run, string, resting.given, drag)
    return moving if drag is not None and speed == feed else resting


def _write(run: "Run", string: String, given: Array, drag: Array | None) -> None:
    """Write loads [N] and, where it is not the case's own, drag [N s/m] of the segments (n,)."""
    S, n = run.S, string.segments
    half = np.ones(n)
    if string.long_segment:  # half of it hangs on the top drive
        half[0] = 0.5
        run.pipe = run.pipe._replace(given=float(given[0] / string.length[0]))
    state.row(S, state.GIVEN_FORCE, n)[:] = half * given
    if drag is None:
        return
    if string.long_segment:
        run.pipe = run.pipe._replace(mud_axial=float(drag[0] / string.length[0]))
    state.row(S, state.MUD_AXIAL, n)[:] = half * drag
    if run.upper_end.in_derrick:
        share = state.row(S, state.IMMERSED, n)
        state.row(S, state.IN_MUD_AXIAL, n)[:] = drag / np.where(share > 0, share, 1.0)
