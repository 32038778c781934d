"""Which contact method: names of registries, numbers from stored results, a guide that its command alone writes."""

from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from references import contact, engines
from reports import which_contact, words
from tests.reports.pages import BLANK
from validation.harness import store
from validation.harness.store import Judged
from validation.harness.study import Check

FRONTS = pd.DataFrame(
    {
        "setting": ["arcs", "cylinders, cylinder_length=2.0, overlap=0.2"],
        "ns_1000": [40.0, 50.0],
        "ns_1000_low": [38.0, 48.0],
        "ns_1000_high": [43.0, 53.0],
        "torque_off_percent": [0.0, 0.3],
    }
)
CHEAPEST = "cheapest mesh over the engine's own arcs, a point in a batch of 1000"


def test_every_need_takes_what_a_registry_has() -> None:
    for need in which_contact.needs():
        registry = contact.REGISTRY if need.kind == "contact" else engines.REGISTRY
        assert need.take == "own" or need.take in registry.names()


def test_numbers_are_those_of_stored_results(tmp_path: Path) -> None:
    check = Judged(Check(CHEAPEST, 321.0, 10.0, "at_least", "", "a test"), None)
    record = replace(BLANK, study="contact_fronts", checks=(check,), tables=("fronts",))
    store.write(record, {"fronts": FRONTS}, tmp_path)
    found = which_contact.table(tmp_path)
    survey = next(row for row in found.rows if row[0].startswith("The hole is a survey"))
    assert "40 (38 to 43)\u00a0ns" in survey[3]
    assert which_contact.fronts(tmp_path).rows[0][2] == "40 (38 to 43)"
    assert "321" in survey[3]
    assert "0.3" in survey[4]
    assert found.origins[0].startswith("contact_fronts: ")


EMPTY = pd.DataFrame({"other": [1.0]})


@pytest.mark.parametrize("tables", [None, {}, {"fronts": EMPTY, "cost": EMPTY, "loads": EMPTY}, {"cost": EMPTY}])
def test_what_has_not_been_measured_is_said_with_its_command(
    tables: dict[str, pd.DataFrame] | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a study has been run, and left a table or a column out."""
    monkeypatch.setattr(which_contact, "GUIDE", tmp_path / "absent.md")
    if tables is not None:
        for study in which_contact.STUDIES:
            store.write(replace(BLANK, study=study, tables=tuple(tables)), tables, tmp_path)
    costs = {row[3] for row in which_contact.table(tmp_path).rows}
    assert all(cost.startswith("not measured yet: run `") for cost in costs)
    assert "not measured yet: run `python -m validation contact_fronts`" in costs
    assert "not measured yet: run `.venv-rivals/bin/python -m validation rival_contact`" in costs
    assert all(set(row[1:]) == {"–"} for row in which_contact.fronts(tmp_path).rows)


def test_without_results_the_last_record_stands_with_its_date(tmp_path: Path) -> None:
    found, kept = which_contact.table(tmp_path), which_contact.recorded()
    assert found.rows == kept.rows
    assert len(found.rows) == len(which_contact.needs())
    assert {line.split(", ")[1].partition(":")[0] for line in found.origins} == set(which_contact.STUDIES)
    assert all(line.startswith("last record, ") and ": 20" in line for line in found.origins)


@pytest.fixture
def guide() -> str:
    return which_contact.GUIDE.read_text()


def test_the_guide_was_written_by_its_command(guide: str) -> None:
    """A number changed by hand does not fit the mark."""
    text, _, last = guide.rstrip("\n").rpartition("\n")
    assert last == which_contact.mark(text + "\n")
    number = next(word for word in text.split() if word.replace(".", "").isdigit())
    assert last != which_contact.mark(text.replace(number, "0.001") + "\n")


def test_the_guide_has_a_row_for_every_need_and_every_method_of_the_suite(guide: str) -> None:
    rows = [line for line in guide.splitlines() if line.startswith("|")]
    assert all(any(row.startswith(f"| {need.need} |") for row in rows) for need in which_contact.needs())
    measured = {row.split("|")[1].partition(",")[0].strip() for row in rows}
    assert {words.name(name) for name in contact.METHODS} <= measured
    assert "not measured yet" not in guide


def test_versions_of_python_are_one_or_a_span() -> None:
    assert [which_contact._span(of) for of in (("3.11",), ("3.11", "3.12", "3.14"))] == ["3.11", "3.11 to 3.14"]
