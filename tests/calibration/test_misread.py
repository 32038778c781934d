"""Rows with the traps of daily reports are doubted, each in one sentence, and others are not."""

from dataclasses import replace

import pytest

from fctd.calibration.calibrate import calibrate
from fctd.calibration.rows import Range, Row
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well

CASE = well()
FITS = ("friction", "rig.block_weight", "rig.torque_offset")


def report(seed: int | None = 1) -> dict[str, Row]:
    """Pick-up, slack-off and rotating at three depths, a report each, with torques of the rotating string alone."""
    rows = measured_rows(CASE, TRUTH, blank_rows(CASE)[:9], seed)
    found = {}
    for row in rows:
        torque = row.torque if row.operation == "rotate_off_bottom" else None
        found[row.id] = replace(row, torque=torque, day=f"{row.bit_depth:g} m", torque_read="off_bottom")
    return found


def doubted(rows: dict[str, Row]) -> dict[str, str]:
    found = calibrate(CASE, [*rows.values()], FITS, priors=["rig.block_weight=230e3+-30e3"], starts=1, scatter=False)
    return dict(found.misread)


@pytest.mark.parametrize("seed", [None, 1, 2, 3])
def test_sound_rows_are_not_doubted(seed: int | None) -> None:
    assert doubted(report(seed)) == {}


def test_readings_carried_over_from_the_report_before() -> None:
    rows = report()
    names = ("trip_out", "trip_in", "rotate")
    for name in names:
        before = rows[f"{name} 1100"]
        rows[f"{name} 1500"] = replace(rows[f"{name} 1500"], hookload=before.hookload, torque=before.torque)
    found = doubted(rows)
    for name in names:
        sentence = found[f"{name} 1500"]
        assert sentence.startswith("all 4 readings are those of 1100 m, 1100 m: carried over from there?")
    assert not any(name.endswith(("700", "1100")) for name in found)


def test_a_slack_off_above_the_rotating_weight() -> None:
    rows = report()
    rotating = rows["rotate 1100"].hookload
    assert rotating is not None
    rows["trip_in 1100"] = rows["trip_in 1100"].with_reading("hookload", Range(*[rotating.high + 20e3] * 2))
    found = doubted(rows)
    assert list(found) == ["trip_in 1100"]
    load = f"{1e-3 * rotating.high + 20:.6g} kN"
    assert found["trip_in 1100"].startswith(f"a slack-off weight of {load} above the rotating")


def test_a_pick_up_below_the_slack_off_where_nothing_turned() -> None:
    rows = report()
    del rows["rotate 700"]
    up, down = rows["trip_out 700"], rows["trip_in 700"]
    rows["trip_out 700"], rows["trip_in 700"] = replace(up, hookload=down.hookload), replace(down, hookload=up.hookload)
    assert "above the pick-up weight" in doubted(rows)["trip_out 700"]


@pytest.mark.parametrize(("share", "expected"), [(0.1, "a dropped digit?"), (10.0, "a digit too many?")])
def test_a_digit(share: float, expected: str) -> None:
    rows = report()
    read = rows["trip_out 1100"].hookload
    assert read is not None
    rows["trip_out 1100"] = rows["trip_out 1100"].with_reading("hookload", Range(share * read.low, share * read.high))
    found = doubted(rows)["trip_out 1100"]
    assert expected in found
    torque = rows["rotate 1500"].torque
    assert torque is not None
    rows = report()
    rows["rotate 1500"] = rows["rotate 1500"].with_reading("torque", Range(share * torque.low, share * torque.high))
    assert expected in doubted(rows)["rotate 1500"]
