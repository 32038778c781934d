"""Loads of every segment over the time of a run, in bounded memory."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fctd.model.wellbore import Wellbore, hole_frame
from fctd.results.buckling import MODES

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]

# Rows kept of all records, some 25 megabytes; pictures and pages show no more.
MOST_ROWS = 200_000
LOADS = ("effective_tension_N", "torque_N_m", "contact_force_N", "bending_moment_N_m", "von_mises_Pa")
LIMITS = ("sinusoidal_limit_N", "helical_limit_N")
COLUMNS = ("time_s", "bit_depth_m", "md_m", *LOADS, "clearance_m", *LIMITS)


class SegmentSeries:
    """Rows of the segments at the records of a run; when they become too many, every second record is dropped.

    most_rows : kept at any time, but for the last two records.
    """

    def __init__(self, most_rows: int = MOST_ROWS) -> None:
        self._most, self._every, self._seen = most_rows, 1, 0
        self._kept: list[Array] = []

    @property
    def wants_next(self) -> bool:
        """Whether the next record is kept, and needs its rows."""
        return self._seen % self._every == 0

    def skip(self) -> None:
        """Count a record that is not kept."""
        self._seen += 1

    def add(
        self, time: float, bit_depth: float, md: Array, loads: Sequence[Array], clearance: Array, limits: Array,
        mode: Array, offset: Array,
    ) -> None:  # fmt: skip
        """Add a record: time [s] and bit depth [m]; and of the n contact points, each (n,), what follows.

        md [m]; loads : of ``LOADS``; clearance [m]; limits (n, 2) : of buckling [N], NaN where nothing is compressed;
        mode : of buckling; offset (n, 3) : from the axis of the hole [m].
        """
        columns = [np.full_like(md, time), np.full_like(md, bit_depth), md, *loads, clearance, *limits.T, mode]
        self._kept.append(np.column_stack([*columns, offset]))
        self._seen += 1
        while len(self._kept) > 2 and sum(map(len, self._kept)) > self._most:
            self._kept = self._kept[::2]
            self._every *= 2

    def table(self, hole: Wellbore) -> pd.DataFrame:
        """A row for every segment at every kept record: ``COLUMNS``, offsets to high side and right, buckling."""
        import pandas as pd

        wide = len(COLUMNS) + 4
        rows = np.concatenate(self._kept) if self._kept else np.empty((0, wide))
        table = pd.DataFrame(rows[:, : len(COLUMNS)], columns=list(COLUMNS))
        if len(table):
            offset = rows[:, -3:]
            for name, side in zip(("high", "right"), hole_frame(hole.at(rows[:, 2])[1]), strict=True):
                table[f"offset_{name}_m"] = (offset * side).sum(axis=1)
            table["buckling"] = MODES[rows[:, len(COLUMNS)].astype(int)]
        return table
