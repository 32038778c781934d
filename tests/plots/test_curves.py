"""Curves of pictures: every part of a description is drawn where it says."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fctd.plots.curves import draw_curve, draw_points
from fctd.plots.describe import describe
from fctd.plots.description import Curve, Points
from fctd.plots.loads import ChartLook
from fctd.plots.palette import BUCKLED, LOOKS
from fctd.plots.style import line_style
from tests.plots.made import chart, curves, lines, locked_chart, well


def drawn(curve: Curve) -> Axes:
    ax: Axes = Figure().subplots()
    draw_curve(ax, curve)
    return ax


def locked() -> Curve:
    look = ChartLook("string")
    return describe(locked_chart(), "si", well(rig={"block_weight": 3e4}), look).groups[0].panels[0].curves[0]


def test_a_curve_has_the_colour_marker_and_dash_of_its_description() -> None:
    for curve in describe(chart(["trip_out", "trip_in"], [0.1, 0.2])).groups[0].panels[0].curves:
        (line,) = curves(drawn(curve))
        assert (line.get_color(), line.get_marker()) == LOOKS[curve.operation]
        np.testing.assert_array_equal(line.get_xdata(), curve.line)
        np.testing.assert_array_equal(line.get_ydata(), curve.depth)
        (alike,) = Figure().subplots().plot([0], linestyle=line_style(curve.dash), linewidth=line.get_linewidth())
        assert line._dash_pattern == alike._dash_pattern


def test_cut_and_stuck_rows_have_triangles_at_the_edge() -> None:
    curve = locked()
    for face, at in (("white", curve.beyond[0]), (LOOKS["drill_sliding"][0], curve.stuck)):
        (marks,) = lines(drawn(curve), marker="<", markerfacecolor=face)
        assert set(marks.get_xdata()) == {curve.limits.low}
        assert list(marks.get_ydata()) == list(curve.depth[at])


def test_buckled_rows_have_a_band_below_their_line() -> None:
    """Light grey for snaking, darker for the helix, both with edges and a core on which a light curve is seen."""
    curve = locked()
    ax = drawn(curve)
    for mode, grey in BUCKLED.items():
        (band,) = lines(ax, color=grey)
        np.testing.assert_array_equal(band.get_xdata(), np.where(curve.modes == mode, curve.line, np.nan))
        cores = lines(ax, color="white")
        assert any(np.array_equal(core.get_xdata(), band.get_xdata(), equal_nan=True) for core in cores)
        assert band.get_zorder() < min(core.get_zorder() for core in cores)
        assert max(core.get_zorder() for core in cores) < curves(ax)[0].get_zorder()


def test_care_lost_rows_and_both_shapes_are_drawn() -> None:
    table = chart(["trip_in"], [0.2], {"under_resolved": "trip_in"})
    table.loc[0, ["hookload_N", "status"]] = [np.nan, "diverged"]
    table.loc[4:8, "hookload_low_N"], table.loc[4:8, "hookload_high_N"] = table["hookload_N"], table["hookload_N"] + 5e4
    curve = describe(table).groups[0].panels[0].curves[0]
    ax = drawn(curve)
    (care,) = lines(ax, markerfacecolor="white")
    assert list(care.get_xdata()) == list(curve.value[curve.care])
    (crosses,) = lines(ax, marker="x")
    assert list(crosses.get_xdata()) == [curve.edge]
    band, bars = ax.collections
    assert [curve.high[8], curve.depth[8]] in band.get_paths()[0].vertices.tolist()
    assert len(bars.get_segments()) == 5


def test_measured_points_have_their_ranges_and_one_without_a_value_an_empty_marker() -> None:
    known, alone = np.array([300.0, np.nan]), np.array([[250.0, 300.0], [400.0, 400.0]])
    ax: Axes = Figure().subplots()
    draw_points(ax, Points("trip_out", np.array([1500.0, 1600.0]), known, *alone))
    full, empty = lines(ax, marker=LOOKS["trip_out"][1])
    assert (list(full.get_xdata()), list(empty.get_xdata())) == ([300.0], [350.0])
    assert empty.get_markerfacecolor() == "white"
    (bars,) = ax.collections
    assert [segment[:, 0].tolist() for segment in bars.get_segments()] == [[250.0, 400.0], [300.0, 400.0]]
