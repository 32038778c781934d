"""``fctd calibrate CASE MEASURED.csv``: unknowns of a case from measured rows."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd
import typer
from rich.markup import escape

from fctd import plots
from fctd.calibration.calibrate import Order, calibrate
from fctd.calibration.calibrated_file import write_calibrated
from fctd.calibration.fit import Loss
from fctd.calibration.predict import coverage, posterior_file
from fctd.calibration.result import Calibration
from fctd.calibration.unknowns import NAMES
from fctd.case.message import Message, within
from fctd.case.systems import told
from fctd.case.text import counted, printable
from fctd.cli.job import FOLD, Job, print_table, right, rows_of
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Quiet,
    Strict,
    check_target,
    messages,
    refuse_sources,
    screen,
    units_option,
    warn,
)
from fctd.cli.pictures import TABLES
from fctd.cli.steady import file_option, metadata_of_case
from fctd.plots import DRAWN
from fctd.results.doing import clauses
from fctd.results.shown_tables import Head, shown_table
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, in_words, shown_unit

# Mean square of the residuals over the noise, by degree of freedom, beyond which the intervals are doubtful.
MISFIT = 2.0
LOADS = {"hookload": "N", "torque": "N*m"}
_MOST_ROWS = 3  # that are named beside a friction factor
Units = Annotated[
    System, units_option("Units of screen and picture, and of rows that name none; files are in SI units")
]


def calibrate_command(
    case_file: CaseFile,
    measured: Annotated[
        Path, typer.Argument(metavar="MEASURED", help="Measured rows, .csv or .xlsx.", show_default=False)
    ],
    fits: Annotated[
        list[str],
        typer.Option(
            "--fit",
            metavar="NAME[=LOW:HIGH]",
            help=f"An unknown, with bounds; may be repeated: {escape(', '.join(NAMES))}.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    priors: Annotated[
        list[str], typer.Option("--prior", metavar="NAME=MEAN+-SD", help="What is known before; may be repeated.")
    ] = [],  # noqa: B006
    setup: Annotated[
        Path | None, file_option("--setup", "Unknowns, sources, override sets and model error, .toml.")
    ] = None,
    order: Annotated[
        Order, typer.Option("--order", help="Fit all rows, or those of the first hole section and predict the deeper.")
    ] = "all",
    loss: Annotated[Loss, typer.Option("--loss", help="Loss of a residual: robust, or its square.")] = "soft_l1",
    starts: Annotated[int, typer.Option("--starts", metavar="N", help="Number of starts of the search.")] = 4,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Seed of the starts.")] = 0,
    scatter: Annotated[
        bool | None,
        typer.Option(
            "--scatter/--no-scatter",
            help="Whether friction and weight differ from day to day; default: where rows name their days.",
            show_default=False,
        ),
    ] = None,
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
    out: Annotated[
        Path | None, file_option("--out", "The calibrated case, .toml, and beside it its posterior, .fit.json.")
    ] = None,
    table: Annotated[Path | None, file_option("--table", "Residuals of the rows, .csv, .parquet or .xlsx.")] = None,
    plot: Annotated[
        Path | None, file_option("--plot", "Measured and fitted readings, residuals, correlations.")
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Find friction, constants of the rig and unknown masses from measured hook loads and torques."""
    job = Job(
        case_file, overrides, friction, units=units, strict=strict, quiet=quiet, reads=[measured, setup],
        files={"--out": (out, (".toml",)), "--table": (table, TABLES), "--plot": (plot, DRAWN)},
    )  # fmt: skip
    if out is not None:
        check_target(posterior_file(out), "--out", (".json",))
        refuse_sources(job.case, posterior_file(out), "--out", [measured, setup])
    job.warn()
    with job.status("fitting") as show:
        doing = "fitting"
        found = calibrate(
            job.case, measured, fits, priors=priors, setup=setup, loss=loss, order=order, starts=starts, seed=seed,
            overrides=job.changes, scatter=scatter, units=units, tell=partial(warn, measured),
            progress=lambda solved: show(f"{doing}: {counted(solved, 'string')} solved"),
        )  # fmt: skip
        doing = "intervals"
        _ = found.intervals
        doing = "leaving out each row"
        _ = found.leave_one_out
    notes = [*notes_of(found)]

    def write(path: Path) -> list[Path]:
        more = {"notes": [sentence for _, sentence in notes]}
        return write_table(found.residuals, path, metadata_of_case(found.case, job.warnings[job.case.name]) | more)

    job.end(
        {
            "--out": partial(write_calibrated, found, case_file, job.changes),
            "--table": write,
            "--plot": lambda path: plots.save(plots.calibration_figure(found, units), path),
        },
        lambda: print_calibration(found, units), codes=[code for code, _ in notes],
        title=f"{found.base.name}: {counted(len(found.fit.used), 'row')} fitted",
    )  # fmt: skip


