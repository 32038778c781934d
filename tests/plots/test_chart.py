"""The chart: its curves are the values of the table in the units of the axes, and no text covers another."""

from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Annotation

from fctd import plots
from fctd.answers.steady import Chart
from fctd.case.operations import KINDS
from fctd.plots.chart import LEADER
from fctd.plots.describe import describe
from fctd.results.notes import MEANINGS
from fctd.results.series import FRICTION_LABEL
from tests.plots.made import (
    DEPTHS,
    chart,
    curves,
    labels_of,
    legend_of,
    lines,
    locked_chart,
    texts_that_overlap,
    well,
)

CASE = well(bit={"weight_on_bit": 8e4}, rig={"block_weight": 3e4}, mud={"density": 1200.0})


@pytest.mark.parametrize("units", ["si", "field"])
def test_panels_and_their_axes_are_those_of_the_description(units: Any) -> None:
    table = chart(list(KINDS), [0.2, 0.3])
    described = describe(table, units, CASE)
    axes = iter(plots.chart_figure(table, units, CASE).axes)
    for group in described.groups:
        for panel, ax in zip(group.panels, axes, strict=False):
            assert (ax.get_xlabel(), ax.get_xlim()) == (panel.label, (panel.limits.low, panel.limits.high))
            assert ax.get_ylim() == (described.depth.lower, described.depth.upper)
            for curve, line in zip(panel.curves, curves(ax), strict=True):
                np.testing.assert_array_equal(line.get_xydata(), np.column_stack((curve.line, curve.depth)))


def test_curves_are_labelled_at_their_ends_and_not_in_a_legend() -> None:
    figure = plots.chart_figure(chart(["trip_out", "trip_in"], [0.2, 0.3]))
    names = {f"{kind}, μ {factor}" for kind in ("picking up", "slacking off") for factor in (0.2, 0.3)}
    assert [set(labels_of(ax)) for ax in figure.axes] == [names, {"picking up", "slacking off"}]
    assert legend_of(figure) == []


def test_ends_of_a_wide_fan_have_their_factors_and_the_legend_the_operations() -> None:
    figure = plots.chart_figure(chart(["trip_out", "rotate_off_bottom", "trip_in"], [0.1, 0.2, 0.3]))
    assert sorted(labels_of(figure.axes[0])) == ["rotating", *sorted(["μ 0.1", "μ 0.2", "μ 0.3"] * 2)]
    assert legend_of(figure) == ["picking up", "rotating off bottom", "slacking off"]
    assert texts_that_overlap(figure) == []


def test_labels_that_do_not_fit_go_into_the_legend() -> None:
    table = chart(["trip_out", "trip_in"], [0.2, 0.3])
    table[FRICTION_LABEL] = table["friction"].map(lambda x: f"cased {x:.2f}, liner {x:.2f}, open hole below it {x:.2f}")
    figure = plots.chart_figure(table)
    assert [text for ax in figure.axes for text in labels_of(ax)] == []
    # Operations, and factors.
    assert len(legend_of(figure)) == 4
    assert texts_that_overlap(figure) == []


def test_lines_differ_without_colour() -> None:
    """In grey, operations are distinguished by their markers and friction factors by their dashes."""
    left, _ = plots.chart_figure(chart(["trip_out", "trip_in", "back_ream"], [0.1, 0.2])).axes
    assert len({(line.get_marker(), str(line._dash_pattern)) for line in curves(left)}) == 6


def test_facts_and_shoes_are_in_the_picture() -> None:
    figure = plots.chart_figure(chart(["trip_in", "drill_sliding"], [0.2]), "si", CASE)
    text = " ".join(text.get_text() for text in figure.texts)
    for fact in ("mud 1200 kg/m³", "weight on bit 80 kN", "block 30 kN", "slacking off 0.3 m/s"):
        assert fact in text
    assert "shoe 1500 m" in [text for ax in figure.axes for text in labels_of(ax)]
    assert all(any(list(line.get_ydata()) == [1500, 1500] for line in ax.lines) for ax in figure.axes)


