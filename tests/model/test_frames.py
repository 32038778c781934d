"""Frames across the hole: no turn, and no jump where the hole begins to build."""

import numpy as np
import pytest

from fctd.model.frames import carried_frame, hole_frame, steady_offsets


def direction(inclination: np.ndarray, azimuth: np.ndarray) -> np.ndarray:
    inc, azi = np.radians(inclination), np.radians(azimuth)
    return np.column_stack((np.sin(inc) * np.cos(azi), np.sin(inc) * np.sin(azi), np.cos(inc)))


MD = np.linspace(0, 1000, 501)


def test_directions_are_carried_along_the_hole_without_a_turn() -> None:
    """Across the hole, of unit length, and steady through vertical, where the high side jumps."""
    angle = np.linspace(-0.5, 1.2, 200)
    direction = np.column_stack([np.sin(angle), np.zeros(200), np.cos(angle)])
    first, second = carried_frame(direction)
    assert np.abs((first * direction).sum(axis=1)).max() < 1e-12
    assert np.linalg.norm(first, axis=1) == pytest.approx(1)
    assert second == pytest.approx(np.cross(first, direction))
    assert np.abs(np.diff(first, axis=0)).max() < 0.02
    # In a planar hole the low side at the bit stays in the plane.
    assert np.abs(first[:, 1]).max() < 1e-12


def offsets(hole: np.ndarray, vector: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What ``hole_frame`` says of an offset, given across a hole (n, 3)."""
    high, right = hole_frame(hole)
    return (vector * high).sum(axis=1), (vector * right).sum(axis=1)


@pytest.mark.parametrize("azimuth", [0.0, 90.0, 217.0])
def test_offsets_do_not_jump_where_the_hole_begins_to_build(azimuth: float) -> None:
    """Vertical to 400 m, then a build: a string on the low side of the build, and there in the vertical part too."""
    hole = direction(np.clip((MD - 400) / 10, 0, None), np.full(501, azimuth))
    low, _ = carried_frame(hole)
    found = steady_offsets(MD, hole, *offsets(hole, 0.05 * low))
    np.testing.assert_allclose(found, np.tile([-0.05, 0.0], (501, 1)), atol=1e-9)


def test_offsets_between_two_inclined_parts_turn_evenly() -> None:
    """An S-shaped well that comes back through vertical to the other side: the high side turns by 180° in between."""
    inclination = np.interp(MD, [0, 300, 700, 1000], [30, 0, 0, 30])
    hole = direction(inclination, np.where(MD < 500, 0.0, 180.0))
    low, right = carried_frame(hole)
    found = steady_offsets(MD, hole, *offsets(hole, 0.03 * low + 0.04 * right))
    assert np.abs(np.diff(found, axis=0)).max() < 0.05 * np.pi / 180
    np.testing.assert_allclose(np.hypot(*found.T), 0.05)
    steep = inclination > 5.01
    np.testing.assert_allclose(found[steep], np.column_stack(offsets(hole, 0.03 * low + 0.04 * right))[steep])


def test_an_inclined_hole_keeps_its_high_side() -> None:
    hole = direction(np.full(501, 40.0), np.linspace(0, 300, 501))
    high, right = np.sin(MD), np.cos(MD)
    np.testing.assert_array_equal(steady_offsets(MD, hole, high, right), np.column_stack((high, right)))


def test_a_vertical_hole_has_offsets_without_a_jump() -> None:
    hole = direction(np.full(501, 0.05), np.linspace(0, 300, 501))
    found = steady_offsets(MD, hole, *offsets(hole, np.tile([0.05, 0.0, 0.0], (501, 1))))
    assert np.abs(np.diff(found, axis=0)).max() < 1e-4
