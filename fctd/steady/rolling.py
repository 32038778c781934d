"""A turning string that rolls slowly round a vertical hole: a steady motion in a frame that goes round with it.

A compressed string in a vertical hole leaves the axis and lies on the wall, where nothing holds it in one direction.
The wall's friction, which resists its rotation, drives it round the hole the other way, until the mud resists as much:
a whirl with slip.  In the frame that goes round at the rate Ω the shape stands still.  With c and m a body's lateral
damping and mass, p its offset from the hole's axis t and L its length, the loads out of balance are those of a steady
string and

    −c Ω t × p,  m Ω² p,  and the moment −c L²/12 Ω t⊥ of the mud on a segment that swings about its centre.

Ω is one more unknown.  Its equation fixes the angle of the shape round the hole: a step has no part along φ, the motion
of all bodies round the axis, (t × p; t·x, t·y, t·z − 1), in which the springs do no work.

The string begins in the shape of its balance without friction, and friction rises from there.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.message import within
from fctd.case.solver import RESOLVING
from fctd.mechanics import state
from fctd.results.status import SteadyStatus
from fctd.steady.block_thomas import SIZE, eliminate
from fctd.steady.climb import come_to_rest
from fctd.steady.continuation import CONVERGED, add_pseudo_mass
from fctd.steady.findings import Findings
from fctd.steady.pose import PLACE, QUATERNION
from fctd.steady.post_buckling import LAYOUTS, finer_case, planned_lengths, shorter
from fctd.steady.problem import Problem, Share
from fctd.steady.relaxation import move_round
from fctd.steady.steady_string import Equilibrium
from fctd.steady.tangent import assemble

REST_ITERATIONS = 600
# Steps of the share of the friction: the first, the smallest, and growth of the next one.
FIRST_STEP, SMALLEST_STEP, GROWTH = 0.25, 0.03, 1.5
# Of a step: iterations, first pseudo-time [s], its growth after a step that was not shortened, its factors after one
# that was and after one that raised the imbalance more than tenfold, and its largest value.
ITERATIONS, TAU, FASTER, SLOWER, BACK, LONGEST = 60, 0.3, 2.0, 0.7, 0.3, 1e4
# Largest lateral step as a share of the clearance and at least [m], and largest tilt [rad].
SHIFT, LEAST_SHIFT, TILT = 0.1, 2e-3, 0.05


class Roll(NamedTuple):
    """A rolling string, in the pose of its problem.

    rate : Ω [rad/s], below 0 against a clockwise rotation; imbalance : largest force out of balance [N]; iterations;
    friction : share of the friction up to which it was found.
    """

    rate: float
    imbalance: float
    iterations: int
    friction: float


class _Frame(NamedTuple):
    """The string in its pose against the hole's axis, a row per body.

    x, y, z : axes of the bodies; p : offset of their centres from the axis of the hole [m]; clearance [m]; pressed :
    how deep contact points are in the wall [m].
    """

    x: Array
    y: Array
    z: Array
    p: Array
    clearance: Array
    pressed: Array


def rolled(_: Problem, so_far: Findings) -> Equilibrium | None:
    """The string as it rolls round the hole; where it was found with less friction only, the message says so."""
    unstable, problem = so_far.found, so_far.lay_anew()
    found = roll(problem)
    if found.friction > 0 and so_far.case.solver.buckling in RESOLVING:
        problem, found = _on_finer_segments(problem, found, so_far)
    if found.friction < 1:
        if found.friction > 0:
            upto = f"its slow roll round the hole was followed up to {100 * found.friction:.3g} % of the friction"
            so_far.found = replace(unstable, message=f"{within(unstable.message)}; {upto}")
        return None
    rolling = so_far.answer(problem, CONVERGED, unstable.iterations + found.iterations, 0)
    if rolling.status not in (SteadyStatus.CONVERGED, SteadyStatus.UNDER_RESOLVED):
        return None
    way = "against" if found.rate * problem.rates.spin < 0 else "with"
    text = f"the string rolls round the hole {abs(found.rate) * 30 / np.pi:.2g} times a minute, {way} its rotation"
    coarse = rolling.status == SteadyStatus.UNDER_RESOLVED
    return replace(
        rolling,
        status=rolling.status if coarse else SteadyStatus.ROLLING,
        message=f"{text}; {within(rolling.message)}" if coarse else text,
        imbalance=found.imbalance,
        roll_rate=found.rate,
    )


def _on_finer_segments(problem: Problem, found: Roll, so_far: Findings) -> tuple[Problem, Roll]:
    """Problem and roll of a string on segments that can bend as it does, or on the shortest that it may have."""
    needed = None
    for _ in range(LAYOUTS):
        planned = planned_lengths(problem.compressed(), problem.weight)
        needed = planned if needed is None else shorter(needed, planned)
        finer = finer_case(so_far.case, problem, needed)
        if finer is None:
            break
        problem, before = so_far.lay_finer(finer), found.iterations
        found = roll(problem)
        found = found._replace(iterations=before + found.iterations)
    return problem, found


def roll(problem: Problem) -> Roll:
    """The string of a problem as it rolls round a vertical hole, up to all of the friction or to the last share of it.

    The pose of the problem is that of the last one found, with loads at the string's surface.  A string that rolls
    without slipping, as fast as its surface turns, is not looked for: its friction hangs on the slip that is left.
    """
    problem.at_axis = 1  # no torque at the bit drives a shape at rest round the hole
    problem.lay_guess(Share(0.0))
    code, done = come_to_rest(problem, REST_ITERATIONS, Share(0.0))
    problem.at_axis = 0
    last, step = Roll(0.0, np.inf, done, 0.0), FIRST_STEP
    while code == CONVERGED and last.friction < 1 and step > SMALLEST_STEP:
        kept = problem.copy_pose()
        found = _settle(problem, min(last.friction + step, 1.0), last.rate)
        done += found.iterations
        if found.imbalance <= problem.allowed:
            last, step = found, GROWTH * step
        else:
            problem.put_pose(kept)
            step *= 0.5
    return last._replace(iterations=done)


def _settle(problem: Problem, friction: float, rate: float) -> Roll:
    """Newton's method for pose and rate at a share of the friction, with a pseudo-time; see the head of the file."""
    w, n, axis = problem.work, problem.n, problem.laid.bit_axis
    S, pieces, laws = w.S, problem.hole.pieces, problem.laws(Share(friction))
    mass, drag, radius = (state.row(S, of, n) for of in (state.MASS, state.MUD_LATERAL, state.RADIUS))
    rocking = drag * (state.row(S, state.ARM_TOP, n) + state.row(S, state.ARM_BOTTOM, n)) ** 2 / 12
    inertia = np.column_stack(
        [state.row(S, of, n) for of in (*(state.MASS,) * 3, *(state.J_TRANSVERSE,) * 2, state.J_AXIAL)]
    )
    tau, before, worst = TAU, np.inf, np.inf
    for k in range(ITERATIONS):
        at = _frame(problem, axis)
        # The surface of a string that rolls slides more slowly along the wall.
        deep = at.pressed.sum()
        ratio = float((at.clearance / radius * at.pressed).sum() / deep) if deep > 0 else 0.0
        slid = laws._replace(spin=laws.spin + rate * ratio)
        assemble(S, n, w.P, problem.kinks, pieces, w.owner, slid, w.R, w.D, w.A, w.U)
        around, tilts = np.cross(axis, at.p), np.column_stack([at.x @ axis, at.y @ axis])
        by_rate = np.zeros((n, SIZE))  # of the loads that the way round adds
        by_rate[:, :3] = 2 * (mass * rate)[:, None] * at.p - drag[:, None] * around
        by_rate[:, 3:5] = -rocking[:, None] * tilts
        left = w.R[1 : n + 1].copy()
        left[:, :3] += (mass * rate**2)[:, None] * at.p - rate * drag[:, None] * around
        left[:, 3:5] -= rate * rocking[:, None] * tilts
        force, moment = np.linalg.norm(left[:, :3], axis=1).max(), np.linalg.norm(left[:, 3:], axis=1).max()
        worst = float(max(force, moment))
        if not problem.allowed < worst < np.inf:
            return Roll(rate, worst, k, friction)
        _add_way_round(w.D[1 : n + 1], axis, rate * drag, mass * rate**2)
        tau *= BACK if worst > 10 * before else 1.0
        before = worst
        add_pseudo_mass(S, n, tau, w.D)
        step, by = _solved(problem, left), _solved(problem, by_rate)
        along = inertia * np.column_stack([around, tilts, at.z @ axis - 1])
        turned = float((along * by).sum())
        more = -float((along * step).sum()) / turned if turned != 0 else 0.0
        step += more * by
        sideways = np.linalg.norm(step[:, :3] - np.outer(step[:, :3] @ axis, axis), axis=1)
        limit = np.maximum(SHIFT * at.clearance, LEAST_SHIFT)
        part = 1 / max((sideways / limit).max(), np.linalg.norm(step[:, 3:5], axis=1).max() / TILT, 1.0)
        move_round(S, n, w.P, pieces, w.owner, laws.geometry, np.vstack([np.zeros((1, SIZE)), step]), part)
        rate = float(rate + part * more)
        tau = min(tau * (FASTER if part == 1 else SLOWER), LONGEST)
    return Roll(rate, worst, ITERATIONS, friction)


