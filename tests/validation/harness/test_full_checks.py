"""A run names the checks of a full run that it leaves out; the list is written from stored full results."""

import tomllib
from dataclasses import replace
from fnmatch import fnmatchcase

import pytest

from reports import figures
from tests.reports.pages import BLANK, judged
from tests.validation.conftest import outcome
from validation.harness import full_checks, store
from validation.harness.registry import STUDIES

FULL = {"overlap": ["largest jump", 'order of "x"']}


def test_a_quick_run_names_what_it_leaves_out(register, run, monkeypatch):
    monkeypatch.setattr(full_checks, "read", lambda: {"toy": ["error", "error of the finest mesh"]})
    register("toy")
    code, text = run("toy", quick=True)
    assert code == 0
    assert "toy: 1 met, 1 not checked" in text
    assert "not checked (quick)" in text
    assert "error of the finest mesh" in text


def test_a_check_that_the_list_lacks_is_told(register, run, monkeypatch):
    monkeypatch.setattr(full_checks, "read", lambda: {"toy": ["old name"]})
    register("toy", lambda context: outcome())
    assert "checks.toml lacks checks of this study" in run("toy")[1]


@pytest.mark.parametrize(("status", "left"), [("finished", ['order of "x"']), ("failed", []), ("skipped", [])])
def test_what_a_run_leaves_out(status, left):
    assert full_checks.left_out(replace(BLANK, status=status, checks=(judged(0.0),)), FULL) == left
    assert full_checks.left_out(replace(BLANK, study="new"), FULL) == []


def test_the_list_is_written_from_full_results_and_keeps_the_rest(tmp_path):
    path, results = tmp_path / "checks.toml", tmp_path / "results"
    path.write_text('ownership = ["kept"]\nspeed = ["old"]\n')
    for record in (
        replace(BLANK, checks=tuple(judged(0.0, name=name) for name in FULL["overlap"])),
        replace(BLANK, study="speed", quick=True, checks=(judged(0.0),)),
    ):
        store.write(record, {}, results)
    assert full_checks.write(results, path) == ["overlap"]
    assert full_checks.read(path) == FULL | {"ownership": ["kept"], "speed": ["old"]}
    before = path.read_text(encoding="utf-8")
    full_checks.write(results, path)
    assert path.read_text(encoding="utf-8") == before


def test_the_list_names_studies_and_figures_show_checks_that_there_are():
    full = tomllib.loads(full_checks.FILE.read_text(encoding="utf-8"))
    assert full.keys() <= STUDIES.keys()
    for study, shown in figures.by_study().items():
        for figure in shown:
            for pattern in figure.checks if study in full else ():
                assert any(fnmatchcase(name, pattern) for name in full[study]), (study, figure.name, pattern)
