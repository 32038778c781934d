"""The fit with scatter between days: friction and weight of a day differ from those of the well.

Friction factors of a day are those of the well times exp(a), and its hook loads read b more at the hook; a and b are
normal about 0, and their standard deviations are unknown.  Readings are smooth in the logarithm of friction: they are
taken as linear about the most likely values (Gauss and Newton), and the rest is exact (``hierarchy``, ``quadrature``).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from fctd.calibration.hierarchy import Linear, condition
from fctd.calibration.quadrature import Mixture, Nodes, integrate
from fctd.calibration.unknowns import Prior, Unknown, is_factor

Array = NDArray[np.float64]

EFFECTS: Final = ("friction", "hookload")
# Prior of a friction factor that has none of its own: log-normal about 0.25, in 95 of 100 wells 0.1 to 0.6 (the range
# of handbooks).  Without one, friction that no row shows would end at any factor near 0.
FACTOR: Final = (np.log(0.25), 0.45)
# The values are found where a step is below this share of their standard deviation.
_CLOSE: Final = 0.02
_STEPS: Final = 12
_LARGEST: Final = 0.7  # step of the logarithm of a friction factor
_LEAST: Final = 1e-3  # friction factor, whose logarithm is taken
# Probability beyond bounds that matters, and draws of what lies within them.
_BEYOND: Final = 2e-3
_DRAWS: Final = 4000


class At(NamedTuple):
    """Readings (n,) [SI] at some values, slopes (n, k) by the unknowns, and gains (n,) of a weight at the hook."""

    value: Array
    slopes: Array
    gains: Array


class DayReadings(Protocol):
    """Measured readings by day: unknowns, measured (n,) [SI], variance (n,) of their noise and rounding, day (n,)."""

    @property
    def unknowns(self) -> Sequence[Unknown]: ...
    @property
    def measured(self) -> Array: ...
    @property
    def variance(self) -> Array: ...
    @property
    def day(self) -> NDArray[np.int64]: ...

    def at(self, values: Array) -> At:
        """The readings where the unknowns have these values on each day (days, k); NaN without loads."""
        ...


@dataclass(frozen=True)
class DayFit:
    """The fit: best values (k,) [SI], effects (days, 2) of ``EFFECTS`` at them, and the readings there.

    mixture : of the unknowns as ``coordinate`` has them; nodes : of the deviations; model : the linear one.  Where a
    part of the mixture lies beyond bounds, the rest of it is what is known.
    """

    unknowns: tuple[Unknown, ...]
    best: Array
    effects: Array
    at: At
    model: Linear
    nodes: Nodes
    mixture: Mixture
    scales: Array

    @property
    def fitted(self) -> Array:
        """The readings with the effects of their days (n,) [SI]."""
        return np.asarray(self.at.value + self.at.gains * self.effects[self.model.day, 1])

    @cached_property
    def within(self) -> Array | None:
        """Draws (n, k) [SI] of the mixture within the bounds, None where next to nothing lies beyond."""
        low, high = bounds_of(self.unknowns)
        if self.mixture.outside(low, high) < _BEYOND:
            return None
        return values_of(self.unknowns, self.mixture.sample(_DRAWS, np.random.default_rng(0), low, high)[0])

    def interval(self, k: int, share: float = 0.95) -> tuple[float, float]:
        """The interval of an unknown [SI]."""
        ends = [0.5 * (1 + side * share) for side in (-1, 1)]
        if self.within is not None:
            low, high = np.quantile(self.within[:, k], ends)
        else:
            low, high = (float(_value(self.unknowns[k], self.mixture.quantile(k, end))) for end in ends)
        return float(low), float(high)

    @property
    def covariance(self) -> Array:
        """Of the unknowns (k, k) [SI]."""
        if self.within is not None:
            return np.atleast_2d(np.cov(self.within.T))
        scale = slopes_of(self.unknowns, self.best)
        return np.asarray(self.mixture.spread * np.outer(scale, scale))

    def without(self, day: int) -> tuple[Mixture, float]:
        """Mixture without the readings of a day, and the log of the density that it had given to them all together.

        The readings stay linear about the values of all days, so that nothing is solved again.
        """
        model = self.model.without(day)
        nodes, mixture = _integrated(model, self.scales)
        return mixture, self.nodes.log_evidence - nodes.log_evidence


def coordinate(unknown: Unknown, value: Array | float) -> Array | float:
    """An unknown in the coordinate of the mixture: a friction factor by its logarithm, others in typical sizes."""
    return np.log(np.maximum(value, _LEAST)) if is_factor(unknown.name) else np.asarray(value) / unknown.size


def _value(unknown: Unknown, z: Array | float) -> Array | float:
    return np.exp(z) if is_factor(unknown.name) else np.asarray(z) * unknown.size


def bounds_of(unknowns: Sequence[Unknown]) -> Array:
    """The lowest and the highest coordinates (2, k)."""
    return np.array([[coordinate(u, u.low), coordinate(u, u.high)] for u in unknowns]).T


def values_of(unknowns: Sequence[Unknown], z: Array) -> Array:
    """Values (..., k) [SI] of coordinates (..., k)."""
    return np.stack([np.asarray(_value(u, z[..., k])) for k, u in enumerate(unknowns)], axis=-1)


def slopes_of(unknowns: Sequence[Unknown], values: Array) -> Array:
    """Change of the values (k,) [SI] with their coordinates."""
    return np.array([v if is_factor(u.name) else u.size for u, v in zip(unknowns, values, strict=True)])


def with_friction(unknowns: Sequence[Unknown], values: Array, effect: Array) -> Array:
    """Values (..., k) [SI] with the friction factors of a day; effect (...) : of friction, a logarithm."""
    factors = np.array([is_factor(u.name) for u in unknowns])
    return np.where(factors, values * np.exp(effect)[..., None], values)


def _prior(unknown: Unknown) -> tuple[float, float]:
    """Mean and precision of the coordinate; a prior of friction is log-normal with its mean and standard deviation."""
    prior: Prior | None = unknown.prior
    if is_factor(unknown.name):
        if prior is None:
            return float(FACTOR[0]), float(FACTOR[1] ** -2)
        mean = max(prior.mean, _LEAST)
        variance = np.log1p((prior.sd / mean) ** 2)
        return float(np.log(mean) - 0.5 * variance), float(1 / variance)
    return (0.0, 0.0) if prior is None else (prior.mean / unknown.size, (unknown.size / prior.sd) ** 2)


def _integrated(model: Linear, scales: Array) -> tuple[Nodes, Mixture]:
    nodes = integrate(lambda deviations: condition(model, deviations).log_evidence, scales)
    found = condition(model, nodes.deviations)
    return nodes, Mixture(nodes.weight, nodes.deviations, found.mean, found.covariance)


def fit_days(readings: DayReadings, first: Array, scales: Array) -> DayFit:
    """The fit from first values (k,) [SI]; scales (2,) : means of the exponential priors of the deviations.

    Raises numpy.linalg.LinAlgError where the readings and the priors do not determine the unknowns.
    """
    unknowns, day = tuple(readings.unknowns), readings.day
    bounds = bounds_of(unknowns)
    means, precisions = np.array([_prior(u) for u in unknowns]).T
    factors = np.array([is_factor(u.name) for u in unknowns])
    z = np.clip(np.array([coordinate(u, value) for u, value in zip(unknowns, first, strict=True)]), *bounds)
    effects = np.zeros((int(day.max()) + 1, len(EFFECTS)))

    def readings_at(z: Array, effects: Array) -> tuple[At, Array]:
        values = with_friction(unknowns, np.broadcast_to(values_of(unknowns, z), (len(effects), len(z))), effects[:, 0])
        return readings.at(values), values

    at, values = readings_at(z, effects)
    for _ in range(_STEPS):
        jacobian = at.slopes * np.stack([slopes_of(unknowns, of_day) for of_day in values])[day]
        by_effect = np.stack([jacobian[:, factors].sum(axis=1), at.gains], axis=1)
        # The working response: what is measured, as seen from the values about which the readings are linear.
        off = readings.measured - at.value - at.gains * effects[day, 1]
        response = off + jacobian @ z + (by_effect * effects[day]).sum(axis=1)
        model = Linear(response, jacobian, by_effect, readings.variance, day, means, precisions)
        nodes, mixture = _integrated(model, scales)
        aim = mixture.centre
        if mixture.outside(*bounds) >= _BEYOND:
            aim = mixture.sample(_DRAWS, np.random.default_rng(0), *bounds)[0].mean(axis=0)
        of_days = condition(model, nodes.deviations, aim).effects
        step = [np.clip(aim, *bounds) - z, np.einsum("m,mdi->di", nodes.weight, of_days) - effects]
        sd = np.sqrt(np.diag(mixture.spread))
        most = max(np.abs(step[0][factors]).max(initial=0.0), np.abs(step[1][:, 0]).max())
        moved = np.abs(by_effect * step[1][day]) / np.sqrt(readings.variance)[:, None]  # of the readings, in noise
        if (np.abs(step[0]) < _CLOSE * sd).all() and moved.max() < 2 * _CLOSE:
            break
        share = min(1.0, _LARGEST / max(most, 1e-300))
        for _ in range(6):
            trial, trial_effects = z + share * step[0], effects + share * step[1]
            beyond, trial_values = readings_at(trial, trial_effects)
            if np.isfinite(beyond.value).all():
                break
            share *= 0.5
        else:  # strings lock up next to here: the readings stay linear about the values before
            break
        z, effects, at, values = trial, trial_effects, beyond, trial_values
    return DayFit(unknowns, values_of(unknowns, z), effects, at, model, nodes, mixture, scales)


def draw(
    unknowns: Sequence[Unknown], mixture: Mixture, best: Array, at: At, day: NDArray[np.int64],
    rng: np.random.Generator, samples: int,
) -> Array:  # fmt: skip
    """Readings (n, samples) [SI] of days that were not seen, without noise.

    at : the readings at ``best`` (k,), taken as linear in the friction factors themselves; day (n,) : which rows share
    the effects of a day.
    """
    z, deviations = mixture.sample(samples, rng, *bounds_of(unknowns))
    values = values_of(unknowns, z)
    effects = rng.normal(size=(int(day.max(initial=-1)) + 1, samples, len(EFFECTS))) * deviations
    found = np.empty((len(day), samples))
    for i, d in enumerate(day):
        of_day = with_friction(unknowns, values, effects[d, :, 0])
        found[i] = at.value[i] + (of_day - best) @ at.slopes[i] + at.gains[i] * effects[d, :, 1]
    return found
