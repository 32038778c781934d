"""What a fit with scatter costs: twelve rows of two assemblies on four days, through the engine."""

from collections.abc import Callable
from time import process_time
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd import Case, calibrate
from fctd.calibration.forward import Forward
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.model.operations import SteadyRates, rad_per_s, steady_rates
from validation.harness.study import Check, in_columns, time_check

TRUTH: Final = {
    "friction.cased": 0.20, "friction.open": 0.30, "rig.block_weight": 250e3, "rig.torque_offset": 800.0
}  # fmt: skip
DEPTHS: Final = (1200.0, 1500.0, 1700.0, 1950.0)
FIT, WHOLE, ROUNDS = 10.0, 120.0, 3  # processor time [s] of the fit, and with intervals and days left out


def twelve_rows(case: Case) -> tuple[pd.DataFrame, list[Check]]:
    """Cost and values of a fit with scatter; case : with collars, which the other assembly has half as long."""
    parts = case.string.components
    short = parts[0].model_copy(update={"length": 0.5 * float(parts[0].length or 0.0)})
    string = case.string.model_copy(update={"components": (short, *parts[1:])})
    strings = {"": case, "short": case.model_copy(update={"string": string})}
    rows = _rows(case, strings)
    solved: list[int] = []
    found = calibrate(case, rows, [*TRUTH], strings=strings, loss="linear", progress=solved.append)
    fits, wholes = fit_times(lambda: calibrate(case, rows, [*TRUTH], strings=strings, loss="linear"))
    table = found.table.assign(strings_solved=max(solved), **in_columns({"fit_s": fits, "whole_s": wholes}))
    source = "a target of this project; processor time"
    return table, [
        time_check("scatter: fit of twelve rows of two assemblies", fits, FIT, "s", source),
        time_check("scatter: with intervals and each day left out", wholes, WHOLE, "s", source),
    ]


def fit_times(fit: Callable[[], Any]) -> tuple[list[float], list[float]]:
    """Processor times [s] of fits alone, and of fits with their intervals and each day left out.

    fit : has a result with ``table`` and ``leave_one_out``, which are found when they are asked for.
    """
    fits, wholes = [], []
    for _ in range(ROUNDS):
        begun = process_time()
        found = fit()
        fits.append(process_time() - begun)
        assert len(found.table)
        assert len(found.leave_one_out)
        wholes.append(process_time() - begun)
    return fits, wholes


def _rows(case: Case, strings: dict[str, Case]) -> list[Row]:
    """Up, down and turning on four days, two with each assembly, with a scatter of 10 % and 20 kN."""
    rng, found = np.random.default_rng(33), []
    for day, depth in enumerate(DEPTHS):
        name = ("", "short")[day % 2]
        kinds = {"trip_out": None, "trip_in": None, "rotate_off_bottom": SteadyRates(0.0, rad_per_s(60.0))}
        rows = [
            Row(f"{kind} {depth:g}", name, depth, kind, rates or steady_rates(case, kind), day=f"day {day}")
            for kind, rates in kinds.items()
        ]
        forward = Forward(rows, strings, find_unknowns(parse_fits([*TRUTH]), Setup(), [case]), Setup())
        scale, weight = np.exp(0.1 * rng.normal()), 20e3 * rng.normal()
        truth = np.array([v * scale if k.startswith("friction") else v for k, v in TRUTH.items()])
        value = forward.evaluate(truth).value
        for reading, read in zip(forward.readings, value, strict=True):
            noisy = float(read + weight * (reading.load == "hookload") + reading.noise * rng.normal())
            if reading.load == "hookload" or rows[reading.row].rates.spin:
                rows[reading.row] = rows[reading.row].with_reading(reading.load, Range(noisy, noisy))
        found += rows
    return found
