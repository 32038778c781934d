"""Modes in which a string would leave its balance, and what becomes of strings that have them."""

import numpy as np
import pytest

from fctd import equilibrium
from fctd.case.load import Case
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.block_thomas import negative_pivots
from fctd.steady.continuation import CONVERGED
from fctd.steady.problem import FULL
from fctd.steady.stability import fastest_mode, push_aside
from tests.cases import make_case, pipe
from tests.steady.buckled import level_case, problem_of


def hanging_case(weight_on_bit: float, **more: object) -> Case:
    """300 m of 5 in pipe in vertical hole of 12¼ in, in segments that follow its waves; its lower end is free."""
    hole = {
        "intervals": [{"to_md": 300.0, "diameter": 0.31115, "friction": 0.2}],
        "geometry": "arcs", "stiffness_per_length": 1e6,
    }  # fmt: skip
    part = pipe(None, None, inner=0.1086, segment_length=0.5)
    return make_case([[0, 0, 0], [300, 0, 0]], [part], wellbore=hole, bit={"weight_on_bit": weight_on_bit, **more})


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
    product = np.einsum("jrc,jc->jr", w.D[1 : n + 1], mode)
    product[1:] += np.einsum("jrc,jc->jr", w.A[2 : n + 1], mode[:-1])
    product[:-1] += np.einsum("jrc,jc->jr", w.U[2 : n + 1], mode[1:])
    assert (mode * product).sum() < 0
    assert negative_pivots(w.D, w.A, w.U, n) == negative


def test_a_push_leads_out_of_the_balance() -> None:
    problem = problem_of(level_case(1.3, length=150.0, segment=3.0))
    balance(problem, ATTEMPTS)
    straight = problem.reactions().contacts[:, :3].copy()
    assert push_aside(problem, FULL) is not None
    moved = np.linalg.norm(problem.reactions().contacts[:, :3] - straight, axis=1).max()
    clearance = 0.5 * (0.2159 - 0.127)
    assert 0.009 * clearance < moved < 0.7 * clearance


@pytest.mark.parametrize("weight_on_bit", [9e3, 12e3, 23.8e3])
@pytest.mark.parametrize("operation", ["drill_sliding", "drill_rotating"])
def test_a_straight_string_above_its_onset_is_not_converged(weight_on_bit: float, operation: str) -> None:
    """2.9 to 7.6 times 1.02 (EI w²)^⅓, the onset of a free lower end: they were straight, without any wall force."""
    point = equilibrium(hanging_case(weight_on_bit), operation, 300.0)
    if operation == "drill_rotating":  # the buckled string rolls round the hole
        assert (point.status, point.total_contact_force) == ("unstable", pytest.approx(0.0, abs=1e-6))
        assert point.message.startswith("the string would leave this balance, and the continuation found no further")
        assert point.message.endswith("where the friction of rotation rolled the buckled string round the hole")
        return
    assert point.status == "converged"
    fine = hanging_case(weight_on_bit)
    fine = fine.model_copy(update={"solver": fine.solver.model_copy(update={"buckling": "resolve"})})
    resolved = equilibrium(fine, operation, 300.0)
    assert resolved.status == "converged"
    assert point.total_contact_force == pytest.approx(resolved.total_contact_force, rel=0.02)
    assert point.total_contact_force > 40.0
