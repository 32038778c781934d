"""``python -m benchmarks``: the gate, a new baseline, and planted slowdowns."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from benchmarks import checkout, history, tables
from benchmarks.gate import Outcome, against, against_baseline
from benchmarks.subjects import SEGMENTS
from fctd.case.errors import InputError
from fctd.cli.main import run
from fctd.cli.options import FAILED, messages, screen
from fctd.steady.problem import Workspace

MOST_MEMORY = 200e3  # of the arrays of a string [B]

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Cost of the kernels compared with the accepted baseline.",
)
History = Annotated[Path, typer.Option("--history", metavar="FOLDER", help="Folder of the baselines.")]


def report(line: str) -> None:
    """Print progress on standard error."""
    messages.print(line)


@app.command("gate")
def gate_command(
    folder: History = history.HISTORY,
    commit: Annotated[
        str, typer.Option("--against", metavar="COMMIT", help="Race this commit too: no slow creep since.")
    ] = "",
) -> None:
    """Exit with code 1 and name the kernel if one became slower than in the baseline by 10 % beyond noise.

    Also where the arrays of a string need more memory than is allowed. Exit code 2 where there is nothing to race.
    """
    needed = Workspace(SEGMENTS).nbytes
    screen.print(f"arrays of a string of {SEGMENTS} segments: {needed / 1e3:.0f} kB, at most {MOST_MEMORY / 1e3:.0f}")
    if needed > MOST_MEMORY:
        raise typer.Exit(FAILED)
    records = history.read(folder)
    if not records:
        raise InputError("a baseline: python -m benchmarks record makes one", key="--history", value=folder)
    file, last = records[-1]
    for kernel in last.accepted:
        screen.print(f"the baseline {last.name} accepts {last.entry(kernel)}", markup=False)
    outcomes = [against_baseline(last, file, report)]
    print_outcome(outcomes[0])
    if commit:
        outcomes.append(against(commit, records, report))
        print_outcome(outcomes[1])
    if not all(outcome.passed for outcome in outcomes):
        raise typer.Exit(FAILED)


def print_outcome(outcome: Outcome) -> None:
    """The table of a race, and a sentence for each kernel that fails."""
    if not outcome.verdicts:
        screen.print(outcome.how)
        return
    screen.print(tables.verdict_table(outcome))
    for verdict in outcome.verdicts:
        if verdict.status == "slower":
            screen.print(
                f"slower: {verdict.kernel} takes {verdict.change:.2f} times what it took"
                f" (80 % interval {verdict.low:.2f} to {verdict.high:.2f})"
            )
        elif verdict.status == "missing":
            screen.print(f"missing: {verdict.kernel} is no longer measured; record a baseline that says why")
        elif verdict.status == "no baseline":
            screen.print(f"no baseline: {verdict.kernel} came with an earlier change; record a baseline that has it")


@app.command("record")
def record_command(
    folder: History = history.HISTORY,
    accept: Annotated[
        list[str] | None,
        typer.Option("--accept", metavar="KERNEL=REASON", help="A kernel that became slower, and why. Repeatable."),
    ] = None,
) -> None:
    """Race the last commit against the baseline, and make it the baseline if a kernel gained or an entry explains."""
    changed = checkout.uncommitted()
    if changed:
        raise InputError("everything committed, since a baseline is a commit", key="git", value=changed)
    reasons = reasons_of(accept or [])
    records = history.read(folder) if folder.is_dir() else []
    outcome = against_baseline(records[-1][1], records[-1][0], report) if records else Outcome("", [], {}, {})
    print_outcome(outcome)
    record = history.record_of(outcome.verdicts, reasons, records[-1][1] if records else None)
    screen.print(str(history.write(record, folder)))


def reasons_of(entries: Sequence[str]) -> dict[str, str]:
    """The reasons of ``--accept`` by kernel; InputError for an entry without one."""
    reasons: dict[str, str] = {}
    for entry in entries:
        kernel, _, reason = (part.strip() for part in entry.partition("="))
        if not kernel or not reason:
            raise InputError("KERNEL=REASON", key="--accept", value=entry)
        reasons[kernel] = reason
    return reasons


@app.command("planted")
def planted_command() -> None:
    """Plant a slowdown of 15 % in each subject, one after the other, and say whether the gate finds it."""
    from benchmarks import planted  # what it compiles is no part of the gate

    found = planted.search(report)
    screen.print(planted.table(found))
    if not all(each.found for each in found):
        raise typer.Exit(FAILED)


@app.command("scale")
def scale_command() -> None:
    """Measure how a sweep scales over workers, and what a scheduler can serve (docs/scale.md)."""
    from benchmarks import scale  # Dask takes a while to import

    scale.measure(report)


if __name__ == "__main__":
    run(app)
