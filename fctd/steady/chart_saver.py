"""Rows of a chart that are kept while it is computed, in its folder: chunks of the rows of whole depths."""

import json
from collections.abc import Callable, Mapping
from typing import Any

from fctd.case.message import SENTENCES, kept, restored
from fctd.steady.carried_shape import Carried
from fctd.steady.torque_drag import Row
from fctd.store import log
from fctd.store.run_folder import RunFolder
from fctd.store.saver import Saver

ROWS, SHAPES = "rows.json", "shapes.json"
Description = tuple[Mapping[str, Any], Mapping[str, bytes]]


class ChartSaver(Saver):
    """The rows of a chart's depths, in their order; see ``Saver``.

    describe : gives the description of the chart, which is written with the first chunk, since most charts end before.
    known : rows of the depths that an earlier process has computed; above : see ``chart_rows``.
    """

    def __init__(
        self, folder: RunFolder, every: float, describe: Callable[[], Description] | None = None, key: str = ""
    ) -> None:
        super().__init__(folder, every, "rows", key)
        self._describe = describe
        self.known: list[list[Row]] = []
        self.above: dict[str, Carried] = {}
        self._new: list[list[Row]] = []
        try:
            while True:
                parts = log.read(self.chunks.path(self.number + 1))
                shapes = json.loads(parts[SHAPES])
                self.known += [[_with(restored, row) for row in rows] for rows in json.loads(parts[ROWS])]
                self.above = {loads: Carried.restore(facts) for loads, facts in shapes.items()}
                self.number += 1
        except (OSError, ValueError, KeyError, TypeError):
            # What follows a chunk that cannot be read is computed again, in other chunks.
            self.chunks.drop_after(self.number)
        self.kept = sum(map(len, self.known))

    def keep(self, rows: list[Row], total: int) -> None:
        """Keep the rows of a depth, and write them where it is time to; total : rows of the chart."""
        self._new.append(rows)
        if self.interval.due():
            self.write_new(total)
        elif self.number:
            self.report(self._done, total)

    def write_new(self, total: int) -> None:
        """Write the rows since the last chunk, if any; InputError where they cannot be written."""
        if self._new:
            self.write(self._done, self._chunk)
            self._new = []
            self.report(self.kept, total, now=True)

    @property
    def _done(self) -> float:
        return self.kept + sum(map(len, self._new))

    def _chunk(self) -> dict[str, bytes]:
        if self._describe is not None and not self.number:
            self.folder.describe(*self._describe())
        shapes = {loads: carried.facts() for loads, carried in self.above.items()}
        rows = [[_with(kept, row) for row in at_depth] for at_depth in self._new]
        return {ROWS: json.dumps(rows).encode(), SHAPES: json.dumps(shapes).encode()}


def _with(change: Callable[[Any], Any], row: Row) -> Row:
    """A row whose sentences are changed."""
    return row | {name: change(row[name]) for name in SENTENCES if name in row}
