"""Planted slowdowns: where they are planted, how long they are made, and what is said of them."""

import ast
from itertools import chain
from pathlib import Path

import pytest

from benchmarks import planted
from benchmarks.gate import PROCESSES
from benchmarks.measure import REFERENCE, Costs
from benchmarks.planted import RACES, SITES, SUBJECTS
from benchmarks.subjects import subjects
from fctd.case.errors import InputError


@pytest.mark.slow
def test_each_subject_has_a_slowdown() -> None:
    assert SUBJECTS.keys() | {REFERENCE} == subjects().keys()


def test_each_race_has_one_slowdown_at_a_key() -> None:
    assert sorted(SUBJECTS) == sorted(chain.from_iterable(RACES))
    for targets in RACES:
        places = [SUBJECTS[name][:2] for name in targets]
        assert len(set(places)) == len(places)


def test_the_work_is_called_once_in_each_function(tmp_path: Path) -> None:
    planted.plant(tmp_path)
    for name, site in SITES.items():
        tree = ast.parse((tmp_path / site.file).read_text())
        assert ast.unparse(tree).count(f"planted.{name}({site.key})") == 1
    ast.parse((tmp_path / "fctd" / "mechanics" / "planted.py").read_text())


def test_a_function_with_other_lines_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SITES, "step", planted.Site("fctd/mechanics/dynamics.py", "    no such line", "n"))
    with pytest.raises(InputError, match="whose body begins as"):
        planted.plant(tmp_path)


@pytest.fixture
def linear(monkeypatch: pytest.MonkeyPatch) -> None:
    """A race in which a turn at a site adds a part of each cost."""
    per_turn = {"joints": 0.004, "step": 0.002, "query": 0.0007, "steady": 0.0001}

    def raced(slow: Path, turns: dict[str, int], pairs: int) -> tuple[Costs, Costs]:
        before = {name: [5.0 + k] * pairs for k, name in enumerate(SUBJECTS)}
        now = {name: [cost * (1 + turns.get(name, 0) * per_turn[SUBJECTS[name][0]]) for cost in taken]
               for name, taken in before.items()}  # fmt: skip
        return before | {REFERENCE: [1.0] * pairs}, now | {REFERENCE: [1.0] * pairs}

    monkeypatch.setattr(planted, "side_by_side", raced)
    monkeypatch.setattr(planted, "plant", lambda folder: None)


@pytest.mark.usefixtures("linear")
def test_slowdowns_are_calibrated_and_found() -> None:
    found = planted.search(str)
    assert [each.verdict.kernel for each in found] == [*chain.from_iterable(RACES)]
    for each in found:
        assert each.verdict.change == pytest.approx(1.15, abs=0.01)
        assert each.found
        assert len(each.now) == 2 * PROCESSES
    assert planted.table(found).row_count == len(found)


@pytest.mark.usefixtures("linear")
def test_a_slowdown_that_is_too_small_is_not_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planted, "SLOWDOWN", 1.05)
    assert not any(each.found for each in planted.search(str))