def test_warnings_and_notes_stand_below_the_title() -> None:
    table = chart(["trip_in"], [0.2])
    table.loc[3, "notes"] = "yield, penetration"
    figure = plots.chart_figure(table, "si", CASE, plots.ChartLook(warnings=["mud.density: a warning, $\\frac"]))
    found = [text.get_text() for text in figure.texts][2:]
    notes = [f"note {code}: {': '.join(MEANINGS[code])}" for code in ("penetration", "yield")]
    assert found == ["warning mud.density: a warning, $\\frac", *notes]
    assert texts_that_overlap(figure) == []


@pytest.mark.parametrize(
    ("kinds", "factors", "units", "load"),
    [
        (["trip_in"], [0.2], "si", "string"),
        (list(KINDS), [0.2], "field", "indicator"),
        pytest.param(list(KINDS), [0.2, 0.3], "si", "string", marks=pytest.mark.slow),
    ],
)
def test_no_text_covers_another(kinds: list[str], factors: list[float], units: Any, load: Any) -> None:
    """At 1, 6 and 12 curves; with rows of every status."""
    table = chart(
        kinds, factors, {"max_iterations": "trip_in", "under_resolved": "drill_sliding", "unstable": "back_ream"}
    )
    named = CASE.model_copy(update={"name": "a well of a rather long name, $1 \\frac 5$"})
    assert texts_that_overlap(plots.chart_figure(table, units, named, plots.ChartLook(load))) == []


def test_no_text_of_several_cases_covers_another() -> None:
    """Two cases of long names, with a formula and a character that does not print, whose strings are not converged."""
    names = ["a well of a rather long name, $1 \\frac 5$, plan A \x1b", "a well of a rather long name, plan B"]
    tables = [chart(["trip_out", "trip_in"], [0.2], {"under_resolved": "trip_in"}).assign(case=name) for name in names]
    charts = {name: Chart(CASE, table, (), (), {}) for name, table in zip(names, tables, strict=True)}
    look = plots.ChartLook("string", told=["mud.density: 1 sg, 2 sg"] * 3)
    figure = plots.chart_figure(pd.concat(tables), "si", charts, look)
    assert texts_that_overlap(figure) == []
    assert any(text.endswith("plan A \\x1b") and len(text) == 40 for text in legend_of(figure))


def test_where_slack_off_is_spent_is_hatched_and_named() -> None:
    figure = plots.chart_figure(locked_chart(), "si", CASE, plots.ChartLook("string"))
    left = figure.axes[0]
    (hatched,) = [patch for patch in left.patches if patch.get_hatch()]
    assert hatched.get_x() == pytest.approx(left.get_xlim()[0])
    assert hatched.get_x() + hatched.get_width() == pytest.approx(-30)
    assert "slack-off is spent" in labels_of(left)
    assert {
        "helical buckling",
        "slack-off is spent (locked up)",
        "no push suffices (locked up)",
        "beyond the axis",
    } <= set(legend_of(figure))
    assert texts_that_overlap(figure) == []


def test_a_series_without_any_answer_is_still_seen() -> None:
    table = chart(["trip_in"], [0.2])
    table["status"] = "max_iterations"
    table[["hookload_N", "surface_torque_N_m"]] = np.nan
    figure = plots.chart_figure(table)
    for ax in figure.axes[:2]:
        (crosses,) = [line for line in ax.lines if line.get_marker() == "x"]
        assert len(crosses.get_xdata()) == len(DEPTHS)
    assert figure.findobj(Annotation) == []
    assert "no loads: no equilibrium found" in legend_of(figure)


def test_the_line_to_a_label_far_below_its_curve_is_dotted() -> None:
    """A solid one would look like loads at the depths that have none."""
    table = chart(["trip_out", "trip_in"], [0.2])
    fails = (table["operation"] == "trip_in") & (table["bit_depth_m"] > 1500)
    table.loc[fails, "status"] = "not_possible"
    table.loc[fails, ["hookload_N", "surface_torque_N_m"]] = np.nan
    left = plots.chart_figure(table).axes[0]
    leaders = {line.get_ydata()[0]: line for line in lines(left, color=LEADER["color"], linewidth=LEADER["linewidth"])}
    assert {depth: line.is_dashed() for depth, line in leaders.items()} == {1500.0: True, 2000.0: False}


def test_one_depth_has_one_tick() -> None:
    table = chart(["trip_in"], [0.2])
    left, _ = plots.chart_figure(table[table["bit_depth_m"] == 1500]).axes
    assert list(left.get_yticks()) == [1500]
