"""Errors of engines on one window: the start that is shifted, and the row of an engine."""

import numpy as np
import pandas as pd
import pytest

from fctd.mechanics import state
from fctd.simulation.preparation import prepare
from references import engines
from references.engines import Window
from validation.parts import gated
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
    assert 0 < row["real_time_factor_low"] <= row["real_time_factor"] <= row["real_time_factor_high"]


def test_the_gate_judges_every_table_with_a_speed_and_refuses_tables_without_one() -> None:
    """A column that was renamed left the engines of rivals unjudged."""
    loads = pd.DataFrame({"engine": ["own"], "hookload_kN": [1.0]})
    tables, gates = gated.held({"loads": loads.assign(real_time_factor=2.0), "apart": loads}, {"own": ("fctd", {})})
    assert tables["loads"]["gate"].tolist() == ["passed"]
    assert all(rule.passed for rule in gates["own"])
    assert "gate" not in tables["apart"]
    with pytest.raises(ValueError, match="real_time_factor"):
        gated.held({"loads": loads}, {"own": ("fctd", {})})
