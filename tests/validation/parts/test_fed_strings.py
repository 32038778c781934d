"""Strings that are fed from rest: how they are drawn and cut, and when rows of several meshes are the same."""

from dataclasses import replace

import pytest

from fctd import Case, equilibrium
from fctd.results.status import SteadyStatus
from validation.harness.study import Context
from validation.parts.fed_strings import ARRIVES, FRICTION, NOT, RAISED, WEIGHT, Row, compare, drawn, meshed, scaled
from validation.parts.resolved_rows import DEPTH, horizontal_well

WEIGHT_OF_STRING = 1e5  # [N]


@pytest.fixture(scope="module")
def row() -> Row:
    """A trip into a horizontal well, on the segments of the case."""
    return Row(equilibrium(horizontal_well(20.0, "detect"), "trip_in", DEPTH), 0.1)


def changed(row: Row, **changes: object) -> Row:
    """The row with other values."""
    assert row.point is not None
    return row._replace(point=replace(row.point, **changes))  # type: ignore[arg-type]


@pytest.mark.parametrize("index", [0, 1, 3, 4])  # the real survey needs the data
def test_a_string_is_the_same_for_the_same_index(index: int) -> None:
    first, second = drawn(Context(), index), drawn(Context(), index)
    assert first.case.model_dump() == second.case.model_dump()
    assert first[2:] == second[2:]
    assert FRICTION[0] <= first.friction <= FRICTION[1]
    assert WEIGHT[0] <= first.case.bit.weight_on_bit <= WEIGHT[1]
    assert {of.friction for of in first.case.wellbore.intervals} == {first.friction}


def test_a_mesh_has_shorter_segments_and_a_share_less_friction() -> None:
    case: Case = drawn(Context(), 1).case
    pairs = zip(case.string.components, meshed(case, 0.5).string.components, strict=True)
    assert all(own.segment_length and fine.segment_length == 0.5 * own.segment_length for own, fine in pairs)
    friction = case.wellbore.intervals[0].friction
    assert scaled(case, 0.95).wellbore.intervals[0].friction == pytest.approx(0.95 * friction)


def test_rows_of_three_meshes_are_the_same_within_one_percent_of_the_weight(row: Row) -> None:
    assert row.point is not None
    load = row.point.hookload
    near, far = (changed(row, hookload=load + share * WEIGHT_OF_STRING) for share in (0.009, 0.011))
    assert compare((row, near, row), WEIGHT_OF_STRING).differs == ""
    found = compare((row, far, row), WEIGHT_OF_STRING)
    assert found.differs == "hook load"
    assert found.load == pytest.approx(1.1)


def test_rows_differ_by_status_loads_and_friction_at_lock_up(row: Row) -> None:
    locked = changed(row, status=SteadyStatus.LOCKED_UP, hookload=float("nan"), locked_up_at=0.9)
    assert compare((row, locked), WEIGHT_OF_STRING).differs == "status, loads or none"
    assert compare((row, Row(None, 0.1, "ValueError: x")), WEIGHT_OF_STRING).differs == "status"
    assert compare((locked, changed(locked, locked_up_at=0.91)), WEIGHT_OF_STRING).differs == ""
    assert compare((locked, changed(locked, locked_up_at=0.93)), WEIGHT_OF_STRING).differs == "friction at lock-up"


def test_a_string_arrives_where_it_has_loads(row: Row) -> None:
    slides, spent = (changed(row, status=of) for of in (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP))
    assert [slides.arrival, spent.arrival] == [ARRIVES, ARRIVES]
    assert changed(spent, hookload=float("nan")).arrival == NOT
    assert changed(row, status=SteadyStatus.UNDER_RESOLVED).arrival == "under_resolved"
    assert Row(None, 0.1, "ValueError: x").arrival == RAISED
