"""Modes in which a string would leave its balance, and what becomes of strings that have them."""

from pathlib import Path

import numpy as np
import pytest

from fctd import equilibrium, load_case
from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import dynamics, state
from fctd.mechanics.energy import energy_of
from fctd.mechanics.rotations import turned
from fctd.mechanics.state import LANES
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.block_thomas import negative_pivots
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from fctd.steady.pose import QUATERNION, SPIN
from fctd.steady.problem import FULL, Problem
from fctd.steady.stability import fastest_mode, push_aside
from tests.cases import make_case, pipe
from tests.steady.buckled import level_case, problem_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "horizontal_well.toml"


def hanging_case(weight_on_bit: float, **more: object) -> Case:
    """300 m of 5 in pipe in vertical hole of 12¼ in, in segments that follow its waves; its lower end is free."""
    hole = {
        "intervals": [{"to_md": 300.0, "diameter": 0.31115, "friction": 0.2}],
        "geometry": "arcs", "stiffness_per_length": 1e6,
    }  # fmt: skip
    part = pipe(None, None, inner=0.1086, segment_length=0.5)
    return make_case([[0, 0, 0], [300, 0, 0]], [part], wellbore=hole, bit={"weight_on_bit": weight_on_bit, **more})


def quadratic_form(problem: Problem, x: Array) -> float:
    """xᵀKx of shifts and tilts (n, 6) with the tangent that the problem's arrays contain [J]."""
    w, n = problem.work, problem.n
    product = np.einsum("jrc,jc->jr", w.D[1 : n + 1], x)
    product[1:] += np.einsum("jrc,jc->jr", w.A[2 : n + 1], x[:-1])
    product[:-1] += np.einsum("jrc,jc->jr", w.U[2 : n + 1], x[1:])
    return float((x * product).sum())


