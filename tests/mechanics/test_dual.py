"""Root and reciprocal with a complex step: their values and derivatives."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.mechanics.dual import power, reciprocal, root
from tests.compiled import kept

STEP = 1e-30


@kept
def compiled_root(x):
    return root(x)


@kept
def compiled_reciprocal(x):
    return reciprocal(x)


@kept
def compiled_power(x, p):
    return power(x, p)


@kept
def witch(x):
    """1/√(1 + x²), by root and reciprocal."""
    return reciprocal(root(1 + x * x))


sizes = st.floats(1e-60, 1e60)


@given(x=sizes)
def test_for_a_float_they_are_the_plain_operations(x: float) -> None:
    assert compiled_root(x) == root(x) == math.sqrt(x)
    assert compiled_reciprocal(x) == reciprocal(x) == 1 / x


@given(x=sizes)
def test_the_derivative_of_the_root(x: float) -> None:
    found = compiled_root(complex(x, STEP))
    assert found.real == math.sqrt(x)
    assert found.imag / STEP == pytest.approx(0.5 / math.sqrt(x), rel=1e-14)


@given(x=sizes, sign=st.sampled_from([-1, 1]))
def test_the_derivative_of_the_reciprocal(x: float, sign: int) -> None:
    x *= sign
    found = compiled_reciprocal(complex(x, STEP))
    assert found.real == 1 / x
    assert found.imag / STEP == pytest.approx(-1 / x**2, rel=1e-14)


@given(x=st.floats(-1e3, 1e3))
def test_a_chain_of_both(x: float) -> None:
    assert witch(complex(x, STEP)).imag / STEP == pytest.approx(-x / (1 + x * x) ** 1.5, rel=1e-13, abs=1e-200)


@given(x=sizes)
def test_compiled_and_plain_agree(x: float) -> None:
    """Outside compiled code numpy's complex root and quotient are used."""
    z = complex(x, 1e-12 * x)
    for compiled, plain in ((compiled_root, root), (compiled_reciprocal, reciprocal)):
        assert compiled(z) == pytest.approx(complex(plain(z)), rel=1e-14)


def test_the_root_of_zero_has_slope_zero_and_is_not_nan() -> None:
    """A length of 0 that does not change: an infinite slope times its zero derivative would give NaN."""
    assert compiled_root(0j) == 0
    assert np.isfinite(compiled_root(0j).imag)


@given(x=st.floats(0, 1e3), p=st.floats(1, 5))
def test_a_power_has_the_derivative_of_calculus_also_at_zero(x: float, p: float) -> None:
    """p x^(p − 1); at 0 it is 0, or 1 for the first power."""
    assert compiled_power(x, p) == pytest.approx(x**p, rel=1e-12)
    found = compiled_power(complex(x, STEP), p)
    assert found.real == pytest.approx(x**p, rel=1e-12)
    assert found.imag / STEP == pytest.approx(p * x ** (p - 1), rel=1e-12)
