"""Files that come to the page: which make a case, and how they are refused."""

import base64

import pytest

from fctd.app.uploads import content_of, source_of, text_of
from fctd.case.errors import InputError
from tests.app.made import SURVEY, TEXT, InProcess, source


def test_files_that_come_together_make_a_case() -> None:
    pool = InProcess()
    case = {"well.toml": TEXT.encode()}
    assert source_of(case | {"survey.csv": SURVEY}, None, pool, "si") == (source(), "")  # type: ignore[arg-type]
    alone, _ = source_of({"../my well.csv": SURVEY}, source(), pool, "si")  # type: ignore[arg-type]
    assert alone.survey_name == "my well.csv"
    assert 'survey = "my well.csv"' in alone.text
    waiting = source(TEXT, "", b"")
    assert source_of({"survey.csv": SURVEY}, waiting, pool, "si") == (source(), "")  # type: ignore[arg-type]
    other, note = source_of({"other.csv": SURVEY}, waiting, pool, "si")  # type: ignore[arg-type]
    assert (other.survey_name, note) == ("other.csv", "")
    _, note = source_of({"o.csv": SURVEY.replace(b"md_m", b"md_ft")}, None, pool, "si")  # type: ignore[arg-type]
    assert note == "o.csv: its depths are in ft, as the file says, those of the case in m"
    _, note = source_of({"o.csv": SURVEY.replace(b"md_m", b"md")}, None, pool, "field")  # type: ignore[arg-type]
    assert note.startswith("o.csv: the file names no unit of depth: ft is assumed, as in the key wellbore.columns: if")
    for files, words in (
        ({}, "one case"), ({"a.csv": b"", "b.csv": b""}, "one case"), ({"a.toml": b"", "b.toml": b""}, "one case"),
        ({"a.toml": b"\xff\xfe\x00"}, "UTF-8"), ({"a.toml": b"="}, "TOML"), ({"a.csv": bytes(9)}, "a survey"),
        (case, "uploaded with the case"), (case | {"other.csv": SURVEY}, "uploaded with the case"),
    ):  # fmt: skip
        with pytest.raises(InputError, match=words):
            source_of(files, None, pool, "si")  # type: ignore[arg-type]
    pool.close()


def test_contents_of_files() -> None:
    assert content_of("data:text/csv;base64," + base64.b64encode(b"a,b").decode()) == b"a,b"
    for text in ("data:text/csv;base64,?", "data:;base64,a", "data:;base64,é"):
        with pytest.raises(InputError, match="a file"):
            content_of(text)


def test_measured_rows_come_as_text() -> None:
    assert text_of(b"\xef\xbb\xbfa,b") == "a,b"
    for content in (b"PK\x03\x04\x00", "a,b".encode("utf-16"), b"\xff"):
        with pytest.raises(InputError, match="UTF-8"):
            text_of(content)
