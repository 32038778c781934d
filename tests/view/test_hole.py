"""The drawn hole: rings and lines as wide as the exaggerated clearance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.model.wellbore import build_wellbore
from fctd.view import hole
from tests.view.made import case


@given(st.floats(1.0, 1e5), st.floats(1e-4, 1.0))
def test_the_exaggeration_is_round_and_shows_the_clearance(size: float, clearance: float) -> None:
    times = hole.exaggeration_of(size, clearance)
    assert f"{times:e}"[0] in "125"
    assert f"{times:e}"[1:].startswith(".000000")
    assert times == 1 or hole.SHARE / 2.6 <= times * clearance / size <= hole.SHARE * (1 + 1e-9)


def test_a_string_without_clearance_is_drawn_as_it_is() -> None:
    assert hole.exaggeration_of(1000.0, 0.0) == hole.exaggeration_of(1000.0, float("nan")) == 1.0


def test_rings_and_lines_lie_at_their_radius_across_the_hole() -> None:
    given_case = case()
    bore = build_wellbore(given_case)
    drawn = hole.drawn_hole(given_case, bore, 0.0)
    assert list(drawn.shoes.md) == [300.0]
    assert {300.0, 0.0, 900.0} <= set(drawn.lines.md)
    radius = np.linspace(5.0, 20.0, len(drawn.rings.md))
    corners = hole.rings(drawn.rings, radius).reshape(len(radius), len(hole.AROUND) + 1, 3)
    assert np.isnan(corners[:, -1]).all()
    arms = corners[:, :-1] - drawn.rings.centre[:, None]
    np.testing.assert_allclose(np.linalg.norm(arms, axis=2), radius[:, None] * np.ones(len(hole.AROUND)))
    _, tangent = bore.at(drawn.rings.md)
    np.testing.assert_allclose((arms * tangent[:, None]).sum(axis=2), 0.0, atol=1e-9)
    # A line keeps its side: from station to station it turns no further than the hole.
    lines = hole.wall_lines(drawn.lines, np.ones(len(drawn.lines.md))).reshape(len(hole.SIDES), -1, 3)[:, :-1]
    side = lines - drawn.lines.centre
    turned = np.arccos(np.clip((side[:, 1:] * side[:, :-1]).sum(axis=2), -1, 1))
    _, along = bore.at(drawn.lines.md)
    bent = np.arccos(np.clip((along[1:] * along[:-1]).sum(axis=1), -1, 1))
    assert (turned <= bent + 1e-6).all()


def test_the_clearance_beyond_the_string_is_that_of_its_ends() -> None:
    found = hole.clearance_at(np.array([0.0, 15.0, 90.0]), np.array([10.0, 20.0]), np.array([0.04, -0.02]))
    assert found == pytest.approx([0.04, 0.01, 0.0])
    assert list(hole.clearance_at(np.array([5.0]), np.empty(0), np.empty(0))) == [0.0]
