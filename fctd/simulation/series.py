"""Loads of every segment over the time of a run, in bounded memory."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fctd.arrays import Array
from fctd.model.frames import hole_frame
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import MODES
from fctd.store.facts import Restorable

if TYPE_CHECKING:
    import pandas as pd


# Rows kept of all records, some 25 megabytes; pictures and pages show no more.
MOST_ROWS = 200_000
LOADS = ("effective_tension_N", "torque_N_m", "contact_force_N", "bending_moment_N_m", "von_mises_Pa")
LIMITS = ("sinusoidal_limit_N", "helical_limit_N")
COLUMNS = ("time_s", "bit_depth_m", "md_m", *LOADS, "clearance_m", *LIMITS)
# Of a record while the run lasts: the mode of buckling as a number, and the offset from the axis of the hole [m].
KEPT = (*COLUMNS, "mode", "offset_x_m", "offset_y_m", "offset_z_m")


class SegmentSeries(Restorable):
    """Rows of the segments at the records of a run; when they become too many, every second record is dropped.

    most_rows : kept at any time, but for the last two records.  every : of so many records one is kept; seen : records
    so far.  A checkpoint keeps both, and chunks the rows.
    """

    FACTS = ("every", "seen")

    def __init__(self, most_rows: int = MOST_ROWS) -> None:
        self._most, self.every, self.seen = most_rows, 1, 0
        self._kept: list[Array] = []

    @property
    def wants_next(self) -> bool:
        """Whether the next record is kept, and needs its rows."""
        return self.seen % self.every == 0

    def skip(self) -> None:
        """Count a record that is not kept."""
        self.seen += 1

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

    def table(self, hole: Wellbore) -> pd.DataFrame:
        """A row for every segment at every kept record: ``COLUMNS``, offsets to high side and right, buckling."""
        import pandas as pd

        rows = np.concatenate(self._kept) if self._kept else np.empty((0, len(KEPT)))
        table = pd.DataFrame(rows[:, : len(COLUMNS)], columns=list(COLUMNS))
        if len(table):
            offset = rows[:, -3:]
            for name, side in zip(("high", "right"), hole_frame(hole.at(rows[:, 2])[1]), strict=True):
                table[f"offset_{name}_m"] = (offset * side).sum(axis=1)
            table["buckling"] = np.array(MODES)[rows[:, len(COLUMNS)].astype(int)]
        return table
