"""Rows of well 15/9-F-4 from its daily reports and from its 4-second series, by the rules of `volve_f4`."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fctd.calibration.rows import Range, Row
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.model.operations import SteadyRates, steady_rates
from validation.cases import load
from validation.parts.volve_f4 import SERIES_STRING, STRINGS

FOLDER = "volve-15-9-F-4"
REPORTS, BINS, SAMPLES = (
    "offbottom_cased_and_shallow.csv",
    "offbottom_bins_25m.csv",
    "timeseries_12.25in_2007-10-23.csv",
)
TONNE = 9806.65  # [N], 1000 kgf
BIN = 25.0  # [m]
# Speed of reaming in a report that records none [m/s].
REAMING = 0.1
# Bins of the series: operation of each mode, and whether the string rotates.
MODES = {
    "rot_static": ("rotate_off_bottom", True),
    "rot_up": ("back_ream", True),
    "rot_dn": ("trip_in", True),
    "pickup": ("trip_out", False),
    "slackoff": ("trip_in", False),
}
# A free drive's torque lies between quartiles no further apart than this [N m].
FREE_DRIVE = 500.0


def cases(data: Path) -> dict[str, Case]:
    """The case of every string, with the survey of the public data."""
    survey = data / FOLDER / "survey.csv"
    return {name: load(name, wellbore__survey=survey) for name in {SERIES_STRING, *STRINGS.values()}}


def report_rows(data: Path, strings: Mapping[str, Case], ids: Sequence[str]) -> list[Row]:
    """The readings of these rows of the daily reports, and of no other row."""
    table = pd.read_csv(data / FOLDER / REPORTS, dtype=str, keep_default_na=False).set_index("id").loc[[*ids]]
    return [row for key, cells in table.iterrows() for row in _report(str(key), cells, strings)]


def _report(key: str, cells: "pd.Series[str]", strings: Mapping[str, Case]) -> list[Row]:
    """The rows of one daily report: strokes, and rotation off bottom or while the string moves."""
    string, depth = STRINGS[key], float(cells["bit_depth_m"])
    rpm = float(np.mean([float(end) for end in cells["rpm"].split("-")]))
    reams = key.endswith("r")
    torque = _range(cells["torque_low_kN_m"], cells["torque_high_kN_m"], 1e3) if rpm else None

    def row(kind: str, label: str, weight: str, turns: float, torque: Range | None = None) -> Row:
        speed = REAMING if reams and KINDS[kind].direction else None
        rates = steady_rates(strings[string], kind, speed, turns)
        load = _range(cells[weight], cells[weight], TONNE)
        return Row(f"{key} {label}", string, depth, kind, rates, load, torque, source="report", day=cells["date"])

    found = [
        row("back_ream" if reams else "trip_out", "up", "up_weight_t", rpm * reams),
        row("trip_in", "down", "down_weight_t", rpm * reams),
    ]
    if rpm:
        found.append(row("rotate_off_bottom", "rotating", "rotating_weight_t", rpm, torque))
    return [row for row in found if row.hookload or row.torque]


def _range(low: str, high: str, unit: float) -> Range | None:
    """A recorded range in SI; None where nothing was recorded."""
    low, high = low or high, high or low  # one of the two may be all that was recorded
    return Range(float(low) * unit, float(high) * unit) if low else None


def series_rows(data: Path, strings: Mapping[str, Case]) -> list[Row]:
    """The medians of the bins of the series."""
    bins = pd.read_csv(data / FOLDER / BINS)
    day = SAMPLES.removesuffix(".csv").rpartition("_")[2]
    speeds, case = _speeds(data), strings[SERIES_STRING]
    found = []
    for cells in bins.to_dict("records"):
        mode, top = str(cells["mode"]), float(cells["bit_depth_from_m"])
        name, weight, torque = f"{top:.0f} m {mode}", _median(cells, "hookload", TONNE), _median(cells, "torque", 1e3)
        still = SteadyRates(0.0, 0.0)
        if mode == "in_slips":
            found.append(Row(name, SERIES_STRING, float("nan"), "in_slips", still, weight, source="series", day=day))
            if 1e3 * (cells["torque_p75_kN_m"] - cells["torque_p25_kN_m"]) <= FREE_DRIVE:
                free = f"{name}, drive"
                found.append(
                    Row(free, SERIES_STRING, float("nan"), "tare", still, torque=torque, source="series", day=day)
                )
        elif mode in MODES:
            kind, turns = MODES[mode]
            rpm = float(cells["rpm"]) if turns else 0.0
            rates = steady_rates(case, kind, speeds.get(mode), rpm)
            found.append(
                Row(
                    name, SERIES_STRING, top + BIN / 2, kind, rates, weight, torque if turns else None, source="series",
                    day=day,
                )
            )  # fmt: skip
    return found


def _median(cells: Mapping[Any, Any], load: str, unit: float) -> Range:
    value = unit * float(cells[f"{load}_median_{'t' if load == 'hookload' else 'kN_m'}"])
    return Range(value, value)


def _speeds(data: Path) -> dict[str, float]:
    """Speed of the block [m/s] in the moving modes of the series: median of its samples off bottom."""
    samples = pd.read_csv(data / FOLDER / SAMPLES)
    clock = pd.to_datetime(samples["date"])
    after = clock.diff().dt.total_seconds().to_numpy()[1:]
    hole, bit, block, rpm = (
        samples[column].to_numpy(float)
        for column in ("Hole Depth (MD) m", "Bit Depth (MD) m", "Block Position m", "Average Rotary Speed rpm")
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        rise = np.diff(block) / after  # the block rises where its position grows
    good = (after < 10) & (np.abs(rise) > 0.01) & (hole[1:] - bit[1:] > 1.0)
    turns = rpm[1:] > 5
    picked = {"rot_up": turns & (rise > 0), "rot_dn": turns & (rise < 0), "pickup": ~turns & (rise > 0),
              "slackoff": ~turns & (rise < 0)}  # fmt: skip
    return {mode: float(np.median(np.abs(rise[good & chosen]))) for mode, chosen in picked.items()}
