"""The table of friction factors: hole, motion, and the rows that show each."""

from dataclasses import replace

import pytest

from fctd.calibration.calibrate import calibrate
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well

CASE = well()


def test_each_factor_has_its_rows() -> None:
    """Cased friction without open hole from the rows above the shoe, torque from those that turn."""
    rows = [
        replace(row, torque=row.torque if row.rates.spin else None)
        for row in measured_rows(CASE, TRUTH, blank_rows(CASE), 1)
    ]
    found = calibrate(
        CASE, rows, ["friction.cased", "friction.open", "rig.block_weight", "rig.torque_offset"], starts=1
    )
    table = found.factors.set_index(["hole", "motion"])
    assert list(table.index) == [
        ("cased hole", "sliding"), ("cased hole", "rotating"), ("open hole", "sliding"), ("open hole", "rotating")
    ]  # fmt: skip
    for (hole, motion), row in table.iterrows():
        assert row["value"] == found.values[f"friction.{str(hole).split()[0]}"]
        assert row["low"] < row["value"] < row["high"]
        for name in row["rows"]:
            assert name.startswith("rotate" if motion == "rotating" else "trip")
            assert hole == "cased hole" or not name.endswith(" 700")  # the bit is above the shoe
    assert table.loc[("open hole", "rotating"), "rows"][0] == "rotate 1500"


def test_one_factor_of_the_whole_hole_without_torque() -> None:
    rows = [replace(row, torque=None) for row in measured_rows(CASE, TRUTH, blank_rows(CASE)[:-1], 1)]
    found = calibrate(CASE, rows, ["friction", "rig.block_weight"], starts=1)
    assert found.factors["hole"].tolist() == ["whole hole", "whole hole"]
    assert found.factors["rows"].tolist()[1] == ()
    assert calibrate(CASE, rows, ["rig.block_weight"], starts=1).factors.empty
    assert found.factors["low"].tolist() == pytest.approx([found.intervals.low[0]] * 2)
