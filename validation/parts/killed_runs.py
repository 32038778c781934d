"""Commands in processes of their own that are killed at random moments, and gone on with until they end.

The processes are forked from this one, which has imported and compiled everything: they begin to compute at once.
"""

import os
import shutil
import signal
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd.cli.keeping import has_kept
from fctd.cli.main import app, run
from fctd.results.tables import TABLES, open_result
from fctd.store import save_interval
from fctd.store.parquet import read_frame
from fctd.store.run_folder import about_of, chunks_of, progress_of, run_path
from references.commands import app as references

# Processes for each kill, after which a command counts as one that ends before it can be killed.
MOST_PROCESSES = 20
WELL = """
name = "killed"
[wellbore]
stations = [[0, 0, 0], [150, 0, 0], [450, 60, 0], [2000, 60, 0]]
geometry = "{geometry}"
[[wellbore.intervals]]
to_md = "2000 m"
diameter = "8.5 in"
friction = 0.25
[string]
[[string.components]]
name = "collar"
length = "60 m"
outer_diameter = "160 mm"
inner_diameter = "70 mm"
segment_length = "20 m"
[[string.components]]
name = "pipe"
outer_diameter = "127 mm"
inner_diameter = "108.6 mm"
segment_length = "28.5 m"
[mud]
density = "1200 kg/m^3"
{more}
"""
TRIP = """
[record]
interval = "{interval}"
[rig]
feed = "stands"
connection_time = "{connection}"
[[operations]]
kind = "trip_in"
from_md = "600 m"
to_md = "{to_md} m"
speed = "{speed}"
"""
# Stick and slip: torque on the rock falls with the rotation, and the drive is stiff.
DRILL = """
[bit]
weight_on_bit = "60 kN"
[bit.rock]
weakening = 0.5
[rig]
feed = "stands"
[[operations]]
kind = "drill_rotating"
from_md = "1500 m"
to_md = "{to_md} m"
speed = "18 m/h"
rpm = 40
ramp_time = "5 s"
"""
ROTATE = """
[record]
interval = "0.05 s"
[[operations]]
kind = "rotate_off_bottom"
at_md = "1000 m"
duration = "{to_md} s"
rpm = 60
ramp_time = "2 s"
"""


@dataclass(frozen=True)
class Command:
    """A command that is killed: its arguments without ``--out``, and the result's name.

    every : between two checkpoints; program : whose command line it is.
    """

    name: str
    case: str
    arguments: tuple[str, ...]
    result: str
    every: str = "0.2 s"
    program: Any = app
    more: tuple[str, ...] = ()

    def begin(self, folder: Path, result: Path) -> list[str]:
        """Arguments of the process that begins."""
        head, *rest = self.arguments
        case = str(folder / "case.toml")
        return [head, case, *rest, "--out", str(result), "--checkpoint-every", self.every, *self.more, "--quiet"]

    def resume(self, result: Path) -> list[str]:
        """Arguments of one that goes on."""
        return [self.arguments[0], "--resume", str(result), "--checkpoint-every", self.every, "--quiet"]


def trip(
    geometry: str, to_md: float, connection: str = "20 s", speed: str = "0.5 m/s", interval: str = "1 s"
) -> Command:
    """A trip with connections; interval : between two records."""
    more = TRIP.format(to_md=to_md, connection=connection, speed=speed, interval=interval)
    return Command(f"trip, {geometry}", WELL.format(geometry=geometry, more=more), ("simulate",), "out")


def drill(geometry: str, to_md: float) -> Command:
    """Drilling with stick and slip."""
    case = WELL.format(geometry=geometry, more=DRILL.format(to_md=to_md))
    return Command(f"stick and slip, {geometry}", case, ("simulate",), "out")


def chart(step: float) -> Command:
    """A chart of all operations; step of its depths [m]."""
    asked = ("chart", "--operation", "all", "--depths", f"300:1800:{step:g}", "--friction", "0.1,0.2,0.3")
    return Command("chart", WELL.format(geometry="arcs", more=""), asked, "chart.parquet")


def meshed(duration: float) -> Command:
    """A rotation against FCL's triangle mesh [s]."""
    case = WELL.format(geometry="arcs", more=ROTATE.format(to_md=duration))
    return Command("rotation, FCL", case, ("simulate",), "out", program=references, more=("--contact", "fcl"))


@dataclass
class Killed:
    """What became of a command: exit codes of its processes, and what was found wrong after any of them.

    took : by the undisturbed process, of which so much computing; resumed : processes that went on with what another
    had kept; kept : chunks after each process that was killed.
    """

    command: str
    took: float = 0.0
    computing: float = 0.0
    kills: int = 0
    processes: int = 0
    resumed: int = 0
    wrong: list[str] = field(default_factory=list)
    kept: list[int] = field(default_factory=list)


class Ended(NamedTuple):
    """A process that has ended: its exit code, −9 where it was killed, and how long it had been computing [s]."""

    code: int
    computing: float


def forked(program: Any, arguments: Sequence[str], *, log: Path, before: Callable[[], None] | None = None) -> int:
    """Exit code of a command in a fork; log : gets what it prints; before : called in the fork first."""
    return os.waitstatus_to_exitcode(os.waitpid(_fork(program, arguments, log, before), 0)[1])


