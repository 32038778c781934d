"""The table of the hole: defaults, alternatives, and the stations that it reads once."""

import math
import pickle
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from tests.case.test_load import SURVEY, USE_SURVEY


def test_defaults(case_file: Path) -> None:
    hole = load_case(case_file).wellbore
    assert (hole.survey_method, hole.geometry, hole.overlap) == ("minimum_curvature", "cylinders", 0.2)
    assert (hole.chord_tolerance, hole.cylinder_length) == (0.002, None)
    assert (hole.stiffness, hole.stiffness_per_length) == (1e7, None)


def test_alternatives_replace_their_default(case_file: Path) -> None:
    hole = load_case(
        case_file,
        {"wellbore.cylinder_length": "2 m", "wellbore.stiffness_per_length": "1e6 N/m/m"},
    ).wellbore
    assert (hole.chord_tolerance, hole.cylinder_length) == (None, 2.0)
    assert (hole.stiffness, hole.stiffness_per_length) == (None, 1e6)


def test_inline_stations_are_checked_and_served(case_file: Path) -> None:
    hole = load_case(case_file, {"wellbore.stations": [[0, 0, 0], [0, 0, 0], [2000, 60, 45]]}).wellbore
    assert hole.trajectory.tolist() == [[0, 0, 0], [2000, math.radians(60), math.radians(45)]]


def test_survey_with_columns(case_file: Path) -> None:
    (case_file.parent / "survey.csv").write_text("Depth ( ft ),I ( deg ),A ( rad )\n0,0,0\n8000,30,1\n")
    columns = {"md": "Depth ( ft )", "inc": "I ( deg )", "azi": "A ( rad )"}
    case = load_case(case_file, USE_SURVEY | {"wellbore.columns": columns})
    assert case.wellbore.trajectory[1] == pytest.approx([2438.4, math.radians(30), 1], rel=1e-14)


@pytest.mark.parametrize(
    "overrides",
    [
        {"wellbore.columns": {"md": {"header": "DEPTH", "unit": "m"}}},
        {"wellbore.columns": {"md": {"header": "depth", "unit": "metres"}, "azi": "AZIM", "inc": {"unit": "deg"}}},
        {"wellbore.columns.md.unit": "m"},
    ],
)
def test_a_survey_whose_headers_have_no_units(case_file: Path, overrides: dict[str, object]) -> None:
    """The public survey that took six edits."""
    (case_file.parent / "survey.csv").write_text("DEPTH,DEVI,AZIM\n0,0,0\n2000,30,90\n")
    case = load_case(case_file, USE_SURVEY | overrides)
    assert case.wellbore.trajectory[1] == pytest.approx([2000, math.radians(30), math.pi / 2], rel=1e-14)
    assert Case.model_validate_json(case.model_dump_json()) == case


def test_the_keys_of_a_survey_are_read_again(case_file: Path) -> None:
    """Stations are kept for the keys that they were read with."""
    (case_file.parent / "survey.csv").write_text(SURVEY)
    hole = load_case(case_file, USE_SURVEY).wellbore
    feet = load_case(case_file, USE_SURVEY | {"wellbore.columns.md.unit": "ft", "operations": None}).wellbore
    assert hole.trajectory[1, 0] == 2000
    assert hole.model_copy(update={"columns": feet.columns}).trajectory[1, 0] == pytest.approx(609.6, rel=1e-14)


def test_a_case_holds_its_stations_but_does_not_show_them(case_file: Path) -> None:
    """Read once; no part of what is stored, compared or hashed, and not kept where the survey is another one."""
    survey = case_file.parent / "survey.csv"
    survey.write_text(SURVEY)
    case = load_case(case_file, USE_SURVEY)
    asked = case.wellbore.trajectory
    stored = Case.model_validate_json(case.model_dump_json())
    survey.unlink()
    assert stored == case
    assert stored.model_dump() == case.model_dump()
    assert "trajectory" not in case.model_dump_json()
    assert case.depths == (0.0, 2000.0)
    moved = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"overlap": 0.1})})
    assert moved.wellbore.trajectory is asked
    assert pickle.loads(pickle.dumps(case)) == case
    assert pickle.loads(pickle.dumps(case)).wellbore.trajectory.tobytes() == asked.tobytes()
    with pytest.raises(InputError, match="a survey file that can be read"):
        _ = stored.wellbore.trajectory
    other = case.wellbore.model_copy(update={"survey": None, "stations": ((0.0, 0.0, 0.0), (900.0, 0.0, 0.0))})
    assert other.trajectory[-1, 0] == 900.0
    assert case.wellbore.trajectory is asked
    with pytest.raises(ValueError, match="read-only"):
        asked[0, 0] = 1.0
