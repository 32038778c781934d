"""``python -m validation``: what it runs, what it answers, how it exits."""

from unittest.mock import Mock

import pytest
from grimp.exceptions import SourceSyntaxError
from typer.testing import CliRunner

from validation.__main__ import app
from validation.claims import ledger
from validation.harness import fingerprint, runner, store, study
from validation.harness.study import Check, Outcome

CLAIM = """
[[claim]]
id = "a-claim"
section = "5.2"
says = "Forces are right."
verdict = "holds"
because = "target"
number = { study = "paper_well", check = "error", at_most = 1.0 }
"""


@pytest.fixture
def invoke(register, tmp_path, monkeypatch):
    expected = tmp_path / "expected.toml"
    expected.write_text("")
    monkeypatch.setattr(runner, "EXPECTED", expected)
    monkeypatch.setattr(ledger, "CLAIMS", tmp_path / "claims.toml")
    ledger.CLAIMS.write_text(CLAIM)
    register("paper_well")
    register("overlap", reproduce=False)
    return lambda *arguments: CliRunner().invoke(app, arguments)


def results():
    return sorted(path.name for path in study.RESULTS.iterdir())


def test_list_gives_names_and_questions(invoke):
    answer = invoke("--list")
    assert answer.exit_code == 0
    assert "paper_well           Is paper_well right?  [reproduce]" in answer.output
    assert "overlap " in answer.output


def test_all_runs_every_study(invoke):
    assert invoke("--all", "--quick").exit_code == 0
    assert results() == ["overlap", "paper_well"]
    assert store.read(study.RESULTS / "overlap").quick


def test_reproduce_runs_the_marked_ones(invoke):
    assert invoke("--reproduce").exit_code == 0
    assert results() == ["paper_well"]


def test_names_run_those(invoke):
    assert invoke("overlap").exit_code == 0
    assert results() == ["overlap"]


def test_the_claims_are_judged_after_all_studies_and_by_their_name(invoke):
    answer = invoke("claims")
    assert "claims: 1 not yet run" in answer.output
    for arguments in (["--all"], ["--reproduce"], ["claims"], ["claims", "overlap"]):
        answer = invoke(*arguments)
        assert answer.exit_code == 0, arguments
        assert "claims: 1 as recorded" in answer.output
        assert "a-claim: holds" in answer.output
    assert "claims: " not in invoke("overlap").output
    assert "studies run" not in invoke("claims").output


def test_another_verdict_than_recorded_is_exit_code_1(invoke, register):
    ledger.CLAIMS.write_text(CLAIM.replace("at_most = 1.0", "at_most = 0.1"))
    assert invoke("paper_well").exit_code == 0
    answer = invoke("--all")
    assert answer.exit_code == 1
    assert "a-claim: does not hold, recorded is holds" in answer.output
    ledger.CLAIMS.write_text(CLAIM.replace(", at_most = 1.0", ""))
    answer = invoke("claims")
    assert answer.exit_code == 1
    assert "claims: failed: claims.toml: claim a-claim.number" in answer.output


def test_a_source_that_is_no_python_is_bad_usage(invoke, monkeypatch):
    monkeypatch.setattr(fingerprint, "Sources", Mock(side_effect=SourceSyntaxError("fctd/x.py", 3, "def :")))
    answer = invoke("--all")
    assert answer.exit_code == 2
    assert "error: Syntax error in fctd/x.py, line 3: def :" in answer.output


def test_unknown_name_is_answered_with_the_nearest(invoke):
    answer = invoke("papr_well")
    assert answer.exit_code == 2
    assert "unknown study 'papr_well'; did you mean 'paper_well'?" in answer.output
    assert not study.RESULTS.exists()


def test_what_was_asked_for_is_shown_as_it_stands(invoke):
    answer = invoke("[/x]\x1b[31m\x9b")
    assert answer.exit_code == 2
    assert r"[/x]\x1b[31m\x9b" in answer.output


def test_nothing_asked_for(invoke):
    answer = invoke()
    assert answer.exit_code == 2
    assert "--reproduce" in answer.output


def test_bad_expected_file(invoke):
    runner.EXPECTED.write_text("[paper_well")
    answer = invoke("--all")
    assert answer.exit_code == 2
    assert "expected.toml" in answer.output


def test_results_that_cannot_be_kept(invoke):
    study.RESULTS.write_text("a file")
    answer = invoke("--all")
    assert answer.exit_code == 2
    assert "results: expected a folder that can be written" in answer.output


def test_a_disk_that_is_full(invoke, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(store, "_write_verdict", full)
    answer = invoke("--all")
    assert answer.exit_code == 2
    assert "expected a folder that can be written (No space left on device)" in answer.output


def test_worse_than_recorded(invoke, register):
    check = Check("error", 2.0, 1.0, "at_most", "", "test")
    register("missing", lambda context: Outcome({}, [check]))
    assert invoke("missing").exit_code == 1
    runner.EXPECTED.write_text('[missing]\n"error" = "missed: known"')
    assert invoke("missing").exit_code == 0
