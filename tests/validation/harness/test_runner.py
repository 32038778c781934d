"""The runner's rules: what is stored, what is recorded, which exit code follows."""

import json
import math
import os
import signal
from unittest.mock import Mock

import pandas as pd
import pytest

from tests.validation.conftest import outcome
from validation.__main__ import choose
from validation.harness import registry, runner, store
from validation.harness.study import Check, Outcome


def stored(tmp_path, name):
    return json.loads((tmp_path / "results" / name / "verdict.json").read_text())


def test_met_check_and_its_table_are_stored(register, run, tmp_path):
    register("toy")
    code, text = run("toy", quick=True)
    assert code == 0
    assert "toy: 1 met" in text

    verdict = stored(tmp_path, "toy")
    assert verdict["question"] == "Is toy right?"
    assert verdict["quick"] is True
    assert verdict["checks"][0] == {
        "name": "error",
        "value": 0.5,
        "bound": 1.0,
        "kind": "at_most",
        "unit": "mm",
        "source": "closed form",
        "timed": False,
        "interval": None,
        "verdict": "met",
        "recorded": None,
    }
    assert set(verdict["provenance"]["versions"]) == {"fctd", "numpy", "numba", "python"}
    kept = store.read(tmp_path / "results" / "toy")
    table = store.read_tables(tmp_path / "results" / "toy", kept)["forces"]
    pd.testing.assert_frame_equal(table, outcome().tables["forces"])


DUE = "remove the entry from expected.toml"


@pytest.mark.parametrize(
    ("value", "recorded", "code", "said"),
    [
        (2.0, None, 1, "worse than recorded: toy"),
        (2.0, "missed: chords are chords", 0, "missed (recorded)"),
        (0.5, "missed: chords are chords", 0, f"recorded as missed; {DUE}"),
        (0.5, "finding: a misprint", 0, f"recorded as finding; {DUE}"),
        (0.5, "varies: a time", 0, "1 met"),  # with the machine: as recorded either way
        (2.0, "varies: a time", 0, "missed (recorded)"),
    ],
)
def test_a_check_is_held_against_its_record(value, recorded, code, said, register, run, tmp_path):
    register("toy", lambda context: outcome(value))
    found, text = run("toy", expected={"toy": {"error": recorded}} if recorded else {})
    assert found == code
    assert said in text
    assert ("better than recorded" in text) == (DUE in said)
    check = stored(tmp_path, "toy")["checks"][0]
    assert (check["verdict"], check["recorded"]) == ("met" if value < 1 else "missed", recorded)


def test_finding_about_the_paper_is_listed_apart_from_misses(register, run):
    checks = [Check(name, 2.0, 1.0, "at_most", "", "the paper") for name in ("eq 23", "chords")]
    register("toy", lambda context: Outcome({}, checks))
    code, text = run("toy", expected={"toy": {"eq 23": "finding: a misprint", "chords": "missed: chords are chords"}})
    assert code == 0
    assert text.index("chords: 2") < text.index("eq 23: 2")
    assert "recorded misses: 1; apart from them, 1 finding about the paper" in text


def test_recorded_check_that_is_gone_is_named(register, run):
    register("toy")
    code, text = run("toy", expected={"toy": {"old name": "why"}})
    assert code == 0
    assert "does not make: ['old name']" in text


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_numbers_that_json_has_no_word_for_survive(register, run, tmp_path, value):
    register("toy", lambda context: outcome(value))
    assert run("toy")[0] == 1
    check = store.read(tmp_path / "results" / "toy").checks[0].check
    assert check.value == pytest.approx(value, nan_ok=True)


def test_pair_of_bounds_survives(register, run, tmp_path):
    check = Check("share", 0.5, (0.0, math.inf), "within", "", "closed form")
    register("toy", lambda context: Outcome({}, [check]))
    assert run("toy")[0] == 0
    assert store.read(tmp_path / "results" / "toy").checks[0].check == check


def test_failed_study_is_recorded_and_the_others_go_on(register, run, tmp_path, capsys):
    register("broken", Mock(side_effect=ArithmeticError("lost in the bend")))
    register("toy")
    code, text = run("broken", "toy")
    assert code == 1
    assert stored(tmp_path, "broken")["status"] == "failed"
    assert stored(tmp_path, "broken")["message"] == "ArithmeticError: lost in the bend"
    assert stored(tmp_path, "toy")["status"] == "finished"
    assert "lost in the bend" in text
    assert "Traceback" in capsys.readouterr().err


