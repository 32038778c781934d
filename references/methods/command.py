"""``python -m references methods CASE``: contact methods and engines compared on any well."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from fctd import plots
from fctd.arena.result import Comparison
from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.cli.interrupts import deferred
from fctd.cli.options import (
    FAILED,
    INTERRUPTED,
    CaseFile,
    Friction,
    Overrides,
    Quiet,
    changes_of,
    check_target,
    messages,
    print_written,
    read_case,
    refuse_sources,
)
from fctd.cli.pictures import check_files
from fctd.plots import DRAWN
from fctd.results.table_files import write_table
from fctd.store.whole_file import whole_file
from references.methods.asked import ALL
from references.methods.compare import BUDGET, compare_methods
from references.methods.tables import counts_of, print_comparison

TABLES = (".csv", ".parquet", ".json")


def methods_command(
    case_file: CaseFile,
    contact: Annotated[
        list[str],
        typer.Option("--contact", metavar="NAME[,KEY=VALUE…]", help="A contact method; default: all installed."),
    ] = [],  # noqa: B006 (typer copies it)
    engine: Annotated[
        list[str], typer.Option("--engine", metavar="NAME[,KEY=VALUE…]", help="An engine, or all installed: all.")
    ] = [],  # noqa: B006
    operation: Annotated[
        str | None, typer.Option("--operation", help="Its number in the case, or its kind; default: the first.")
    ] = None,
    budget: Annotated[
        float, typer.Option("--budget", min=1.0, help="Wall-clock time in s: what does not fit has no loads.")
    ] = BUDGET,
    quick: Annotated[
        bool, typer.Option("--quick", help="A first look, within a minute: no loads of meshes, no memory.")
    ] = False,
    segments: Annotated[
        str | None,
        typer.Option("--segments", metavar="FROM:TO", help="Also loads over a range of counts of segments: 10:1000."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", metavar="FILE", help=f"The table, {', '.join(TABLES)}.")] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", metavar="FILE", help="Cost against error, and forces along the string.")
    ] = None,
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
    quiet: Quiet = False,
) -> None:
    """Compare contact methods and engines on the hole, string and operation of a case.

    Exit code 1 where something that was asked for failed; its row says why.
    """
    check_target(out, "--out", TABLES)
    check_files({"--plot": (plot, DRAWN)})
    case = read_case(case_file, changes_of(overrides, friction))
    for path, key in ((out, "--out"), (plot, "--plot")):
        refuse_sources(case, path, key)
    columns = TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=messages, disable=quiet, transient=True) as bar:
        task = bar.add_task("", total=None)

        def show(what: str, done: float, total: float) -> None:
            bar.update(task, description=printable(what), completed=done, total=total)

        found = compare_methods(
            case, contact or [ALL], engine, operation=operation, budget=budget, quick=quick, segments=segments,
            progress=show,
        )  # fmt: skip
    written: list[Path] = []
    try:
        with deferred():
            written += write(found, out) if out is not None else []
            if plot is not None:
                from fctd.plots.methods import methods_figure

                written += plots.save(methods_figure(found, case.system), plot)
                if (counts := found.counts) is not None:
                    figure = plots.counts_figure(found.case, *counts_of(counts), counts.tolerance)
                    written += plots.save(figure, plot.with_stem(f"{plot.stem}_segments"))
    finally:
        print_comparison(found, case.system)
    print_written(written)
    if found.interrupted:
        raise typer.Exit(INTERRUPTED)
    if not found.sound:
        raise typer.Exit(FAILED)


def write(found: Comparison, path: Path) -> list[Path]:
    """Write a comparison: all of it as JSON, else a table of its rows; returns the files.

    Raises InputError where they cannot be written.
    """
    if path.suffix.lower() not in TABLES:
        raise InputError(f"a file name that ends in {' or '.join(TABLES)}", key="--out", value=path)
    if path.suffix.lower() == ".json":
        with whole_file(path) as scratch:
            scratch.write_text(found.model_dump_json(indent=1), encoding="utf-8")
        return [path]
    about: Mapping[str, Any] = found.model_dump(mode="json", exclude={"rows", "md_m"})
    return write_table(found.flat(), path, about)
