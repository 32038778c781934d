"""The table of margins: its columns, its rows where string and hole do not fit, and what is refused."""

import numpy as np
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.case.fluids import InsideSpec
from fctd.results.columns import DOES
from fctd.steady.margin_table import COLUMNS, USUAL, limits_of
from fctd.steady.margins import MEANINGS, Margin
from tests.cases import make_case, pipe

CASE = make_case(rig={"hoist_capacity": 1e6, "largest_torque": 20e3, "slip_length": 0.4}, mud={"density": 1200.0})


def test_a_row_for_each_margin_with_the_columns_of_the_guide() -> None:
    table = fctd.limits_of(CASE, bit_depths=[500.0, "900 m"])
    assert list(table.columns) == ["operation", "bit_depth_m", *(column.name for column in DOES), *COLUMNS.values()]
    assert tuple(COLUMNS) == Margin._fields
    assert list(table["bit_depth_m"].unique()) == [500.0, 900.0]
    assert set(table["operation"]) == set(USUAL)
    assert set(table["limit"]) == {
        "yield",
        "hoist",
        "snaking",
        "helix",
        "slack_off",
        "lock_up",
        "drive",
        "slips",
        "fatigue",
    }
    assert set(table["limit"]) <= set(MEANINGS)
    pulled = table[(table["limit"] == "yield") & (table["operation"] == "trip_out")]
    assert pulled["force_at_bit_N"].is_monotonic_decreasing


def test_without_depths_the_bit_is_at_the_bottom_of_the_hole() -> None:
    assert list(limits_of(CASE, "trip_out")["bit_depth_m"].unique()) == [1000.0]


def test_friction_is_that_which_is_asked_for() -> None:
    bend = [[0, 0, 0], [200, 0, 0], [600, 60, 0], [1000, 60, 0]]
    case = make_case(bend, [pipe(None, None, segment_length=20.0)], mud={"density": 1200.0})
    pulls = [limits_of(case, "trip_out", [900.0], friction=mu)["force_at_bit_N"].iloc[0] for mu in (0.1, 0.3)]
    assert pulls[0] > 1.1 * pulls[1]


def test_depths_at_which_the_string_does_not_fit_have_a_reason() -> None:
    narrow = {
        "intervals": [
            {"to_md": 800, "diameter": 0.2159, "friction": 0.2},
            {"to_md": 1000, "diameter": 0.12, "friction": 0.2},
        ]
    }
    case = make_case(components=[pipe(None, None, segment_length=20.0)], wellbore=narrow)
    table = limits_of(case, "trip_out", [700.0, 900.0])
    assert list(table["margin"]) == ["overpull", "none"]
    assert table["reason"].iloc[1].startswith("not_possible: ")
    assert np.isnan(table["force_at_bit_N"].iloc[1])
    with pytest.raises(InputError, match="contact_diameter"):
        limits_of(case, "trip_out", [900.0])


@pytest.mark.parametrize("stuck_at", [None, 600.0])
def test_rows_have_the_notes_of_a_chart(stuck_at: float | None) -> None:
    heavy = CASE.mud.model_copy(update={"inside": (InsideSpec(density=1500.0),), "float": True})
    case = CASE.model_copy(update={"mud": heavy})
    for operation in USUAL:
        (told,) = fctd.torque_drag(case, operation, [900.0])["notes"]
        assert told == "falling"
        table = limits_of(case, operation, [900.0], stuck_at=stuck_at)
        assert len(table)
        assert set(table["notes"]) == {told}
    assert set(limits_of(CASE, bit_depths=[900.0])["notes"]) == {"none"}


def test_progress_is_told_by_depth() -> None:
    seen: list[tuple[int, int]] = []
    limits_of(CASE, "trip_out", [500.0, 900.0], progress=lambda done, total: seen.append((done, total)))
    assert seen == [(1, 2), (2, 2)]


def test_an_unknown_kind_is_refused() -> None:
    with pytest.raises(InputError, match="trip_out"):
        limits_of(CASE, "trip_ou", [900.0])
