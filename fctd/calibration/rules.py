"""Rows that are left out by rule: strokes that end with torque locked in, and strokes too short to move the string."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from fctd.calibration.rows import Row
from fctd.case.load import Case
from fctd.case.message import Message, quantity
from fctd.model.operations import SteadyRates
from fctd.steady.equilibrium import Solver

# A stroke must be this many times as long as the stretch that its reversal takes.
STRETCHES: Final = 3.0


def left_out_by_rule(rows: Sequence[Row], strings: Mapping[str, Case]) -> dict[int, str]:
    """The reasons of the rows that cannot be used, by index.

    At a reversal the top moves by the stretch before the bit does, and the pull passes through all values between
    those of both directions; torque locked in at the end of a stroke uses a part of the friction.
    """
    found: dict[int, str] = {}
    stretches: dict[tuple[str, float], float] = {}
    for k, row in enumerate(rows):
        if row.locked_torque:
            found[k] = Message(
                f"the stroke ended with {quantity(1e-3 * row.locked_torque, 'kN·m')} locked in the string"
            )
        elif row.has_string and not np.isnan(row.stroke) and not row.rates.spin:
            key = row.string, row.bit_depth
            if key not in stretches:
                stretches[key] = stretch_at_reversal(strings[row.string], row.bit_depth)
            least = STRETCHES * stretches[key]
            if np.isnan(least):
                found[k] = "the stretch at its reversal has no answer: the string cannot be moved both ways"
            elif row.stroke < least:
                found[k] = Message(
                    f"a stroke of {quantity(row.stroke, 'm', '.3g')}, shorter than {STRETCHES:g} times the string's "
                    f"stretch at reversal, {quantity(stretches[key], 'm', '.3g')}"
                )
    return found


def stretch_at_reversal(case: Case, bit_depth: float) -> float:
    """What the string is longer moving up than moving down at a bit depth [m], ∫ ΔF/EA dl; NaN without both."""
    solver = Solver(case)
    laid = solver.lay_out(bit_depth)
    tensions = []
    for kind, speed in (("trip_out", -0.1), ("trip_in", 0.1)):
        point = solver.solve_string(kind, SteadyRates(speed, 0.0), laid)
        if not point.answered:
            return float("nan")
        tensions.append(point.profile["effective_tension_N"].to_numpy(float))
    up, down = tensions
    difference = 0.5 * ((up - down)[1:] + (up - down)[:-1])  # from the ends of the segments to their middles
    return float((difference * laid.string.length / laid.string.of("EA")).sum())
