"""``fctd equilibrium CASE``: the steady string of one operation and bit depth."""

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import typer

from fctd import plots
from fctd.case.errors import InputError
from fctd.case.friction import pairs_of
from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.message import Message
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.cli.job import Job, print_facts
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
    screen,
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
    file_option,
    print_segments,
    read_drive,
    read_kinds,
)
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.plots import DRAWN
from fctd.results.buckling import BUCKLED, NOT_BUCKLED
from fctd.results.columns import COLUMNS, LOADS, SHAPES, SHARES
from fctd.results.notes import as_metadata
from fctd.results.profile import place_in_words
from fctd.results.shown_tables import Fact, facts, of_column, short, text
from fctd.results.unit_systems import System, shown
from fctd.steady.equilibrium import equilibrium
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd


OPTION: Final = "--plot-feeding"
SLIDING: Final = " or ".join(kind for kind, of in KINDS.items() if of.direction > 0 and not of.turns)

PlotFeeding = Annotated[
    Path | None,
    file_option(OPTION, "Loads against feed, of a string fed from rest (solver.buckling=feed), .png, .svg or .pdf."),
]


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
    kinds = read_kinds(operations)
    if len(kinds) > 1:
        raise InputError("one kind of operation (fctd chart takes several)", key="--operation", value=operations)
    job = Job(
        case_file, overrides, friction, resolve_buckling, units=units, strict=strict, quiet=quiet, out=out, plot=plot,
        draws=True, files={OPTION: (plot_feeding, DRAWN)},
    )  # fmt: skip
    depth = bit_depth.depth(job.case, units)
    with naming_file(job.case):
        check_bit_depth(depth, *job.case.depths, "--bit-depth", bit_depth.text)
    drive = read_drive(speed, rpm, flow, units)
    check_feeding(plot_feeding, job.case, rates_of_all(job.case, kinds, **drive)[kinds[0]])
    job.warn(kinds, **drive)
    point = equilibrium(job.case, kinds[0], depth, **drive)
    lacking = not point.answered and (out is not None or plot is not None)

    def draw(path: Path) -> list[Path]:
        return draw_profiles(path, [point], units=units, force=side_force, warnings=job.told)

    job.end(
        {
            "--out": point.profile if point.answered else None, "--plot": draw if point.answered else None,
            OPTION: lambda path: draw_feeding(path, point, units, job.told),
        },
        lambda: _print(job, point, lacking=lacking), title=f"{job.case.name}: {kinds[0]}, bit at {job.depth(depth)}",
        rates=(kinds, drive), more=_about(point) if point.answered else None,
        acceptable=point.status.acceptable and not lacking, codes=(note.code for note in point.notes),
    )  # fmt: skip


def _about(point: Equilibrium) -> dict[str, Any]:
    """Metadata of a profile."""
    return {
        "bit_depth_m": point.bit_depth, "bit_md_m": float(point.profile["md_m"].iloc[-1]),
        "status": point.status, "message": point.message, **_loads(point),
        "buckling": str(point.buckling), "shape": point.shape, **_found(point), "notes": as_metadata(point.notes),
    }  # fmt: skip


def _loads(point: Equilibrium) -> dict[str, float]:
    """Loads of a steady string by column name."""
    return {load.name: load.value(point) for load in LOADS}


def _found(point: Equilibrium) -> dict[str, float]:
    """What was found of the shapes of a buckled string, by column name."""
    values = {column.name: column.value(point) for column in (*SHAPES, *SHARES)}
    return {name: value for name, value in values.items() if np.isfinite(value)}


