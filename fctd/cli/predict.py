"""``fctd predict CASE ROWS.csv``: readings of rows with bands, and scores of those that are measured."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fctd import plots
from fctd.calibration.calibrate import predict
from fctd.calibration.predict import posterior_file
from fctd.cli.calibrate import Units, print_prediction
from fctd.cli.job import Job
from fctd.cli.options import CaseFile, Overrides, Quiet, warn
from fctd.cli.steady import file_option, metadata_of_case
from fctd.plots import DRAWN
from fctd.results.table_files import write_table


def predict_command(
    case_file: CaseFile,
    rows: Annotated[
        Path, typer.Argument(metavar="ROWS.csv", help="Rows to predict, measured or not.", show_default=False)
    ],
    posterior: Annotated[
        Path | None,
        file_option("--posterior", "Posterior of the calibration, .fit.json; default: the one beside the case."),
    ] = None,
    samples: Annotated[int, typer.Option("--samples", metavar="N", help="Draws of the bands.", min=100)] = 4000,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Seed of the draws.")] = 0,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    out: Annotated[
        Path | None, file_option("--out", "A row for every reading, with bands and scores, .csv, .parquet or .xlsx.")
    ] = None,
    plot: Annotated[Path | None, file_option("--plot", "Predicted and measured readings with bands.")] = None,
    units: Units = "si",
    quiet: Quiet = False,
) -> None:
    """Predict hook loads and torques of a calibrated case with 50 and 95 % bands, and score measured ones."""
    beside = posterior_file(case_file) if posterior is None else posterior
    job = Job(
        case_file, overrides, units=units, quiet=quiet, out=out, files={"--plot": (plot, DRAWN)}, reads=[rows, beside]
    )  # fmt: skip
    with job.status("predicting"):
        table = predict(
            job.case, rows, posterior, samples=samples, seed=seed, overrides=job.changes, units=units,
            tell=partial(warn, rows),
        )  # fmt: skip
    title = f"{job.case.name}: predicted readings"
    job.end(
        {
            "--out": lambda path: write_table(table, path, metadata_of_case(job.case, job.case.warnings)),
            "--plot": lambda path: plots.save(plots.prediction_figure(table, title, units), path),
        },
        lambda: print_prediction(table, units), title=title,
    )  # fmt: skip
