"""Predictions of rows of well 15/9-F-4 from frozen values, with bands, and where the recorded ranges lie in them.

A band is that of what the source records: the values' covariance through the derivatives of the readings, the noise of
the readings, and the declared error of the model, all normal and added in squares.
"""

from collections.abc import Collection, Mapping, Sequence

import numpy as np
import pandas as pd

from fctd.arrays import Array
from fctd.calibration.forward import Evaluation, Forward
from fctd.calibration.rows import Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case
from validation.parts.judging import BANDS, UNITS, Judged, line
from validation.parts.volve_f4_fits import Frozen


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
    from scipy.stats import norm

    readings = [(forward.readings[i], share) for i, share in one.parts]
    slopes = np.array([share * evaluation.slopes[i] for i, share in one.parts]).sum(axis=0)
    median = sum(share * float(evaluation.value[i]) for i, share in one.parts)
    error = getattr(forward.setup.model_error, readings[0][0].load)
    added = sum(share**2 * (reading.noise**2 + error**2) for reading, share in readings)
    sd = float(np.sqrt(slopes @ covariance @ slopes + added))
    low, high = (sum(share * getattr(reading.range, end) for reading, share in readings) for end in ("low", "high"))
    unit = 1e-3
    widths = {share: float(norm.ppf(0.5 + share / 2)) * sd for share in BANDS}
    z = (0.5 * (low + high) - median) / sd
    # Normal prediction: Gneiting & Raftery 2007, Eq. 5.
    crps = sd * float(z * (2 * norm.cdf(z) - 1) + 2 * norm.pdf(z) - 1 / np.sqrt(np.pi))
    ends = {share: (unit * (median - width), unit * (median + width)) for share, width in widths.items()}
    low, high, median = unit * low, unit * high, unit * median
    # A range is in a band where it meets it.
    row = line(
        one, UNITS[readings[0][0].load], low, high, median, ends,
        lambda bottom, top: bool(low <= top and bottom <= high),
    )  # fmt: skip
    return {**row, "crps": unit * crps}
