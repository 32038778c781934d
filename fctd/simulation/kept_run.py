"""A run that is kept while it lasts, in its folder: chunks of records, checkpoints, and how far it is."""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

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


class KeptRun(Saver):
    """Keeps a run in a folder; see ``Keeper`` and ``Saver``.

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
        """Put a run into the state of the last checkpoint; InputError where the disk is too small for a new one."""
        warm_up()
        there = _complete(self.folder.path)
        for number in there:
            try:
                self.interval.restore(_restore(self.folder.path, simulation, number)["interval"])
                self.number, self.kept = number, simulation.run.time
                break
            except Exception as error:  # the checkpoint before may do
                self.tell(f"checkpoint {number} cannot be used ({getattr(error, 'strerror', None) or error})")
        for kind in (self.chunks, self._checkpoints):  # of those that a process began to write or that cannot be read
            kind.drop_after(self.number)
        if there:
            self._cursor = Cursor.at_end(simulation.recorder) if self.number else Cursor()
            self.tell(f"the run goes on from {self.kept:.4g} s" if self.number else "the run begins anew")
        else:
            needed = bytes_needed(simulation.run, len(simulation.intervals), self.csv)
            check_disk(self.folder.path, needed, self.key)
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


def _complete(folder: Path) -> list[int]:
    """Numbers of the checkpoints whose chunk has been written too, the last one first."""
    chunks = chunks_of(folder).files
    return [number for number in reversed(checkpoints_of(folder).files) if number in chunks]


def kept_so_far(folder: Path, case: Case) -> SimulationResult:
    """What a run that has not ended has kept in its folder, to which another process may be writing.

    Raises InputError where nothing is kept.
    """
    simulation = Simulation(case)
    for _ in range(ATTEMPTS):
        for number in _complete(folder):
            with suppress(Exception):  # damaged, or removed by the run meanwhile
                _restore(folder, simulation, number)
                return simulation.result()
    raise InputError("a run of which something has been kept (fctd status says how far it is)", value=folder)


def _restore(folder: Path, simulation: Simulation, number: int) -> Facts:
    """Put a run into the state of a checkpoint, with its records; returns the facts of the checkpoint.

    Raises OSError, ValueError or LookupError where a file is missing or damaged, or belongs to another run, which stays
    as it was.
    """
    checkpoint = facts.unpack(log.read(checkpoints_of(folder).path(number)))
    chunks = [read_chunk(log.read(chunks_of(folder).path(k))) for k in range(1, number + 1)]
    simulation.check_facts(checkpoint)
    simulation.restore(checkpoint)  # once all has been read
    for chunk in chunks:
        add_chunk(simulation.recorder, chunk)
    return checkpoint
