"""A run that is kept while it lasts, in its folder: chunks of records, checkpoints, and how far it is."""

import io
import json
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.results.tables import SimulationResult
from fctd.simulation.checkpoint import Checkpoint, capture, put_back
from fctd.simulation.chunks import NAMES, Cursor, add_chunk, chunk_since, read_chunk, size_of, warm_up
from fctd.simulation.disk import bytes_needed, check_disk
from fctd.simulation.simulate import Simulation
from fctd.store.run_folder import REPORTED_EVERY, Progress, RunFolder, cannot_keep, numbered
from fctd.store.save_interval import Clocks, SaveInterval

CHECKPOINT = "checkpoint.npz"
# Checkpoints of a run, the last of which may be damaged.
KEPT_CHECKPOINTS = 2
# To read a run to which another process is writing.
ATTEMPTS = 3


class KeptRun:
    """Keeps a run in a folder; see ``Keeper``.

    every : time between two checkpoints [s], longer where they take long; csv : whether the result will have CSV files.
    key : the option that names the place; tell : called with what the user should know.
    kept : simulated time of the last checkpoint [s].
    """

    def __init__(
        self, folder: RunFolder, every: float, *, csv: bool = False, key: str = "", tell: Callable[[str], None] = print
    ) -> None:
        self.folder, self.csv, self.key, self.tell = folder, csv, key, tell
        self.kept, self._number, self._cursor = 0.0, 0, Cursor()
        self._pace, self._reported = SaveInterval(every), time.monotonic()
        self._before, self._spent_before = 0.0, Clocks(0.0, 0.0)  # of the processes before

    @property
    def spent(self) -> Clocks:
        """Time that keeping the run has taken so far."""
        return self._spent_before.plus(self._pace.spent)

    @property
    def took(self) -> float:
        """Time of the run so far on the wall [s]."""
        return self._before + self._pace.took

    def begin(self, simulation: Simulation) -> None:
        """Put a run into the state of the last checkpoint; InputError where the disk is too small for a new one."""
        warm_up()
        checkpoints = numbered(self.folder.path, CHECKPOINT)
        for number in reversed(checkpoints):
            try:
                self._go_on(simulation, number)
            except Exception as error:  # a damaged archive raises nearly anything; the checkpoint before may do
                self.tell(f"checkpoint {number} cannot be used ({getattr(error, 'strerror', None) or error})")
            else:
                break
        self._remove_after(self._number)
        if checkpoints:
            self.tell(f"the run goes on from {self.kept:.4g} s" if self._number else "the run begins anew")
        else:
            needed = bytes_needed(simulation.run, len(simulation.intervals), self.csv)
            check_disk(self.folder.path, needed, self.key)

    def keep(self, simulation: Simulation, *, now: bool = False) -> None:
        """Write a chunk and a checkpoint where they are due; InputError where they cannot be written."""
        due = now or self._pace.due()
        if due:
            try:
                with self._pace.keeping():
                    self._write(simulation)
            except OSError as error:
                raise cannot_keep(error, self.folder, self.key, f"{self.kept:.4g} s" if self.kept else "") from error
        if due or time.monotonic() - self._reported >= REPORTED_EVERY:
            self._reported = time.monotonic()
            with self._pace.reporting():
                done, total = simulation.run.time, simulation.end
                self.folder.report(Progress(done, total, "s", self.kept, self.took, time.time()))
        simulation.keeping = self.spent

    def _write(self, simulation: Simulation) -> None:
        number = self._number + 1
        for name, content in chunk_since(simulation.recorder, self._cursor).items():
            self.folder.write(f"{number}-{name}.parquet", content)
        checkpoint = capture(simulation)
        facts = checkpoint.facts | {
            "took": self.took, "spent": self.spent,
            "cursor": [self._cursor.records, self._cursor.profiles, self._cursor.seen],
        }  # fmt: skip
        sink = io.BytesIO()
        kept: dict[str, Any] = {"facts": np.frombuffer(json.dumps(facts).encode(), np.uint8), **checkpoint.arrays}
        np.savez(sink, **kept)
        self.folder.write(f"{number}-{CHECKPOINT}", sink.getvalue())
        self.folder.remove({f"{number - KEPT_CHECKPOINTS}-{CHECKPOINT}"})
        self._number, self.kept = number, checkpoint.time

    def _go_on(self, simulation: Simulation, number: int) -> None:
        facts = _restore(self.folder.path, simulation, number)
        self._number, self._cursor, self.kept = number, Cursor(*facts["cursor"]), facts["last_time"]
        self._before, self._spent_before = facts["took"], Clocks(*facts["spent"])
        simulation.keeping = self.spent

    def _remove_after(self, number: int) -> None:
        """Remove chunks and checkpoints after one, which a process had begun to write or which cannot be read."""
        for kind in (CHECKPOINT, *(f"{name}.parquet" for name in NAMES)):
            self.folder.remove({name for k, name in numbered(self.folder.path, kind).items() if k > number})


def kept_so_far(folder: Path, case: Case) -> SimulationResult:
    """What a run that has not ended has kept in its folder, to which another process may be writing.

    Raises InputError where nothing is kept.
    """
    simulation = Simulation(case)
    for _ in range(ATTEMPTS):
        for number in reversed(numbered(folder, CHECKPOINT)):
            with suppress(Exception):  # damaged, or removed by the run meanwhile
                _restore(folder, simulation, number)
                return simulation.result()
    raise InputError("a run of which something has been kept (fctd status says how far it is)", value=folder)


def _restore(folder: Path, simulation: Simulation, number: int) -> dict[str, Any]:
    """Put a run into the state of a checkpoint, with its records; returns the facts of the checkpoint.

    Raises nearly anything where a file is damaged; the run is then as it was.
    """
    content = (folder / f"{number}-{CHECKPOINT}").read_bytes()  # numpy leaves a file open that is damaged
    with np.load(io.BytesIO(content), allow_pickle=False) as read:
        arrays = {name: read[name] for name in read.files}
    facts: dict[str, Any] = json.loads(arrays.pop("facts").tobytes())
    chunks = []
    for k in range(1, number + 1):
        files = {name: folder / f"{k}-{name}.parquet" for name in NAMES}
        chunks.append(read_chunk({name: file.read_bytes() for name, file in files.items() if file.exists()}))
    records, profiles, _ = facts["cursor"]
    if size_of(chunks) != (records, records, profiles):
        raise ValueError("a chunk of its records is missing")
    recorder = put_back(simulation, Checkpoint(arrays, facts))  # once all has been read
    for chunk in chunks:
        add_chunk(recorder, chunk)
    simulation.go_on(recorder)
    return facts
