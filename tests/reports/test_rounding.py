"""The page of numbers that hang on rounding."""

from dataclasses import replace

from reports import rounding
from tests.reports.pages import BLANK, judged, words_of
from validation.harness import store
from validation.harness.fingerprint import Inputs
from validation.harness.variation import FOLDER


def keep(folder, label, values):
    """Store a run of ``johancsik`` with a number for each check."""
    checks = tuple(judged(value, name=name) for name, value in values.items())
    inputs = Inputs({"fctd/a.py": "1"}, {"environment FCTD_PERTURBED": label} if label else {})
    store.write(replace(BLANK, study="johancsik", checks=checks, variation=label), {}, folder, inputs)


def test_the_numbers_that_moved_stand_first_with_their_reason(render, tmp_path):
    results = tmp_path / "results"
    keep(results, "", {"still": 5e-7, "jump": 5e-7})
    keep(results / FOLDER / "noise-1", "noise-1", {"still": 5.1e-7, "jump": 2e-6})
    _, problems = render(studies=["johancsik"])
    assert problems == []
    text = words_of((tmp_path / "out" / "rounding.html").read_text(encoding="utf-8"))
    assert "1 of 2 numbers moved by more than a tenth of what its bound allows, and 1 verdict changed" in text
    assert "Studies that ran again: johancsik. Their runs: noise-1" in text
    assert "johancsik jump 5e-07 5e-07 2e-06 at most 1e-06 kN·m 1 another verdict in noise-1 not explained" in text
    assert "johancsik still 5e-07 5e-07 5.1e-07 at most 1e-06 kN·m 1 2 % of its tolerance" in text
    first = words_of((tmp_path / "out" / "index.html").read_text(encoding="utf-8"))
    assert "1 of 2 numbers moved" in first
    assert "not explained" in first
    assert [path.stem for path in (tmp_path / "out" / "studies").iterdir()] == ["johancsik"]  # none of the run


def test_without_runs_the_page_says_how_to_make_them(render, tmp_path):
    render(studies=[])
    text = words_of((tmp_path / "out" / "rounding.html").read_text(encoding="utf-8"))
    assert "Not measured here yet: run python -m validation STUDY --perturbed 1 --draws 4." in text


def test_reasons_that_cannot_be_read_are_a_problem(tmp_path):
    path = tmp_path / "sensitive.toml"
    path.write_text("[overlap")
    assert rounding.page_of(tmp_path, path).problem.startswith("sensitive.toml: ")
