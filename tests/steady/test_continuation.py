"""Newton's method with pseudo-time: its convergence, its ways to stop, and its step sizes."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.mechanics import state
from fctd.mechanics.law_names import CODES
from fctd.model.drillstring import lay_out
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.steady import continuation
from fctd.steady.continuation import (
    CONVERGED,
    MAX_ITERATIONS,
    NOT_FINITE,
    UNSOUND,
    Pace,
    add_pseudo_mass,
    converge,
    take_step,
)
from fctd.steady.equilibrium import Solver
from fctd.steady.first_guess import guess
from fctd.steady.problem import Workspace
from fctd.steady.tangent import Steady
from tests.cases import make_case, pipe
from tests.compiled import kept

allowed_share, imbalance = kept(continuation.allowed_share), kept(continuation.imbalance)

SEGMENTS = 6
# Steps of any size and a pseudo-time that soon leaves them to Newton's method alone.
BOLD = Pace(40, 1e3, 1e3, 1.0, 1e9, 1.0, 1e9, 1e-3, 1e-3)


class Chain:
    """60 m of pipe hung from a tilted top drive without a wall: smooth, and so bent that it is far from linear."""

    def __init__(self) -> None:
        case = make_case([[0, 5, 0], [60, 5, 0]], [pipe(60, SEGMENTS)], contact={"enabled": False})
        self.hole = Solver(case).hole
        self.work = Workspace(SEGMENTS)
        string = lay_out(case, 60.0)
        fill(self.work.S, string, case, build_wellbore(case))
        self.laws = Steady(state.OPEN, CODES["coulomb"], 1.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0)
        self.kinks = np.zeros((SEGMENTS + 2, 4))
        self.kinks[:, 0] = 1.0
        w = self.work
        guess(w.S, SEGMENTS, self.hole.pieces, self.laws, 0.0, 0.0, string.contact_radius(), 0.0, w.G, w.P)

    def soften(self) -> None:
        """Give the joints a tension and shear stiffness of 100 kN/m."""
        for row in (state.K_AXIAL, state.K_SHEAR):
            state.row(self.work.S, row, SEGMENTS)[:] = 1e5

    def converge(self, pace: Pace, tau: float | None = None) -> tuple[int, int, float]:
        """Status, iterations and last pseudo-time."""
        begun = pace.tau if tau is None else tau
        found: tuple[int, int, float] = converge(
            self.work, SEGMENTS, self.kinks, self.hole.pieces, self.laws, pace, begun
        )
        return found


def test_the_last_steps_converge_quadratically() -> None:
    """Poses of one more iteration each, against the last: an error [m] is less than that before it squared.

    Joints as soft in tension as in bending, and pulled aside by 0.3 kN at the bit: one scale of length for all errors.
    """
    poses = []
    for iterations in range(1, 11):
        chain = Chain()
        chain.soften()
        chain.laws = chain.laws._replace(bit_x=300.0)
        chain.converge(BOLD._replace(iterations=iterations, tau=1e9, force=1e-10, moment=1e-10))
        poses.append(chain.work.P[: SEGMENTS + 1, :3].copy())
    errors = np.array([np.abs(pose - poses[-1]).max() for pose in poses])
    near = np.flatnonzero((errors < 0.5) & (errors > 1e-7))
    assert len(near) >= 3
    assert (errors[near + 1] < errors[near] ** 2 + 1e-13).all(), errors


def test_a_pose_in_balance_is_not_changed() -> None:
    chain = Chain()
    status, iterations, _ = chain.converge(BOLD)
    assert status == CONVERGED
    assert 2 < iterations < BOLD.iterations
    assert imbalance(chain.work.R, SEGMENTS, BOLD) <= 1
    weight = float(state.row(chain.work.S, state.WEIGHT, SEGMENTS).sum())
    assert chain.work.R[0, :3] == pytest.approx([0, 0, weight], abs=1e-2)
    balance = chain.work.P.copy()
    assert chain.converge(BOLD)[:2] == (CONVERGED, 0)
    np.testing.assert_array_equal(chain.work.P, balance)


def test_too_few_iterations() -> None:
    assert Chain().converge(BOLD._replace(iterations=2))[:2] == (MAX_ITERATIONS, 2)


def test_a_pose_with_nan() -> None:
    chain = Chain()
    chain.work.P[3, 0] = np.nan
    assert chain.converge(BOLD)[:2] == (NOT_FINITE, 0)


def test_equations_that_elimination_cannot_solve() -> None:
    """A chain without stiffness at one joint, and without pseudo-mass, has a singular tangent."""
    chain = Chain()
    for row in (state.K_AXIAL, state.K_SHEAR, state.K_BEND, state.K_TWIST):
        chain.work.S[row + 4] = 0.0
    assert chain.converge(BOLD, tau=np.inf)[:2] == (UNSOUND, 0)


def test_pseudo_time_grows_with_every_step_that_is_not_shortened() -> None:
    assert Chain().converge(BOLD._replace(iterations=3, tau=0.1, growth=2.0))[2] == pytest.approx(0.1 * 2**2)
    assert Chain().converge(BOLD._replace(iterations=3, tau=0.1, growth=2.0, shift=1e-9))[2] == 0.1


def test_pseudo_mass_is_the_bodies_own_over_the_time_squared() -> None:
    S, D = Chain().work.S, np.zeros((SEGMENTS + 1, 6, 6))
    add_pseudo_mass(S, SEGMENTS, 0.5, D)
    mass, transverse, axial = (S[row + 2] for row in (state.MASS, state.J_TRANSVERSE, state.J_AXIAL))
    np.testing.assert_allclose(D[2], np.diag([mass, mass, mass, transverse, transverse, axial]) / 0.25, rtol=1e-14)
    assert not D[0].any()


def test_the_worst_body_is_the_imbalance() -> None:
    R = np.zeros((4, 6))
    R[0] = 1e9  # the top drive's reactions do not count
    R[1, :3], R[2, 3:] = [3.0, 4.0, 0.0], [0.0, 0.6, 0.8]
    pace = BOLD._replace(force=10.0, moment=0.5)
    assert imbalance(R, 3, pace) == pytest.approx(2.0)
    assert imbalance(R, 1, pace) == pytest.approx(0.5)
    R[3, 0] = np.inf
    assert np.isnan(imbalance(R, 3, pace))


def test_a_step_is_shortened_to_the_largest_shift_and_turn() -> None:
    """An upright body that is moved 0.3 m across, and one that is tilted by 0.5 rad about where its contact is."""
    S, P, X = state.new_state(2), np.zeros((3, 8)), np.zeros((3, 6))
    P[:, 3] = 1.0
    X[1, :3] = [0.3, 0.0, 5.0]  # its step along the axis has no limit
    X[2, 3] = 0.5
    assert allowed_share(S, 2, P, X, 0.1, 10.0) == pytest.approx(0.1 / 0.3)
    assert allowed_share(S, 2, P, X, 10.0, 0.2) == pytest.approx(0.2 / 0.5)
    assert allowed_share(S, 2, P, X, 10.0, 10.0) == 1.0
    S[state.ARM_CONTACT + 2] = 2.0
    assert allowed_share(S, 2, P, X, 0.1, 10.0) == pytest.approx(0.1 / (0.5 * 2.0))


def test_a_step_moves_tilts_and_spins() -> None:
    """Half of it: positions add up, a tilt is in the body's own frame, a spin is kept beside the quaternion."""
    P, X = np.zeros((2, 8)), np.zeros((2, 6))
    start = Rotation.from_rotvec([0.3, -0.4, 0.2])
    P[1, 3:7] = start.as_quat(scalar_first=True)
    X[1] = [1.0, 2.0, 3.0, 0.04, -0.02, 7.0]
    take_step(P, 1, X, 0.5)
    np.testing.assert_allclose(P[1, :3], [0.5, 1.0, 1.5])
    found = Rotation.from_quat(P[1, 3:7], scalar_first=True)
    expected = start * Rotation.from_rotvec([0.02, -0.01, 0.0])
    assert (found.inv() * expected).magnitude() < 1e-7
    assert P[1, 7] == 3.5
    assert not P[0].any()
