"""Answers from the rig's readings: they show and draw themselves."""

import pytest

import fctd
from tests.calibration.wells import TRUTH, blank_rows, measured_rows
from tests.calibration.wells import well as measured_well
from tests.monitoring.made import readings, shared_chart, well


def test_a_calibration() -> None:
    rows = measured_rows(measured_well(), TRUTH, blank_rows(measured_well()))[-5:]
    found = fctd.calibrate(measured_well(), rows, ["rig.block_weight", "rig.torque_offset"], starts=1)
    assert repr(found).startswith("Calibration('test', 5 rows: rig.block_weight 2.")
    assert "rig.torque_offset" in found._repr_html_()
    assert found.plot()._repr_png_().startswith(b"\x89PNG")


def test_monitored_friction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)
    found = fctd.monitor(well(), readings())
    assert repr(found) == "Monitored('test': 42 stretches, 1 alarm)"
    assert found.alarms[0].sentence in found._repr_html_()
    assert found.plot("field")._repr_png_().startswith(b"\x89PNG")
