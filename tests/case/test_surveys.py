"""Survey files as they are: headers, units, separators, encodings, workbooks, WITSML, and the public surveys."""

import math
import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import MISSING, InputError
from fctd.case.surveys import doubts
from fctd.case.surveys.reading import read_survey
from fctd.case.surveys.stations import StationKey, Survey, Written, check, to_radians
from fctd.case.tables.headers import Choice
from tests.case.survey_files import DEPTH, HEADERS, ROWS, SHEET, STATION, TEXT, text, witsml, workbook

DATA = Path(os.environ.get("FCTD_DATA", Path(__file__).parents[2] / ".." / "shared" / "data"))


def written(stations: list[list[float]] | np.ndarray) -> Written:
    """Stations in m and degrees as a case has them."""
    values = np.array(stations, dtype=float)
    return Written(values, ("m", "deg", "deg"), lambda row, column: (f"[{row}]", MISSING), range(len(values)))


def read(folder: Path, content: str | bytes, sheet: str | None = None, **columns: Choice) -> Survey:
    """The survey of a file with this content."""
    path = folder / "survey.dat"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    by_key: dict[StationKey, Choice] = {}
    for key in ("md", "inc", "azi"):
        if key in columns:
            by_key[key] = columns[key]  # type: ignore[index]
    return read_survey(path, by_key, sheet)


def is_the_survey(survey: Survey, unit: float = 1.0) -> None:
    """The stations are those of ROWS, whose depths are in a unit [m]."""
    stations = np.array([[float(cell) for cell in row.split(",")] for row in ROWS]) * [unit, 1.0, 1.0]
    assert survey.stations == pytest.approx(to_radians(stations), rel=1e-14)


FOOT = 0.3048


# --- headers and units -----------------------------------------------------------------------------


_NUMBERED = [f"{k},{row}" for k, row in enumerate(ROWS)]
_PAGE = ["MD,Inc,Azi", "ft,deg,deg"]
# Contents that are the survey, and the unit of their depths [m].
FILES = {
    # Headers of the field.
    **{
        headers: (text(headers), unit)
        for headers, unit in [
            ("md_m,inc_deg,azi_deg", 1),
            ("MD_FT,Inc_Deg,AZI_deg", FOOT),
            ("Measured Depth ( ft ),Inclination ( deg ),Azimuth Grid ( deg )", FOOT),
            ("Measured Depth [m],Inclination [°],Azimuth [°]", 1),
            ("MD (metres),Incl (degrees),Azim (degrees)", 1),
            ("Depth feet,Hole Angle Inc,Hole Azimuth degrees", FOOT),
            ("DEPT.M,DEVI.DEG,AZIM_TN.DEG", 1),
            ("DEPT_M,DEV,HAZI", 1),
            ("M.D. (m),Inc.,Azi.", 1),
            ("MD mRKB,Drift Angle,AZ", 1),
            ("Along Hole Depth (m),Deviation,Azimuth (True North)", 1),
            ("MD (usft),Inc (°),Azi (azimuth) (°)", 1200 / 3937),
            ("Depth (m RT),Inclin,AZI_GN", 1),
            ("Depth ( ft ),I_deg,A_deg", FOOT),
            ("Depth in feet,Drift,Direction", FOOT),
            ("MDepth (ft),Drift,Direction", FOOT),
            ("MDRKB ft,Inc,Azi", FOOT),
            ("Measured Depth from RKB (feet),Inc,Azi", FOOT),
            ("Depth m,Inc,Azi", 1),
        ]
    },
    # A row of units, also as a comment.
    **{
        f"units {units}": (text(f"MD,Inc,Azi\n{units}"), FOOT)
        for units in (
            "ft,deg,deg", "(ft),(deg),(deg)", "[feet],[°],[°]", "ft,,", "Feet,degrees,Degrees", "ftMD,deg,deg",
            "# a gyro\n# ft,deg,deg",
        )
    },
    "units in a comment": (text("Sta MD Inc Azi\n# (ft) (deg) (deg)", " ", _NUMBERED), FOOT),
    "headers on each page": (text("Page 1\n" + "\n".join(_PAGE), rows=[*ROWS[:2], "", *_PAGE, *ROWS[2:]]), FOOT),
    "other columns": (
        text("No,MD (m),Inc,Azi,TVD (m),Tool,DLS (deg/30m)", rows=[f"{row},-9,x,0" for row in _NUMBERED]), 1,
    ),
    # Columns apart by something else, decimal commas, blanks that group digits.
    **{
        f"apart by {separator!r}": (text(separator.join(["MD(ft)", "Inc", "Azi"]), separator), FOOT)
        for separator in (",", ";", "\t", "|", " ", "   ", ", ", " \t ")
    },
    **{
        f"commas and {separator!r}": (
            "\n".join(row.replace(",", separator).replace(".", ",") for row in ("MD(m),Inc,Azi", *ROWS)), 1,
        )
        for separator in (";", "\t", "|", " ")
    },
    "byte order mark": ("\ufeff" + text("MD (ft),Inc,Azi"), FOOT),
    "blanks in numbers": ("MD (m);Inc;Azi\n0;0;0\n500;0;90\n1\u202f000;30,5;90\n1 500;45;91\n2\u00a0000,0;60;92,25", 1),
    **{
        headers: (text(headers, "  "), 1)
        for headers in (
            "MD (m) Inc (deg) Azi (deg)",
            "Measured Depth (m)   Inclination (deg)  Azimuth Grid (deg)",
            "  MD     Inc    Azi\n  (m)   (deg)  (deg)",
            "MD Inc Azi\nm deg deg",
            "# md_m inc_deg azi_deg",
            "#MD_m  Inc  Azi",
        )
    },
    **{
        encoding: (("Brønn A-1, Sørfeltet\n" + text("MD (ft);Inc (°);Azi (°)", ";")).encode(encoding), FOOT)
        for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1", "cp1252")
    },
}  # fmt: skip


