"""``python -m validation``: what it runs, what it answers, how it exits."""

from unittest.mock import Mock

import pytest
from grimp.exceptions import SourceSyntaxError
from typer.testing import CliRunner

from fctd.case.solver import PERTURBED, SolverSpec
from validation.__main__ import app
from validation.claims import ledger
from validation.harness import fingerprint, runner, sensitivity, store, study, targets, variation
from validation.harness.study import Check, Outcome
from validation.harness.variation import FOLDER

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
    monkeypatch.delenv(PERTURBED, raising=False)
    monkeypatch.setattr(runner, "EXPECTED", expected)
    monkeypatch.setattr(sensitivity, "REASONS", tmp_path / "sensitive.toml")
    sensitivity.REASONS.write_text("")
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


@pytest.mark.slow
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


@pytest.mark.slow
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


def noisy(context):
    """A study whose number is the seed of the noise."""
    return Outcome({}, [Check("seed", SolverSpec().perturbed or 0, 0, "at_most", "", "test")])


def test_a_run_with_noise_leaves_the_plain_result(invoke, register, monkeypatch):
    register("overlap", noisy)
    assert invoke("overlap").exit_code == 0
    monkeypatch.setenv(PERTURBED, "3")
    answer = invoke("overlap", "--quick")
    assert answer.exit_code == 1
    assert answer.output.startswith("noise-3:\n")
    assert "worse than recorded      seed: 3 (at most 0)" in answer.output
    plain, found = store.read(study.RESULTS / "overlap"), store.read(study.RESULTS / FOLDER / "noise-3" / "overlap")
    assert (plain.checks[0].check.value, plain.quick, plain.variation) == (0, False, "")
    assert (found.checks[0].check.value, found.quick, found.variation) == (3, True, "noise-3")


def test_times_of_a_run_with_noise_are_not_judged(invoke, register, monkeypatch):
    checks = [Check("time", 2.0, 1.0, "at_most", "s", "test", timed=True)]
    register("overlap", lambda context: Outcome({}, list(checks)))
    assert invoke("overlap").exit_code == 1
    monkeypatch.setenv(PERTURBED, "3")
    assert invoke("overlap").exit_code == 0
    checks.append(Check("load", 2.0, 1.0, "at_most", "kN", "test"))
    assert invoke("overlap", "--force").exit_code == 1


def test_draws_and_targets_run_in_processes_of_their_own(invoke, monkeypatch):
    begun = []
    monkeypatch.setattr(variation, "in_processes", lambda *given: begun.append(given) or 1)
    monkeypatch.setattr(targets, "lacking", lambda name: "this processor lacks avx512f" if name == "x86-64-v4" else "")
    assert invoke("overlap", "claims", "--quick", "--perturbed", "3", "--draws", "2").exit_code == 1
    assert invoke("--all", "--target", "no-fma").exit_code == 1
    labels = [[each.label for each in asked] for asked, _ in begun]
    assert labels == [["noise-3", "noise-4"], ["no-fma"]]
    assert [arguments for _, arguments in begun] == [["overlap", "claims", "--quick"], ["--all"]]
    answer = invoke("overlap", "--target", "x86-64-v4")
    assert (answer.exit_code, len(begun)) == (0, 2)
    assert answer.output == "x86-64-v4: skipped: this processor lacks avx512f\n"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--target", "x86-65"], "target = 'x86-65': expected one of x86-64-v2, x86-64-v3, x86-64-v4, no-fma"),
        (["--draws", "2"], "--draws: expected --perturbed SEED"),
        (["--perturbed", "-1"], "FCTD_PERTURBED"),
    ],
)
def test_a_variation_that_there_is_not(arguments, said, invoke):
    answer = invoke("overlap", *arguments)
    assert answer.exit_code == 2
    assert said in answer.output
    assert not study.RESULTS.exists()
