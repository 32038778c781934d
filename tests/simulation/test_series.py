"""Loads of every segment over time, in bounded memory."""

import numpy as np
import pytest

from fctd import simulate
from fctd.simulation.series import SegmentSeries
from tests.cases import make_case, pipe, rotation


def test_every_record_of_a_short_run_is_kept() -> None:
    result = simulate(make_case(components=[pipe(None, 10)], operations=[rotation(1000, 3, ramp=1)]))
    series, n = result.segments, result.run["segments"]
    assert len(series) == n * len(result.history)
    last = series[series["time_s"] == result.history["time_s"].iloc[-1]]
    below = result.profile.iloc[1:]
    for column in ("md_m", "effective_tension_N", "torque_N_m", "contact_force_N"):
        np.testing.assert_array_equal(last[column], below[column])


@pytest.mark.parametrize("records", [4, 7, 8, 9, 100, 1001])
def test_a_long_run_keeps_evenly_spaced_records_within_its_rows(records: int) -> None:
    series = SegmentSeries(most_rows=80)
    for k in range(records):
        series.add(float(k), 1000.0, *np.ones((4, 10)))
    times = series.table()["time_s"].unique()
    assert len(series.table()) <= 80
    assert len(times) > min(records, 8) / 2 - 1
    assert times[0] == 0
    assert len(set(np.diff(times))) <= 1


def test_no_records() -> None:
    assert SegmentSeries().table().empty
