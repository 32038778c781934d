"""The profile: it draws the string in the units of its axes, and no text covers another."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from fctd import plots
from fctd.plots import tracks
from fctd.plots.palette import BUCKLED
from fctd.plots.tracks import TRACKS
from fctd.results.notes import Note
from fctd.results.status import SteadyStatus
from tests.plots.made import FOOT, curves, legend_of, points, texts_that_overlap


def of(kind: str) -> Any:
    return next(point for point in points() if point.operation == kind)


def test_the_string_is_drawn_in_the_units_of_the_axes() -> None:
    point = of("trip_out")
    for units, across in (("si", 1e-3), ("field", FOOT / 12)):
        by_name = dict(zip(TRACKS, plots.profile_figure([point], units).axes, strict=True))  # type: ignore[arg-type]
        (offset,) = curves(by_name["offset_high_m"])
        np.testing.assert_allclose(np.asarray(offset.get_xdata()) * across, point.offsets[:, 0], rtol=1e-9)
        band = by_name["offset_high_m"].collections[0].get_paths()[0].vertices[:, 0]
        assert np.abs(band).max() * across == pytest.approx(point.profile["clearance_m"].max(), rel=1e-9)
    assert by_name["offset_high_m"].get_xlabel().endswith("in")
    assert by_name["von_mises_Pa"].get_xlabel().endswith("ksi")
    assert by_name["contact_force_N"].get_xlabel() == "side force per length,\nlbf/ft"


def test_grey_lies_over_the_depths_where_a_lone_string_is_buckled() -> None:
    point = of("drill_sliding")
    ax = plots.profile_figure([point]).axes[0]
    profile = point.profile
    for mode in BUCKLED:
        rows = profile[profile["buckling"] == mode]
        spans = [p for p in ax.patches if p.get_facecolor()[:3] == pytest.approx(rgb(BUCKLED[mode]))]
        assert bool(len(rows)) == bool(spans)
        for span in spans:
            low, high = span.get_y(), span.get_y() + span.get_height()
            assert profile.loc[profile["md_m"].between(low, high), "buckling"].eq(mode).all()
    assert "helical buckling" in legend_of(plots.profile_figure([point]))


def rgb(colour: str) -> list[float]:
    return [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]


def test_a_limit_far_from_the_loads_is_neither_drawn_nor_named() -> None:
    pulled, pushed = plots.profile_figure([of("trip_out")]), plots.profile_figure([of("drill_sliding")])
    assert "helical limit" in legend_of(pushed)
    for figure in (pulled, pushed):
        ax = figure.axes[TRACKS.index("effective_tension_N")]
        drawn = [line for line in ax.lines if line.get_linestyle() == "--"]
        assert len(drawn) == sum(text.endswith(" limit") for text in legend_of(figure))
        left, _ = ax.get_xlim()
        assert all(np.nanmax(line.get_xdata()) >= left for line in drawn)


def test_an_axis_does_not_show_the_noise_of_the_solver() -> None:
    ax = plots.profile_figure([of("trip_in")]).axes[TRACKS.index("torque_N_m")]
    left, right = ax.get_xlim()
    assert np.abs(of("trip_in").profile["torque_N_m"]).max() / 1e3 < 0.1 * (right - left)
    # The torque of the bit, 3 kN·m, is the same all along a string that slides: the axis begins at 0, and the line
    # stands clear of its end.
    left, right = plots.profile_figure([of("drill_sliding")]).axes[TRACKS.index("torque_N_m")].get_xlim()
    assert left <= 0 < 3.05 < right


def test_a_string_without_a_balance_is_only_named() -> None:
    point = replace(of("drill_sliding"), status=SteadyStatus.LOCKED_UP).without_loads()
    figure = plots.profile_figure([point])
    assert "drilling, sliding: no loads (locked up)" in legend_of(figure)
    assert texts_that_overlap(figure) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["trip_in", "drill_sliding"])
def test_labels_of_ticks_stay_beside_their_panel(kind: str) -> None:
    """Half way to the next panel, where the labels of that one begin."""
    figure = plots.profile_figure([of(kind)])
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    for one, other in pairwise(figure.axes):
        middle = 0.5 * (one.bbox.x1 + other.bbox.x0)
        right = [tick.label1.get_window_extent(renderer).x1 for tick in one.xaxis.get_major_ticks()]
        left = [tick.label1.get_window_extent(renderer).x0 for tick in other.xaxis.get_major_ticks()]
        assert right
        assert left
        assert max(right) < middle < min(left)


def test_an_axis_that_begins_at_zero_says_so() -> None:
    """Half of "0.0" reaches no label of the panel before."""
    side_force = plots.profile_figure([of("trip_out")]).axes[TRACKS.index("contact_force_N")]
    assert side_force.get_xlim()[0] == 0
    assert side_force.get_xticks()[0] == 0


@pytest.mark.parametrize(("units", "force"), [("si", "length"), pytest.param("field", "joint", marks=pytest.mark.slow)])
def test_no_text_covers_another(units: Any, force: Any) -> None:
    assert texts_that_overlap(plots.profile_figure(points(), units, force=force)) == []


def test_warnings_and_notes_stand_below_the_title() -> None:
    """Each code once, with its worst numbers."""
    note = Note("yield", "the stress at 700 m is 2000 MPa", "remedy", 700.0, 2.0)
    worse = replace(note, text="the stress at 800 m is 3000 MPa, $\\frac", excess=3.0)
    deep = Note("penetration", "a contact point at 5 m is 9 mm deep", "remedy", 5.0)
    noted = [replace(point) for point in points() if point.answered][:2]
    for point, found in zip(noted, ((note,), (worse, deep)), strict=True):
        point.__dict__["notes"] = found
    small = [text.get_text() for text in plots.profile_figure(noted, warnings=["a warning"]).texts][2:]
    assert small == [
        "warning a warning",
        "note penetration: a contact point at 5 m is 9 mm deep: remedy",
        "note yield: the stress at 800 m is 3000 MPa, $\\frac: remedy",
    ]


def test_a_peak_is_cut_and_marked_with_its_value(monkeypatch: pytest.MonkeyPatch) -> None:
    """A force on the bit alone, here 10 m of 880 m, does not make a line of all the others."""
    monkeypatch.setattr(tracks, "PEAK", 0.02)
    (point,) = [replace(point) for point in points() if point.operation == "trip_out"]
    profile = point.profile.copy()
    profile.loc[profile.index[-1], "contact_force_N"] = 1e6
    point.__dict__["profile"] = profile
    panel = plots.profile_figure([point]).axes[TRACKS.index("contact_force_N")]
    (mark,) = [line for line in panel.lines if line.get_marker() == ">"]
    (text,) = [text.get_text() for text in panel.texts]
    assert (mark.get_xdata()[0], mark.get_ydata()[0]) == (panel.get_xlim()[1], profile["md_m"].iloc[-1])
    assert float(text) > 10 * panel.get_xlim()[1]
