"""Mean and swing over whole periods, from made-up histories."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd.results.swings import Span, operations_table

PERIOD, MEAN, SWING = 4.3, 2000.0, 500.0


def history(end: float, interval: float = 0.1, **columns: Any) -> pd.DataFrame:
    """Means over intervals of a torque MEAN + SWING sin(2πt/PERIOD), of a hook load of 9 kN, and of a turning bit."""
    edges = np.arange(0.0, end + 1e-9, interval)
    w = 2 * np.pi / PERIOD
    torque = MEAN - SWING * np.diff(np.cos(w * edges)) / (w * interval)
    rows = {
        "time_s": edges[1:], "bit_depth_m": 1000.0, "hookload_N": 9e3, "hookload_min_N": 8e3, "hookload_max_N": 11e3,
        "surface_torque_N_m": torque, "surface_torque_min_N_m": MEAN - SWING, "surface_torque_max_N_m": MEAN + SWING,
        "top_rpm": 60.0, "bit_rpm": 60.0, "bit_still_s": 0.25 * interval,
    }  # fmt: skip
    return pd.DataFrame(rows | columns)


def span(steady_from: float, end: float, **more: Any) -> Span:
    return Span("rotate_off_bottom", 0.0, steady_from, end, end, 1.0, PERIOD)._replace(**more)


@pytest.mark.parametrize("end", [50.0, 51.3, 52.9, 54.0])
@pytest.mark.parametrize("interval", [0.1, 1.0, PERIOD])
def test_the_mean_over_whole_periods_does_not_depend_on_the_end(end: float, interval: float) -> None:
    """Exact to the interpolation within a record; a mean over all of the time is off by up to 6 %."""
    table = operations_table(history(np.ceil(end / interval) * interval, interval), 0.0, 1000.0, [span(10.0, end)])
    (row,) = table.to_dict("records")
    assert row["surface_torque_mean_N_m"] == pytest.approx(MEAN, rel=2e-3)
    assert row["surface_torque_swing_N_m"] == SWING
    assert row["surface_torque_peak_N_m"] == MEAN + SWING
    assert row["surface_torque_periods"] == int((end - 10.0) / PERIOD)
    assert row["hookload_mean_N"] == pytest.approx(9e3)
    assert (row["hookload_swing_N"], row["hookload_periods"]) == (1500.0, int(end - 10.0))
    assert row["bit_still_share"] == pytest.approx(0.25)


def test_less_than_a_period_is_averaged_as_it_is() -> None:
    (row,) = operations_table(history(12.0), 0.0, 1000.0, [span(10.0, 12.0)]).to_dict("records")
    w = 2 * np.pi / PERIOD
    assert row["surface_torque_periods"] == 0
    expected = MEAN - SWING * (np.cos(12 * w) - np.cos(10 * w)) / (2 * w)
    assert row["surface_torque_mean_N_m"] == pytest.approx(expected)


def test_a_peak_of_the_ramp_counts_and_its_swing_does_not() -> None:
    table = history(20.0)
    table.loc[20, "hookload_max_N"] = 50e3
    (row,) = operations_table(table, 0.0, 1000.0, [span(10.0, 20.0)]).to_dict("records")
    assert (row["hookload_peak_N"], row["hookload_swing_N"]) == (50e3, 1500.0)


@pytest.mark.parametrize(("top", "bit"), [(60.0, 0.0), (20.0, 20.0)])
def test_the_steady_part_begins_when_the_string_turns_as_planned(top: float, bit: float) -> None:
    """Wound up from 0 to MEAN until 20 s, with a bit that rests or a drive that has not caught up."""
    table = history(50.0)
    early = table["time_s"] < 20.05
    table["surface_torque_N_m"] *= np.where(early, table["time_s"] / 20.0, 1.0)
    table["top_rpm"], table["bit_rpm"] = np.where(early, top, 60.0), np.where(early, bit, 60.0)
    table["bit_still_s"] = np.where(early & (bit == 0), 0.1, 0.0)
    (row,) = operations_table(table, 0.0, 1000.0, [span(5.0, 50.0, rpm=60.0)]).to_dict("records")
    assert row["surface_torque_mean_N_m"] == pytest.approx(MEAN, rel=2e-3)
    assert row["surface_torque_periods"] == int((50.0 - 20.0) / PERIOD)
    assert row["bit_still_share"] == 0.0


def test_a_string_that_never_turns_as_planned_is_judged_by_all_of_its_steady_part() -> None:
    table = history(50.0, bit_rpm=0.0, bit_still_s=0.1)
    (row,) = operations_table(table, 0.0, 1000.0, [span(5.0, 50.0, rpm=60.0)]).to_dict("records")
    assert row["surface_torque_periods"] == int((50.0 - 5.0) / PERIOD)
    assert row["bit_still_share"] == pytest.approx(1.0)


def test_operations_follow_each_other_and_end_with_the_records() -> None:
    """Of the second the records have 5 s, none of them steady, and of the third nothing."""
    table = history(25.0, bit_depth_m=np.linspace(1000.1, 1025.0, 250))
    spans = [
        span(10.0, 20.0),
        span(27.0, 40.0, operation="trip_in", start=20.0),
        span(50.0, 60.0, start=40.0),
    ]
    found = operations_table(table, 0.0, 1000.0, spans)
    assert found["operation"].tolist() == ["rotate_off_bottom", "trip_in"]
    assert found["end_s"].tolist() == pytest.approx([20.0, 25.0])
    assert found[["from_bit_depth_m", "to_bit_depth_m"]].to_numpy() == pytest.approx(
        np.array([[1000.0, 1020.0], [1020.0, 1025.0]])
    )
    assert operations_table(table.iloc[:0], 0.0, 1000.0, spans).empty


def test_a_string_that_does_not_turn_has_no_share_of_rest() -> None:
    (row,) = operations_table(history(20.0, top_rpm=0.0), 0.0, 1000.0, [span(10.0, 20.0)]).to_dict("records")
    assert np.isnan(row["bit_still_share"])
