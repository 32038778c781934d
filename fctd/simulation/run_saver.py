"""A run that is kept while it lasts, in its folder: chunks of records, checkpoints, and how far it is."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.results.tables import SimulationResult
from fctd.simulation.chunks import Cursor, add_chunk, bytes_needed, chunk_since, read_chunk, warm_up
from fctd.simulation.simulate import Simulation
from fctd.store import facts, log
from fctd.store.facts import Facts
from fctd.store.limits import check_disk
from fctd.store.log import Log
from fctd.store.run_folder import RunFolder, chunks_of
from fctd.store.saver import Saver

# Checkpoints of a run, the last of which may be damaged.
KEPT_CHECKPOINTS = 2
# To read a run to which another process is writing.
ATTEMPTS = 3


class RunSaver(Saver):
    """Keeps a run in a folder; see ``Checkpointer`` and ``Saver``.

    csv : whether the result will have CSV files; tell : called with what the user should know.
    kept : simulated time of the last checkpoint [s].
    """

    def __init__(
        self, folder: RunFolder, every: float, *, csv: bool = False, key: str = "", tell: Callable[[str], None] = print
    ) -> None:
        super().__init__(folder, every, "s", key)
        self.csv, self.tell = csv, tell
        self._checkpoints, self._cursor = checkpoints_of(folder.path), Cursor()

    def begin(self, simulation: Simulation) -> None:
        """Put a run into the state of the last checkpoint that can be read.

        Raises InputError where it does not fit, and where the disk is too small for a new run.
        """
        warm_up()
        folder = self.folder.path
        if found := _last(folder, self.tell):
            self.number, checkpoint, chunks = found
            _restore(simulation, checkpoint, chunks, folder)
            self.interval.restore(checkpoint["interval"])
            self.kept, self._cursor = simulation.run.time, Cursor.at_end(simulation.recorder)
            self.tell(f"the run goes on from {self.kept:.4g} s")
        elif self.chunks.files:
            self.tell("the run begins anew")
        else:
            check_disk(folder, bytes_needed(simulation.run, len(simulation.intervals), self.csv), self.key)
        for files in (self.chunks, self._checkpoints):  # that a process began to write, or that cannot be read
            files.drop_after(self.number)
        simulation.saving = self.interval.spent

    def keep(self, simulation: Simulation, *, now: bool = False) -> None:
        """Write a checkpoint and a chunk where they are due; InputError where they cannot be written."""
        due, done = now or self.interval.due(), simulation.run.time
        if due:
            self.write(done, lambda: self._chunk(simulation))
            self._cursor = Cursor.at_end(simulation.recorder)
        self.report(done, simulation.end, now=due)
        simulation.saving = self.interval.spent

    def _chunk(self, simulation: Simulation) -> dict[str, bytes]:
        """The new records; the checkpoint that belongs to them is written before, since a chunk has one."""
        number = self.number + 1
        checkpoint = simulation.facts() | {"interval": self.interval.facts()}
        self._checkpoints.write(number, facts.pack(checkpoint))
        self._checkpoints.path(number - KEPT_CHECKPOINTS).unlink(missing_ok=True)
        return chunk_since(simulation.recorder, self._cursor)


def checkpoints_of(folder: Path) -> Log:
    """The checkpoints of the run in a folder."""
    return Log(folder, tail="-checkpoint.zip")


def kept_so_far(folder: Path, case: Case) -> SimulationResult:
    """What a run that has not ended has kept in its folder, to which another process may be writing.

    Raises InputError where nothing is kept.
    """
    for _ in range(ATTEMPTS):
        if found := _last(folder):
            simulation = Simulation(case)
            _restore(simulation, *found[1:], folder)
            return simulation.result()
    raise InputError("a run of which something has been kept (fctd status says how far it is)", value=folder)


def _last(folder: Path, tell: Callable[[str], None] = lambda _: None) -> tuple[int, Facts, list[dict[str, Any]]] | None:
    """The last checkpoint that can be read: its number, itself, and the tables of all chunks up to it."""
    checkpoints, chunks = checkpoints_of(folder), chunks_of(folder)
    for number in sorted(checkpoints.files.keys() & chunks.files.keys(), reverse=True):
        try:
            checkpoint = facts.unpack(log.read(checkpoints.path(number)))
            return number, checkpoint, [read_chunk(log.read(chunks.path(k))) for k in range(1, number + 1)]
        except Exception as error:  # what is damaged raises nearly anything; the checkpoint before may do
            tell(f"checkpoint {number} cannot be used ({getattr(error, 'strerror', None) or error})")
    return None


def _restore(simulation: Simulation, checkpoint: Facts, chunks: list[dict[str, Any]], folder: Path) -> None:
    """Put a run into the state of a checkpoint, with its records; InputError where it does not fit."""
    try:
        simulation.restore(checkpoint)
        for chunk in chunks:
            add_chunk(simulation.recorder, chunk)
    except (LookupError, ValueError) as error:
        other = f"no {error}" if isinstance(error, LookupError) else error
        expected = f"a run of this version of fctd (its checkpoint has {other}): go on with that one, or --restart"
        raise InputError(expected, value=folder) from error
