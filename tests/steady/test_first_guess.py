"""The first guess: the soft string of a straight hole against its closed forms."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd import Case
from fctd.mechanics import state
from fctd.mechanics.law_names import CODES
from fctd.model.drillstring import lay_out
from fctd.model.operations import steady_rates
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.steady.equilibrium import Solver
from fctd.steady.first_guess import MD, OFFSET, TENSION, TORQUE, guess
from fctd.steady.problem import Workspace
from fctd.steady.tangent import Steady
from tests.cases import make_case, pipe

LENGTH, SEGMENTS, CLEARANCE = 600.0, 30, 0.5 * (0.2159 - 0.127)
WEIGHT = 9.80665 * np.pi / 4 * (0.127**2 - 0.07**2) * (7850 - 1200)  # buoyed [N/m]
SINE, COSINE = np.sin(np.radians(40)), np.cos(np.radians(40))
ALONG = np.array([0.0, SINE, COSINE])


def inclined() -> Case:
    """A straight hole at 40 degrees towards the east."""
    stations = [[0, 40, 90], [LENGTH, 40, 90]]
    hole = {"geometry": "arcs", "stiffness": 1e9}
    return make_case(stations, [pipe(LENGTH, SEGMENTS)], mud={"density": 1200.0}, wellbore=hole)


def guessed(
    case: Case, kind: str, bit_tension: float = 0.0, seed: float = 0.0, given: tuple[float, float] = (0.0, 0.0)
) -> Workspace:
    """A solver's arrays with the guess of a whole string in its hole; given : to the tenth segment [N], [N m]."""
    solver, work = Solver(case), Workspace(SEGMENTS)
    string = lay_out(case, LENGTH)
    fill(work.S, string, case, build_wellbore(case))
    work.S[state.GIVEN_FORCE + 10], work.S[state.GIVEN_TORQUE + 10] = given
    rates = steady_rates(case, kind)
    laws = Steady(solver.geometry, CODES[case.contact.friction_law], 1.0, rates.speed, rates.spin, 0.0, 0.0, 0.0, 0.0)
    radius = string.contact_radius()
    guess(work.S, SEGMENTS, solver.hole.pieces, laws, 0.0, bit_tension, radius, seed, work.G, work.P)
    return work


@pytest.mark.parametrize(("kind", "sign"), [("trip_in", -1), ("trip_out", 1)])
def test_tension_of_a_string_that_slides(kind: str, sign: int) -> None:
    """At a distance s from the bit: w s (cos I ± μ sin I), down to what pulls at the bit."""
    work = guessed(inclined(), kind, bit_tension=5e3)
    above_bit = LENGTH - LENGTH / SEGMENTS * np.arange(SEGMENTS)
    expected = 5e3 + WEIGHT * above_bit * (COSINE + sign * 0.2 * SINE)
    # A node carries half a segment's weight of either neighbour; the lowest one half of its own, and none the top's.
    half = 0.5 * WEIGHT * LENGTH / SEGMENTS * sign * 0.2 * SINE
    assert work.G[0, TENSION] == pytest.approx(expected[0] - half, rel=1e-9)
    assert work.G[1:SEGMENTS, TENSION] == pytest.approx(expected[1:] + half, rel=1e-9)
    assert work.G[: SEGMENTS + 1, TORQUE] == pytest.approx(0.0, abs=1e-9)


def test_given_loads_add_to_what_is_above_them() -> None:
    without, work = guessed(inclined(), "trip_in"), guessed(inclined(), "trip_in", given=(3e4, -2e3))
    gained = (work.G - without.G)[: SEGMENTS + 1]
    above = np.arange(SEGMENTS + 1) < 10  # the node at its lower end is below it
    assert gained[:, TENSION] == pytest.approx(3e4 * above, abs=1e-6)
    assert gained[:, TORQUE] == pytest.approx(2e3 * (np.arange(SEGMENTS + 1) <= 10), abs=1e-6)


def test_torque_of_a_string_that_turns() -> None:
    """It climbs to the angle of friction, so that the wall's torque r w s sin I · μ/√(1 + μ²) resists and twists it.

    The upper half of the top segment presses on the top drive.
    """
    work = guessed(inclined(), "rotate_off_bottom")
    assert work.G[0, TENSION] == pytest.approx(WEIGHT * LENGTH * COSINE, rel=1e-9)
    share = 0.2 / np.sqrt(1 + 0.2**2)
    twist = work.G[:SEGMENTS, TORQUE] / state.row(work.S, state.K_TWIST, SEGMENTS)
    assert work.P[SEGMENTS, 7] == pytest.approx(-twist.sum(), rel=1e-12)
    weight = WEIGHT * (LENGTH - 0.5 * LENGTH / SEGMENTS)
    assert work.G[0, TORQUE] == pytest.approx(0.0635 * share * weight * SINE, rel=1e-9)


