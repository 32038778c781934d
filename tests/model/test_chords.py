"""Cylinders of a hole: how far they are from its axis, and shorter ones."""

import math
from typing import Any

import pytest

from fctd.model.chords import largest_chord, shorter_cylinders
from tests.cases import make_case

BUILD = [[0, 0, 0], [400, 0, 0], [800, 60, 0]]
RADIUS = 400 / math.radians(60)


@pytest.mark.parametrize(
    ("hole", "chord"),
    [
        ({"chord_tolerance": 0.02}, 0.02),
        ({"cylinder_length": 12.0}, 12.0**2 / (8 * RADIUS)),  # κ ℓ²/8, exact to first order in ℓ/R
        ({"survey_method": "minimum_curvature", "geometry": "arcs"}, 0.0),
    ],
)
def test_the_largest_chord(hole: dict[str, Any], chord: float) -> None:
    assert largest_chord(make_case(BUILD, wellbore=hole)) == pytest.approx(chord, rel=1e-9)


@pytest.mark.parametrize("hole", [{"chord_tolerance": 0.02}, {"cylinder_length": 0.6}])
def test_half_the_length_has_a_quarter_of_the_chord_and_room_for_the_overlap(hole: dict[str, Any]) -> None:
    case = make_case(BUILD, wellbore=hole | {"overlap": 0.2})
    shorter = shorter_cylinders(case)
    assert largest_chord(shorter) == pytest.approx(largest_chord(case) / 4, rel=1e-9)
    length = math.sqrt(8 * RADIUS * largest_chord(shorter))
    assert shorter.wellbore.overlap == pytest.approx(min(0.2, 0.5 * length), rel=1e-6)
