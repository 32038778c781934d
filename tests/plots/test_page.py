"""Pages: whole, without a network, with the values of the table, and with texts from outside as they stand."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fctd import plots
from fctd.case.operations import KINDS
from fctd.plots.palette import LOOKS
from fctd.plots.tracks import TRACKS
from tests.plots.made import DEPTHS, chart, locked_chart, points, well

CASE = well(rig={"block_weight": 3e4}).model_copy(update={"name": "<b>$x$"})


def test_a_page_is_one_file_that_needs_no_network(tmp_path: Path) -> None:
    figure = plots.chart_page(chart(["trip_in"], [0.2]), "si", CASE)
    first, second = tmp_path / "a.html", tmp_path / "b.html"
    for path in (first, second):
        assert plots.save_page(figure, path) == [path]
    text = first.read_text(encoding="utf-8")
    assert text.lstrip().startswith("<!doctype html>")
    assert not re.search(r"<(?:script|link|img)[^>]+(?:src|href)=", text)
    assert "Plotly.newPlot" in text
    # Nor does a button send the chart anywhere, as plotly's own would.
    assert '"modeBarButtonsToRemove": ["sendChartToCloud"]' in text
    assert first.read_bytes() == second.read_bytes()


def test_a_curve_has_the_values_and_reasons_of_its_rows() -> None:
    table = chart(["trip_in", "trip_out"], [0.2], {"diverged": "trip_in"})
    table.loc[table["status"] == "diverged", "reason"] = "deep in the wall <script>"
    figure = plots.chart_page(table, "si", CASE)
    # Both curves have the factor 0.2, which the title names.
    (left, _) = (trace for trace in figure.data if trace.name == "slacking off")
    rows = table[table["operation"] == "trip_in"]
    np.testing.assert_allclose(left.x, rows["hookload_N"] / 1e3)
    np.testing.assert_allclose(left.y, rows["bit_depth_m"])
    lost = next(trace for trace in figure.data if trace.name == "no loads")
    assert list(lost.y) == list(rows.loc[rows["hookload_N"].isna(), "bit_depth_m"])
    assert "deep in the wall &lt;script&gt;" in lost.text[0]
    assert "&lt;b&gt;&#36;x&#36;" in figure.layout.title.text


def test_panels_are_those_of_the_picture() -> None:
    figure = plots.chart_page(chart(list(KINDS), [0.2, 0.3]), "field", CASE, plots.ChartLook("indicator"))
    titles = [axis.title.text for axis in figure.select_xaxes()]
    assert titles == ["weight indicator (string and block), klbf", "surface torque, kft·lbf"] * 2
    names = [trace.name for trace in figure.data if trace.showlegend]
    assert len(names) == len(set(names)) == 12


def test_pushes_do_not_set_the_axis_of_a_page() -> None:
    figure = plots.chart_page(locked_chart(), "si", CASE)
    low, high = next(iter(figure.select_xaxes())).range
    assert -100 < low < -30 < 120 < high
    assert "slack-off is spent" in {note.text for note in figure.layout.annotations}
    lost = next(trace for trace in figure.data if trace.name == "no loads")
    assert low < min(lost.x) == max(lost.x) < low + 0.05 * (high - low)
    cut = next(trace for trace in figure.data if trace.name == "beyond the axis")
    assert (set(cut.x), list(cut.y), set(cut.customdata)) == ({low}, [1650.0, 1700.0, 1750.0], {-5e4})
    assert {"sinusoidal buckling", "helical buckling"} <= {trace.name for trace in figure.data if trace.showlegend}


def test_every_row_is_a_point_and_few_have_markers() -> None:
    table = chart(["trip_in"], [0.2], {"under_resolved": "trip_in"})
    (line, _) = (trace for trace in chart_page_lines(table))
    assert len(line.x) == len(DEPTHS)
    flagged = table["status"] == "under_resolved"
    seen = np.array(line.marker.color) == LOOKS["trip_in"][0]
    assert seen[flagged].all()
    assert {*seen[~flagged]} == {True, False}


def chart_page_lines(table: pd.DataFrame) -> list[Any]:
    """The curves of a page, in both panels."""
    return [trace for trace in plots.chart_page(table).data if trace.mode == "lines+markers"]


def test_measured_points_have_their_ranges() -> None:
    values = {"hookload_N": 3e5, "hookload_low_N": 2e5, "hookload_high_N": 5e5}
    measured = pd.DataFrame(
        {"operation": ["trip_in"], "bit_depth_m": [1500.0]}
        | {name: [value] for name, value in values.items()}
        | {f"surface_torque{end}_N_m": [np.nan] for end in ("", "_low", "_high")}
    )
    figure = plots.chart_page(chart(["trip_out", "trip_in"], [0.2]), look=plots.ChartLook(measured=measured))
    point = next(trace for trace in figure.data if trace.name == "measured, with range")
    # The name stands beside points, not with an operation that has none.
    assert point.showlegend
    assert (list(point.x), list(point.error_x.array), list(point.error_x.arrayminus)) == ([300.0], [200.0], [100.0])


def test_rows_without_loads_above_the_first_answer_stand_beside_the_edge() -> None:
    """In the axes, clear of the depths, and those of each curve beside those of the other."""
    table = chart(["trip_in", "trip_out"], [0.2], {"diverged": "trip_in", "max_iterations": "trip_out"})
    figure = plots.chart_page(table)
    low, high = next(iter(figure.select_xaxes())).range
    first, second = ({*trace.x} for trace in figure.data if trace.name == "no loads" and trace.xaxis == "x")
    assert low < min(first) == max(first) < min(second) == max(second) < low + 0.05 * (high - low)


def test_a_profile_has_a_panel_for_every_quantity() -> None:
    figure = plots.profile_page(points(), "si", warnings=["a warning"])
    assert len(list(figure.select_xaxes())) == len(TRACKS)
    torque = list(figure.select_xaxes())[TRACKS.index("torque_N_m")]
    assert torque.range[0] <= 0
    assert torque.range[1] > 0.1
    drawn = {trace.name for trace in figure.data if trace.showlegend}
    assert "clearance" in drawn
    assert {KINDS[point.operation].label for point in points() if point.answered} <= drawn
    assert "a warning" in figure.layout.title.text