@pytest.mark.parametrize(("content", "unit"), FILES.values(), ids=FILES)
def test_a_text_is_the_survey(content: str | bytes, unit: float, tmp_path: Path) -> None:
    is_the_survey(read(tmp_path, content), unit)


def test_radians(tmp_path: Path) -> None:
    survey = read(tmp_path, "AZI_RAD, Note ,Inc (radians),MD_FT\n0,a,0,0\n1,b,0.5,100\n")
    assert survey.stations[1] == pytest.approx([30.48, 0.5, 1], rel=1e-14)


@pytest.mark.parametrize(
    "depth",
    ["M.Depth", "M Depth", "M. Depth", "M-Depth", "m_depth", "MDepth", "Depth M", "DEPTH M", "M.D.", "Meas. Depth"],
)
@pytest.mark.parametrize("first", ["#", "No", "", "(ft)", "1"])
def test_the_row_below_the_headers_has_the_units(depth: str, first: str, tmp_path: Path) -> None:
    """The M of a depth is that of "measured", and a row of units may begin with anything."""
    rows = [f"{k},{row}" for k, row in enumerate(ROWS)]
    units = f"{first},(ft),(deg),(deg)"
    is_the_survey(read(tmp_path, text(f"Sta.,{depth},Inclin,Azim. Grid\n{units}", rows=rows)), FOOT)
    for header in (f"{depth} (ft)", f"{depth}_ft"):
        is_the_survey(read(tmp_path, text(f"{header},Inc,Azi")), FOOT)


def test_a_letter_names_an_angle_where_no_word_does(tmp_path: Path) -> None:
    rows = [f"{row},80,70" for row in ROWS]
    is_the_survey(read(tmp_path, text("md_m,Inc,Azi,I (deg),A (deg)", rows=rows)))
    for headers in ("md_m,I,Azi", "md_m,I_m,Azi"):
        with pytest.raises(InputError, match="column inc_deg"):
            read(tmp_path, text(headers))


