"""``fctd hydraulics CASE``: what the pumps need, where pressure is lost, and the density that the hole feels."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import typer

from fctd.case import message
from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.case.message import frame_of
from fctd.case.systems import ACROSS, DENSITY, FLOW
from fctd.case.text import counted
from fctd.case.units import MOST_FLOW
from fctd.cli.job import FOLD, Depths, Job, headed, numbers, print_facts, print_table, rows_of
from fctd.cli.options import CaseFile, Overrides, Quiet, Strict, Units, messages
from fctd.cli.pictures import PICTURE_HELP, TABLES, draw_panels
from fctd.cli.quantities import PENETRATION, TO_TOTAL_DEPTH, Given, QuantityOption, quantity, several
from fctd.cli.steady import file_option
from fctd.hydraulics.cuttings import Cuttings
from fctd.hydraulics.pressures import SHARE, Circulation, Eccentricity, circulations
from fctd.model.operations import flow_of
from fctd.results.case_facts import flow_curves
from fctd.results.shown_tables import Fact, Head, Table, facts, short, shown_table
from fctd.results.unit_systems import System, in_words, shown
from fctd.steady.equilibrium import lie_along

if TYPE_CHECKING:
    import pandas as pd

SCREEN_ROWS: Final = 30
# Columns of a row on the screen, with headings.
WORTH_SAYING: Final = 0.025  # share of the pressure in the annulus
SHOWN: Final = {
    "bit_depth_m": "bit", "standpipe_Pa": "standpipe", "surface_drop_Pa": "surface", "bore_drop_Pa": "bore",
    "tool_drop_Pa": "tools", "bit_drop_Pa": "at the bit", "annulus_drop_Pa": "annulus",
    "ecd_shoe_kg_m3": "ECD, shoe", "ecd_bit_kg_m3": "ECD, bit",
}  # fmt: skip

PARTS: Final = {
    "from_md_m": "from", "to_md_m": "to", "pressure_drop_Pa": "lost", "speed_m_s": "speed", "regime": "",
    "ecd_kg_m3": "ECD below",
}  # fmt: skip

Flows = Annotated[
    list[Given],
    quantity(
        QuantityOption("--flow", FLOW, above=0.0, at_most=MOST_FLOW),
        "Q",
        "Flow of the pumps, '2000 L/min' or '500 gpm', several with commas between them; default: the largest of the "
        "case's operations.",
    ),
]
SIZE: Final = QuantityOption("--cuttings-size", ACROSS, above=0.0).parse("6.35 mm")
ROCK: Final = QuantityOption("--cuttings-density", DENSITY).parse("2.6 sg")
Beside = Annotated[
    str | None,
    typer.Option(
        "--eccentricity", metavar="E",
        help="Offset of the pipe over its clearance, 0 (concentric) to 1, or 'string', where the string lies; default: "
        "the case's.",
    ),
]  # fmt: skip


def hydraulics_command(
    case_file: CaseFile,
    flows: Flows = [],  # noqa: B006 (typer copies it)
    depths: Depths = TO_TOTAL_DEPTH,
    eccentricity: Beside = None,
    penetration: Annotated[
        Given | None,
        quantity(
            PENETRATION, "V", "Rate of penetration, '20 m/h', bare in m/h or ft/h; cuttings weigh in the annulus."
        ),
    ] = None,
    cuttings_size: Annotated[Given, quantity(SIZE.option, "D", "Size of a piece of rock.")] = SIZE,
    cuttings_density: Annotated[Given, quantity(ROCK.option, "ρ", "Density of the rock.")] = ROCK,
    overrides: Overrides = [],  # noqa: B006
    out: Annotated[
        Path | None, file_option("--out", "A row for every flow and depth, .csv, .parquet or .xlsx, or its picture.")
    ] = None,
    parts: Annotated[
        Path | None, file_option("--parts", "A row for every part of the circuit, .csv, .parquet or .xlsx.")
    ] = None,
    plot: Annotated[
        Path | None, file_option("--plot", f"Pressures and equivalent densities against depth, {PICTURE_HELP}.")
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Find the pressures of mud that is pumped: surface lines, string, tools, bit and annulus, standpipe, ECD.

    Friction is that of API RP 13D, steady, of one temperature and without gas.
    """
    job = Job(
        case_file, overrides, units=units, strict=strict, quiet=quiet, out=out, plot=plot, draws=True,
        files={"--parts": (parts, TABLES)},
    )  # fmt: skip
    case = job.case
    pumped, bit_depths = _flows(flows, case, units), depths.depths(case, units)
    cuttings = None
    if penetration is not None:
        cuttings = Cuttings(penetration.si(units), cuttings_size.si(units), cuttings_density.si(units))
        if cuttings.density <= case.mud.densest:
            heavier = f"a density above the mud's, {message.quantity(case.mud.densest, 'kg/m^3')}"
            raise InputError(heavier, key="--cuttings-density", value=cuttings_density.text)
    job.warn(flow=pumped[0])
    with naming_file(case), job.bar() as show:
        found = circulations(case, pumped, bit_depths, read_eccentricity(eccentricity, case), cuttings, show)
    import pandas as pd  # slow to import

    solved = [one for one in found if isinstance(one, Circulation)]
    table = frame_of([one.summary() if isinstance(one, Circulation) else one for one in found])

    def draw(path: Path) -> list[Path]:
        from fctd.plots.flow import losses_panels

        lines = _facts_line(solved[-1], pumped, units), *job.lines
        return draw_panels(path, losses_panels(table, solved[-1], units, lines))

    of_parts = None if parts is None else pd.DataFrame([row for one in solved for row in one.parts()])
    job.end({"--out": table, "--parts": of_parts, "--plot": draw}, lambda: _print(job, table, solved))