def notes_of(found: Calibration) -> Iterator[tuple[str, str]]:
    """What is to be known of a fit: the code of each note, and a sentence in SI."""
    if found.misfit > MISFIT:
        yield (
            "misfit",
            (
                f"warning: the residuals are {np.sqrt(found.misfit):.2g} times the noise of the sources: the noise is "
                "declared too small, or the model lacks something; the intervals are too narrow"
            ),
        )
    if found.scattered is not None and not found.scattered.fit.settled:
        yield (
            "unsettled",
            (
                "warning: the fit with scatter did not settle: values and intervals are near the best ones at most; "
                "start it nearer (--prior, bounds), or fit without (--no-scatter)"
            ),
        )
    if found.absorbed:
        yield "flow_absorbed", f"warning: {found.absorbed}"
    for name, doubt in [*found.misread.items(), *found.doubts.items()]:
        yield "doubt", Message(f"with care: {name}: {within(doubt)}")
    for name, reason in found.left_out.items():
        yield "not_fitted", Message(f"not fitted: {name}: {within(reason)}")


def print_calibration(found: Calibration, units: System) -> None:
    """Print unknowns, strong correlations, residuals, rows left out, and predictions of deeper sections."""
    unknowns = [
        [
            row["name"], label, *(f"{row[key] * factor:.4g}" for key in ("value", "low", "high")),
            f"{row['how']}{', at a bound' if row['at_bound'] else ''}",
        ]
        for row in rows_of(found.table)
        for factor, label in [shown_unit(str(row["unit"]), units)]
    ]  # fmt: skip
    _print(["unknown", "", *right("value", "95 %", "interval"), "interval from"], unknowns)
    print_factors(found)
    names, matrix = found.forward.names, found.correlations.to_numpy(float)
    for i, one in enumerate(names):
        for other, value in zip(names[:i], matrix[i], strict=False):
            if abs(value) >= 0.9:
                screen.print(f"correlation of {other} and {one}: {value:.3f}", soft_wrap=True)
    rows: list[list[Any]] = []
    table = found.leave_one_out
    without = dict(zip(zip(table["id"], table["load"], strict=True), table["predicted"], strict=True))
    for row in rows_of(found.residuals):
        factor, label = shown_unit(LOADS[str(row["load"])], units)
        key = str(row["id"]), str(row["load"])
        measured = _span(row["low"] * factor, row["high"] * factor)
        alone = f"{float(without[key]) * factor:z.1f}" if key in without else "–"
        name = f"{row['id']}{_pumps(row, units)}" if row["used"] else f"({row['id']}{_pumps(row, units)})"
        rows.append([
            name, f"{row['load']}, {label}", measured, f"{row['fitted'] * factor:z.1f}",
            f"{row['residual'] * factor:z.1f}", f"{row['in_noise']:z.1f}", alone,
        ])  # fmt: skip
    screen.print("; ".join(clauses(rows_of(found.residuals), units)), soft_wrap=True)
    _print(["row", "load", *right("measured", "fitted", "off", "off/noise", "left out")], rows)
    left = "row" if found.scattered is None else "rows of its day"
    screen.print(f"off: beyond the recorded range; left out: predicted by a fit without the {left}", soft_wrap=True)
    if lifted := float(found.residuals["lift_N"].abs().max()):
        factor, label = shown_unit("N", units)
        moved = "pumped" if (found.residuals["flow_m3_s"] > 0).any() else "displaced by the moving string"
        screen.print(f"mud that is {moved} changes hook load by up to {lifted * factor:.3g} {label}", soft_wrap=True)
    if found.scattered is not None:
        days = counted(len(found.scattered.days), "day")
        scores = found.scores or {"": found.scattered.score}
        listed = ", ".join(f"{score:.1f} {name}".rstrip() for name, score in scores.items())
        kept = f"; kept: friction {max(scores, key=lambda name: scores[name])}" if found.scores else ""
        screen.print(f"score of the {days}, each left out (log density): {listed}{kept}", soft_wrap=True)
    for _, sentence in notes_of(found):
        messages.print(printable(told(sentence, units)), soft_wrap=True)
    if found.predicted is not None:
        print_prediction(found.predicted, units)


