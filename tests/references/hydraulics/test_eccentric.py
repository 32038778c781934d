"""Eccentric annuli: finite elements against Piercy's series, the exact pull on the pipe, and the concentric referee."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from references.hydraulics import quadrature
from references.hydraulics.eccentric import newtonian_flow, newtonian_square, solve
from references.hydraulics.flow import Annulus, Mud

NEWTONIAN = Mud(0.0, 0.03, 1.0)


@pytest.mark.parametrize("ratio", [0.3, 0.6, 0.9])
@pytest.mark.parametrize("eccentricity", [0.1, 0.6, 0.95])
def test_newtonian_is_exact(ratio: float, eccentricity: float) -> None:
    annulus = Annulus(0.1 * ratio, 0.1)
    coarse, fine = (
        solve(annulus, NEWTONIAN, eccentricity, 50.0, across=across, around=2 * across) for across in (12, 24)
    )
    exact = newtonian_flow(annulus, 0.03, eccentricity, 50.0)
    assert np.log2((coarse.flow - exact) / (fine.flow - exact)) == pytest.approx(2, abs=0.1)
    assert fine.square == pytest.approx(newtonian_square(annulus, eccentricity), rel=1e-5)


@pytest.mark.parametrize("mud", [Mud(0.0, 0.5, 0.4), Mud(0.4, 0.05, 1.0)])
def test_nearly_concentric(mud: Mud) -> None:
    annulus = Annulus(0.06, 0.1)
    found = solve(annulus, mud, 0.01, 50.0)
    exact = quadrature.solve(annulus, mud, found.flow)
    assert found.gradient == pytest.approx(exact.gradient, rel=2e-3)
    assert found.square == pytest.approx(exact.zero_shear**2, rel=2e-4)


def test_pull_from_concentric_to_touching() -> None:
    annulus = Annulus(0.06, 0.1)
    squares = [newtonian_square(annulus, e) for e in (0, 1e-4, 0.5, 1 - 1e-9, 1)]
    assert squares == sorted(squares, reverse=True)
    assert squares[0] == pytest.approx(squares[1], rel=1e-8)
    assert squares[0] == pytest.approx(quadrature.solve(annulus, NEWTONIAN, 0.01).zero_shear ** 2, rel=1e-9)
    assert squares[-1] == pytest.approx(squares[-2], rel=1e-8)


def test_concentric_is_refused() -> None:
    with pytest.raises(InputError, match="above 0 and below 1"):
        solve(Annulus(0.06, 0.1), NEWTONIAN, 0.0, 50.0)
