"""Rows of a chart that are kept while it is computed, in its folder: numbered chunks of the rows of whole depths."""

import json
import time
from collections.abc import Callable, Mapping
from typing import Any

from fctd.results.run_folder import REPORTED_EVERY, SHARE, Progress, RunFolder, cannot_keep, numbered
from fctd.steady.torque_drag import Row

ROWS = "rows.json"
Description = tuple[Mapping[str, Any], Mapping[str, bytes]]


class KeptRows:
    """The rows of a chart's depths, in their order.

    every : time between two chunks [s], longer where one takes long; describe : gives the description of the chart,
    which is written with the first chunk, since most charts end before.  known : rows of the depths that an earlier
    process has computed.
    """

    def __init__(
        self, folder: RunFolder, every: float, describe: Callable[[], Description] | None = None, key: str = ""
    ) -> None:
        self.folder, self.every, self.key, self._describe = folder, every, key, describe
        self.known: list[list[Row]] = []
        for number, name in numbered(folder.path, ROWS).items():
            if number != self._number + 1:
                break
            try:
                self.known += json.loads((folder.path / name).read_bytes())
            except (OSError, ValueError):  # it is computed again, and all that follows
                break
            self._number = number
        self.kept = sum(map(len, self.known))
        self._new: list[list[Row]] = []
        self._cost = 0.0
        self._began = self._last = self._reported = time.monotonic()

    _number = 0  # of the last chunk

    def keep(self, rows: list[Row], total: int) -> None:
        """Keep the rows of a depth, and write them where it is time to; total : rows of the chart."""
        self._new.append(rows)
        now = time.monotonic()
        if now - self._last >= max(self.every, self._cost / SHARE):
            self.write(total)
        elif self._number and now - self._reported >= REPORTED_EVERY:
            self._report(total)

    def write(self, total: int) -> None:
        """Write the rows since the last chunk, if any; InputError where they cannot be written."""
        if not self._new:
            return
        try:
            if self._describe is not None and not self._number:
                self.folder.describe(*self._describe())
            began = time.monotonic()
            self.folder.write(f"{self._number + 1}-{ROWS}", json.dumps(self._new).encode())
        except OSError as error:
            raise cannot_keep(error, self.folder, self.key, f"{self.kept} rows" if self.kept else "") from error
        self._number += 1
        self.kept += sum(map(len, self._new))
        self._new = []
        self._report(total)
        self._last = time.monotonic()
        self._cost = self._last - began

    def _report(self, total: int) -> None:
        self._reported = time.monotonic()
        done = self.kept + sum(map(len, self._new))
        self.folder.report(Progress(done, total, "rows", self.kept, self._reported - self._began, time.time()))
