"""The wall of sampled holes beside a point: its place, its slopes, and that its force has an energy."""

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics import sampled
from fctd.mechanics.jit import entry
from fctd.model.wellbore import Wellbore, find_contacts
from tests.calipers import BORE, FIRST, LAST, bent_hole, rough, sampled_hole
from tests.mechanics.test_stored_walls import pressed, slopes_of_energy

PIPE = 0.0635


@entry
def _wall(C, i, x, y, z, radius):  # type: ignore[no-untyped-def]
    return sampled.sampled_wall(C, i, x, y, z, radius)


def beside(hole: Wellbore, seed: int, count: int = 300) -> tuple[Array, Array]:
    """Measured depths (n,) and points (n, 3) near the wall of a hole."""
    rng = np.random.default_rng(seed)
    md = rng.uniform(FIRST + 5, LAST - 5, count)
    return md, hole.off_axis(md, rng.uniform(0, 2 * np.pi, count), rng.uniform(0.03, 0.06, count))


@pytest.mark.slow
@pytest.mark.parametrize("arms", [1, 2, 8])
def test_of_a_round_caliper_it_is_that_of_arcs(arms: int) -> None:
    """In bends and at the shoe, above and below the caliper, beyond both ends of the hole."""
    arcs, hole = bent_hole("arcs"), sampled_hole(lambda md: np.full((len(md), arms), 0.5 * BORE))
    rng = np.random.default_rng(1)
    points = arcs.off_axis(rng.uniform(-9, 1009, 2000), rng.uniform(0, 7, 2000), rng.uniform(0.001, 0.1, 2000))
    expected, found = find_contacts(arcs, points, PIPE), find_contacts(hole, points, PIPE)
    for name in ("penetration", "normal", "md"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), atol=1e-9)
    assert not hole.pieces[:, sampled.AROUND_CELLS].any()


@pytest.mark.slow
def test_the_force_of_a_rough_wall_is_the_gradient_of_its_energy() -> None:
    """Also along the hole: −K d n of the stored wall against differences of ½ K d²."""
    hole = sampled_hole(rough(2))
    md, points = beside(hole, 3)
    force, energy = pressed(hole, points, PIPE)
    slopes = slopes_of_energy(hole, points, PIPE)
    assert (energy > 0).mean() > 0.3
    np.testing.assert_allclose(force, -slopes, atol=1e-6 * np.abs(force).max())
    along = np.abs(np.sum(force * hole.at(md)[1], axis=1)) / np.maximum(np.linalg.norm(force, axis=1), 1.0)
    assert along.max() > 0.01


@pytest.mark.slow
def test_slope_and_deviation_are_continuous_between_cells() -> None:
    hole = sampled_hole(rough(5))
    ends = hole.md[(hole.md > FIRST + 1) & (hole.md < LAST - 1)][::40]
    angle = np.linspace(0, 6, len(ends))
    for side in (-1, 1):
        points = hole.off_axis(ends + side * 1e-7, angle, np.full(len(ends), 0.04))
        owners = hole.owners(points)
        found = np.array([_wall(hole.pieces, i, *point, PIPE) for i, point in zip(owners, points, strict=True)])
        if side < 0:
            before, owned = found, owners
    assert (owners != owned).mean() > 0.9
    np.testing.assert_allclose(found, before, atol=2e-6)


@pytest.mark.slow
def test_the_wall_that_was_measured_is_found_at_second_order() -> None:
    """A smooth wall that winds along the hole: cells of four lengths, from the high side in bends."""

    def wall(md: Array) -> Array:
        around = 2 * np.pi * np.arange(16) / 16
        return np.asarray(0.5 * BORE + 0.01 * np.cos(around - 2 * md[:, None]))

    errors = []
    for cell in (0.8, 0.4, 0.2, 0.1):
        hole = sampled_hole(wall, spacing=0.02, cell=cell)
        rng = np.random.default_rng(6)
        md, angle = rng.uniform(FIRST + 5, LAST - 5, 400), rng.uniform(0, 2 * np.pi, 400)
        found = hole.walls(hole.off_axis(md, angle, np.full(400, 0.05)))
        errors.append(np.abs(found.radius - 0.5 * BORE - 0.01 * np.cos(angle - 2 * md)).max())
    assert errors[0] > 3.2 * errors[1]
    assert errors[1] > 2.8 * errors[2]
    assert errors[-1] < 4e-4  # most of it by the 16 arms
