"""Loads of every segment over time, in bounded memory."""

import numpy as np
import pytest

from fctd import simulate
from fctd.simulation.series import LIMITS, LOADS, SegmentSeries
from tests.cases import hole_of, make_case, pipe, rotation, trip


def test_every_record_of_a_short_run_is_kept() -> None:
    result = simulate(make_case(components=[pipe(None, 10)], operations=[rotation(1000, 3, ramp=1)]))
    series, n = result.segments, result.run["segments"]
    assert len(series) == n * len(result.history)
    last = series[series["time_s"] == result.history["time_s"].iloc[-1]]
    below = result.profile.iloc[1:]
    for column in ("md_m", "clearance_m", *LOADS):
        np.testing.assert_array_equal(last[column], below[column])
    for column in ("offset_high_m", "offset_right_m"):
        np.testing.assert_allclose(last[column], below[column], rtol=0, atol=1e-12)
    assert list(last["buckling"]) == list(below["buckling"]) == ["none"] * n


def test_a_compressed_string_has_the_limits_of_its_profile() -> None:
    hole = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [1300, 90, 0]]
    intervals = [{"to_md": 1300, "diameter": 0.2159, "friction": 0.9}]
    case = make_case(
        hole, [pipe(None, 40, 0.0889, 0.07)], [trip(1200, 1200.5, ramp=1)], wellbore={"intervals": intervals}
    )
    result = simulate(case)
    last = result.segments[result.segments["time_s"] == result.history["time_s"].iloc[-1]]
    below = result.profile.iloc[1:]
    for column in LIMITS:
        np.testing.assert_array_equal(last[column], below[column])
    assert list(last["buckling"]) == list(below["buckling"])
    assert "sinusoidal" in set(last["buckling"])


@pytest.mark.parametrize("records", [4, 7, 8, 9, 100, 1001])
def test_a_long_run_keeps_evenly_spaced_records_within_its_rows(records: int) -> None:
    series = SegmentSeries(most_rows=80)
    for k in range(records):
        if series.wants_next:
            ones = np.ones(10)
            series.add(float(k), 1000.0, ones, [ones] * len(LOADS), ones, np.ones((10, 2)), ones, np.ones((10, 3)))
        else:
            series.skip()
    table = series.table(hole_of([[0, 0, 0], [1000, 0, 0]]))
    times = table["time_s"].unique()
    assert len(table) <= 80
    assert len(times) > min(records, 8) / 2 - 1
    assert times[0] == 0
    assert len(set(np.diff(times))) <= 1


def test_no_records() -> None:
    assert SegmentSeries().table(hole_of([[0, 0, 0], [1000, 0, 0]])).empty
