"""``fctd limits CASE``: how far the string is from its limits, per operation and bit depth."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import numpy as np

from fctd.case.systems import told
from fctd.case.text import printable
from fctd.cli.chart_table import noted
from fctd.cli.job import WHOLE, Depths, Job, print_table, right, rows_of
from fctd.cli.options import CaseFile, Friction, Overrides, Quiet, Strict, Units, messages, screen
from fctd.cli.quantities import TO_TOTAL_DEPTH
from fctd.cli.steady import (
    Flow,
    Rpm,
    Speed,
    StuckAt,
    file_option,
    kinds_option,
    read_drive,
    read_kinds,
)
from fctd.results.shown_tables import number, of_column, shown_table
from fctd.results.unit_systems import System, shown
from fctd.steady.margin_table import AT_STUCK, USUAL, limits_of
from fctd.steady.margins import FATIGUE, LACKING, MEANINGS, OVERPULL, SET_DOWN, SLIPS, TORQUE

if TYPE_CHECKING:
    import pandas as pd

SCREEN_ROWS = 24  # of a margin
# Of each margin, in words, and the columns of the load at the bit, of that at the hook and of what is left.
SHOWN: Final = {
    OVERPULL: ("pull on a stuck bit", "force_at_bit_N", "hookload_N", "hookload_left_N"),
    SET_DOWN: ("weight on the bit", "force_at_bit_N", "hookload_N", "hookload_left_N"),
    TORQUE: ("torque at the bit", "torque_at_bit_N_m", "surface_torque_N_m", "surface_torque_left_N_m"),
    SLIPS: ("weight in the slips", "", "hookload_N", "hookload_left_N"),
}
# The same of pipe that is stuck above its bit.
STUCK: Final = {
    OVERPULL: ("pull at the stuck point", AT_STUCK[SHOWN[OVERPULL][1]], *SHOWN[OVERPULL][2:]),
    SET_DOWN: ("push at the stuck point", AT_STUCK[SHOWN[SET_DOWN][1]], *SHOWN[SET_DOWN][2:]),
    TORQUE: ("torque at the stuck point", AT_STUCK[SHOWN[TORQUE][1]], *SHOWN[TORQUE][2:]),
}


def limits_command(
    case_file: CaseFile,
    operations: Annotated[list[str], kinds_option(f"; default: {', '.join(USUAL)}")] = [],  # noqa: B006
    depths: Depths = TO_TOTAL_DEPTH,
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    stuck_at: StuckAt = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    out: Annotated[Path | None, file_option("--out", "A row for every margin, .csv, .parquet or .xlsx.")] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Find how far the string is from its limits: overpull, weight set down, torque, slips, and bending to and fro.

    Loads at the bit grow until the first limit is reached, each as a steady string.  How much of a capacity may be used
    is set in `limits` of the case, and what the rig bears in `rig`.  Of pipe that is stuck above its bit, loads grow at
    the stuck point.
    """
    job = Job(case_file, overrides, friction, units=units, strict=strict, quiet=quiet, out=out)
    bit_depths, kinds = depths.depths(job.case, units), read_kinds(operations, USUAL)
    drive = read_drive(speed, rpm, flow, units)
    stuck = None if stuck_at is None else stuck_at.depth(job.case, units)
    job.warn(kinds, **drive)
    pumps: dict[str, float] = {} if stuck is None else {"flow": 0.0}  # of a string that is stuck they stand
    with job.bar() as show:
        table = limits_of(job.case, kinds, bit_depths, **drive, stuck_at=stuck, progress=show)
    meanings = {code: MEANINGS[code] for code in table["limit"].unique() if code in MEANINGS}
    job.end(
        {"--out": table}, lambda: _print(job, table), rates=(kinds, drive | pumps),
        more={"stuck_at_m": stuck, "limits": meanings}, acceptable=bool((table["margin"] != "none").all()),
        notes=table["notes"], codes=_beyond(table),
    )  # fmt: skip


def _beyond(table: "pd.DataFrame") -> list[str]:
    """The limits that a string is beyond before any load is added, and the overpull that it lacks."""
    beyond = set(table.loc[table["share_used"] > 1, "limit"])
    if table["reason"].str.contains(LACKING, regex=False).any():
        beyond.add("overpull_margin")
    return sorted(beyond)


