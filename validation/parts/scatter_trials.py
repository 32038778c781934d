"""Synthetic trials of the fit with scatter between days, on a string whose readings are formulas.

What is tested is the statistics, not the mechanics: drags and torques are those of a capstan that has the contact loads
of a 60° tangent, a pull depends on friction exponentially, and the factor of sliding differs from that of turning.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.calibration.scatter import At, DayFit, draw, fit_days, with_friction
from fctd.calibration.setup import ScatterPrior
from fctd.calibration.unknowns import Prior, Unknown

Array = NDArray[np.float64]

HOOKLOAD, TORQUE = 10e3, 500.0  # noise, one standard deviation [N], [N m]
ROUNDING: Final = 22e3, 1.36e3  # resolution of the readings: 5 klbf, 1,000 ft lbf
DAYS, ROWS = (4, 12), (1, 3)
UNKNOWNS: Final = (
    Unknown("friction.cased", 0.0, 0.8, 0.2, 0.1, Prior(0.2, 0.06), ""),
    Unknown("friction.open.axial", 0.0, 0.8, 0.3, 0.1, Prior(0.3, 0.1), ""),
    Unknown("friction.open.rotational", 0.0, 0.8, 0.2, 0.1, Prior(0.2, 0.08), ""),
    Unknown("rig.block_weight", 0.0, 2e6, 250e3, 20e3, Prior(250e3, 40e3), "N"),
    Unknown("rig.torque_offset", -20e3, 20e3, 800.0, 500.0, Prior(800.0, 500.0), "N*m"),
)  # fmt: skip
SCALES: Final = np.array([ScatterPrior().friction, ScatterPrior().hookload])
EXPONENT: Final = 0.6  # wrap of the hole [rad]
RADIUS: Final = 0.08  # of the string [m]


@dataclass(frozen=True)
class Toy:
    """n readings [SI] by day.

    weight (n,) of the string, contact (n, 2) loads in casing and open hole, motion (n,) 1 down, −1 up, 0 turning, and
    torque (n,) for a torque in place of a hook load.
    """

    weight: Array
    contact: Array
    motion: Array
    torque: NDArray[np.bool_]
    measured: Array
    variance: Array
    day: NDArray[np.int64]
    unknowns: Sequence[Unknown] = UNKNOWNS

    def at(self, values: Array) -> At:
        """See ``DayReadings``."""
        cased, axial, rotational, block, offset = values[self.day].T
        grip = np.stack([cased, np.where(self.torque, rotational, axial)], axis=1)
        motion = self.motion[:, None]
        powers = np.exp(-EXPONENT * motion * grip)
        sliding = np.where(motion == 0.0, 0.0, (powers - 1) / EXPONENT)
        hook = self.weight + block + (self.contact * sliding).sum(axis=1)
        climb = np.sqrt(1 + grip**2)
        drive = offset + RADIUS * (self.contact * grip / climb).sum(axis=1)
        by_hook, by_drive = -motion * self.contact * powers, RADIUS * self.contact / climb**3
        by = np.where(self.torque[:, None], by_drive, by_hook)
        none = np.zeros(len(self.day))
        slopes = np.stack(
            [
                by[:, 0],
                np.where(self.torque, none, by[:, 1]),
                np.where(self.torque, by[:, 1], none),
                np.where(self.torque, 0.0, 1.0),
                np.where(self.torque, 1.0, 0.0),
            ],
            axis=1,
        )
        return At(np.where(self.torque, drive, hook), slopes, np.where(self.torque, 0.0, 1.0))


def blank(rng: np.random.Generator, days: int) -> Toy:
    """Rows of some days, up, down or turning with hook load, and torque where they turn; not measured."""
    rows: list[tuple[float, ...]] = []
    for day in range(days):
        depth = rng.uniform(0.0, 1.0)
        for motion in rng.choice([-1, 0, 1], rng.integers(ROWS[0], ROWS[1] + 1), replace=False):
            at = (400e3 + 300e3 * depth, 250e3, 50e3 + 400e3 * depth, float(motion))
            rows.append((*at, 0.0, day))
            if motion == 0:
                rows.append((*at, 1.0, day))
    weight, cased, open_hole, motion, torque, day_of = np.array(rows).T
    turns = torque > 0
    noise = np.where(turns, TORQUE**2 + ROUNDING[1] ** 2 / 12, HOOKLOAD**2 + ROUNDING[0] ** 2 / 12)
    contact = np.stack([cased, open_hole], axis=1)
    return Toy(weight, contact, motion, turns, np.zeros(len(motion)), noise, day_of.astype(np.int64))


def measure(rng: np.random.Generator, toy: Toy, truth: Array, deviations: Array) -> Toy:
    """The rows as days with these deviations would read them, rounded as a report rounds."""
    effects = rng.normal(size=(int(toy.day.max()) + 1, 2)) * deviations
    at = toy.at(with_friction(UNKNOWNS, np.broadcast_to(truth, (len(effects), len(truth))), effects[:, 0]))
    read = at.value + at.gains * effects[toy.day, 1] + rng.normal(size=len(toy.day)) * np.where(
        toy.torque, TORQUE, HOOKLOAD
    )  # fmt: skip
    step = np.where(toy.torque, ROUNDING[1], ROUNDING[0])
    return replace(toy, measured=step * np.round(read / step))


def drawn_truth(rng: np.random.Generator) -> Array:
    """Values of the unknowns from the priors of the fit: log-normal for friction."""
    found = []
    for unknown in UNKNOWNS:
        mean, sd = unknown.prior or (0.0, 0.0)
        if unknown.name.startswith("friction"):
            s = np.sqrt(np.log1p((sd / mean) ** 2))
            found.append(mean * np.exp(s * rng.normal() - 0.5 * s**2))
        else:
            found.append(rng.normal(mean, sd))
    return np.array(found)


def predicted(fit: DayFit, rng: np.random.Generator, toy: Toy, samples: int = 1000) -> Array:
    """Readings (samples, n) of days that were not seen, as ``fctd predict`` draws them."""
    at = toy.at(np.broadcast_to(fit.best, (int(toy.day.max()) + 1, len(fit.best))))
    found = draw(UNKNOWNS, fit.mixture, fit.best, at, toy.day, rng, samples).T
    return np.asarray(found + rng.normal(size=found.shape) * np.sqrt(toy.variance))


def trial(seed: int, *, scatter: bool = True) -> tuple[list[dict[str, Any]], pd.DataFrame]:
    """A trial: for each parameter truth and interval, and a row for each reading of five days that were not fitted.

    scatter : whether deviations are drawn from their priors, or 0.
    """
    rng = np.random.default_rng([33, seed, int(scatter)])
    truth = drawn_truth(rng)
    deviations = rng.exponential(SCALES) if scatter else np.zeros(2)
    toy = measure(rng, blank(rng, int(rng.integers(DAYS[0], DAYS[1] + 1))), truth, deviations)
    first = np.array([unknown.start for unknown in UNKNOWNS])
    fit = fit_days(toy, first, SCALES)
    later = measure(rng, blank(rng, 5), truth, deviations)
    bands = np.quantile(predicted(fit, rng, later), [0.025, 0.975], axis=0)
    rows = []
    for k, unknown in enumerate(UNKNOWNS):
        low, high = fit.interval(k)
        rows.append({"name": unknown.name, "truth": truth[k], "value": fit.best[k], "low": low, "high": high})
    for i, name in enumerate(("scatter.friction", "scatter.hookload")):
        low, high = fit.nodes.quantile(i, 0.025), fit.nodes.quantile(i, 0.975)
        rows.append(
            {"name": name, "truth": deviations[i], "value": fit.nodes.quantile(i, 0.5), "low": low, "high": high}
        )
    readings = pd.DataFrame(
        {"torque": later.torque, "measured": later.measured, "low": bands[0], "high": bands[1], "trial": seed}
    )
    if not scatter:
        alone = fit_days(toy, first, np.zeros(2))
        without = np.quantile(predicted(alone, rng, later), [0.025, 0.975], axis=0)
        readings["width_without"] = without[1] - without[0]
    return [{"trial": seed, **row} for row in rows], readings
