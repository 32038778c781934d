"""Survey files: headers with units, real files, and the message for each wrong file."""

import math
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case import survey_file
from fctd.case.errors import MISSING, InputError
from fctd.case.survey_file import StationKey, check_stations, read_stations, to_radians

DATA = Path(os.environ.get("FCTD_DATA", Path(__file__).parents[2] / ".." / "shared" / "data"))

Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes lines to a file and returns its path."""

    def write(*lines: str) -> Path:
        path = tmp_path / "survey.csv"
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    return write


def refusal(path: Path, columns: dict[StationKey, str] | None = None) -> InputError:
    """The error that reading raises; its message names the file."""
    with pytest.raises(InputError) as caught:
        read_stations(path, columns)
    assert str(caught.value).startswith(f"{path}: ")
    return caught.value


# --- what is read ----------------------------------------------------------------------------------


def test_metres_and_degrees(write: Write) -> None:
    stations = read_stations(write("md_m,inc_deg,azi_deg", "0,0,0", "10.5,1.5,359"))
    assert stations.dtype == np.float64
    assert stations.tolist() == [[0, 0, 0], [10.5, math.radians(1.5), pytest.approx(math.radians(-1), rel=1e-13)]]


def test_feet_and_radians_in_any_order_and_case(write: Write) -> None:
    stations = read_stations(write("AZI_RAD, Note ,Inc_Rad,MD_FT", "0,a,0,0", "1,b,0.5,100"))
    assert stations[1] == pytest.approx([30.48, 0.5, 1], rel=1e-14)


@pytest.mark.parametrize("header", ["Measured Depth ( ft )", "Measured Depth (FT)", "depth_ft", "MD_FT"])
def test_a_named_header_carries_its_unit(write: Write, header: str) -> None:
    path = write(f"inc_deg,azi_deg,{header}", "0,0,0", "0,0,100")
    assert read_stations(path, {"md": header})[1, 0] == pytest.approx(30.48, rel=1e-14)


def test_blank_lines_byte_order_mark_and_quotes_are_nothing(tmp_path: Path) -> None:
    path = tmp_path / "survey.csv"
    path.write_text('\n"md_m","inc_deg","azi_deg"\r\n\r\n0,0,0\r\n,,\r\n"10",0,0\r\n', encoding="utf-8-sig")
    assert read_stations(path)[:, 0].tolist() == [0, 10]


def test_exact_repeats_are_dropped(write: Write) -> None:
    rows = ["0,0,0", "0,0,0", "10,1,2", "10,1,2", "10,1,2", "20,1,2"]
    assert read_stations(write("md_m,inc_deg,azi_deg", *rows))[:, 0].tolist() == [0, 10, 20]


@given(
    steps=st.lists(st.floats(1e-3, 100), min_size=1, max_size=20),
    repeats=st.lists(st.integers(1, 3), min_size=21, max_size=21),
)
def test_repeats_never_change_what_remains(steps: list[float], repeats: list[int]) -> None:
    md = np.concatenate([[0.0], np.cumsum(steps)])
    stations = np.column_stack([md, np.minimum(md, 180), -md % 360])
    repeated = np.repeat(stations, repeats[: len(md)], axis=0)
    checked = check_stations(repeated, lambda row, column: (f"[{row}][{column}]", MISSING))
    assert np.array_equal(checked, to_radians(stations))


def test_the_bounds_themselves_are_accepted(write: Write) -> None:
    stations = read_stations(write("md_m,inc_deg,azi_deg", "0,0,-720", "10,180,720", "50000,0,720"))
    assert stations[1:, 0].tolist() == [10, 50_000]
    assert stations[1, 1] == pytest.approx(math.pi, rel=1e-15)


def test_a_row_within_a_nanometre_of_the_one_before_is_the_same_station() -> None:
    def kept(md: float) -> int:
        return len(check_stations(np.array([[0, 0, 0], [md, 0, 0], [10, 0, 0]]), lambda *_: ("", MISSING)))

    assert (kept(1e-9), kept(1.2e-9)) == (2, 3)


# --- what is refused -------------------------------------------------------------------------------

HEADERS = "md_m,inc_deg,azi_deg"


@pytest.mark.parametrize(
    ("rows", "key", "value", "expected"),
    [
        (["0,0,0", "10,x,0"], "row 3, inc_deg", "x", "a number"),
        (["0,0,0", "10,,0"], "row 3, inc_deg", "", "a number"),
        (["0,0,0", "", "10,0"], "row 4, azi_deg", "", "a number"),
        (["0,0,0", "nan,0,0"], "row 3, md_m", "nan", "a finite number"),
        (["0,0,0", "10,0,-inf"], "row 3, azi_deg", "-inf", "a finite number"),
        (["0,0,0", "10,180.5,0"], "row 3, inc_deg", "180.5", "an inclination from 0 to 180 deg"),
        (["0,-0.1,0", "10,0,0"], "row 2, inc_deg", "-0.1", "an inclination from 0 to 180 deg"),
        (["0,0,0", "10,0,-999.25"], "row 3, azi_deg", "-999.25", "an azimuth from -720 to 720 deg"),
        (["0,0,0", "10,0,720.5"], "row 3, azi_deg", "720.5", "an azimuth from -720 to 720 deg"),
        (["0,0,0", "50000.5,0,0"], "row 3, md_m", "50000.5", "a measured depth of at most 50 km"),
        (["5,0,0", "10,0,0"], "row 2, md_m", "5", "measured depth 0, add a tie-in station at surface"),
        (["-5,0,0", "10,0,0"], "row 2, md_m", "-5", "measured depth 0, add a tie-in station at surface"),
        (
            ["0,0,0", "20,0,0", "20,0,0", "10,0,0"],
            "row 5, md_m",
            "10",
            "greater than that of the station before",
        ),
        (["0,0,0", "20,0,0", "20,1,0"], "row 4, md_m", "20", "greater than that of the station before"),
        (["0,0,0"], "", MISSING, "at least two different stations, found 1"),
        (["0,0,0", "0,0,0"], "", MISSING, "at least two different stations, found 1"),
        ([], "", MISSING, "at least two different stations, found 0"),
    ],
)
def test_a_wrong_row(write: Write, rows: list[str], key: str, value: object, expected: str) -> None:
    error = refusal(write(HEADERS, *rows))
    assert (error.key, error.value) == (key, value)
    assert key in str(error)
    assert expected in str(error)


def test_the_whole_message(write: Write) -> None:
    path = write(HEADERS, "0,0,0", "10,x,0")
    assert str(refusal(path)) == f'{path}: row 3, inc_deg = "x": expected a number'


def test_a_missing_column_lists_the_headers(write: Write) -> None:
    message = str(refusal(write("md,inc_deg,azi_deg", "0,0,0")))
    assert 'column md_m or md_ft is missing: expected it among the headers "md", "inc_deg"' in message


@pytest.mark.parametrize("separator", [";", "\t"])
def test_other_separators_are_named(write: Write, separator: str) -> None:
    header = HEADERS.replace(",", separator)
    error = refusal(write(header, separator.join(["0,0", "0,0", "0,0"])))
    assert (error.key, error.value) == ("row 1", header)
    assert "columns separated by commas" in str(error)


def test_a_named_column_that_is_missing(write: Write) -> None:
    error = refusal(write(HEADERS, "0,0,0"), {"md": "Depth (m)"})
    assert (error.key, error.value) == ("columns.md", "Depth (m)")
    assert 'one of the headers "md_m", "inc_deg", "azi_deg"' in str(error)


@pytest.mark.parametrize("header", ["Depth", "Depth (deg)", "Depth ( km )", "depth_"])
def test_a_named_header_without_a_usable_unit(write: Write, header: str) -> None:
    error = refusal(write(f"{header},inc_deg,azi_deg", "0,0,0"), {"md": header})
    assert (error.key, error.value) == ("columns.md", header)
    assert "a header that ends in its unit, ( m ) or ( ft )" in str(error)


def test_an_empty_file(write: Write) -> None:
    assert "the file is empty" in str(refusal(write("", "")))


def test_more_stations_than_any_well_has(tmp_path: Path) -> None:
    """Refused before the memory is full: the file is not read to its end."""
    path = tmp_path / "survey.csv"
    path.write_text("md_m,inc_deg,azi_deg\n" + "".join(f"{0.01 * k:.2f},0,0\n" for k in range(100_001)) + "no number\n")
    assert refusal(path).expected == "at most 100000 stations"


def test_the_largest_survey_is_read_to_its_end(write: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(survey_file, "MOST_STATIONS", 3)
    rows = [HEADERS, "0,0,0", "10,0,0", "20,0,0", "30,0,0"]
    assert read_stations(write(*rows[:-1]))[:, 0].tolist() == [0, 10, 20]
    assert refusal(write(*rows)).expected == "at most 3 stations"


def test_a_file_larger_than_any_survey(tmp_path: Path) -> None:
    path = tmp_path / "survey.csv"
    path.touch()
    os.truncate(path, 32 * 2**20 + 1)
    assert refusal(path).expected == "a file of at most 32 MiB"


def test_a_missing_file(tmp_path: Path) -> None:
    assert "expected a survey file that can be read (No such file" in str(refusal(tmp_path / "none.csv"))


def test_a_folder(tmp_path: Path) -> None:
    assert "expected a survey file that can be read (Is a directory)" in str(refusal(tmp_path))


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"\x89PNG\r\n\x1a\n\xff\xfe", "a CSV file of text"),
        (b"PK\x03\x04\x00\x00\x00", "it among the headers"),
        (b'md_m,inc_deg,azi_deg\n"' + b"0" * 200_000, "a CSV file of text"),
    ],
)
def test_a_binary_file(tmp_path: Path, content: bytes, expected: str) -> None:
    path = tmp_path / "survey.csv"
    path.write_bytes(content)
    assert expected in str(refusal(path))


@given(content=st.binary(max_size=60) | st.text('0123456789.,-\n"xna', max_size=40).map(str.encode))
def test_any_bytes_are_stations_or_refused(content: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("bytes") / "survey.csv"
    path.write_bytes(b"md_m,inc_deg,azi_deg\n0,0,0\n" + content)
    try:
        stations = read_stations(path)
    except InputError:
        return
    assert stations.shape[1] == 3
    assert np.all(np.diff(stations[:, 0]) > 0)


# --- real files ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "columns", "count", "last"),
    [
        ("surveys/iscwsa_reference_well.csv", None, 100, (2940, 90, 180)),
        ("surveys/nlog_K05-ENC-05-S1.csv", None, 568, (8161, 77.58, 359.63)),
        (
            "surveys/wellpathpy_well9_horizontal_reference.csv",
            {"md": "Measured Depth ( ft )", "inc": "Inclination ( deg )", "azi": "Azimuth Grid ( deg )"},
            121,
            (7922 * 0.3048, 90.25, 212.16),
        ),
        ("volve-15-9-F-4/survey.csv", None, 87, (3510, 54.67, 202.72)),
    ],
)
def test_real_surveys(
    name: str, columns: dict[StationKey, str] | None, count: int, last: tuple[float, float, float]
) -> None:
    """Counts and last stations are read off the files."""
    if not (DATA / name).is_file():
        pytest.skip(f"{DATA / name} is missing: public well surveys, folder from FCTD_DATA, see README")
    stations = read_stations(DATA / name, columns)
    assert len(stations) == count
    md, inclination, azimuth = stations[-1]
    assert (md, np.degrees(inclination), np.degrees(azimuth) % 360) == pytest.approx(last, rel=1e-12)
