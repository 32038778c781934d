"""``fctd simulate CASE``: run the operations of a case in time."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Final
from uuid import uuid4

import numpy as np
import typer
from rich.box import HEAVY_HEAD
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from fctd import plots
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.text import counted, file_name, printable
from fctd.cli.interrupts import deferred
from fctd.cli.job import print_table, right
from fctd.cli.keeping import (
    EVERY_RUN,
    OptionalCase,
    SaveOptions,
    begun_folder,
    case_of,
    description_of,
    resumed_folder,
    say_how_to_go_on,
)
from fctd.cli.option_classes import beside, to_keep, with_options
from fctd.cli.options import (
    INTERRUPTED,
    Csv,
    Friction,
    Out,
    Overrides,
    Quiet,
    Strict,
    changes_of,
    finish,
    messages,
    print_notes,
    print_status,
    print_written,
    read_case,
    refuse_source_files,
    refuse_sources,
    screen,
    tell,
    units_option,
)
from fctd.cli.pictures import check_files
from fctd.plots import DRAWN
from fctd.results.buckling import MODES
from fctd.results.columns import BUCKLED, COLUMNS
from fctd.results.shown_tables import of_column, shown_table
from fctd.results.status import RunStatus
from fctd.results.swings import ENOUGH_PERIODS
from fctd.results.tables import SimulationResult, check_result_folder, identity_of, own_files, result_files
from fctd.results.unit_systems import System, digits_of, in_words, shown
from fctd.simulation.external_contact import WallQuery
from fctd.simulation.preparation import LONGEST_SETTLING
from fctd.simulation.run_saver import RunSaver
from fctd.simulation.simulate import simulate
from fctd.store.run_folder import RunFolder
from fctd.store.whole_file import writing

ShownUnits = Annotated[System, units_option("Units of screen and CSV files; the Parquet files are in SI units")]

# Of a table of loads.
BOXED: Final[dict[str, Any]] = {"box": HEAVY_HEAD, "collapse_padding": False, "pad_edge": True}


@with_options
def simulate_command(
    case_file: OptionalCase = None,
    out: Out = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    csv: Csv = False,
    units: ShownUnits = "si",
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", metavar="FILE", help="Picture of the run over time, .png, .svg or .pdf.", show_default=False
        ),
    ] = None,
    *,
    keeping: SaveOptions,
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Run the operations of a case and write its tables: history, profile, energy, operations, segments."""
    simulate_file(case_file, out, overrides, friction, RunOutput(csv, units, plot, strict, quiet), keeping=keeping)


@dataclass(frozen=True)
class RunOutput:
    """What is written and printed beside the tables; the options of ``simulate_command``."""

    csv: bool = False
    units: System = "si"
    plot: Path | None = None
    strict: bool = False
    quiet: bool = False


def simulate_file(
    case_file: Path | None,
    out: Path | None,
    overrides: list[str],
    friction: str | None,
    shown: RunOutput,
    contact: Callable[[Case], WallQuery] | None = None,
    *,
    keeping: SaveOptions,
    program: str = "fctd simulate",
    more: Mapping[str, Any] | None = None,
) -> None:
    """Run ``fctd simulate``; ``contact`` builds another contact method for the case (see fctd.simulate).

    program : that goes on with the run; more : its own options, which it finds with the run.
    """
    given = {"CASE": case_file, "--out": out, "--set": overrides or None, "--friction": friction}
    keeping.check(given)
    check_files({"--plot": (shown.plot, DRAWN)})
    if keeping.resume is not None:
        folder = keeping.resume
        with resumed_folder(folder, program, accept_changes=keeping.accept_changes) as (kept, about):
            case, shown = case_of(kept.path, about), beside(shown, about["options"])
            check_result_folder(folder, shown.csv, "--resume")
            method = None if contact is None else contact(case)
            _compute(case, folder, method, shown, keeping, kept, about["identity"])
        return
    if case_file is None:
        raise InputError("a case file, or --resume with an unfinished result", key="CASE")
    case = read_case(case_file, changes_of(overrides, friction))
    refuse_sources(case, shown.plot, "--plot")
    tell(case, case.warnings, strict=shown.strict, units=shown.units)
    method = None if contact is None else contact(case)
    folder = out or Path(file_name(case.name, "-result"))
    check_result_folder(folder, shown.csv, "--out")  # before hours of computing
    refuse_source_files(case, (folder / name for name in own_files(folder).union(result_files(shown.csv))), "--out")
    with begun_folder(folder, "--out", restart=keeping.restart) as kept:
        identity = uuid4().hex
        options = to_keep(shown, shown.units) | dict(more or {})
        described = description_of(case, program, "simulate", options, identity)
        with writing(kept.path):
            kept.describe(*described)
        _compute(case, folder, method, shown, keeping, kept, identity)


