"""``fctd refine CASE``: the number of segments that a tolerance needs, and the refined case."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from fctd import plots
from fctd.case.operations import KINDS
from fctd.cli.job import FOLD, WHOLE, Job, Written, headed, print_table, right, rows_of
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Quiet,
    Strict,
    Units,
    messages,
    print_notes,
    print_status,
    read_share,
    screen,
)
from fctd.cli.quantities import BIT_DEPTH, Given, quantity
from fctd.cli.steady import DEPTH_HELP, KIND_HELP, Flow, ResolveBuckling, Rpm, Speed, read_drive, read_kinds
from fctd.plots import DRAWN
from fctd.results.convergence import counts_in_words, orders_table
from fctd.results.shown_tables import Table, of_column, shown_table
from fctd.results.unit_systems import System, shown
from fctd.steady.refine import Refinement, refine
from fctd.steady.refined_file import survey_from, write_refined

if TYPE_CHECKING:
    import pandas as pd

RANGE = "10:1000"  # of counts, where only a picture is asked for


def refine_command(
    case_file: CaseFile,
    tolerance: Annotated[
        str, typer.Option("--tolerance", metavar="X", help="Relative error of hook load and torque, '1%' or 0.01.")
    ] = "1%",
    operations: Annotated[
        list[str],
        typer.Option("--operation", metavar="KIND", help=f"{KIND_HELP}; may be repeated; default: the case's first."),
    ] = [],  # noqa: B006 (typer copies it)
    bit_depth: Annotated[
        Given | None, quantity(BIT_DEPTH, "D", f"{DEPTH_HELP}; default: the end of that operation.")
    ] = None,
    graded: Annotated[
        bool, typer.Option("--graded", help="Short segments only in bends and near the bit, if that saves a tenth.")
    ] = False,
    most: Annotated[int, typer.Option("--most", metavar="N", help="Largest number of segments.")] = 5000,
    segments: Annotated[
        str | None,
        typer.Option(
            "--segments",
            metavar="FROM:TO",
            show_default=False,
            help=f"Observed order, extrapolated loads and errors over a range of counts, {RANGE} with --plot.",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", metavar="FILE", show_default=False, help=f"Errors against the counts, {', '.join(DRAWN)}."
        ),
    ] = None,
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="FILE", help="The case with the refined string and hole, .toml.", show_default=False
        ),
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Refine the segments of a case until hook load and torque no longer change, and estimate the remaining error."""
    share = read_share(tolerance, "--tolerance")
    job = Job(
        case_file, overrides, friction, resolve_buckling, units=units, strict=strict, quiet=quiet,
        files={"--out": (out, (".toml",)), "--plot": (plot, DRAWN)},
    )  # fmt: skip
    if plot is not None and segments is None:
        segments = RANGE
    if out is not None:
        survey_from(out, job.case)  # raises InputError before the computing
    depth = None if bit_depth is None else bit_depth.depth(job.case, units)
    drive = read_drive(speed, rpm, flow, units)
    kinds = read_kinds(operations) if operations else []
    job.warn(kinds, **drive)
    with job.status("compiling") as show:
        refined = refine(job.case, share, kinds or None, depth, graded, most, **drive, progress=show, segments=segments)
    found = refined.status.has_loads
    files: dict[str, Written] = {"--out": partial(write_refined, refined, case_file, job.changes) if found else None}
    if (orders := refined.orders) is not None:
        files["--plot"] = lambda path: plots.save(
            plots.counts_figure(job.case.name, refined.steps, orders, share), path
        )
    job.end(
        files,
        lambda: _print(job, refined, graded, lacking=out is not None and not found),
        title=f"{job.case.name}: bit at {job.depth(refined.bit_depth)}",
        rates=(refined.steps["operation"].unique().tolist(), drive), acceptable=refined.status.acceptable,
        codes=(note.code for note in refined.notes),
    )  # fmt: skip


def counts_parts(
    steps: "pd.DataFrame", orders: "pd.DataFrame", tolerance: float, units: System
) -> Iterator[Table | str]:
    """What is shown of a range of counts: every string, observed orders with extrapolated loads, counts that suffice.

    steps, orders, tolerance : of a ``Refinement`` with a range of counts.
    """
    steps = steps[steps["stage"] == "counts"]
    yield _levels(steps, units, layouts=True)
    for kind, rows in orders.groupby("operation", sort=False):
        yield KINDS[str(kind)].label
        yield orders_table(rows, tolerance, units)
    yield from counts_in_words(steps, orders, tolerance)


def _levels(steps: "pd.DataFrame", units: System, *, layouts: bool) -> Table:
    """A row for each level and operation; layouts : whether the layout of a string is named."""
    across = shown("clearance_m", units)
    loads = headed({"hookload_N": "hook load", "surface_torque_N_m": "torque"}, units)
    told: list[list[Any]] = []
    for (stage, layout, _), rows in steps.groupby(["stage", "layout", "level"], sort=False):
        chord, segments = rows["chord_m"].iloc[0] * across.factor, rows["segments"].iloc[0]
        string = f"{segments} {layout}" if layouts else f"{segments} segments"
        name = f"chords {chord:.3g} {across.label}" if stage == "hole" else string
        for row in rows_of(rows):
            answer = (
                of_column("hookload_N", row["hookload_N"], units, 2),
                of_column("surface_torque_N_m", row["surface_torque_N_m"], units, 3),
                _percent(np.maximum(row["hookload_change"], row["torque_change"])),
                _percent(np.maximum(row["hookload_error"], row["torque_error"])),
            )
            told.append([
                name, row["operation"] + (" (locked up)" if row["status"] == "locked_up" else ""),
                *((None, None, "no answer", None) if np.isnan(row["hookload_N"]) else answer),
                f"{1e3 * row['time_s']:.0f}",
            ])  # fmt: skip
            name = ""
    return shown_table(["", "operation", *loads, *right("change\n%", "error\n%", "time\nms")], told)


def _print(job: Job, refined: Refinement, graded: bool, *, lacking: bool) -> None:
    """Print every level and the conclusion; name the layout of a string only where both were tried.

    lacking : whether a file was asked for, and there is nothing to write.
    """
    metre = shown("bit_depth_m", job.units)
    levels = refined.steps[refined.steps["stage"] != "counts"]
    print_table(_levels(levels, job.units, layouts=graded), words=WHOLE, numbers=FOLD)
    if refined.status.acceptable:
        cut = f"{refined.layout} segments" if graded else "segments"
        job.say(
            f"{refined.segments} {cut}, from {refined.shortest * metre.factor:.3g} {metre.label} up: the error is "
            f"{_percent(refined.error)} %, the tolerance {_percent(refined.tolerance)} %."
        )
        if graded and refined.layout == "uniform":
            job.say("A graded layout would save less than a tenth of the segments.")
    else:
        print_status(refined.status, refined.message, job.units)
    if refined.resolved:
        job.say(
            "The string is buckled. Its buckled stretch has segments that can bend as it does (solver.buckling = "
            f'"resolve"), {refined.resolved} in all; the loads depend on the length of the others alone.'
        )
    if refined.orders is not None:
        for part in counts_parts(refined.steps, refined.orders, refined.tolerance, job.units):
            if isinstance(part, str):
                screen.print(part, soft_wrap=True)
            else:
                print_table(part, words=WHOLE, numbers=FOLD)
    print_notes(refined.notes, job.units)
    if lacking:
        messages.print("Nothing is written: no equilibrium was found.")


def _percent(share: float) -> str:
    return "–" if not np.isfinite(share) else f"{100 * share:.2g}"
