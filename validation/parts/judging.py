"""Judging of predictions with scatter between days: bands, coverage, widths and scores, for one well at a time.

What is judged is the middle of a recorded range, against the distribution of what the source would record on a day that
was not seen: draws of all readings together (``fctd.calibration.predict``), in which readings of one day share its
friction and its weight.  Torques and weights have scores of their own; those of different wells are never pooled.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, NamedTuple

import numpy as np
import pandas as pd

from fctd.arrays import Array
from fctd.calibration.forward import Forward
from fctd.calibration.predict import SAMPLES, Posterior, crps, draw_readings
from fctd.calibration.rows import days_of
from fctd.calibration.scatter import coordinate
from validation.harness.study import Rows, table_of_rows

BANDS: Final = (0.50, 0.95)
# Two-sided probability below which the count outside the bands is not that of 95 % bands.
LEVEL: Final = 0.01
RESAMPLED: Final = 10_000
UNITS: Final = {"torque": "kN m", "hookload": "kN"}


class Judged(NamedTuple):
    """What a row is judged on: its id, a quantity, and the readings that it combines, with their shares."""

    id: str
    quantity: str
    parts: tuple[tuple[int, float], ...]


@dataclass(frozen=True)
class Forecast:
    """Judged quantities (n) of a model in ``units``: low and high as recorded, and joint draws (n, samples); days."""

    judged: tuple[Judged, ...]
    units: tuple[str, ...]
    days: tuple[str, ...]
    low: Array
    high: Array
    draws: Array

    @property
    def middle(self) -> Array:
        """The middle of each recorded range (n,)."""
        return 0.5 * (self.low + self.high)


def readings_of(forward: Forward) -> list[Judged]:
    """Every measured reading of rows with ids such as "KEY up", by itself."""
    found = []
    for i, reading in enumerate(forward.readings):
        if not np.isnan(reading.range.low):
            key, label = forward.rows[reading.row].id.rsplit(" ", 1)
            found.append(Judged(key, "torque" if reading.load == "torque" else f"weight {label}", ((i, 1.0),)))
    return found


def differences_of(forward: Forward) -> list[Judged]:
    """Pick-up minus slack-off of the keys that have both."""
    at = {(one.id, one.quantity): one.parts[0][0] for one in readings_of(forward)}
    return [
        Judged(key, "pick-up minus slack-off", ((i, 1.0), (at[key, "weight down"], -1.0)))
        for (key, quantity), i in at.items()
        if quantity == "weight up" and (key, "weight down") in at
    ]


def forecast(
    posterior: Posterior, forward: Forward, judged: Iterable[Judged], *, noise: bool = True, seed: int = 0
) -> Forecast:
    """What a posterior says of quantities of the readings of a forward model [kN, kN m]."""
    judged = tuple(judged)
    names, day = days_of(forward.rows)
    readings, draws = forward.readings, draw_readings(posterior, forward, SAMPLES, seed, noise=noise)
    first = [readings[one.parts[0][0]] for one in judged]

    def combined(values: Array) -> Array:
        return 1e-3 * np.array([sum(share * values[i] for i, share in one.parts) for one in judged])

    middle = combined(np.array([reading.range.middle for reading in readings]))
    # The range of a difference is as wide as those of its parts together.
    widths = [
        [abs(share) * (readings[i].range.high - readings[i].range.low) for i, share in one.parts] for one in judged
    ]
    half = 0.5e-3 * np.array([sum(parts) for parts in widths])
    return Forecast(
        judged, tuple(UNITS[r.load] for r in first), tuple(names[day[r.row]] for r in first),
        middle - half, middle + half, combined(draws),
    )  # fmt: skip


def line(
    one: Judged,
    unit: str,
    low: float,
    high: float,
    median: float,
    ends: Mapping[float, tuple[float, float]],
    inside: Callable[[float, float], bool],
) -> dict[str, object]:
    """The columns of a judged quantity; ends : of each band; inside : whether the recorded one is in a band."""
    edges = {
        f"{end}_{100 * share:.0f}": found[k] for share, found in ends.items() for k, end in enumerate(("low", "high"))
    }
    return {
        "row": one.id, "quantity": one.quantity, "unit": unit, "measured_low": low, "measured_high": high,
        "median": median, **edges,
        **{f"in_{100 * share:.0f}": inside(*found) for share, found in ends.items()},
        "distance_percent": 100 * max(low - median, median - high, 0.0) / abs(0.5 * (low + high)),
    }  # fmt: skip


@table_of_rows
def judge(well: str, model: str, found: Forecast) -> Rows:
    """A row for each quantity: recorded range, median, bands, whether its middle is in them, distance, CRPS, error."""
    for k, one in enumerate(found.judged):
        draws, middle = found.draws[k], float(found.middle[k])
        ends = {share: tuple(np.quantile(draws, [0.5 - share / 2, 0.5 + share / 2]).tolist()) for share in BANDS}
        low, high = float(found.low[k]), float(found.high[k])
        row = line(one, found.units[k], low, high, float(np.median(draws)), ends, partial(_within, middle))
        error = float(draws.mean()) - middle
        yield {"well": well, "model": model, "day": found.days[k], **row, "crps": crps(draws, middle), "error": error}


def _within(middle: float, low: float, high: float) -> bool:
    return low <= middle <= high


@table_of_rows
def summarise(found: Forecast, table: pd.DataFrame, carried: Mapping[tuple[str, str], float]) -> Rows:
    """A row for the torques and one for the weights of a table of ``judge``.

    carried : the last reading that fitted of the same kind [kN, kN m], by id and quantity.  Coverage with its interval
    by resampling days; whether the count outside is compatible with bands of 95 %; CRPS beside that of the last reading
    carried on, as a forecast without width; bias, the mean of the errors.
    """
    for unit in dict.fromkeys(found.units):
        here = np.flatnonzero(np.array(found.units) == unit)
        rows = table.iloc[here]
        inside = rows["in_95"].to_numpy(bool)
        low, high = coverage_interval(inside, [found.days[k] for k in here])
        few, many = count_probabilities(found.draws[here], int((~inside).sum()))
        known = [(k, carried.get(found.judged[k][:2])) for k in here]
        off = [abs(value - float(found.middle[k])) for k, value in known if value is not None]
        yield {
            "well": rows["well"].iloc[0], "model": rows["model"].iloc[0], "unit": unit, "readings": len(here),
            "days": rows["day"].nunique(), "in_50": int(rows["in_50"].sum()), "in_95": int(inside.sum()),
            "coverage_95": float(inside.mean()), "coverage_low": low, "coverage_high": high,
            "probability_of_as_few_outside": few, "probability_of_as_many_outside": many,
            "compatible": min(few, many) > LEVEL / 2, "crps": float(rows["crps"].mean()),
            "crps_carried_on": float(np.mean(off)) if len(off) == len(here) else float("nan"),
            "bias": float(rows["error"].mean()),
        }  # fmt: skip


def coverage_interval(inside: Array, days: Sequence[str]) -> tuple[float, float]:
    """95 % interval of a share of readings inside, from days drawn with replacement; seeded."""
    _, of = np.unique(np.array(days), return_inverse=True)
    counts, hits = np.bincount(of), np.bincount(of, weights=np.asarray(inside, float))
    picked = np.random.default_rng(33).integers(len(counts), size=(RESAMPLED, len(counts)))
    shares = hits[picked].sum(axis=1) / counts[picked].sum(axis=1)
    low, high = np.quantile(shares, [0.025, 0.975])
    return float(low), float(high)


def count_probabilities(draws: Array, outside: int) -> tuple[float, float]:
    """How likely as few, and as many, quantities lie outside their own 95 % bands, from the joint draws (n, samples).

    Readings of a day miss together, which a binomial distribution would not know.
    """
    low, high = np.quantile(draws, [0.025, 0.975], axis=1)
    counts = ((draws < low[:, None]) | (draws > high[:, None])).sum(axis=0)
    return float((counts <= outside).mean()), float((counts >= outside).mean())


def widths(posterior: Posterior, forward: Forward) -> pd.DataFrame:
    """A row for each pick-up minus slack-off: reading [kN], its 95 % width, and that which scatter alone forces.

    width, scatter_width : over the reading; the second with the best values of the unknowns, known without error, and
    with readings without noise; ratio of the two.
    """
    pairs = differences_of(forward)
    assert posterior.mixture is not None
    at = np.array([float(coordinate(u, v)) for u, v in zip(posterior.unknowns, posterior.best, strict=True)])
    mixture = posterior.mixture
    fixed = replace(mixture, mean=np.tile(at, (len(mixture.weight), 1)), covariance=np.zeros_like(mixture.covariance))
    full = forecast(posterior, forward, pairs)
    alone = forecast(replace(posterior, mixture=fixed), forward, pairs, noise=False)
    table = pd.DataFrame({"row": [one.id for one in pairs], "difference_kN": full.middle})
    for name, found in (("width", full), ("scatter_width", alone)):
        low, high = np.quantile(found.draws, [0.025, 0.975], axis=1)
        table[name] = (high - low) / found.middle
    return table.assign(ratio=table["width"] / table["scatter_width"])
