"""The deviations between days integrated on a grid: their posterior, and a mixture of normal distributions.

As INLA does (Rue, Martino & Chopin 2009), the few standard deviations that are not normal are integrated by nodes, and
each node holds a normal distribution of all else.  The prior of a deviation is exponential, the penalised complexity
prior of Simpson et al. (2017): largest at none.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.special import ndtr

Array = NDArray[np.float64]

# A deviation is at most this many times the mean of its prior; its scale is linear below the mean, logarithmic beyond.
MOST: Final = 40.0
# Points of the first look by deviation, and nodes of Gauss and Legendre between the points that matter.
_LOOK, NODES = 16, 20
_NEGLIGIBLE: Final = 20.0  # below the largest log density
_ROUNDS: Final = 100  # of draws that may be thrown away


@dataclass(frozen=True)
class Mixture:
    """Normal distributions of k unknowns at m nodes of e deviations: weight (m,), deviations (m, e), mean (m, k),
    covariance (m, k, k)."""

    weight: Array
    deviations: Array
    mean: Array
    covariance: Array

    @property
    def centre(self) -> Array:
        """Mean of the unknowns (k,)."""
        return self.weight @ self.mean

    @property
    def spread(self) -> Array:
        """Covariance of the unknowns (k, k)."""
        off = self.mean - self.centre
        return np.asarray(np.einsum("m,mkl->kl", self.weight, self.covariance) + (self.weight * off.T) @ off)

    def quantile(self, k: int, share: float) -> float:
        """The value below which an unknown lies with this probability, by bisection."""
        sd = np.sqrt(self.covariance[:, k, k])
        low, high = float((self.mean[:, k] - 9 * sd).min()), float((self.mean[:, k] + 9 * sd).max())
        for _ in range(60):
            middle = 0.5 * (low + high)
            below = float(self.weight @ ndtr((middle - self.mean[:, k]) / sd))
            low, high = (middle, high) if below < share else (low, middle)
        return 0.5 * (low + high)

    def outside(self, low: Array, high: Array) -> float:
        """Probability that the unknown which is most often beyond its bounds (k,) is."""
        sd = np.sqrt(np.diagonal(self.covariance, axis1=1, axis2=2))
        within = ndtr((high - self.mean) / sd) - ndtr((low - self.mean) / sd)
        return float((1 - self.weight @ within).max())

    def sample(self, count: int, rng: np.random.Generator, low: Array, high: Array) -> tuple[Array, Array]:
        """Unknowns (count, k) within bounds (k,), and deviations (count, e), drawn from it.

        Draws beyond the bounds are thrown away; where nearly all are, the rest is put on the bounds.
        """
        values, vectors = np.linalg.eigh(self.covariance)
        half = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
        kept_x, kept_s, found = [], [], 0
        for _ in range(_ROUNDS):
            node = rng.choice(len(self.weight), count, p=self.weight)
            x = self.mean[node] + np.einsum("ckl,cl->ck", half[node], rng.normal(size=(count, self.mean.shape[1])))
            within = ((low <= x) & (x <= high)).all(axis=1)
            kept_x.append(x[within])
            kept_s.append(self.deviations[node[within]])
            found += int(within.sum())
            if found >= count:
                break
        else:
            kept_x.append(np.clip(x[~within], low, high))
            kept_s.append(self.deviations[node[~within]])
        return np.concatenate(kept_x)[:count], np.concatenate(kept_s)[:count]

    def main(self, least: float = 1e-4) -> "Mixture":
        """The nodes whose weight is at least this share of the largest."""
        kept = self.weight >= least * self.weight.max()
        weight = self.weight[kept] / self.weight[kept].sum()
        return Mixture(weight, self.deviations[kept], self.mean[kept], self.covariance[kept])


@dataclass(frozen=True)
class Nodes:
    """Posterior of e deviations: nodes (m, e), their weights (m,), and the log of the evidence of all.

    below : of each deviation values that rise, and the probability that it lies below them.
    """

    deviations: Array
    weight: Array
    log_evidence: float
    below: tuple[tuple[Array, Array], ...]

    def quantile(self, i: int, share: float) -> float:
        """The value below which a deviation lies with this probability."""
        value, probability = self.below[i]
        return float(np.interp(share, probability, value))


def integrate(log_evidence: Callable[[Array], Array], scales: Array) -> Nodes:
    """The posterior of deviations with exponential priors of these means (e,); one of mean 0 has no deviation.

    log_evidence : of sets (m, e) of deviations, (m,).
    """
    free = np.flatnonzero(scales > 0)

    def deviations(t: Array) -> Array:
        found = np.zeros((len(t), len(scales)))
        found[:, free] = scales[free] * np.sinh(t)
        return found

    def log_density(t: Array) -> Array:
        s = deviations(t)
        prior = -s[:, free] / scales[free] + np.log(np.cosh(t))
        return np.asarray(log_evidence(s) + prior.sum(axis=1))

    if not len(free):
        return Nodes(np.zeros((1, len(scales))), np.ones(1), float(log_evidence(np.zeros((1, len(scales))))[0]), ())
    look = np.linspace(0.0, np.arcsinh(MOST), _LOOK)
    shape = (_LOOK,) * len(free)
    seen = log_density(_tensor([look] * len(free))).reshape(shape)
    x, w = legendre.leggauss(NODES)
    axes, weights = [], []
    for i in range(len(free)):
        along = seen.max(axis=tuple(j for j in range(len(free)) if j != i))
        kept = np.flatnonzero(along > along.max() - _NEGLIGIBLE)
        low, high = look[max(kept[0] - 1, 0)], look[min(kept[-1] + 1, _LOOK - 1)]
        axes.append(0.5 * (low + high) + 0.5 * (high - low) * x)
        weights.append(0.5 * (high - low) * w)
    t = _tensor(axes)
    density = log_density(t)
    top = float(density.max())
    weight = np.exp(density - top) * _tensor(weights).prod(axis=1)
    total = float(weight.sum())
    weight /= total
    below: list[tuple[Array, Array]] = [(np.zeros(2), np.array([0.0, 1.0])) for _ in scales]
    for i, of in enumerate(free):
        marginal = weight.reshape((NODES,) * len(free)).sum(axis=tuple(j for j in range(len(free)) if j != i))
        span = axes[i][-1] - axes[i][0]
        half = span / (x[-1] - x[0])
        fine = np.linspace(-1.0, 1.0, 2001)
        at = axes[i].mean() + half * fine
        below[of] = scales[of] * np.sinh(np.maximum(at, 0.0)), _shares(x, w, marginal, fine)
    return Nodes(deviations(t), weight, top + np.log(total), tuple(below))


def _tensor(axes: list[Array]) -> Array:
    """Every combination of one value of each axis (m, e)."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def _shares(x: Array, w: Array, marginal: Array, at: Array) -> Array:
    """Probability below points within −1 and 1: the integral of the polynomial through the density at the nodes."""
    degree = np.arange(len(x))
    coefficients = (degree + 0.5) * (legendre.legvander(x, len(x) - 1) * marginal[:, None]).sum(axis=0)
    found = legendre.legval(at, legendre.legint(coefficients, lbnd=-1))
    return np.maximum.accumulate(np.clip(found, 0.0, 1.0))
