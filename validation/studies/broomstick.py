"""The broomstick of the paper's well: hook load and torque over bit depth for several friction factors."""

import numpy as np
import pandas as pd

from fctd import torque_drag
from fctd.case.load import with_friction
from references.soft_string.integration import soft_string
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows

OPERATIONS = ("trip_in", "trip_out", "rotate_off_bottom")
FACTORS = (0.1, 0.2, 0.3)
CHECKED = 2450.0  # [m], where the soft string is computed as well


@table_of_rows
def by_soft_string(chart: pd.DataFrame) -> Rows:
    """Hook load at the deepest bit depth by the soft string and from the chart."""
    deepest = chart[chart["bit_depth_m"] == CHECKED]
    for kind, factor, stiff in zip(deepest["operation"], deepest["friction"], deepest["hookload_N"], strict=True):
        soft = soft_string(with_friction(load("paper_well"), factor), kind, CHECKED).hookload
        yield {
            "operation": kind,
            "friction": factor,
            "hookload_kN": stiff / 1e3,
            "soft_hookload_kN": soft / 1e3,
            "difference_percent": 100 * (stiff / soft - 1),
        }


def run(context: Context) -> Outcome:
    """A chart of three operations and friction factors, and the soft string at its deepest bit depth."""
    depths = np.arange(1750.0, CHECKED + 1, 100.0 if context.quick else 25.0)
    chart = torque_drag(load("paper_well"), OPERATIONS, [float(depth) for depth in depths], FACTORS)
    soft = by_soft_string(chart)
    loads = chart.pivot_table(index=["bit_depth_m", "friction"], columns="operation", values="hookload_N")
    # Friction lowers the hook load tripping in and raises it tripping out.
    wrong = (loads["trip_in"] > loads["rotate_off_bottom"] + 1) | (loads["trip_out"] < loads["rotate_off_bottom"] - 1)
    return Outcome(
        tables={"chart": chart, "soft": soft},
        checks=[
            Check("rows of the broomstick without an answer", float((chart["status"] != "converged").sum()), 0,
                  "at_most", "", "three operations and friction factors at every depth"),
            Check("depths at which friction pulls the wrong way", float(wrong.sum()), 0, "at_most", "",
                  "slacking off below rotating below picking up"),
            Check("hook load against the soft string at 2450 m, largest difference",
                  float(soft["difference_percent"].abs().max()), 1.0, "at_most", "%",
                  "a different model; in gentle bends the two agree"),
        ],
        display={"soft": "Hook load at 2450 m, stiff and soft string"},
    )  # fmt: skip


STUDY = Study("broomstick", "What are hook load and torque at every depth and friction factor?", run)