def _print(job: Job, point: Equilibrium, *, lacking: bool) -> None:
    """Print the loads of a string, its extreme tension, side force and stress, and how it is buckled.

    lacking : whether a profile was asked for that there is not.
    """
    units, metre = job.units, shown("bit_depth_m", job.units)

    def fact(name: str, value: float, of: str = "", more: str = "") -> Fact:
        return f"{of}{COLUMNS[name].label}", of_column(name, value, units, 3), shown(name, units).label + more

    rows = [fact(name, value if point.answered else np.nan) for name, value in _loads(point).items()]
    if point.answered:
        profile = point.profile
        for name, worst in (("effective_tension_N", "min"), ("contact_force_N", "max"), ("von_mises_Pa", "max")):
            row = profile.loc[profile[name].agg(f"idx{worst}")]
            where = place_in_words(row["md_m"], point.bit_depth, metre.factor, metre.label)
            rows.append(fact(name, row[name], f"{worst}. ", f" at {where}"))
        rows += [
            (f"beyond {mode} limit", text(f"{first * metre.factor:.0f} to {last * metre.factor:.0f}"), metre.label)
            for mode in BUCKLED
            for first, last in stretches(profile, mode)
        ]
    rows += [("shape", text(point.shape), "")] * (point.shape != "none")
    rows += [
        (COLUMNS[name].label, short(100 * value, 3), "% of the friction")
        if COLUMNS[name] in SHARES else fact(name, value)
        for name, value in _found(point).items()
    ]  # fmt: skip
    print_facts(facts("", rows), pad_edge=True)
    screen.print(f"{point.status}, {point.iterations} iterations")
    if point.message:
        print_status(point.status, point.message, units)
    print_notes(point.notes, units)
    print_segments(job.case, point.bit_depth, units)
    if lacking:
        messages.print("No profile is written: no equilibrium was found.")


def stretches(profile: "pd.DataFrame", mode: str) -> list[tuple[float, float]]:
    """First and last depth [m] of every run of contact points beyond the buckling limit of a mode."""
    found = []
    for buckled, run in groupby(zip(profile["buckling"] == mode, profile["md_m"], strict=True), key=lambda row: row[0]):
        if buckled:
            depths = [float(md) for _, md in run]
            found.append((depths[0], depths[-1]))
    return found


def check_feeding(path: Path | None, case: Case, rates: SteadyRates) -> None:
    """Raise InputError where a picture of feeding cannot be written, before anything is computed.

    The block feeds a string that slides down without rotation, against friction, in a case that resolves buckling.
    """
    if path is None:
        return
    lacking = ""
    if rates.speed <= 0:
        lacking = f"a string that slides down without rotation ({SLIDING}), which the block feeds"
    elif rates.spin:
        lacking = "a string without rotation: one that turns is not fed from rest (--rpm 0)"
    elif not case.contact.enabled or not any(pair.along or pair.around for pair in pairs_of(case.wellbore.intervals)):
        lacking = "a hole with friction: a string that slides without it is not fed from rest"
    elif case.solver.buckling != "feed":
        lacking = 'solver.buckling = "feed" (--set solver.buckling=feed): else no string is fed from rest'
    if lacking:
        raise InputError(lacking, key=OPTION, value=path)


def draw_feeding(path: Path, point: Equilibrium, units: System, warnings: Sequence[str]) -> list[Path]:
    """Write the picture of a string that was fed; returns the file.  Raises InputError for one that was not."""
    if not point.fed:
        raise InputError(told(Message(_lacking(point)), units), key=OPTION, value=path)
    return plots.save(plots.feeding_figure(point, units, warnings=warnings), path)


def _lacking(point: Equilibrium) -> str:
    """What a string lacks that was not fed, and what to do."""
    if point.answered and point.buckling.mode == NOT_BUCKLED.mode:
        return (
            "a string that buckles, which alone is fed from rest: this one is compressed beyond no limit, so look at "
            "a larger weight on bit, more friction or a larger depth"
        )
    return (
        f"a string that was fed from rest: this one is {point.status} by another method, as its line above explains, "
        f"so try a larger solver.resolve_work (it is {point.case.solver.resolve_work:g}) or smaller loads"
    )