def energy(problem: Problem, P: Array) -> float:
    """Strain energy and weight of a string in a pose, by the stepper's joints [J]; its bends do not spin with it."""
    n, S = problem.n, state.copy_state(problem.work.S)
    for k, offset in enumerate((state.X, state.Y, state.Z, state.QW, state.QX, state.QY, state.QZ)):
        S[offset : offset + n + 1] = P[: n + 1, k]
    S[state.TURNS + 1 : state.TURNS + n + 1] = np.diff(P[: n + 1, SPIN])
    for k, offset in ((1, state.KINK_X), (2, state.KINK_Y)):
        S[offset : offset + n + 1] = problem.kinks[: n + 1, k]
    dynamics.update_axes(S, (n + LANES - 1) // LANES * LANES)
    found = energy_of(S, n)
    return found.strain + found.gravity


def bent_case(bend: float) -> Case:
    """A motor with a bend 2 m above the bit and two stabilisers, as wide as the hole; pipe that hangs above them.

    Of steel as heavy as mud below the pipe, which is slender: the assembly has no load but its bend.
    """
    light = pipe(None, None, outer=0.165, density=1201.0, segment_length=0.5)
    wide = light | {"length": 0.25, "contact_diameter": 0.2159, "segment_length": 0.25}
    spans = [light | {"length": length} for length in (1.75, 5.875, 8.75)]
    thin = pipe(None, None, outer=0.05, inner=0.03, bending_stiffness=10.0, segment_length=0.5)
    parts = [wide, spans[0] | {"bend": bend, "toolface": 0.7}, spans[1], wide, spans[2], wide, thin]
    hole = {"geometry": "arcs", "stiffness": 1e9, "intervals": [{"to_md": 40.0, "diameter": 0.2159, "friction": 0.0}]}
    return make_case([[0, 0, 0], [40, 0, 0]], parts, wellbore=hole, mud={"density": 1200.0})


def test_the_tangent_of_a_bent_string_is_the_second_derivative_of_its_energy() -> None:
    """Along any motion of the bodies above and below the bend, for a string far from balance."""
    case = bent_case(0.05)
    problem = problem_of(case.model_copy(update={"contact": case.contact.model_copy(update={"enabled": False})}))
    problem.lay_guess()
    rng, n, P = np.random.default_rng(2), problem.n, problem.work.P
    bent = int(np.hypot(problem.kinks[:, 1], problem.kinks[:, 2]).argmax())
    for j in range(1, n + 1):
        P[j, :3] += 1e-4 * rng.normal(size=3)
        P[j, QUATERNION] = turned(*P[j, QUATERNION], *(0.02 * rng.normal(size=2)), 0.0)
        P[j, SPIN] += 0.02 * rng.normal()
    for moves in (slice(3, 5), slice(5, 6), slice(0, 6)):
        x, h = np.zeros((n, 6)), 3e-4
        x[bent - 2 : bent, moves] = rng.normal(size=(2, 6))[:, moves]
        x[:, :3] *= 1e-3
        values = []
        for size in (-h, 0.0, h):
            Q = P.copy()
            for body in (bent - 1, bent):
                step = size * x[body - 1]
                Q[body, :3] += step[:3]
                Q[body, QUATERNION] = turned(*Q[body, QUATERNION], step[3], step[4], 0.0)
                Q[body, SPIN] += step[5]
            values.append(energy(problem, Q))
        problem.bare_tangent(FULL, 1e9)
        assert quadratic_form(problem, x) == pytest.approx((values[0] - 2 * values[1] + values[2]) / h**2, rel=1e-5)


@pytest.mark.parametrize("bend", [0.1, 1.0, 3.0])
def test_a_bent_housing_between_supports_is_stable(bend: float) -> None:
    """Its bend, in degrees, presses a stiff beam that no load compresses; at 1° a mode was counted, as its spin and
    what holds its toolface were taken for one."""
    problem = problem_of(bent_case(np.radians(bend)))
    assert balance(problem, ATTEMPTS)[::2] == (CONVERGED, 0)
    w, n = problem.work, problem.n
    problem.bare_tangent(FULL, 1e9)
    lower, upper = w.A[2 : n + 1], w.U[2 : n + 1].transpose(0, 2, 1)
    assert np.abs(lower - upper).max() < 1e-9 * np.abs(lower).max()
    twisted = w.D[1 : n + 1] - w.D[1 : n + 1].transpose(0, 2, 1)
    assert np.abs(twisted).max() < 1e-9 * np.abs(w.D[1 : n + 1]).max()


@pytest.mark.parametrize(("friction", "bit_depth"), [(0.1, 1100.0), (0.25, 1000.0), (0.2, 1100.0)])
def test_a_joint_on_a_shoe_is_stable(friction: float, bit_depth: float) -> None:
    """The wall at a shoe presses harder on a joint farther down, but not along the hole: half of that in the symmetric
    part counted a mode of a string in tension, which the tangent itself does not have.  Depths around meet the shoe."""
    case = load_case(EXAMPLE, {"friction": friction})
    solver, rates = Solver(case), steady_rates(case, "trip_out")
    for depth in bit_depth + np.linspace(-1.0, 1.0, 41):
        assert solver.solve("trip_out", rates, float(depth)).status == SteadyStatus.CONVERGED


def test_a_shoe_leaves_the_tangent_of_its_stability_symmetric() -> None:
    """A joint on a shoe of arcs, off its middle: what the wall changes along the hole is left out to rounding."""
    case = load_case(EXAMPLE, {"friction": 0.25})
    solver = Solver(case)
    problem = solver.problem("trip_out", steady_rates(case, "trip_out"), solver.lay_out(1000.0))
    assert balance(problem, ATTEMPTS)[0] == CONVERGED
    places = problem.reactions().contacts
    md = problem.walls(places).md
    assert ((md > 900.01) & (md < 900.99)).any()
    problem.bare_tangent(FULL, 1e9)
    D = problem.work.D[1 : problem.n + 1]
    assert np.abs(D - D.transpose(0, 2, 1)).max() < 20.0  # N/m, where the wall presses with 2e7


def test_a_string_below_its_onset_has_no_unstable_mode() -> None:
    problem = problem_of(level_case(0.4, length=60.0, segment=3.0))
    balance(problem, ATTEMPTS)
    assert fastest_mode(problem, FULL) is None
    pose = problem.copy_pose()
    assert push_aside(problem, FULL) is None
    np.testing.assert_array_equal(problem.copy_pose().P, pose.P)


def test_the_fastest_mode_has_negative_stiffness() -> None:
    problem = problem_of(level_case(1.3, length=150.0, segment=3.0))
    code, _, negative = balance(problem, ATTEMPTS)
    assert (code, negative > 0) == (CONVERGED, True)
    fastest = fastest_mode(problem, FULL)
    assert fastest is not None
    mode = fastest.shape
    # It is the one that does not grow in less than its time, found within a tenth.
    assert problem.unstable_modes(FULL, fastest.time) == 0 < problem.unstable_modes(FULL, 1.1 * fastest.time)
    w, n = problem.work, problem.n
    problem.bare_tangent(FULL, 1e9)
    assert quadratic_form(problem, mode) < 0
    assert negative_pivots(w.D, w.A, w.U, n) == negative


def test_a_push_leads_out_of_the_balance() -> None:
    problem = problem_of(level_case(1.3, length=150.0, segment=3.0))
    balance(problem, ATTEMPTS)
    straight = problem.reactions().contacts[:, :3].copy()
    assert push_aside(problem, FULL) is not None
    moved = np.linalg.norm(problem.reactions().contacts[:, :3] - straight, axis=1).max()
    clearance = 0.5 * (0.2159 - 0.127)
    assert 0.009 * clearance < moved < 0.7 * clearance


@pytest.mark.slow
@pytest.mark.parametrize(
    ("operation", "weight_on_bit"),
    [("drill_sliding", 9e3), ("drill_sliding", 12e3), ("drill_sliding", 23.8e3), ("drill_rotating", 9e3)],
)
def test_a_straight_string_above_its_onset_is_not_converged(weight_on_bit: float, operation: str) -> None:
    """2.9 to 7.6 times 1.02 (EI w²)^⅓, the onset of a free lower end: they were straight, without any wall force."""
    point = equilibrium(hanging_case(weight_on_bit), operation, 300.0)
    if operation == "drill_rotating":  # the buckled string rolls round the hole
        assert (point.status, point.total_contact_force) == ("unstable", pytest.approx(0.0, abs=1e-6))
        assert point.message.startswith(
            "the string would leave this balance, and the continuation found a steady shape"
        )
        assert "%, where the friction of rotation rolled the buckled string round the hole" in point.message
        return
    assert point.status == "converged"
    fine = hanging_case(weight_on_bit)
    fine = fine.model_copy(update={"solver": fine.solver.model_copy(update={"buckling": "resolve"})})
    resolved = equilibrium(fine, operation, 300.0)
    assert resolved.status == "converged"
    assert point.total_contact_force == pytest.approx(resolved.total_contact_force, rel=0.02)
    assert point.total_contact_force > 40.0
