"""Which numbers hang on rounding: what counts as moved, which runs are compared, and when it is an error."""

import io
import math
from dataclasses import replace

import pytest
from rich.console import Console

from validation.harness import sensitivity, store
from validation.harness.fingerprint import Inputs
from validation.harness.runner import UsageError
from validation.harness.sensitivity import Moved
from validation.harness.store import Judged, Provenance, Record
from validation.harness.study import Check
from validation.harness.variation import FOLDER

LOAD = Check("load", 2.0, 3.0, "at_most", "kN", "test")
TIME = Check("time", 2.0, 3.0, "at_most", "s", "test", timed=True)
PLAIN = Record(
    study="toy", question="Is it?", status="finished", message="", checks=(Judged(LOAD, None), Judged(TIME, None)),
    notes=(), display={}, tables=(), quick=True, date="2026-01-01", wall_s=1.0,
    provenance=Provenance("c", {}, "cpu", 2),
)  # fmt: skip
INPUTS = Inputs({"fctd/a.py": "1"}, {"quick or full": "quick"}, {"case.toml": "2"})


@pytest.fixture
def keep(tmp_path, register):
    """Store a run of ``toy``: the loads that it finds, its label, and inputs that differ."""
    register("toy")

    def call(load, label="", status="finished", **around):
        checks = tuple(Judged(replace(judged.check, value=load), None) for judged in PLAIN.checks)
        run = replace(PLAIN, checks=checks if status == "finished" else (), variation=label, status=status)
        folder = tmp_path / FOLDER / label if label else tmp_path
        noise = {"environment FCTD_PERTURBED": label} if label else {}
        inputs = replace(INPUTS, around=INPUTS.around | noise | around)
        store.write(run, {}, folder, inputs if status == "finished" else None)

    return call


def found(tmp_path, reasons=None):
    return sensitivity.moved(tmp_path, reasons or {})


def test_a_number_is_set_beside_its_runs_and_times_are_left_out(keep, tmp_path):
    keep(2.0)
    keep(1.9, "noise-1")
    keep(2.2, "no-fma")
    (moved,) = found(tmp_path)
    assert (moved.check.name, moved.runs) == ("load", {"no-fma": 2.2, "noise-1": 1.9})
    assert (moved.low, moved.high, moved.tolerance) == (1.9, 2.2, 1.0)
    assert moved.share == pytest.approx(0.3)
    assert moved.is_sensitive
    assert moved.changed == []


def test_runs_with_other_inputs_than_the_plain_one_do_not_count(keep, tmp_path):
    keep(2.0)
    keep(2.9, "noise-1", **{"quick or full": "full"})
    assert found(tmp_path) == []
    keep(2.01, "noise-2")
    assert [each.runs for each in found(tmp_path)] == [{"noise-2": 2.01}]


def test_a_run_that_fails_is_a_changed_verdict(keep, tmp_path):
    keep(2.0)
    keep(2.0, "noise-1", status="failed")
    (moved,) = found(tmp_path)
    assert moved.changed == ["noise-1"]
    assert (moved.low, moved.high) == (2.0, 2.0)


def test_without_a_plain_result_there_is_nothing_to_compare(keep, tmp_path):
    keep(2.0, "noise-1")
    assert found(tmp_path) == []


@pytest.mark.parametrize(
    ("kind", "bound", "plain", "other", "share", "changed"),
    [
        ("at_most", 3.0, 2.0, 2.05, 0.05, False),
        ("at_most", 3.0, 2.0, 3.05, math.inf, True),
        ("at_least", 1.0, 2.0, 2.2, 0.2, False),
        ("within", (1.0, 3.0), 2.0, 2.1, 0.05, False),
        ("within", (1.0, math.inf), 2.0, 2.2, 0.2, False),
        ("at_most", 0.0, 0.0, 0.0, 0.0, False),
        ("at_most", 0.0, 0.0, 1.0, math.inf, True),
        ("at_most", 0.0, 0.0, -1.0, math.inf, False),
        ("at_most", 3.0, 2.0, math.nan, math.inf, True),
        ("at_most", 3.0, math.nan, math.nan, 0.0, False),
        ("at_most", 1.0, 2.0, 2.2, 0.2, False),  # missed in both
    ],
)
def test_what_a_number_moves_by_is_measured_by_its_tolerance(kind, bound, plain, other, share, changed):
    moved = Moved("toy", Check("load", plain, bound, kind, "kN", "test"), {"noise-1": other})
    assert moved.share == pytest.approx(share)
    assert bool(moved.changed) == changed
    assert moved.is_sensitive == (share > 0.1)


def tell(tmp_path, reasons):
    text = io.StringIO()
    code = sensitivity.tell(found(tmp_path, reasons), reasons, Console(file=text))
    return code, text.getvalue()


def test_a_verdict_that_changes_needs_an_explanation(keep, tmp_path):
    keep(2.0)
    keep(2.5, "noise-1")
    code, text = tell(tmp_path, {})
    assert code == 0
    assert "toy: load\n    2, 2 to 2.5 kN (at most 3 kN); 50 % of its tolerance\n    not explained\n" in text
    keep(3.5, "noise-2")
    code, text = tell(tmp_path, {})
    assert code == 1
    assert "another verdict in noise-2" in text
    code, text = tell(tmp_path, {"toy": {"load": "it has two balances"}})
    assert code == 0
    assert "it has two balances" in text


def test_an_explanation_of_what_does_not_move_is_named(keep, tmp_path):
    keep(2.0)
    keep(2.0, "noise-1")
    assert "toy: load: explained in sensitive.toml, and did not move" in tell(tmp_path, {"toy": {"load": "why"}})[1]


def test_the_reasons_of_the_project_can_be_read():
    assert sensitivity.read_reasons(sensitivity.REASONS) is not None


@pytest.mark.parametrize(
    "text", ['[toy]\n"load" = ""', '[toy]\n"load" = 3', '[other]\n"load" = "why"', 'toy = "why"', "[toy"]
)
def test_reasons_that_say_something_else_are_refused(text, register, tmp_path):
    register("toy")
    path = tmp_path / "sensitive.toml"
    path.write_text(text)
    with pytest.raises(UsageError, match=r"sensitive\.toml"):
        sensitivity.read_reasons(path)
