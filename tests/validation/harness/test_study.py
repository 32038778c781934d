"""A verdict follows from the stored number and bound."""

import ast
import math

import numpy as np
import pandas as pd
import pytest

from fctd.arena.result import Quartiles
from validation.harness import study
from validation.harness.study import Check, Outcome


@pytest.mark.parametrize(
    ("value", "bound", "kind", "verdict"),
    [
        (1.0, 1.0, "at_most", "met"),
        (1.001, 1.0, "at_most", "missed"),
        (-5.0, 1.0, "at_most", "met"),
        (1.0, 1.0, "at_least", "met"),
        (0.999, 1.0, "at_least", "missed"),
        (0.2, (0.1, 0.2), "within", "met"),
        (0.21, (0.1, 0.2), "within", "missed"),
        (0.09, (0.1, 0.2), "within", "missed"),
        (math.nan, 1.0, "at_most", "missed"),
        (math.nan, 1.0, "at_least", "missed"),
        (math.nan, (0.0, 1.0), "within", "missed"),
        (-math.inf, 1.0, "at_most", "missed"),
        (math.inf, 1.0, "at_least", "missed"),
        (0.5, math.nan, "at_most", "missed"),
    ],
)
def test_verdict(value, bound, kind, verdict):
    assert Check("x", value, bound, kind, "m", "test").verdict == verdict


def test_requirement_in_words():
    assert Check("x", 0.0, 0.02, "at_most", "kN·m", "test").requirement() == "at most 0.02 kN·m"
    assert Check("x", 0.0, (-1.0, 1.0), "within", "", "test").requirement() == "within -1 to 1"


@pytest.mark.parametrize(
    ("interval", "bound", "kind", "verdict"),
    [
        ((0.9, 1.1), 1.2, "at_most", "met"),
        ((0.9, 1.3), 1.2, "at_most", "missed"),
        ((0.7, 1.1), 0.8, "at_least", "missed"),
        ((0.9, 1.3), (0.8, 1.2), "within", "missed"),
        ((math.nan, 1.1), 1.2, "at_most", "missed"),
    ],
)
def test_both_ends_of_an_interval_meet_the_bound(interval, bound, kind, verdict):
    check = Check("x", 1.0, bound, kind, "", "test", timed=True, interval=interval)
    assert check.verdict == verdict
    assert check.found() == f"1 ({interval[0]:g} to {interval[1]:g})"


def test_a_ratio_of_times_is_that_of_its_rounds():
    row = study.in_columns({"over": [1.0, 1.5, 2.0, 2.5, 3.0]})
    assert row == {"over": 2.0, "over_low": 1.5, "over_high": 2.5}
    check = study.ratio_check("x", study.quartiles_of(row, "over"), 2.2, "at_most", "test")
    assert (check.value, check.interval, check.timed, check.verdict) == (2.0, (1.5, 2.5), True, "missed")


def test_times_of_rounds_meet_a_bound_by_their_quartiles():
    check = study.time_check("x", [1.0, 1.5, 2.0, 2.5, 3.0], 2.4, "s", "test")
    assert (check.value, check.interval, check.unit, check.verdict) == (2.0, (1.5, 2.5), "s", "missed")
    assert f"{Quartiles.of([1.0, 1.5, 2.0, 2.5, 3.0]):.1f}" == "2.0 (1.5 to 2.5)"


def test_quartiles_of_a_fitted_exponent_widen_with_its_scatter():
    x = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    exact, rough = study.fitted_exponent(x, x**2), study.fitted_exponent(x, x**2 * [1, 1.2, 0.9, 1.1, 1])
    assert exact.all == pytest.approx((2.0, 2.0, 2.0))
    assert rough.low < rough.median < rough.high
    # Half of all fits lie within: by the closed form of the slope's error with three degrees of freedom.
    u, v = np.log(x), np.log(x**2 * [1, 1.2, 0.9, 1.1, 1])
    left = v - np.polyval(np.polyfit(u, v, 1), u)
    error = np.sqrt((left @ left) / 3 / np.sum((u - u.mean()) ** 2))
    assert rough.high - rough.median == pytest.approx(0.7649 * error, rel=1e-3)


def test_a_time_and_a_ratio_of_times_come_with_their_interval():
    """`time_check` and `ratio_check` make them, but for a count of settings and for times of the fastest round."""
    without = {
        path.name
        for path in (study.ROOT / "validation").glob("*/*.py")
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "Check"
        if {"timed", "interval"} & {each.arg for each in call.keywords} == {"timed"}
    }
    assert without == {"contact_fronts.py", "speed.py"}


@pytest.mark.parametrize(("bound", "kind"), [(1.0, "within"), ((0.0, 1.0), "at_most")])
def test_bound_must_suit_its_kind(bound, kind):
    with pytest.raises(ValueError, match="pair"):
        Check("x", 0.0, bound, kind, "m", "test")


def test_outcome_refuses_what_could_not_be_reported():
    check = Check("x", 0.0, 1.0, "at_most", "m", "test")
    with pytest.raises(ValueError, match="share a name"):
        Outcome({}, [check, check])
    with pytest.raises(ValueError, match="not there"):
        Outcome({"a": pd.DataFrame()}, [], display={"b": "caption"})


def test_data_folder(monkeypatch, tmp_path):
    monkeypatch.setenv("FCTD_DATA", str(tmp_path))
    assert study.data_folder() == tmp_path
    monkeypatch.setenv("FCTD_DATA", str(tmp_path / "missing"))
    assert study.data_folder() is None
    monkeypatch.delenv("FCTD_DATA")
    monkeypatch.setattr(study, "ROOT", tmp_path / "checkout")
    assert study.data_folder() is None
    (tmp_path / "shared" / "data").mkdir(parents=True)
    assert study.data_folder() == tmp_path / "shared" / "data"
