"""Whether a kernel has become slower, as a pure function of the samples of two commits.

Every process places its memory and compiled code anew, which changes a kernel's cost by a per cent for the whole
process.  A sample is therefore one process.  The change is the median of all quotients of a sample now and a sample
before (Hodges and Lehmann), with the confidence interval of Mann and Whitney, which assumes no distribution and is
robust against outliers.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import nan

import numpy as np

THRESHOLD = 1.10
# Standard deviations of the Mann–Whitney statistic: one-sided confidence of 90 %.
CONFIDENCE = 1.2816
FAILING = ("slower", "missing", "no baseline")

Samples = Mapping[str, Sequence[float]]  # kernel -> cost in each process, in the same unit on both sides


@dataclass(frozen=True)
class Verdict:
    """One kernel now, compared with before.

    status : ``slower`` (by the threshold, beyond noise), ``perhaps slower`` (by the threshold, within noise),
    ``faster`` (by the threshold, beyond noise), ``as before``, ``new`` (the change at hand brings it), ``no baseline``
    (an earlier change brought it) or ``missing`` (measured before, not now).  change, low, high : cost now over cost
    before and its 80 % interval, NaN without one; threshold : change at which a kernel fails.
    """

    kernel: str
    status: str
    change: float = nan
    low: float = nan
    high: float = nan
    threshold: float = THRESHOLD

    @property
    def fails(self) -> bool:
        """Whether the gate fails: the kernel is slower, has no baseline, or is no longer measured."""
        return self.status in FAILING

    @property
    def open(self) -> bool:
        """Whether more processes are needed: the interval reaches the threshold."""
        return self.high >= self.threshold


def decide(
    before: Samples,
    now: Samples,
    accepted: Mapping[str, float] = {},
    brings: Callable[[str], bool] = lambda kernel: False,
) -> list[Verdict]:
    """A verdict for every kernel of either side, in the order of ``before``.

    accepted : by how much kernels became slower since, with a reason; their thresholds rise by it.
    brings : whether the change at hand brings a kernel, which then needs no baseline.
    """
    verdicts = [
        _one(kernel, before[kernel], now[kernel], THRESHOLD * accepted.get(kernel, 1.0))
        if kernel in now
        else Verdict(kernel, "missing")
        for kernel in before
    ]
    fresh = [kernel for kernel in now if kernel not in before]
    return verdicts + [Verdict(kernel, "new" if brings(kernel) else "no baseline") for kernel in fresh]


def _one(kernel: str, before: Sequence[float], now: Sequence[float], threshold: float) -> Verdict:
    change, low, high = change_of(before, now)
    if change < threshold:
        status = "faster" if high <= 1 / THRESHOLD else "as before"
    else:
        status = "slower" if low > threshold else "perhaps slower"
    return Verdict(kernel, status, change, low, high, threshold)


def change_of(before: Sequence[float], now: Sequence[float]) -> tuple[float, float, float]:
    """Cost now over cost before: estimate, lower and upper end of its 80 % interval."""
    quotients = np.divide.outer(np.asarray(now, float), np.asarray(before, float)).ravel()
    m, n = len(now), len(before)
    tail = max(0.5 - CONFIDENCE * ((m + n + 1) / (12 * m * n)) ** 0.5, 0.0)
    low, change, high = np.quantile(quotients, [tail, 0.5, 1 - tail])
    return float(change), float(low), float(high)
