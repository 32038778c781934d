"""The picture of a fed string: its path in the units of the axes, its snaps, and how it ends."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fctd import plots
from fctd.case.message import quantity
from fctd.plots.feeding import ARRIVED, ROW, SNAP, STUCK
from fctd.results.status import SteadyStatus
from fctd.steady.feed import Fed
from fctd.steady.steady_string import Equilibrium
from tests.plots.made import FOOT, LBF, legend_of, points, texts_that_overlap

WEIGHT = 150e3  # on bit, of the strings that drill
# Feed, push, place of the bit, weight on bit, whether the string snapped: bit on bottom after 0.4 m of feed.
OFF_BOTTOM = [(0.0, -3e5, 900.0, 0.0, False), (0.2, -2e5, 900.0, 0.0, True), (0.4, -1e5, 900.15, 0.0, False)]
PRESSED = [(0.4, -1e5, 900.15, 0.0, False), (0.6, 1e5, 900.16, 9e4, True), (0.8, 2e5, 900.17, WEIGHT, False)]
SLIDING = [*OFF_BOTTOM[:2], (0.4, -1e5, 900.1, 0.0, False), (0.5, -9e4, 900.2, 0.0, False)]


def fed(kind: str, path: list[tuple[Any, ...]], **changes: Any) -> Equilibrium:
    """A string of an operation with a path, and loads of which the last is not that of the path."""
    point = next(point for point in points() if point.operation == kind)
    given: dict[str, Any] = {"status": SteadyStatus.CONVERGED, "message": "", "hookload": -2.5e5}
    return replace(point, fed=tuple(Fed(*of) for of in path), **given | changes)


def marks(ax: Axes, look: dict[str, Any]) -> list[tuple[float, float]]:
    """Places of marks with a look."""
    lines = [line for line in ax.lines if line.get_marker() == look["marker"] and line.get_color() == look["color"]
             and line.get_markersize() == look["markersize"]]  # fmt: skip
    places = [np.column_stack([line.get_xdata(), line.get_ydata()]) for line in lines]
    return [(float(x), float(y)) for place in places for x, y in place]


def panels(figure: Figure) -> tuple[Axes, Axes]:
    loads, arrives = figure.axes
    return loads, arrives


@pytest.mark.parametrize(("units", "newton", "metre"), [("si", 1e3, 1.0), ("field", 1e3 * LBF, FOOT)])
def test_the_path_is_drawn_in_the_units_of_the_axes(units: Any, newton: float, metre: float) -> None:
    drilling, tripping = fed("drill_sliding", OFF_BOTTOM + PRESSED), fed("trip_in", SLIDING)
    for point, of, column, scale in (
        (drilling, "weight on bit, ", "weight_on_bit_N", newton), (tripping, "way of the bit, ", "bit_moved_m", metre),
    ):  # fmt: skip
        loads, arrives = panels(plots.feeding_figure(point, units))
        path = point.feeding
        for ax, name, factor in ((loads, "hookload_N", newton), (arrives, column, scale)):
            np.testing.assert_allclose(np.asarray(ax.lines[0].get_xdata()) * metre, path["feed_m"], rtol=1e-12)
            np.testing.assert_allclose(np.asarray(ax.lines[0].get_ydata()) * factor, path[name], rtol=1e-12)
        assert loads.get_ylabel() == f"hook load, {'kN' if units == 'si' else 'klbf'}"
        assert arrives.get_ylabel().startswith(of)
        assert arrives.get_xlabel() == f"feed of the block, {'m' if units == 'si' else 'ft'}"


def test_snaps_are_marked_in_both_panels() -> None:
    figure = plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED))
    loads, arrives = panels(figure)
    assert marks(loads, SNAP) == [(0.2, 200.0), (0.6, -100.0)]
    assert [x for x, _ in marks(arrives, SNAP)] == [0.2, 0.6]
    assert "after a snap (2)" in legend_of(figure)
    calm = plots.feeding_figure(fed("drill_sliding", [OFF_BOTTOM[0], *PRESSED[::2]]))
    assert not any("snap" in text for text in legend_of(calm))


def test_the_end_says_whether_the_feed_arrives() -> None:
    arrived = plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED))
    assert marks(panels(arrived)[1], ARRIVED) == [(0.8, 150.0)]
    assert "weight on bit reached" in legend_of(arrived)
    follows = plots.feeding_figure(fed("trip_in", SLIDING))
    assert "the bit follows" in legend_of(follows)

    short = [*OFF_BOTTOM, *PRESSED[:2]]
    for status, words in (("locked_up", "locked up"), ("unstable", "no balance beyond")):
        point = fed("drill_sliding", short, status=SteadyStatus(status)).without_loads()
        figure = plots.feeding_figure(point)
        assert marks(panels(figure)[0], STUCK) == [(0.6, -100.0)]
        assert words in legend_of(figure)
        assert not any("reached" in text or "sliding on" in text for text in legend_of(figure))
    behind = [*SLIDING[:3], (0.5, -9e4, 900.15, 0.0, False)]
    assert "locked up" in legend_of(plots.feeding_figure(fed("trip_in", behind, status=SteadyStatus.LOCKED_UP)))


def test_the_load_of_the_row_stands_beside_the_end() -> None:
    figure = plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED))
    assert marks(panels(figure)[0], ROW) == [(0.8, -250.0)]
    assert "sliding on: the row's hook load" in legend_of(figure)


def test_a_string_that_begins_sliding_has_followed() -> None:
    assert "the bit follows" in legend_of(plots.feeding_figure(fed("trip_in", OFF_BOTTOM[:1])))
    # One that drills is on bottom from the start: no line says where that begins.
    begun = plots.feeding_figure(fed("drill_sliding", [OFF_BOTTOM[0], OFF_BOTTOM[0], PRESSED[-1]]))
    assert "bit on bottom" not in legend_of(begun)
    assert "bit on bottom" in legend_of(plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED)))


def test_the_limit_of_slack_off_is_drawn_where_the_hook_load_comes_near() -> None:
    """The rig has no block."""
    label = "−block weight: slack-off is spent"
    assert label in legend_of(plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED)))
    light = [(feed, push - 5e5, *rest) for feed, push, *rest in OFF_BOTTOM + PRESSED]
    assert label not in legend_of(plots.feeding_figure(fed("drill_sliding", light, hookload=2.9e5)))


def test_the_heading_has_status_and_message_in_the_units() -> None:
    point = fed("drill_sliding", OFF_BOTTOM, status=SteadyStatus.LOCKED_UP, message=f"stuck below {quantity(300, 'm')}")
    lines = [text.get_text() for text in plots.feeding_figure(point, "field", warnings=["a warning"]).texts]
    assert "locked up: stuck below 984.3 ft" in lines
    assert "warning a warning" in lines


@pytest.mark.parametrize("units", ["si", "field"])
def test_no_text_covers_another(units: Any) -> None:
    message = "fed from rest, the string is locked up with 84 % of the weight on bit; slack-off is spent at 70 %, " * 2
    for point in (
        fed("drill_sliding", OFF_BOTTOM + PRESSED, status=SteadyStatus.LOCKED_UP, message=message),
        fed("trip_in", SLIDING),
    ):
        assert texts_that_overlap(plots.feeding_figure(point, units)) == []


def test_a_string_that_was_not_fed_has_no_picture() -> None:
    with pytest.raises(ValueError, match="fed from rest; the method 'newton' found this one"):
        plots.feeding_figure(next(point for point in points() if point.operation == "trip_out"))
