"""Whether a kernel has become slower: a pure function of what two releases' processes measured.

A process lays its memory and its compiled code out anew, which moves a kernel's cost by several per cent for as long
as the process lives, while rounds within a process agree to one.  A sample is therefore one process; the change is
the median of all quotients of a sample now and a sample before (the estimate of Hodges and Lehmann), and what noise
leaves open is its confidence interval of Mann and Whitney, which knows no distribution and no outlier.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

THRESHOLD = 1.15
# Standard deviations of the Mann–Whitney statistic: one-sided confidence of 90 %.
CONFIDENCE = 1.2816
# Fewer processes on either side show no spread.
LEAST_SAMPLES = 3

Samples = Mapping[str, Sequence[float]]  # kernel -> cost in each process, in a unit that both sides share


@dataclass(frozen=True)
class Verdict:
    """One kernel now against before.

    status : ``slower`` (by the threshold, beyond noise), ``perhaps slower`` (by the threshold, within noise),
    ``faster`` (by the threshold, beyond noise), ``as before``, ``new``, ``missing`` (measured before, not now) or
    ``too few`` (samples).  change, low, high : cost now over cost before and its 80 % interval, NaN without one;
    threshold : of the change that fails.
    """

    kernel: str
    status: str
    change: float = float("nan")
    low: float = float("nan")
    high: float = float("nan")
    threshold: float = THRESHOLD

    @property
    def fails(self) -> bool:
        """Whether this is not to be merged: slower, or no longer measured."""
        return self.status in ("slower", "missing")

    @property
    def open(self) -> bool:
        """Whether more processes are worth their time: a kernel that may be too slow for all that noise leaves open."""
        return self.high >= self.threshold


def decide(before: Samples, now: Samples, threshold: float = THRESHOLD) -> list[Verdict]:
    """A verdict for every kernel of either side, in the order of ``before``."""
    verdicts = [_one(kernel, before[kernel], now[kernel], threshold) if kernel in now else Verdict(kernel, "missing")
                for kernel in before]  # fmt: skip
    return verdicts + [Verdict(kernel, "new") for kernel in now if kernel not in before]


def _one(kernel: str, before: Sequence[float], now: Sequence[float], threshold: float) -> Verdict:
    if min(len(before), len(now)) < LEAST_SAMPLES:
        return Verdict(kernel, "too few")
    change, low, high = change_of(before, now)
    if low >= threshold:
        status = "slower"
    elif change >= threshold:
        status = "perhaps slower"
    else:
        status = "faster" if high <= 1 / threshold else "as before"
    return Verdict(kernel, status, change, low, high, threshold)


def change_of(before: Sequence[float], now: Sequence[float]) -> tuple[float, float, float]:
    """Cost now over cost before: estimate, lower and upper bound."""
    quotients = np.divide.outer(np.asarray(now, float), np.asarray(before, float)).ravel()
    m, n = len(now), len(before)
    tail = max(0.5 - CONFIDENCE * ((m + n + 1) / (12 * m * n)) ** 0.5, 0.0)
    low, change, high = np.quantile(quotients, [tail, 0.5, 1 - tail])
    return float(change), float(low), float(high)
