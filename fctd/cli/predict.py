"""``fctd predict CASE ROWS.csv``: readings of rows with bands, and scores of those that are measured."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fctd.calibration.calibrate import predict
from fctd.calibration.predict import posterior_file
from fctd.case.doubts import warnings_of
from fctd.case.text import printable
from fctd.cli.calibrate import Units, print_prediction
from fctd.cli.options import (
    CaseFile,
    Overrides,
    Quiet,
    changes_of,
    messages,
    print_written,
    read_case,
    refuse_sources,
    screen,
    warn,
)
from fctd.cli.pictures import DRAWN, check_pictures
from fctd.cli.steady import check_table, file_option, metadata_of_case
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
    check_table(out)
    check_pictures({"--plot": plot}, DRAWN)
    changes = changes_of(overrides)
    case = read_case(case_file, changes)
    beside = posterior_file(case_file) if posterior is None else posterior
    for key, path in {"--out": out, "--plot": plot}.items():
        refuse_sources(case, path, key, [rows, beside])
    with messages.status("predicting") as status:
        if quiet:
            status.stop()
        table = predict(
            case, rows, posterior, samples=samples, seed=seed, overrides=changes, units=units, tell=partial(warn, rows)
        )
    metadata = metadata_of_case(case, warnings_of(case))
    written = [] if out is None else write_table(table, out, metadata)
    if plot is not None:
        from fctd import plots  # needs matplotlib

        written += plots.save(plots.prediction_figure(table, f"{case.name}: predicted readings", units), plot)
    screen.print(printable(f"{case.name}: predicted readings"), style="bold", soft_wrap=True)
    print_prediction(table, units)
    print_written(written)
