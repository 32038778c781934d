"""Predictions of rows of well 15/9-F-4 from frozen values, with bands, and where the recorded ranges lie in them.

A band is that of what the source records: the values' covariance through the derivatives of the readings, the noise of
the readings, and the declared error of the model, all normal and added in squares.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.stats import norm

from fctd.arrays import Array
from fctd.calibration.forward import Evaluation, Forward
from fctd.calibration.rows import Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case
from validation.parts.volve_f4 import BANDS
from validation.parts.volve_f4_fits import Frozen


class Judged(NamedTuple):
    """What a row is judged on: its id, a quantity, and the readings that it combines, with their shares."""

    id: str
    quantity: str
    parts: tuple[tuple[int, float], ...]


def predict(
    strings: Mapping[str, Case],
    rows: Sequence[Row],
    setup: Setup,
    fitted: Frozen,
    absolute: Collection[str] = (),
    route: type[Forward] = Forward,
) -> pd.DataFrame:
    """A row for each judged quantity [kN, kN m]: recorded range, median, bands, whether they meet, distance, CRPS.

    absolute : ids of the rows whose weights are judged; route : how the loads of a string are computed.
    """
    unknowns = find_unknowns({}, setup, list(strings.values()))
    forward = route(rows, strings, unknowns, setup)
    evaluation = forward.evaluate(np.array([fitted.best[name] for name in forward.names]))
    order = [list(fitted.best).index(name) for name in forward.names]
    covariance = fitted.covariance[np.ix_(order, order)]
    return pd.DataFrame([_row(forward, evaluation, covariance, one) for one in judged(forward, absolute)])


def judged(forward: Forward, absolute: Collection[str]) -> list[Judged]:
    """Torques, halves of the spread of up and down weight, and weights of the strings whose mass another row fixed."""
    at: dict[tuple[str, str], int] = {
        (forward.rows[r.row].id, r.load): i for i, r in enumerate(forward.readings) if not np.isnan(r.range.low)
    }
    found = []
    for key in dict.fromkeys(row.id.rsplit(" ", 1)[0] for row in forward.rows):
        torque, up, down = (
            at.get((f"{key} {label}", load))
            for label, load in (("rotating", "torque"), ("up", "hookload"), ("down", "hookload"))
        )
        if torque is not None:
            found.append(Judged(key, "torque", ((torque, 1.0),)))
        if up is not None and down is not None:
            found.append(Judged(key, "half spread", ((up, 0.5), (down, -0.5))))
        for label in ("up", "down", "rotating"):
            weight = at.get((f"{key} {label}", "hookload"))
            if key in absolute and weight is not None:
                found.append(Judged(key, f"weight {label}", ((weight, 1.0),)))
    return found


def _row(forward: Forward, evaluation: Evaluation, covariance: Array, one: Judged) -> dict[str, object]:
    """The prediction of a quantity and its score."""
    readings = [(forward.readings[i], share) for i, share in one.parts]
    slopes = np.array([share * evaluation.slopes[i] for i, share in one.parts]).sum(axis=0)
    median = sum(share * float(evaluation.value[i]) for i, share in one.parts)
    error = getattr(forward.setup.model_error, readings[0][0].load)
    added = sum(share**2 * (reading.noise**2 + error**2) for reading, share in readings)
    sd = float(np.sqrt(slopes @ covariance @ slopes + added))
    low, high = (sum(share * getattr(reading.range, end) for reading, share in readings) for end in ("low", "high"))
    unit = 1e-3
    off = max(low - median, median - high, 0.0)
    bands = {share: float(norm.ppf(0.5 + share / 2)) * sd for share in BANDS}
    edges = {
        f"{end}_{100 * share:.0f}": unit * (median + sign * width)
        for share, width in bands.items()
        for end, sign in (("low", -1), ("high", 1))
    }
    inside = {f"in_{100 * share:.0f}": bool(off <= width) for share, width in bands.items()}
    z = (0.5 * (low + high) - median) / sd
    # Normal prediction: Gneiting & Raftery 2007, Eq. 5.
    crps = sd * float(z * (2 * norm.cdf(z) - 1) + 2 * norm.pdf(z) - 1 / np.sqrt(np.pi))
    return {
        "row": one.id, "quantity": one.quantity, "unit": "kN m" if one.quantity == "torque" else "kN",
        "measured_low": unit * low, "measured_high": unit * high, "median": unit * median, **edges, **inside,
        "distance_percent": 100 * off / (0.5 * (low + high)), "crps": unit * crps,
    }  # fmt: skip
