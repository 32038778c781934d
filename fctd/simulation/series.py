"""Loads of every segment over the time of a run, in bounded memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]

# Rows kept of all records, a few megabytes; a picture shows no more.
MOST_ROWS = 300_000
COLUMNS = ("time_s", "bit_depth_m", "md_m", "effective_tension_N", "torque_N_m", "contact_force_N")


class SegmentSeries:
    """Rows of the segments at the records of a run; when they become too many, every second record is dropped.

    most_rows : kept at any time, but for the last two records.  every : of so many records one is kept; seen : records
    so far.
    """

    def __init__(self, most_rows: int = MOST_ROWS) -> None:
        self._most, self.every, self.seen = most_rows, 1, 0
        self._kept: list[Array] = []

    def add(self, time: float, bit_depth: float, md: Array, tension: Array, torque: Array, normal: Array) -> None:
        """Add a record: time [s] and bit depth [m]; of the contact points (n,) md [m], loads [N, N m] and force [N]."""
        if self.seen % self.every == 0:
            rows = np.stack([np.full_like(md, time), np.full_like(md, bit_depth), md, tension, torque, normal], axis=1)
            self._kept.append(rows)
        self.seen += 1
        while len(self._kept) > 2 and sum(map(len, self._kept)) > self._most:
            self._kept = self._kept[::2]
            self.every *= 2

    def since(self, first: int) -> list[tuple[int, Array]]:
        """The kept records from the number ``first`` on, each with its number: multiples of ``every``."""
        return [(k * self.every, rows) for k, rows in enumerate(self._kept) if k * self.every >= first]

    def put_back(self, number: int, rows: Array) -> None:
        """Add a record that ``since`` returned, in its order; one that would have been dropped since is left out."""
        if number % self.every == 0:
            self._kept.append(rows)

    def table(self) -> pd.DataFrame:
        """A row for every segment at every kept record."""
        import pandas as pd

        rows = np.concatenate(self._kept) if self._kept else np.empty((0, len(COLUMNS)))
        return pd.DataFrame(rows, columns=list(COLUMNS))