def test_depth_beside_measured_depth_is_another_one(tmp_path: Path) -> None:
    survey = read(tmp_path, "Depth (m),MD (ft),Inc,Azi\n0,0,0,0\n90,1000,60,0\n")
    assert survey.stations[1, 0] == pytest.approx(304.8, rel=1e-14)


@pytest.mark.parametrize("header", ["DEPTH", "depth", "Depth"])
def test_the_case_names_header_and_unit(header: str, tmp_path: Path) -> None:
    is_the_survey(read(tmp_path, text("DEPTH,DEVI,AZIM"), md=Choice(header, "m")))
    is_the_survey(read(tmp_path, text("DEPTH,DEVI,AZIM"), md=Choice(None, "ft")), FOOT)


def test_the_case_chooses_between_two(tmp_path: Path) -> None:
    content = "md_m,inc,azi,md_ft\n0,0,0,0\n30.48,1,2,100\n60.96,1,2,200\n"
    for header in ("md_m", "MD_FT"):
        assert read(tmp_path, content, md=Choice(header)).stations[-1, 0] == pytest.approx(60.96, rel=1e-14)


def test_the_unit_in_the_case_goes_before_that_of_the_file(tmp_path: Path) -> None:
    """The remedy of a warning that depths look like feet."""
    is_the_survey(read(tmp_path, TEXT, md=Choice("md_m", "ft")), FOOT)
    is_the_survey(read(tmp_path, text("MD,Inc,Azi\nm,deg,deg"), md=Choice(None, "ft")), FOOT)


def test_a_header_named_by_the_case_may_have_any_words(tmp_path: Path) -> None:
    content = text("Tiefe (m),Neigung,Richtung")
    wanted = {"md": Choice("tiefe  (M)"), "inc": Choice("Neigung"), "azi": Choice("Richtung", "deg")}
    is_the_survey(read(tmp_path, content, **wanted))


# --- texts -----------------------------------------------------------------------------------------


def test_titles_and_comments(tmp_path: Path) -> None:
    """Line numbers count every line of the file."""
    above = "Well: A-1, North Sea; final\n\n# MD, Inc, Azi of the gyro\nAzimuth: grid north\n"
    content = above + text("MD (m),Inc,Azi").replace("1000,", "# casing 1000\n,,\n1000,")
    survey = read(tmp_path, content)
    is_the_survey(survey)
    assert survey.rows(0, 3) == "survey.dat, rows 6 to 11"
    with pytest.raises(InputError) as caught:
        read(tmp_path, content.replace("1500", "x"))
    assert caught.value.key == "row 11, MD (m)"


def test_quotes_and_line_ends(tmp_path: Path) -> None:
    content = '\r\n"Measured\nDepth\n(m)","Inc, deg",Azi\r\n\r\n0,0,0\r\n,,\r\n"10",0,0\r\n\x1a'
    assert read(tmp_path, content).stations[:, 0].tolist() == [0, 10]
    assert read(tmp_path, TEXT.replace("\n", "\r")).stations[:, 0].tolist() == DEPTH


# --- workbooks -------------------------------------------------------------------------------------


def test_a_workbook(tmp_path: Path) -> None:
    """The sheet with the headers of a survey is read; rows have the numbers that Excel shows."""
    survey = read(tmp_path, workbook({"Info": [["Well", "A-1"]], "Survey": SHEET, "Empty": []}))
    is_the_survey(survey, FOOT)
    assert survey.rows(0, 4) == "survey.dat, rows 5 to 9"


def test_a_sheet_by_name(tmp_path: Path) -> None:
    plan = [*SHEET[:-1], ["", 3000.0, 1.0, 2.0]]
    content = workbook({"Plan": plan, "Survey": SHEET})
    is_the_survey(read(tmp_path, content, "Survey"), FOOT)
    assert read(tmp_path, content, "Plan").stations[-1, 0] == pytest.approx(3000 * FOOT, rel=1e-14)


