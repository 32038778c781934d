"""``fctd.monitor``: from a series to factors and alarms, in one piece and row by row."""

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.monitoring.monitor import Monitor, result_of
from fctd.monitoring.synthetic import over_time, steady_readings
from tests.cases import make_case, pipe
from tests.monitoring.made import BLOCK, STEP_AT, readings, series, shared_chart, well


@pytest.fixture(autouse=True)
def _one_chart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)


def test_a_step_is_found_over_time_and_by_depth() -> None:
    for table in (series(), readings()):
        (alarm,) = fctd.monitor(well(), table).alarms
        assert STEP_AT - 40 <= alarm.start <= alarm.found <= STEP_AT + 75  # two and three stands of 25 m
        assert alarm.size == pytest.approx(0.15, abs=0.06)


def test_factors_of_a_series_over_time() -> None:
    """Noise of 1 kN and 1 %, and every kind of stretch at each stand."""
    table = fctd.monitor(well(), series()).stretches
    assert set(table["mode"]) == {"in_slips", "rotating", "pick_up", "slack_off"}
    known = table[table["friction"].notna() & (table["bit_depth_m"] > 850)]
    assert known["friction"].median() == pytest.approx(0.45, abs=0.02)
    assert ((known["friction_low"] < 0.45) & (known["friction_high"] > 0.45)).mean() > 0.9
    assert table.loc[table["mode"] == "in_slips", "weight_indicator_N"].to_numpy() == pytest.approx(BLOCK, rel=0.03)


def test_pieces_give_what_the_whole_gives() -> None:
    whole, watch, at_once = fctd.monitor(well(), series()), Monitor(well()), []
    for k in range(0, len(series()), 211):
        at_once += watch.feed(series().iloc[k : k + 211])
    at_once += watch.finish()
    pieces = result_of(watch)
    assert tuple(at_once) == whole.alarms
    assert pieces.told == whole.told
    pd.testing.assert_frame_equal(pieces.stretches, whole.stretches)


@pytest.mark.parametrize(
    "change",
    [
        {"bit_depth_m": 900.0, "hole_depth_m": 900.0},
        {"weight_indicator_N": 0.0},
        {"weight_indicator_N": 1e9, "drive_torque_N_m": 1e9},
        {"rpm": 60.0, "block_position_m": 5.0, "bit_depth_m": 1e6, "hole_depth_m": 2e6},
        {"bit_depth_m": -3.0},
    ],
    ids=["drilling alone", "no load", "absurd loads", "below the hole", "above the rig"],
)
def test_series_that_tell_nothing_end_without_alarm(change: dict[str, float]) -> None:
    found = fctd.monitor(well(), series().assign(**change).iloc[:600])
    assert found.alarms == ()
    factors = found.stretches["friction"].dropna().to_numpy(float)
    assert np.isfinite(factors).all()


def test_no_rows_and_one_row() -> None:
    for count in (0, 1):
        assert fctd.monitor(well(), series().iloc[:count]).stretches.empty


@pytest.mark.parametrize("wrong", [{"step": 0}, {"readings": 0.5}, {"fit": "liner"}])
def test_wrong_arguments_are_named(wrong: dict[str, object]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        fctd.monitor(well(), readings(), **wrong)  # type: ignore[arg-type]


@pytest.mark.slow
def test_slack_off_of_an_extended_reach_well_is_no_slips(monkeypatch: pytest.MonkeyPatch) -> None:
    """The wall carries most of the string that slides in: its load is below the half of its rotating weight."""
    monkeypatch.undo()
    stations = [[0.0, 0, 0], [300, 0, 0], [800, 75, 0], [3000, 75, 0]]
    intervals = [{"to_md": 3000.0, "diameter": 0.2159, "friction": 0.35}]
    case = make_case(
        stations, [pipe(None, None, inner_diameter=0.1086)], mud={"density": 1200.0}, rig={"block_weight": BLOCK},
        wellbore={"intervals": intervals, "geometry": "arcs", "survey_method": "minimum_curvature"},
    )  # fmt: skip
    at_depth = steady_readings(case, [2960.0, 2985.0])
    turning, _, down = at_depth["weight_indicator_N"].iloc[-3:] - BLOCK
    assert down < turning / 2
    found = fctd.monitor(case, over_time(at_depth, np.random.default_rng(0), BLOCK)).stretches
    assert found["mode"].value_counts().to_dict() == dict.fromkeys(("rotating", "pick_up", "slack_off", "in_slips"), 2)
    factors = found.loc[found["mode"] == "slack_off", "friction"].to_numpy(float)
    np.testing.assert_allclose(factors, 0.35, atol=0.02)
