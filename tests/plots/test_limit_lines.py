"""Limits in charts: their lines are the rows of the table, within the axes, with their names in the legend."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest

from fctd import plots
from fctd.model.operations import weight_indicator
from fctd.plots.chart import LIMIT_WIDTH
from fctd.plots.limit_lines import limit_lines
from fctd.plots.loads import TORQUE, ChartLook
from fctd.plots.palette import LOOKS
from tests.plots.made import chart, legend_of, lines, texts_that_overlap, well

CASE = well(rig={"block_weight": 2e5})
MARGINS = pd.DataFrame(
    [
        {"operation": kind, "limit": limit, "bit_depth_m": depth, "hookload_N": load, "surface_torque_N_m": torque}
        for kind, limit, load, torque in (
            ("trip_out", "yield", 3e6, np.nan), ("trip_out", "hoist", 2e6, np.nan),
            ("trip_in", "lock_up", np.nan, np.nan), ("rotate_off_bottom", "drive", np.nan, 60e3),
            ("back_ream", "yield", 9e6, np.nan),
        )
        for depth in (1000.0, 1500.0, 2000.0)
    ]
)  # fmt: skip
LOOK = ChartLook("string", margins=MARGINS)


def test_a_limit_without_numbers_is_left_out() -> None:
    found = limit_lines(MARGINS, CASE, "string", "hookload_N")
    assert [(line.operation, line.limit) for line in found] == [
        ("trip_out", "yield"), ("trip_out", "hoist"), ("back_ream", "yield"),
    ]  # fmt: skip
    assert [line.limit for line in limit_lines(MARGINS, CASE, "string", TORQUE)] == ["drive"]
    assert limit_lines(None, CASE, "string", TORQUE) == []


def test_the_indicator_reads_block_and_string() -> None:
    line = limit_lines(MARGINS, CASE, "indicator", "weight_indicator_N")[1]
    assert line.value == pytest.approx(weight_indicator(CASE.rig, -1, 2e6))


def test_lines_are_drawn_for_the_operations_of_the_chart_and_within_the_axes() -> None:
    table = chart(["trip_in", "trip_out", "rotate_off_bottom"], [0.2])
    figure = plots.chart_figure(table, "si", CASE, LOOK)
    first, second = figure.axes
    drawn = lines(first, linewidth=LIMIT_WIDTH)
    assert [(line.get_color(), line.get_xdata()[0]) for line in drawn] == [
        (LOOKS["trip_out"][0], 3000.0), (LOOKS["trip_out"][0], 2000.0),
    ]  # fmt: skip
    assert first.get_xlim()[1] > 3000
    assert [line.get_xdata()[-1] for line in lines(second, linewidth=LIMIT_WIDTH)] == [60.0]
    assert {"limit: yield", "limit: hoist", "limit: drive"} <= set(legend_of(figure))
    assert texts_that_overlap(figure) == []


def named(figure: object) -> Iterator[tuple[str, float]]:
    for trace in figure.data:  # type: ignore[attr-defined]
        if str(trace.name).startswith("limit: "):
            yield trace.name, round(float(trace.x[0]), 3)


def test_a_page_has_the_same_lines() -> None:
    pytest.importorskip("plotly")
    page = plots.chart_page(chart(["trip_out", "rotate_off_bottom"], [0.2]), "field", CASE, LOOK)
    assert dict(named(page)) == {"limit: yield": 674.427, "limit: hoist": 449.618, "limit: drive": 44.254}
