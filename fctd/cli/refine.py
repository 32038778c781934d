"""``fctd refine CASE``: the number of segments that a tolerance needs, and the refined case."""

from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from fctd.cli.job import FOLD, WHOLE, Job, headed, print_table, right, rows_of
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
)
from fctd.cli.quantities import BIT_DEPTH, Given, quantity
from fctd.cli.steady import DEPTH_HELP, KIND_HELP, Flow, ResolveBuckling, Rpm, Speed, read_drive, read_kinds
from fctd.results.shown_tables import of_column, shown_table
from fctd.results.unit_systems import shown
from fctd.steady.refine import Refinement, refine
from fctd.steady.refined_file import survey_from, write_refined


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
        files={"--out": (out, (".toml",))},
    )  # fmt: skip
    if out is not None:
        survey_from(out, job.case)  # raises InputError before the computing
    depth = None if bit_depth is None else bit_depth.depth(job.case, units)
    drive = read_drive(speed, rpm, flow, units)
    kinds = read_kinds(operations) if operations else []
    job.warn(kinds, **drive)
    with job.status("compiling") as show:
        refined = refine(job.case, share, kinds or None, depth, graded, most, **drive, progress=show)
    found = refined.status.has_loads
    job.end(
        {"--out": partial(write_refined, refined, case_file, job.changes) if found else None},
        lambda: _print(job, refined, graded, lacking=out is not None and not found),
        title=f"{job.case.name}: bit at {job.depth(refined.bit_depth)}",
        rates=(refined.steps["operation"].unique().tolist(), drive), acceptable=refined.status.acceptable,
        codes=(note.code for note in refined.notes),
    )  # fmt: skip


def _print(job: Job, refined: Refinement, graded: bool, *, lacking: bool) -> None:
    """Print every level and the conclusion; name the layout of a string only where both were tried.

    lacking : whether a file was asked for, and there is nothing to write.
    """
    units, metre, across = job.units, shown("bit_depth_m", job.units), shown("clearance_m", job.units)
    loads = headed({"hookload_N": "hook load", "surface_torque_N_m": "torque"}, units)
    told: list[list[Any]] = []
    for (stage, layout, _), rows in refined.steps.groupby(["stage", "layout", "level"], sort=False):
        chord, segments = rows["chord_m"].iloc[0] * across.factor, rows["segments"].iloc[0]
        string = f"{segments} {layout}" if graded else f"{segments} segments"
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
    print_table(
        shown_table(["", "operation", *loads, *right("change\n%", "error\n%", "time\nms")], told),
        words=WHOLE,
        numbers=FOLD,
    )
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
    print_notes(refined.notes, job.units)
    if lacking:
        messages.print("Nothing is written: no equilibrium was found.")


def _percent(share: float) -> str:
    return "–" if not np.isfinite(share) else f"{100 * share:.2g}"
