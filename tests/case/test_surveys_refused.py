"""Wrong survey files: each has one message, and no bytes end in anything else."""

import io
import os
import time
import zipfile
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.case.load import load_case
from fctd.case.surveys import reading
from fctd.case.surveys import witsml as xml
from fctd.case.surveys.reading import read_survey
from fctd.case.tables import workbook as sheets
from fctd.case.tables.headers import Choice
from tests.case.survey_files import DEPTH, HEADERS, SHEET, WRONG, WRONG_WORKBOOKS, Keys, witsml, workbook


def refusal(path: Path) -> InputError:
    """The error that reading raises; its message names the file."""
    with pytest.raises(InputError) as caught:
        read_survey(path)
    assert str(caught.value).startswith(f"{path}: ")
    return caught.value


def message(case_file: Path, keys: Keys, content: str | bytes) -> str:
    """What loading a case with this survey says, below the name of the survey."""
    path = case_file.parent / "survey.dat"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    overrides = {"wellbore.stations": None, "wellbore.survey": str(path)}
    with pytest.raises(InputError) as caught:
        load_case(case_file, overrides | {f"wellbore.{key}": value for key, value in keys.items()})
    return str(caught.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize(("keys", "content", "said"), [row[1:] for row in WRONG], ids=[row[0] for row in WRONG])
def test_a_wrong_survey(case_file: Path, keys: Keys, content: str | bytes, said: str) -> None:
    assert message(case_file, keys, content) == said


@pytest.mark.parametrize(
    ("keys", "sheets", "said"), [row[1:] for row in WRONG_WORKBOOKS], ids=[row[0] for row in WRONG_WORKBOOKS]
)
def test_a_wrong_workbook(case_file: Path, keys: Keys, sheets: dict[str, list[list[object]]], said: str) -> None:
    assert message(case_file, keys, workbook(sheets)) == said


def test_a_file_that_is_no_survey_is_not_shown(case_file: Path) -> None:
    """A case of someone else may name any file, and its columns."""
    secret = "root:$6$salt$hash:19000:0:99999:7:::\n"
    for keys in ({}, {"columns": {"md": "Depth"}}):
        assert "hash" not in message(case_file, keys, secret)


def test_no_workbook_of_excel(tmp_path: Path) -> None:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as parts:
        parts.writestr("content.xml", "<x/>")
    path = tmp_path / "survey.ods"
    path.write_bytes(content.getvalue())
    assert refusal(path).expected == "a workbook of Excel (xlsx), or a text file"


def test_a_workbook_that_is_large_when_unpacked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    content = io.BytesIO(workbook({"A": SHEET}))
    with zipfile.ZipFile(content, "a", zipfile.ZIP_DEFLATED) as parts:
        parts.writestr("xl/media/picture.bmp", bytes(2**20))
    monkeypatch.setattr(sheets, "_LARGEST", 1)
    path = tmp_path / "survey.xlsx"
    path.write_bytes(content.getvalue())
    assert refusal(path).expected == "a workbook of at most 1 MiB when unpacked"


def test_the_largest_survey_is_read_to_its_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "SURVEY", replace(reading.SURVEY, most=3))
    path = tmp_path / "survey.csv"
    rows = [HEADERS, "0,0,0", "10,0,0", "20,0,0", "30,0,x"]
    path.write_text("\n".join(rows[:-1]))
    assert read_survey(path).stations[:, 0].tolist() == [0, 10, 20]
    path.write_text("\n".join(rows))
    assert refusal(path).expected == "at most 3 stations"


def test_the_largest_trajectory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "survey.xml"
    path.write_text(witsml("S1"))
    monkeypatch.setattr(xml, "MOST_STATIONS", len(DEPTH))
    assert len(read_survey(path).stations) == len(DEPTH)
    monkeypatch.setattr(xml, "MOST_STATIONS", len(DEPTH) - 1)
    assert refusal(path).expected == "at most 4 stations"


def test_more_stations_than_any_well_has(tmp_path: Path) -> None:
    """Refused before the numbers are read."""
    path = tmp_path / "survey.csv"
    path.write_text(f"{HEADERS}\n" + "".join(f"{0.01 * k:.2f},0,0\n" for k in range(100_001)) + "no number\n")
    assert refusal(path).expected == "at most 100000 stations"


