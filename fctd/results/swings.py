"""Mean and swing of hook load and surface torque in every operation of a run, over whole periods of the string.

The string swings along itself and in torsion, and an instant of a swing is no result.  A mean over whole periods of the
slowest vibration is: for a string that only rotates, whose torsion nothing damps, it is the steady torque.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from fctd.arrays import Array

if TYPE_CHECKING:
    import pandas as pd


# Fewer whole periods than these are said where the table is printed.
ENOUGH_PERIODS = 2
# Top and bit turn as planned where a record has this share of the planned rotation, which they swing about.
AS_PLANNED = 0.95


class Span(NamedTuple):
    """An operation in time: when it begins, is steady (between its ramps) and ends [s].

    axial_period, torsional_period : of the string at its end [s].  rpm : planned rotation of the top [rev/min], 0 where
    the string does not turn.
    """

    operation: str
    start: float
    steady_from: float
    steady_to: float
    end: float
    axial_period: float
    torsional_period: float
    rpm: float = 0.0


class Swing(NamedTuple):
    """A load over the last whole periods of an operation's steady part, or over all of that where it is shorter.

    mean; swing : half of the difference between the largest and the smallest; peak : the largest of the whole
    operation, ramps included; period [s] and number of whole periods.
    """

    mean: float
    swing: float
    peak: float
    period: float
    periods: int


def swing_of(time: Array, history: pd.DataFrame, stem: str, unit: str, span: Span, period: float) -> Swing:
    """The swing of one load; time (n + 1,) : at the ends of the records, the start of the first included [s]."""
    mean = history[f"{stem}_{unit}"].to_numpy(float)
    least, most = (history[f"{stem}_{end}_{unit}"].to_numpy(float) for end in ("min", "max"))
    periods = int((span.steady_to - span.steady_from) / period + 1e-9)
    first = span.steady_to - periods * period if periods else span.steady_from
    impulse = np.append(0.0, np.cumsum(mean * np.diff(time)))
    before, after = np.interp([first, span.steady_to], time, impulse)
    inside = (time[:-1] < span.steady_to - 1e-6) & (time[1:] > first + 1e-6)
    whole = (time[:-1] < span.end - 1e-6) & (time[1:] > span.start + 1e-6)
    return Swing(
        float(after - before) / (span.steady_to - first),
        0.5 * float(most[inside].max() - least[inside].min()),
        float(most[whole].max()),
        period,
        periods,
    )


def _turning_from(time: Array, history: pd.DataFrame, span: Span) -> float:
    """When the steady part begins in which the string turns [s]; time : as of ``swing_of``.

    After the ramp the bit rests until the string is wound up, and a drive that is not stiff may be behind its plan.
    Till then the torque rises.  The string turns from the first record on in which top and bit turn as planned; without
    such a record the steady part is the whole one.
    """
    slower = history[["top_rpm", "bit_rpm"]].min(axis=1).to_numpy(float)
    inside = (time[1:] > span.steady_from + 1e-6) & (time[:-1] < span.steady_to - 1e-6)
    turning = time[:-1][inside & (slower >= AS_PLANNED * span.rpm)]
    return max(float(turning[0]), span.steady_from) if span.rpm > 0 and len(turning) else span.steady_from


def operations_table(history: pd.DataFrame, start: float, depth: float, spans: Sequence[Span]) -> pd.DataFrame:
    """A row for each operation of a run: when and where it was, hook load and surface torque, and the bit's rest.

    history : of the run, recorded from ``start`` [s] on, with the bit at ``depth`` [m] then.  Operations that the
    records do not reach are left out; one that was cut short is judged by what there is of it.  ``bit_still_share`` is
    the share of the steady time during which the bit did not turn, for an operation that turns the string; it begins
    when the string is wound up.
    """
    import pandas as pd

    rows = []
    time = np.append(start, history["time_s"].to_numpy(float)) if len(history) else np.array([start])
    for span in spans:
        low, high = max(span.start, time[0]), min(span.end, time[-1])
        if high <= low + 1e-6:
            continue
        steady = max(span.steady_from, low), min(span.steady_to, high)
        if steady[1] <= steady[0] + 1e-6:
            steady = low, high
        part = span._replace(start=low, end=high, steady_from=steady[0], steady_to=steady[1])
        part = part._replace(steady_from=_turning_from(time, history, part))
        reached = np.interp([low, high], time, np.append(depth, history["bit_depth_m"]))
        pull = swing_of(time, history, "hookload", "N", part, span.axial_period)
        twist = swing_of(time, history, "surface_torque", "N_m", part, span.torsional_period)
        still = np.append(0.0, np.cumsum(history["bit_still_s"]))
        turned = np.append(0.0, np.cumsum(history["top_rpm"] * np.diff(time)))
        ends = [part.steady_from, part.steady_to]
        rest, turns = (np.diff(np.interp(ends, time, total))[0] for total in (still, turned))
        rows.append(
            {
                "operation": span.operation,
                "start_s": low,
                "end_s": high,
                "from_bit_depth_m": reached[0],
                "to_bit_depth_m": reached[1],
                **_cells("hookload", "N", pull),
                **_cells("surface_torque", "N_m", twist),
                "bit_still_share": rest / (part.steady_to - part.steady_from) if turns > 0 else np.nan,
            }
        )
    return pd.DataFrame(rows)


def _cells(load: str, unit: str, swing: Swing) -> dict[str, float]:
    """The cells of a load's swing by their columns."""
    loads = {f"{load}_{name}_{unit}": getattr(swing, name) for name in ("mean", "swing", "peak")}
    return {**loads, f"{load}_period_s": swing.period, f"{load}_periods": swing.periods}
