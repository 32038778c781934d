"""A computation that is saved while it lasts, in its folder: chunks of its results, and how far it is."""

import time
from collections.abc import Callable, Mapping

from fctd.case.errors import InputError
from fctd.store.run_folder import RunFolder, RunProgress, chunks_of
from fctd.store.save_interval import SaveInterval

# Time between two reports of the progress of a run [s].
REPORTED_EVERY = 1.0


class Saver:
    """Saves a computation in a folder.

    every : time between two chunks [s], longer where they take long; unit : of how far the computation is; key : the
    option that names the place.  number : of the last chunk; kept : how far it reaches.
    """

    def __init__(self, folder: RunFolder, every: float, unit: str, key: str) -> None:
        self.folder, self.unit, self.key = folder, unit, key
        self.chunks, self.interval = chunks_of(folder.path), SaveInterval(every)
        self.number, self.kept = 0, 0.0
        self._reported = time.monotonic()

    def write(self, kept: float, parts: Callable[[], Mapping[str, bytes]]) -> None:
        """Write the next chunk, which reaches as far as ``kept``; InputError where it cannot be written."""
        try:
            with self.interval.saving():
                self.chunks.write(self.number + 1, parts())
        except OSError as error:
            on = f", and go on with --resume from {self.kept:.4g} {self.unit}" if self.number else ""
            expected = f"a place where the run can be kept ({error.strerror or error}): make room there{on}"
            raise InputError(expected, key=self.key, value=self.folder.path) from error
        self.number, self.kept = self.number + 1, kept

    def report(self, done: float, total: float, *, now: bool = False) -> None:
        """Say in the folder how far the computation is, where it is time to, or now."""
        if now or time.monotonic() - self._reported >= REPORTED_EVERY:
            self._reported = time.monotonic()
            with self.interval.reporting():
                progress = RunProgress(done, total, self.unit, self.kept, float(self.interval.passed[0]), time.time())
                self.folder.report(progress)