def read_eccentricity(text: str | None, case: Case) -> Eccentricity:
    """The eccentricity of ``--eccentricity``, else that of the case."""
    given = case.mud.eccentricity if text is None else text
    if given == "string":
        return lie_along
    try:
        return SHARE.parse(float(given))
    except (InputError, ValueError):
        raise InputError("'string' or a share at least 0 and at most 1", key="--eccentricity", value=given) from None


def _flows(given: Sequence[Given], case: Case, units: System) -> list[float]:
    """The flows of ``--flow`` [m³/s]; else the largest of the operations."""
    found = several(given, units)
    largest = flow_of(case)
    if not found and not largest:
        raise InputError("a flow such as '2000 L/min', as no operation of the case has one", key="--flow")
    return found or [largest]


def _print(job: Job, table: "pd.DataFrame", found: Sequence[Circulation]) -> None:
    units = job.units
    print_facts(flow_curves(job.case.mud, units))
    for flow, of in table.groupby("flow_m3_s", sort=False):
        here = [one for one in found if one.flow == flow]
        if not here:
            continue
        last = here[-1].summary()
        pumped = f"{job.words(last, 'flow_m3_s')}, {job.words(last, 'standpipe_Pa')}"
        job.say(f"{pumped} at the standpipe with the bit at {job.words(last, 'bit_depth_m')}")
        print_table(_table(of, units) if len(of) > 1 else _parts(here[0], units), words=FOLD)
        print_facts(facts("", _bit(last, units)))
    job.say_reasons(table)
    if (off := max((one.circuit.too_high for one in found), default=0.0)) > WORTH_SAYING:
        messages.print(
            f"RP 13D may be {100 * off:.0f} % high in the annulus, where much of the stress at the wall is yield "
            "stress: with more flow or less yield stress it is exact within 2.5 %",
            soft_wrap=True,
        )
    if any(one.cuttings is not None and np.isnan(one.ratios).any() for one in found):
        messages.print(
            "cuttings: no estimate where the hole is steeper than 30°, and no weight in the density there",
            soft_wrap=True,
        )


def _table(of: "pd.DataFrame", units: System) -> Table:
    """A row for every depth, evenly spread where they are many."""
    return shown_table(headed(SHOWN, units), (numbers(row, SHOWN, units) for row in rows_of(of, SCREEN_ROWS)))


def _parts(one: Circulation, units: System) -> Table:
    """A row for every part of the circuit."""
    heads = (
        Head(words, shown(name, units).label, numbers=True) if words else Head("regime", numbers=True)
        for name, words in PARTS.items()
    )
    rows = (
        [
            " ".join(filter(None, (row["part"], row["name"], row["interval"] and f"in {row['interval']}"))),
            *(numbers(row, [name], units)[0] if words else row[name] for name, words in PARTS.items()),
            "" if np.isnan(row["transport_ratio"]) else f"{100 * row['transport_ratio']:.0f} %",
        ]
        for row in one.parts()
    )  # fmt: skip
    return shown_table(["part", *heads, Head("cuttings\nrise at", numbers=True)], rows)


def _bit(row: dict[str, Any], units: System) -> list[Fact]:
    """What the jets do, and what the flow does to the hook load."""
    rows: list[Fact] = []
    if not np.isnan(row["jet_speed_m_s"]):
        share = f"{100 * row['bit_drop_Pa'] / row['standpipe_Pa']:.0f} % of the standpipe pressure"
        rows = [
            _fact("pressure drop at the bit", row, "bit_drop_Pa", units, f", {share}"),
            _fact("hydraulic power at the bit", row, "bit_power_W", units),
            _fact("impact force of the jets", row, "impact_force_N", units),
            _fact("speed of the jets", row, "jet_speed_m_s", units),
        ]
    return [*rows, _fact("hook load less by", row, "lift_N", units, ", in straight vertical hole")]


def _fact(words: str, row: dict[str, Any], column: str, units: System, more: str = "") -> Fact:
    unit = shown(column, units)
    return words, short(row[column] * unit.factor, none=""), unit.label + more


def _facts_line(one: Circulation, flows: Sequence[float], units: System) -> str:
    depth = one.laid.string.bit_depth
    pumped = [short(flow * shown("flow_m3_s", units).factor).text for flow in flows]
    listed = f"{', '.join(pumped)} {shown('flow_m3_s', units).label}"
    nozzles = counted(len(one.laid.case.bit.nozzles), "nozzle")
    return f"{listed}, bit at {in_words(depth, 'bit_depth_m', units)}, {nozzles}; API RP 13D"
