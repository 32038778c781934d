"""A mixture of normal distributions: drawn, and cut at bounds."""

import numpy as np
import pytest

from fctd.calibration.quadrature import Mixture


def test_a_mixture_is_sampled() -> None:
    mixture = Mixture(
        np.array([0.25, 0.75]), np.array([[1.0], [2.0]]), np.array([[0.0, 1.0], [3.0, -1.0]]),
        np.array([[[1.0, 0.5], [0.5, 2.0]], [[0.5, 0.0], [0.0, 0.1]]]),
    )  # fmt: skip
    none = np.full(2, np.inf)
    x, s = mixture.sample(200_000, np.random.default_rng(1), -none, none)
    assert x.mean(axis=0) == pytest.approx(mixture.centre, abs=0.01)
    assert np.cov(x.T) == pytest.approx(mixture.spread, abs=0.03)
    assert s.mean() == pytest.approx(1.75, abs=0.01)
    assert np.quantile(x[:, 0], 0.3) == pytest.approx(mixture.quantile(0, 0.3), abs=0.03)
    assert len(mixture.main(0.5).weight) == 1


def test_a_mixture_within_bounds() -> None:
    """A normal distribution cut at its mean, of which the correlated other knows: means √(2/π) and half of that."""
    mixture = Mixture(np.ones(1), np.zeros((1, 1)), np.zeros((1, 2)), np.array([[[1.0, 0.5], [0.5, 1.0]]]))
    low, high = np.array([0.0, -9.0]), np.array([9.0, 9.0])
    assert mixture.outside(low, high) == pytest.approx(0.5)
    x, _ = mixture.sample(100_000, np.random.default_rng(1), low, high)
    assert x.mean(axis=0) == pytest.approx(np.sqrt(2 / np.pi) * np.array([1.0, 0.5]), abs=0.01)
    far, _ = mixture.sample(10, np.random.default_rng(1), low + 20.0, high + 20.0)
    assert far[:, 0].tolist() == [20.0] * 10  # nothing lies within
