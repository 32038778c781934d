"""Frames of a pose: small tilts, products and vectors in a body's frame."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.mechanics.rotations import rotation_columns, turned
from fctd.steady.pose import in_frame, stepped, times

frames = st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 0.1)


def unit(q: list[float]) -> np.ndarray:
    return np.array(q) / np.linalg.norm(q)


def matrix(q: np.ndarray) -> np.ndarray:
    """Rows: the body's axes."""
    return np.array(rotation_columns(*q)).reshape(3, 3)


@given(q=frames, a=st.floats(-1, 1), b=st.floats(-1, 1))
def test_a_small_tilt_is_the_first_order_of_a_turn(q: list[float], a: float, b: float) -> None:
    h = 1e-6
    exact, found = turned(*unit(q), h * a, h * b, 0.0), stepped(*unit(q), h * a, h * b)
    np.testing.assert_allclose(found, exact, atol=1e-12)


@given(p=frames, q=frames)
def test_a_product_turns_by_one_frame_in_the_other(p: list[float], q: list[float]) -> None:
    both = times(*unit(p), *unit(q))
    np.testing.assert_allclose(matrix(np.array(both)), matrix(unit(q)) @ matrix(unit(p)), atol=1e-12)


@given(q=frames)
def test_in_its_own_frame_an_axis_of_a_body_is_a_unit_vector(q: list[float]) -> None:
    for k, axis in enumerate(matrix(unit(q))):
        assert in_frame(*unit(q), *axis) == pytest.approx(np.eye(3)[k], abs=1e-12)
