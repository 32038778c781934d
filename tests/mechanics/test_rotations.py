"""Quaternion helpers against scipy, and the two series against the functions they approximate."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fctd.mechanics import rotations

angles = st.floats(-math.pi, math.pi)
parts = st.floats(-1, 1)


def quaternion(rotation: Rotation) -> np.ndarray:
    return rotation.as_quat(scalar_first=True)


@given(st.tuples(parts, parts, parts), st.tuples(parts, parts, parts))
def test_turned_composes_rotations(first: tuple[float, ...], second: tuple[float, ...]) -> None:
    start = Rotation.from_rotvec(first)
    step = 0.1 * np.array(second)
    expected = start * Rotation.from_rotvec(step)
    found = rotations.turned(*quaternion(start), *step)
    assert abs(np.dot(found, quaternion(expected))) == pytest.approx(1.0, abs=1e-14)


@given(st.tuples(parts, parts, parts))
def test_columns_are_the_matrix(vector: tuple[float, ...]) -> None:
    rotation = Rotation.from_rotvec(vector)
    columns = np.array(rotations.rotation_columns(*quaternion(rotation))).reshape(3, 3).T
    np.testing.assert_allclose(columns, rotation.as_matrix(), atol=1e-14)


@pytest.mark.parametrize(("largest", "tolerance"), [(2.0, 1e-10), (3.1, 3e-7)])
@given(bend=st.floats(0, 1.0), towards=angles, share=parts)
def test_twist_is_found_whatever_the_bend(
    largest: float, tolerance: float, bend: float, towards: float, share: float
) -> None:
    twist = largest * share
    half = Rotation.from_rotvec([0, 0, twist / 2])
    swing = Rotation.from_rotvec([bend * math.cos(towards), bend * math.sin(towards), 0])
    upper = Rotation.from_rotvec([0.3, -0.4, 0.5])
    lower = quaternion(upper * half * swing * half)
    # The quaternion of a continuous motion from rest: no flip of sign.
    lower = lower * np.sign(np.dot(lower, quaternion(upper)) or 1.0)
    found = rotations.twist_angle(*quaternion(upper), *lower)
    assert found == pytest.approx(twist, rel=tolerance, abs=1e-12)


@pytest.mark.parametrize("angle", [1e-9, 1e-3, 0.1, 0.5])
def test_angle_over_sine(angle: float) -> None:
    assert rotations.angle_over_sine(math.cos(angle)) == pytest.approx(angle / math.sin(angle), rel=1e-10)


def test_quaternion_from_axis_turns_z_into_it() -> None:
    axes = np.array([[0, 0, 1], [1, 0, 0], [0, -1, 0], [0.6, 0, -0.8], [0, 0, -1]], dtype=float)
    turned = Rotation.from_quat(rotations.quaternion_from_axis(axes), scalar_first=True).apply([0, 0, 1])
    np.testing.assert_allclose(turned, axes, atol=1e-12)
