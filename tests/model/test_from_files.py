"""A new case with string and hole of WITSML files: made-up ones, and the public ones of a well."""

import re
from pathlib import Path

import numpy as np
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.case.surveys.reading import read_survey
from fctd.model.from_files import Files, with_files
from fctd.model.new_case import Plan, from_survey
from fctd.results.status import SteadyStatus
from tests.case.witsml_files import BIT, HOLE, PIPE, geometry, objects, section, tubular
from validation.harness.study import data_folder

STATIONS = np.array([[0.0, 0.0, 0.0], [1000.0, 0.0, 0.0], [2000.0, 0.7, 0.0], [3000.0, 0.7, 0.0]])
NARROW = geometry([section("casing", 0, 3000, 6.184)])


def plan_with(folder: Path, string: str | None = None, hole: str | None = None, **names: str) -> Plan:
    """The plan of a survey with files of these contents."""
    paths: dict[str, Path | None] = {}
    for name, content in (("string", string), ("hole", hole)):
        paths[name] = None if content is None else folder / f"{name}.xml"
        if content is not None:
            (folder / f"{name}.xml").write_text(content, encoding="utf-8")
    plan = from_survey("build-hold", "case", "si", "survey.csv", (), STATIONS)
    return with_files(plan, STATIONS, Files(**paths, **names))


def test_without_files_a_plan_is_that_of_the_survey(tmp_path: Path) -> None:
    assert plan_with(tmp_path) == from_survey("build-hold", "case", "si", "survey.csv", (), STATIONS)


def test_the_title_says_what_the_case_is_made_of(tmp_path: Path) -> None:
    assert plan_with(tmp_path, tubular(), geometry()).title == (
        "the well of survey.csv with the string of string.xml and the hole of hole.xml; the rest is that of a "
        "build-and-hold well"
    )
    assert plan_with(tmp_path, hole=geometry()).title == (
        "the well of survey.csv with the string of a build-and-hold well and the hole of hole.xml"
    )


def test_a_string_without_a_bit_does_not_drill(tmp_path: Path) -> None:
    assert "[bit]" not in plan_with(tmp_path, tubular([PIPE]), geometry()).text()
    with_bit = plan_with(tmp_path, tubular([{**BIT, "nozzle": [{"diaNozzle": (12, "in/32")}] * 2}, PIPE]), geometry())
    assert 'nozzles = ["9.525 mm", "9.525 mm"]' in with_bit.text()
    area = plan_with(tmp_path, tubular([{**BIT, "areaNozzleFlow": (0.331, "in2")}, PIPE]), geometry(), string_name="u1")
    assert 'flow_area = "213.54796 mm^2"' in area.text()


def test_a_hole_ends_where_hole_or_survey_end_first(tmp_path: Path) -> None:
    plan = plan_with(
        tmp_path, hole=geometry([section("casing", 0, 1000, 8.681), section("open hole", 1000, 2500, 8.5)])
    )
    assert (plan.depth, plan.shoe) == (2500, 1000)
    assert plan_with(tmp_path, hole=geometry([section("casing", 0, 3500, 8.681)])).shoe == 0


def test_files_of_two_wellbores_are_named(tmp_path: Path) -> None:
    other = objects("wbGeometry", [("h", "B T2", {"wbGeometrySection": HOLE})])
    (doubt,) = plan_with(tmp_path, tubular([BIT, {**PIPE, "len": (2999.7, "m")}]), other).given.doubts
    assert doubt == ("hole.xml", "its wellbore is B T2, that of the string B")


@pytest.mark.parametrize(
    ("string", "hole", "names", "message"),
    [
        (None, NARROW, {}, 'hole = "157.0736 mm": expected a hole wider than the string of the template, 171.45 mm'),
        (tubular(), None, {"hole_name": "A"}, 'hole_name = "A": expected a file of the hole beside it'),
        (tubular(), None, {"string_name": "A"}, 'string_name = "A": expected the name or the uid of a tubular'),
    ],
)
def test_what_cannot_be_used_is_refused(
    string: str | None, hole: str | None, names: dict[str, str], message: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError) as refused:
        plan_with(tmp_path, string, hole, **names)
    assert message in str(refused.value)


# --- public files ------------------------------------------------------------------------------------------------

FOLDER = (data_folder() or Path("no data")) / "volve-15-9-F-4"
needs_files = pytest.mark.skipif(
    not (FOLDER / "witsml").is_dir(), reason="public WITSML files are missing (see docs/claims.md)"
)
# What a driller would write into the blanks: the bit of 8 1/2 in, pipe with joints, and tubing with couplings.
FILLED = {"diameter": "8.5 in", "linear_mass": "36.76 kg/m", "contact_diameter": "184.15 mm"}
OF_TUBING = {"linear_mass": "29 lb/ft", "contact_diameter": "7.656 in"}
LONG = "the string has {} m in all, and the hole 3510 m"


def filled_in(text: str) -> str:
    """The case with its blanks filled in; the uppermost component reaches the surface."""
    lines, name = [], ""
    for line in text.splitlines():
        name = found[1] if (found := re.fullmatch(r'name = "(.*)"', line)) else name
        blank = re.fullmatch(r'(\w+) = "" +# fill in', line)
        if blank is not None:
            value = (OF_TUBING if name == "tubing" else {}).get(blank[1]) or FILLED.get(blank[1])
            line = f'{blank[1]} = "{value}"' if value else ""
        lines.append(line)
    return "\n".join(lines)


@needs_files
@pytest.mark.parametrize(
    ("number", "length", "doubts"),
    [
        (1, 2616, ["no component is a bit", '"tubing" of 2054 m', "lenJointAv 40.1 m"]),
        (2, 200, ["no component is a bit", "lenJointAv 40 m"]),
        (3, 2621, []),
    ],
)
def test_public_files_are_read_and_what_they_lack_is_named(
    number: int, length: float, doubts: list[str], tmp_path: Path
) -> None:
    """They have no masses and no joints, too little pipe, and the diameter of a pipe as that of the open hole."""
    out, survey = tmp_path / "case.toml", FOLDER / "survey.csv"
    files = Files(FOLDER / "witsml" / f"tubular_{number}.xml", FOLDER / "witsml" / "wbGeometry_1.xml")
    stations = read_survey(survey).stations
    plan = with_files(from_survey(None, "case", "si", str(survey), (), stations), stations, files)
    assert [doubt for _, doubt in plan.given.doubts if not any(one in doubt for one in doubts)] == []
    assert len(plan.given.doubts) == len(doubts)
    hole, *string = (str(blank) for _, blank in plan.blanks)
    assert "idSection is 177.8 mm, the outer diameter of 7 in pipe, and the hole has 216.789 mm above it" in hole
    assert sum(LONG.format(length) in blank for blank in string) == 1
    keys = [blank.key.rpartition("[")[2] for _, blank in plan.blanks]
    assert [keys.count(f"{number == 1:d}].{key}") for key in ("length", "linear_mass", "contact_diameter")] == [1, 1, 1]
    out.write_text(plan.text(), encoding="utf-8")
    with pytest.raises(InputError) as refused:
        fctd.load_case(out)
    assert str(refused.value).count("\n") == len(plan.blanks) - 1
    out.write_text(filled_in(plan.text()), encoding="utf-8")
    case = fctd.load_case(out)
    assert not case.warnings
    assert case.depths == (0.0, 3510.0)
    assert fctd.check_case(case).string["to_md_m"].max() == pytest.approx(3510)
    assert fctd.equilibrium(case, "trip_out", "td").status == SteadyStatus.CONVERGED
