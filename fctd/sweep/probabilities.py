"""Probabilities over the samples: of lock-up, of buckling, of no or a doubtful answer, and of exceeding limits.

A limit of string or rig is an event where a sample has its note; other limits stand in the sweep file.

Intervals of 95 % are Wilson's (1927), which are sound for no and for few events, too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.results.buckling import BUCKLED, HELICAL, MODES
from fctd.results.notes import BORNE
from fctd.results.status import ACCEPTABLE
from fctd.sweep.limits import LimitSpec
from fctd.sweep.percentiles import columns_of, places_of

if TYPE_CHECKING:
    import pandas as pd

LOCKED_UP, IS_BUCKLED, IS_HELICAL, NO_ANSWER = "locked up", "buckled", "buckled helically", "no answer"
# Statuses of rows with an answer: of steady strings, of runs, of refinements.
ANSWERED: Final = (
    "converged", "locked_up", "rolling", "under_resolved", "unstable", "completed", "inaccurate", "within_tolerance",
    "not_reached",
)  # fmt: skip

# Those of them whose loads are to be doubted.
DOUBTED: Final = tuple(sorted(set(ANSWERED) - ACCEPTABLE))


def probability_table(rows: pd.DataFrame, limits: Sequence[LimitSpec], samples: int) -> pd.DataFrame:
    """A row for every event and place, and one for every event anywhere in an operation, whose bit_depth_m is NaN.

    samples : their number; a sample without any row of an operation counts as no answer there, and otherwise as none of
    the events.  Columns: operation, bit_depth_m, event, probability, low and high (95 %), count, samples.
    """
    import pandas as pd

    events = _events(rows, limits)
    places = places_of(rows)
    found = []
    answered = rows[rows["operation"].notna()] if "operation" in rows else rows
    for operation, of in answered.groupby("operation", sort=True):
        lacking = samples - of["sample"].nunique()
        for name, happened in events.items():
            here = happened.loc[of.index]
            extra = lacking if name == NO_ANSWER else 0
            anywhere = int(here.groupby(of["sample"]).any().sum()) + extra
            found.append(_row(operation, float("nan"), name, anywhere, samples))
            if "bit_depth_m" in places:
                for depth, count in here.groupby(of["bit_depth_m"]).sum().items():
                    found.append(_row(operation, float(str(depth)), name, int(count) + extra, samples))
    return pd.DataFrame(found)


def _events(rows: pd.DataFrame, limits: Sequence[LimitSpec]) -> Mapping[str, pd.Series[bool]]:
    status = rows["status"]
    events = {NO_ANSWER: ~status.isin(ANSWERED)}
    events |= {name.replace("_", " "): status == name for name in DOUBTED if (status == name).any()}
    if "buckling" in rows:
        events |= {
            LOCKED_UP: status == "locked_up",
            IS_BUCKLED: rows["buckling"].isin(BUCKLED),
            IS_HELICAL: rows["buckling"] == MODES[HELICAL],
        }
    if "notes" in rows:
        noted = {code: rows["notes"].astype(str).str.contains(rf"\b{code}\b") for code in BORNE}
        events |= {f"beyond {code.replace('_', ' ')}": beyond for code, beyond in noted.items() if beyond.any()}
    for i, limit in enumerate(limits):
        columns_of(rows, [limit.column], f"uncertainty.limits[{i}].column")
        values = rows[limit.column]
        events[limit.event] = values > limit.bound if limit.side == "above" else values < limit.bound
    return events


def _row(operation: Any, depth: float, event: str, count: int, samples: int) -> dict[str, Any]:
    low, high = interval(count, samples)
    return {
        "operation": operation, "bit_depth_m": depth, "event": event, "probability": count / samples, "low": low,
        "high": high, "count": count, "samples": samples,
    }  # fmt: skip


def interval(count: int, samples: int) -> tuple[float, float]:
    """Wilson's interval of 95 % of a probability, of which ``count`` of ``samples`` events were seen."""
    from scipy import stats

    found = stats.binomtest(count, samples).proportion_ci(0.95, method="wilson")
    return float(np.clip(found.low, 0, 1)), float(np.clip(found.high, 0, 1))
