"""``fctd refine`` on real surveys, which are slightly bent everywhere."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case
from fctd.model.layouts import Components, uniform
from validation.cases import load
from validation.cases.wells import real_well
from validation.harness.study import Context, Outcome, Rows, Study
from validation.parts.refinement import REFERENCE, in_arcs, judge, loads

COUNTS = (40, 80, 160, 320, 640)
# Where the lowest joint is, in segments above the bit.
SHIFTS = tuple(k / 8 for k in range(3, 11))
WELL_9 = {"md": "Measured Depth ( ft )", "inc": "Inclination ( deg )", "azi": "Azimuth Grid ( deg )"}


def wells(context: Context) -> dict[str, tuple[Case, float]]:
    """Cases and bit depths, 5 in pipe in 8.5 in hole."""
    bit = 2400.0
    short: dict[str, Any] = {
        "wellbore__columns": WELL_9, "wellbore__intervals__0__to_md": bit, "string__components__0__length": bit,
        "operations": [],
    }  # fmt: skip
    assert context.data is not None  # the runner has checked that the data are there
    horizontal = context.data / "surveys" / "wellpathpy_well9_horizontal_reference.csv"
    return {
        "K05-ENC-05-S1": (real_well(context), 8161.0),
        "well 9": (load("nlog_k05", wellbore__survey=horizontal, **short), bit),
    }


def scatter(name: str, case: Case, bit: float, counts: tuple[int, ...]) -> Rows:
    """Errors of uniform strings, mean and standard deviation as their joints are shifted by eighths of a segment."""
    case = in_arcs(case)
    total = bit - case.string.top_md
    exact = np.array(loads(case, uniform, bit, total / REFERENCE)[1:])
    for count in counts:
        found = [loads(case, partial(_shifted, by=shift), bit, total / count)[1:] for shift in SHIFTS]
        off = 100 * (np.array(found) / exact - 1)
        row: dict[str, Any] = {"well": name, "segments": count}
        for column, quantity in zip(off.T, ("torque", "hookload"), strict=True):
            row |= {f"{quantity}_off_percent": column.mean(), f"{quantity}_scatter_percent": column.std(ddof=1)}
        yield row


def _shifted(case: Case, bit_depth: float, length: float, *, by: float) -> Components:
    """A uniform string of one component with its lowest joint ``by`` segments above the bit."""
    (part,) = case.string.components
    lowest = {"length": by * length, "segments": 1, "segment_length": None}
    # More segments than fit into the hole: the surplus is above the surface, and the joints keep their spacing.
    rest = {"length": bit_depth - case.string.top_md + length, "segments": None, "segment_length": length}
    return part.model_copy(update=lowest), part.model_copy(update=rest)


def run(context: Context) -> Outcome:
    """An extended-reach well and a horizontal one."""
    cases = wells(context)
    shifted = pd.DataFrame([row for name, (case, bit) in cases.items() for row in scatter(name, case, bit, COUNTS)])
    share = (shifted["torque_scatter_percent"] / shifted["torque_off_percent"].abs()).max()
    outcome = judge(
        cases,
        context,
        "Hole, string, mud and friction are assumed, the surveys are real: 568 stations over 8,161 m, 121 over "
        "2,415 m.",
        "No number of the layouts was chosen on these wells.",
        f"The torque error of a uniform string changes by no more than {100 * share:.0f} % of itself (standard "
        "deviation) as its joints are shifted: segments miss the bends of the survey between joints wherever the "
        "joints fall.",
    )
    title = "Error of uniform strings: mean, and scatter as their joints are shifted by eighths of a segment"
    return replace(
        outcome,
        tables=outcome.tables | {"scatter": shifted},
        display=outcome.display | {"scatter": title},
    )


STUDY = Study(
    "refine_real",
    "Is the error of fctd refine within its tolerance in a real well?",
    run,
    needs=("data",),
)
