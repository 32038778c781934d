"""Resolved rows of a chart begin with the shape of the row above: less work, the same loads."""

import json
from typing import Any

import numpy as np
import pytest

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.steady.carried_shape import Carried
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from fctd.steady.torque_drag import chart_rows
from tests.steady.buckled import HOLE, level_case

KIND, DEPTHS = "drill_sliding", [110.0, 120.0, 130.0, 140.0, 150.0]
# Shapes of the same loads differ by a fraction of a wave.
ALIKE = 2e-3  # of the push


def pushed(times_onset: float, friction: float, length: float = 150.0) -> Case:
    """Resolved pipe in a level hole, with a block that is heavy enough to push it."""
    case = level_case(times_onset, length, 6.0, friction)
    return case.model_copy(
        update={
            "rig": case.rig.model_copy(update={"block_weight": 1e6}),
            "solver": case.solver.model_copy(update={"buckling": "resolve"}),
        }
    )


def alone(case: Case, depth: float) -> dict[str, Any]:
    return chart_rows(case, KIND, [depth])[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("times_onset", "friction", "shape"),
    [(1.25, 0.1, "snaking"), (1.25, 0.0, "snaking"), (1.9, 0.1, "helix"), (1.9, 0.0, "helix")],
)
def test_a_chart_takes_less_work_than_its_rows_alone_and_has_their_loads(
    times_onset: float, friction: float, shape: str
) -> None:
    case = pushed(times_onset, friction)
    chart, rows = chart_rows(case, KIND, DEPTHS), [alone(case, depth) for depth in DEPTHS]
    assert chart[0]["hookload_N"] == rows[0]["hookload_N"]
    for begun, own in zip(chart, rows, strict=True):
        assert (begun["status"], begun["shape"]) == (own["status"], own["shape"]) == ("converged", shape)
        assert begun["hookload_N"] == pytest.approx(own["hookload_N"], rel=ALIKE)
        assert begun["total_contact_force_N"] == pytest.approx(own["total_contact_force_N"], rel=0.03)
    if friction > 0:  # without, the helix of a short string is laid at once
        assert sum(row["iterations"] for row in chart[1:]) < 0.5 * sum(row["iterations"] for row in rows[1:])


def test_where_a_helix_becomes_due_the_row_is_that_of_its_own_path() -> None:
    """The row above only snakes: its shape says nothing of a helix, which has the lower energy ten metres deeper."""
    case, depths = pushed(1.38, 0.3), DEPTHS[2:4]
    chart, rows = chart_rows(case, KIND, depths), [alone(case, depth) for depth in depths]
    assert [row["shape"] for row in chart] == [row["shape"] for row in rows] == ["snaking", "helix"]
    assert [row["hookload_N"] for row in chart] == [row["hookload_N"] for row in rows]


def begun(case: Case, depth: float, above: Carried | None) -> Equilibrium:
    """The row of a depth, begun with shapes of another one."""
    solver = Solver(case)
    return solver.solve_problem(solver.problem(KIND, steady_rates(case, KIND), solver.lay_out(depth)), above)


def test_shapes_are_kept_and_restored_to_the_last_bit() -> None:
    case = pushed(1.9, 0.1)
    above = begun(case, 140.0, None).carried
    assert above is not None
    restored = Carried.restore(json.loads(json.dumps(above.facts())))
    points = [begun(case, 150.0, of) for of in (above, restored)]
    assert points[0].hookload == points[1].hookload
    assert points[0].iterations == points[1].iterations


def test_a_shape_of_no_use_changes_nothing() -> None:
    """Of a string a tenth as long, turned inside out: the row is what it is alone, with all of its work."""
    case = pushed(1.25, 0.1)
    own = begun(case, 150.0, None)
    above = begun(case, 110.0, None).carried
    assert above is not None
    assert above.snaking is not None
    wild = above.snaking._replace(
        low=-10 * above.snaking.low, right=np.roll(above.snaking.right, 7), tension=-above.snaking.tension
    )
    point = begun(case, 150.0, above._replace(snaking=wild))
    assert point.status == own.status
    assert point.hookload == pytest.approx(own.hookload, rel=ALIKE)


def test_a_string_that_locks_up_leaves_nothing_to_begin_with() -> None:
    case = pushed(1.25, 0.1)
    stuck = case.model_copy(update={"rig": case.rig.model_copy(update={"block_weight": 0.0})})
    assert begun(stuck, 150.0, None).carried is None


def test_a_bit_at_gauge_has_no_clearance_to_be_a_share_of() -> None:
    case = pushed(1.25, 0.1)
    (pipe,) = case.string.components
    bit = pipe.model_copy(update={"name": "bit", "length": 0.3, "contact_diameter": HOLE, "segment_length": 0.3})
    with_bit = case.model_copy(update={"string": case.string.model_copy(update={"components": (bit, pipe)})})
    chart, own = chart_rows(with_bit, KIND, DEPTHS[2:4]), alone(with_bit, DEPTHS[3])
    assert [row["status"] for row in chart] == ["converged", "converged"]
    assert chart[1]["hookload_N"] == pytest.approx(own["hookload_N"], rel=ALIKE)
    assert chart[1]["iterations"] < 0.5 * own["iterations"]
