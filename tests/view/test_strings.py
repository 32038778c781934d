"""Strings of charts and runs: their contacts are those of the tables."""

from dataclasses import replace

import numpy as np
import pytest

from fctd import equilibrium, simulate
from fctd.case.errors import InputError
from fctd.view.strings import MOST_RECORDS, of_chart, of_points, of_run
from tests.cases import make_case, pipe, rotation
from tests.view.made import DEPTHS, KINDS, case, strings


def test_a_chart_has_a_string_for_each_operation_and_depth() -> None:
    made = strings()
    assert made.groups == KINDS
    assert [one.bit_depth for one in made.of("trip_in")] == list(DEPTHS)
    point = equilibrium(case(), "trip_in", float(DEPTHS[-1]))
    last = made.of("trip_in")[-1]
    assert last.hookload == pytest.approx(point.hookload, rel=1e-9)
    profile = point.profile
    np.testing.assert_allclose(last.columns["contact_force_N"], profile["contact_force_N"], atol=1.0)
    assert list(last.touching) == list(profile["contact_force_N"] > 0)
    distance = np.hypot(profile["offset_high_m"], profile["offset_right_m"])
    np.testing.assert_allclose(np.linalg.norm(last.offset, axis=1), distance, atol=1e-6)
    # Where it touches there is no gap, and elsewhere there is one.
    assert (last.columns["gap_m"][last.touching] == 0).all()
    assert (last.columns["gap_m"][~last.touching] > 0).all()
    angle = last.columns["contact_angle_deg"][last.touching]
    np.testing.assert_allclose(angle, profile["contact_angle_deg"][last.touching], atol=0.01)


def test_a_depth_at_which_string_and_hole_do_not_fit_is_left_out() -> None:
    made = of_chart(case(), "trip_in", [500.0, 5000.0])
    assert [one.bit_depth for one in made.snapshots] == [500.0]
    with pytest.raises(InputError):
        of_chart(case(), "trip_in", [5000.0])
    with pytest.raises(InputError, match="at least one bit depth"):
        of_chart(case(), "trip_in", [])


def test_words_and_factors_are_those_of_charts() -> None:
    (one,) = of_chart(case(), "trip_in", "td", friction=0.4).snapshots
    assert one.bit_depth == case().depths[1]
    assert one.hookload == equilibrium(case(), "trip_in", "td", friction=0.4).hookload


def test_a_string_without_a_balance_says_why() -> None:
    (one,) = of_points([equilibrium(case(), "trip_in", 500.0).without_loads()]).snapshots
    assert len(one.offset) == 0
    assert one.hookload != one.hookload


def test_a_run_has_a_string_for_each_record() -> None:
    run = simulate(make_case(components=[pipe(None, 10)], operations=[rotation(1000, 5, ramp=1)]))
    made = of_run(run)
    assert [one.at for one in made.snapshots] == list(run.history["time_s"])
    last, below = made.snapshots[-1], run.profile.iloc[1:]
    np.testing.assert_array_equal(last.columns["effective_tension_N"], below["effective_tension_N"])
    distance = np.hypot(below["offset_high_m"], below["offset_right_m"])
    np.testing.assert_allclose(np.linalg.norm(last.offset, axis=1), distance, atol=1e-12)
    few = of_run(run, most=3)
    times = [one.at for one in few.snapshots]
    assert len(times) == 3 < len(made.snapshots) <= MOST_RECORDS
    assert {times[0], times[-1]} == {run.history["time_s"].iloc[0], run.history["time_s"].iloc[-1]}


def test_a_run_of_an_older_version_is_refused() -> None:
    run = simulate(make_case(components=[pipe(None, 10)], operations=[rotation(1000, 2, ramp=1)]))
    old = replace(run, segments=run.segments.drop(columns="offset_high_m"))
    with pytest.raises(InputError, match=r"offset_high_m: simulate the case again"):
        of_run(old)
