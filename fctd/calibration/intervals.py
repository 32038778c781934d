"""Intervals of the unknowns: from the cost's Hessian, or from the profile likelihood where the Hessian misleads."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd

from fctd.arrays import Array
from fctd.calibration.fit import Fit, Loss, cost_of, fit, residuals_of, weights_of
from fctd.calibration.forward import Forward
from fctd.calibration.identify import covariance_of, information

# Half-width of a 95 % interval in standard deviations of a normal distribution.
Z95: Final = 1.959963984540054
# The Hessian holds where the profile at its ends is within this share of ``Z95``.
OFF: Final = 0.1
# A profile's end is found to this share of the distance to it.
CLOSE: Final = 0.01
_MOST: Final = 12  # evaluations of a profile


@dataclass(frozen=True)
class Intervals:
    """95 % intervals [SI] of the unknowns (k,), where each comes from, and the covariance (k, k) of the unknowns.

    how : "Hessian", or "profile" with the reason.  An end that is a bound of the unknown is named in ``at_bound``.
    """

    low: Array
    high: Array
    how: tuple[str, ...]
    at_bound: tuple[str, ...]
    covariance: Array

    @property
    def correlation(self) -> Array:
        """Correlations of the unknowns (k, k); of one that a bound holds, which has no spread, 0."""
        sd = np.sqrt(np.diag(self.covariance))
        both = np.outer(sd, sd)
        return np.asarray(np.divide(self.covariance, both, out=np.eye(len(sd)), where=both > 0))


def find_intervals(forward: Forward, best: Fit, loss: Loss) -> Intervals:
    """The 95 % intervals of a fit.

    The Hessian is that of Gauss and Newton at the fit.  It misleads where rows are ranges, whose residual is zero
    inside, where a bound holds an unknown, and where the likelihood's profile (the cost with all other unknowns fitted
    again) is not 1.92 above the fit's at the Hessian's ends: then the interval is that of the profile (Venzon &
    Moolgavkar 1988).
    """
    sizes = np.array([unknown.size for unknown in forward.unknowns])
    low, high = (np.array([getattr(unknown, end) for unknown in forward.unknowns]) for end in ("low", "high"))
    residuals = residuals_of(forward, best.evaluation, best.best, best.used)
    weighted = np.sqrt(weights_of(residuals, loss))[:, None] * residuals.jacobian
    ranges = any(reading.range.high > reading.range.low and reading.row in best.used for reading in forward.readings)
    C = covariance_of(information(forward, best.evaluation, best.used) if ranges else weighted, sizes)
    sd = np.sqrt(np.diag(C))
    ends, how, at_bound = np.empty((len(sizes), 2)), [], []
    for k in range(len(sizes)):
        near = 1e-6 * (high[k] - low[k])
        reason = "ranges" if ranges else ""
        if not low[k] + near < best.best[k] < high[k] - near:
            reason = "at a bound"
        profile = Profile(forward, best, loss, C, k)
        first = [profile.at(side * Z95 * sd[k]) for side in (-1, 1)]
        if not reason and not all(abs(s - Z95) <= OFF * Z95 for s in first):
            reason = "asymmetric" if min(first) < Z95 < max(first) else "not quadratic"
        for i, side in enumerate((-1, 1)):
            bound = (low, high)[i][k]
            by_hessian = np.clip(best.best[k] + side * Z95 * sd[k], low[k], high[k])
            ends[k, i] = profile.end(side, first[i]) if reason else by_hessian
            if abs(ends[k, i] - bound) <= near:
                at_bound.append(forward.names[k])
        how.append(f"profile ({reason})" if reason else "Hessian")
    # The covariance of predictions keeps the correlations and has the widths of the intervals.
    width = np.where([h == "Hessian" for h in how], sd, (ends[:, 1] - ends[:, 0]) / (2 * Z95))
    return Intervals(ends[:, 0], ends[:, 1], tuple(how), tuple(at_bound), C * np.outer(width / sd, width / sd))


class Profile:
    """The likelihood along one unknown, with all others fitted again: √(2 Δcost), which a quadratic has linear."""

    def __init__(self, forward: Forward, best: Fit, loss: Loss, covariance: Array, k: int) -> None:
        self.forward, self.best, self.loss, self.k = forward, best, loss, k
        self.along, self.sd = covariance[:, k] / covariance[k, k], float(np.sqrt(covariance[k, k]))
        self.low, self.high = (np.array([getattr(u, end) for u in forward.unknowns]) for end in ("low", "high"))

    def at(self, offset: float) -> float:
        """√(2 Δcost) at a distance from the fit's value [SI], which is cut at the bound."""
        best, k = self.best.best, self.k
        value = float(np.clip(best[k] + offset, self.low[k], self.high[k]))
        # A quadratic cost has its least others on this line.
        first = np.clip(best + (value - best[k]) * self.along, self.low, self.high)
        cost, gain = self._near(first)
        if gain <= CLOSE * Z95**2:
            return float(np.sqrt(2 * max(cost - gain - self.best.cost, 0.0)))
        found = fit(self.forward, self.best.used, self.loss, 1, fixed={k: value}, first=first)
        return float(np.sqrt(2 * max(found.cost - self.best.cost, 0.0)))

    def _near(self, values: Array) -> tuple[float, float]:
        """Cost at values, and what one step of Gauss and Newton in the other unknowns would take from it."""
        evaluation = self.forward.evaluate(values)
        if any(row in evaluation.reasons for row in self.best.used):
            return np.inf, np.inf
        residuals = residuals_of(self.forward, evaluation, values, self.best.used)
        root = np.sqrt(weights_of(residuals, self.loss))
        J, r = root[:, None] * np.delete(residuals.jacobian, self.k, axis=1), root * residuals.value
        if not J.shape[1]:
            return cost_of(residuals, self.loss), 0.0
        step, *_ = np.linalg.lstsq(J, -r, rcond=None)
        left = r + J @ step
        return cost_of(residuals, self.loss), 0.5 * float(r @ r - left @ left)

    def end(self, side: int, first: float) -> float:
        """The value on a side where the profile is ``Z95``, by false position; the bound where it stays below.

        first : the profile at the Hessian's end.
        """
        value = float(self.best.best[self.k])
        reach = self.high[self.k] - value if side > 0 else value - self.low[self.k]
        offset, height = min(Z95 * self.sd, reach), first
        inner, outer = (0.0, 0.0), (np.inf, np.inf)  # distance from the fit and profile, on both sides of the end
        for _ in range(_MOST):
            if height < Z95:
                inner = offset, height
            else:
                outer = offset, height
            found = np.isfinite(outer[0]) and outer[0] - inner[0] <= CLOSE * outer[0]
            if found or abs(height - Z95) <= CLOSE * Z95 or inner[0] >= reach:
                break
            if np.isinf(outer[0]):
                offset = min(2 * offset, reach)
            else:
                share = (Z95 - inner[1]) / (outer[1] - inner[1])
                offset = inner[0] + float(np.clip(share, 0.1, 0.9)) * (outer[0] - inner[0])
            height = self.at(side * offset)
        return float(value + side * offset)


def leave_one_out(forward: Forward, best: Fit, loss: Loss) -> pd.DataFrame:
    """A row for each measured load of each used row: the fit without that row, and what it predicts for it.

    Columns: id, load, low, high, predicted (SI), off : distance from the range over the noise, 0 inside; and the value
    of each unknown without the row.
    """
    table = []
    for row in best.used:
        without = [other for other in best.used if other != row]
        found = fit(forward, without, loss, 1, first=best.best)
        for i, reading in enumerate(forward.readings):
            low, high = reading.range.low, reading.range.high
            if reading.row != row or np.isnan(low):
                continue
            value = found.evaluation.value[i]
            off = (np.maximum(value - high, 0.0) + np.minimum(value - low, 0.0)) / reading.noise
            values = dict(zip(forward.names, found.best.tolist(), strict=True))
            table.append(
                {"id": forward.rows[row].id, "load": reading.load, "low": low, "high": high, "predicted": value,
                 "off": off, **values}
            )  # fmt: skip
    return pd.DataFrame(table)
