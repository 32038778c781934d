"""Friction that remembers: its derivative, its limit, and what it keeps from increment to increment."""

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics.rotations import rotation_columns, turned
from fctd.mechanics.state import ARM_BOTTOM
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.held_friction import ALONG_THEN, AROUND_THEN, MEMORY, PLACE_THEN, SPIN_THEN, Held, end_increment
from fctd.steady.pose import QUATERNION, SPIN
from fctd.steady.problem import Problem, Share
from fctd.steady.tangent import assemble
from tests.cases import make_case, pipe
from tests.steady.test_tangent import changed

FACTOR, AROUND = 0.3, 0.12


def lying(geometry: str = "arcs", around: float | None = None, **held: float) -> tuple[Problem, Array]:
    """A string at rest in a build and its memory: friction of random size at every point, within the limit."""
    interval = {"to_md": 800, "diameter": 0.2159, "friction": FACTOR}
    if around is not None:
        interval["rotational_friction"] = around
    case = make_case(
        [[0, 0, 30], [200, 0, 30], [500, 60, 60], [800, 85, 100]], [pipe(None, None, segment_length=20.0)],
        wellbore={"geometry": geometry, "intervals": [interval]}, bit={"weight_on_bit": 3e4, "torque": 2e3},
    )  # fmt: skip
    solver = Solver(case)
    rates = steady_rates(case, "drill_sliding")
    problem = solver.problem("drill_sliding", rates, solver.lay_out(790.0))
    problem.lay_guess()
    memory = np.zeros((problem.n + 2, MEMORY))
    ahead = problem.laid.bit_axis
    given = {"rock": 0.0, "level": 0.0, "torque": 0.0} | held
    problem.held = Held(memory, given["rock"], given["level"], *ahead.tolist(), given["torque"])
    remember(problem)
    memory[:, ALONG_THEN:] = 0.0
    return problem, memory


def remember(problem: Problem) -> None:
    w = problem.work
    end_increment(w.S, problem.n, w.P, problem.hole.pieces, w.owner, problem.laws(Share(1.0, 0.0)))


def normal_forces(problem: Problem) -> Array:
    return np.asarray(problem.reactions(Share(1.0, 0.0)).contacts[:, 3])


@pytest.mark.slow  # it compiles what nothing else here needs
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("around", [None, AROUND])
@pytest.mark.parametrize("slides", [False, True])
def test_tangent_is_the_derivative_of_the_forces(geometry: str, around: float | None, slides: bool) -> None:
    """Points that stick and points that slide, with the rock and a torque at the bit: central differences."""
    problem, memory = lying(geometry, around, rock=1e7, level=-1e6, torque=2e3)
    assert problem.held is not None
    problem.held = problem.held._replace(level=float(problem.work.P[problem.n, :3] @ problem.laid.bit_axis))
    problem.at_axis = 1
    w, n, rng = problem.work, problem.n, np.random.default_rng(1)
    size = 0.02 if slides else 1e-5
    memory[1 : n + 1, PLACE_THEN] -= size * rng.normal(size=(n, 3))
    memory[1 : n + 1, SPIN_THEN] -= size * rng.normal(size=n)
    P = w.P[: n + 1].copy()
    for j in range(1, n + 1):
        P[j, QUATERNION] = turned(*P[j, QUATERNION], *(1e-4 * rng.normal(size=2)), 0.0)
    R, (D, A, U) = np.zeros((n + 1, 6)), np.zeros((3, n + 1, 6, 6))
    laws = problem.laws(Share(1.0, 0.0))

    def forces(pose: Array) -> Array:
        assemble(w.S, n, pose, problem.kinks, problem.hole.pieces, w.owner, laws, R, D, A, U)
        return R.copy()

    forces(P)
    exact = D.copy()
    for j in (2, n // 2, n - 1, n):
        for k in range(6):
            h = 1e-8
            slope = -(forces(changed(P, j, k, h)) - forces(changed(P, j, k, -h))) / (2 * h)
            for part in (slice(0, 3), slice(3, 6)):
                largest = np.abs(exact[j, part]).max()
                assert np.abs(slope[j, part] - exact[j, part, k]).max() < 1e-5 * largest, (j, k)


@pytest.mark.parametrize("around", [None, AROUND])
def test_a_point_that_slides_has_the_limit_of_the_ellipse(around: float | None) -> None:
    problem, memory = lying(around=around)
    n, rng = problem.n, np.random.default_rng(2)
    memory[1 : n + 1, PLACE_THEN] -= rng.normal(size=(n, 3))
    memory[1 : n + 1, SPIN_THEN] -= 20 * rng.normal(size=n)
    remember(problem)
    normal, other = normal_forces(problem), FACTOR if around is None else around
    pressed = normal > 0
    assert pressed.sum() > n / 2
    along, round_it = memory[1 : n + 1, ALONG_THEN], memory[1 : n + 1, AROUND_THEN]
    share = np.hypot(along / (FACTOR * np.maximum(normal, 1e-9)), round_it / (other * np.maximum(normal, 1e-9)))
    assert share[pressed] == pytest.approx(1.0, rel=1e-9)
    assert not along[~pressed].any()


def test_a_point_that_sticks_takes_its_friction_along() -> None:
    """Within the limit forces add up from increment to increment, and without motion they stay."""
    problem, memory = lying()
    n, normal = problem.n, normal_forces(problem)
    memory[1 : n + 1, ALONG_THEN] = 0.5 * FACTOR * normal
    before = memory.copy()
    remember(problem)
    assert memory == pytest.approx(before, rel=1e-12, abs=1e-9)
    memory[1 : n + 1, SPIN_THEN] -= 1e-6
    remember(problem)
    pressed = normal > 0
    assert (memory[1 : n + 1, AROUND_THEN][pressed] < 0).all()
    assert memory[:, ALONG_THEN] == pytest.approx(before[:, ALONG_THEN])


def test_the_rock_presses_with_its_stiffness_and_lets_go() -> None:
    problem, _ = lying(rock=1e6, level=0.0)
    w, n, ahead = problem.work, problem.n, problem.laid.bit_axis
    assert problem.held is not None
    share = Share(1.0, 0.0)
    loads = []
    for beyond in (-0.01, 0.01):
        axis = np.array(rotation_columns(*w.P[n, QUATERNION])[6:])
        bit = float((w.P[n, :3] + w.S[ARM_BOTTOM + n] * axis) @ ahead)
        problem.held = problem.held._replace(level=bit - beyond)
        problem.reactions(share)
        loads.append(w.R[n, :3].copy())
    assert (loads[1] - loads[0]) @ ahead == pytest.approx(-1e4, rel=1e-6)


def test_spin_alone_turns_friction_round_the_string() -> None:
    problem, memory = lying()
    n = problem.n
    problem.work.P[1 : n + 1, SPIN] += 1.0
    remember(problem)
    pressed = normal_forces(problem) > 0
    assert (memory[1 : n + 1, AROUND_THEN][pressed] < 0).all()
    assert np.abs(memory[1 : n + 1, ALONG_THEN]).max() < 1e-6 * np.abs(memory[1 : n + 1, AROUND_THEN]).max()