def test_a_header_that_no_sheet_has(tmp_path: Path) -> None:
    """The header is told of, and not the sheet: one alone has headers of a survey."""
    content = workbook({"Cover": [["Well", "A-1"], ["Date", "3 May"]], "Survey": SHEET})
    with pytest.raises(InputError, match=r'azi = "Azi Grid": expected the header'):
        read(tmp_path, content, azi=Choice("Azi Grid"))


def test_cells_that_are_text(tmp_path: Path) -> None:
    rows = [[cell.replace(".", ",") for cell in row.split(",")] for row in ROWS]
    is_the_survey(read(tmp_path, workbook({"A": [["MD (m)", "Inc", "Azi"], *rows]})))


def test_a_stray_cell_would_fill_the_memory(tmp_path: Path) -> None:
    """The package keeps the whole rectangle, and ends the process where the memory does not suffice."""
    import xlsxwriter

    path = tmp_path / "far.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet()
        sheet.write(0, 0, "MD (m)")
        sheet.write(29_999, 16_383, "x")
    with pytest.raises(InputError) as caught:
        read_survey(path)
    assert caught.value.expected == ("at most 20000000 cells up to the last one, which is in row 30000 or column 16384")


def test_without_the_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "python_calamine", None)
    with pytest.raises(InputError, match=re.escape("pip install 'fctd[excel]'")):
        read(tmp_path, workbook({"A": SHEET}))


# --- WITSML ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("version", ["1.3.1.1", "1.4.1.1"])
def test_a_trajectory(version: str, tmp_path: Path) -> None:
    survey = read(tmp_path, witsml("S1", version=version))
    is_the_survey(survey, FOOT)
    assert survey.rows(1, 2) == "survey.dat, trajectoryStations 2 to 3"


def test_a_trajectory_in_other_units_and_encodings(tmp_path: Path) -> None:
    content = witsml("Brønn").replace('uom="ft"', 'uom="m"').replace('"UTF-8"', '"ISO-8859-1"')
    is_the_survey(read(tmp_path, content.encode("latin-1")))
    in_radians = witsml("S1").replace('uom="dega">30.5', 'uom="dega">1.5').replace('uom="dega"', 'uom="rad"')
    in_radians = in_radians.replace(">45<", ">1.6<").replace(">60<", ">2.5<").replace(">9", ">")
    assert read(tmp_path, in_radians).stations[2, 1] == pytest.approx(1.5, rel=1e-14)


def test_a_trajectory_by_name(tmp_path: Path) -> None:
    is_the_survey(read(tmp_path, witsml("S1", "S2"), "S2"), FOOT)


def test_a_station_without_a_direction_is_left_out(tmp_path: Path) -> None:
    """Tie-in points have a depth alone."""
    survey = read(tmp_path, re.sub(r'<incl uom="dega">0</incl><azi uom="dega">0</azi>', "", witsml("S1")))
    assert survey.tied_in
    assert survey.stations[:, 0] == pytest.approx(np.array(DEPTH) * FOOT)


def test_rejected_stations_are_left_out_with_a_warning(tmp_path: Path) -> None:
    """The words of TrajStationStatus are open, rejected and position; here the station at 1,000 ft is taken twice."""
    each = [STATION.format(*row.split(",")) for row in ROWS]
    status = "<statusTrajStation>{}</statusTrajStation></trajectoryStation>"
    wrong = STATION.format("1000", "33", "94").replace("</trajectoryStation>", status.format("rejected"))
    good = [row.replace("</trajectoryStation>", status.format(word)) for row, word in
            zip(each, ["open", "position", "position", "unknown", "position"], strict=True)]  # fmt: skip
    survey = read(tmp_path, witsml("S1", stations="".join([*good[:2], wrong, *good[2:]])))
    is_the_survey(survey, FOOT)
    (warning,) = doubts.find(survey)
    assert (warning.code, warning.key) == ("rejected_stations", "survey.dat")
    assert warning.text == "stations that the file marks as rejected are left out: 1 (3)"


# --- stations --------------------------------------------------------------------------------------