def _solved(problem: Problem, loads: Array) -> Array:
    """The step of the bodies under loads (n, 6), by the tangent of the workspace."""
    w, n = problem.work, problem.n
    w.R[1 : n + 1] = loads
    eliminate(w.D, w.A, w.U, w.R, n, w.W)
    return w.R[1 : n + 1].copy()


def _add_way_round(D: Array, axis: Array, drag: Array, pull: Array) -> None:
    """Add to the diagonal blocks (n, 6, 6) what drag c Ω [N/m] and centrifugal force m Ω² [N/m] of the way round do."""
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    D[:, :3, :3] += drag[:, None, None] * across - pull[:, None, None] * (np.eye(3) - np.outer(axis, axis))


def _frame(problem: Problem, axis: Array) -> _Frame:
    w, n = problem.work, problem.n
    pose = w.P[1 : n + 1]
    a, b, c, d = pose[:, QUATERNION].T
    x = np.column_stack([1 - 2 * (c * c + d * d), 2 * (b * c + a * d), 2 * (b * d - a * c)])
    y = np.column_stack([2 * (b * c - a * d), 1 - 2 * (b * b + d * d), 2 * (c * d + a * b)])
    z = np.column_stack([2 * (b * d + a * c), 2 * (c * d - a * b), 1 - 2 * (b * b + c * c)])
    lever = state.row(w.S, state.ARM_CONTACT, n)[:, None] * z
    walls = problem.hole.walls(pose[:, PLACE] + lever, w.owner[1 : n + 1], problem.string.contact_radius())
    clearance = np.maximum(walls.radius - state.row(w.S, state.RADIUS, n), 1e-4)
    p = walls.offset - lever
    return _Frame(
        x, y, z, p - np.outer(p @ axis, axis), clearance,
        np.maximum(np.linalg.norm(walls.offset, axis=1) - clearance, 0.0),
    )  # fmt: skip
