"""Curves: rows without loads, rows that are cut, and rows that need care are marked."""

import numpy as np
import pandas as pd
import pytest

from fctd import plots
from fctd.plots.palette import BUCKLED, LOOKS
from tests.plots.made import chart, curves, legend_of, lines, locked_chart, well

CASE = well(rig={"block_weight": 3e4})


def test_rows_without_an_answer_are_crossed_where_their_line_breaks() -> None:
    """A cross stands in a gap of the line; rows above the first answer have theirs in the strip alone."""
    table = chart(["trip_out", "trip_in"], [0.2], {"diverged": "trip_in"})
    first = table.index[(table["operation"] == "trip_in") & (table["bit_depth_m"] == 1100)]
    table.loc[first, ["hookload_N", "surface_torque_N_m", "status"]] = [3e5, 2e3, "converged"]
    gap = table[(table["status"] == "diverged") & (table["bit_depth_m"] > 1100)]
    for ax in plots.chart_figure(table).axes[:2]:
        (crosses,) = [line for line in lines(ax, marker="x") if len(line.get_xdata())]
        assert list(crosses.get_ydata()) == list(gap["bit_depth_m"])
        assert np.isfinite(crosses.get_xdata()).all()


def test_rows_that_need_care_have_an_open_marker() -> None:
    table = chart(["trip_in"], [0.2], {"under_resolved": "trip_in"})
    left = plots.chart_figure(table).axes[0]
    (marks,) = [line for line in lines(left, markerfacecolor="white") if line.get_marker() == LOOKS["trip_in"][1]]
    np.testing.assert_allclose(marks.get_xdata(), table.loc[table["status"] == "under_resolved", "hookload_N"] / 1e3)


def test_buckled_rows_have_a_band_below_their_line() -> None:
    """Light grey for snaking, darker for the helix, both with edges; none where nothing is buckled."""
    table = chart(["trip_in", "trip_out"], [0.2])
    rows = table.index[table["operation"] == "trip_in"]
    table.loc[rows[3:6], "buckling"], table.loc[rows[6:], "buckling"] = "sinusoidal", "helical"
    figure = plots.chart_figure(table)
    for ax, column in zip(figure.axes, ("hookload_N", "surface_torque_N_m"), strict=False):
        for mode, grey in BUCKLED.items():
            (band,) = lines(ax, color=grey)
            at = np.isfinite(band.get_xdata())
            np.testing.assert_allclose(band.get_xdata()[at], table.loc[table["buckling"] == mode, column] / 1e3)
            cores = lines(ax, color="white")  # on which a light curve is seen in grey
            assert any(np.array_equal(core.get_xdata(), band.get_xdata(), equal_nan=True) for core in cores)
            assert band.get_zorder() < min(core.get_zorder() for core in cores)
            assert max(core.get_zorder() for core in cores) < min(line.get_zorder() for line in curves(ax))
    assert not [line for ax in plots.chart_figure(chart(["trip_in"], [0.2])).axes for line in lines(ax, color=grey)]


def test_pushes_are_cut_at_the_edges_and_marked_there() -> None:
    """Hook loads beyond the left edge from 1,650 m, torque beyond the right edge; no push suffices from 1,800 m."""
    left, right, *_ = plots.chart_figure(locked_chart(), "si", CASE).axes
    edge = left.get_xlim()[0]
    cut, stuck = (
        next(line for line in lines(left, marker="<") if line.get_markerfacecolor() == face)
        for face in ("white", LOOKS["drill_sliding"][0])
    )
    for marks, depths in ((cut, [1650.0, 1700.0, 1750.0]), (stuck, [1800.0, 1850.0, 1900.0, 1950.0, 2000.0])):
        assert list(marks.get_xdata()) == pytest.approx([edge] * len(depths))
        assert list(marks.get_ydata()) == depths
    (line,) = curves(left)
    # The line goes to the edge and ends there.
    assert line.get_xdata()[13] == pytest.approx(edge)
    assert np.isnan(line.get_xdata()[14:]).all()
    (beyond,) = lines(right, marker=">")
    assert list(beyond.get_ydata()) == [1650.0, 1700.0, 1750.0]
    assert not [marks for ax in (left, right) for marks in lines(ax, marker="x") if len(marks.get_xdata())]


def test_a_band_spans_the_hook_loads_of_both_shapes() -> None:
    table = chart(["trip_in"], [0.2])
    table.loc[4:8, "hookload_low_N"] = table.loc[4:8, "hookload_N"]
    table.loc[4:8, "hookload_high_N"] = table.loc[4:8, "hookload_N"] + 5e4
    for load, shift in (("string", 0.0), ("indicator", 30.0)):
        figure = plots.chart_figure(table, "si", CASE, plots.ChartLook(load))  # type: ignore[arg-type]
        left, torque, *_ = figure.axes
        band, bars = left.collections
        edges = band.get_paths()[0].vertices
        row = table.loc[6]
        at = edges[edges[:, 1] == row["bit_depth_m"], 0]
        assert at.max() == pytest.approx(row["hookload_high_N"] / 1e3 + shift)
        assert len(bars.get_segments()) == 5
        assert not torque.collections


def test_a_band_beyond_the_axis_is_not_named() -> None:
    """Both shapes of a string that is pushed far beyond the axis: no band is seen."""
    table = locked_chart()
    table.loc[table["bit_depth_m"] == 1700, ["hookload_low_N", "hookload_high_N"]] = [-5.1e7, -5e7]
    assert "hook loads of both shapes" not in legend_of(plots.chart_figure(table, "si", CASE))
    table.loc[table["bit_depth_m"] == 1100, ["hookload_low_N", "hookload_high_N"]] = [8e4, 9e4]
    assert "hook loads of both shapes" in legend_of(plots.chart_figure(table, "si", CASE))


def test_a_measured_range_alone_has_an_empty_marker() -> None:
    """Its shape names the operation."""
    loads = {"hookload_N": [np.nan], "hookload_low_N": [3e5], "hookload_high_N": [4e5]}
    torques = {f"surface_torque{end}_N_m": [np.nan] for end in ("", "_low", "_high")}
    measured = pd.DataFrame({"operation": ["trip_out"], "bit_depth_m": [1500.0]} | loads | torques)
    figure = plots.chart_figure(chart(["trip_out"], [0.2]), look=plots.ChartLook(measured=measured))
    (mark,) = lines(figure.axes[0], markerfacecolor="white", marker=LOOKS["trip_out"][1])
    assert (list(mark.get_xdata()), list(mark.get_ydata())) == ([350.0], [1500.0])
    assert "measured range without a value" in legend_of(figure)


def test_a_lone_answer_carries_a_marker() -> None:
    table = chart(["trip_in"], [0.2])
    lone = 3
    table.loc[table.index != lone, ["hookload_N", "surface_torque_N_m"]] = np.nan
    table.loc[table.index != lone, "status"] = "diverged"
    (line,) = curves(plots.chart_figure(table).axes[0])
    assert lone in line.get_markevery()
