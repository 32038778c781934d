"""Curves against depth: every curve is drawn once, with its name in the legend, depth downwards."""

import numpy as np

from fctd.plots.depth_panels import Curve, Panel, Panels, panels_figure, panels_page
from tests.plots.made import texts_that_overlap

DEPTH = np.array([100.0, 200.0, 300.0])
PANELS = Panels(
    "a well", ["2000 L/min"], "bit depth, m",
    [
        Panel("pressure, bar", [Curve(DEPTH / 10, DEPTH, "bore", 0), Curve(DEPTH / 5, DEPTH, "annulus", 1, 2)]),
        Panel("density, kg/m³", [Curve(DEPTH * 0 + 1250, DEPTH, "bore", 0), Curve(DEPTH[:1], DEPTH[:1], "one", 2)]),
    ],
)  # fmt: skip


def test_a_picture_has_every_curve() -> None:
    figure = panels_figure(PANELS)
    first, second = figure.axes
    assert [line.get_xdata().tolist() for line in first.lines] == [[10, 20, 30], [20, 40, 60]]
    assert first.get_ylim() == second.get_ylim()
    assert first.yaxis_inverted()
    assert (first.get_xlabel(), first.get_ylabel(), second.get_xlabel()) == (
        "pressure, bar", "bit depth, m", "density, kg/m³",
    )  # fmt: skip
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["bore", "annulus", "one"]
    assert texts_that_overlap(figure) == []


def test_a_page_has_the_same_curves_and_names_each_once() -> None:
    page = panels_page(PANELS)
    assert [list(trace.x) for trace in page.data] == [[10, 20, 30], [20, 40, 60], [1250] * 3, [100]]
    assert [trace.name for trace in page.data if trace.showlegend] == ["bore", "annulus", "one"]
    assert page.layout.yaxis.autorange == "reversed"
    assert page.layout.meta["title"] == "a well"
