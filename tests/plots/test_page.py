"""Pages: whole, without a network, with the values of the table, and with texts from outside as they stand."""

import re
from pathlib import Path
from typing import Any

import pytest

from fctd import plots
from fctd.case.operations import KINDS
from fctd.plots.tracks import TRACKS
from tests.plots.made import chart, points, well

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


@pytest.mark.parametrize("units", ["si", "field"])
def test_picture_and_page_of_one_well_have_the_same_axes(units: Any) -> None:
    table = chart(list(KINDS), [0.2, 0.3])
    page, picture = plots.chart_page(table, units, CASE), plots.chart_figure(table, units, CASE)
    across, down = list(page.select_xaxes()), list(page.select_yaxes())
    assert [(axis.title.text, axis.range) for axis in across] == [
        (ax.get_xlabel(), ax.get_xlim()) for ax in picture.axes
    ]
    assert [axis.range for axis in down] == [ax.get_ylim() for ax in picture.axes]
    assert "&lt;b&gt;&#36;x&#36;" in page.layout.title.text


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
    picture = plots.profile_figure(points(), "si")
    assert [axis.range for axis in figure.select_xaxes()] == [ax.get_xlim() for ax in picture.axes]
    assert {axis.range for axis in figure.select_yaxes()} == {picture.axes[0].get_ylim()}
