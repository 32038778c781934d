"""Mud that flows past a moving string: its pull where the pipe rests, as given loads, and the drag that motion adds.

Flow is quasi-steady.  What the motion of a body adds is linear in its speed, with the drag that the planned speed of
the string has, and acts implicitly: at that speed all loads are those of the steady formula.  Its work is lost to the
mud, and the work of the pull an entry of the ledger.
"""

import math
from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.hydraulics.channel import channel_of, has_flow_curve
from fctd.hydraulics.circuit import Circuit, circulate
from fctd.mechanics import state
from fctd.mechanics.topdrive import Motion, PerMetre, smooth_step
from fctd.model.drillstring import String
from fctd.model.wellbore import Wellbore

# Speed of a string that rests or creeps, for the drag on its swings [m/s]: a yield stress would hold it without limit.
SLOWEST: Final = 0.05
# For so long a string is taken to lie where it does [s], for the eccentricity of its annulus.
LIE_LASTS: Final = 10.0


def pumps(case: Case) -> bool:
    """Whether an operation of a case pumps mud."""
    return case.mud.densest > 0 and any(operation.flow for operation in case.operations)


def is_driven(case: Case) -> bool:
    """Whether mud that flows acts on the string along the hole: it is pumped, or has a flow curve and is displaced."""
    return pumps(case) or (case.mud.axial_damping is None and has_flow_curve(case))


def rates_at(motion: Motion, at: float) -> tuple[float, float]:
    """Feed downwards [m/s] and flow of the pumps [m³/s] at a time of a motion [s]."""
    feed, flow = (
        smooth_step(at, motion.start, motion.duration, *ends)
        for ends in ((motion.feed_from, motion.feed_to), (motion.flow_from, motion.flow_to))
    )
    return feed, flow


def let_flow(
    S: Array, case: Case, string: String, hole: Wellbore, pipe: PerMetre, feed: float, flow: float, *,
    in_derrick: bool = False,
) -> tuple[PerMetre, Circuit]:  # fmt: skip
    """Write the loads of the flow into a state; returns the pipe at the top, and the flow.

    string : laid out at its present depth; feed [m/s], flow [m³/s] : of ``rates_at``; in_derrick : whether its upper
    part is in air (derrick.py).
    """
    n, given = string.segments, case.mud.eccentricity
    channel = channel_of(case, string, hole, lie_of(S, string) if isinstance(given, str) else given)
    found = resting = circulate(channel, flow)
    half = np.ones(n)
    if string.long_segment:  # half of it hangs on the top drive
        half[0] = 0.5
        pipe = pipe._replace(given=float(resting.given[0] / string.length[0]))
    state.row(S, state.GIVEN_FORCE, n)[:] = half * resting.given
    if case.mud.axial_damping is not None:
        return pipe, found
    speed = math.copysign(max(abs(feed), SLOWEST), feed)
    moving = circulate(channel, flow, speed)
    drag = (resting.given - moving.given) / speed
    state.row(S, state.MUD_AXIAL, n)[:] = half * drag
    if string.long_segment:
        pipe = pipe._replace(mud_axial=float(drag[0] / string.length[0]))
    if in_derrick:
        share = state.row(S, state.IMMERSED, n)
        state.row(S, state.IN_MUD_AXIAL, n)[:] = drag / np.where(share > 0, share, 1.0)
    return pipe, moving if speed == feed else found


def lie_of(S: Array, string: String) -> Array:
    """Offset of each segment over its clearance (n,), 0 to 1, by its contact point; 0 where there is no wall."""
    n = string.segments
    offset = np.linalg.norm([state.row(S, row, n) for row in (state.PX, state.PY, state.PZ)], axis=0)
    clearance = state.row(S, state.HOLE, n) - string.channel_radii[0]
    return np.asarray(np.clip(offset / np.where(clearance > 0, clearance, np.inf), 0.0, 1.0))
