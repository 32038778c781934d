"""Pictures of calibrations: every reading is there in its unit, and names below the panels do not overlap."""

from dataclasses import replace

import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fctd import plots
from fctd.calibration.calibrate import calibrate
from fctd.calibration.predict import predict_rows
from fctd.calibration.rows import Range
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well
from tests.plots.made import texts_that_overlap

CASE = well()
UNREAD = Range(float("nan"), float("nan"))


def test_a_calibration_and_a_prediction_are_drawn() -> None:
    rows = measured_rows(CASE, TRUTH, blank_rows(CASE)[-3:])
    rows[1] = replace(rows[1], hookload=Range(220e3, 240e3))
    found = calibrate(CASE, rows, ["rig.block_weight", "rig.torque_offset"], starts=1)
    figure = plots.calibration_figure(found)
    hookload, torque, residuals, correlations = figure.axes
    assert hookload.get_ylabel() == "bit depth, m"
    assert hookload.get_ylim()[0] > 1500 > 0 > hookload.get_ylim()[1]
    assert _depths_of(torque) == {0.0, 1500.0}  # of the tare and the string
    assert "Rows without a string (in slips, free drive) stand at depth 0." in _words_of(figure)
    ends = [tuple(line.get_xdata()) for line in hookload.lines if line.get_color() == "black"]
    assert (220.0, 240.0) in [(round(a), round(b)) for a, b in (end for end in ends if len(end) == 2)]
    assert len(correlations.images) == 1
    assert residuals.get_xlabel().endswith("over noise")
    assert texts_that_overlap(figure) == []
    table = predict_rows(found.posterior, rows, {"": CASE})
    si, field = (plots.prediction_figure(table, "well", units).axes for units in ("si", "field"))
    assert [axes.get_xlabel() for axes in field] == ["weight indicator, klbf", "drive torque, kft·lbf"]
    loads = [[line.get_xdata()[0] for line in axes[0].lines if len(line.get_xdata()) == 1] for axes in (si, field)]
    assert loads[1] == pytest.approx([load / 4.4482216152605 for load in loads[0]])


def test_what_was_not_measured_has_no_panel_and_one_unknown_no_correlations() -> None:
    rows = [replace(row, torque=UNREAD) for row in measured_rows(CASE, TRUTH, blank_rows(CASE)[:3])]
    rows[1] = replace(rows[1], hookload=Range(rows[1].hookload.low + 80e3, rows[1].hookload.high + 80e3))
    figure = plots.calibration_figure(calibrate(CASE, rows, ["rig.block_weight"], starts=1))
    assert [axes.get_xlabel() for axes in figure.axes] == ["weight indicator, kN", "fitted − measured, over noise"]
    assert f"Off by more than 2 of the noise: {rows[1].id}" in _words_of(figure)


def _depths_of(axes: Axes) -> set[float]:
    return {round(float(line.get_ydata()[0])) for line in axes.lines}


def _words_of(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.texts)