def print_factors(found: Calibration) -> None:
    """Print the friction factors by hole and motion."""
    table = found.factors
    if not len(table):
        return
    rows: list[list[Any]] = []
    for row in rows_of(table):
        names = [*row["rows"]]
        listed = ", ".join(names[:_MOST_ROWS]) + (
            f" and {len(names) - _MOST_ROWS} more" if len(names) > _MOST_ROWS else ""
        )
        rows.append([
            row["hole"], row["motion"], *(f"{row[key]:.3f}" for key in ("value", "low", "high")),
            listed or "none shows it",
        ])  # fmt: skip
    _print(["hole", "motion", *right("friction factor", "95 %", "interval"), "from rows"], rows)


def _pumps(row: Mapping[Any, Any], units: System) -> str:
    """What a row says of pumps and flow, in brackets."""
    said = [f"pumps {row['pumps']}"] if row["pumps"] else []
    if row["flow_m3_s"] > 0:
        said.append(in_words(row["flow_m3_s"], "flow_m3_s", units))
    return f" ({', '.join(said)})" if said else ""


def print_prediction(table: pd.DataFrame, units: System) -> None:
    """Print predicted readings with their bands, and how many measured ones lie inside."""
    rows: list[list[Any]] = []
    for row in rows_of(table):
        factor, label = shown_unit(str(row["unit"]), units)
        if row["reason"] != "none":
            rows.append([row["id"], f"{row['load']}, {label}", *["–"] * 4, ""])
            continue
        bands = (_span(row[f"low{band}"] * factor, row[f"high{band}"] * factor) for band in (50, 95))
        inside, measured = "", "–"
        if row["inside95"] is not None:
            inside = "50 %" if row["inside50"] else "95 %" if row["inside95"] else "no"
            measured = _span(row["low"] * factor, row["high"] * factor)
        rows.append([
            row["id"], f"{row['load']}, {label}", f"{row['predicted'] * factor:z.1f}", *bands, measured, inside
        ])  # fmt: skip
    screen.print("; ".join(clauses(rows_of(table), units)), soft_wrap=True)
    _print(["row", "load", *right("predicted", "50 %", "95 %", "measured"), "inside"], rows)
    for name, reason in (
        table[table["reason"] != "none"].drop_duplicates("id")[["id", "reason"]].itertuples(index=False)
    ):
        messages.print(printable(f"no prediction: {name}: {told(reason, units)}"), soft_wrap=True)
    counts = coverage(table)
    if counts["inside95"][1]:
        half, most = (f"{got} of {of}" for got, of in counts.values())
        screen.print(f"inside the band of 50 %: {half}, of 95 %: {most}", soft_wrap=True)
        for load, unit in LOADS.items():
            factor, label = shown_unit(unit, units)
            scores = table.loc[(table["load"] == load) & table["crps"].notna(), "crps"]
            if len(scores):
                screen.print(f"mean CRPS of {load}: {scores.mean() * factor:.3g} {label}", soft_wrap=True)


def _span(low: float, high: float) -> str:
    """A range, or the value that both ends are, to a tenth."""
    ends = f"{low:z.1f}", f"{high:z.1f}"
    return ends[0] if ends[0] == ends[1] else "–".join(ends).replace("-", "−")


def _print(heads: Sequence[Head | str], rows: list[list[Any]]) -> None:
    print_table(shown_table(heads, rows), words=FOLD, numbers={**FOLD, "no_wrap": screen.keeps_numbers})
