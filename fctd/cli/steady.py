"""What the steady commands share: options, rates, and the metadata of a table."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case
from fctd.case.message import frame_of
from fctd.case.operation_names import USUAL, kinds_of, split_names
from fctd.case.operations import KINDS
from fctd.case.systems import FLOW, LENGTH, ROTATION, SPEED
from fctd.case.units import A_MINUTE, FASTEST, MOST_FLOW, MOST_RPM
from fctd.cli.options import screen
from fctd.cli.quantities import Given, QuantityOption, quantity, si
from fctd.model.drillstring import lay_out
from fctd.model.operations import rates_of_all
from fctd.model.summary import segments_in_words
from fctd.results.unit_systems import System, in_field_units, shown
from fctd.store.origin import versions
from fctd.store.tables import Rows

if TYPE_CHECKING:
    import pandas as pd


def _defaults(rate: str) -> str:
    """The default of a rate for each kind."""
    return ", ".join(f"{name} {getattr(kind, rate):g}" for name, kind in KINDS.items() if getattr(kind, rate))


KIND_HELP = f"Kind of operation: {', '.join(KINDS)}, also {', '.join(USUAL)}"
SPEED_OPTION, RPM_OPTION, FLOW_OPTION = (
    QuantityOption("--speed", SPEED, at_most=FASTEST, likely_units=A_MINUTE),
    QuantityOption("--rpm", ROTATION, at_most=MOST_RPM),
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
    quantity(
        RPM_OPTION, "N", f"Rev/min of what rotates by its name; default: the case's, else {_defaults('default_rpm')}."
    ),
]
Flow = Annotated[
    Given | None,
    quantity(
        FLOW_OPTION,
        "Q",
        "Flow of the pumps in all operations, '2000 L/min' or '500 gpm', bare in L/min, with --units field in gpm; "
        "default: the case's, in what drills, rotates or reams.",
    ),
]
DEPTHS_HELP = (
    "Bit depths, 1750:2450:10 in m, with --units field in ft, '5000 ft:8000 ft:30 ft' or shoe:td:50; the last is "
    "always among them."
)
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
FrictionFan = Annotated[
    list[str],
    typer.Option(
        "--friction",
        metavar="X",
        help="Friction factor of every interval, 0.25, a list, 0.1,0.2,0.3, a fan, 0.1:0.4:0.1, or by kind, "
        "cased=0.2,open=0.3; may be repeated.",
    ),
]


def kinds_option(more: str = "") -> typer.models.OptionInfo:
    """The option of several kinds of operations; more : what its help says of the default."""
    text = f"{KIND_HELP}; several with commas between them, or all{more}."
    info: typer.models.OptionInfo = typer.Option("--operation", metavar="KINDS", help=text)
    return info


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


def print_segments(case: Case, bit_depth: float, units: System) -> None:
    """Print number and lengths of the segments where the program has chosen them; bit_depth [m]."""
    if any(part.cut_by_default for part in case.string.components):
        metre = shown("bit_depth_m", units)
        line = segments_in_words(case, lay_out(case, bit_depth), metre.factor, metre.label)
        screen.print(line, soft_wrap=True)


def in_units(units: System, table: "pd.DataFrame | Rows") -> "pd.DataFrame | Rows":
    return table if units == "si" else in_field_units(frame_of(table))


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
