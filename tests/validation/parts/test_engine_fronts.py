"""Errors of engines on one window: the start that is shifted, and the row of an engine."""

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.simulation.preparation import prepare
from references import engines
from references.engines import Window
from validation.parts.engine_fronts import SHIFT, Shifted, engine_errors, the_case


def test_every_second_segment_starts_a_micrometre_aside() -> None:
    window = Window(1.0, 0.1)
    (run, _), (moved, _) = prepare(the_case(window)), prepare(the_case(window))
    engines.build("fctd").begin(run)
    Shifted(engines.build("fctd")).begin(moved)
    way = state.row(moved.S, state.X, moved.segments) - state.row(run.S, state.X, run.segments)
    np.testing.assert_allclose(way[::2], SHIFT, rtol=1e-6)
    assert (way[1::2] == 0).all()


def test_a_row_tells_an_engine_from_the_truth_itself_and_a_shifted_start() -> None:
    row = engine_errors([("FCTD", "fctd")], Window(20.0, 0.3)).iloc[0]
    assert (row["engine"], row["name"], row["status"]) == ("FCTD", "fctd", "valid")
    assert row["hookload_off_truth_percent"] == pytest.approx(0, abs=0.2)
    assert 0 < abs(row["torque_spread_percent"]) < 0.01
