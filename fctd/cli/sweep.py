"""``fctd sweep SWEEP.toml``: many samples of a case, on all cores or on a cluster."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from fctd.case.errors import InputError
from fctd.case.text import counted, file_name, printable
from fctd.cli.options import FAILED, Quiet, messages, screen
from fctd.results.status import ACCEPTABLE
from fctd.store.limits import cores
from fctd.sweep.chunk import NO_ROWS
from fctd.sweep.cluster import ClusterChoice, encrypted
from fctd.sweep.run import SchedulerLostError, Summary, sweep
from fctd.sweep.spec import read_sweep

if TYPE_CHECKING:
    from distributed import Client

SweepFile = Annotated[Path, typer.Argument(metavar="SWEEP.toml", help="Sweep file (TOML).", show_default=False)]


def sweep_command(
    sweep_file: SweepFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FOLDER", help="Folder of the dataset; default: NAME-sweep.", show_default=False),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            "--workers",
            metavar="N",
            min=1,
            help="Local worker processes; default: one for each core.",
            show_default=False,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler", metavar="ADDRESS", help="Address of a Dask scheduler, tls://host:8786.", show_default=False
        ),
    ] = None,
    scheduler_file: Annotated[
        Path | None,
        typer.Option("--scheduler-file", metavar="FILE", help="File that a Dask scheduler wrote.", show_default=False),
    ] = None,
    tls_ca: Annotated[
        Path | None, typer.Option("--tls-ca", metavar="FILE", help="Certificate authority.", show_default=False)
    ] = None,
    tls_cert: Annotated[
        Path | None, typer.Option("--tls-cert", metavar="FILE", help="Own certificate.", show_default=False)
    ] = None,
    tls_key: Annotated[
        Path | None, typer.Option("--tls-key", metavar="FILE", help="Key of the own certificate.", show_default=False)
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Compute all samples of a sweep; the same command goes on with one that was interrupted."""
    choice = cluster_choice(workers, scheduler, scheduler_file, (tls_ca, tls_cert, tls_key))
    spec = read_sweep(sweep_file)
    folder = out if out is not None else Path(file_name(spec.name, "-sweep"))
    try:
        with _bar(printable(spec.name), quiet) as (bar, task):

            def show(done: int, total: int, lacking: int) -> None:
                rest = f", {lacking} without an answer" if lacking else ""
                bar.update(task, completed=done, total=total, description=f"{printable(spec.name)}{rest}")

            found = sweep(spec, folder, choice, show, on_client=lambda client: _show_address(client, choice))
    except SchedulerLostError:
        messages.print(f"The scheduler has ended; what was written stays in {printable(str(folder))}. {AGAIN}")
        raise typer.Exit(FAILED) from None
    except KeyboardInterrupt:
        messages.print(f"Interrupted; what was written stays in {printable(str(folder))}. {AGAIN}", soft_wrap=True)
        raise
    _print(found, folder)
    if not ACCEPTABLE.issuperset(found.statuses):
        raise typer.Exit(FAILED)


MOST_WORKERS = 4  # for each core: each has an interpreter and compiled code of its own
AGAIN = "The same command goes on with the samples that are missing."


def cluster_choice(
    workers: int | None, scheduler: str | None, scheduler_file: Path | None, tls: tuple[Path | None, ...]
) -> ClusterChoice:
    """Where the options say that a sweep runs; raises InputError for options that exclude or need each other."""
    if scheduler is not None and scheduler_file is not None:
        raise InputError("--scheduler or --scheduler-file, not both", key="--scheduler-file", value=scheduler_file)
    choice = ClusterChoice(workers, scheduler, scheduler_file)
    if workers is not None and not choice.local:
        raise InputError("no number of workers beside a scheduler, which has its own", key="--workers", value=workers)
    most = MOST_WORKERS * cores()
    if workers is not None and workers > most:
        expected = f"at most {most}, {MOST_WORKERS} for each core of this machine: one for each core is fastest"
        raise InputError(expected, key="--workers", value=workers)
    names = ("--tls-ca", "--tls-cert", "--tls-key")
    given = {name: path for name, path in zip(names, tls, strict=True) if path is not None}
    if not given:
        return choice
    if choice.local:
        name, path = next(iter(given.items()))
        raise InputError("the scheduler of another machine beside it (--scheduler)", key=name, value=path)
    for name in names:
        if name not in given:
            raise InputError(f"a file, as {' and '.join(given)} are given", key=name)
        if not given[name].is_file():
            raise InputError("a file that is there", key=name, value=given[name])
    ca, cert, key = (given[name] for name in names)
    return ClusterChoice(None, scheduler, scheduler_file, (ca, cert, key))


class _Rate(ProgressColumn):
    """Samples a second, once there is a rate."""

    def render(self, task: Task) -> Text:
        """The rate, or nothing."""
        return Text("" if task.speed is None else f"{task.speed:.3g}/s")


@contextmanager
def _bar(name: str, quiet: bool) -> Iterator[tuple[Progress, TaskID]]:
    """A progress bar with the number of samples, their rate, and the remaining time."""
    columns = (
        TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(),
        _Rate(), TimeElapsedColumn(), TimeRemainingColumn(),
    )  # fmt: skip
    with Progress(*columns, console=messages, disable=quiet, transient=True) as bar:
        yield bar, bar.add_task(name, total=None)


def _show_address(client: "Client", choice: ClusterChoice) -> None:
    """Print the dashboard's address, and a warning where the connection is open to others."""
    messages.print(f"dashboard: {client.dashboard_link}", soft_wrap=True)
    if not choice.local and not encrypted(client):
        messages.print(
            "warning: the connection to the scheduler is not encrypted, and whoever reaches it can run programs on its "
            "workers: use a network of your own, or --tls-ca, --tls-cert and --tls-key",
            soft_wrap=True,
        )


def _print(found: Summary, folder: Path) -> None:
    """Print what was computed, how long it took, and all samples and rows that have no answer, or one to doubt."""
    new = found.samples - found.done_before
    name = printable(str(folder))
    if new:
        were = "was" if found.done_before == 1 else "were"
        before = f", {found.done_before} {were} there" if found.done_before else ""
        screen.print(
            f"{counted(new, 'sample')}{before}; {counted(found.rows, 'row')} in {found.wall:.1f} s on "
            f"{counted(found.workers, 'worker')} "
            f"({100 * found.share:.0f} % solving and writing), start {found.start:.1f} s",
            soft_wrap=True,
        )
    for status, count in found.statuses.items():
        if status not in ACCEPTABLE:
            rows = counted(sum(found.statuses.values()), "row")
            what = counted(count, "sample") if status in NO_ROWS else f"{count} of {rows}"
            messages.print(f"{what} {status}: see the column reason", soft_wrap=True)
    whole = "The sample is" if found.samples == 1 else f"All {found.samples} samples are"
    screen.print(f"Written: {name}" if new else f"{whole} there: {name}", soft_wrap=True)
