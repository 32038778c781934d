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
from validation.harness.study import Check, Context

Array = NDArray[np.float64]

TRIALS: Final = 400
# Of 400 trials, those of 95 % intervals that hold the truth lie in this range in 99.7 % of studies (binomial).
HELD: Final = (366, 392)
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

    scatter : whether deviations are drawn from their priors, or 0; then also the width of the band that a fit without
    scatter gives, and the deviations over the noise of a reading.
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
    noise = np.where(toy.torque, TORQUE, HOOKLOAD)
    for i, name in enumerate(("scatter.friction", "scatter.hookload")):
        low, value, high = (fit.nodes.quantile(i, share) for share in (0.025, 0.5, 0.975))
        moved = np.abs(fit.model.effects[:, i] / noise)
        rows.append(
            {"name": name, "truth": deviations[i], "value": value, "low": low, "high": high,
             "over_noise": value * float(np.median(moved[moved > 0]))}
        )  # fmt: skip
    readings = pd.DataFrame(
        {"trial": seed, "torque": later.torque, "measured": later.measured, "low": bands[0], "high": bands[1]}
    )
    readings["inside"] = (readings["low"] <= readings["measured"]) & (readings["measured"] <= readings["high"])
    if not scatter:
        alone = np.quantile(predicted(fit_days(toy, first, np.zeros(2)), rng, later), [0.025, 0.975], axis=0)
        readings["width_over_without"] = (bands[1] - bands[0]) / (alone[1] - alone[0])
    found = [{"trial": seed, **row, "held": row["low"] <= row["truth"] <= row["high"]} for row in rows]
    return found, readings


def trials(context: Context) -> tuple[dict[str, pd.DataFrame], list[Check]]:
    """Trials with scatter and without, their summaries, and what they must show."""
    count, none = (12, 4) if context.quick else (TRIALS, TRIALS // 2)
    made = [trial(seed) for seed in context.progress(range(count), "trials with scatter")]
    still = [trial(seed, scatter=False) for seed in context.progress(range(none), "trials without scatter")]
    parameters, without = (pd.DataFrame([row for rows, _ in of for row in rows]) for of in (made, still))
    readings, narrow = (pd.concat([table for _, table in of], ignore_index=True) for of in (made, still))
    summary = parameters.groupby("name", sort=False).agg(
        trials=("held", "size"), held=("held", "sum"), mean_truth=("truth", "mean"), mean_value=("value", "mean")
    ).reset_index()  # fmt: skip
    summary["median_without_over_noise"] = without.groupby("name", sort=False)["over_noise"].median().to_numpy()
    inside = 100 * float(readings["inside"].mean())
    deviation = float(summary["median_without_over_noise"].max())
    wider = float(narrow["width_over_without"].mean())
    tables = {"scatter_trials": parameters, "scatter_readings": readings, "scatter_intervals": summary}
    if context.quick:
        shares = 100 * float(summary["held"].sum() / summary["trials"].sum())
        source = "95 %, and four standard errors of 84 intervals"
        return tables, [Check("scatter: intervals that hold the truth", shares, 85.0, "at_least", "%", source)]
    source = "99.7 % of the binomial distribution of 400 intervals of 95 %"
    return tables, [
        Check("scatter: trials whose interval holds the truth, fewest", int(summary["held"].min()), HELD[0],
              "at_least", f"of {TRIALS}", source),
        Check("scatter: trials whose interval holds the truth, most", int(summary["held"].max()), HELD[1],
              "at_most", f"of {TRIALS}", source),
        Check("scatter: readings of unseen days inside their band of 95 %", inside, (92.0, 97.0), "within", "%",
              "95 %, and what the scatter of few days leaves"),
        Check("scatter of days that have none: median deviation over the noise of a reading", deviation, 1 / 3,
              "at_most", "", "the prior must not make scatter"),
        Check("scatter of days that have none: width of bands over those of a fit without it", wider, 1.15, "at_most",
              "", "the prior must not widen bands"),
    ]  # fmt: skip
