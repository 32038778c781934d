"""``python -m benchmarks``: the gate, a comparison of this run with the last release, and a new record."""

from importlib.metadata import version
from pathlib import Path
from typing import Annotated

import typer

from benchmarks import history, measure, tables
from benchmarks.gate import gate
from benchmarks.subjects import SEGMENTS
from fctd.case.errors import InputError
from fctd.cli.main import run
from fctd.cli.options import FAILED, messages, screen
from fctd.steady.problem import Workspace

PROCESSES = 6  # processes measured for a record
MOST_MEMORY = 200e3  # of the arrays of a string [B]

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Cost of the kernels compared with the last release.",
)
History = Annotated[Path, typer.Option("--history", metavar="FOLDER", help="Folder of the records.")]


def report(line: str) -> None:
    """Print progress on standard error."""
    messages.print(line)


@app.command("gate")
def gate_command(folder: History = history.HISTORY) -> None:
    """Exit with code 1 and name the kernel if one is slower than in the last release by 15 % beyond noise.

    Also where the arrays of a string need more memory than is allowed.
    """
    needed = Workspace(SEGMENTS).nbytes
    screen.print(f"arrays of a string of {SEGMENTS} segments: {needed / 1e3:.0f} kB, at most {MOST_MEMORY / 1e3:.0f}")
    if needed > MOST_MEMORY:
        raise typer.Exit(FAILED)
    last = history.last_release(folder)
    if last is None:
        screen.print("no release is recorded: nothing to compare with")
        return
    file, record = last
    if record.accepted:
        screen.print(f"the baseline of {record.date:%Y-%m-%d} accepts: {record.accepted}")
    outcome = gate(record, file, report)
    if not outcome.verdicts:
        screen.print(outcome.how)
        return
    screen.print(tables.verdict_table(outcome))
    screen.print(tables.shown_table(outcome))
    for verdict in outcome.verdicts:
        if verdict.status == "slower":
            screen.print(
                f"slower: {verdict.kernel} takes {verdict.change:.2f} times what it took"
                f" (80 % interval {verdict.low:.2f} to {verdict.high:.2f})"
            )
        elif verdict.status == "missing":
            screen.print(f"missing: {verdict.kernel} is no longer measured; record a new release")
    if not outcome.passed:
        raise typer.Exit(FAILED)


@app.command("scale")
def scale_command() -> None:
    """Measure how a sweep scales over workers, and what a scheduler can serve (docs/scale.md)."""
    from benchmarks import scale  # Dask takes a while to import

    scale.measure(report)


@app.command("compare")
def compare_command(folder: History = history.HISTORY) -> None:
    """Measure and print this run next to the last release."""
    last = history.last_release(folder)
    record = measured()
    why_not = "" if last is None else last[1].not_here(record.reference, record.processor, record.versions)
    screen.print(tables.comparison(record, last[1] if last else None, why_not))


@app.command("record")
def record_command(
    folder: History = history.HISTORY,
    release: Annotated[str, typer.Option("--release", help="Name of the release; default: FCTD's version.")] = "",
    accept: Annotated[
        str, typer.Option("--accept", metavar="REASON", help="What became slower, and why it is accepted.")
    ] = "",
) -> None:
    """Measure and store a record for comparison with later runs; the sources have to be committed."""
    changed = history.uncommitted()
    if changed:
        raise InputError("everything committed, since a record names its commit", key="git", value=changed)
    screen.print(str(history.write(measured(release, accept), folder)))


def measured(release: str = "", accepted: str = "") -> history.Record:
    """Measure the kernels; returns the record."""
    costs, subjects = measure.alone(PROCESSES, report=report)
    return history.record_of(costs, subjects, release or version("fctd"), accepted)


if __name__ == "__main__":
    run(app)
