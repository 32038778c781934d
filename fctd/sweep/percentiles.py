"""Percentiles of the results over depth, with the error bars that the number of samples leaves.

An error bar is an interval of 95 % from order statistics: the number of samples below the true percentile is binomial,
whatever the distribution.  It is that of random samples; those of Latin hypercubes and of Sobol's and Halton's points
spread more evenly, so that their errors are smaller.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError, nearest

if TYPE_CHECKING:
    import pandas as pd


CONFIDENCE: Final = 0.95
# Shares of the samples with which the convergence of a percentile is shown.
SHARES: Final = (0.125, 0.25, 0.5, 1.0)
# Columns without which a load is no load of any kind of work, in the order in which they are looked for.
DEFAULTS: Final = (
    "hookload_N", "surface_torque_N_m", "hookload_mean_N", "surface_torque_mean_N_m", "stick_slip_severity", "segments",
)  # fmt: skip


def places_of(rows: pd.DataFrame) -> list[str]:
    """Columns whose values say what a row is of: operation, and bit depth where a sample has several or one of all."""
    return [name for name in ("operation", "bit_depth_m") if name in rows]


def columns_of(rows: pd.DataFrame, wanted: Sequence[str], key: str = "uncertainty.columns") -> list[str]:
    """The columns to tell of: those that are wanted, else those of hook load and torque.

    Raises InputError, which names the key, for one that the results do not have, or that has no numbers.
    """
    numbers = [name for name in rows.columns if rows[name].dtype.kind in "if" and name != "sample"]
    for name in wanted:
        if name not in numbers:
            raise InputError(nearest(name, numbers, "column"), key=key, value=name)
    return list(wanted) or [name for name in DEFAULTS if name in numbers]


def quantile(values: Array, share: float) -> tuple[float, float, float]:
    """A quantile of values (n,), and the ends of its error bar; an end that lies beyond the samples is NaN."""
    from scipy import stats

    if not len(values):
        return float("nan"), float("nan"), float("nan")
    bar: Any = stats.quantile_test(values, p=share).confidence_interval(CONFIDENCE)
    return float(np.quantile(values, share)), float(bar.low), float(bar.high)


def percentile_table(rows: pd.DataFrame, columns: Sequence[str], percentiles: Sequence[float]) -> pd.DataFrame:
    """A row for every place, column and percentile.

    Columns: operation, bit_depth_m, column, percentile, value, low and high (the error bar; NaN where it ends beyond
    the samples), mean, sd, samples (with a value) and without (those of this place that have none).
    """
    import pandas as pd

    found = []
    for place, name, values, without in _groups(rows, columns):
        moments = {"mean": float(values.mean()), "sd": float(values.std(ddof=1))} if len(values) > 1 else {}
        for percentile in percentiles:
            value, low, high = quantile(values, percentile / 100)
            numbers = {"value": value, "low": low, "high": high, "mean": np.nan, "sd": np.nan} | moments
            found.append(
                {
                    **place,
                    "column": name,
                    "percentile": percentile,
                    **numbers,
                    "samples": len(values),
                    "without": without,
                }
            )
    return pd.DataFrame(found)


def convergence_table(rows: pd.DataFrame, columns: Sequence[str], percentiles: Sequence[float]) -> pd.DataFrame:
    """Percentiles at the last depth of every operation by the first eighth, quarter and half of the samples, and all.

    Columns: samples, and those of ``percentile_table`` without its moments.
    """
    import pandas as pd

    last = rows[rows["bit_depth_m"] == rows["bit_depth_m"].max()] if "bit_depth_m" in rows else rows
    found = []
    for place, name, values, _ in _groups(last, columns):
        for count in dict.fromkeys(max(round(share * len(values)), 1) for share in SHARES):
            for percentile in percentiles:
                value, low, high = quantile(values[:count], percentile / 100)
                found.append(
                    {**place, "column": name, "percentile": percentile, "samples": count, "value": value, "low": low,
                     "high": high}
                )  # fmt: skip
    return pd.DataFrame(found)


def _groups(rows: pd.DataFrame, columns: Sequence[str]) -> Iterator[tuple[dict[str, Any], str, Array, int]]:
    """Every place and column with its values, in the order of the samples, and the number of rows without one."""
    places = places_of(rows)
    for key, group in rows.groupby(places, sort=True):
        place = dict(zip(places, key, strict=True))
        for name in columns:
            values = group[name].to_numpy(float)
            kept = values[np.isfinite(values)]
            yield place, name, kept, len(values) - len(kept)
