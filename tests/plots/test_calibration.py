"""Pictures of calibrations: every reading is there in its unit, and names below the panels do not overlap."""

from dataclasses import replace

import pytest

from fctd import plots
from fctd.calibration.calibrate import calibrate
from fctd.calibration.predict import predict_rows
from fctd.calibration.rows import Range
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well
from tests.plots.made import texts_that_overlap

CASE = well()


def test_a_calibration_and_a_prediction_are_drawn() -> None:
    rows = measured_rows(CASE, TRUTH, blank_rows(CASE)[-3:])
    rows[1] = replace(rows[1], hookload=Range(220e3, 240e3))
    found = calibrate(CASE, rows, ["rig.block_weight", "rig.torque_offset"], starts=1)
    figure = plots.calibration_figure(found)
    hookload, torque, residuals, correlations = figure.axes
    assert [label.get_text() for label in hookload.get_xticklabels()] == ["rotate 1500", "slips", "tare"]
    assert [label.get_text() for label in torque.get_xticklabels()] == ["rotate 1500", "tare"]
    ends = [tuple(line.get_ydata()) for line in hookload.lines if len(line.get_ydata()) == 2]
    assert (220.0, 240.0) in [(round(a), round(b)) for a, b in ends]
    assert len(correlations.images) == 1
    assert residuals.get_ylabel().endswith("over noise")
    assert texts_that_overlap(figure) == []
    table = predict_rows(found.posterior, rows, {"": CASE})
    si, field = (plots.prediction_figure(table, "well", units).axes for units in ("si", "field"))
    assert [axes.get_ylabel() for axes in field] == ["weight indicator, klbf", "drive torque, kft·lbf"]
    loads = [[line.get_ydata()[0] for line in axes[0].lines if len(line.get_ydata()) == 1] for axes in (si, field)]
    assert loads[1] == pytest.approx([load / 4.4482216152605 for load in loads[0]])
