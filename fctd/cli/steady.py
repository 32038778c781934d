"""What the steady commands share: options, rates, pictures, and the metadata of a table."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import pandas as pd
import typer

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.units import SPEED
from fctd.cli.options import (
    check_target,
    read_quantity,
)
from fctd.cli.pictures import check_package
from fctd.model.operations import rates_of_all
from fctd.results.tables import versions
from fctd.results.unit_systems import System, in_field_units

TABLES = (".csv", ".parquet", ".xlsx")


def _defaults(rate: str) -> str:
    """The default of a rate for each kind."""
    return ", ".join(f"{name} {getattr(kind, rate):g}" for name, kind in KINDS.items() if getattr(kind, rate))


KIND_HELP = f"Kind of operation: {', '.join(KINDS)}"
Speed = Annotated[
    str | None,
    typer.Option(
        "--speed",
        metavar="V",
        help=f"Speed along the hole, '0.3 m/s'; default: the case's, else {_defaults('default_speed')} m/s.",
    ),
]
Rpm = Annotated[
    float | None,
    typer.Option("--rpm", metavar="N", help=f"Rev/min; default: the case's, else {_defaults('default_rpm')}."),
]
Units = Annotated[System, typer.Option("--units", help="Units of tables, pictures and screen.")]
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


def read_drive(speed: str | None, rpm: float | None) -> dict[str, Any]:
    """The given rates: speed [m/s] and rpm, None where the case sets them."""
    return {"speed": None if speed is None else read_quantity(speed, SPEED, "--speed"), "rpm": rpm}


def check_table(path: Path | None) -> None:
    """Raise InputError for ``--out`` where no table can be written there."""
    check_target(path, "--out", TABLES)
    if path is not None and path.suffix.lower() == ".xlsx":
        check_package(path, "--out")


def in_units(units: System, table: pd.DataFrame) -> pd.DataFrame:
    return in_field_units(table) if units == "field" else table


def metadata_of(case: Case, units: System, kinds: Sequence[str], drive: Mapping[str, Any]) -> dict[str, Any]:
    """Metadata of a table: case, units, versions, and the rates used, positive downwards and clockwise."""
    rates = rates_of_all(case, kinds, **drive)
    return {
        "case": case.model_dump(mode="json"),
        "units": units,
        "rates": {kind: {"speed_m_s": r.speed, "spin_rad_s": r.spin} for kind, r in rates.items()},
        "versions": versions(),
    }
