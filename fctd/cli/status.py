"""``fctd status``: how far the run of a result is, and what its folder holds."""

import time
from pathlib import Path
from typing import Annotated, Any

import typer

from fctd.case.errors import InputError
from fctd.case.text import counted, printable
from fctd.cli.base_command import Silent
from fctd.cli.keeping import has_kept, way_on
from fctd.cli.options import screen
from fctd.cli.pictures import PICTURES, TABLES
from fctd.results.tables import open_result, result_files
from fctd.store.lock import holder_of
from fctd.store.run_folder import about_of, clock, progress_of, run_path, writer_of

SWEEP = "sweep.json"  # of the folder of a sweep


def status_command(
    result: Annotated[
        Path,
        typer.Argument(
            metavar="RESULT", help="Folder of a run or sweep, or table or picture of a chart.", show_default=False
        ),
    ],
    quiet: Silent = False,
) -> None:
    """Say how far a run is, also while it lasts, and how to go on with one that has stopped."""
    lines = _of_the_run(result) + _of_the_sweep(result)
    try:
        lines += _of_the_result(result)
    except InputError:
        if not lines and any((result / name).exists() for name in result_files(csv=False)):
            raise  # it says which table cannot be read
    if not lines:
        expected = "the result of fctd simulate, fctd chart or fctd sweep, or the place of an unfinished one"
        raise InputError(expected, value=result)
    for line in () if quiet else lines:
        screen.print(f"{printable(str(result))}: {line}", soft_wrap=True)


def _of_the_run(target: Path) -> list[str]:
    """What there is to say of a run that has not ended."""
    about, writer, progress = about_of(target), writer_of(target), progress_of(target)
    if about is None and writer is not None:
        return [f"begun by process {writer.process} at {clock(writer.since)}"]
    if about is None:
        return ["stopped before anything was kept"] if run_path(target).is_dir() else []
    lines = []
    if writer is not None:
        lines.append(f"running since {clock(writer.since)}, process {writer.process}")
    if progress is not None:
        share = 100 * progress.done / progress.total if progress.total > 0 else 0.0
        # The clock may have been set back since.
        age = max(time.time() - progress.now, 0.0)
        lines.append(
            f"{progress.done:.4g} of {progress.total:.4g} {progress.unit} ({share:.0f} %) in {progress.took:.0f} s, "
            f"{age:.0f} s ago; kept up to {progress.kept:.4g} {progress.unit}"
        )
    elif writer is not None:
        lines.append("nothing computed yet")
    if writer is None:
        lines.append(_stopped(target, about))
    return lines


def _stopped(target: Path, about: dict[str, Any]) -> str:
    if not has_kept(target):
        return "stopped before anything was kept"
    return f"stopped; `{way_on(target, about)}` goes on"


def _of_the_sweep(folder: Path) -> list[str]:
    """What there is to say of the dataset of a sweep, whether it is complete or not."""
    if not (folder / SWEEP).is_file():
        return []
    # Here, as scipy's statistics take most of a second, which other results need not wait for.
    from fctd.sweep.chunk import NO_ROWS
    from fctd.sweep.dataset import open_dataset

    writer, dataset = holder_of(folder), open_dataset(folder)
    total, done = len(dataset.samples), len(dataset.done)
    lacking = sum(count for status, count in dataset.statuses().items() if status in NO_ROWS)
    lines = [] if writer is None else [f"running since {clock(writer.since)}, process {writer.process}"]
    line = f"a sweep: {done} of {counted(total, 'sample')} done ({100 * done / total:.0f} %)"
    if lacking:
        line += f", {lacking} without an answer"
    if dataset.parts:
        line += f"; last rows written at {clock(dataset.parts[-1].stat().st_mtime)}"
    lines.append(line)
    if writer is None and done < total:
        lines.append("stopped; the same `fctd sweep` command goes on")
    return lines


def _of_the_result(target: Path) -> list[str]:
    """What there is to say of a result that is there; raises InputError for a folder that cannot be read as one."""
    if target.is_file():
        if target.suffix.lower() not in (*TABLES, *PICTURES):
            return []
        return [f"a chart, written at {clock(target.stat().st_mtime)}"]
    if not target.is_dir():
        return []
    found = open_result(target, pause=0.0)
    line = f"a result: {found.status}, {counted(len(found.history), 'record')}"
    if len(found.history):
        last = found.history.iloc[-1]
        line += f", {last['operation']} at {last['bit_depth_m']:.1f} m"
    return [f"{line} ({found.message})" if found.message else line]
