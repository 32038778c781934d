"""The picture of a range of counts: a panel for each load, a curve for each layout, and the tolerance."""

import pytest

import fctd
from fctd.plots.counts import counts_figure
from tests.cases import make_case, pipe

BUILD = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1300, 60, 0]]


def test_each_load_has_a_panel_and_each_layout_a_curve() -> None:
    case = make_case(BUILD, [pipe(None, None, segment_length=10.0)], wellbore={"geometry": "arcs"})
    found = fctd.refine(case, 0.01, ["rotate_off_bottom", "trip_out"], 1300.0, segments="10:160")
    assert found.orders is not None
    axes = counts_figure("a well", found.steps, found.orders, found.tolerance).axes
    assert [ax.get_title("left") for ax in axes] == [
        "hook load, rotating off bottom", "torque, rotating off bottom", "hook load, picking up",
    ]  # fmt: skip
    steps = found.steps[(found.steps["stage"] == "counts") & (found.steps["operation"] == "rotate_off_bottom")]
    for line, layout in zip(axes[1].get_lines(), ("uniform", "graded", "default"), strict=False):
        of = steps[steps["layout"] == layout]
        assert list(line.get_xdata()) == of["segments"].tolist()
        assert list(line.get_ydata()) == pytest.approx((100 * of["torque_error"]).tolist())
    assert list(axes[1].get_lines()[-1].get_ydata()) == [1.0, 1.0]  # the tolerance, in percent
    assert "observed order, graded: " in axes[1].get_xlabel()
