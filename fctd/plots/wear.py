"""The picture of casing wear: side force, depth of the groove and burst pressure against depth."""

from collections.abc import Sequence
from typing import Final

import pandas as pd

from fctd.case.load import Case
from fctd.plots.depth_panels import Curve, Panel, Panels
from fctd.results.unit_systems import System, shown

# Columns of each panel, with the names of their curves and the places of their colours.
PANELS: Final = {
    "side force on 30 ft of string": {"side_force_N": ("side force", 0)},
    "depth of the groove": {
        "low_groove_m": ("lowest wear factor", 2), "high_groove_m": ("highest wear factor", 1),
    },
    "burst pressure": {
        "burst_Pa": ("new", 3), "high_burst_Pa": ("lowest wear factor", 2), "low_burst_Pa": ("highest wear factor", 1),
    },
}  # fmt: skip


def wear_panels(case: Case, table: pd.DataFrame, units: System, lines: Sequence[str] = ()) -> Panels:
    """Side force, depth of the groove and burst pressure along the casing.

    table : of ``casing_wear``, SI.  Of one wear factor there is one curve of each.
    """
    metre = shown("md_m", units)
    one = (table["low_groove_m"] == table["high_groove_m"]).all()
    panels = []
    for label, columns in PANELS.items():
        unit = shown(next(iter(columns)), units)
        curves = [
            Curve(of[name].to_numpy(float) * unit.factor, of["md_m"].to_numpy(float) * metre.factor, words, colour)
            for name, (words, colour) in columns.items()
            if name in table and not (one and words.startswith("lowest"))
            for _, of in table.groupby("casing", sort=False)
        ]
        panels.append(Panel(f"{label}, {unit.label}", curves))
    return Panels(case.name, list(lines), f"measured depth, {metre.label}", panels)
