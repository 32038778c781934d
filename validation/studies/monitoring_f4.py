"""Stretches of a real four-second series against medians of 25 m bins that someone else made of it."""

from collections import defaultdict
from typing import Any

import numpy as np
import pandas as pd

from fctd.monitoring.monitor import Monitor, result_of
from fctd.monitoring.series import read_series
from fctd.monitoring.stretches import Mode
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.f4 import f4

MODES: dict[str, Mode] = {
    "in_slips": "in_slips", "rot_static": "rotating", "rot_up": "rotating_up", "rot_dn": "rotating_down",
}  # fmt: skip
BIN = 25.0  # [m]
SLACK = 0.02
TONNE = 9806.65  # [N], 1,000 kgf


def run(context: Context) -> Outcome:
    """Every row of the settled stretches by the bin of its bit depth; the rules were fixed before the comparison."""
    assert context.data is not None  # the runner has checked that the data are there
    folder = context.data / "volve-15-9-F-4"
    watch = Monitor(f4(folder))
    series = read_series(folder / "timeseries_12.25in_2007-10-23.csv")
    watch.feed(series)
    watch.finish()
    pooled: dict[tuple[str, float], list[np.ndarray]] = defaultdict(list)
    for found in watch.found:
        for row in found.stretch.rows:
            pooled[found.stretch.mode, BIN * np.floor(row[0] / BIN)].append(row)
    bins = pd.read_csv(folder / "offbottom_bins_25m.csv")
    rows = [_compared(one, pooled) for _, one in bins[bins["mode"].isin(list(MODES))].iterrows()]
    table = pd.DataFrame(rows)
    within = float(table["within"].mean())
    result = result_of(watch)
    stretches = result.stretches.drop(columns=["start_s", "end_s"])
    return Outcome(
        tables={
            "bins": table, "distance": _by_distance(series, table), "stretches": stretches,
            "alarms": pd.DataFrame([vars(alarm) for alarm in result.alarms]),
        },
        checks=[
            Check("bins of rotation and slips whose medians lie within the quartiles or 2 %", within, 0.8, "at_least",
                  "", "target: 80 % of the bins"),
        ],
        notes=[
            f"{int(table['within'].sum())} of {len(table)} bins. A bin without a stretch counts as missed. The rule "
            "behind the bins is not recorded.",
            "Torque of the standing, turning string falls with the distance off bottom, up to about a metre: in missed "
            "bins of standing rotation the other hand has counted rows nearer to the bottom than the 1 m asked for "
            "here, or rows in which the rotation was not yet settled.",
            *result.told,
            *(f"Alarm: {alarm.sentence}." for alarm in result.alarms),
        ],
        display={
            "bins": "Medians of stretches against the bins",
            "distance": "Standing rotation in the missed bins, every row, by the least distance off bottom",
        },
    )  # fmt: skip


@table_of_rows
def _by_distance(series: pd.DataFrame, table: pd.DataFrame) -> Rows:
    """Rows with standing block and 20 rev/min or more in missed bins, by the least distance off bottom [m]."""
    missed = table.loc[~table["within"] & (table["mode"] == "rotating"), "bit_depth_from_m"]
    speed = series["block_position_m"].diff() / series["time_s"].diff()
    standing = series[(series["rpm"] >= 20) & (speed.abs() < 0.01)]
    off = standing["hole_depth_m"] - standing["bit_depth_m"]
    for start in missed:
        inside = (standing["bit_depth_m"] >= start) & (standing["bit_depth_m"] < start + BIN)
        for least in (0.1, 0.3, 0.5, 0.8, 1.0):
            here = standing[inside & (off > least)]
            yield {"bit_depth_from_m": start, "off_bottom_m": least, "rows": len(here), "rpm": here["rpm"].median(),
             "torque_kN_m": here["drive_torque_N_m"].median() / 1e3}  # fmt: skip


def _compared(one: "pd.Series[Any]", pooled: dict[tuple[str, float], list[np.ndarray]]) -> dict[str, object]:
    """A bin beside the stretches in it: in slips the hook load is judged, in rotation the torque and the hook load."""
    mode = MODES[str(one["mode"])]
    rows = np.array(pooled.get((mode, float(one["bit_depth_from_m"])), np.empty((0, 3)))).reshape(-1, 3)
    row: dict[str, object] = {"bit_depth_from_m": one["bit_depth_from_m"], "mode": mode, "rows": len(rows),
                              "rows_of_bin": one["samples"]}  # fmt: skip
    within = len(rows) > 0
    judged = {"hookload": (1, TONNE, "t")} | ({} if mode == "in_slips" else {"torque": (2, 1e3, "kN_m")})
    for name, (column, unit, ending) in judged.items():
        middle = float(np.median(rows[:, column])) / unit if len(rows) else float("nan")
        low, median, high = (one[f"{name}_{part}_{ending}"] for part in ("p25", "median", "p75"))
        inside = low <= middle <= high or abs(middle / median - 1) <= SLACK
        row |= {f"{name}_{ending}": middle, f"{name}_p25_{ending}": low, f"{name}_median_{ending}": median,
                f"{name}_p75_{ending}": high, f"{name}_within": inside}  # fmt: skip
        within = within and inside
    return row | {"within": within}


STUDY = Study(
    "monitoring_f4",
    "Are the stretches that monitoring finds in a real series those of another hand?",
    run,
    needs=("data",),
)
