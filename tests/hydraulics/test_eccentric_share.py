"""The pull on a pipe against the referee: bipolar coordinates, quadrature, and finite elements."""

import numpy as np
import pytest

from fctd.hydraulics.eccentric_share import pull_square
from references.hydraulics import eccentric, quadrature
from references.hydraulics.flow import Annulus, Mud


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.6, 0.999])
def test_the_referee_in_another_form(ratio: float) -> None:
    annulus, offsets = Annulus(0.1 * ratio, 0.1), np.array([0.0, 1e-3, 0.3, 0.8, 0.999, 1.0])
    expected = [eccentric.newtonian_square(annulus, float(e)) for e in offsets]
    assert pull_square(*annulus, offsets) == pytest.approx(expected, rel=1e-8)


def test_a_pipe_that_fills_its_hole() -> None:
    assert pull_square(0.1, 0.1, 0.5) == pytest.approx(0.01, rel=1e-15)


@pytest.mark.parametrize(("ratio", "bound"), [(0.4, 0.012), (0.6, 2e-3), (0.8, 2e-4)])
@pytest.mark.parametrize("mud", [Mud(0.0, 0.5, 0.3), Mud(4.0, 0.02, 1.0), Mud(3.0, 0.2, 0.6)])
def test_radius_of_zero_shear_of_other_muds(ratio: float, bound: float, mud: Mud) -> None:
    annulus = Annulus(0.1 * ratio, 0.1)
    exact = quadrature.solve(annulus, mud, 3.0 * annulus.area)
    found = pull_square(*annulus, 0.0, mud.index, exact.yield_share)
    assert found == pytest.approx(exact.zero_shear**2, rel=bound)


@pytest.mark.parametrize(("eccentricity", "yielding"), [(0.5, 0.0), (0.95, 0.0), (0.95, 0.3)])
def test_other_muds_beside_the_axis(eccentricity: float, yielding: float) -> None:
    """By finite elements, at 2 Pa on the walls: what a Newtonian mud has is up to 4 % more."""
    annulus = Annulus(0.05, 0.1)
    mud = Mud(2.0 * yielding, 0.1, 0.4)
    found = eccentric.solve(annulus, mud, eccentricity, 80.0, across=24, around=48).square
    assert pull_square(*annulus, eccentricity, 0.4, yielding) == pytest.approx(found, rel=0.007)
