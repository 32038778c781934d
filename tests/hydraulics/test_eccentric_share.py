"""The pull on an eccentric pipe against the referee: bipolar coordinates, and finite elements."""

import numpy as np
import pytest

from fctd.hydraulics.eccentric_share import pull_square
from references.hydraulics import eccentric
from references.hydraulics.flow import Annulus, Mud


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.6, 0.999])
def test_the_referee_in_another_form(ratio: float) -> None:
    annulus, offsets = Annulus(0.1 * ratio, 0.1), np.array([0.0, 1e-3, 0.3, 0.8, 0.999, 1.0])
    expected = [eccentric.newtonian_square(annulus, float(e)) for e in offsets]
    assert pull_square(*annulus, offsets) == pytest.approx(expected, rel=1e-8)


def test_a_pipe_that_fills_its_hole() -> None:
    assert pull_square(0.1, 0.1, 0.5) == pytest.approx(0.01, rel=1e-15)


@pytest.mark.parametrize(("eccentricity", "index"), [(0.5, 0.5), (0.95, 0.4)])
def test_how_far_shear_thinning_takes_it(eccentricity: float, index: float) -> None:
    """A power law lies between the Newtonian value and 3 % less, by finite elements."""
    annulus = Annulus(0.06, 0.1)
    found = eccentric.solve(annulus, Mud(0.0, 0.3, index), eccentricity, 100.0).square
    assert 0.97 < found / pull_square(*annulus, eccentricity) < 1
