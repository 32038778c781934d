"""Rows of a chart that are kept while it is computed, in its folder: numbered chunks of the rows of whole depths."""

import json
import time
import zlib
from collections.abc import Callable, Mapping
from typing import Any

from fctd.steady.torque_drag import Row
from fctd.store.run_folder import REPORTED_EVERY, Progress, RunFolder, cannot_keep, numbered
from fctd.store.save_interval import SaveInterval

ROWS = "rows.jsonl"
Description = tuple[Mapping[str, Any], Mapping[str, bytes]]


class KeptRows:
    """The rows of a chart's depths, in their order.

    every : time between two chunks [s], longer where they take long; describe : gives the description of the chart,
    which is written with the first chunk, since most charts end before.  known : rows of the depths that an earlier
    process has computed.
    """

    def __init__(
        self, folder: RunFolder, every: float, describe: Callable[[], Description] | None = None, key: str = ""
    ) -> None:
        self.folder, self.key, self._describe = folder, key, describe
        self.known: list[list[Row]] = []
        chunks = numbered(folder.path, ROWS)
        while (following := self._number + 1) in chunks:
            try:
                self.known += _unpacked((folder.path / chunks[following]).read_bytes())
            except (OSError, ValueError):
                break
            self._number = following
        # What follows a chunk that cannot be read is computed again, in other chunks.
        folder.remove({name for number, name in chunks.items() if number > self._number})
        self.kept = sum(map(len, self.known))
        self._new: list[list[Row]] = []
        self._pace, self._reported = SaveInterval(every), time.monotonic()

    _number = 0  # of the last chunk

    def keep(self, rows: list[Row], total: int) -> None:
        """Keep the rows of a depth, and write them where it is time to; total : rows of the chart."""
        self._new.append(rows)
        if self._pace.due():
            self.write(total)
        elif self._number and time.monotonic() - self._reported >= REPORTED_EVERY:
            self._report(total)

    def write(self, total: int) -> None:
        """Write the rows since the last chunk, if any; InputError where they cannot be written."""
        if not self._new:
            return
        try:
            with self._pace.keeping():
                if self._describe is not None and not self._number:
                    self.folder.describe(*self._describe())
                self.folder.write(f"{self._number + 1}-{ROWS}", _packed(self._new))
        except OSError as error:
            raise cannot_keep(error, self.folder, self.key, f"{self.kept} rows" if self.kept else "") from error
        self._number += 1
        self.kept += sum(map(len, self._new))
        self._new = []
        self._report(total)

    def _report(self, total: int) -> None:
        self._reported = time.monotonic()
        done = self.kept + sum(map(len, self._new))
        with self._pace.reporting():
            self.folder.report(Progress(done, total, "rows", self.kept, self._pace.took, time.time()))


def _packed(rows: list[list[Row]]) -> bytes:
    """The rows of depths as a line of JSON, after a line with its checksum."""
    content = json.dumps(rows).encode()
    return b"%d\n" % zlib.crc32(content) + content


def _unpacked(chunk: bytes) -> list[list[Row]]:
    """The rows that were packed; ValueError for a damaged chunk."""
    checksum, _, content = chunk.partition(b"\n")
    if int(checksum) != zlib.crc32(content):
        raise ValueError("a chunk of its rows is damaged")
    rows: list[list[Row]] = json.loads(content)
    return rows
