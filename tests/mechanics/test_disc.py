"""How far a disc moves in a section of hole, against closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.arrays import Array
from fctd.mechanics.disc import roll_disc

CELLS, POINTS = 36, 16
ANGLES = 2 * np.pi / (CELLS * POINTS) * np.arange(CELLS * POINTS)


def rolled(radii: Array, radius: float) -> tuple[Array, Array]:
    """Ways (CELLS,) and half angles (CELLS,) between the normals of two places."""
    ways, corners = np.empty((1, CELLS)), np.empty((1, CELLS, 2))
    roll_disc(radii[None, :], radius, CELLS, ways, corners)
    middle = corners[0, corners[0, :, 1] > 0, 0]
    assert np.abs(np.sin(middle)).max(initial=0.0) < 0.02  # grooves of these tests lie on the axis
    return ways[0], corners[0, :, 1]


def ellipse(a: float, b: float) -> Array:
    radii: Array = a * b / np.hypot(b * np.cos(ANGLES), a * np.sin(ANGLES))
    return radii


@given(st.floats(0.08, 0.3), st.floats(0.2, 0.95))
def test_in_a_circle_it_moves_by_the_clearance(hole: float, share: float) -> None:
    ways, halves = rolled(np.full(len(ANGLES), hole), share * hole)
    np.testing.assert_allclose(ways, (1 - share) * hole, rtol=1e-12)
    assert not halves.any()


@pytest.mark.parametrize("radius", [0.05, 0.07, 0.09, 0.097])
def test_in_an_ellipse_it_touches_one_place_or_two(radius: float) -> None:
    """Along the long half axis a: a − r where r ≤ b²/a, the smallest radius of curvature.

    A larger disc touches at two places: its centre comes to x = c √(1 − r²/b²) with c² = a² − b².
    """
    a, b = 0.12, 0.1
    ways, halves = rolled(ellipse(a, b), radius)
    assert ways[CELLS // 4] == pytest.approx(b - radius, abs=1e-12)
    assert not halves[CELLS // 4 - 4 : CELLS // 4 + 5].any()
    if radius <= b * b / a:
        assert ways[0] == pytest.approx(a - radius, abs=1e-6)
        assert halves[0] == 0
        return
    c = np.sqrt(a * a - b * b)
    x = c * np.sqrt(1 - (radius / b) ** 2)
    assert ways[0] == pytest.approx(x, abs=2e-5)
    cosine = a * x / (c * c)
    half = np.arctan2(b * np.sqrt(1 - cosine**2), a * cosine - x)
    assert halves[0] == pytest.approx(half, rel=0.005)


def test_a_groove_that_is_narrower_than_the_disc_grips_it() -> None:
    """A groove to the right, 60 mm wide in a hole of 108 mm: a disc of 84 mm touches both of its edges.

    The edges lie at the angle α beside the groove's middle; the centre comes to R cos α − √(r² − R² sin² α), and the
    normals lie at β with sin β = R sin α/r.
    """
    hole, radius = 0.108, 0.084
    alpha = np.arcsin(0.03 / hole)
    inside = np.abs(np.angle(np.exp(1j * ANGLES))) < alpha
    ways, halves = rolled(np.where(inside, 0.2, hole), radius)
    edge = np.abs(np.angle(np.exp(1j * ANGLES)))[~inside].min()
    sine = hole * np.sin(edge) / radius
    assert ways[0] == pytest.approx(hole * np.cos(edge) - radius * np.sqrt(1 - sine**2), abs=1e-12)
    assert halves[0] == pytest.approx(np.arcsin(sine), rel=1e-3)
    assert ways[CELLS // 2] == pytest.approx(hole - radius, abs=1e-12)
    assert halves[CELLS // 2] == 0


@given(st.integers(0, 2**31), st.floats(0.03, 0.09))
def test_no_point_of_the_wall_lies_in_the_disc(seed: int, radius: float) -> None:
    """In rough sections too: at the end of its way the disc touches the wall, and on the way it does not."""
    rng = np.random.default_rng(seed)
    radii = 0.108 + 0.01 * np.sin(ANGLES * rng.integers(1, 6) + rng.uniform(0, 6)) + rng.uniform(0, 0.005, len(ANGLES))
    ways, corners = np.empty((1, CELLS)), np.empty((1, CELLS, 2))
    roll_disc(radii[None, :], radius, CELLS, ways, corners)
    wall = radii[:, None] * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
    for k in range(CELLS):
        angle = ANGLES[k * POINTS]
        centre = np.array([np.cos(angle), np.sin(angle)])
        apart = np.linalg.norm(wall - ways[0, k] * centre, axis=1)
        assert apart.min() == pytest.approx(radius, abs=1e-12)
        assert np.linalg.norm(wall - 0.7 * ways[0, k] * centre, axis=1).min() >= radius
    assert ((corners[0, :, 1] >= 0) & (corners[0, :, 1] < np.pi / 2)).all()
