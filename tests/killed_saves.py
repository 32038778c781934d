"""``python -m tests.killed_saves BASE``: saves and repairs that are killed before each of their steps, in turn.

Makes BASE/N/out for the save killed before its step N, and BASE/N-M/out for the same repaired by a process killed
before its step M.  The last N and the last M of each are those that ended by themselves.
"""

import os
import shutil
import signal
import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq

from fctd.results import tables
from fctd.results.tables import SimulationResult, own_files
from fctd.store.whole_folder import repair
from tests.cases import make_case

STEPS = [(os, "mkdir"), (os, "rename"), (os, "replace"), (os, "unlink"), (os, "rmdir"), (pq, "write_table")]
FOREIGN = {"notes.txt": "mine", "sub/deep.txt": "also mine", "energy.csv.bak": "and this"}


def result(value: float) -> SimulationResult:
    """A result with one value in all of its tables."""
    frame = pd.DataFrame({"value": [value]})
    return SimulationResult(
        make_case(), "completed", "", frame, frame, frame, {"segments": 1}, operations=frame, segments=frame,
        identity=f"run {value:g}",
    )  # fmt: skip


def earlier(folder: Path) -> None:
    """A folder with a result that has CSV files, and with the user's own files."""
    result(1.0).save(folder, csv=True)
    (folder / "sub").mkdir()
    for name, text in FOREIGN.items():
        (folder / name).write_text(text)
    (folder / "link").symlink_to("sub")


def killed(action: Callable[[], object], step: int) -> bool:
    """Run an action in a process of its own that is killed before a step; False where it ends before."""
    child = os.fork()
    if child == 0:
        counter = count(1)

        def counted(real: Callable[..., object]) -> Callable[..., object]:
            def call(*arguments: object, **more: object) -> object:
                if next(counter) == step:
                    os.kill(os.getpid(), signal.SIGKILL)
                return real(*arguments, **more)

            return call

        for module, name in STEPS:
            setattr(module, name, counted(getattr(module, name)))
        action()
        os._exit(0)
    status = os.waitpid(child, 0)[1]
    if not os.WIFSIGNALED(status) and os.WEXITSTATUS(status) != 0:
        raise RuntimeError(f"step {step} ended with {os.WEXITSTATUS(status)}")
    return os.WIFSIGNALED(status)


def main(base: Path) -> None:
    """See above."""
    tables.versions = lambda: {}  # asks git
    saving = True
    for step in count(1):
        folder = base / f"{step}" / "out"
        earlier(folder)
        saving = killed(lambda folder=folder: result(2.0).save(folder), step)
        for second in count(1):
            again = base / f"{step}-{second}" / "out"
            shutil.copytree(folder.parent, again.parent, symlinks=True)
            if not killed(lambda folder=again: repair(folder, own_files), second):
                break
        if not saving:
            break


if __name__ == "__main__":
    main(Path(sys.argv[1]))