def _print(job: Job, table: "pd.DataFrame") -> None:
    """Print a table for each operation and margin, and the reasons of rows without a number."""
    units, stuck = job.units, "stuck_md_m" in table
    metre = shown("bit_depth_m", units)
    for (operation, margin), of in table.groupby(["operation", "margin"], sort=False):
        if margin in SHOWN:
            words, *columns = STUCK[margin] if stuck else SHOWN[margin]
            screen.print(f"{operation}: {words}, {shown(columns[1], units).label}")
            _print_margin(of, columns, units)
    if stuck:
        where = job.words(rows_of(table)[0], "stuck_md_m")
        job.say(f"stuck at {where}: what is left counts from the free string with its bit below")
    job.say("hook loads are those of the string alone, without the block", *_bending(job, table))
    said = table[table["reason"] != "none"]
    for (operation, limit, _), of in said.groupby(["operation", "limit", "reason"], sort=False):
        depths = [f"{depth * metre.factor:.0f}" for depth in of["bit_depth_m"]]
        span = depths[0] if len(depths) == 1 else f"{depths[0]} to {depths[-1]}"
        at = f"{operation} at {span} {metre.label} ({len(of)} of {table['bit_depth_m'].nunique()})"
        what = "" if limit == "none" else f", {limit}"
        job.say(f"{at}{what}: {told(of['reason'].iloc[0], units)}")
    strings = rows_of(table.drop_duplicates(["operation", "bit_depth_m"]))
    for operation in table["operation"].unique():
        of_one = [row for row in strings if row["operation"] == operation]
        for line in noted(of_one, metre.factor, metre.label):
            messages.print(f"{operation}: {told(line, units)}", soft_wrap=True)


def _print_margin(of: "pd.DataFrame", columns: Sequence[str], units: System) -> None:
    """Print the rows of a margin, at evenly spread depths where they are many."""
    metre = shown("bit_depth_m", units)
    depths = of["bit_depth_m"].unique()
    most = max(SCREEN_ROWS // of["limit"].nunique(), 1)
    picked = depths[np.unique(np.linspace(len(depths) - 1, 0, min(most, len(depths))).round().astype(int))]
    below = "at stuck point" if "stuck_md_m" in of else "at bit"
    names = [f"bit, {metre.label}", "used, %", below, "at surface", "left"]
    rows = (
        [
            row["limit"].replace("_", " "), of_column("bit_depth_m", row["bit_depth_m"], units, 0),
            number(100 * row["share_used"], 0, ""),
            *(of_column(name, row[name], units, int(name.endswith("_N_m"))) if name else None for name in columns),
            ", ".join([
                *([] if np.isnan(row["md_m"]) else [f"{row['md_m'] * metre.factor:.0f} {metre.label}"]),
                *([] if row["part"] == "none" else [row["part"]]),
            ]),
        ]
        for row in rows_of(of[of["bit_depth_m"].isin(picked)])
    )  # fmt: skip
    looks = {name: {**WHOLE, "min_width": len(name)} for name in names}
    looks["until"] = {**WHOLE, "min_width": max(map(len, of["limit"]))}
    print_table(shown_table(["until", *right(*names), "where"], rows), looks, words=WHOLE)


def _bending(job: Job, table: "pd.DataFrame") -> list[str]:
    """The largest bending to and fro of each operation, as lines."""
    lines = []
    metre, stress = shown("bit_depth_m", job.units), shown("bending_stress_Pa", job.units)
    for operation, of in table[table["margin"] == FATIGUE].groupby("operation", sort=False):
        worst = max(rows_of(of), key=lambda row: row["bending_stress_Pa"])
        amplitude, often = worst["bending_stress_Pa"] * stress.factor, worst["cycles_per_hour"]
        place, bit = worst["md_m"] * metre.factor, worst["bit_depth_m"] * metre.factor
        lines.append(
            f"{operation}: turning bends the steel to and fro by ±{amplitude:.0f} {stress.label}, {often:.0f} times an "
            f"hour, at {place:.0f} {metre.label} in {printable(worst['part'])}, bit at {bit:.0f} {metre.label}"
        )
    return lines
