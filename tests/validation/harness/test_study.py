"""A verdict follows from the stored number and bound."""

import math

import pandas as pd
import pytest

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
