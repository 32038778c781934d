"""The forces of the steady string: their derivative, and their agreement with the stepper's."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.mechanics import dynamics, joints, state
from fctd.mechanics.law_names import CODES
from fctd.mechanics.rotations import turned
from fctd.mechanics.state import LANES, Laws
from fctd.mechanics.stored_walls import update_walls
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.pose import QUATERNION, SPIN, times
from fctd.steady.tangent import Steady, assemble
from tests.cases import make_case, pipe
from tests.compiled import kept

update_joint_loads, update_velocities = kept(joints.update_joint_loads), kept(dynamics.update_velocities)
BUILD = [[0, 0, 30], [200, 0, 30], [500, 60, 60], [800, 85, 100]]


def case_of(geometry: str, law: str, **more: Any) -> Case:
    """Collars, a bent housing, a stabiliser and pipe with tool joints, in two sizes of hole and damping mud."""
    components = [
        pipe(30, 3, outer=0.165, bend=0.02, toolface=1.0),
        pipe(2, 1, outer=0.165, contact_diameter=0.21),
        pipe(90, 6, outer=0.165),
        pipe(None, None, segment_length=20.0, contact_diameter=0.16),
    ]
    hole = {
        "geometry": geometry,
        "intervals": [
            {"to_md": 400, "diameter": 0.3, "friction": 0.2},
            {"to_md": 800, "diameter": 0.2159, "friction": 0.3},
        ],
    }
    mud = {"density": 1200.0, "axial_damping": 2.0, "rotational_damping": 0.5}
    bit = {"weight_on_bit": 3e4, "torque": 2e3}
    return make_case(BUILD, components, wellbore=hole, mud=mud, bit=bit, contact={"friction_law": law}, **more)


def laws_of(solver: Solver, kind: str, at_axis: int = 0) -> Steady:
    """The laws of an operation, with the bit pushed up a slanting hole."""
    rates = steady_rates(solver.case, kind)
    push = np.array([0.3, -0.2, -0.9]) * (3e4 if KINDS[kind].on_bottom else 0.0)
    torque = 2e3 if KINDS[kind].on_bottom else 0.0
    law = CODES[solver.case.contact.friction_law]
    return Steady(solver.geometry, law, 1.0, rates.speed, rates.spin, *push, torque, at_axis)


def changed(P: Array, j: int, k: int, by: float) -> Array:
    """The pose with unknown k of body j changed."""
    out = P.copy()
    if k < 3:
        out[j, k] += by
    elif k < 5:
        tilt = [by, 0.0] if k == 3 else [0.0, by]
        out[j, 3:7] = turned(*out[j, 3:7], *tilt, 0.0)
    else:
        out[j, 7] += by
    return out


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("law", ["coulomb", "paper"])
@pytest.mark.parametrize(
    ("kind", "at_axis"), [("trip_in", 0), ("back_ream", 0), ("drill_rotating", 0), ("drill_rotating", 1)]
)
def test_tangent_is_the_derivative_of_the_forces(geometry: str, law: str, kind: str, at_axis: int) -> None:
    """Central differences of the same forces, body by body, away from balance."""
    solver = Solver(case_of(geometry, law))
    point = solver.solve(kind, steady_rates(solver.case, kind), 790.0)
    w, laws, pieces = solver.work, laws_of(solver, kind, at_axis), solver.hole.pieces
    n = len(point.profile) - 1
    for row, load in ((state.GIVEN_FORCE, 2e4), (state.GIVEN_TORQUE, -1e3)):
        state.row(w.S, row, n)[::3] = load
    kinks = np.zeros((n + 2, 4))
    kinks[:, 0] = 1.0
    kinks[n - 2] = np.cos(0.01), 0.006, 0.008, 0.0
    rng = np.random.default_rng(1)
    P = w.P[: n + 1].copy()
    for j in range(1, n + 1):
        P[j, :3] += 1e-4 * rng.normal(size=3)
        P[j, QUATERNION] = turned(*P[j, QUATERNION], *(1e-3 * rng.normal(size=2)), 0.0)
    R, (D, A, U) = np.zeros((n + 1, 6)), np.zeros((3, n + 1, 6, 6))

    def forces(pose: Array) -> Array:
        assemble(w.S, n, pose, kinks, pieces, w.owner, laws, R, D, A, U)
        return R.copy()

    forces(P)
    exact = D.copy(), A.copy(), U.copy()
    for j in (1, 2, n // 2, n - 3, n - 2, n - 1, n):
        for k in range(6):
            h = 1e-7 if k < 3 else 1e-8
            slope = -(forces(changed(P, j, k, h)) - forces(changed(P, j, k, -h))) / (2 * h)
            blocks = [(j, exact[0][j, :, k])]
            blocks += [(j + 1, exact[1][j + 1, :, k])] if j < n else []
            blocks += [(j - 1, exact[2][j, :, k])] if j > 1 else []
            for row, column in blocks:
                # Forces and moments each against the largest entry of their column: the rounding of h.
                for part in (slice(0, 3), slice(3, 6)):
                    largest = np.abs(exact[0][j, part]).max()
                    assert np.abs(slope[row, part] - column[part]).max() < 2e-6 * largest, (row, j, k)
            others = np.delete(slope, [j - 1, j, *([j + 1] if j < n else [])], axis=0)
            np.testing.assert_array_equal(others, 0.0)


@pytest.mark.parametrize("kind", ["trip_out", "rotate_off_bottom", "back_ream"])
@pytest.mark.parametrize("law", ["coulomb", "paper"])
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_the_stepper_does_not_accelerate_a_steady_string(kind: str, law: str, geometry: str) -> None:
    """A string in balance by the steady solver stays in balance when the stepper moves it at the same rate."""
    case = make_case(
        BUILD,
        [pipe(100, 5, outer=0.165), pipe(None, None, segment_length=20.0, contact_diameter=0.16)],
        wellbore={"geometry": geometry},
        contact={"friction_law": law},
    )
    solver = Solver(case)
    rates = steady_rates(case, kind)
    point = solver.solve(kind, rates, 800.0)
    assert point.status == "converged"
    w, n = solver.work, len(point.profile) - 1
    S = state.copy_state(w.S)
    for k, offset in enumerate((state.X, state.Y, state.Z, state.QW, state.QX, state.QY, state.QZ)):
        S[offset : offset + n + 1] = w.P[: n + 1, k]
    S[state.TURNS + 1 : state.TURNS + n + 1] = np.diff(w.P[: n + 1, SPIN])
    packed = (n + LANES - 1) // LANES * LANES
    dynamics.update_axes(S, packed)
    # So slow that following the hole's curvature takes no noticeable force, and never near the clamp.
    slow = 1e-3
    walls = solver.hole.at(point.profile["md_m"].to_numpy()[1:])[1]
    for k, offset in enumerate((state.VX, state.VY, state.VZ)):
        state.row(S, offset, n)[:] = slow * rates.speed * walls[:, k]
    state.row(S, state.WZ, n)[:] = slow * rates.spin
    dynamics.update_axes(S, packed)
    laws = Laws(solver.geometry, CODES[case.contact.friction_law], 1.0, 0.0, 0.0, 0.0)
    dt = 1e-9
    before = state.copy_state(S)
    update_joint_loads(S, packed, 0.0, dt)
    update_walls(S, w.owner, n, packed, solver.hole.pieces, solver.geometry)
    update_velocities(S, packed, laws, dt)
    weight = float(state.row(S, state.WEIGHT, n).sum())
    for velocity in (state.VX, state.VY, state.VZ):
        change = state.row(S, velocity, n) - state.row(before, velocity, n)
        assert np.abs(state.row(S, state.MASS, n) * change / dt).max() < 2e-3 * weight / n
    spin = state.row(S, state.WZ, n) - state.row(before, state.WZ, n)
    assert np.abs(state.row(S, state.J_AXIAL, n) * spin / dt).max() < 2e-3 * 0.1 * weight / n


def test_a_torque_at_the_bit_does_no_work_on_a_string_that_rolls() -> None:
    """The bit's axis goes round a cone of half angle β about the hole's, while the bit does not turn.

    Exact: a torque about the bit's own axis does work on it, by the solid angle of the cone, 2π(1 − cos β).
    """
    solver = Solver(make_case([[0, 0, 0], [300, 0, 0]], [pipe(None, None, segment_length=30.0)]))
    problem = solver.problem("drill_sliding", steady_rates(solver.case, "drill_sliding"), solver.lay_out(300.0))
    problem.lay_guess()
    w, n, torque, tilt, parts = problem.work, problem.n, 5e3, 0.02, 400
    work = {}
    for at_axis in (0, 1):
        laws = Steady(state.OPEN, 0, 1.0, 0.0, 0.0, 0.0, 0.0, -1e4, torque, at_axis)
        still = laws._replace(bit_torque=0.0)
        frames = [turned(1.0, 0.0, 0.0, 0.0, tilt * np.cos(a), tilt * np.sin(a), 0.0)
                  for a in 2 * np.pi * np.arange(parts + 1) / parts]  # fmt: skip
        total = 0.0
        for before, after in pairwise(frames):
            middle = np.add(before, after) / np.linalg.norm(np.add(before, after))
            w.P[n, QUATERNION] = middle
            loads = []
            for of in (laws, still):
                assemble(w.S, n, w.P, problem.kinks, solver.hole.pieces, w.owner, of, w.R, w.D, w.A, w.U)
                loads.append(w.R[n, 3:6].copy())
            # The rotation from one frame to the next, in the frame between them.
            step = 2 * np.array(times(middle[0], *-middle[1:], *np.subtract(after, before)))[1:]
            total += float((loads[0] - loads[1]) @ step)
        work[at_axis] = total
    assert abs(work[0]) == pytest.approx(torque * 2 * np.pi * (1 - np.cos(tilt)), rel=1e-3)
    assert abs(work[1]) < 1e-3 * abs(work[0])
