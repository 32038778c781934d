"""Input errors: their text, their order, and the keys they name."""

import pickle
from pathlib import Path

import pytest

from tests.case.test_load import refusal


def test_the_message_of_the_documentation(case_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(case_file.parent)
    error = refusal(Path("well.toml"), {"string.components[0].length": "-2 m"})
    assert str(error) == 'well.toml: string.components[0].length = "-2 m": expected a length above 0'


def test_several_problems_stand_on_lines_of_their_own(case_file: Path) -> None:
    error = refusal(case_file, {"mud.density": "-1 ppg", "rig.sheave_efficiency": 2})
    assert [line.split(": ")[1] for line in str(error).splitlines()] == [
        'mud.density = "-1 ppg"',
        "rig.sheave_efficiency = 2",
    ]


def test_what_follows_from_a_problem_is_not_reported(case_file: Path) -> None:
    """The next start is filled in from a bad end, and contact_diameter from a bad outer_diameter."""
    overrides = {"operations[0].to_md": "far", "string.components[0].outer_diameter": "wide"}
    assert len(str(refusal(case_file, overrides)).splitlines()) == 2


def test_an_error_survives_pickling(case_file: Path) -> None:
    error = refusal(case_file, {"mud.density": "-1 ppg", "rig.sheave_efficiency": 2, "name": None})
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
