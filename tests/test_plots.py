"""Pictures: they show the values of the tables in the units of the axes, and no text covers another."""

from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("matplotlib")

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation

from fctd import plots
from fctd.case.operations import KINDS
from fctd.results.notes import MEANINGS, Note
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Equilibrium, equilibrium
from tests.cases import make_case, pipe

LBF, FOOT = 4.4482216152605, 0.3048
DEPTHS = np.arange(1000.0, 2001.0, 50.0)


def chart(kinds: list[str], frictions: list[float], lost: dict[str, str] | None = None) -> pd.DataFrame:
    """A chart of made-up loads; ``lost`` maps a status to the kind whose upper half has it."""
    rows = [
        {
            "operation": kind,
            "friction": friction,
            "bit_depth_m": depth,
            "hookload_N": 400.0 * depth + 1e5 * friction * k,
            "surface_torque_N_m": 10.0 * friction * depth * (k + 1) ** 2,
            "hookload_low_N": np.nan,
            "hookload_high_N": np.nan,
            "buckling": "none",
            "status": "converged",
            "notes": "none",
        }
        for k, kind in enumerate(kinds)
        for friction in frictions
        for depth in DEPTHS
    ]
    table = pd.DataFrame(rows)
    for status, kind in (lost or {}).items():
        at = (table["operation"] == kind) & (table["bit_depth_m"] < 1500)
        table.loc[at, "status"] = status
        if status not in plots.FLAGS:
            table.loc[at, ["hookload_N", "surface_torque_N_m"]] = np.nan
    return table


