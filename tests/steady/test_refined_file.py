"""A refined case written into the user's own file: what is cut is new, all else stays as it was written."""

import tomllib
from pathlib import Path

import pytest

import fctd
from fctd import InputError
from fctd.steady.refined_file import survey_from, write_refined

CASE = """
# Of the planning meeting.
name = "tiny"  # mine
[wellbore]
survey = "hole.csv"
chord_tolerance = "50 mm"  # coarse
overlap = "0.1 m"  # ours
[[wellbore.intervals]]
to_md = "2952.756 ft"  # as the driller says it
diameter = "8.5 in"
friction = 0.2
[[string.components]]
name = "collar"
length = "300 ft"
outer_diameter = "6.5 in"
inner_diameter = "2.8125 in"
segments = 3
bend = "1 deg"
toolface = "30 deg"
[[string.components]]
name = "pipe"
outer_diameter = "5 in"  # as on the rack
inner_diameter = "4.276 in"
segment_length = "40 m"
[mud]
density = "1.2 sg"
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    (tmp_path / "hole.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n100,0,0\n550,90,0\n900,90,0\n")
    path = tmp_path / "tiny.toml"
    path.write_text(CASE)
    return path


def test_comments_and_units_stay(source: Path, tmp_path: Path) -> None:
    overrides = {"mud.density": "10 ppg", "string.components[1].name": "drill pipe", "bit.weight_on_bit": None}
    found = fctd.refine(fctd.load_case(source, overrides), 0.05, "trip_out", 850.0, graded=True)
    out = tmp_path / "new" / "fine.toml"
    out.parent.mkdir()
    write_refined(found, source, overrides, out)
    text = out.read_text()
    assert text.startswith("# Cut by fctd refine for trip_out with the bit at 850 m: ")
    for kept in ("# Of the planning meeting.", "# mine", "# ours", "# as the driller says it", "# as on the rack"):
        assert kept in text
    assert "# coarse" not in text  # of a chord tolerance that is another one now
    raw = tomllib.loads(text)
    assert raw["wellbore"]["intervals"] == [{"to_md": "2952.756 ft", "diameter": "8.5 in", "friction": 0.2}]
    assert raw["wellbore"]["survey"] == "../hole.csv"
    assert raw["wellbore"]["overlap"] == "0.1 m"
    assert raw["mud"] == {"density": "10 ppg"}
    assert "bit" not in raw
    parts = raw["string"]["components"]
    assert [part["name"] for part in parts] == sorted(part["name"] for part in parts)  # collars, then drill pipe
    assert {part["inner_diameter"] for part in parts if part["name"] == "drill pipe"} == {"4.276 in"}
    # The bent housing is bent once, at the upper end of its uppermost piece.
    collars = [part for part in parts if part["name"] == "collar"]
    assert [part.get("bend") for part in collars] == [None] * (len(collars) - 1) + ["1 deg"]
    assert [part.get("toolface") for part in collars] == [None] * (len(collars) - 1) + ["30 deg"]


def test_the_file_is_the_refined_case(source: Path, tmp_path: Path) -> None:
    found = fctd.refine(fctd.load_case(source), 0.05, "trip_out", 850.0)
    write_refined(found, source, {}, tmp_path / "fine.toml")
    written = fctd.load_case(tmp_path / "fine.toml")
    assert len(written.string.components) == len(found.case.string.components)
    for one, other in zip(written.string.components, found.case.string.components, strict=True):
        assert (one.name, one.segments, one.outer_diameter, one.bend) == (
            other.name, other.segments, other.outer_diameter, other.bend,
        )  # fmt: skip
        assert (one.length or 0.0) == pytest.approx(other.length or 0.0, rel=1e-9)
        assert (one.segment_length or 0.0) == pytest.approx(other.segment_length or 0.0, rel=1e-9)
    assert written.wellbore.chord_tolerance == pytest.approx(found.case.wellbore.chord_tolerance, rel=1e-9)


def test_the_survey_is_named_from_where_the_file_is(source: Path, tmp_path: Path) -> None:
    case = fctd.load_case(source)
    assert survey_from(tmp_path / "fine.toml", case) == "hole.csv"
    assert survey_from(tmp_path / "a" / "b" / "fine.toml", case) == "../../hole.csv"
    stations = {"wellbore.survey": None, "wellbore.stations": [[0, 0, 0], [900, 0, 0]]}
    assert survey_from(tmp_path / "fine.toml", fctd.load_case(source, stations)) is None


def test_a_survey_whose_name_toml_cannot_hold_is_refused(source: Path, tmp_path: Path) -> None:
    """From its own folder the path is short and in UTF-8; from elsewhere it leads through a folder that is not."""
    folder = tmp_path / "\udcff"
    folder.mkdir()
    for file in (source, tmp_path / "hole.csv"):
        file.rename(folder / file.name)
    case = fctd.load_case(folder / "tiny.toml")
    assert survey_from(folder / "fine.toml", case) == "hole.csv"
    with pytest.raises(InputError, match="a file in the folder of the survey") as caught:
        survey_from(tmp_path / "fine.toml", case)
    assert caught.value.key == "--out"