def watched(
    program: Any, arguments: Sequence[str], result: Path, *, log: Path, kill_after: float | None = None,
    from_the_start: bool = False,
) -> Ended:  # fmt: skip
    """A command in a fork, killed after so many seconds of computing, or from its start on.

    It computes from its first report of progress on; before that it prepares and settles.
    """
    began, reported = time.monotonic(), progress_of(result)
    child = _fork(program, arguments, log)
    computing = None
    while True:
        pid, status = os.waitpid(child, os.WNOHANG)
        now = time.monotonic()
        if computing is None and progress_of(result) != reported:
            computing = now
        since = began if from_the_start else computing
        if not pid and kill_after is not None and since is not None and now - since >= kill_after:
            os.kill(child, signal.SIGKILL)
            pid, status = os.waitpid(child, 0)
        if pid:
            return Ended(os.waitstatus_to_exitcode(status), 0.0 if computing is None else now - computing)
        time.sleep(0.005)


def _fork(program: Any, arguments: Sequence[str], log: Path, before: Callable[[], None] | None = None) -> int:
    """The number of the process."""
    sys.stdout.flush()
    child = os.fork()
    if child:
        return child
    code = 70
    # A checkpoint may take any share of the time, so that there are many.
    save_interval.SHARE = 1.0
    try:
        out = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
        os.dup2(out, 1)
        os.dup2(out, 2)
        sys.stdout = sys.stderr = os.fdopen(1, "w", buffering=1, closefd=False)  # a test has replaced them
        sys.argv = ["fctd", *arguments]
        if before is not None:
            before()
        run(program)
        code = 0
    except SystemExit as ended:
        code = ended.code if isinstance(ended.code, int) else int(bool(ended.code))
    finally:
        os._exit(code)


def kill_again_and_again(
    command: Command, kills: int, rng: np.random.Generator, folder: Path, longest: float = 0.7
) -> Killed:
    """Run a command undisturbed; then run it, and kill and resume it until it was killed so often.

    A kill comes after a time of computing that is uniform up to ``longest`` of the undisturbed one; every fourth comes
    while the process prepares, or soon after.  Where the command ends before, its result is compared and it begins
    anew, also where it was killed after its result had been put into its place.  An earlier result of a run stands
    there meanwhile.
    """
    folder.mkdir(parents=True)
    (folder / "case.toml").write_text(command.case)
    whole, result, log = (folder / name for name in (f"whole-{command.result}", command.result, "log"))
    found = Killed(command.name)
    if command.program is app:  # compiles what is not compiled yet
        forked(app, [*command.begin(folder, whole), "--time-limit", "0.1 s"], log=log)
        for left in (whole, run_path(whole)):
            shutil.rmtree(left, ignore_errors=True)
    began = time.monotonic()
    code, found.computing = watched(command.program, command.begin(folder, whole), whole, log=log)
    found.took = time.monotonic() - began
    if code:
        found.wrong.append(f"the undisturbed command ended with {code}")
        return found
    if not found.computing:
        found.wrong.append(f"the undisturbed command ended in {found.took:.2g} s, before it said how far it was")
        return found
    wanted = tables_of(whole)
    while found.kills < kills:
        _earlier(whole, result)
        before = _identity(result)
        kept, cleaning = 0, False
        while True:
            preparing, share = found.kills % 4 == 3, float(rng.uniform())
            span = found.took - found.computing if preparing else longest * found.computing
            kill_after = share * span if found.kills < kills else None
            goes_on = about_of(result) is not None and has_kept(result)
            arguments = command.resume(result) if goes_on else command.begin(folder, result)
            code, _ = watched(
                command.program, arguments, result, log=log, kill_after=kill_after, from_the_start=preparing
            )
            found.processes += 1
            found.resumed += goes_on
            if code != -signal.SIGKILL:
                break
            found.kills += 1
            if cleaning := _identity(result) not in (before, ""):
                break
            now = len(chunks_of(run_path(result)).files)
            found.kept.append(now)
            if now < kept:
                found.wrong.append(f"{kept} chunks were kept, and {now} after a kill")
            kept = now
            if forked(app, ["status", str(result)], log=log):
                found.wrong.append("fctd status failed after a kill")
        if code and not cleaning:
            found.wrong.append(f"a process ended with {code}")
            break
        if found.processes > MOST_PROCESSES * kills:
            found.wrong.append(f"{found.processes} processes, of which {found.kills} could be killed before they ended")
            break
        found.wrong += [f"{name} differs" for name, bits in tables_of(result).items() if bits != wanted[name]]
        if run_path(result).exists() and not cleaning:
            found.wrong.append("the folder of the run is still there")
    if "Traceback" in log.read_text(errors="replace"):
        found.wrong.append("a traceback was printed")
    return found


def _earlier(whole: Path, result: Path) -> None:
    """Put an earlier result into the place of the one that is computed."""
    if result.is_file():
        result.unlink()
    shutil.rmtree(result, ignore_errors=True)
    if whole.is_dir():
        shutil.copytree(whole, result)


def _identity(result: Path) -> str:
    """Identity of a run's result, or the name of a chart's, which has none before; opening a part of a folder fails."""
    if result.is_file():
        return result.name
    return open_result(result).identity if result.is_dir() else ""


def tables_of(result: Path) -> dict[str, bytes]:
    """Every column of a result, bit by bit."""
    if not result.is_dir():
        return _bits("chart", read_frame(result))
    found = open_result(result)
    return {key: bits for name in TABLES for key, bits in _bits(name, getattr(found, name)).items()}


def _bits(name: str, table: pd.DataFrame) -> dict[str, bytes]:
    return {
        f"{name}.{column}": values.to_numpy().tobytes()
        if values.dtype.kind in "fiub"
        else repr(values.tolist()).encode()
        for column, values in table.items()
    }
