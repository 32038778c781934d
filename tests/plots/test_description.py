"""Curves of a description: where rows stand that are cut, flagged, lost or buckled."""

import numpy as np
import pytest

from fctd.plots.describe import describe
from fctd.plots.description import Curve
from fctd.plots.loads import ChartLook
from tests.plots.made import chart, locked_chart, well

CASE = well(rig={"block_weight": 3e4})


def curves(table: object, load: str = "string") -> tuple[Curve, Curve]:
    """The first curve of loads and that of torques."""
    left, right = describe(table, "si", CASE, ChartLook(load)).groups[0].panels  # type: ignore[arg-type]
    return left.curves[0], right.curves[0]


def test_rows_without_an_answer_stand_in_the_gap_of_their_line_or_beside_the_edge() -> None:
    """Any other place would look like a load; those of each curve stand beside those of the others."""
    table = chart(["trip_in", "trip_out"], [0.2], {"diverged": "trip_in", "max_iterations": "trip_out"})
    first = table.index[(table["operation"] == "trip_in") & (table["bit_depth_m"] == 1100)]
    table.loc[first, ["hookload_N", "surface_torque_N_m", "status"]] = [3e5, 2e3, "converged"]
    one, other = describe(table).groups[0].panels[0].curves
    (lost, place), (_, beside) = one.lost, other.lost
    assert lost.tolist() == (table[table["operation"] == "trip_in"]["hookload_N"].isna()).tolist()
    low, high = one.limits.low, one.limits.high
    assert low < place[0] == one.edge < beside[0] == other.edge < low + 0.05 * (high - low)
    assert np.interp(1250, [1100, 1500], [300, one.value[10]]) == pytest.approx(place[5])


def test_rows_that_need_care_are_flagged() -> None:
    table = chart(["trip_in"], [0.2], {"under_resolved": "trip_in"})
    table.loc[3, "buckling"], table.loc[3, "reason"] = "helical", "too long segments"
    curve, _ = curves(table)
    assert curve.care.tolist() == (table["status"] == "under_resolved").tolist()
    assert curve.texts[3] == "under resolved, buckling helical: too long segments"
    assert curve.texts[-1] == ""


def test_pushes_are_cut_at_the_edges() -> None:
    """Hook loads beyond the left edge from 1,650 m, torque beyond the right edge; no push suffices from 1,800 m."""
    load, torque = curves(locked_chart())
    edge = load.limits.low
    assert [load.depth[at].tolist() for at in (load.beyond[0], load.beyond[1], load.stuck)] == [
        [1650.0, 1700.0, 1750.0], [], [1800.0, 1850.0, 1900.0, 1950.0, 2000.0],
    ]  # fmt: skip
    # The line goes to the edge and ends there.
    assert load.line[13] == pytest.approx(edge)
    assert np.isnan(load.line[14:]).all()
    assert load.end == (pytest.approx(edge), 1650.0)
    assert torque.depth[torque.beyond[1]].tolist() == [1650.0, 1700.0, 1750.0]
    assert not torque.stuck.any()
    assert not load.lost[0].any()


def test_a_band_spans_the_hook_loads_of_both_shapes_and_is_named_where_it_is_seen() -> None:
    table = chart(["trip_in"], [0.2])
    table.loc[4:8, "hookload_low_N"] = table.loc[4:8, "hookload_N"]
    table.loc[4:8, "hookload_high_N"] = table.loc[4:8, "hookload_N"] + 5e4
    for load, shift in (("string", 0.0), ("indicator", 30.0)):
        curve, torque = curves(table, load)
        assert curve.high[6] == pytest.approx(table["hookload_high_N"][6] / 1e3 + shift)
        assert (np.isfinite(curve.low).sum(), np.isfinite(torque.low).any()) == (5, False)
        assert curve.has_band
    # Both shapes of a string that is pushed far beyond the axis.
    table = locked_chart()
    table.loc[table["bit_depth_m"] == 1700, ["hookload_low_N", "hookload_high_N"]] = [-5.1e7, -5e7]
    assert not curves(table)[0].has_band


def test_a_lone_answer_carries_a_marker() -> None:
    table = chart(["trip_in"], [0.2])
    lone = 3
    table.loc[table.index != lone, ["hookload_N", "surface_torque_N_m"]] = np.nan
    table.loc[table.index != lone, "status"] = "diverged"
    assert curves(table)[0].marks[lone]


def test_a_series_without_any_answer_has_no_end() -> None:
    table = chart(["trip_in"], [0.2])
    table[["hookload_N", "surface_torque_N_m"]], table["status"] = np.nan, "max_iterations"
    curve, _ = curves(table)
    assert np.isnan(curve.end).all()
    assert curve.lost[0].all()
