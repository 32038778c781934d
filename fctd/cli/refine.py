"""``fctd refine CASE``: the number of segments that a tolerance needs, and the refined case."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.doubts import warnings_of
from fctd.case.text import printable
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    check_target,
    finish,
    messages,
    print_notes,
    print_status,
    print_written,
    read_case,
    read_share,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.quantities import BIT_DEPTH, Given, quantity
from fctd.cli.steady import DEPTH_HELP, KIND_HELP, Flow, ResolveBuckling, Rpm, Speed, read_drive, read_kinds
from fctd.results.unit_systems import System, shown
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
    check_target(out, "--out", (".toml",))
    share = read_share(tolerance, "--tolerance")
    changes = changes_of(overrides, friction, resolve_buckling)
    case = read_case(case_file, changes)
    refuse_sources(case, out, "--out")
    if out is not None:
        survey_from(out, case)  # raises InputError before the computing
    depth = None if bit_depth is None else bit_depth.depth(case, units)
    drive = read_drive(speed, rpm, flow, units)
    kinds = read_kinds(operations) if operations else []
    tell(case, warnings_of(case, kinds, **drive), strict=strict, units=units)
    with messages.status("compiling") as status:
        if quiet:
            status.stop()
        refined = refine(case, share, kinds or None, depth, graded, most, **drive, progress=status.update)
    target = out if refined.status.has_loads else None
    try:  # written before anything is printed, as the terminal may be closed; printed also where writing fails
        if target is not None:
            write_refined(refined, case_file, changes, target)
    finally:
        _print(refined, graded, units)
    if target is not None:
        print_written([target])
    elif out is not None:
        messages.print("Nothing is written: no equilibrium was found.")
    finish(refined.status.acceptable, (note.code for note in refined.notes), strict)


def _print(refined: Refinement, graded: bool, units: System) -> None:
    """Print every level and the conclusion; name the layout of a string only where both were tried."""
    metre, load, torque = (shown(name, units) for name in ("bit_depth_m", "hookload_N", "surface_torque_N_m"))
    title = f"{printable(refined.case.name)}: bit at {refined.bit_depth * metre.factor:.1f} {metre.label}"
    screen.print(title, style="bold")
    numbers = f"hook load\n{load.label}", f"torque\n{torque.label}", "change\n%", "error\n%", "time\nms"
    table = Table(
        Column("", no_wrap=True), Column("operation", no_wrap=True),
        *(Column(heading, justify="right", overflow="fold") for heading in numbers),
        box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False,
    )  # fmt: skip
    across = shown("clearance_m", units)
    for (stage, layout, _), rows in refined.steps.groupby(["stage", "layout", "level"], sort=False):
        chord, segments = rows["chord_m"].iloc[0] * across.factor, rows["segments"].iloc[0]
        string = f"{segments} {layout}" if graded else f"{segments} segments"
        name = f"chords {chord:.3g} {across.label}" if stage == "hole" else string
        for row in rows.to_dict("records"):
            answer = (
                f"{row['hookload_N'] * load.factor:z.2f}",
                f"{row['surface_torque_N_m'] * torque.factor:z.3f}",
                _percent(np.maximum(row["hookload_change"], row["torque_change"])),
                _percent(np.maximum(row["hookload_error"], row["torque_error"])),
            )
            nothing = ("–", "–", "no answer", "–")
            loads = nothing if np.isnan(row["hookload_N"]) else answer
            kind = row["operation"] + (" (locked up)" if row["status"] == "locked_up" else "")
            table.add_row(name, kind, *loads, f"{1e3 * row['time_s']:.0f}")
            name = ""
    screen.print(table)
    if refined.status.acceptable:
        cut = f"{refined.layout} segments" if graded else "segments"
        screen.print(
            f"{refined.segments} {cut}, from {refined.shortest * metre.factor:.3g} {metre.label} up: the error is "
            f"{_percent(refined.error)} %, the tolerance {_percent(refined.tolerance)} %.",
            soft_wrap=True,
        )  # fmt: skip
        if graded and refined.layout == "uniform":
            screen.print("A graded layout would save less than a tenth of the segments.", soft_wrap=True)
    else:
        print_status(refined.status, refined.message, units)
    if refined.resolved:
        screen.print(
            "The string is buckled. Its buckled stretch has segments that can bend as it does (solver.buckling = "
            f'"resolve"), {refined.resolved} in all; the loads depend on the length of the others alone.',
            soft_wrap=True,
        )  # fmt: skip
    print_notes(refined.notes, units)


def _percent(share: float) -> str:
    return "–" if not np.isfinite(share) else f"{100 * share:.2g}"
