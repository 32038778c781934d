"""Friction factors as a driller knows them: of cased and open hole, sliding and rotating, and whose rows they are."""

import re
from typing import Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.calibration.fit import Fit
from fctd.calibration.forward import Forward
from fctd.calibration.intervals import Intervals
from fctd.calibration.rows import Load
from fctd.calibration.unknowns import is_factor

Array = NDArray[np.float64]

# The reading that shows the factor of a motion: drag of a string that slides, torque of one that turns.
MOTIONS: Final[dict[str, Load]] = {"sliding": "hookload", "rotating": "torque"}
_DIRECTIONS: Final = {"axial": "sliding", "rotational": "rotating"}
# Rows are listed until they have this share of what the readings say of a factor.
SHARE: Final = 0.9


def friction_table(forward: Forward, best: Fit, intervals: Intervals) -> pd.DataFrame:
    """A row for each friction factor and motion: hole, motion, unknown, value, low and high of its 95 % interval, rows.

    rows : ids, the most informative first, that have nine tenths of what the readings say of the factor in that motion;
    none where no reading does.
    """
    table = []
    for k, name in enumerate(forward.names):
        if not is_factor(name):
            continue
        last = name.rpartition(".")[2]
        for motion, load in MOTIONS.items():
            if _DIRECTIONS.get(last, motion) == motion:
                rows = _rows_of(forward, best, k, load)
                table.append((_hole(name), motion, name, best.best[k], intervals.low[k], intervals.high[k], rows))
    return pd.DataFrame(table, columns=["hole", "motion", "unknown", "value", "low", "high", "rows"])


def _rows_of(forward: Forward, best: Fit, k: int, load: Load) -> tuple[str, ...]:
    """Rows that say most of an unknown by their readings of a load."""
    said: dict[str, float] = {}
    for i, reading in enumerate(forward.readings):
        if reading.row in best.used and reading.load == load and not np.isnan(reading.range.low):
            row = forward.rows[reading.row]
            said[row.id] = row.weight * float(best.evaluation.slopes[i, k] / reading.noise) ** 2
    order = sorted(said, key=lambda name: -said[name])
    below = np.cumsum([0.0, *(said[name] for name in order)])
    if not below[-1] > 0:
        return ()
    return tuple(name for name, before in zip(order, below, strict=False) if before < SHARE * below[-1])


def _hole(name: str) -> str:
    index = re.search(r"\[(\d+)\]", name)
    if index:
        return f"interval {index[1]}"
    kind = next((part for part in name.split(".")[1:] if part not in _DIRECTIONS), "")
    return {"cased": "cased hole", "open": "open hole"}.get(kind, "whole hole")
