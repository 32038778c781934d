"""The wall force of waves on coarse strings: the force it transmits, what includes it, and where it ends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import fctd
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.operations import steady_rates
from fctd.model.section import Section, section_of
from fctd.results.status import SteadyStatus
from fctd.steady.attempts import EARLY, HOMOGENISED, TOO_MUCH
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from fctd.steady.problem import Problem
from fctd.steady.wave_force import WaveForce, press, snaking_over_helix
from references.buckling.mitchell import UNIT, snaking
from references.soft_string.directions import associated
from tests.steady.buckled import HOLE, level_case, with_tables

FRICTION, PUSHED = 0.3, 1.5  # times the onset, above the helical limit of 1.41


def analytic(case: Case, **contact: str) -> Case:
    changes = {"helical_force": "analytic", **contact}
    return case.model_copy(update={"contact": case.contact.model_copy(update=changes)})


def section(case: Case) -> Section:
    return section_of(case.string.components[0], case.mud.density)


def helix_force(case: Case, compression: float) -> float:
    """r F²/4EI [N/m] (Mitchell 1986)."""
    pipe = section(case)
    return (0.5 * HOLE - pipe.contact_radius) * compression**2 / (4 * pipe.EI)


def lock_up_length() -> float:
    """4EI/(μ r F₀) [m]."""
    case = level_case(PUSHED)
    push = case.bit.weight_on_bit
    return push / (FRICTION * helix_force(case, push))


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_the_push_through_a_level_helix_follows_the_reciprocal_law(share: float) -> None:
    """1/F₀ − 1/F(x) = μ r x/4EI, whatever the segments; without the force it is far less."""
    length = share * lock_up_length()
    case = level_case(PUSHED, length, 15.0, friction=FRICTION)
    law = case.bit.weight_on_bit / (1 - share)
    point = fctd.equilibrium(analytic(case), "drill_sliding", length)
    assert -point.hookload == pytest.approx(law, rel=0.03)
    assert -fctd.equilibrium(case, "drill_sliding", length).hookload < 0.9 * law
    assert point.status == SteadyStatus.LOCKED_UP  # this rig cannot push
    assert "analytic" in point.message


def test_profile_and_sums_include_the_force() -> None:
    length = 300.0
    case = level_case(PUSHED, length, 20.0, friction=FRICTION)
    point = fctd.equilibrium(analytic(case), "drill_sliding", length)
    inside = point.profile.iloc[2:-2]
    force = [20.0 * helix_force(case, push) for push in -inside["effective_tension_N"]]
    # The tension of a contact point is that below it, without the friction there (2 % of it, 4 % of its square).
    np.testing.assert_allclose(inside["contact_force_N"], force, rtol=0.05)
    assert (inside["buckling"] == "helical").all()
    assert point.total_contact_force == pytest.approx(point.profile["contact_force_N"].sum())
    assert point.sum_r_mu_fn == pytest.approx(section(case).contact_radius * FRICTION * point.total_contact_force)
    # All that pushes the level string along is the weight on bit and the friction.
    drag = -point.hookload - case.bit.weight_on_bit
    assert drag == pytest.approx(FRICTION * point.total_contact_force, rel=1e-3)


@pytest.mark.parametrize("operation", ["drill_sliding", "drill_rotating"])
def test_a_coarse_row_stays_under_resolved_and_says_where_its_force_comes_from(operation: str) -> None:
    case = level_case(PUSHED, 300.0, 20.0, friction=0.1)
    case = case.model_copy(update={"rig": case.rig.model_copy(update={"block_weight": 1e6})})
    bare, point = (fctd.equilibrium(each, operation, 300.0) for each in (case, analytic(case)))
    assert bare.status == point.status == SteadyStatus.UNDER_RESOLVED
    assert point.message.startswith(bare.message.split(" from ")[0])
    assert point.message.endswith("r F²/4EI")
    assert "r F²" not in bare.message
    if operation == "drill_rotating":
        # The torque at surface is that of the friction: the bit has none.
        assert point.surface_torque == pytest.approx(point.sum_r_ft, rel=0.02)
        assert point.surface_torque > 1.3 * bare.surface_torque


@pytest.mark.parametrize(("law", "operation"), [("coulomb", "back_ream"), ("paper", "drill_rotating")])
def test_friction_acts_against_the_sliding_of_the_surface(law: str, operation: str) -> None:
    """One force against the resultant speed; the law of the paper has drag and torque in full."""
    case = analytic(level_case(PUSHED, 300.0, 20.0, friction=FRICTION), friction_law=law)
    problem, speed = pressed(case, operation)
    limit = FRICTION * problem.given.wall[:, 0]
    n, S, rates = problem.n, problem.work.S, problem.rates
    drag, torque = -state.row(S, state.GIVEN_FORCE, n), -state.row(S, state.GIVEN_TORQUE, n)
    radius = section(case).contact_radius
    around = radius * rates.spin
    along = np.array([rates.speed, around]) / np.hypot(rates.speed, around) if law == "coulomb" else np.sign([speed, 1])
    assert limit.max() > 0
    np.testing.assert_allclose(drag, along[0] * limit, rtol=1e-9)
    np.testing.assert_allclose(torque, along[1] * radius * limit, rtol=1e-9)
    np.testing.assert_allclose(problem.given.wall[:, 1], torque, rtol=1e-9)
    np.testing.assert_allclose(problem.given.wall[:, 2], radius * limit, rtol=1e-9)


@pytest.mark.parametrize("law", ["coulomb", "paper"])
def test_friction_along_and_around_have_their_own_factors(law: str) -> None:
    case, around = analytic(level_case(PUSHED, 300.0, 20.0, friction=FRICTION), friction_law=law), 0.1
    (hole,) = case.wellbore.intervals
    pair = hole.model_copy(update={"rotational_friction": around})
    case = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": (pair,)})})
    problem, _ = pressed(case, "back_ream")
    n, S, rates, missing = problem.n, problem.work.S, problem.rates, problem.given.wall[:, 0]
    drag, torque = -state.row(S, state.GIVEN_FORCE, n), -state.row(S, state.GIVEN_TORQUE, n)
    radius = section(case).contact_radius
    down, about = -FRICTION, around
    if law == "coulomb":
        found = associated(FRICTION, around, -rates.speed, radius * rates.spin)
        down, about = -found.along, found.around
    assert missing.max() > 0
    np.testing.assert_allclose(drag, down * missing, rtol=1e-9)
    np.testing.assert_allclose(torque, about * radius * missing, rtol=1e-9)
    np.testing.assert_allclose(problem.given.wall[:, 2], radius * around * missing, rtol=1e-9)


def pressed(case: Case, operation: str) -> tuple[Problem, float]:
    """A level string in balance under the weight on bit, with the force of its helix; its speed [m/s]."""
    rates = steady_rates(case, operation)
    solver = Solver(case)
    problem = solver.problem(operation, rates, solver.lay_out(case.wellbore.intervals[-1].to_md))
    problem.weight_on_bit = case.bit.weight_on_bit
    balance(problem, ATTEMPTS)
    WaveForce(problem).add()
    return problem, rates.speed


def test_a_helix_that_no_push_moves_is_locked_up() -> None:
    length = 1.3 * lock_up_length()
    case = level_case(PUSHED, length, 20.0, friction=FRICTION)
    point = fctd.equilibrium(analytic(case), "drill_sliding", length)
    assert point.status == SteadyStatus.LOCKED_UP
    assert not point.answered
    assert point.message.startswith("slack-off is spent, and the push exceeds 10 times the string's weight; ")


@pytest.mark.parametrize(("times_onset", "segment"), [(1.2, 20.0), (1.5, 0.75)])
def test_nothing_is_added_to_snaking_nor_to_segments_that_can_bend(times_onset: float, segment: float) -> None:
    case = level_case(times_onset, 40.0, segment, friction=0.1)
    bare, point = (fctd.equilibrium(each, "drill_sliding", 40.0) for each in (case, analytic(case)))
    assert point.hookload == bare.hookload
    assert point.message == bare.message


def test_a_refinement_refuses_it() -> None:
    with pytest.raises(fctd.InputError, match=r'contact.helical_force = "analytic": expected "none" in a refinement'):
        fctd.refine(analytic(level_case(PUSHED)), operation="drill_sliding", bit_depth=150.0)


@pytest.mark.parametrize("ratio", [1.02, 1.1, 1.25, 1.4])
def test_the_mean_wall_force_of_snaking_is_that_of_its_equation(ratio: float) -> None:
    whole = snaking(UNIT, ratio * UNIT.onset).mean_wall_force
    helix_of_it = ratio**2  # over the weight, as is the other
    assert float(snaking_over_helix(np.array([ratio]))[0]) * helix_of_it == pytest.approx(whole, rel=0.01)


@given(st.floats(0.05, 0.9), st.integers(20, 200))
def test_a_helix_presses_by_the_reciprocal_law_or_without_end(share: float, n: int) -> None:
    """From the lower end upwards 1/F falls by a share of it: shares beyond 1 have no end."""
    wave, drag = np.full(n, share / n), np.ones(n)
    none, pushed, force = np.zeros(n), np.ones(n), np.empty(n)
    assert press(wave, drag, none, pushed, 1e6, force)
    assert 1 + force.sum() == pytest.approx(1 / (1 - share), rel=6 / n / (1 - share) ** 2)
    assert not press(3 * wave / share, drag, none, pushed, 1e3, force)


def spent(case: Case, **tables: dict[str, object]) -> Case:
    """The case resolved with so little work that its waves are homogenised, and a rig that can push."""
    return with_tables(case, solver={"buckling": "resolve", "resolve_work": 50.0}, rig={"block_weight": 1e7}, **tables)


@pytest.mark.slow
@pytest.mark.parametrize("times_onset", [1.25, 2.0])
@pytest.mark.parametrize("operation", ["drill_sliding", "trip_in"])
def test_homogenised_waves_have_the_loads_of_resolved_ones(times_onset: float, operation: str) -> None:
    """What they drag: the push beyond the weight on bit."""
    case = level_case(times_onset, 400.0, 3.0, friction=0.2)
    point = fctd.equilibrium(spent(case), operation, 400.0)
    whole = fctd.equilibrium(with_tables(spent(case), solver={"buckling": "resolve"}), operation, 400.0)
    pressed_at_bit = 0.0 if operation == "trip_in" else case.bit.weight_on_bit
    drag, of_whole = (-each.hookload - pressed_at_bit for each in (point, whole))
    assert drag == pytest.approx(of_whole, rel=0.025)
    if operation == "drill_sliding":
        assert (point.method, point.status, point.message) == ("homogenised", SteadyStatus.CONVERGED, "")
        assert [note.code for note in point.notes] == ["homogenised"]
        assert point.shape == ("snaking" if times_onset < 1.4 else "helix")
    if operation == "trip_in":  # nothing is compressed
        assert "homogenised" not in (point.method, *(note.code for note in point.notes))


def test_homogenised_waves_are_the_same_whatever_the_segments_of_the_case() -> None:
    cases = [spent(level_case(2.0, 300.0, segment, friction=0.2)) for segment in (5.0, 12.0, 25.0)]
    loads = {fctd.equilibrium(case, "drill_sliding", 300.0).hookload for case in cases}
    assert len(loads) == 1


def test_the_profile_of_homogenised_waves_has_their_wall_force() -> None:
    case = level_case(2.0, 300.0, 5.0, friction=0.2)
    point = fctd.equilibrium(spent(case), "drill_sliding", 300.0)
    drag = -point.hookload - case.bit.weight_on_bit
    assert drag == pytest.approx(0.2 * point.profile["contact_force_N"].sum(), rel=1e-3)
    assert point.buckling.resolved


def test_a_homogenised_helix_that_no_push_moves_is_locked_up() -> None:
    length = 1.2 * lock_up_length()
    point = fctd.equilibrium(spent(level_case(PUSHED, length, 20.0, friction=FRICTION)), "drill_sliding", length)
    assert (point.status, point.answered) == (SteadyStatus.LOCKED_UP, False)
    assert point.locked_up_at == pytest.approx(1 / 1.2, rel=0.05)
    assert point.message.endswith(f"{TOO_MUCH}, {HOMOGENISED}")


@pytest.mark.slow
@pytest.mark.parametrize("work", [50.0, 1e5])
def test_a_row_whose_work_is_spent_before_it_is_fed_says_so(work: float) -> None:
    length = 1.2 * lock_up_length()
    case = spent(level_case(PUSHED, length, 20.0, friction=FRICTION))
    case = with_tables(case, solver={"buckling": "feed", "resolve_work": work})
    point = fctd.equilibrium(case, "drill_sliding", length)
    assert point.status == SteadyStatus.LOCKED_UP
    assert point.message.endswith(f"{TOO_MUCH}, {HOMOGENISED}; {EARLY}")


def test_a_pose_has_the_loads_of_its_waves() -> None:
    """A pose that is put back is in balance again."""
    problem, _ = pressed(level_case(PUSHED, 300.0, 20.0, friction=FRICTION), "drill_sliding")
    waves = WaveForce(problem)
    problem.settle = waves.settle
    assert waves.settle()[0] == CONVERGED
    kept, before = problem.copy_pose(), problem.reactions()
    problem.weight_on_bit *= 1.3
    assert waves.settle()[0] == CONVERGED
    assert problem.reactions().hookload < 1.2 * before.hookload
    problem.weight_on_bit /= 1.3
    problem.put_pose(kept)
    assert problem.reactions().hookload == before.hookload
