"""Series with known friction."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.monitoring.synthetic import raised, steady_readings, with_noise, with_step
from tests.monitoring.made import readings, series, well


def test_a_step_below_a_depth_cuts_the_open_hole_alone() -> None:
    intervals = with_step(well(), 800.0, 0.5).wellbore.intervals
    assert [(i.to_md, i.friction) for i in intervals] == [(600.0, 0.2), (800.0, 0.3), (1000.0, pytest.approx(0.45))]
    assert [i.friction for i in raised(well(), 0.5).wellbore.intervals] == [0.2, pytest.approx(0.45)]


def test_noise_has_the_sizes_that_are_asked_for() -> None:
    rows = readings()
    each = [with_noise(rows, np.random.default_rng(seed), 1e3, 0.05) for seed in range(40)]
    hook = np.concatenate([e["weight_indicator_N"] - rows["weight_indicator_N"] for e in each])
    torque = np.concatenate([e["drive_torque_N_m"] / rows["drive_torque_N_m"] - 1 for e in each])
    # Within two standard errors of a deviation.
    assert (hook.std(), torque.std()) == pytest.approx((1e3, 0.05), rel=2 / np.sqrt(2 * len(hook)))


def test_a_series_over_time_goes_on_by_its_interval_and_never_below_the_hole() -> None:
    table = series()
    assert set(np.diff(table["time_s"])) == {5.0}
    assert (table["bit_depth_m"] <= table["hole_depth_m"] + 1e-9).all()


def test_a_depth_without_a_steady_string_is_refused() -> None:
    with pytest.raises(InputError, match="bit_depth"):
        steady_readings(well(), [2000.0])