def test_exact_repeats_are_dropped(tmp_path: Path) -> None:
    survey = read(tmp_path, text(HEADERS, rows=["0,0,0", "0,0,0", "10,1,2", "10,1,2", "10,1,2", "20,1,2"]))
    assert survey.stations[:, 0].tolist() == [0, 10, 20]
    assert survey.rows(1, 2) == "survey.dat, rows 4 to 7"


@given(
    steps=st.lists(st.floats(1e-3, 100), min_size=1, max_size=20),
    repeats=st.lists(st.integers(1, 3), min_size=21, max_size=21),
)
def test_repeats_never_change_what_remains(steps: list[float], repeats: list[int]) -> None:
    md = np.concatenate([[0.0], np.cumsum(steps)])
    stations = np.column_stack([md, np.minimum(md, 180), -md % 360])
    repeated = np.repeat(stations, repeats[: len(md)], axis=0)
    assert np.array_equal(check(written(repeated)).stations, to_radians(stations))


def test_the_bounds_themselves_are_accepted(tmp_path: Path) -> None:
    stations = read(tmp_path, text(HEADERS, rows=["0,0,-720", "10,180,720", "50000,0,720"])).stations
    assert stations[1:, 0].tolist() == [10, 50_000]
    assert stations[1, 1] == pytest.approx(math.pi, rel=1e-15)


def test_a_row_within_a_nanometre_of_the_one_before_is_the_same_station() -> None:
    def kept(md: float) -> int:
        return len(check(written([[0, 0, 0], [md, 0, 0], [10, 0, 0]])).stations)

    assert (kept(1e-9), kept(1.2e-9)) == (2, 3)


def test_a_vertical_station_is_added_at_0() -> None:
    survey = check(written([[100, 5, 40], [200, 6, 50]]))
    assert survey.tied_in
    assert survey.stations.tolist() == to_radians(np.array([[0, 0, 40], [100, 5, 40], [200, 6, 50]])).tolist()
    assert not check(written([[1e-10, 5, 40], [200, 6, 50]])).tied_in


# --- real files ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "count", "last"),
    [
        ("surveys/iscwsa_reference_well.csv", 100, (2940, 90, 180)),
        ("surveys/nlog_K05-ENC-05-S1.csv", 568, (8161, 77.58, 359.63)),
        ("surveys/wellpathpy_well9_horizontal_reference.csv", 121, (7922 * 0.3048, 90.25, 212.16)),
        ("volve-15-9-F-4/survey.csv", 87, (3510, 54.67, 202.72)),
    ],
)
def test_real_surveys(name: str, count: int, last: tuple[float, float, float]) -> None:
    """Counts and last stations are read off the files; none of them has a warning."""
    if not (DATA / name).is_file():
        pytest.skip(f"{DATA / name} is missing: public well surveys, folder from FCTD_DATA, see docs/claims.md")
    survey = read_survey(DATA / name)
    assert len(survey.stations) == count
    md, inclination, azimuth = survey.stations[-1]
    assert (md, np.degrees(inclination), np.degrees(azimuth) % 360) == pytest.approx(last, rel=1e-12)
    assert doubts.find(survey) == ()


# --- the guide -------------------------------------------------------------------------------------

GUIDE = (Path(__file__).parents[2] / "docs" / "well.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("example", re.findall(r"^```csv\n(.*?)^```", GUIDE, re.DOTALL | re.MULTILINE))
def test_the_examples_of_the_guide(example: str, tmp_path: Path) -> None:
    assert read(tmp_path, example).stations[1] == pytest.approx([500, math.radians(12.5), math.pi / 4], rel=1e-3)


def test_every_warning_has_its_line_in_the_guide() -> None:
    folder = Path(doubts.__file__).parent
    sources = "".join((folder / name).read_text() for name in ("doubts.py", "rounding.py"))
    codes = re.findall(r'InputWarning\(\s*f?"([a-z_]+)', sources)
    assert len(codes) == 12
    assert [code for code in codes if f"\n| `{code}" not in GUIDE] == []
