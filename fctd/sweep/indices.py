"""Which parameter matters: Sobol's indices and Morris's effects of their designs, else a regression on the samples.

Samples without an answer leave their block of a design: one of Saltelli's, or one trajectory of Morris's.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.sweep.design import LEVELS, problem_of, unit_cube
from fctd.sweep.spec import SweepSpec

if TYPE_CHECKING:
    import pandas as pd


# Resamples of the error bars, of 95 %.
RESAMPLES: Final = 200
# Samples that an index needs for each parameter.
FEWEST: Final = 4
# Measures in the unit of the result; the others are shares or coefficients.
WITH_UNIT: Final = ("mu_star", "sigma")


class Index(NamedTuple):
    """A measure of a parameter's influence: value and half the width of its error bar of 95 %."""

    parameter: str
    measure: str
    value: float
    error: float


def indices_of(spec: SweepSpec, samples: pd.DataFrame, values: pd.Series[float]) -> list[Index]:
    """The influence of every parameter on a result.

    samples : of the sweep; values : of the result, by the number of the sample, NaN or absent where there is none.
    Measures: of ``saltelli`` the first-order index S1 and the total index ST, of ``morris`` the mean absolute effect
    mu_star and the deviation sigma of the effects, in units of the result; else SRC and SRRC, the regression
    coefficients of standardised values and of their ranks, whose squares are shares of the variance where parameters
    are independent and the result linear or monotonic, and R2 and R2_rank, the share that each regression explains.
    Raises InputError where there are too few answers.
    """
    result: Any = values.reindex(samples["sample"]).to_numpy(float)
    if spec.method == "saltelli":
        return _sobol(spec, result)
    if spec.method == "morris":
        return _morris(spec, result)
    return _regression(samples, result)


def _blocks(result: Array, length: int) -> NDArray[np.bool_]:
    """Which samples are in blocks of a design that are answered in full."""
    whole = np.isfinite(result).reshape(-1, length).all(axis=1)
    if whole.sum() < FEWEST:
        raise InputError(
            f"at least {FEWEST} blocks of {length} samples that all have answers", key="samples", value=f"{whole.sum()}"
        )
    return np.repeat(whole, length)


def _sobol(spec: SweepSpec, result: Array) -> list[Index]:
    from SALib.analyze import sobol

    kept = result[_blocks(result, len(spec.parameters) + 2)]
    found = sobol.analyze(
        problem_of(spec), kept, calc_second_order=False, num_resamples=RESAMPLES, seed=spec.seed
    )  # fmt: skip
    return _listed(found, found["names"] if "names" in found else _names(spec), {"S1": "S1_conf", "ST": "ST_conf"})


def _morris(spec: SweepSpec, result: Array) -> list[Index]:
    from SALib.analyze import morris

    kept = _blocks(result, len(spec.parameters) + 1)
    levels = (unit_cube(spec) * LEVELS - 0.5) / (LEVELS - 1)  # as SALib drew them
    found = morris.analyze(
        problem_of(spec), levels[kept], result[kept], num_resamples=RESAMPLES, num_levels=LEVELS, seed=spec.seed
    )
    return _listed(found, _names(spec), {"mu_star": "mu_star_conf", "sigma": ""})


def _names(spec: SweepSpec) -> list[str]:
    return [parameter.key for parameter in spec.parameters]


def _listed(found: Any, names: Sequence[str], measures: dict[str, str]) -> list[Index]:
    return [
        Index(name, measure, float(found[measure][k]), float(found[error][k]) if error else float("nan"))
        for measure, error in measures.items()
        for k, name in enumerate(names)
    ]


def _regression(samples: pd.DataFrame, result: Array) -> list[Index]:
    """Coefficients of a linear regression; their errors are those of least squares, times 1.96."""
    from scipy import stats

    names = [name for name in samples.columns if name != "sample" and samples[name].dtype.kind in "if"]
    names = [name for name in names if samples[name].max() > samples[name].min()]
    kept = np.isfinite(result)
    if kept.sum() < FEWEST * (len(names) + 1):
        expected = f"at least {FEWEST * (len(names) + 1)} samples with an answer, for {len(names)} parameters"
        raise InputError(expected, key="samples", value=int(kept.sum()))
    X, y = samples.loc[kept, names].to_numpy(float), result[kept]
    indices = []
    for measure, share, of in (("SRC", "R2", lambda a: a), ("SRRC", "R2_rank", lambda a: stats.rankdata(a, axis=0))):
        slopes, errors, explained = _least_squares(of(X), of(y))
        indices += [Index(*row) for row in zip(names, [measure] * len(names), slopes, errors, strict=True)]
        indices.append(Index("", share, explained, float("nan")))
    return indices


def _least_squares(X: Array, y: Array) -> tuple[list[float], list[float], float]:
    """Standardised coefficients, 1.96 of their standard errors, and the share of the variance that is explained."""
    A, b = (X - X.mean(axis=0)) / X.std(axis=0), (y - y.mean()) / y.std()
    inverse = np.linalg.pinv(A.T @ A)
    slopes = inverse @ A.T @ b
    rest = b - A @ slopes
    freedom = max(len(b) - len(slopes) - 1, 1)
    errors = 1.96 * np.sqrt(np.diag(inverse) * (rest @ rest) / freedom)
    return slopes.tolist(), errors.tolist(), float(1 - (rest @ rest) / (b @ b))
