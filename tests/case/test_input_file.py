"""Case and survey files are regular and of limited size: a pipe would block, and a device may never end."""

import os
from collections.abc import Callable
from pathlib import Path
from unittest.mock import Mock

import pytest

from fctd import load_case
from fctd.case.errors import InputError
from fctd.case.input_file import read_text, read_toml
from fctd.case.surveys.reading import read_survey

NO_FILE = "expected a regular file (this is a pipe or a device"


@pytest.mark.parametrize("name", ["pipe", "/dev/zero", "/dev/null", "link"])
def test_a_pipe_or_a_device_is_refused_at_once(name: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("/dev/zero")
    path = tmp_path / name
    for read in (load_case, read_survey):
        with pytest.raises(InputError) as caught:
            read(path)
        assert str(caught.value).startswith(f"{path}: {NO_FILE}")


def test_a_survey_that_is_a_pipe_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(tmp_path / "hole.csv")
    case = tmp_path / "case.toml"
    case.write_text(
        'name = "a"\n[wellbore]\nsurvey = "hole.csv"\n'
        "[[wellbore.intervals]]\nto_md = 10\ndiameter = 0.2\nfriction = 0.1\n"
        '[[string.components]]\nname = "pipe"\nouter_diameter = 0.1\ninner_diameter = 0.05\nsegment_length = 5\n'
    )
    monkeypatch.chdir(tmp_path)
    for overrides in ({}, {"wellbore.survey": "hole.csv"}):
        with pytest.raises(InputError) as caught:
            load_case("case.toml", overrides)
        assert f"{tmp_path}/hole.csv: {NO_FILE}" in str(caught.value)


@pytest.mark.parametrize(("read", "limit"), [(load_case, 4), (read_survey, 32)])
def test_the_limit_is_named(read: Callable[[Path], object], limit: int, tmp_path: Path) -> None:
    """Of a sparse file of a terabyte only the limit is read."""
    path = tmp_path / "large"
    with path.open("wb") as file:
        file.truncate(2**40)
    with pytest.raises(InputError) as caught:
        read(path)
    assert str(caught.value) == f"{path}: expected a file of at most {limit} MiB"


def test_a_file_of_the_limit_is_read(tmp_path: Path) -> None:
    path = tmp_path / "large"
    path.write_bytes(b"a" * 2**20)
    assert len(read_text(path, 1, "a text")) == 2**20
    path.write_bytes(b"a" * (2**20 + 1))
    with pytest.raises(InputError, match="at most 1 MiB"):
        read_text(path, 1, "a text")


def test_line_ends_and_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "text"
    path.write_bytes(b"\xef\xbb\xbfa\r\nb\rc\n")
    assert read_text(path, 1, "a text") == "a\nb\nc\n"


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"x = " + b"[" * 5000 + b"]" * 5000, r"a setup in TOML \(too many arrays or tables lie in each other\)"),
        (b"x = ", r"a setup in TOML \(Invalid value"),
        (b"x = '\xff'", r"a setup in TOML \('utf-8' codec"),
        (None, r"a setup that can be read \(No such file"),
    ],
)
def test_a_file_that_is_not_toml_says_why(content: bytes | None, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "setup.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=expected):
        read_toml(path, "a setup")


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("x = 8.535 in", "a quantity with its unit stands in quotes"),
        ("x = \u201c8.5 in\u201d", "quotes are straight"),
        ("x = 0,20", "decimals follow a point"),
        ('x = "8.5 in', "a quote is missing at the end of a text"),
        ("y = 2", "it stands in the case twice: remove one"),
        ("[[y]]", "each table of this list stands in double brackets, [[ and ]], the one above too"),
        ('x = "C:\\Users\\survey.csv"', "a path is written with /, or in single quotes"),
    ],
)
def test_the_line_that_is_no_toml_is_shown(line: str, hint: str, tmp_path: Path) -> None:
    path = tmp_path / "setup.toml"
    path.write_text(f"y = 1\n{line}\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_toml(path, "a setup")
    assert (caught.value.key, caught.value.value) == ("line 2", line)
    assert caught.value.expected.startswith("a setup in TOML (")
    assert caught.value.expected.endswith(f"; {hint}")


def test_a_toml_file_is_read_with_its_mark_and_line_ends(tmp_path: Path) -> None:
    path = tmp_path / "setup.toml"
    path.write_bytes(b"\xef\xbb\xbfx = 1\r\n[y]\r\nz = [2]\r\n")
    assert read_toml(path, "a setup") == {"x": 1, "y": {"z": [2]}}


@pytest.mark.parametrize(
    "text",
    [
        "a" + ".a" * 40_000 + " = 1", "[a" + ' . "a"' * 20_000 + "]", "x = {a" + ".'b'" * 20_000 + " = 1}",
        "\n".join(f"k{number}.a = 1" for number in range(100_000)),
        "\n".join(f"[a.k{number}]" for number in range(100_000)),
    ],
    ids=["dotted", "header", "inline", "keys", "tables"],
)  # fmt: skip
def test_keys_that_would_take_minutes_are_refused_at_once(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before they are parsed: a reader of TOML keeps every beginning of a dotted key, 4 GiB of 80 kB."""
    monkeypatch.setattr("tomllib.loads", Mock(side_effect=AssertionError))
    path = tmp_path / "case.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=r"in TOML \(.* has a key of more than 16 parts|at most 50,000 keys"):
        load_case(path)


def test_as_many_stations_as_a_case_may_have_are_read(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text("# 1.2.3. etc. etc.\nrows = [\n" + "[1.5, 2.5, 0.5],\n" * 10_000 + "]\n")
    assert len(read_toml(path, "a case file")["rows"]) == 10_000
