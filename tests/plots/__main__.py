"""``python -m tests.plots FOLDER``: draw the pictures to look at, each in colour and in grey, and two pages."""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from PIL import Image

from fctd import plots
from fctd.case.operations import KINDS
from fctd.results.series import FRICTION_LABEL
from tests.plots.made import BLOCK, chart, locked_chart, points, well
from tests.plots.test_feeding import OFF_BOTTOM, PRESSED, SLIDING, fed

CASE = well(bit={"weight_on_bit": 8e4}, rig={"block_weight": BLOCK}, mud={"density": 1200.0})
THREE = ["trip_out", "rotate_off_bottom", "trip_in"]


def measured() -> pd.DataFrame:
    """A point with its range, a range alone, and a point alone."""
    loads = {"hookload_N": [3.4e5, np.nan, 3.8e5], "hookload_low_N": [3.3e5, 4.6e5, np.nan],
             "hookload_high_N": [3.6e5, 5.0e5, np.nan]}  # fmt: skip
    torque = {
        f"surface_torque{end}_N_m": [np.nan, np.nan, value] for end, value in (("", 6e3), ("_low", 5e3), ("_high", 8e3))
    }
    indicator = {name.replace("hookload", "weight_indicator"): np.array(v) + BLOCK for name, v in loads.items()}
    rows = {"operation": ["trip_in", "trip_out", "rotate_off_bottom"], "bit_depth_m": [1600.0, 1700.0, 1500.0]}
    return pd.DataFrame(rows | loads | torque | indicator)


def states() -> pd.DataFrame:
    """Six curves with rows of every status, both shapes, and both modes of buckling."""
    table = chart(
        list(KINDS), [0.2], {"not_possible": "trip_out", "max_iterations": "trip_in", "unstable": "back_ream"}
    )
    parts = [table[table["operation"] != "drill_sliding"], locked_chart().assign(friction=0.2)]
    table = pd.concat(parts, ignore_index=True)
    at = (table["operation"] == "trip_in") & (table["bit_depth_m"] > 1700)
    table.loc[at, "hookload_low_N"], table.loc[at, "hookload_high_N"] = table["hookload_N"] - 2e4, table["hookload_N"]
    return table


def charts() -> dict[str, tuple[pd.DataFrame, dict[str, Any]]]:
    """Tables and options by name."""
    six, pairs = chart(list(KINDS), [0.2]), chart(THREE, [0.2, 0.3])
    pairs[FRICTION_LABEL] = pairs["friction"].map(lambda x: f"cased 0.20, open {x:.2f}")
    return {
        "one": (chart(["trip_in"], [0.2]), {}),
        "six": (six, {"load": "string"}),
        "fan": (chart(THREE, [0.2, 0.3]), {"measured": measured()}),
        "pairs": (pairs, {"warnings": ["wellbore.intervals[0].friction: a warning"]}),
        "nine": (chart(THREE, [0.1, 0.2, 0.3]), {"measured": measured()}),
        "twelve": (chart(list(KINDS), [0.2, 0.3]), {}),
        "factors": (chart(["trip_in"], [round(0.05 * k, 2) for k in range(1, 13)]), {}),
        "states": (states(), {"measured": measured()}),
        "locked": (locked_chart(), {}),
        "no_answer": (chart(["trip_in"], [0.2], {"diverged": "trip_in"}).head(5), {}),
    }


def main(folder: Path) -> None:
    figures = {
        f"{name}_{units}": plots.chart_figure(table, units, CASE, plots.ChartLook(**options))  # type: ignore[arg-type]
        for name, (table, options) in charts().items()
        for units in ("si", "field")
    }
    alone = next(point for point in points() if point.operation == "drill_sliding")
    figures["profile_six"] = plots.profile_figure(points(), "si")
    figures["profile_one"] = plots.profile_figure([alone], "field", force="joint")
    for units in ("si", "field"):
        figures[f"fed_on_bottom_{units}"] = plots.feeding_figure(fed("drill_sliding", OFF_BOTTOM + PRESSED), units)  # type: ignore[arg-type]
        figures[f"fed_off_bottom_{units}"] = plots.feeding_figure(fed("trip_in", SLIDING), units)  # type: ignore[arg-type]
    for name, figure in figures.items():
        (path,) = plots.save(figure, folder / f"{name}.png")
        with Image.open(path) as picture:
            picture.convert("L").save(folder / f"{name}_grey.png")
        print(path)
    plots.save_page(
        plots.chart_page(states(), "si", CASE, plots.ChartLook(measured=measured())), folder / "states.html"
    )
    plots.save_page(plots.profile_page(points()), folder / "profile.html")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