def test_a_file_larger_than_any_survey(tmp_path: Path) -> None:
    path = tmp_path / "survey.csv"
    path.touch()
    os.truncate(path, 32 * 2**20 + 1)
    assert refusal(path).expected == "a file of at most 32 MiB"


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    assert "expected a survey file that can be read (No such file" in str(refusal(tmp_path / "none.csv"))
    assert "expected a survey file that can be read (Is a directory)" in str(refusal(tmp_path))


def test_a_cell_without_end(tmp_path: Path) -> None:
    path = tmp_path / "survey.csv"
    path.write_bytes(HEADERS.encode() + b'\n"' + b"0" * 200_000)
    assert "a text in columns (field larger than field limit" in str(refusal(path))


@pytest.mark.parametrize("line", ["1" + " " * 100_000 + "(", "# " + " " * 100_000, "<c " * 30_000])
def test_long_lines_take_no_time(line: str, tmp_path: Path) -> None:
    """No pattern goes back over blanks again and again."""
    path = tmp_path / "survey.csv"
    path.write_text(f"MD (m) Inc Azi\n0 0 0\n{line}\n1 2\n")
    began = time.process_time()
    assert refusal(path).key.startswith("row ")
    assert time.process_time() - began < 1.0


def test_elements_within_elements(tmp_path: Path) -> None:
    path = tmp_path / "survey.xml"
    path.write_text("<a>" * 100_000 + "</a>" * 100_000)
    assert 'found the element "a"' in str(refusal(path))


# --- any bytes -------------------------------------------------------------------------------------

CELLS = st.text('0123456789.,;-+eE\t |"\n#xnaft°()[]_ mdic', max_size=60)
STARTS = [
    "md_m,inc_deg,azi_deg\n0,0,0\n",
    "MD;Inc;Azi\nm;deg;deg\n",
    "MD(m) Inc Azi\n0 0 0\n",
    "#",
    "<",
    "\ufeff",
    "PK\x03\x04",
    "",
]


@settings(max_examples=100)
@given(start=st.sampled_from(STARTS), rest=st.binary(max_size=60) | CELLS.map(str.encode))
def test_any_bytes_are_stations_or_refused(start: str, rest: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    check_read(tmp_path_factory, start.encode() + rest)


@settings(max_examples=100)
@given(seed=st.integers(0, 2**32))
def test_changed_workbooks_and_trajectories_are_stations_or_refused(
    seed: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    rng = Random(seed)
    content = bytearray(rng.choice(SOUND))
    for _ in range(rng.choice([1, 3])):
        place = rng.randrange(len(content))
        content[place : place + rng.choice([0, 1, 9])] = bytes(
            rng.choices(b'<>"=AZ09/ &;:\0\xff', k=rng.choice([0, 1, 3]))
        )
    check_read(tmp_path_factory, bytes(content))


def unpacked(content: bytes) -> bytes:
    """The workbook with its parts as they are, so that changed bytes reach the reader."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as parts, zipfile.ZipFile(out, "w") as stored:
        for name in parts.namelist():
            stored.writestr(name, parts.read(name))
    return out.getvalue()


SOUND = [witsml("S1").encode(), workbook({"A": SHEET}), unpacked(workbook({"A": SHEET}))]


def check_read(factory: pytest.TempPathFactory, content: bytes) -> None:
    path = factory.mktemp("bytes") / "survey"
    path.write_bytes(content)
    try:
        found = read_survey(path, {"md": Choice(None, "m")} if len(content) % 2 else None).stations
    except InputError as error:
        said = str(error)
    else:
        is_a_path(found)
        return
    assert said.startswith(f"{path}: ")


def is_a_path(found: np.ndarray) -> None:
    assert found.shape[1] == 3
    assert found[0, 0] == 0.0
    assert (found[1:, 0] > found[:-1, 0]).all()


def test_a_text_that_is_named_as_a_workbook(tmp_path: Path) -> None:
    """A survey in columns is read whatever its name; any other text is no workbook."""
    path = tmp_path / "survey.xlsx"
    path.write_text(f"{HEADERS}\n0,0,0\n100,1,2\n")
    assert len(read_survey(path).stations) == 2
    path.write_text("see the other sheet\n")
    assert str(refusal(path)).startswith(
        f"{path}: expected a workbook, as the name says: the file is a text, and no survey (expected a row of "
    )
