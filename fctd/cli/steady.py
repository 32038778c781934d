"""What the steady commands share: options, rates, pictures, and the metadata of a table."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from fctd.case.errors import InputError
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case
from fctd.case.operation_names import USUAL, kinds_of, split_names
from fctd.case.operations import KINDS
from fctd.case.systems import FLOW, LENGTH, ROTATION, SPEED
from fctd.case.units import MOST_FLOW
from fctd.cli.options import check_target, messages, screen
from fctd.cli.pictures import PICTURES, check_package, check_pictures
from fctd.cli.quantities import Given, QuantityOption, quantity, si
from fctd.model.drillstring import lay_out
from fctd.model.operations import rates_of_all
from fctd.model.summary import segments_in_words
from fctd.results.unit_systems import System, in_field_units, shown
from fctd.store.origin import versions

if TYPE_CHECKING:
    import pandas as pd

TABLES = (".csv", ".parquet", ".xlsx")


def _defaults(rate: str) -> str:
    """The default of a rate for each kind."""
    return ", ".join(f"{name} {getattr(kind, rate):g}" for name, kind in KINDS.items() if getattr(kind, rate))


KIND_HELP = f"Kind of operation: {', '.join(KINDS)}, also {', '.join(USUAL)}"
DRIVE = SPEED_OPTION, RPM_OPTION, FLOW_OPTION = (
    QuantityOption("--speed", SPEED), QuantityOption("--rpm", ROTATION),
    QuantityOption("--flow", FLOW, at_most=MOST_FLOW),
)  # fmt: skip
Speed = Annotated[
    Given | None,
    quantity(
        SPEED_OPTION,
        "V",
        f"Speed along the hole, '0.3 m/s', bare in m/s, with --units field in ft/min; default: the case's, else "
        f"{_defaults('default_speed')} m/s.",
    ),
]
Rpm = Annotated[
    Given | None,
    quantity(RPM_OPTION, "N", f"Rev/min; default: the case's, else {_defaults('default_rpm')}."),
]
Flow = Annotated[
    Given | None,
    quantity(
        FLOW_OPTION,
        "Q",
        "Flow of the pumps, '2000 L/min' or '500 gpm', bare in L/min, with --units field in gpm; default: the "
        "case's, or 0.",
    ),
]
DEPTH_HELP = "Bit depth, '2450 m', td or shoe; bare in m, with --units field in ft"
StuckAt = Annotated[
    Given | None,
    quantity(
        QuantityOption("--stuck-at", LENGTH),
        "MD",
        "Measured depth at which the pipe is stuck, '2700 m', td or shoe; default: the bit.",
    ),
]
ResolveBuckling = Annotated[
    bool | None,
    typer.Option(
        "--resolve-buckling/--no-resolve-buckling",
        help="Lay out buckled strings in segments that can bend as they do; default: the case's.",
        show_default=False,
    ),
]


def file_option(option: str, what: str) -> typer.models.OptionInfo:
    info: typer.models.OptionInfo = typer.Option(option, metavar="FILE", help=what, show_default=False)
    return info


def read_drive(speed: Given | None, rpm: Given | None, flow: Given | None, units: System) -> dict[str, Any]:
    """The given rates: speed [m/s], rpm and flow [m³/s], None where the case sets them."""
    return {"speed": si(speed, units), "rpm": si(rpm, units), "flow": si(flow, units)}


def read_kinds(texts: Sequence[str], usual: Sequence[str] = ()) -> list[str]:
    """The kinds of operations of an option that may be repeated, with commas between them or "all"; else the usual."""
    names = [name for text in texts for name in split_names(text)]
    return kinds_of([kind for name in names for kind in (KINDS if name == "all" else [name])] or usual)


def row_bar(quiet: bool) -> Progress:
    """The progress of rows on the terminal."""
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=messages, disable=quiet, transient=True)


def check_table(out: Path | None, suffixes: Sequence[str] = TABLES) -> None:
    """Raise InputError for ``--out`` where no table can be written there; suffixes : that it may have."""
    check_target(out, "--out", suffixes)
    if out is not None and out.suffix.lower() == ".xlsx":
        check_package(out, "--out")


def check_targets(
    out: Path | None, plot: Path | None, others: Mapping[str, Path | None]
) -> tuple[Path | None, Path | None]:
    """The table and the picture of a command: ``--out`` is a picture where its suffix is that of one.

    others : pictures by option.  Raises InputError for a file that cannot be written, before anything is computed.
    """
    if out is None or out.suffix.lower() not in PICTURES:
        check_table(out, (*TABLES, *PICTURES))
        check_pictures({"--plot": plot, **others})
        return out, plot
    if plot is not None:
        raise InputError(f"a table, {' or '.join(TABLES)}, beside the picture of --plot", key="--out", value=out)
    check_pictures({"--out": out, **others})
    return None, out


def print_segments(case: Case, bit_depth: float, units: System) -> None:
    """Print number and lengths of the segments where the program has chosen them; bit_depth [m]."""
    if any(part.cut_by_default for part in case.string.components):
        metre = shown("bit_depth_m", units)
        line = segments_in_words(case, lay_out(case, bit_depth), metre.factor, metre.label)
        screen.print(line, soft_wrap=True)


def in_units(units: System, table: "pd.DataFrame") -> "pd.DataFrame":
    return in_field_units(table) if units == "field" else table


def metadata_of(
    case: Case, units: System, kinds: Sequence[str], drive: Mapping[str, Any], warnings: Sequence[InputWarning] = ()
) -> dict[str, Any]:
    """Metadata of a table: case, units, warnings, versions, and the rates used, positive downwards and clockwise."""
    rates = rates_of_all(case, kinds, **drive)
    return metadata_of_case(case, warnings) | {
        "units": units,
        "rates": {kind: {"speed_m_s": r.speed, "spin_rad_s": r.spin, "flow_m3_s": r.flow} for kind, r in rates.items()},
    }


def metadata_of_case(case: Case, warnings: Sequence[InputWarning]) -> dict[str, Any]:
    """Metadata of any table of a case: case, warnings and versions."""
    return {
        "case": case.model_dump(mode="json"),
        "warnings": [warning.as_metadata() for warning in warnings],
        "versions": versions(),
    }
