"""Rows of a series in SI units: cells to numbers, rows that cannot be used, and their counts."""

import re
from collections import Counter
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.operation_names import read_kind
from fctd.case.tables.headers import no_unit
from fctd.case.tables.rows import NOTHING, NULLS, Numbers, Rows
from fctd.monitoring.quantities import BY_DEPTH, OVER_TIME, QUANTITIES, SERIES

_DATE: Final = re.compile(r"\d[-/:T]\d")  # or a time of day
_TIME_OF_DAY: Final = re.compile(r"\d{1,2}:\d{2}")
# More than this share of rows that go back in time is a series in another order.
DISORDER: Final = 0.1
FEW: Final = 20  # rows in which disorder is not judged
DATES: Final = (
    "a time such as 2007-10-23 08:07:08 (ISO 8601), with its date here or in a column of dates, or a number with its "
    "unit in the header"
)


class Converter:
    """Rows of cells to a table [SI]; what the first rows tell of times and decimal commas holds for all."""

    def __init__(self) -> None:
        self._numbers = Numbers()
        self._dated: bool | None = None

    def take(self, rows: Rows) -> pd.DataFrame:
        """The table of rows, whose numbers become its index.

        Empty cells and ``NULLS`` are NaN.  Raises InputError, which names row and column, for a cell that is neither
        a number nor empty, and for times that have no unit and are no dates.
        """
        time, times = _times(rows)
        first = next(filter(None, times), None)
        if first is not None and self._dated is None:
            self._dated = _DATE.search(first) is not None
        if first is not None and not self._dated and not rows.columns[time].unit:
            raise no_unit([rows.columns[time]], SERIES)
        keys = {column: time if field.key == "time" else field.key for column, field in QUANTITIES.items()}
        keys = {column: key for column, key in keys.items() if key in rows.columns}
        texts = {"operation", time} if self._dated or first is None else {"operation"}
        numeric = [key for key in keys.values() if key not in texts]
        values = self._numbers.read(rows, numeric, NOTHING)
        values[np.isin(values, NULLS) | ~np.isfinite(values)] = np.nan
        table: dict[str, Any] = {}
        for column, key in keys.items():
            if key in numeric:
                table[column] = values[:, numeric.index(key)] * rows.columns[key].factor
            else:
                table[column] = (
                    _seconds(rows, key, times) if key == time else [cell or None for cell in rows.texts(key)]
                )
        return pd.DataFrame(table, index=pd.Index(rows.numbers, name="row"))


def _times(rows: Rows) -> tuple[str, list[str]]:
    """The key of the column of times, and its texts, those of a day with the date beside them."""
    dates, times = rows.texts("date"), rows.texts("time")
    if "time" not in rows.columns:
        return "date", dates
    if "date" in rows.columns and any(map(_TIME_OF_DAY.match, times)):
        times = [f"{date} {time}" if date and time else "" for date, time in zip(dates, times, strict=True)]
    return "time", times


def _seconds(rows: Rows, key: str, texts: list[str]) -> np.ndarray[Any, Any]:
    """Seconds since 1970 of dates."""
    times = pd.Series(pd.to_datetime(texts, errors="coerce", format="ISO8601", utc=True))
    bad = np.flatnonzero(times.isna() & np.array(list(map(bool, texts))))
    if len(bad):
        more = f" ({len(bad)} such cells)" if len(bad) > 1 else ""
        raise rows.error(int(bad[0]), key, DATES + more)
    seconds = times.to_numpy("datetime64[ms]").astype(float) / 1e3
    seconds[times.isna().to_numpy()] = np.nan
    return seconds


def _kind(row: object, name: object) -> str:
    """The kind of operation of a row."""
    try:
        return read_kind(name)
    except InputError as error:
        raise error.at(f"row {row}, operation") from None


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
        for column, field in QUANTITIES.items():
            key = field.key
            if key not in (OVER_TIME if over_time else BY_DEPTH):
                continue
            if not over_time and key in ("hook_load", "torque"):
                continue  # a row by depth has the reading that its operation needs
            missing = kept[column].isna()
            self.counts[f"no {key.replace('_', ' ')}"] += int(missing.sum())
            kept = kept[~missing]
        if over_time:
            kept = self._in_order(kept)
        else:
            kept = kept.assign(operation=[_kind(row, name) for row, name in kept["operation"].items()])
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
