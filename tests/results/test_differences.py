"""What differs between cases: keys once validated, lists by their names, surveys by their stations, words."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.load import Case, load_case
from fctd.results.differences import differences, in_a_row
from tests.rules import CASE

WELL = Path(__file__).parents[2] / "examples" / "my_well.toml"
PARTS: Any = load_case(WELL).written["string"]["components"]
MWD = {**PARTS[0], "name": "MWD", "length": "10 m"}


def told(*changes: dict[str, Any], units: Any = "si") -> list[str]:
    """The sentences of a well and of its changes."""
    cases = [load_case(WELL), *(load_case(WELL, change) for change in changes)]
    return [found.sentence("ABCDE"[: len(cases)], units) for found in differences(cases, units)]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"mud.density": "1400 kg/m^3"}, "mud.density: 1250 kg/m³ (A), 1400 kg/m³ (B)"),
        # 1 ppg is 119.826427 kg/m³: the case's own unit, and enough digits to tell them apart.
        ({"mud.density": "10.43 ppg"}, "mud.density: 1250 kg/m³ (A), 1249.8 kg/m³ (B)"),
        ({"mud.density": 1250.001}, "mud.density: 1250 kg/m³ (A), 1250.001 kg/m³ (B)"),
        ({"wellbore.intervals[1].diameter": "8.75 in"}, "wellbore.intervals[1].diameter: 8.5 in (A), 8.75 in (B)"),
        # What follows from another key is not told: contact_diameter, contact.
        ({"string.components[0].outer_diameter": "7 in"}, "string.components[0].outer_diameter: 6.75 in (A), 7 in (B)"),
        ({"bit.torque": None}, "bit.torque: 4 kN·m (A), 0 kN·m (B)"),
        ({"contact.friction_law": "paper"}, "contact.friction_law: coulomb (A), paper (B)"),
        ({"mud.fann": {"600": 60, "300": 40}}, "mud.fann: none (A), 300 40, 600 60 (B)"),
        ({"string.components": [MWD, *PARTS]}, "string.components: none (A), MWD (B)"),
        (
            {"string.components": [PARTS[1], PARTS[0], PARTS[2]]},
            "string.components: drill collars; heavy-weight pipe; 5 in drill pipe, 19.5 lb/ft (A), "
            "heavy-weight pipe; drill collars; 5 in drill pipe, 19.5 lb/ft (B)",
        ),
        ({"operations": []}, "operations: rotate_off_bottom (A), none (B)"),
    ],
)
def test_a_difference_in_one_key_is_one_line(change: dict[str, Any], sentence: str) -> None:
    assert told(change) == [sentence]


def test_another_spelling_is_no_difference() -> None:
    same = {"wellbore.intervals[1].diameter": "215.9 mm", "mud.density": "1.25 sg", "name": "other"}
    assert told(same | {"wellbore.overlap": "20 cm"}) == []


def test_a_component_of_another_place_is_compared_by_its_name() -> None:
    longer = {"string.components": [MWD, PARTS[0], {**PARTS[1], "length": "200 m"}, PARTS[2]]}
    assert told(longer) == [
        "string.components: none (A), MWD (B)",
        "string.components.heavy-weight pipe.length: 150 m (A), 200 m (B)",
    ]


def test_values_are_told_in_field_units_and_usual_ones_last() -> None:
    heavy, light = {"mud.density": "1.4 sg"}, {"bit.torque": "4 kN*m"}
    assert told(light, heavy, light, units="field") == ["mud.density: 11.684 ppg (C), 10.432 ppg (the other 3)"]
    assert told(heavy, light, units="field") == ["mud.density: 10.432 ppg (A and C), 11.684 ppg (B)"]
    assert in_a_row(["A", "B", "C"]) == "A, B and C"


def test_stations_count_and_not_their_file(tmp_path: Path) -> None:
    """A copy of the survey in feet is the same path; another last station is told with the depth above it."""
    stations = load_case(WELL).wellbore.trajectory * [1 / 0.3048, 180 / np.pi, 180 / np.pi]
    rows = [",".join(map(repr, row)) for row in stations.tolist()]
    copy, other = tmp_path / "copy.csv", tmp_path / "other.csv"
    copy.write_text("\n".join(["md_ft,inc_deg,azi_deg", *rows]))
    other.write_text("\n".join(["md_ft,inc_deg,azi_deg", *rows[:-1], f"{stations[-1, 0]},39,{stations[-1, 2]}"]))
    assert told({"wellbore.survey": copy}) == []
    above = stations[-2, 0] * 0.3048
    assert told({"wellbore.survey": other}) == [
        f"wellbore survey, another path below {above:.1f} m: my_survey.csv, 21 stations to 3000.0 m (A), "
        "other.csv, 21 stations to 3000.0 m (B)"
    ]


@given(st.floats(100, 2000), st.sampled_from([("m", 1.0), ("ft", 0.3048), ("in", 0.0254)]))
def test_any_length_is_the_same_in_any_unit(length: float, unit: tuple[str, float]) -> None:
    cases = [case_of({"string.components[0].length": text}) for text in (length, f"{length / unit[1]:.17g} {unit[0]}")]
    assert differences(cases) == []
    assert len(differences([cases[0], case_of({"string.components[0].length": length * 1.001})])) == 1


def case_of(changes: dict[str, Any]) -> Case:
    import tomllib

    return load_case(tomllib.loads(CASE), changes)
