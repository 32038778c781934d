"""Whether a kernel has become slower, as a pure function of the samples of two releases.

Every process places its memory and compiled code anew, which changes a kernel's cost by several per cent for the whole
process, while rounds of one process agree to one per cent.  A sample is therefore one process.  The change is the
median of all quotients of a sample now and a sample before (Hodges and Lehmann), with the confidence interval of Mann
and Whitney, which assumes no distribution and is robust against outliers.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

THRESHOLD = 1.15
# Standard deviations of the Mann–Whitney statistic: one-sided confidence of 90 %.
CONFIDENCE = 1.2816
# With fewer processes on either side the interval has no meaning.
LEAST_SAMPLES = 3

Samples = Mapping[str, Sequence[float]]  # kernel -> cost in each process, in the same unit on both sides


@dataclass(frozen=True)
class Verdict:
    """One kernel now, compared with before.

    status : ``slower`` (by the threshold, beyond noise), ``perhaps slower`` (by the threshold, within noise),
    ``faster`` (by the threshold, beyond noise), ``as before``, ``new``, ``missing`` (measured before, not now) or
    ``too few`` (samples).  change, low, high : cost now over cost before and its 80 % interval, NaN without one;
    threshold : change at which a kernel fails.
    """

    kernel: str
    status: str
    change: float = float("nan")
    low: float = float("nan")
    high: float = float("nan")
    threshold: float = THRESHOLD

    @property
    def fails(self) -> bool:
        """Whether the gate fails: the kernel is slower, or no longer measured."""
        return self.status in ("slower", "missing")

    @property
    def open(self) -> bool:
        """Whether more processes are needed: the interval reaches the threshold."""
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
    """Cost now over cost before: estimate, lower and upper end of its 80 % interval."""
    quotients = np.divide.outer(np.asarray(now, float), np.asarray(before, float)).ravel()
    m, n = len(now), len(before)
    tail = max(0.5 - CONFIDENCE * ((m + n + 1) / (12 * m * n)) ** 0.5, 0.0)
    low, change, high = np.quantile(quotients, [tail, 0.5, 1 - tail])
    return float(change), float(low), float(high)
