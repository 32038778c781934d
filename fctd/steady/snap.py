"""A snap of a string that is fed: its release into another shape while the block stands still.

The string is let go like one in a thick fluid, and friction follows every step: it takes up the energy that the snap
releases, along the whole way.  The step is ruled by its length and not by the damping.  A step that would move a point
farther than ``creep.shift`` is taken anew with a shorter pseudo-time τ, and the next τ is that with which the string
would move as far: τ² in M/τ² is a time over a damping, so that its first value and the damping cancel out.

A step of relaxation.py that is too long is scaled instead.  Its direction is that of its τ, and the shape in which the
string ends then depends on the τ it began with.

The way is not that of an arc length in feed (Riks 1979, Crisfield 1981).  That path turns back at the fold, and the
block has to be pulled up by centimetres to hold what snaps: friction between the two turns round, and what the string
carries when feed comes back is not what it carries after a snap.
"""

import numpy as np

from fctd.mechanics.jit import entry
from fctd.steady.block_thomas import eliminate
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS, NOT_FINITE, add_pseudo_mass, imbalance
from fctd.steady.held_friction import remember
from fctd.steady.relaxation import LONGEST, PLACES, find_arcs, find_places, largest_move, move
from fctd.steady.tangent import assemble

# A step is taken anew where it is longer than allowed by this factor.
TOO_LONG = 2.0
# τ changes by this factor at least, when a step is taken anew.
CUT = 0.1


@entry
def release(w, n, kinks, C, laws, creep):
    """Let a string go with friction that follows it; returns status and iterations.

    The arguments are those of ``relaxation.relax``; ``laws.held`` remembers each step.
    """
    S, P, _G, R, D, A, U, W, owner = w
    places, arcs = np.zeros((n + 1, PLACES)), np.zeros((n + 1, 3))
    tau = creep.tau
    for k in range(creep.iterations):
        assemble(S, n, P, kinks, C, owner, laws, R, D, A, U)
        error = imbalance(R, n, creep)
        if not error < np.inf:
            return NOT_FINITE, k
        if error <= 1:
            return CONVERGED, k
        add_pseudo_mass(S, n, tau, D)
        if not eliminate(D, A, U, R, n, W):
            tau *= creep.shrink
            continue
        find_places(S, n, P, C, owner, laws.geometry, places)
        moved = largest_move(S, n, P, R, places, creep)
        # A short step is as long as τ².
        as_long = 1 / np.sqrt(moved)
        if moved > TOO_LONG:
            tau *= max(CUT, as_long)
            continue
        find_arcs(S, n, P, R, 1.0, places, arcs)
        move(S, n, P, R, 1.0, arcs)
        remember(S, n, P, C, owner, laws)
        tau = creep.tau if tau > LONGEST else tau * min(creep.growth, max(creep.shrink, as_long))
    return MAX_ITERATIONS, creep.iterations