def test_a_message_is_shown_as_it_stands_and_stored_with_any_bytes(register, run, tmp_path, capsys):
    message = "[/x] :x: \x1b[31m Σ data-\udcff"
    register("broken", Mock(side_effect=ArithmeticError(message)))
    _, text = run("broken")
    assert r"ArithmeticError: [/x] :x: \x1b[31m Σ data-\udcff" in text
    assert store.read(tmp_path / "results" / "broken").message == f"ArithmeticError: {message}"


def test_study_that_cannot_be_loaded_fails_like_any_other(register, run, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(registry.STUDIES, "absent", "validation.no_such_module")
    assert run("absent")[0] == 1
    assert "no_such_module" in stored(tmp_path, "absent")["message"]
    assert "absent" in choose([], every=False, reproduce=True, rivals=False)


def test_table_that_cannot_be_stored_is_a_failure(register, run, tmp_path, capsys):
    table = pd.DataFrame({"mixed": [1.0, "two", object()]})
    register("toy", lambda context: Outcome({"mixed": table}, []))
    assert run("toy")[0] == 1
    assert stored(tmp_path, "toy")["status"] == "failed"


@pytest.mark.parametrize("left", [None, 0, 100])
def test_a_result_whose_table_is_gone_or_cut_short_is_repeated(left, register, run, tmp_path):
    register("toy")
    run("toy")
    table = tmp_path / "results" / "toy" / "forces.parquet"
    whole = table.read_bytes()
    if left is None:
        table.unlink()
    else:
        table.write_bytes(whole[:left])
    assert "table forces cannot be read" in run("toy")[1]
    assert table.read_bytes() == whole
    assert "kept" in run("toy")[1]


def test_without_checks_the_notes_say_why(register, run):
    register("toy", lambda context: Outcome({}, [], ["Not installed, and so not run: a package."]))
    assert "Not installed, and so not run: a package." in run("toy")[1]
    register("other")
    assert "a toy" not in run("other")[1]


def test_study_without_its_data_is_skipped_by_name(register, run, tmp_path):
    register("real", needs=("data",))
    code, text = run("real")
    assert code == 0
    assert "real: skipped" in text
    assert "open registries" in stored(tmp_path, "real")["message"]
    assert run("real", data=tmp_path)[0] == 0
    assert stored(tmp_path, "real")["status"] == "finished"


def test_interrupt_keeps_what_finished_and_half_of_nothing(register, run, tmp_path):
    register("first")
    register("second", Mock(side_effect=KeyboardInterrupt))
    register("third")
    code, text = run("first", "second", "third")
    assert code == 130
    assert "kept: first" in text
    assert [path.name for path in (tmp_path / "results").iterdir()] == ["first"]


def test_interrupt_while_writing_leaves_the_earlier_result(register, run, tmp_path, monkeypatch):
    register("toy")
    run("toy")
    before = stored(tmp_path, "toy")

    def interrupt(*args, **kwargs):
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(store, "_to_json", interrupt)
    # Tests that run in the background have inherited that SIGINT is ignored.
    inherited = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        assert run("toy")[0] == 130
    finally:
        signal.signal(signal.SIGINT, inherited)
    assert stored(tmp_path, "toy") == before
    assert [path.name for path in (tmp_path / "results").iterdir()] == ["toy"]


def test_progress_hands_on_every_item(register, run):
    seen = []

    def loop(context):
        seen.extend(context.progress(range(3), "depths"))
        seen.extend(context.progress(iter("ab"), "letters"))
        return outcome()

    register("toy", loop)
    assert run("toy")[0] == 0
    assert seen == [0, 1, 2, "a", "b"]


@pytest.mark.parametrize("name", registry.STUDIES)
def test_every_registered_study_loads(name):
    try:
        study = runner.load(name)
    except ModuleNotFoundError as missing:
        pytest.skip(f"{missing.name} is not installed")
    assert study.question.endswith("?")


def test_expected_file_is_readable_and_names_studies():
    assert runner.read_expected(runner.EXPECTED).keys() <= registry.STUDIES.keys()


@pytest.mark.parametrize(
    "text",
    [
        '[toy]\n"error" = "met: no"',
        '[toy]\n"error" = "missed:"',
        '[toy]\n"error" = "missed"',
        '[other]\n"error" = "missed: why"',
        'toy = "missed: why"',
        "[toy",
    ],
)
def test_expected_file_that_says_something_else_is_refused(register, tmp_path, text):
    register("toy")
    path = tmp_path / "expected.toml"
    path.write_text(text)
    with pytest.raises(runner.UsageError, match=r"expected\.toml"):
        runner.read_expected(path)


def test_expected_file_gives_the_reasons(register, tmp_path):
    register("toy")
    path = tmp_path / "expected.toml"
    path.write_text('[toy]\n"error" = "missed: chords: 2 mm"')
    assert runner.read_expected(path) == {"toy": {"error": "missed: chords: 2 mm"}}
