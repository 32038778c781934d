"""Points near a wall: where they lie, and that they are drawn the same again."""

import numpy as np

from fctd.arena.contract import SIZES, STATIONS
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import BAND, RADIUS, case_of, frame


def test_points_lie_within_the_band_of_touching() -> None:
    hole = ExactHole(case_of("frames", STATIONS, SIZES).wellbore)
    near = frame(hole, 400, md=(60.0, 180.0))
    assert np.abs(near.exact.penetration).max() <= BAND + 1e-9
    assert 0.4 < (near.exact.penetration > 0).mean() < 0.6
    np.testing.assert_allclose(near.exact.md, near.md, atol=1e-6)
    assert set(near.radii) == {RADIUS}
    assert (np.diff(near.md) < 0).any()
    again = frame(hole, 400, md=(60.0, 180.0))
    np.testing.assert_array_equal(again.places, near.places)
    part = near.part(near.md < 100)
    np.testing.assert_array_equal(part.exact.penetration, near.exact.penetration[near.md < 100])
