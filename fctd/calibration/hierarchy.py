"""Readings that are linear in the unknowns and in random effects of their day: everything but the deviations exact.

y = J x + U u_d + e, with e of known variance, a normal prior of x, and effects u_d of each day that are normal about 0
with the standard deviations s.  Given s, all is normal: the evidence p(y | s), and mean and covariance of x, follow in
closed form (Lindley & Smith 1972).  Only sums over the readings of a day enter, so that a day costs the same however
many readings it has.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Linear:
    """A linear model of n readings, k unknowns, e effects and days numbered from 0.

    value (n,) : the readings; jacobian (n, k) and effects (n, e) : their derivatives; variance (n,) of their noise;
    day (n,) : number of the day of each.  prior_mean (k,), prior_precision (k,) : of the unknowns, 0 for none.
    """

    value: Array
    jacobian: Array
    effects: Array
    variance: Array
    day: NDArray[np.int64]
    prior_mean: Array
    prior_precision: Array

    def without(self, day: int) -> "Linear":
        """The model without the readings of a day, whose number stays."""
        kept = self.day != day
        return replace(
            self, value=self.value[kept], jacobian=self.jacobian[kept], effects=self.effects[kept],
            variance=self.variance[kept], day=self.day[kept],
        )  # fmt: skip


class Conditional(NamedTuple):
    """What m sets of deviations give: log of the evidence (m,), mean (m, k) and covariance (m, k, k) of the unknowns.

    effects (m, days, e) : mean of the effects of each day.
    """

    log_evidence: Array
    mean: Array
    covariance: Array
    effects: Array


def condition(model: Linear, deviations: Array, unknowns: Array | None = None) -> Conditional:
    """The normal distributions for sets of standard deviations (m, e) of the effects.

    unknowns (k,) : at which the effects are given, in place of their mean.

    Raises numpy.linalg.LinAlgError where readings and priors do not determine the unknowns.
    """
    J, U, scale = model.jacobian, model.effects, 1 / model.variance
    count, e = int(model.day.max(initial=-1)) + 1, U.shape[1]
    of_day = np.equal.outer(np.arange(count), model.day).astype(float)
    G = np.einsum("dn,ni,nj->dij", of_day, U * scale[:, None], U)
    C = np.einsum("dn,ni,nk->dik", of_day, U * scale[:, None], J)
    q = of_day @ (U * (scale * model.value)[:, None])
    precision = np.diag(model.prior_precision) + J.T @ (scale[:, None] * J)
    pull = model.prior_precision * model.prior_mean + J.T @ (scale * model.value)
    square = model.value @ (scale * model.value) + model.prior_mean**2 @ model.prior_precision
    # The effects taken out of each day: X = S (1 + S G S)^-1 S, which is 0 where all deviations are.
    S = deviations[:, None, :, None] * np.eye(e)
    M = np.eye(e) + S @ G @ S
    X = S @ np.linalg.solve(M, np.broadcast_to(S, M.shape))
    H = precision - np.einsum("dik,mdij,djl->mkl", C, X, C, optimize=True)
    h = pull - np.einsum("dik,mdij,dj->mk", C, X, q, optimize=True)
    factor = np.linalg.cholesky(H)  # raises where H is not positive definite
    covariance = np.linalg.inv(H)
    mean = np.einsum("mkl,ml->mk", covariance, h)
    square = square - np.einsum("di,mdij,dj->m", q, X, q, optimize=True) - np.einsum("mk,mk->m", h, mean)
    held = model.prior_precision[model.prior_precision > 0]
    logs = np.log(2 * np.pi * model.variance).sum() - np.log(held).sum()
    logs = logs + np.linalg.slogdet(M)[1].sum(axis=1) + 2 * np.log(np.diagonal(factor, axis1=1, axis2=2)).sum(axis=1)
    at = mean if unknowns is None else np.broadcast_to(unknowns, mean.shape)
    effects = np.einsum("mdij,mdj->mdi", X, q - np.einsum("dik,mk->mdi", C, at))
    return Conditional(-0.5 * (logs + square), mean, covariance, effects)
