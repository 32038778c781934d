"""Modes in which a string would leave its balance, and a push along the fastest of them.

A balance is stable where the symmetric part of the tangent K of springs, weight and wall is positive definite.  With
the pseudo-mass of the relaxation, K + M/τ² has a negative pivot for each mode that grows faster than in the time τ: the
largest τ without one is the time of the fastest mode, and inverse iteration there gives its shape.  An aimless push has
little of that shape in it, and the steps of the relaxation, which become Newton's, lead back to the balance before it
has grown.
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state
from fctd.steady.block_thomas import SIZE, eliminate
from fctd.steady.problem import SLOWEST, Problem, Share
from fctd.steady.relaxation import move_round
from fctd.steady.tangent import assemble

# The pseudo-time of the fastest mode is found within this factor, from a time of which no mode is [s].
WITHIN, FASTEST = 1.1, 1e-4
INVERSE_ITERATIONS = 3
# First push, as a share of the clearance; it is doubled up to so many times while the forces drive the string on.
PUSH, DOUBLINGS = 0.01, 6
# Least clearance that a push is measured by [m].
NARROWEST = 1e-4


class Mode(NamedTuple):
    """An unstable mode: shift and tilt (n, 6), its largest shift 1, and the time in which it grows [s]."""

    shape: Array
    time: float


def fastest_mode(problem: Problem, share: Share) -> Mode | None:
    """The fastest unstable mode of a string in balance, None where it is stable."""
    if problem.unstable_modes(share) == 0:
        return None
    low, high = FASTEST, SLOWEST
    while high > WITHIN * low:
        tau = float(np.sqrt(low * high))
        low, high = (low, tau) if problem.unstable_modes(share, tau) else (tau, high)
    w, n = problem.work, problem.n
    rows = (*(state.MASS,) * 3, *(state.J_TRANSVERSE,) * 2, state.J_AXIAL)
    mass = np.column_stack([state.row(w.S, offset, n) for offset in rows])
    mode = np.random.default_rng(0).uniform(-1.0, 1.0, (n, 6))
    for _ in range(INVERSE_ITERATIONS):
        problem.bare_tangent(share, low)
        w.R[1 : n + 1] = mass * mode
        eliminate(w.D, w.A, w.U, w.R, n, w.W)
        mode = w.R[1 : n + 1] / np.abs(w.R[1 : n + 1, :3]).max()
    return Mode(mode, low)


def push_aside(problem: Problem, share: Share, *, if_driven: bool = False) -> float | None:
    """Push a string out of the balance of some loads that it would leave; returns in which time [s], None for never.

    if_driven : only where its forces, friction among them, drive it on.
    """
    fastest = fastest_mode(problem, share)
    if fastest is None:
        return None
    mode, n = fastest.shape, problem.n
    walls = problem.walls(problem.reactions(share).contacts)
    clearance = np.maximum(walls.radius - problem.string.contact_radius(), NARROWEST)
    arm = np.abs(state.row(problem.work.S, state.ARM_CONTACT, n))
    moved = np.linalg.norm(mode[:, :3], axis=1) + arm * np.linalg.norm(mode[:, 3:5], axis=1)
    balance, size = problem.copy_pose(), PUSH / (moved / clearance).max()
    for doubling in range(DOUBLINGS):
        _shift(problem, mode, 2 * size)
        drives = _driving(problem, mode, share) > 0
        problem.put_pose(balance)
        if not drives:
            if if_driven and doubling == 0:
                return None
            break
        size *= 2
    _shift(problem, mode, size)
    return fastest.time


def _shift(problem: Problem, mode: Array, size: float) -> None:
    """Move the string by a multiple of a mode (n, 6)."""
    w, n, step = problem.work, problem.n, np.vstack([np.zeros((1, SIZE)), mode])
    move_round(w.S, n, w.P, problem.hole.pieces, w.owner, problem.laws().geometry, step, size)


def _driving(problem: Problem, mode: Array, share: Share) -> float:
    """Work of the forces out of balance along a mode, which drive the string on where it is positive."""
    w, n = problem.work, problem.n
    assemble(w.S, n, w.P, problem.kinks, problem.hole.pieces, w.owner, problem.laws(share), w.R, w.D, w.A, w.U)
    return float((w.R[1 : n + 1] * mode).sum())