def test_the_string_lies_on_the_low_side() -> None:
    """A clearance from the axis, plus the penetration into the wall by its weight."""
    work = guessed(inclined(), "trip_out")
    low = np.array([0.0, -COSINE, SINE])
    depth = WEIGHT * LENGTH / SEGMENTS * SINE / 1e9
    inner = work.G[1:SEGMENTS, OFFSET : OFFSET + 3]
    np.testing.assert_allclose(inner, np.tile((CLEARANCE + depth) * low, (SEGMENTS - 1, 1)), atol=1e-12)


def test_the_chain_lies_along_the_hole_and_is_stretched_by_its_tension() -> None:
    """Between the first body, which leads from the axis to the wall, and the last, whose end presses half as much."""
    work = guessed(inclined(), "trip_out")
    S, P = work.S, work.P[: SEGMENTS + 1]
    np.testing.assert_allclose(np.linalg.norm(P[:, 3:7], axis=1), 1.0, atol=1e-12)
    axes = Rotation.from_quat(P[:, 3:7], scalar_first=True).apply([0, 0, 1])
    np.testing.assert_allclose(axes[2:SEGMENTS], np.tile(ALONG, (SEGMENTS - 2, 1)), atol=1e-9)
    ends = P[1:SEGMENTS, :3] + state.row(S, state.ARM_BOTTOM, SEGMENTS - 1)[:, None] * axes[1:SEGMENTS]
    stretch = work.G[1 : SEGMENTS - 1, TENSION] / state.row(S, state.K_AXIAL, SEGMENTS)[1 : SEGMENTS - 1]
    length = (state.row(S, state.ARM_TOP, SEGMENTS) + state.row(S, state.ARM_BOTTOM, SEGMENTS))[1 : SEGMENTS - 1]
    np.testing.assert_allclose(length, LENGTH / SEGMENTS, rtol=1e-5)  # squeezed by the mud
    np.testing.assert_allclose(np.diff(ends, axis=0) @ ALONG, length + stretch, rtol=1e-10)
    np.testing.assert_allclose(ends @ ALONG, work.G[1:SEGMENTS, MD], rtol=1e-10)


def test_a_hanging_string_is_seeded_to_the_side() -> None:
    """By the seed's length, so that a straight string may buckle, and no further than a tenth of the clearance."""
    case = make_case([[0, 0, 0], [LENGTH, 0, 0]], [pipe(LENGTH, SEGMENTS)], wellbore={"geometry": "arcs"})
    for seed, aside in ((0.0, 0.0), (1e-4, 1e-4), (1.0, 0.1 * CLEARANCE)):
        work = guessed(case, "trip_out", seed=seed)
        P = work.P[1 : SEGMENTS + 1]
        axes = Rotation.from_quat(P[:, 3:7], scalar_first=True).apply([0, 0, 1])
        ends = P[:, :3] + state.row(work.S, state.ARM_BOTTOM, SEGMENTS)[:, None] * axes
        np.testing.assert_allclose(np.hypot(ends[:, 0], ends[:, 1]), aside, rtol=1e-6, atol=1e-12)


def test_bodies_begin_on_the_line_of_their_tool_joints() -> None:
    """Laid on the wall between them they would be a zigzag; the tool joints touch, the bodies are as far aside."""
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    stations, hole = [[0, 40, 90], [LENGTH, 40, 90]], {"geometry": "arcs", "stiffness_per_length": 1e9}
    case = make_case(stations, [pipe(None, None, joint=joint, joint_segments=6)], wellbore=hole)
    solver = Solver(case)
    problem = solver.problem("trip_in", steady_rates(case, "trip_in"), solver.lay_out(LENGTH))
    problem.lay_guess()
    offset = np.linalg.norm(problem.work.G[1 : problem.n + 1, OFFSET : OFFSET + 3], axis=1)
    np.testing.assert_allclose(offset, 0.5 * (0.2159 - 0.165), atol=1e-5)
