"""Alarms: where apparent friction factors leave the band of those before, found by cumulative sums.

Page's test (E. S. Page, Continuous inspection schemes, Biometrika 41, 1954) adds up log-likelihood ratios of a step
against no step and starts again from 0.  A reading with standard deviation σ of its factor, z standard deviations above
its baseline, adds δ (z − δ/2), δ = step/σ: a reading that hardly depends on the friction adds hardly anything.  The
alarm comes where the sum exceeds ln(2 N).  By Lorden (Annals of Mathematical Statistics 42, 1971, theorem 2) sums in
one direction then have a false alarm in 2 N readings on average or fewer of them, so that both together have one in N.

Rotation, pick-up and slack-off have a baseline each, since what the model leaves out differs between them; a step of
the friction shows in all, and they share the sums.  The baseline is the mean, weighted by 1/σ², of the readings of the
kind but the last `LAG`, which may lie behind a step already; each enters with at most `HUBER` standard deviations of
difference (Huber 1964).  Its own variance is added to that of a reading, as in Hawkins's self-starting sums
(Technometrics 29, 1987).  Where the readings of a kind scatter more than their σ says, σ is multiplied by the ratio,
estimated from the median of the differences between one reading and the next (Rice 1984), which a step hardly changes.
"""

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from fctd.case.message import Message, quantity
from fctd.monitoring.friction import TWO_SIDED_95, Apparent
from fctd.monitoring.stretches import ROTATING, Mode

FIRST: Final = 3  # readings of a kind before its baseline judges others
LAG: Final = 3
HUBER: Final = 2.0
SCATTER_OF: Final = 5  # differences of a kind from which its scatter is estimated
CHANCE: Final = 0.6  # times 1/√n: half the relative standard deviation of a scatter estimated by a median
KINDS: Final = ("rotation", "pick_up", "slack_off")


def kind_of(mode: Mode) -> str:
    """The kind of reading of a stretch: rotation in any direction is one."""
    return "rotation" if mode in ROTATING else mode


@dataclass(frozen=True)
class Alarm:
    """A step of the apparent friction factor.

    start, found : least and greatest depth of the readings from the step to the alarm [m]; row, time [s] : of the
    reading that raised it; size : change of the factor, low and high its 95 % band; before : weighted mean of the
    baselines.
    """

    start: float
    found: float
    row: int
    time: float
    size: float
    low: float
    high: float
    before: float

    @property
    def sentence(self) -> Message:
        """The alarm in words."""
        change = "above" if self.size > 0 else "below"
        share = f", {abs(self.size / self.before):.0%}" if self.before > 0.02 else ""
        what = f"the apparent friction factor is {abs(self.size):.2f} {change} the {self.before:.2f} before{share}"
        band = f"95 % band {self.low:+.2f} to {self.high:+.2f}"
        start, found = quantity(self.start, "m", ".0f"), quantity(self.found, "m", ".0f")
        return Message(f"from {start} {what} ({band}); found at {found}")


@dataclass
class _Baseline:
    """The readings of one kind: those in the baseline by sums, and the last ones that wait."""

    weight: float = 0.0
    weighted: float = 0.0
    readings: int = 0
    waiting: list[tuple[float, float]] = field(default_factory=list)
    scatter: list[float] = field(default_factory=list)
    last: tuple[float, float] | None = None

    @property
    def mean(self) -> float:
        return self.weighted / self.weight

    @property
    def scale(self) -> float:
        """How much more the readings scatter than their standard deviations say: 1 or more, and hardly by chance."""
        if len(self.scatter) < SCATTER_OF:
            return 1.0
        found = 1.4826 * float(np.median(np.abs(self.scatter)))
        return max(1.0, found / (1 + CHANCE / float(np.sqrt(len(self.scatter)))))

    def take(self, factor: float, noise: float) -> None:
        """Keep a reading back, and let the one that has waited longest enter."""
        if self.last is not None:
            self.scatter.append((factor - self.last[0]) / float(np.hypot(noise, self.last[1])))
        self.last = (factor, noise)
        self.readings += 1
        self.waiting.append((factor, noise))
        if len(self.waiting) > LAG or self.weight == 0:
            factor, noise = self.waiting.pop(0)
            if self.weight > 0:
                most = HUBER * self.scale * float(np.hypot(noise, self.weight**-0.5))
                factor = float(np.clip(factor, self.mean - most, self.mean + most))
            self.weight += noise**-2
            self.weighted += factor * noise**-2


class Detector:
    """Finds steps in apparent factors that come one after the other.

    step : the change to find, a share of the baseline; readings : N above, readings between false alarms.  An alarm
    starts the baselines anew, so that the next one tells a change from the new state.
    """

    def __init__(self, step: float = 0.25, readings: float = 50.0) -> None:
        self.step, self.limit = step, float(np.log(2 * readings))
        self._baselines = {kind: _Baseline() for kind in KINDS}
        self._start_anew()

    def _start_anew(self) -> None:
        self._baselines = {kind: _Baseline(scatter=old.scatter, last=old.last) for kind, old in self._baselines.items()}
        self._sums = np.zeros(2)  # of a rise, of a fall
        self._since: tuple[list[tuple[Apparent, float, float]], ...] = ([], [])

    def band(self, kind: str) -> tuple[float, float]:
        """Baseline of a kind and its standard deviation; NaN while there is none."""
        baseline = self._baselines[kind]
        if baseline.weight == 0:
            return float("nan"), float("nan")
        return baseline.mean, baseline.weight**-0.5

    def feed(self, reading: Apparent) -> Alarm | None:
        """The alarm that a reading raises, if any; readings without a factor change nothing."""
        if np.isnan(reading.factor):
            return None
        kind = kind_of(reading.stretch.mode)
        baseline = self._baselines[kind]
        alarm = None
        if baseline.readings >= FIRST:
            deviation = baseline.scale * float(np.hypot(reading.noise, baseline.weight**-0.5))
            alarm = self._add(reading, reading.factor - baseline.mean, deviation)
        if alarm is not None:
            self._start_anew()
        self._baselines[kind].take(reading.factor, reading.noise)
        return alarm

    def _add(self, reading: Apparent, off: float, deviation: float) -> Alarm | None:
        """Add a reading that is ``off`` its baseline to both sums."""
        shift = self.step * max(self._level(), 0.02) / deviation
        for k, sign in enumerate((1.0, -1.0)):
            self._sums[k] += shift * (sign * off / deviation - shift / 2)
            self._since[k].append((reading, off, deviation))
            if self._sums[k] <= 0:
                self._sums[k] = 0.0
                self._since[k].clear()
            elif self._sums[k] > self.limit:
                return self._alarm(self._since[k])
        return None

    def _level(self) -> float:
        """Weighted mean of the baselines."""
        weight = sum(baseline.weight for baseline in self._baselines.values())
        return sum(baseline.weighted for baseline in self._baselines.values()) / weight

    def _alarm(self, since: list[tuple[Apparent, float, float]]) -> Alarm:
        weights = np.array([deviation**-2 for _, _, deviation in since])
        size = float(np.average([off for _, off, _ in since], weights=weights))
        error = TWO_SIDED_95 * float(weights.sum() ** -0.5)
        depths, last = [reading.stretch.bit_depth for reading, _, _ in since], since[-1][0].stretch
        return Alarm(min(depths), max(depths), last.last_row, last.end, size, size - error, size + error, self._level())