def _compute(
    case: Case,
    folder: Path,
    method: WallQuery | None,
    shown: RunOutput,
    keeping: SaveOptions,
    kept: RunFolder,
    identity: str,
) -> None:
    """Run a case, which is kept meanwhile, write its result and print what there is to say."""
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.completed:.0f}/{task.total:.0f} s simulated, {task.fields[factor]} × real time"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    key = "--out" if keeping.resume is None else "--resume"
    checkpointer = RunSaver(kept, keeping.interval(EVERY_RUN), csv=shown.csv, key=key, tell=_tell)
    limits = keeping.limits
    result, written, ended, unfinished = None, [], False, True
    try:
        with Progress(*columns, console=messages, disable=shown.quiet, transient=True) as bar:
            task = bar.add_task("compiling, settling", total=1.0, factor="–")

            def settling(now: float, imbalance: float) -> None:
                text = f"settling, forces out of balance by {imbalance:.0e} of the weight"
                bar.update(task, description=text, total=LONGEST_SETTLING, completed=now)
                limits.check()

            def show(now: float, total: float, factor: float) -> None:
                bar.update(task, description=printable(case.name), total=total, completed=now, factor=f"{factor:.0f}")
                limits.check()

            result = simulate(case, progress=show, contact=method, settling=settling, checkpointer=checkpointer)
            ended = result.status not in (RunStatus.INTERRUPTED, RunStatus.STOPPED)
            # The files are written before anything is printed: the terminal may have been closed.
            with deferred():
                # A part of a run does not take the place of another run's result.
                if ended or (len(result.history) and identity_of(folder) in ("", identity)):
                    whole = replace(result, identity=identity)
                    written = whole.save(folder, csv=shown.csv, units=shown.units)
                    if shown.plot is not None and len(result.history):
                        written += plots.save(plots.run_figure(result, shown.units), shown.plot)
                if ended:
                    kept.clear()
                    unfinished = False
    finally:  # printed also where a file cannot be written, or a signal came meanwhile
        if result is not None:
            _summarise(result, shown.units)
            print_written(written)
            if not ended and not written and identity_of(folder):
                _tell(f"the earlier result in {printable(str(folder))} stays as it was")
        if unfinished:
            say_how_to_go_on(folder)
    if result.status is RunStatus.INTERRUPTED:
        raise typer.Exit(INTERRUPTED)
    finish(result.status.acceptable, (note.code for note in result.notes), shown.strict)


def _tell(text: str) -> None:
    messages.print(text, soft_wrap=True)


def _summarise(result: SimulationResult, units: System) -> None:
    """Print the loads at the end, and the size, speed and energy error of the run."""
    if result.message and not result.status.acceptable:
        print_status(result.status, result.message, units)
    print_notes((note for note in result.notes if str(note) != result.message or result.status.acceptable), units)
    if len(result.history):
        last, depth = result.history.iloc[-1], shown("bit_depth_m", units)
        at = f"{last['bit_depth_m'] * depth.factor:.1f} {depth.label}"
        loads = ("hookload_N", "surface_torque_N_m", "sum_r_mu_fn_N_m", "total_contact_force_N")
        heads = right(*(f"{COLUMNS[name].label} {shown(name, units).label}" for name in loads), "contacts")
        cells = [of_column(name, last[name], units) for name in loads]
        title = f"{printable(result.case.name)}: {last['operation']}, bit at {at}"
        print_table(shown_table(heads, [[*cells, last["contact_count"]]]), title=title, **BOXED)
        buckled = result.history[result.history["buckling"] != "none"]
        if len(buckled):
            first, last = (buckled[column.name].agg(how) for column, how in zip(BUCKLED, ("min", "max"), strict=True))
            mode = max(buckled["buckling"], key=MODES.index)
            where = f"between {first * depth.factor:.0f} and {last * depth.factor:.0f} {depth.label}"
            screen.print(f"buckled in {len(buckled)} of {len(result.history)} records, at worst {mode}, {where}")
    _print_operations(result, units)
    run = result.run
    parts = [
        f"{counted(run['segments'], 'segment')}, step {1e3 * run['step_s']:.3g} ms, {counted(run['steps'], 'step')}",
        f"{run['simulated_s']:.0f} s simulated in {run['wall_s']:.2f} s",
    ]
    # A run that did not settle has no speed, and one that ended before any work was done no energy error.
    if np.isfinite(run["real_time_factor"]):
        parts[-1] += f" ({run['real_time_factor']:.0f} × real time)"
    if np.isfinite(run["energy_error"]):
        parts.append(f"energy error {run['energy_error']:.1e}")
    screen.print(", ".join(parts), soft_wrap=True)


def _print_operations(result: SimulationResult, units: System) -> None:
    """Print mean and swing of hook load and torque of every operation, and the time for which the bit stood still."""
    if not len(result.operations):
        return
    rows, short = [], []
    for row in result.operations.to_dict("records"):
        turns = row["bit_still_share"] >= 0
        names = [row["operation"], f"{row['start_s']:.0f} to {row['end_s']:.0f} s"]
        if turns:
            names[1] += f", bit at rest {100 * row['bit_still_share']:.0f} %"
        for name, column in zip(names, ("hookload_N", "surface_torque_N_m"), strict=True):
            unit, digits, stem = shown(column, units), digits_of(column, units), COLUMNS[column].stem
            mean, swing, peak = (
                row[column.replace(stem, f"{stem}_{part}")] * unit.factor for part in ("mean", "swing", "peak")
            )
            periods = row[f"{stem}_periods"]
            rows.append([
                name, f"{COLUMNS[column].heading} {unit.label}", f"{mean:z.{digits}f} ± {swing:z.{digits}f}",
                f"{peak:z.{digits}f}", f"{periods} × {row[f'{stem}_period_s']:.3g} s",
            ])  # fmt: skip
            if periods < ENOUGH_PERIODS and (turns or column == "hookload_N"):
                short.append(f"{row['operation']} ({COLUMNS[column].label})")
    table = shown_table(["operation", "load", *right("mean ± swing", "peak", "periods")], rows)
    print_table(table, title="mean ± swing over whole periods, peak of the whole operation", **BOXED)
    if weight := result.case.rig.block_weight:
        block = in_words(weight, "hookload_N", units)
        screen.print(f"hook load: of the string alone; the block adds {block} to the indicator", soft_wrap=True)
    if short:
        text = (
            f"means over less than {ENOUGH_PERIODS} whole periods: {', '.join(short)}; let these operations last longer"
        )
        screen.print(text, soft_wrap=True)
