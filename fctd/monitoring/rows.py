"""Rows of a series in SI units: cells to numbers, rows that cannot be used, and their counts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd.case.errors import InputError, nearest
from fctd.case.operations import KINDS
from fctd.monitoring.quantities import BY_DEPTH, OVER_TIME, QUANTITIES, Column

# Values that stand for none in LAS and WITSML logs.
NULLS: Final = (-999.25, -999.0, -9999.0, -9999.25, -99999.0)
# More than this share of rows that go back in time is a series in another order.
DISORDER: Final = 0.1
FEW: Final = 20  # rows in which disorder is not judged
DATES: Final = "a time such as 2007-10-23 08:07:08 (ISO 8601), or a number with its unit in the header"


def to_si(
    cells: pd.DataFrame, numbers: Sequence[int], columns: Mapping[str, Column], decimal_comma: bool
) -> pd.DataFrame:
    """A table [SI] of text cells, a column for each quantity in the order of ``columns``.

    numbers : of the rows in their file, which become the index.  Empty cells and ``NULLS`` are NaN.  Raises
    InputError, which names row and column, for a cell that is neither a number nor empty.
    """
    table: dict[str, Any] = {}
    for key, column in columns.items():
        texts = cells[column.place].astype("string").str.strip()
        texts = texts.mask(texts == "")
        quantity = QUANTITIES[key]
        if quantity.dimension is None:
            table[quantity.column] = texts.to_numpy(object)
            continue
        if key == "time" and column.unit is None:
            table[quantity.column] = _seconds(texts, numbers, column)
            continue
        if decimal_comma:
            texts = texts.str.replace(",", ".", regex=False)
        values = pd.to_numeric(texts, errors="coerce").to_numpy(float, na_value=np.nan)
        nothing = texts.isna() | texts.str.casefold().isin(["nan", "null", "n/a"])
        _refuse(np.isnan(values) & ~nothing.to_numpy(bool), texts, numbers, column, "a number")
        values[np.isin(values, NULLS) | ~np.isfinite(values)] = np.nan
        table[quantity.column] = values * column.factor(quantity)
    return pd.DataFrame(table, index=pd.Index(numbers, name="row"))


def _seconds(texts: pd.Series[Any], numbers: Sequence[int], column: Column) -> np.ndarray[Any, Any]:
    """Seconds since 1970 of dates."""
    times = pd.to_datetime(texts, errors="coerce", format="ISO8601", utc=True)
    _refuse((times.isna() & texts.notna()).to_numpy(), texts, numbers, column, DATES)
    seconds = times.to_numpy("datetime64[ms]").astype(float) / 1e3
    seconds[times.isna().to_numpy()] = np.nan
    return seconds


def _refuse(
    bad: np.ndarray[Any, Any], texts: pd.Series[Any], numbers: Sequence[int], column: Column, expected: str
) -> None:
    if bad.any():
        first = int(np.flatnonzero(bad)[0])
        more = f" ({int(bad.sum())} such cells)" if bad.sum() > 1 else ""
        raise InputError(f"{expected}{more}", key=f"row {numbers[first]}, {column.header}", value=texts.iloc[first])


class Cleaner:
    """Leaves out rows that cannot be used and counts why; takes a series in one piece or in several.

    counts : rows left out by reason.  rows : rows taken.
    """

    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()
        self.rows = 0
        self._latest = -np.inf

    def take(self, table: pd.DataFrame) -> pd.DataFrame:
        """The rows that can be used.  Raises InputError for an unknown operation and for a series in disorder."""
        over_time = "time_s" in table
        kept = table
        for key in OVER_TIME if over_time else BY_DEPTH:
            column = QUANTITIES[key].column
            if not over_time and key in ("hook_load", "torque"):
                continue  # a row by depth has the reading that its operation needs
            missing = kept[column].isna()
            self.counts[f"no {key.replace('_', ' ')}"] += int(missing.sum())
            kept = kept[~missing]
        if over_time:
            kept = self._in_order(kept)
        else:
            for row, kind in kept["operation"].items():
                if kind not in KINDS:
                    raise InputError(nearest(kind, KINDS, "kind"), key=f"row {row}, operation", value=kind)
        self.counts = +self.counts
        self.rows += len(table)
        return kept

    def _in_order(self, table: pd.DataFrame) -> pd.DataFrame:
        """The rows later than all before them."""
        times = table["time_s"].to_numpy(float)
        latest = np.maximum.accumulate(np.concatenate(([self._latest], times)))[:-1]
        repeated, backward = times == latest, times < latest
        self.counts["repeated time"] += int(repeated.sum())
        self.counts["time before that of an earlier row"] += int(backward.sum())
        read = self.rows + len(table)
        if read >= FEW and self.counts["time before that of an earlier row"] > DISORDER * read:
            first = int(np.flatnonzero(backward)[0])
            raise InputError(
                f"rows in the order of time ({self.counts['time before that of an earlier row']} of {read} rows are "
                "earlier than a row above them)",
                key=f"row {table.index[first]}, time",
                value=f"{times[first]:.0f} s",
            )
        if len(times):
            self._latest = max(self._latest, float(times.max()))
        later: pd.DataFrame = table[~(repeated | backward)]
        return later

    def told(self) -> list[str]:
        """What was left out, a line for each reason."""
        return [f"{count} of {self.rows} rows left out: {reason}" for reason, count in sorted(self.counts.items())]
