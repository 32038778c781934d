"""Intervals against closed forms, profiles where the Hessian misleads, and leaving out rows."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.calibration.calibrate import calibrate
from fctd.calibration.intervals import Z95, leave_one_out
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Range, Row
from tests.calibration.wells import TURN, exact_rows, well

CASE = well()


def blocks(*weights: float | Range, fit: str = "rig.block_weight") -> Calibration:
    """The block's weight from rows in slips, whose noise is 10 kN."""
    ranges = [weight if isinstance(weight, Range) else Range(weight, weight) for weight in weights]
    rows = [replace(exact_rows()[-2], id=str(k), hookload=each) for k, each in enumerate(ranges)]
    return calibrate(CASE, rows, [fit], loss="linear", starts=1)


def test_the_interval_of_a_mean() -> None:
    found = blocks(220e3, 230e3, 240e3, 250e3)
    half = Z95 * 10e3 / 2
    assert found.intervals.low == pytest.approx([235e3 - half])
    assert found.intervals.high == pytest.approx([235e3 + half])
    assert found.intervals.how == ("Hessian",)


def test_an_interval_ends_at_a_bound() -> None:
    """230 kN read, and no less than 240 kN: the profile rises from there, √(2Δ) = √((x − 230)² − 10²)/10."""
    found = blocks(230e3, fit="rig.block_weight=240 kN:400 kN")
    assert found.intervals.how == ("profile (at a bound)",)
    assert found.intervals.low == pytest.approx([240e3])
    assert found.intervals.high == pytest.approx([230e3 + 10e3 * np.hypot(Z95, 1.0)], rel=2e-3)
    assert found.intervals.at_bound == ("rig.block_weight",)
    assert found.table["at_bound"].tolist() == [True]


def test_a_range_widens_the_interval_by_its_ends() -> None:
    found = blocks(Range(220e3, 250e3))
    assert found.intervals.how == ("profile (ranges)",)
    assert found.intervals.low == pytest.approx([220e3 - Z95 * 10e3], rel=2e-3)
    assert found.intervals.high == pytest.approx([250e3 + Z95 * 10e3], rel=2e-3)


def test_correlations_are_those_of_the_covariance() -> None:
    """Offset and torque per rpm of two tares: the line through two points, at 60 and 120 rev/min."""
    rows = [
        Row(str(rpm), "", float("nan"), "tare", exact_rows()[-2].rates._replace(spin=rpm * TURN), None, Range(t, t))
        for rpm, t in ((60, 1e3), (120, 1.5e3))
    ]
    found = calibrate(CASE, rows, ["rig.torque_offset", "rig.torque_per_rpm"], loss="linear", starts=1)
    X = np.array([[1, 60], [1, 120]])
    C = np.linalg.inv(X.T @ X) * 500.0**2
    assert found.correlations.iloc[0, 1] == pytest.approx(C[0, 1] / np.sqrt(C[0, 0] * C[1, 1]))
    # The slope's interval ends at zero, its bound, and the covariance of predictions is as narrow.
    assert found.intervals.how[0] == "profile (not quadratic)" or found.intervals.low[1] == 0.0
    assert found.intervals.covariance[1, 1] <= C[1, 1] * 1.01


def test_a_fit_without_each_row_predicts_it() -> None:
    found = blocks(220e3, 230e3, 260e3)
    table = leave_one_out(found.forward, found.fit, "linear")
    assert table["id"].tolist() == ["0", "1", "2"]
    assert table["predicted"].to_numpy() == pytest.approx([245e3, 240e3, 225e3])
    assert table["off"].to_numpy() == pytest.approx([2.5, 1.0, -3.5])
    assert table["rig.block_weight"].to_numpy() == pytest.approx([245e3, 240e3, 225e3])
