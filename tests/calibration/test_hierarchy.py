"""The statistics of scatter between days, against integrals by brute force."""

import numpy as np
import pytest
from numpy.typing import NDArray

from fctd.calibration.hierarchy import Linear, condition
from fctd.calibration.quadrature import Mixture, integrate

Array = NDArray[np.float64]

X, U = np.linspace(-4.0, 5.0, 181), np.linspace(-7.0, 7.0, 71)  # of the unknown, and of effects in their deviations


def model(effects: int) -> Linear:
    """Six readings of one unknown on three days."""
    rng = np.random.default_rng(5)
    return Linear(
        value=np.array([1.0, 2.0, -1.5, 0.4, 1.2, 0.1]), jacobian=rng.uniform(0.5, 1.5, (6, 1)),
        effects=rng.normal(size=(6, effects)), variance=rng.uniform(0.2, 0.6, 6), day=np.array([0, 0, 1, 2, 2, 2]),
        prior_mean=np.array([0.3]), prior_precision=np.array([0.25]),
    )  # fmt: skip


def density(of: Linear, deviations: Array) -> Array:
    """Density of all readings and the unknown at each ``X``: a sum over a grid of the effects of each day."""
    from scipy.stats import norm

    found = norm.pdf(X, 0.3, 2.0)
    grids = np.meshgrid(*[U] * of.effects.shape[1], indexing="ij")
    prior = np.prod([norm.pdf(grid) * (U[1] - U[0]) for grid in grids], axis=0).ravel()
    for day in range(3):
        log = np.zeros((len(X), prior.size))
        for n in np.flatnonzero(of.day == day):
            by_day = sum(of.effects[n, i] * s * grids[i].ravel() for i, s in enumerate(deviations))
            off = of.value[n] - of.jacobian[n, 0] * X[:, None] - by_day
            log -= 0.5 * off**2 / of.variance[n] + 0.5 * np.log(2 * np.pi * of.variance[n])
        found = found * (np.exp(log) @ prior)
    return np.asarray(found)


def moments(of_x: Array) -> tuple[float, float, float]:
    """Integral of a density over ``X``, its mean and its variance."""
    total = of_x.sum()
    mean = float(of_x @ X / total)
    return float(total * (X[1] - X[0])), mean, float(of_x @ (X - mean) ** 2 / total)


def test_given_deviations_all_is_exact() -> None:
    of, s = model(2), np.array([[0.7, 0.4], [0.0, 0.0]])
    found = condition(of, s)
    for m in range(2):
        total, mean, variance = moments(density(of, s[m]))
        assert np.exp(found.log_evidence[m]) == pytest.approx(total, rel=1e-9)
        assert found.mean[m, 0] == pytest.approx(mean, abs=1e-9)
        assert found.covariance[m, 0, 0] == pytest.approx(variance, rel=1e-9)
    assert not found.effects[1].any()


def test_deviations_are_integrated() -> None:
    """Unknown, effects and deviation by sums over grids: evidence, moments and the distribution function to 1e-6."""
    of, scale = model(1), 0.25
    g, w = np.polynomial.legendre.leggauss(60)
    s = 0.5 * (g + 1) * 24.0  # in means of the exponential prior, whose tail beyond is 4e-11
    joint = np.array([density(of, np.array([scale * one])) for one in s]) * (12.0 * w * np.exp(-s))[:, None]
    total, mean, variance = moments(joint.sum(axis=0))
    nodes = integrate(lambda deviations: condition(of, deviations).log_evidence, np.array([scale]))
    at = condition(of, nodes.deviations)
    mixture = Mixture(nodes.weight, nodes.deviations, at.mean, at.covariance)
    assert np.exp(nodes.log_evidence) == pytest.approx(total, rel=1e-6)
    assert mixture.centre[0] == pytest.approx(mean, abs=1e-6)
    assert mixture.spread[0, 0] == pytest.approx(variance, rel=2e-6)
    expected = float(joint.sum(axis=1) @ (scale * s) / joint.sum())
    assert nodes.weight @ nodes.deviations[:, 0] == pytest.approx(expected, rel=1e-6)
    for share in (0.025, 0.5, 0.975):
        edge = mixture.quantile(0, share)
        below = np.interp(edge, X + 0.5 * (X[1] - X[0]), np.cumsum(joint.sum(axis=0))) / joint.sum()
        assert below == pytest.approx(share, abs=2e-4)


def test_two_deviations_on_a_finer_grid() -> None:
    of, scales = model(2), np.array([0.5, 0.3])
    g, w = np.polynomial.legendre.leggauss(120)
    s, w = 0.5 * (g + 1) * 20.0, 10.0 * w * np.exp(-0.5 * (g + 1) * 20.0)
    grid = np.stack(np.meshgrid(s, s, indexing="ij"), axis=-1).reshape(-1, 2)
    at = condition(of, grid * scales)
    weight = np.outer(w, w).ravel() * np.exp(at.log_evidence)
    nodes = integrate(lambda deviations: condition(of, deviations).log_evidence, scales)
    assert np.exp(nodes.log_evidence) == pytest.approx(weight.sum(), rel=1e-6)
    expected = weight @ (grid * scales) / weight.sum()
    assert nodes.weight @ nodes.deviations == pytest.approx(expected, rel=1e-6)
    median = nodes.quantile(0, 0.5)
    of_first = weight.reshape(120, 120).sum(axis=1) / weight.sum()
    assert of_first[s * scales[0] < median].sum() == pytest.approx(0.5, abs=0.02)


def test_a_prior_of_mean_0_is_no_deviation() -> None:
    of = model(2)
    nodes = integrate(lambda deviations: condition(of, deviations).log_evidence, np.array([0.5, 0.0]))
    assert not nodes.deviations[:, 1].any()
    assert nodes.quantile(1, 0.975) == 0.0
    none = integrate(lambda deviations: condition(of, deviations).log_evidence, np.zeros(2))
    assert none.weight.tolist() == [1.0]


def test_a_day_left_out_has_the_density_of_its_readings() -> None:
    """Normal about the prediction of the others."""
    from scipy.stats import norm

    of, none = model(1), np.zeros((1, 1))
    others = condition(of.without(1), none)
    J, v = of.jacobian[2, 0], of.variance[2]
    predicted = norm.logpdf(of.value[2], J * others.mean[0, 0], np.sqrt(J**2 * others.covariance[0, 0, 0] + v))
    assert condition(of, none).log_evidence[0] - others.log_evidence[0] == pytest.approx(predicted)
