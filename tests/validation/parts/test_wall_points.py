"""The hole of the studies of contact: the same at any depth, with points that lie where their region says."""

import numpy as np
import pytest

from fctd.arena.frames import BAND
from validation.parts.wall_points import OVERLAP, REGIONS, near_wall, the_case


def test_points_lie_in_their_region_near_the_wall() -> None:
    case = the_case()
    near, regions = near_wall(case, 60)
    assert np.abs(near.exact.penetration).max() <= BAND + 1e-9
    assert [(regions == region).sum() for region in (*REGIONS, OVERLAP)] == [60, 60, 60, 60]
    for region, (top, end) in REGIONS.items():
        md = near.exact.md[regions == region]
        assert top <= md.min() <= md.max() <= end
    assert the_case(3500.0).wellbore.trajectory[-1, 0] == pytest.approx(4400.0)
    # In the order of depth the first lie in the straight part, which flatters a tree.
    assert abs(np.corrcoef(np.arange(len(near.md)), near.md)[0, 1]) < 0.2
