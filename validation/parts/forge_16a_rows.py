"""Rows of well 16A(78)-32 from its daily reports, by the rules of `forge_16a`."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from fctd.calibration.rows import Range, Row
from fctd.case.load import Case
from fctd.model.operations import steady_rates
from validation.parts.forge_16a import PUMPS, RPM
from validation.parts.forge_16a_strings import FOLDER, FOOT, POUND_FORCE

TORQUE = POUND_FORCE * FOOT  # [N m], 1 ft lbf


def readings(data: Path, keys: Sequence[str]) -> pd.DataFrame:
    """The reports of these depths [ft], as text; no other row is kept."""
    table = pd.read_csv(data / FOLDER / "observations.csv", dtype=str, keep_default_na=False)
    depths = [f"{float(depth):.0f}" for depth in table["bit_md_ft"]]
    table.index = pd.Index(depths)
    return table[[depth in keys for depth in depths]]


def report_rows(data: Path, strings: Mapping[str, Case], keys: Sequence[str]) -> list[Row]:
    """The rows of these depths [ft], three a report: up, down, and rotating with the torque."""
    found = {str(key): cells for key, cells in readings(data, keys).iterrows()}
    return [row for key in keys for row in _report(key, found[key], strings[key])]


def _report(key: str, cells: "pd.Series[str]", case: Case) -> list[Row]:
    depth = FOOT * float(cells["bit_md_ft"])

    def row(label: str, kind: str, weight: str, rpm: float = 0.0, torque: Range | None = None) -> Row:
        rates = steady_rates(case, kind, None, rpm)
        load = _reading(cells[weight], POUND_FORCE)
        return Row(
            f"{key} {label}", key, depth, kind, rates, load, torque, source="report", day=cells["date"],
            torque_read="off_bottom" if torque is None else "unknown",
        )  # fmt: skip

    torque = _reading(cells["torque_ftlbf"], TORQUE)
    return [
        row("up", "trip_out", "pu_lbf"),
        row("down", "trip_in", "so_lbf"),
        row("rotating", "rotate_off_bottom", "rot_lbf", RPM, torque),
    ]


def _reading(cell: str, unit: float) -> Range | None:
    """A reading in SI; None for an empty cell."""
    return Range(float(cell) * unit, float(cell) * unit) if cell else None


def pumps(data: Path) -> pd.DataFrame:
    """Pick-up and slack-off with and without pumps [klbf], as the report has them."""
    table = readings(data, [PUMPS])
    found = pd.DataFrame(
        {
            "bit_md_ft": PUMPS,
            "pumps": ["on" if "ON" in text else "off" for text in table["bha"]],
            "pick_up_klbf": table["pu_lbf"].astype(float).to_numpy() / 1e3,
            "slack_off_klbf": table["so_lbf"].astype(float).to_numpy() / 1e3,
        }
    )
    return found.assign(difference_klbf=found["pick_up_klbf"] - found["slack_off_klbf"])
