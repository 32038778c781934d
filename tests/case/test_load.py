"""Case files: what is accepted, in which units, and how each wrong value is answered."""

import copy
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings

from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from fctd.case.operations import RotateOffBottom, TripOut
from tests.strategies import cases, corrupted_cases, write_case


def refusal(path: Path, overrides: dict[str, Any] | None = None) -> InputError:
    """The error that loading raises."""
    with pytest.raises(InputError) as caught:
        load_case(path, overrides)
    return caught.value


# --- what a valid case becomes ---------------------------------------------------------------------


def test_values_are_si(case_file: Path) -> None:
    case = load_case(case_file)
    assert case.file == case_file
    assert case.wellbore.intervals[0].diameter == pytest.approx(0.31115, rel=1e-14)
    assert case.wellbore.intervals[1].diameter == 0.2159
    assert case.string.components[0].length == 200.0
    assert case.operations[1].ramp_time == 10.0


def test_each_operation_starts_where_the_last_ended(case_file: Path) -> None:
    operations = load_case(case_file).operations
    assert [(o.start_md, o.end_md) for o in operations] == [
        (1000.0, 1500.0),
        (1500.0, 1500.0),
        (1500.0, 1200.0),
        (1200.0, 1100.0),
    ]
    assert isinstance(operations[1], RotateOffBottom)
    assert isinstance(operations[3], TripOut)
    assert [(o.speed, o.rpm) for o in operations] == [(0.5, 0.0), (0.0, 60.0), (0.1, 90.0), (0.2, 0.0)]


def test_a_byte_order_mark_is_nothing(case_file: Path) -> None:
    case_file.write_text(case_file.read_text(encoding="utf-8"), encoding="utf-8-sig")
    assert load_case(case_file).name


def test_a_case_is_frozen(case_file: Path) -> None:
    with pytest.raises(ValueError, match="frozen"):
        load_case(case_file).mud.density = 1.0


def test_operations_may_be_absent(case_file: Path) -> None:
    assert load_case(case_file, {"operations": None}).operations == ()


# --- the survey file -------------------------------------------------------------------------------

SURVEY = "md_m,inc_deg,azi_deg\n0,0,0\n2000,30,90\n"
USE_SURVEY = {"wellbore.stations": None, "wellbore.survey": "survey.csv"}


def test_survey_lies_beside_the_case(case_file: Path) -> None:
    (case_file.parent / "survey.csv").write_text(SURVEY)
    case = load_case(case_file, USE_SURVEY)
    assert case.wellbore.survey == case_file.parent / "survey.csv"
    assert case.wellbore.trajectory.tolist() == [[0, 0, 0], [2000, math.radians(30), math.radians(90)]]


def test_overridden_survey_is_first_sought_in_the_current_directory(
    case_file: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = tmp_path_factory.mktemp("elsewhere")
    monkeypatch.chdir(here)
    (case_file.parent / "survey.csv").write_text(SURVEY)
    assert load_case(case_file, USE_SURVEY).wellbore.survey == case_file.parent / "survey.csv"
    (here / "survey.csv").write_text(SURVEY)
    assert load_case(case_file, USE_SURVEY).wellbore.survey == here / "survey.csv"


def test_a_wrong_survey_is_named_instead_of_the_case(case_file: Path) -> None:
    (case_file.parent / "survey.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n2000,x,90\n")
    error = refusal(case_file, USE_SURVEY)
    assert (error.file, error.key) == (case_file.parent / "survey.csv", "row 3, inc_deg")


# --- every rule that a file can break --------------------------------------------------------------


def test_operations_that_omit_a_start_may_not_follow_a_missing_end(case_file: Path) -> None:
    assert "operations[0].to_md is missing" in str(refusal(case_file, {"operations[0].to_md": None}))


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (None, "a case file that can be read (No such file"),
        (b"name = ", "a case file in TOML"),
        (b"\xff\xfe\x00", "a case file in TOML"),
        (b"", "a name in quotes"),
        (b"x = " + b"[" * 5000, "a case file in TOML (too many arrays or tables lie in each other)"),
        (b"x = " + b"{x = " * 5000, "a case file in TOML (too many arrays or tables lie in each other)"),
        (b"[a" + b".a" * 5000 + b"]", "a case file in TOML (line 1 has a key of more than 16 parts)"),
        (b"x = " + b"9" * 5000, "a case file in TOML"),
        (b"x = 0x" + b"9" * 5000, "one of the keys name"),
    ],
    ids=[
        "missing",
        "half",
        "binary",
        "empty",
        "nested arrays",
        "nested inline tables",
        "nested tables",
        "long integer",
        "long hexadecimal",
    ],
)
def test_a_file_that_is_no_case(tmp_path: Path, content: bytes | None, expected: str) -> None:
    path = tmp_path / "well.toml"
    if content is not None:
        path.write_bytes(content)
    error = refusal(path)
    assert str(path) in str(error)
    assert expected in str(error)


def test_a_survey_is_no_case(tmp_path: Path) -> None:
    path = tmp_path / "survey.csv"
    path.write_text("md_m,inc_deg,azi_deg\n0,0,0\n")
    assert refusal(path).expected == "a case file in TOML; of a survey, `fctd init` makes one"


def test_a_bare_length_among_feet_is_named_beside_the_rule_that_it_breaks(tmp_path: Path) -> None:
    path = tmp_path / "well.toml"
    path.write_text(
        """name = "A"
[wellbore]
stations = [["0 ft", 0, 0], ["9800 ft", 0, 0]]
[[wellbore.intervals]]
to_md = 9200
diameter = "8.5 in"
friction = 0.2
[[wellbore.intervals]]
to_md = "9800 ft"
diameter = "8.5 in"
friction = 0.3
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
"""
    )
    first, second = str(refusal(path)).splitlines()
    assert "wellbore.intervals[1].to_md" in first
    assert second == (
        f"{path}: wellbore.intervals[0].to_md = 9200: expected a length with its unit: bare, it is in metres, and the "
        "other lengths are in feet and inches"
    )


def test_a_folder_is_no_case(tmp_path: Path) -> None:
    assert "a case file that can be read" in str(refusal(tmp_path))


# --- any case --------------------------------------------------------------------------------------


@pytest.mark.slow
@given(raw=cases())
def test_a_valid_case_loads_and_round_trips(raw: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("valid") / "well.toml"
    path.write_text(write_case(raw), encoding="utf-8")
    case = load_case(path)
    assert Case.model_validate_json(case.model_dump_json()) == case
    assert Case.model_validate(copy.deepcopy(raw)).operations == case.operations


@pytest.mark.slow
@settings(max_examples=100)
@given(raw=corrupted_cases())
def test_a_corrupted_case_is_accepted_or_refused(raw: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("corrupted") / "well.toml"
    path.write_text(write_case(raw), encoding="utf-8")
    answer = f"{path}: expected nothing else"
    try:
        load_case(path)
    except InputError as error:
        answer = str(error)
    for line in answer.splitlines():
        assert line.startswith(f"{path}: ")
        assert "expected " in line
