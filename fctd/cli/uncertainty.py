"""``fctd uncertainty SWEEP.toml``: percentiles, probabilities and influences from the samples of a sweep."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from fctd import plots
from fctd.answers.swept import dataset_of
from fctd.case.errors import InputError
from fctd.case.operation_names import kinds_of
from fctd.case.systems import LENGTH
from fctd.case.text import counted, printable
from fctd.cli.job import FOLD, WHOLE, print_table, right, rows_of
from fctd.cli.options import Quiet, Units, check_target, messages, print_written, screen
from fctd.cli.pictures import check_files
from fctd.cli.quantities import Given, QuantityOption, quantity, si
from fctd.cli.steady import file_option
from fctd.cli.sweep import SweepFile
from fctd.plots import DRAWN
from fctd.results.doing import clauses
from fctd.results.shown_tables import shown_table
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, in_field_units, long_in_field_units, shown, shown_if_any
from fctd.store.origin import versions
from fctd.sweep.indices import WITH_UNIT
from fctd.sweep.spec import read_sweep
from fctd.sweep.uncertainty import Uncertainty, assess

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

# Numbers of the tables that have the unit of their row.
NUMBERS = ("value", "low", "high", "mean", "sd", "error")
# Measures that the screen leaves to the files.
IN_FILES = ("SRRC", "R2_rank")
WIDE: dict[str, Any] = {"collapse_padding": False, "pad_edge": True, "title_justify": "left"}  # of a table
OPERATION = {"operation": {**FOLD, **WHOLE}}
TABLES = ("percentiles", "probabilities", "indices", "convergence")


def uncertainty_command(
    sweep_file: SweepFile,
    folder: Annotated[
        Path | None,
        typer.Option("--from", metavar="FOLDER", help="Folder of fctd sweep; default: NAME-sweep.", show_default=False),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FOLDER", help=f"Folder for {', '.join(TABLES)} as CSV.", show_default=False),
    ] = None,
    bit_depth: Annotated[
        Given | None,
        quantity(
            QuantityOption("--bit-depth", LENGTH),
            "D",
            "Depth of indices and map; default: the last.",
            show_default=False,
        ),
    ] = None,
    operation: Annotated[
        str | None,
        typer.Option(
            "--operation", metavar="KIND", help="Operation of tornado and map; default: the first.", show_default=False
        ),
    ] = None,
    plot_bands: Annotated[
        Path | None, file_option("--plot-bands", "Bands of loads over depth, .png, .svg, .pdf.")
    ] = None,
    plot_tornado: Annotated[Path | None, file_option("--plot-tornado", "Influence of the parameters.")] = None,
    plot_map: Annotated[Path | None, file_option("--plot-map", "A result over two parameters, those of --map.")] = None,
    map_keys: Annotated[
        str | None,
        typer.Option("--map", metavar="X,Y[,COLUMN]", help="Keys of the map, and its result.", show_default=False),
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
) -> None:
    """Summarise the samples of a sweep: bands of the loads, probabilities, and which parameter matters."""
    if (plot_map is None) != (map_keys is None):
        raise InputError("--plot-map and --map, both or none", key="--map", value=map_keys or "none")
    check_files({
        "--plot-bands": (plot_bands, DRAWN), "--plot-tornado": (plot_tornado, DRAWN), "--plot-map": (plot_map, DRAWN),
    })  # fmt: skip
    files = {} if out is None else {name: out / f"{name}.csv" for name in TABLES}
    for path in files.values():
        check_target(path, "--out", (".csv",))
    spec = read_sweep(sweep_file)
    dataset = dataset_of(spec, folder, "--from")
    operation = None if operation is None else kinds_of([operation])[0]
    depth = si(bit_depth, units)
    found = assess(dataset, spec, depth)
    keys = [] if map_keys is None else [part.strip() for part in map_keys.split(",")]
    if map_keys is not None and len(keys) not in (2, 3):
        raise InputError("two keys of parameters, and a column", key="--map", value=map_keys)
    figures = _figures(found, plot_bands, plot_tornado, plot_map, keys, operation, units)
    written: list[Path] = []
    try:  # written before anything is printed, as the terminal may be closed
        metadata = {"sweep": spec.model_dump(mode="json"), "versions": versions()}
        for name, path in files.items():
            written += write_table(_in_units(getattr(found, name), units), path, metadata)
        written += [file for path, figure in figures.items() for file in plots.save(figure, path)]
    finally:
        if not quiet:
            _print(found, units)
    print_written(written)


def _in_units(table: "pd.DataFrame", units: System) -> "pd.DataFrame":
    """A table of ``Uncertainty`` in units; limits of events stay as the sweep file has them."""
    if units == "si" or table.empty:
        return table
    if "column" not in table:
        return in_field_units(table)
    numbers = [name for name in NUMBERS if name in table]
    scaled = table["measure"].isin(WITH_UNIT) if "measure" in table else table["column"].notna()
    return long_in_field_units(table, numbers, scaled)


def _figures(
    found: Uncertainty, bands: Path | None, tornado: Path | None, of_map: Path | None, keys: list[str],
    operation: str | None, units: System,
) -> dict[Path, "Figure"]:  # fmt: skip
    """The pictures by their files; raises InputError for those that the samples do not allow."""
    figures = {}
    if bands is not None:
        figures[bands] = plots.bands_figure(found, units)
    if tornado is not None:
        figures[tornado] = plots.tornado_figure(found, operation, units)
    if of_map is not None:
        column = keys[2] if len(keys) == 3 else found.columns[0]
        if column not in found.rows or found.rows[column].dtype.kind not in "if":
            raise InputError("a column of the results with numbers", key="--map", value=column)
        figures[of_map] = plots.map_figure(found, keys[:2], column, operation, units)
    return figures


def _print(found: Uncertainty, units: System) -> None:
    """Print percentiles at the last depth, the probabilities of events anywhere, and the influences."""
    screen.print(f"{printable(found.spec.name)}: {counted(found.rows['sample'].nunique(), 'sample')}", style="bold")
    if "flow_m3_s" in found.rows:  # else rows of runs and of searches for segments
        screen.print("; ".join(clauses(rows_of(found.rows), units)), soft_wrap=True)
    _print_percentiles(found, units)
    anywhere = found.probabilities[found.probabilities["bit_depth_m"].isna()]
    rows: list[list[Any]] = [
        [row["operation"], row["event"], f"{row['probability']:.3g}", f"{row['low']:.3g} to {row['high']:.3g}"]
        for row in rows_of(anywhere[anywhere["count"] > 0])
    ]
    if rows:
        print_table(
            shown_table(["operation", "event", *right("probability", "95 %")], rows),
            title="Probability at any depth",
            **WIDE,
        )
    if found.trouble:
        messages.print(f"no indices: {printable(found.trouble)}", soft_wrap=True)
    if found.indices.empty:
        return
    metre = shown("bit_depth_m", units)
    at = "" if np.isnan(found.bit_depth) else f" at {found.bit_depth * metre.factor:.5g} {metre.label}"
    rows = [
        [
            row["operation"], row["column"], row["measure"], row["parameter"],
            f"{row['value'] * factor:.3g} {unit}".rstrip(),
            "" if np.isnan(row["error"]) else f"{row['error'] * factor:.2g}",
        ]
        for row in rows_of(found.indices[~found.indices["measure"].isin(IN_FILES)])
        for factor, unit in [shown_if_any(row["column"], units) if row["measure"] in WITH_UNIT else (1.0, "")]
    ]  # fmt: skip
    print_table(
        shown_table(["operation", "column", "measure", "parameter", *right("value", "±")], rows),
        OPERATION,
        words=FOLD,
        title=f"Influence{at}",
        **WIDE,
    )


def _print_percentiles(found: Uncertainty, units: System) -> None:
    of = found.percentiles
    if "bit_depth_m" in of:
        of = of[of["bit_depth_m"] == of["bit_depth_m"].max()]
    rows = [
        [
            row["operation"], row["column"], f"{row['percentile']:g}",
            "–" if np.isnan(row["value"]) else f"{row['value'] * factor:z.4g} {unit}",
            " to ".join("–" if np.isnan(row[end]) else f"{row[end] * factor:z.4g}" for end in ("low", "high")),
            row["samples"],
        ]
        for row in rows_of(of)
        if (row["operation"], row["column"]) not in found.noise
        for factor, unit in [shown_if_any(row["column"], units)]
    ]  # fmt: skip
    print_table(
        shown_table(["operation", "column", *right("%", "value", "95 %", "samples")], rows),
        OPERATION,
        words=FOLD,
        title="Percentiles at the last depth",
        **WIDE,
    )
