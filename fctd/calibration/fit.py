"""The fit of the unknowns: least squares over the readings, with bounds, priors, ranges and a robust loss."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.calibration.forward import Evaluation, Forward

Loss = Literal["soft_l1", "linear"]
LOSSES: Final = get_args(Loss)

# Standard deviations beyond which the loss of a residual grows as its size, not its square.
SOFT: Final = 3.0
# Residual of a reading whose string has no loads at a trial: far beyond all others, so that the step is taken back.
_NO_LOADS: Final = 1e3
# Half-width of the starts about the first one, in typical sizes: beyond it strings lock up, which is slow to compute.
SPREAD: Final = 1.5
# Tolerance of the values, in their typical size: of a start, and of the best one's end.  The cost's is its square.
ROUGH: Final = 1e-2
FINE: Final = 1e-4
# Rounds of a fit whose left-out rows are solved at its end.
_ROUNDS: Final = 3


@dataclass(frozen=True)
class Residuals:
    """Differences of readings from recorded ranges over their noise, weighted, and those of the priors (n,).

    jacobian (n, k); rows (n,) : index of the row, −1 for a prior.
    """

    value: Array
    jacobian: Array
    rows: NDArray[np.int64]


@dataclass(frozen=True)
class Fit:
    """The best values (k,) of the unknowns [SI], their cost, and the rows that were fitted.

    cost : half the sum of the loss; left_out : reasons of the rows without loads, by index; costs : of every start.
    """

    best: Array
    cost: float
    used: tuple[int, ...]
    left_out: dict[int, str]
    evaluation: Evaluation
    costs: tuple[float, ...]


def residuals_of(forward: Forward, evaluation: Evaluation, values: Array, used: Collection[int]) -> Residuals:
    """The residuals of the used rows and of the priors; zero within a range, and ``_NO_LOADS`` without loads."""
    found, slopes, rows = [], [], []
    for i, reading in enumerate(forward.readings):
        low, high = reading.range.low, reading.range.high
        if reading.row not in used or np.isnan(low):
            continue
        scale = np.sqrt(forward.rows[reading.row].weight) / reading.noise
        value = evaluation.value[i]
        off = max(value - high, 0.0) + min(value - low, 0.0)
        found.append(_NO_LOADS if np.isnan(value) else scale * off)
        # Within a range nothing changes the residual, nor where there are no loads.
        slopes.append(scale * evaluation.slopes[i] if off or low == high else np.zeros(len(values)))
        rows.append(reading.row)
    for k, unknown in enumerate(forward.unknowns):
        if unknown.prior is not None:
            found.append((values[k] - unknown.prior.mean) / unknown.prior.sd)
            slopes.append(np.eye(len(values))[k] / unknown.prior.sd)
            rows.append(-1)
    return Residuals(
        np.array(found), np.nan_to_num(np.array(slopes)).reshape(-1, len(values)), np.array(rows, np.int64)
    )


def fit(
    forward: Forward, used: Collection[int], loss: Loss = "soft_l1", starts: int = 4, seed: int = 0,
    fixed: dict[int, float] | None = None, first: Array | None = None,
) -> Fit:  # fmt: skip
    """The fit of the used rows from several starts: the first values of the unknowns, and seeded ones about them.

    fixed : values of unknowns by index that are not fitted; first : the first start (k,), in place of the unknowns'.
    """
    first = np.array([unknown.start for unknown in forward.unknowns]) if first is None else first
    if starts == 1:
        return _fit_from(forward, first, used, loss, fixed or {}, FINE)
    begun = [
        _fit_from(forward, start, used, loss, fixed or {}, ROUGH) for start in _starts(forward, first, starts, seed)
    ]
    best = min(begun, key=lambda one: (-len(one.used), one.cost))
    costs = tuple(one.cost for one in begun)
    return replace(_fit_from(forward, best.best, used, loss, fixed or {}, FINE), costs=costs)


def _starts(forward: Forward, first: Array, count: int, seed: int) -> list[Array]:
    """The first start and a Latin hypercube about it, or within two standard deviations of a prior."""
    from scipy.stats import qmc  # slow to import, and not needed by other commands

    around = [
        (u.prior.mean, 2 * u.prior.sd) if u.prior is not None else (start, SPREAD * u.size)
        for u, start in zip(forward.unknowns, first, strict=True)
    ]
    middle, half = np.array(around).T
    low, high = middle - half, middle + half
    others = qmc.LatinHypercube(len(first), rng=np.random.default_rng(seed)).random(max(count - 1, 0))
    bounds = np.array([(u.low, u.high) for u in forward.unknowns]).T
    return [first, *(np.clip(low + share * (high - low), *bounds) for share in others)]


def _fit_from(
    forward: Forward, start: Array, used: Collection[int], loss: Loss, fixed: dict[int, float], tolerance: float
) -> Fit:
    """The fit from one start: rows without loads there are left out, and taken in where the end has their loads."""
    values = start.copy()
    for k, value in fixed.items():
        values[k] = value
    within = sorted(used)
    for _ in range(_ROUNDS):
        reasons = forward.evaluate(values).reasons
        solved = [row for row in within if row not in reasons]
        values, cost = _minimise(forward, values, solved, loss, fixed, tolerance)
        evaluation = forward.evaluate(values)
        if not any(row not in evaluation.reasons for row in within if row not in solved):
            break
    solved = [row for row in solved if row not in evaluation.reasons]
    left_out = {row: evaluation.reasons.get(row, "no loads at a start") for row in within if row not in solved}
    return Fit(values, cost, tuple(solved), left_out, evaluation, (cost,))


def _minimise(
    forward: Forward, start: Array, used: Sequence[int], loss: Loss, fixed: dict[int, float], tolerance: float
) -> tuple[Array, float]:
    """Values and cost of the local minimum, by the trust region of Branch, Coleman & Li (1999)."""
    free = [k for k in range(len(start)) if k not in fixed]
    scale = np.array([forward.unknowns[k].size for k in free])
    low, high = (np.array([getattr(forward.unknowns[k], end) for k in free]) / scale for end in ("low", "high"))

    def at(x: Array) -> Residuals:
        values = start.copy()
        values[free] = x * scale
        return residuals_of(forward, forward.evaluate(values), values, used)

    def residuals(x: Array) -> Array:
        return at(x).value

    def slopes(x: Array) -> Array:
        return np.asarray(at(x).jacobian[:, free] * scale)

    rows = at(start[free] / scale).rows
    robust: Any = "linear" if loss == "linear" else partial(_robust, measured=rows >= 0)
    if not free or not len(rows):
        return start, cost_of(at(start[free] / scale), loss)
    from scipy.optimize import least_squares  # as above

    # Not at a bound, from which the method cannot start.
    margin = 1e-9 * (high - low)
    found: Any = least_squares(
        residuals, np.clip(start[free] / scale, low + margin, high - margin), slopes, bounds=(low, high), loss=robust,
        xtol=tolerance, ftol=tolerance**2, gtol=1e-10, max_nfev=60,
    )  # fmt: skip
    values = start.copy()
    x = np.where(found.x - low <= 2 * margin, low, np.where(high - found.x <= 2 * margin, high, found.x))
    values[free] = np.where(np.abs(x) < 1e-9, 0.0, x) * scale  # no remainder of 1e-20 in place of 0
    return values, float(found.cost)


def _robust(squares: Array, measured: NDArray[np.bool_]) -> Array:
    """The loss of squared residuals with its two derivatives (3, n): soft l1 of readings, squares of priors."""
    root = np.sqrt(1 + squares / SOFT**2)
    rho = np.array([squares, np.ones_like(squares), np.zeros_like(squares)])
    rho[:, measured] = np.array([2 * SOFT**2 * (root - 1), 1 / root, -0.5 / (SOFT**2 * root**3)])[:, measured]
    return rho


def weights_of(residuals: Residuals, loss: Loss) -> Array:
    """What the loss makes of the square of each residual: its derivative (n,)."""
    squares = residuals.value**2
    return np.ones(len(squares)) if loss == "linear" else _robust(squares, residuals.rows >= 0)[1]


def cost_of(residuals: Residuals, loss: Loss) -> float:
    """Half the sum of the loss."""
    squares = residuals.value**2
    return float(0.5 * (squares if loss == "linear" else _robust(squares, residuals.rows >= 0)[0]).sum())