@pytest.fixture(scope="module")
def points() -> list[Equilibrium]:
    """Every kind of operation in one well, the drilling ones buckled or out of balance."""
    stations = [[0.0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
    case = make_case(
        stations,
        [pipe(200, 10, 0.16), pipe(None, None, segment_length=20.0)],
        bit={"weight_on_bit": 150e3, "torque": 3e3},
    )
    return [equilibrium(case, kind, 880.0) for kind in KINDS]


def lines(ax: Axes, **look: Any) -> list[Line2D]:
    """The lines of an axis that look so."""
    return [line for line in ax.lines if all(getattr(line, f"get_{name}")() == value for name, value in look.items())]


def texts_that_overlap(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of visible texts of which one covers part of the other."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    shown = [*([figure._suptitle] if figure._suptitle else []), *figure.findobj(Annotation)]
    for ax in figure.axes:
        shown += [ax.xaxis.label, ax.yaxis.label, ax.title, ax.xaxis.get_offset_text()]
        for axis in (ax.xaxis, ax.yaxis) if ax is figure.axes[0] else (ax.xaxis,):
            low, high = sorted(axis.get_view_interval())
            shown += [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
    for legend in figure.legends:
        shown += legend.get_texts()
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in shown if text.get_text()]
    inside = figure.bbox.padded(1)
    assert [t for t, box in boxes if not (inside.x0 < box.x0 < box.x1 < inside.x1 and inside.y0 < box.y0)] == []
    return [(one, other) for (one, a), (other, b) in combinations(boxes, 2) if a.padded(-0.5).overlaps(b.padded(-0.5))]


def test_a_chart_draws_every_series_in_the_units_of_its_axes() -> None:
    table = chart(["trip_out", "rotate_off_bottom", "trip_in"], [0.2, 0.3])
    for units, force, torque, depth, labels in (
        ("si", 1e3, 1e3, 1.0, ("hook load, kN", "surface torque, kN·m", "bit depth, m")),
        ("field", 1e3 * LBF, 1e3 * FOOT * LBF, FOOT, ("hook load, klbf", "surface torque, kft·lbf", "bit depth, ft")),
    ):
        left, right = plots.chart_figure(table, units, "well").axes
        assert (left.get_xlabel(), right.get_xlabel(), left.get_ylabel()) == labels
        assert left.get_ylim()[0] > left.get_ylim()[1]
        for ax, column, factor in ((left, "hookload_N", force), (right, "surface_torque_N_m", torque)):
            drawn = [line for line in ax.lines if len(line.get_xdata())]
            assert len(drawn) == 6
            for (kind, _), rows in table.groupby(["operation", "friction"]):
                fits = [line for line in drawn if np.allclose(line.get_xdata(), rows[column] / factor, rtol=1e-9)]
                assert {line.get_color() for line in fits} == {plots.LOOKS[kind][0]}
                np.testing.assert_allclose(fits[0].get_ydata(), rows["bit_depth_m"] / depth, rtol=1e-9)


@pytest.mark.parametrize(
    ("factors", "heading", "named"),
    [([0.2], "friction factor 0.2", set()), ([0.2, 0.3], "", {"friction factor 0.2", "friction factor 0.3"})],
)
def test_friction_is_named_once(factors: list[float], heading: str, named: set[str]) -> None:
    figure = plots.chart_figure(chart(["trip_in"], factors))
    texts = {text.get_text() for legend in figure.legends for text in legend.get_texts()}
    assert (figure._suptitle.get_text(), {text for text in texts if "friction" in text}) == (heading, named)


def test_lines_differ_without_colour() -> None:
    """In grey, operations are distinguished by their markers and friction factors by their dashes."""
    left, _ = plots.chart_figure(chart(list(KINDS), [0.1, 0.2, 0.3])).axes
    looks = {(line.get_marker(), str(line._dash_pattern)) for line in left.lines if len(line.get_xdata())}
    assert len(looks) == len(KINDS) * 3


def test_rows_without_an_answer_are_crossed_where_their_line_breaks() -> None:
    table = chart(["trip_out", "trip_in"], [0.2], {"diverged": "trip_in", "locked_up": "trip_out"})
    figure = plots.chart_figure(table)
    lost = int((table["status"] == "diverged").sum())
    for ax in figure.axes:
        (crosses,) = [line for line in lines(ax, marker="x") if len(line.get_xdata())]
        assert len(crosses.get_xdata()) == lost
        assert np.isfinite(crosses.get_xdata()).all()
        (squares,) = [line for line in lines(ax, marker="s") if len(line.get_xdata())]
        assert len(squares.get_xdata()) == lost
    legend = [text.get_text() for box in figure.legends for text in box.get_texts()]
    assert "no answer: diverged" in legend
    assert "locked_up" in legend


def test_rows_with_a_buckled_string_have_a_disc_below_their_line() -> None:
    """Light grey for snaking, dark for the helix, and both in the legend; none where nothing is buckled."""
    table = chart(["trip_in", "trip_out"], [0.2])
    rows = table.index[table["operation"] == "trip_in"]
    table.loc[rows[3:6], "buckling"], table.loc[rows[6:], "buckling"] = "sinusoidal", "helical"
    figure = plots.chart_figure(table)
    for ax, column in zip(figure.axes, ("hookload_N", "surface_torque_N_m"), strict=True):
        for mode, look in plots.DISCS.items():
            (discs,) = lines(ax, color=look["color"])
            at = table["buckling"] == mode
            np.testing.assert_allclose(discs.get_xdata(), table.loc[at, column] / 1e3)
            np.testing.assert_allclose(discs.get_ydata(), table.loc[at, "bit_depth_m"])
            assert discs.get_zorder() < min(line.get_zorder() for line in lines(ax, color=plots.LOOKS["trip_in"][0]))
    legend = [text.get_text() for box in figure.legends for text in box.get_texts()]
    assert {"sinusoidal buckling", "helical buckling"} <= set(legend)
    assert texts_that_overlap(figure) == []
    figure = plots.chart_figure(chart(["trip_in"], [0.2]))
    assert not [text for box in figure.legends for text in box.get_texts() if "buckling" in text.get_text()]


def locked_chart() -> pd.DataFrame:
    """A string that slides deeper: pushed from 1,500 m on, too hard to show from 1,650 m, stuck from 1,800 m."""
    table = chart(["drill_sliding"], [0.3])
    depth = table["bit_depth_m"]
    table["hookload_N"] = 300.0 * (1400 - depth)
    table["surface_torque_N_m"] = 0.0
    table.loc[depth >= 1650, "hookload_N"] = -5e7
    table.loc[depth >= 1800, ["hookload_N", "surface_torque_N_m"]] = np.nan
    table.loc[depth >= 1500, "status"] = "locked_up"
    return table


def test_pushes_do_not_set_the_axis_and_are_marked_at_its_edge() -> None:
    """Slack-off is spent at 30 kN block weight; 120 kN at 1,000 m to −15 kN at 1,450 m are the other hook loads."""
    table, block = locked_chart(), 30e3
    figure = plots.chart_figure(table, title="well", block_weight=block)
    left, _ = figure.axes
    edge, right = left.get_xlim()
    assert edge == pytest.approx(-30 - plots.BESIDE * 150)
    assert right > 120
    (limit,) = lines(left, color=plots.QUIET, linestyle="-")
    assert list(limit.get_xdata()) == [-30, -30]
    (hatched,) = left.patches
    assert (hatched.get_x(), hatched.get_x() + hatched.get_width()) == pytest.approx((edge, -30))
    cut, stuck = (
        next(line for line in lines(left, marker="<") if line.get_markerfacecolor() == face)
        for face in ("white", plots.LOOKS["drill_sliding"][0])
    )
    for marks, depths in ((cut, [1650.0, 1700.0, 1750.0]), (stuck, [1800.0, 1850.0, 1900.0, 1950.0, 2000.0])):
        assert list(marks.get_xdata()) == pytest.approx([edge] * len(depths))
        assert list(marks.get_ydata()) == depths
    (line,) = lines(left, marker=plots.LOOKS["drill_sliding"][1])
    assert list(line.get_xdata()[-7:]) == pytest.approx([-5e4] * 2 + [edge] * 5)
    assert not [marks for ax in figure.axes for marks in lines(ax, marker="x") if len(marks.get_xdata())]
    legend = {text.get_text() for box in figure.legends for text in box.get_texts()}
    assert {"slack-off is spent", "pushed harder than shown", "locked up: no push suffices", "locked_up"} <= legend
    assert not [text for text in legend if "no answer" in text]
    assert texts_that_overlap(figure) == []


@pytest.mark.parametrize("units", ["si", "field"])
def test_a_chart_of_nothing_but_pushes_shows_the_least(units: Any) -> None:
    table = locked_chart()
    table["status"] = "locked_up"
    table.loc[table["bit_depth_m"] < 1500, "hookload_N"] = np.nan
    left, _ = plots.chart_figure(table, units).axes
    edge, right = left.get_xlim()
    least = table["hookload_N"].max() / (1e3 if units == "si" else 1e3 * LBF)
    assert edge < least < 0 < right
    table["hookload_N"] = np.nan
    left, _ = plots.chart_figure(table, units).axes
    assert left.get_xlim()[0] < 0 < left.get_xlim()[1]


def test_a_band_spans_the_hook_loads_of_both_shapes() -> None:
    table = chart(["trip_in"], [0.2])
    table.loc[4:8, "hookload_low_N"] = table.loc[4:8, "hookload_N"]
    table.loc[4:8, "hookload_high_N"] = table.loc[4:8, "hookload_N"] + 5e4
    figure = plots.chart_figure(table)
    left, torque = figure.axes
    band, bars = left.collections
    edges = band.get_paths()[0].vertices
    for k in range(4, 9):
        row = table.loc[k]
        at = edges[edges[:, 1] == row["bit_depth_m"], 0]
        assert (at.min(), at.max()) == pytest.approx((row["hookload_low_N"] / 1e3, row["hookload_high_N"] / 1e3))
    assert len(bars.get_segments()) == 5
    assert not torque.collections
    legend = {text.get_text() for box in figure.legends for text in box.get_texts()}
    assert "hook loads of both shapes" in legend
    assert texts_that_overlap(figure) == []


def test_a_profile_of_a_locked_string_without_a_balance_is_only_named(points: list[Equilibrium]) -> None:
    point = next(point for point in points if point.operation == "drill_sliding")
    figure = plots.profile_figure([replace(point, status=SteadyStatus.LOCKED_UP).without_loads()])
    legend = [text.get_text() for box in figure.legends for text in box.get_texts()]
    assert "drilling, sliding: no answer (locked_up)" in legend
    assert texts_that_overlap(figure) == []


def test_every_status_with_loads_has_a_mark() -> None:
    flagged = {str(status) for status in SteadyStatus if status.has_loads and status != "converged"}
    assert set(plots.FLAGS) == flagged


def test_a_series_without_any_answer_is_still_seen() -> None:
    table = chart(["trip_in"], [0.2])
    table["status"] = "max_iterations"
    table[["hookload_N", "surface_torque_N_m"]] = np.nan
    for ax in plots.chart_figure(table).axes:
        (crosses,) = lines(ax, marker="x")
        assert len(crosses.get_xdata()) == len(DEPTHS)
        assert ((np.asarray(crosses.get_xdata()) > 0) & (np.asarray(crosses.get_xdata()) < 1)).all()


def test_a_lone_answer_carries_a_marker() -> None:
    table = chart(["trip_in"], [0.2])
    lone = 3
    table.loc[table.index != lone, ["hookload_N", "surface_torque_N_m"]] = np.nan
    table.loc[table.index != lone, "status"] = "diverged"
    left, _ = plots.chart_figure(table).axes
    (line,) = lines(left, marker=plots.LOOKS["trip_in"][1])
    assert lone in line.get_markevery()


def test_rounding_noise_is_drawn_as_zero() -> None:
    """A sliding string has no torque; what the solver leaves of it must not fill the axis."""
    table = chart(["trip_in"], [0.2])
    table["surface_torque_N_m"] = 1e-9 * np.sin(table["bit_depth_m"])
    _, torque = plots.chart_figure(table).axes
    assert torque.get_xlim() == (-1, 1)


def test_a_profile_draws_the_string_in_the_units_of_its_axes(points: list[Equilibrium]) -> None:
    point = next(point for point in points if point.operation == "trip_out")
    for units, across in (("si", 1e-3), ("field", FOOT / 12)):
        figure = plots.profile_figure([point], units)
        by_name = dict(zip(plots.TRACKS, figure.axes, strict=True))
        (offset,) = by_name["offset_high_m"].lines
        np.testing.assert_allclose(np.asarray(offset.get_xdata()) * across, point.profile["offset_high_m"], rtol=1e-9)
        band = by_name["offset_high_m"].collections[0].get_paths()[0].vertices[:, 0]
        assert np.abs(band).max() * across == pytest.approx(point.profile["clearance_m"].max(), rel=1e-9)
    assert by_name["offset_high_m"].get_xlabel().endswith("in")
    assert by_name["von_mises_Pa"].get_xlabel().endswith("ksi")
    (touching,) = by_name["contact_force_N"].lines
    assert len(touching.get_xdata()) == (point.profile["contact_force_N"] > 0).sum()


def test_a_profile_marks_where_the_string_is_beyond_its_buckling_limits(points: list[Equilibrium]) -> None:
    point = next(point for point in points if point.operation == "drill_sliding")
    assert point.answered
    ax = dict(zip(plots.TRACKS, plots.profile_figure([point]).axes, strict=True))["effective_tension_N"]
    for mode, look in plots.BUCKLED.items():
        (marked,) = [line for line in lines(ax, marker=look["marker"]) if line.get_linestyle() == "None"]
        rows = point.profile[point.profile["buckling"] == mode]
        assert len(rows)
        np.testing.assert_allclose(marked.get_ydata(), rows["md_m"])
    left, right = ax.get_xlim()
    assert left < point.profile["effective_tension_N"].min() / 1e3
    assert right > 0


@pytest.mark.parametrize("units", ["si", "field"])
def test_no_text_covers_another(points: list[Equilibrium], units: Any) -> None:
    table = chart(list(KINDS), [0.1, 0.2, 0.3], {"max_iterations": "trip_in", "under_resolved": "drill_sliding"})
    table.loc[table["status"] == "under_resolved", "buckling"] = "helical"
    assert texts_that_overlap(plots.chart_figure(table, units, "a well of a rather long name, $1 \\frac 5$")) == []
    assert texts_that_overlap(plots.chart_figure(chart(["trip_in"], [float("nan")]), units, "well")) == []
    assert texts_that_overlap(plots.profile_figure(points, units)) == []
    for point in (points[0], points[-1]):  # one in order, and one that is buckled and out of balance
        assert texts_that_overlap(plots.profile_figure([point], units)) == []


def test_notes_stand_below_the_title(points: list[Equilibrium]) -> None:
    """Each code once, with its worst numbers, clear of everything else."""
    note = Note("yield", "the stress at 700 m is 2000 MPa", "remedy", 700.0, 2.0)
    worse = replace(note, text="the stress at 800 m is 3000 MPa, $\\frac", excess=3.0)
    deep = Note("penetration", "a contact point at 5 m is 9 mm deep", "remedy", 5.0)
    noted = [replace(point) for point in points if point.answered]
    for point, found in zip(noted, ((note,), (worse, deep)), strict=False):
        point.__dict__["notes"] = found
    figure = plots.profile_figure(noted)
    (small,) = figure.findobj(Annotation)
    assert small.get_text() == (
        "note penetration: a contact point at 5 m is 9 mm deep\nnote yield: the stress at 800 m is 3000 MPa, $\\frac"
    )
    assert texts_that_overlap(figure) == []

    table = chart(["trip_in"], [0.2])
    table.loc[3, "notes"] = "yield, penetration"
    figure = plots.chart_figure(table, title="well")
    (small,) = figure.findobj(Annotation)
    assert small.get_text() == "\n".join(f"note {code}: {MEANINGS[code].headline}" for code in ("penetration", "yield"))
    assert texts_that_overlap(figure) == []
    assert plots.chart_figure(chart(["trip_in"], [0.2])).findobj(Annotation) == []


def test_files_are_as_their_suffix_says_and_the_same_each_time(tmp_path: Path) -> None:
    for suffix, start in ((".png", b"\x89PNG"), (".svg", b"<?xml")):
        first, second = tmp_path / f"a{suffix}", tmp_path / "new" / f"b{suffix}"
        for path in (first, second):
            assert plots.save(plots.chart_figure(chart(["trip_in"], [0.2])), path) == [path]
        assert first.read_bytes().startswith(start)
        assert first.read_bytes() == second.read_bytes()
