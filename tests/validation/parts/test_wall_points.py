"""The hole of the studies of contact: the same at any depth, with points that lie where their region says."""

import numpy as np
import pytest

from fctd import build_wellbore, find_contacts
from validation.parts.wall_points import BAND, RADIUS, REGIONS, points_in, the_case


@pytest.mark.parametrize("deeper", [0.0, 3500.0])
def test_points_lie_in_their_region_near_the_wall(deeper: float) -> None:
    case = the_case(deeper)
    points = points_in(case, 60)
    hits = find_contacts(build_wellbore(case), np.ascontiguousarray(points[["x", "y", "z"]]), RADIUS)
    assert np.abs(hits.penetration).max() <= BAND + 1e-9
    for region, (top, end) in REGIONS.items():
        md = hits.md[points["region"] == region] - deeper
        assert top <= md.min() <= md.max() <= end


def test_a_deeper_hole_has_the_same_bends() -> None:
    shallow, deep = (
        find_contacts(build_wellbore(case), points_of(case), RADIUS) for case in (the_case(), the_case(800.0))
    )
    np.testing.assert_allclose(deep.penetration, shallow.penetration, atol=1e-9)
    np.testing.assert_allclose(deep.md - 800.0, shallow.md, atol=1e-9)


def points_of(case) -> np.ndarray:
    return np.ascontiguousarray(points_in(case, 20)[["x", "y", "z"]])
