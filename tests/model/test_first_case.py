"""New cases from Python are those of ``fctd init``, and run."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.model.templates import TEMPLATES

EXAMPLES = Path(__file__).parents[2] / "examples"
SURVEY = EXAMPLES / "my_survey.csv"
TABLE = pd.read_csv(SURVEY)


def test_of_a_survey_a_table_and_a_file_it_is_the_same_well(tmp_path: Path) -> None:
    in_memory, of_table = fctd.new_case(SURVEY), fctd.new_case(TABLE)
    written = fctd.new_case(SURVEY, out=tmp_path / "well.toml")
    assert in_memory.digest == of_table.digest == written.digest
    assert written.file == tmp_path / "well.toml"
    assert "# an assumed casing shoe" in (tmp_path / "well.toml").read_text(encoding="utf-8")
    assert fctd.equilibrium(of_table, "trip_out", "shoe").status == "converged"


def test_a_template_has_its_own_well() -> None:
    case = fctd.new_case(template="horizontal", units="field", name="A-1")
    assert case.name == "A-1"
    assert case.wellbore.trajectory[:, 1].max() > 1.5


def test_what_the_file_does_not_say_is_told(tmp_path: Path) -> None:
    file = tmp_path / "survey.csv"
    TABLE.set_axis(["Teufe", "inc", "azi"], axis=1).to_csv(file, index=False)
    with pytest.warns(UserWarning, match="the file names no unit of depth: ft is assumed"):
        assumed = fctd.new_case(file, units="field", columns={"md": "Teufe"})
    said = fctd.new_case(file, columns={"md": {"header": "Teufe", "unit": "m"}})
    assert assumed.depths[1] == pytest.approx(0.3048 * said.depths[1])


def test_string_and_hole_of_files(tmp_path: Path) -> None:
    """What they leave blank is named, also where the case is written."""
    files = {"string": EXAMPLES / "my_string.xml", "hole": EXAMPLES / "my_hole.xml"}
    mass = "string.components[6].linear_mass is missing: expected its mass with tool joints"
    with pytest.raises(InputError) as in_memory:
        fctd.new_case(TABLE, **files)
    assert str(in_memory.value).startswith(mass)
    out = tmp_path / "well.toml"
    with pytest.raises(InputError) as written:
        fctd.new_case(SURVEY, **files, out=out)
    assert str(written.value).startswith(f"{out}: {mass}")
    out.write_text(out.read_text(encoding="utf-8").replace('linear_mass = ""', 'linear_mass = "49.3 lb/ft"'))
    case = fctd.load_case(out)
    assert case.bit.nozzle_area == pytest.approx((2 * 12**2 + 13**2) * 0.25 * np.pi * (0.0254 / 32) ** 2)
    assert [part.bend for part in case.string.components[1:5]] == pytest.approx([0, 0, np.radians(0.39), 0])
    assert [one.diameter for one in case.wellbore.intervals] == pytest.approx([8.681 * 0.0254, 8.5 * 0.0254])
    alone = fctd.new_case(TABLE, hole=files["hole"])
    assert [one.friction for one in alone.wellbore.intervals] == [0.2, 0.3]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"survey": 3}, "survey = 3: expected the path of a survey, or a DataFrame"),
        ({"survey": "no.csv"}, "no.csv: expected a survey file that can be read"),
        ({"template": "deep"}, f'template = "deep": expected one of the templates {", ".join(TEMPLATES)}'),
        ({"units": "ft"}, 'units = "ft": expected "si" or "field"'),
        ({"survey": SURVEY, "out": SURVEY}, "expected a new file that can be written (File exists)"),
        ({"columns": {"md": "x"}}, "survey is missing: expected a survey file beside columns and sheet"),
        ({"survey": SURVEY, "columns": {"mdd": "x"}}, "expected the key md"),
        ({"survey": SURVEY, "columns": {"md": 3}}, "columns.md = 3: expected a table of keys and values"),
        ({"string": "s.xml"}, "survey is missing: expected a survey beside string and hole"),
        ({"survey": TABLE, "string": 3}, "string = 3: expected the path of a WITSML file"),
        ({"survey": TABLE, "hole": "no.xml"}, "no.xml: expected a WITSML wbGeometry file that can be read"),
        ({"survey": TABLE.iloc[::-1]}, "wellbore.stations[1][0] = 2800.0: expected a measured depth greater"),
    ],
)
def test_what_cannot_be_used_is_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as caught:
        fctd.new_case(**arguments)
    assert message in str(caught.value)
