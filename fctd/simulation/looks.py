"""What the guards look at in every record, compiled: whether there is anything that a note could say.

Most records have no notes.  A look takes a microsecond or two, where numpy takes ten times as long; the note itself,
with its text and place, is made in Python where a look has found something.
"""

import math

from fctd.mechanics.faults import worst_of
from fctd.mechanics.jit import entry
from fctd.mechanics.readings import drain_swing
from fctd.mechanics.state import K_WALL, WEIGHT, lateral_inverse_mass
from fctd.mechanics.topdrive import PULL_TIME, TOP_LENGTH
from fctd.results.run_notes import MOST_BEND, MOST_TWIST

# Time [s] over which the flutter of the hook load is read; it counts where it lasts for two such times, as the jolt of
# a start does not.
LISTEN = 1.0
# Cosines within which ``run_notes.beyond_joints`` has no note; where rounding could matter, it decides.
COS_BEND, COS_HALF_TWIST = math.cos(0.999 * MOST_BEND), math.cos(0.999 * MOST_TWIST / 2)


@entry
def is_sound(S, n):
    """Whether the state is finite and in the hole, and no joint of bodies 1..n is beyond its range."""
    finite, outside, bend, twist = worst_of(S, n)
    return finite and outside[0] <= 0 and bend[0] > COS_BEND and twist[0] > COS_HALF_TWIST


@entry
def listen(S, top, n, fed):
    """Read how the hook load swung, where it was listened to for ``LISTEN``; it then begins anew.

    fed : weight of the pipe fed at the top [N/m].  Returns the string's weight [N]; the lowest frequency of a segment
    on its wall spring [Hz], infinite without walls; the time listened [s], 0 where it was too short; and amplitude [N]
    and frequency [Hz] of the fast part of the hook load.
    """
    weight, square = 0.5 * fed * top[TOP_LENGTH], math.inf
    for j in range(1, n + 1):
        weight += S[WEIGHT + j]
        if S[K_WALL + j] > 0:
            square = min(square, S[K_WALL + j] * lateral_inverse_mass(S, j))
    on_wall, heard = math.sqrt(square) / (2 * math.pi), top[PULL_TIME]
    if heard < LISTEN:
        return weight, on_wall, 0.0, (0.0, 0.0)
    return weight, on_wall, heard, drain_swing(top)
