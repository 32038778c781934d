"""Series with known friction: readings of the steady string with noise, by depth or over time, from a seed."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.friction import Pair, changed, pairs_of
from fctd.case.load import Case
from fctd.case.message import quantity, within
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.monitoring.stretches import OF_KIND
from fctd.steady.equilibrium import Solver

STROKE, OFF_BOTTOM = 10.0, 2.0  # [m] of pick-up and slack-off, and how far above the bottom they end
SPEED = 0.25  # [m/s] of strokes
DRILLING, TURNING, SLIPS = 600.0, 120.0, 240.0  # [s] of drilling a stand, rotating off bottom, and a connection
BIT_TORQUE, BIT_WEIGHT = 3e3, 60e3  # [N m], [N] of drilling


def with_step(case: Case, from_md: float, share: float) -> Case:
    """The case whose open hole has its friction factors times 1 + share below a depth [m] alone."""
    intervals = []
    top = 0.0
    for interval in case.wellbore.intervals:
        (own,) = pairs_of([interval])
        (raised,) = changed([interval], [Pair(own.along * (1 + share), own.around * (1 + share))])
        if interval.kind != "open" or interval.to_md <= from_md:
            intervals.append(interval)
        elif top >= from_md:
            intervals.append(raised)
        else:
            intervals += [interval.model_copy(update={"to_md": from_md}), raised]
        top = interval.to_md
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": tuple(intervals)})})


def raised(case: Case, share: float) -> Case:
    """The case whose whole open hole has its friction factors times 1 + share."""
    return with_step(case, 0.0, share)


def steady_readings(case: Case, depths: Sequence[float]) -> pd.DataFrame:
    """What the rig reads of a steady string at bit depths [m]: a series by depth [SI], three rows a depth.

    Raises InputError where there is no steady string.
    """
    solver, rates = Solver(case), rates_of_all(case, list(OF_KIND))
    return pd.DataFrame([_row(solver, kind, rates[kind], depth) for depth in depths for kind in OF_KIND])


def _row(solver: Solver, kind: str, rates: SteadyRates, depth: float) -> dict[str, object]:
    point = solver.solve(kind, rates, depth)
    if not point.answered:
        raise InputError(
            f"a depth with a steady string ({within(point.message)})", key="bit_depth", value=quantity(depth, "m")
        )
    return {
        "operation": kind, "bit_depth_m": depth, "weight_indicator_N": point.weight_indicator,
        "drive_torque_N_m": point.drive_torque, "rpm": rates.spin * 30 / np.pi,
    }  # fmt: skip


def with_noise(
    rows: pd.DataFrame, generator: np.random.Generator, hook_load: float = 9.80665e3, torque: float = 0.04
) -> pd.DataFrame:
    """Rows with normal noise of standard deviations hook_load [N] and torque (share of the reading)."""
    count = len(rows)
    return rows.assign(
        weight_indicator_N=rows["weight_indicator_N"] + hook_load * generator.standard_normal(count),
        drive_torque_N_m=rows["drive_torque_N_m"] * (1 + torque * generator.standard_normal(count)),
    )


def over_time(
    rows: pd.DataFrame, generator: np.random.Generator, block_weight: float, interval: float = 5.0
) -> pd.DataFrame:
    """A series over time [SI] of drilled stands, with the readings of a series by depth at the end of each.

    Of every stand: drilling, rotation off bottom, pick-up, slack-off, slips.  interval [s] between rows; each row has a
    noise of its own beside that of the reading, 2 kN and 2 % of torque.
    """
    depths = np.unique(rows["bit_depth_m"].to_numpy(float))
    readings = rows.set_index(["bit_depth_m", "operation"])
    turn, out, down = (readings.xs(kind, level="operation") for kind in OF_KIND)
    parts: list[pd.DataFrame] = []
    strokes = STROKE / SPEED
    for before, depth in pairwise([depths[0] - (depths[1] - depths[0]), *depths]):
        load, torque = turn.loc[depth, "weight_indicator_N"], turn.loc[depth, "drive_torque_N_m"]
        rpm = turn.loc[depth, "rpm"]
        stand, low = depth - before, depth - OFF_BOTTOM
        phases = [  # duration, bit depth from and to, weight indicator, torque, rpm, weight on bit
            (DRILLING, before, depth, load - BIT_WEIGHT, torque + BIT_TORQUE, rpm, BIT_WEIGHT),
            (OFF_BOTTOM / SPEED, depth, low, load, torque, rpm, 0.0),
            (TURNING, low, low, load, torque, rpm, 0.0),
            (strokes, low, low - STROKE, out.loc[depth, "weight_indicator_N"], 0.0, 0.0, 0.0),
            (strokes, low - STROKE, low, down.loc[depth, "weight_indicator_N"], 0.0, 0.0, 0.0),
            (SLIPS, low, low, block_weight, 0.0, 0.0, 0.0),
        ]
        for duration, start, end, hook, twist, turns, on_bit in phases:
            count = max(round(duration / interval), 1)
            bit = start + (end - start) * np.arange(1, count + 1) / count
            block = 2.0 + depth - bit if hook != block_weight else 2.0 + np.linspace(OFF_BOTTOM, stand, count)
            parts.append(
                pd.DataFrame(
                    {
                        "hole_depth_m": np.maximum(bit, before) if on_bit else depth, "bit_depth_m": bit,
                        "block_position_m": block, "weight_indicator_N": hook, "drive_torque_N_m": twist, "rpm": turns,
                        "weight_on_bit_N": on_bit,
                    }
                )
            )  # fmt: skip
    table = pd.concat(parts, ignore_index=True)
    table.insert(0, "time_s", interval * np.arange(len(table)))
    noisy = with_noise(table, generator, 2e3, 0.02)
    noisy.index = pd.RangeIndex(1, len(table) + 1, name="row")
    return noisy
