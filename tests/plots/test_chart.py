"""The chart: its curves are the values of the table in the units of the axes, and no text covers another."""

from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Annotation

from fctd import plots
from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from fctd.plots.chart import LEADER, MOST_GROUPS
from fctd.plots.palette import LOOKS
from fctd.results.notes import MEANINGS
from fctd.results.series import FRICTION_LABEL
from tests.plots.made import (
    DEPTHS,
    FOOT,
    LBF,
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


def test_every_series_is_drawn_in_the_units_of_its_axes() -> None:
    table = chart(["trip_out", "rotate_off_bottom", "trip_in"], [0.2, 0.3])
    for units, force, torque, depth, labels in (
        ("si", 1e3, 1e3, 1.0, ("hook load (string), kN", "surface torque, kN·m", "bit depth, m")),
        (
            "field",
            1e3 * LBF,
            1e3 * FOOT * LBF,
            FOOT,
            ("hook load (string), klbf", "surface torque, kft·lbf", "bit depth, ft"),
        ),
    ):
        left, right = plots.chart_figure(table, units).axes
        assert (left.get_xlabel(), right.get_xlabel(), left.get_ylabel()) == labels
        assert left.get_ylim()[0] > left.get_ylim()[1]
        for ax, column, factor in ((left, "hookload_N", force), (right, "surface_torque_N_m", torque)):
            drawn = curves(ax)
            assert len(drawn) == 6
            for (kind, _), rows in table.groupby(["operation", "friction"]):
                fits = [line for line in drawn if np.allclose(line.get_xdata(), rows[column] / factor, rtol=1e-9)]
                assert LOOKS[kind][0] in {line.get_color() for line in fits}
                np.testing.assert_allclose(fits[0].get_ydata(), rows["bit_depth_m"] / depth, rtol=1e-9)


def test_the_weight_indicator_is_shown_and_named_where_it_is_asked_for() -> None:
    table = chart(["trip_in"], [0.2])
    left, _ = plots.chart_figure(table, "si", CASE, plots.ChartLook("indicator")).axes
    assert left.get_xlabel() == "weight indicator (string and block), kN"
    np.testing.assert_allclose(curves(left)[0].get_xdata(), table["weight_indicator_N"] / 1e3)


def test_curves_are_labelled_at_their_ends_and_not_in_a_legend() -> None:
    figure = plots.chart_figure(chart(["trip_out", "trip_in"], [0.2, 0.3]))
    names = {f"{kind}, μ {factor}" for kind in ("picking up", "slacking off") for factor in (0.2, 0.3)}
    for ax in figure.axes:
        assert set(labels_of(ax)) == names
    assert legend_of(figure) == []


def test_labels_that_do_not_fit_go_into_the_legend() -> None:
    table = chart(["trip_out", "trip_in"], [0.2, 0.3])
    table[FRICTION_LABEL] = table["friction"].map(lambda x: f"cased {x:.2f}, liner {x:.2f}, open hole below it {x:.2f}")
    figure = plots.chart_figure(table)
    assert [text for ax in figure.axes for text in labels_of(ax)] == []
    assert len(legend_of(figure)) == 4
    assert texts_that_overlap(figure) == []


def test_at_most_six_curves_share_a_panel() -> None:
    figure = plots.chart_figure(chart(list(KINDS), [0.2, 0.3]))
    assert [len(curves(ax)) for ax in figure.axes] == [6] * 4
    assert [ax._left_title.get_text() for ax in figure.axes[::2]] == ["friction factor 0.2", "friction factor 0.3"]
    assert len({ax.get_xlim() for ax in figure.axes[::2]}) == 1
    with pytest.raises(InputError, match=f"at most {MOST_GROUPS} groups"):
        plots.chart_figure(chart(list(KINDS), list(np.linspace(0.1, 0.9, 25 * 6))))


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


def test_where_slack_off_is_spent_is_hatched_and_named() -> None:
    figure = plots.chart_figure(locked_chart(), "si", CASE)
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


def test_measured_points_are_drawn_over_the_curves() -> None:
    measured = pd.DataFrame(
        {"operation": ["trip_in"], "bit_depth_m": [1500.0]}
        | {f"{stem}{end}": [value * 1e3] for stem in ("hookload", "weight_indicator")
           for end, value in (("_N", 300.0), ("_low_N", 250.0), ("_high_N", 2000.0))}
        | {f"surface_torque{end}_N_m": [np.nan] for end in ("", "_low", "_high")}
    )  # fmt: skip
    figure = plots.chart_figure(chart(["trip_in"], [0.2]), look=plots.ChartLook(measured=measured))
    left, right = figure.axes
    assert [
        (line.get_xdata()[0], line.get_ydata()[0]) for line in left.lines if line.get_markeredgecolor() == "black"
        and line.get_markersize() > 7
    ] == [(300.0, 1500.0)]  # fmt: skip
    assert left.get_xlim()[1] > 2000  # the axis grows
    assert right.get_xlim()[1] < 10
    assert "measured, with range" in legend_of(figure)
