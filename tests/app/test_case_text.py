"""Cases and surveys that anyone may have written: nothing else is opened, nothing is too large."""

import io
import tomllib
import zipfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.app.case_text import MOST_STATIONS, SourceCase, check_paths, check_survey, from_upload
from fctd.app.sessions import Source
from fctd.case import input_file
from fctd.case.errors import InputError
from tests.app.made import SURVEY, TEXT, source

SECRET = "root:x:0:0"
BILLION = '<!DOCTYPE a [<!ENTITY b "' + "x" * 99 + '"><!ENTITY c "' + "&b;" * 99 + '">]><a>&c;</a>'


def zipped(parts: dict[str, bytes]) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as book:
        for name, content in parts.items():
            book.writestr(name, content)
    return sink.getvalue()


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Files that a case has opened."""
    found: list[Path] = []
    read = input_file.read_bytes

    def noted(path: Path, largest: int) -> bytes:
        found.append(path)
        return read(path, largest)

    for module in ("fctd.case.input_file", "fctd.case.surveys.reading"):
        monkeypatch.setattr(f"{module}.read_bytes", noted)
    return found


@pytest.mark.parametrize(
    "written",
    [
        '"/etc/passwd"', '"../secret.txt"', '"folder/survey.csv"', '"survey.csv/../../secret.txt"', '"SURVEY.csv"',
        '["survey.csv"]', "{path = 'survey.csv'}", "3", "true", '"http://example.org/survey.csv"', '"\\u0000"', '""',
    ],
)  # fmt: skip
def test_a_case_opens_no_other_file(written: str, opened: list[Path], tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text(SECRET)
    folder = tmp_path / "work"
    folder.mkdir()
    text = TEXT.replace('"survey.csv"', written)
    for given_source in (source(text), Source(text)):
        with pytest.raises(InputError, match="uploaded with the case") as refused:
            SourceCase(given_source, folder)
        assert SECRET not in str(refused.value)
    assert opened == []


@given(st.text(max_size=60) | st.integers() | st.none() | st.lists(st.text(max_size=5), max_size=2))
def test_only_the_name_of_the_survey_passes(named: object) -> None:
    raw = {"wellbore": {"survey": named}}
    if named is None or named == "s.csv":
        check_paths(raw, "s.csv")
    else:
        with pytest.raises(InputError):
            check_paths(raw, "s.csv")


def test_a_case_keeps_its_text_and_says_nothing_of_its_copy(tmp_path: Path) -> None:
    read = SourceCase(source(), tmp_path)
    assert read.case.mud.density == 1200
    assert read.case.wellbore.trajectory.shape == (4, 3)
    changed = {"mud.density": 1300.0, "string.components[0].segments": None, "bit.torque": 2e3}
    text = read.text(changed)
    assert "# a comment that stays" in text
    assert tomllib.loads(text)["wellbore"]["survey"] == "survey.csv"
    assert "segments" not in tomllib.loads(text)["string"]["components"][0]
    again = SourceCase(source(text), tmp_path).case
    assert (again.mud.density, again.bit.torque) == (1300, 2e3)
    assert read.changed(changed).mud == again.mud
    for bad in (b"md_m,inc_deg,azi_deg\n0,0,30\n100,x,30\n", b"\x89PNG\r\n\x1a\n" + bytes(99), b""):
        with pytest.raises(InputError) as refused:
            SourceCase(source(survey=bad), tmp_path)
        assert str(refused.value).startswith("survey.csv: ")
        assert str(tmp_path) not in str(refused.value)
    with pytest.raises(InputError, match=r"\[wellbore\]"):
        SourceCase(Source("name = 'x'"), tmp_path)
    for wrong in ("=", "name = '''", "a = " + "[" * 5000):
        with pytest.raises(InputError, match="TOML"):
            SourceCase(Source(wrong), tmp_path)


@pytest.mark.parametrize(
    "content",
    [
        BILLION.encode(), b"\xff\xfe" + BILLION.encode("utf-16-le"), BILLION.lower().encode(),
        zipped({"xl/workbook.xml": BILLION.encode()}),
        zipped({"xl/worksheets/sheet1.xml": b" " * (2**16 - 4) + BILLION.encode()}),
    ],
)  # fmt: skip
def test_a_document_type_is_refused(content: bytes, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"^survey\.xml: .*DOCTYPE"):
        check_survey(content, "survey.xml")
    with pytest.raises(InputError, match=r"^survey\.xml: .*DOCTYPE"):
        from_upload("survey.xml", content, "si", tmp_path)


@pytest.mark.slow
def test_a_packed_file_is_not_unpacked_beyond_its_limit() -> None:
    bomb = zipped({f"xl/{k}.xml": bytes(9 * 2**20) for k in range(6)})
    assert len(bomb) < 2**17
    with pytest.raises(InputError, match=r"^bomb\.xlsx: expected a workbook of at most 50 MiB when unpacked"):
        check_survey(bomb, "bomb.xlsx")
    check_survey(zipped({"xl/workbook.xml": b"<a/>"}), "a.xlsx")
    with pytest.raises(InputError, match="xlsx"):
        check_survey(b"PK\x03\x04" + bytes(99), "a.xlsx")


def test_too_many_stations_and_segments_are_refused(tmp_path: Path) -> None:
    rows = "".join(f"{k * 0.01:.2f},0,30\n" for k in range(MOST_STATIONS + 1))
    survey = ("md_m,inc_deg,azi_deg\n" + rows).encode()
    with pytest.raises(
        InputError, match=rf"^survey\.csv: expected at most {MOST_STATIONS} stations, here {MOST_STATIONS + 1}$"
    ):
        from_upload("survey.csv", survey, "si", tmp_path)
    with pytest.raises(InputError, match=f"at most {MOST_STATIONS} stations"):
        SourceCase(source(TEXT.replace('"900 m"', '"500 m"').replace('"880 m"', '"400 m"'), survey=survey), tmp_path)
    more = survey * 3  # beyond what a file may have, too: the page has the one limit
    for read in (
        lambda: from_upload("survey.csv", more, "si", tmp_path),
        lambda: SourceCase(source(survey=more), tmp_path),
    ):
        with pytest.raises(InputError, match=rf"^survey\.csv: expected at most {MOST_STATIONS} stations$"):
            read()
    with pytest.raises(InputError, match=r"^expected a string of at most 2000 segments in the hole, here about \d+$"):
        SourceCase(source(TEXT.replace('"25 m"', '"0.4 m"')), tmp_path)


def test_a_refusal_says_which_survey_came(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r'the file that came is "other\.csv"'):
        SourceCase(source(name="other.csv"), tmp_path)
    with pytest.raises(InputError, match="no survey came"):
        SourceCase(Source(TEXT), tmp_path)


def test_a_warning_names_the_survey_as_its_user_does(tmp_path: Path) -> None:
    found = SourceCase(source(TEXT.replace("survey.csv", "Smith 3.csv"), "Smith 3.csv"), tmp_path)
    keys = [str(one.key) for one in found.case.warnings]
    assert any(key.startswith("survey.csv, row") for key in keys)  # the copy
    assert [one.key for one in found.warnings] == [key.replace("survey.csv", "Smith 3.csv") for key in keys]


def test_a_survey_becomes_a_case(tmp_path: Path) -> None:
    made, note = from_upload("my survey.csv", SURVEY, "si", tmp_path)
    assert (made.survey_name, note) == ("my survey.csv", "")
    case = SourceCase(made, tmp_path).case
    assert case.name == "my survey"
    assert case.depths[1] == 900
    with pytest.raises(InputError, match=r"^notes\.txt: "):
        from_upload("notes.txt", b"no survey at all", "si", tmp_path)
