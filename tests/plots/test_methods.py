"""The picture of a comparison: names of all methods, bars of quartiles, names that do not meet."""

import numpy as np
import pytest

from fctd.arena.result import Comparison, Cost, Quartiles, Row, WallErrors
from fctd.plots.methods import STEP, _apart, methods_figure


def compared(errors: dict[str, float]) -> Comparison:
    """Methods by their largest error [m], each of its own cost."""
    rows = []
    for k, (name, error) in enumerate(errors.items()):
        time = Quartiles(median=10.0**k, low=0.9 * 10.0**k, high=1.2 * 10.0**k)
        off = WallErrors(
            points=9, touching=4, no_answer=0, largest_penetration_m=error, largest_angle_deg=0, missed=0,
            false_contacts=0,
        )  # fmt: skip
        cost = Cost(points=9, point_ns=time, kernels=time)
        rows.append(Row(kind="contact", name=name, status="measured", broken=[], errors=off, costs=[cost]))
    return Comparison(case="a well", digest="d", reference="exact circular arcs", rows=rows, budget_s=1.0)


def test_every_method_is_named() -> None:
    figure = methods_figure(compared({"exact": 0.0, "near": 1e-4, "like it": 1e-4, "far": 3e-3}))
    left, right = figure.axes
    assert {text.get_text() for text in left.texts} == {"exact, exact", "near", "like it", "far"}
    assert right.texts[0].get_text() == "no other loads"
    assert len(left.containers) == 4  # points with the bars of their quartiles


def test_a_method_that_breaks_the_contract_says_so() -> None:
    found = compared({"a": 1e-3, "b": 1e-3})
    found.rows[1].broken = ["a demand"]
    assert "b, breaks the contract" in {text.get_text() for text in methods_figure(found).axes[0].texts}


def test_names_keep_apart_and_in_the_panel() -> None:
    for heights in ([0.5] * 12, [0.0, 0.01, 0.99, 1.0], [0.2, 0.5, 0.8]):
        found = _apart(heights)
        assert np.diff(found).min() >= STEP - 1e-9
        assert found[0] >= -1e-9
        assert found[-1] <= 1 + 1e-9
    assert _apart([0.2, 0.5, 0.8]) == [0.2, 0.5, 0.8]
    many = _apart([0.5] * 40)
    assert (many[0], many[-1]) == pytest.approx((0.0, 1.0), abs=1e-9)


def test_long_names_do_not_reach_into_the_second_panel() -> None:
    figure = methods_figure(compared({"a method with a name, and an option=1 m": 1e-3}))
    left, right = figure.axes
    figure.canvas.draw()
    ends = [text.get_window_extent().x1 for text in left.texts]
    assert max(ends) < right.get_tightbbox().x0
