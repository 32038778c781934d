"""``fctd equilibrium CASE``: the steady string of one operation and bit depth."""

from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.table import Table

from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.load import check_bit_depth, naming_file
from fctd.case.text import printable
from fctd.cli.feeding import OPTION, PlotFeeding, check_feeding, check_feeding_file, draw_feeding
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    finish,
    messages,
    print_notes,
    print_status,
    print_written,
    read_case,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.pictures import PICTURE_HELP, ShownSideForce, draw_profiles
from fctd.cli.quantities import BIT_DEPTH, Given, quantity
from fctd.cli.steady import (
    DEPTH_HELP,
    KIND_HELP,
    Flow,
    ResolveBuckling,
    Rpm,
    Speed,
    check_targets,
    file_option,
    in_units,
    metadata_of,
    print_segments,
    read_drive,
    read_kinds,
)
from fctd.model.operations import rates_of_all
from fctd.results.buckling import BUCKLED
from fctd.results.columns import COLUMNS, LOADS, SHAPES, SHARES
from fctd.results.notes import as_metadata
from fctd.results.profile import place_in_words
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, shown
from fctd.steady.equilibrium import equilibrium
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd


def equilibrium_command(
    case_file: CaseFile,
    operations: Annotated[list[str], typer.Option("--operation", metavar="KIND", help=f"{KIND_HELP}.")],
    bit_depth: Annotated[Given, quantity(BIT_DEPTH, "D", f"{DEPTH_HELP}.")],
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    out: Annotated[
        Path | None, file_option("--out", "Profile of the string, .csv, .parquet or .xlsx, or its picture.")
    ] = None,
    plot: Annotated[Path | None, file_option("--plot", f"Picture of the profile, {PICTURE_HELP}.")] = None,
    plot_feeding: PlotFeeding = None,
    side_force: ShownSideForce = "length",
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Solve the steady string of one operation and bit depth: its loads, and its profile from top to bit."""
    check_feeding_file(plot_feeding)
    out, plot = check_targets(out, plot, {OPTION: plot_feeding})
    kinds = read_kinds(operations)
    if len(kinds) > 1:
        raise InputError("one kind of operation (fctd chart takes several)", key="--operation", value=operations)
    (operation,) = kinds
    case = read_case(case_file, changes_of(overrides, friction, resolve_buckling))
    refuse_sources(case, out, "--out")
    refuse_sources(case, plot, "--plot")
    depth = bit_depth.depth(case, units)
    with naming_file(case):
        check_bit_depth(depth, *case.depths, "--bit-depth", bit_depth.text)
    drive = read_drive(speed, rpm, flow, units)
    check_feeding(plot_feeding, case, rates_of_all(case, [operation], **drive)[operation])
    warnings = warnings_of(case, [operation], **drive)
    told = tell(case, warnings, strict=strict, units=units)
    point = equilibrium(case, operation, depth, **drive)
    written = []
    try:  # written before anything is printed, as the terminal may be closed; printed also where writing fails
        if point.answered and out is not None:
            metadata = metadata_of(case, units, [operation], drive, warnings)
            metadata |= {"bit_depth_m": depth, "bit_md_m": float(point.profile["md_m"].iloc[-1])}
            metadata |= {"status": point.status, "message": point.message} | _loads(point)
            metadata |= {"buckling": str(point.buckling), "shape": point.shape}
            metadata |= _found(point) | {"notes": as_metadata(point.notes)}
            written += write_table(in_units(units, point.profile), out, metadata)
        if point.answered and plot is not None:
            written += draw_profiles(plot, [point], units=units, force=side_force, warnings=told)
        if plot_feeding is not None:
            written += draw_feeding(plot_feeding, point, units, told)
    finally:
        _print_point(point, units)
        print_segments(case, depth, units)
    lacking = not point.answered and (out is not None or plot is not None)
    if lacking:
        messages.print("No profile is written: no equilibrium was found.")
    print_written(written)
    finish(point.status.acceptable and not lacking, (note.code for note in point.notes), strict)


def _loads(point: Equilibrium) -> dict[str, float]:
    """Loads of a steady string by column name."""
    return {load.name: load.value(point) for load in LOADS}


def _found(point: Equilibrium) -> dict[str, float]:
    """What was found of the shapes of a buckled string, by column name."""
    values = {column.name: column.value(point) for column in (*SHAPES, *SHARES)}
    return {name: value for name, value in values.items() if np.isfinite(value)}


def _print_point(point: Equilibrium, units: System) -> None:
    """Print the loads of a string, its extreme tension, side force and stress, and how it is buckled."""
    metre = shown("bit_depth_m", units)
    depth = f"{point.bit_depth * metre.factor:.1f} {metre.label}"
    screen.print(f"{printable(point.case.name)}: {point.operation}, bit at {depth}", style="bold")
    table = Table(box=SIMPLE_HEAD, show_header=False)
    for name, value in _loads(point).items():
        unit = shown(name, units)
        text = f"{value * unit.factor:z.3f}" if point.answered else "–"
        table.add_row(COLUMNS[name].label, text, unit.label)
    if point.answered:
        profile = point.profile
        for name, worst in (("effective_tension_N", "min"), ("contact_force_N", "max"), ("von_mises_Pa", "max")):
            unit, row = shown(name, units), profile.loc[profile[name].agg(f"idx{worst}")]
            where = f"at {place_in_words(row['md_m'], point.bit_depth, metre.factor, metre.label)}"
            table.add_row(f"{worst}. {COLUMNS[name].label}", f"{row[name] * unit.factor:z.3f}", f"{unit.label} {where}")
        for mode in BUCKLED:
            for first, last in stretches(profile, mode):
                where = f"{first * metre.factor:.0f} to {last * metre.factor:.0f}"
                table.add_row(f"beyond {mode} limit", where, metre.label)
    if point.shape != "none":
        table.add_row("shape", point.shape, "")
    for name, value in _found(point).items():
        if COLUMNS[name] in SHARES:
            table.add_row(COLUMNS[name].label, f"{100 * value:.3g}", "% of the friction")
        else:
            unit = shown(name, units)
            table.add_row(COLUMNS[name].label, f"{value * unit.factor:z.3f}", unit.label)
    table.columns[1].justify = "right"
    screen.print(table)
    screen.print(f"{point.status}, {point.iterations} iterations")
    if point.message:
        print_status(point.status, point.message, units)
    print_notes(point.notes, units)


def stretches(profile: "pd.DataFrame", mode: str) -> list[tuple[float, float]]:
    """First and last depth [m] of every run of contact points beyond the buckling limit of a mode."""
    found = []
    for buckled, run in groupby(zip(profile["buckling"] == mode, profile["md_m"], strict=True), key=lambda row: row[0]):
        if buckled:
            depths = [float(md) for _, md in run]
            found.append((depths[0], depths[-1]))
    return found
