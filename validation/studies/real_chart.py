"""Charts of all operations on a real survey of eight kilometres: every depth must have a solution."""

import time
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import torque_drag
from fctd.results.status import SteadyStatus
from references.timing.stopwatch import rounds
from validation.cases.wells import real_well
from validation.harness.study import ENDS, Check, Context, Outcome, Study, in_columns
from validation.parts.recorded_kinds import RECORDED_KINDS

MEAN, ROUNDS = "mean_ms", 3  # time of a row on the wall, of so many charts


def run(context: Context) -> Outcome:
    """K05-ENC-05-S1, 5 in pipe in 8.5 in hole, 10 m segments, every 250 m; with and without weight on bit."""
    fine: dict[str, Any] = {
        "string__components__0__segments": None,
        "string__components__0__segment_length": "10 m",
        "bit__weight_on_bit": "50 kN",
        "bit__torque": "5 kN*m",
    }
    depths = [float(depth) for depth in range(500, 8162, 1000 if context.quick else 250)]
    parts = []
    for geometry in context.progress(["cylinders", "arcs"], "hole"):
        case = real_well(context, wellbore__geometry=geometry, **fine)
        chart = torque_drag(case, RECORDED_KINDS, depths)
        times = rounds(partial(torque_drag, case, RECORDED_KINDS, depths), ROUNDS, time.perf_counter)
        parts.append(chart.assign(geometry=geometry, **in_columns({MEAN: 1e3 * np.array(times) / len(chart)})))
    chart = pd.concat(parts, ignore_index=True)
    lost = sum(not SteadyStatus(status).has_loads for status in chart["status"])
    counts = chart.groupby(["geometry", "operation", "status"], sort=False).agg(
        rows=("iterations", "size"),
        most_iterations=("iterations", "max"),
        **{f"{MEAN}{end}": (f"{MEAN}{end}", "first") for end in ENDS},
    )
    return Outcome(
        tables={"chart": chart, "counts": counts.reset_index()},
        checks=[
            Check("rows without an answer", float(lost), 0, "at_most", "",
                  "every row converged, locked up or unstable"),
        ],
        notes=[
            "Hole, string, mud, friction (0.2) and bit loads are assumed, the survey is real: 568 stations, "
            "8,161 m, up to 816 segments.",
        ],
        display={"counts": "Rows by status"},
    )  # fmt: skip


STUDY = Study(
    "real_chart",
    "Does the steady solver find a solution at every depth of a real well?",
    run,
    needs=("data",),
    timed=True,
)
