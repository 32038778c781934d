"""The result of a calibration: the calibrated case, residuals, and rows left out."""

from dataclasses import replace

import pytest

from fctd.calibration.calibrate import calibrate
from fctd.calibration.rows import Range
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well


def test_a_calibrated_case_and_its_residuals() -> None:
    rows = measured_rows(well(), TRUTH, blank_rows(well()))[-5:]
    rows[0] = replace(rows[0], locked_torque=500.0)
    rows[3] = replace(rows[3], hookload=Range(220e3, 225e3))
    found = calibrate(well(), rows, ["rig.block_weight=100 kN:226 kN", "rig.torque_offset"], starts=1)
    assert found.values["rig.block_weight"] == pytest.approx(226e3)
    assert found.active == {"rig.block_weight": "highest"}
    assert found.case.rig.block_weight == pytest.approx(226e3)
    assert found.case.wellbore == well().wellbore
    assert found.strings == {"": found.case}
    assert list(found.left_out) == ["trip_out 1500"]
    table = found.residuals.set_index(["id", "load"])
    slips = table.loc[("slips", "hookload")]
    assert (slips.low, slips.high, slips.residual, slips.in_noise) == pytest.approx((220e3, 225e3, 1e3, 0.1))
    assert not table.loc[("trip_out 1500", "hookload")].used
    assert table["used"].sum() == len(table) - 2
    used = table[table["used"]]["in_noise"]
    assert found.misfit == pytest.approx((used**2).sum() / (len(used) - 2))
