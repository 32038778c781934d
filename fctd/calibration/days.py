"""Measured rows by day: the fit with scatter of a ``Forward``, and what it says without each day."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.calibration.fit import Fit
from fctd.calibration.forward import Evaluation, Forward
from fctd.calibration.intervals import Intervals
from fctd.calibration.rows import days_of
from fctd.calibration.scatter import EFFECTS, At, DayFit, draw, fit_days, values_of
from fctd.calibration.unknowns import is_factor
from fctd.case.errors import InputError

Array = NDArray[np.float64]

HOW: Final = "scatter of days"  # where its intervals come from
SAMPLES: Final = 4000
# Names and units of the standard deviations between days.
DEVIATIONS: Final = {f"scatter.{effect}": unit for effect, unit in zip(EFFECTS, ("", "N"), strict=True)}


class ForwardByDay:
    """The measured readings of used rows, whose strings are solved with the friction of their day (``DayReadings``)."""

    def __init__(self, forward: Forward, used: Sequence[int]) -> None:
        self.unknowns = forward.unknowns
        self.names, of_row = days_of([forward.rows[k] for k in used])
        # Rows by day, each with the part of the forward model that has them.
        self.rows = [[row for row, of in zip(used, of_row, strict=True) if of == d] for d in range(len(self.names))]
        self.parts = [forward.of_rows(rows) for rows in self.rows]
        place = {(reading.row, reading.load): i for i, reading in enumerate(forward.readings)}
        measured, variance, day, self.index, self._kept = [], [], [], [], []
        for d, part in enumerate(self.parts):
            for i, reading in enumerate(part.readings):
                low, high = reading.range
                if np.isnan(low):
                    continue
                measured.append(reading.range.middle)
                variance.append((reading.noise**2 + (high - low) ** 2 / 12) / part.rows[reading.row].weight)
                day.append(d)
                self.index.append(place[self.rows[d][reading.row], reading.load])
                self._kept.append((d, i))
        self.measured, self.variance, self.day = np.array(measured), np.array(variance), np.array(day, np.int64)

    def at(self, values: Array) -> At:
        """See ``DayReadings``."""
        found = [part.evaluate(of_day) for part, of_day in zip(self.parts, values, strict=True)]
        gains = [part.gains(of_day) for part, of_day in zip(self.parts, values, strict=True)]
        return At(
            np.array([found[d].value[i] for d, i in self._kept]),
            np.array([found[d].slopes[i] for d, i in self._kept]),
            np.array([gains[d][i] for d, i in self._kept]),
        )


@dataclass(frozen=True)
class Scattered:
    """A fit with scatter: names of its days, and the places of its readings (n,) among those of the forward model.

    typical : all readings of the forward model at the best values, on a day without effects.
    """

    fit: DayFit
    days: tuple[str, ...]
    index: NDArray[np.int64]
    typical: Evaluation

    @property
    def score(self) -> float:
        """Sum over the days of the log of the density that a fit without the day gives to its readings."""
        return sum(self.fit.without(d)[1] for d in range(len(self.days)))

    @property
    def intervals(self) -> Intervals:
        """Intervals of the unknowns, and their covariance [SI]."""
        unknowns = self.fit.unknowns
        low, high = np.array([self.fit.interval(k) for k in range(len(unknowns))]).T
        near = 0.03 * (high - low)
        at_bound = tuple(
            u.name for u, a, b, c in zip(unknowns, low, high, near, strict=True) if a <= u.low + c or b >= u.high - c
        )
        return Intervals(low, high, (HOW,) * len(low), at_bound, self.fit.covariance)

    @property
    def deviations(self) -> list[dict[str, Any]]:
        """Name, unit, value (median) and 95 % interval of the standard deviations that were fitted."""
        found = []
        for i, (name, unit) in enumerate(DEVIATIONS.items()):
            if self.fit.scales[i] > 0:
                low, value, high = (self.fit.nodes.quantile(i, share) for share in (0.025, 0.5, 0.975))
                found.append({"name": name, "unit": unit, "value": value, "low": low, "high": high, "how": HOW})
        return found

    def leave_one_out(self, forward: Forward) -> pd.DataFrame:
        """A row for each reading: what a fit without its day says of it, with the band of 95 % of its day and noise.

        Columns: id, load, low, high, predicted, low95, high95 [SI], off : distance of predicted from the range over
        the noise; and the value of each unknown without the day.
        """
        unknowns, table = self.fit.unknowns, []
        for d in range(len(self.days)):
            mixture, _ = self.fit.without(d)
            values = values_of(unknowns, mixture.centre)
            here = self.index[self.fit.model.day == d]
            gains = self.fit.at.gains[self.fit.model.day == d]
            at = At(self.typical.value[here], self.typical.slopes[here], gains)
            drawn = draw(unknowns, mixture, self.fit.best, at, np.zeros(len(here), np.int64), _rng(d), SAMPLES)
            noise = np.sqrt(self.fit.model.variance[self.fit.model.day == d])
            drawn += noise[:, None] * _rng(d + len(self.days)).normal(size=drawn.shape)
            predicted = at.value + at.slopes @ (values - self.fit.best)
            for j, i in enumerate(here):
                reading = forward.readings[i]
                low, high = reading.range
                off = max(predicted[j] - high, 0.0) + min(predicted[j] - low, 0.0)
                band = np.quantile(drawn[j], [0.025, 0.975]).tolist()
                table.append(
                    {"id": forward.rows[reading.row].id, "load": reading.load, "low": low, "high": high,
                     "predicted": predicted[j], "low95": band[0], "high95": band[1], "off": off / reading.noise,
                     **dict(zip(forward.names, values.tolist(), strict=True))}
                )  # fmt: skip
        return pd.DataFrame(table)


def fit_scatter(forward: Forward, found: Fit) -> tuple[Fit, Scattered]:
    """A fit with scatter, which starts at one without: its values, and readings with the effects of their days.

    The loss of the fit before is not used: readings are normal, and a day that is off is what the scatter is for.
    Raises InputError where the rows and the priors do not determine the unknowns.
    """
    prior = forward.setup.scatter
    by_day = ForwardByDay(forward, found.used)
    # An effect that no reading shows would be its prior.
    shown = any(is_factor(name) for name in forward.names), any(
        forward.readings[i].load == "hookload" for i in by_day.index
    )  # fmt: skip
    try:
        fit = fit_days(by_day, found.best, np.array([prior.friction, prior.hookload]) * shown)
    except np.linalg.LinAlgError:
        raise InputError(
            "rows that tell the unknowns apart, or priors", key="fit", value=[*forward.names]
        ) from None  # fmt: skip
    typical = forward.evaluate(fit.best)
    index = np.array(by_day.index, np.int64)
    value, slopes = typical.value.copy(), typical.slopes.copy()
    value[index], slopes[index] = fit.fitted, fit.at.slopes
    evaluation = replace(typical, value=value, slopes=slopes)
    return replace(found, best=fit.best, evaluation=evaluation), Scattered(fit, by_day.names, index, typical)


def _rng(seed: int) -> np.random.Generator:
    return np.random.default_rng([33, seed])
