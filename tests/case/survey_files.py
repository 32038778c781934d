"""Survey files for the tests: texts, workbooks and WITSML, and those that are wrong with their messages."""

import io
from collections.abc import Sequence

HEADERS = "md_m,inc_deg,azi_deg"
ROWS = ["0,0,0", "500,0,90", "1000,30.5,90", "1500,45,91", "2000,60,92.25"]
TEXT = "\n".join([HEADERS, *ROWS])
DEPTH = [0, 500, 1000, 1500, 2000]
"""The measured depths of `ROWS`."""

STATION = (
    '<trajectoryStation uid="s{0}"><typeTrajStation>unknown</typeTrajStation><md uom="ft">{0}</md>'
    '<tvd uom="ft">9</tvd><incl uom="dega">{1}</incl><azi uom="dega">{2}</azi><dls uom="dega/30m">1</dls>'
    "</trajectoryStation>"
)


def text(headers: str, separator: str = ",", rows: Sequence[str] = ROWS) -> str:
    """The rows below other headers, with another separator."""
    return "\n".join([headers, *(row.replace(",", separator) for row in rows)]) + "\n"


def workbook(sheets: dict[str, list[list[object]]]) -> bytes:
    """A workbook of these cells, row by row."""
    import xlsxwriter

    content = io.BytesIO()
    book = xlsxwriter.Workbook(content, {"in_memory": True})
    for name, rows in sheets.items():
        sheet = book.add_worksheet(name)
        for number, row in enumerate(rows):
            sheet.write_row(number, 0, row)
    book.close()
    return content.getvalue()


def witsml(*names: str, version: str = "1.4.1.1", stations: str | None = None) -> str:
    """A WITSML document of a trajectory for each name."""
    schema = "1series" if version.startswith("1.4") else "131"
    if stations is None:
        stations = "".join(STATION.format(*row.split(",")) for row in ROWS)
    each = (
        f'<trajectory uidWell="w" uid="t{k}"><nameWell>A-1</nameWell><name>{name}</name>'
        f'<mdMx uom="ft">2000</mdMx>{stations}</trajectory>'
        for k, name in enumerate(names)
    )
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<trajectorys xmlns="http://www.witsml.org/schemas/{schema}" '
        f'version="{version}">{"".join(each)}</trajectorys>'
    )


SHEET: list[list[object]] = [
    ["Survey of A-1"],
    [],
    ["", "MD", "Inc.", "Azi."],
    ["", "ft", "°", "°"],
    *(["", *map(float, row.split(","))] for row in ROWS),
]

Keys = dict[str, object]
"""Keys of [wellbore] beside `survey`."""

# Name, keys of the case, the file, and the message below its name.
WRONG: list[tuple[str, Keys, str | bytes, str]] = [
    (
        "depth without a unit",
        {},
        text("DEPTH,DEVI,AZIM"),
        'row 1 = "DEPTH": expected a header with its unit, such as "DEPTH (m)", or the unit in the case: '
        'columns = {md = {header = "DEPTH", unit = "m"}} (or "ft"; for init: --columns md.unit=m)',
    ),
    ("depth in km", {}, text("Depth (km),Inc,Azi"), 'row 1 = "Depth (km)": expected a unit of m, ft or usft'),
    ("azimuth in gon", {}, text("MD_m,Inc,Azi [gon]"), 'row 1 = "Azi [gon]": expected a unit of deg or rad'),
    ("row of units in km", {}, text("MD,Inc,Azi\nkm,deg,deg"), 'row 2, MD = "km": expected a unit of m, ft or usft'),
    ("two units", {}, text("MD (m),Inc,Azi\nft,deg,deg"), 'row 2, MD (m) = "ft": expected m, as the header says'),
    (
        "two units, in a row that looks like a comment",
        {},
        text("No,MD (m),Inc,Azi\n#,(ft),(deg),(deg)", rows=[f"{k},{row}" for k, row in enumerate(ROWS)]),
        'row 2, MD (m) = "(ft)": expected m, as the header says',
    ),
    (
        "two rows of units",
        {},
        text("MD,Inc,Azi\nm,,\n# ft,deg,deg"),
        'row 3, MD = "ft": expected m, as row 2 says',
    ),
    ("two units in one header", {}, text("MD m (ft),Inc,Azi"), 'row 1 = "MD m (ft)": expected a unit of m, ft or usft'),
    (
        "a letter that may be that of a unit or of measured",
        {},
        text("Depth M,Inc,Azi"),
        'row 1 = "Depth M": expected a header with its unit, such as "Depth M (m)", or the unit in the case: '
        'columns = {md = {header = "Depth M", unit = "m"}} (or "ft"; for init: --columns md.unit=m)',
    ),
    (
        "an M below a depth, which may be that of measured",
        {},
        text("Depth,Inc,Azi\nM,,"),
        'row 1 = "Depth": expected a header with its unit, such as "Depth (m)", or the unit in the case: '
        'columns = {md = {header = "Depth", unit = "m"}} (or "ft"; for init: --columns md.unit=m)',
    ),
    (
        "a title that speaks of a unit",
        {},
        "All depths in feet\n" + text("MD,Inc,Azi"),
        'row 1, a title = "All depths in feet": expected a header with its unit, such as "MD (m)", or the unit in the '
        'case: columns = {md = {header = "MD", unit = "m"}} (or "ft"; for init: --columns md.unit=m)',
    ),
    (
        "decimal commas between commas",
        {},
        "MD (ft),Inc,Azi\n0,0,0\n500,0,9,5,45,1",
        'row 3 = "500, 0, 9, 5, 45, 1": expected at most 3 cells, as many as headers (the column separator cannot '
        "be a decimal comma)",
    ),
    (
        "commas and dots for decimals",
        {},
        "md_m;inc;azi\n0;0,5;0\n1.030;3,5;4",
        'row 3, md_m = "1.030": expected a number with a decimal comma, as in row 2',
    ),
    (
        "dots of thousands or of decimals",
        {},
        "md_m;inc;azi\n0;0;0\n1.030;3;4\n1.060;4;4",
        'row 3, md_m = "1.030": expected a number whose dot has one meaning: this is 1.03 or 1030',
    ),
    (
        "two columns of depth",
        {},
        text("md_m,inc,azi,md_ft"),
        'row 1, columns of md = ["md_m", "md_ft"]: expected one column of this quantity, or a choice in the case: '
        'columns.md = {header = "md_m"} or {header = "md_ft"} (for init: --columns \'md=md_m\')',
    ),
    (
        "two columns of azimuth",
        {},
        text("md_m,inc,Azi grid,Azi true"),
        'row 1, columns of azi = ["Azi grid", "Azi true"]: expected one column of this quantity, or a choice in the '
        'case: columns.azi = {header = "Azi grid"} or {header = "Azi true"} (for init: --columns \'azi=Azi grid\')',
    ),
    (
        "no column of azimuth",
        {},
        text("md_m,inc,TVD"),
        'column azi_deg is missing: expected it among the headers "md_m", "inc", "TVD", or its header in the case: '
        "columns.azi = {header = \"HEADER\"} (for init: --columns 'azi=HEADER')",
    ),
    (
        "another file",
        {},
        "date,torque_kN_m\n2007-10-22,7",
        "expected a row of headers such as md_m, inc_deg, azi_deg in the first 100 rows, or headers in other words in "
        "the case: columns.md = {header = \"HEADER\"} (for init: --columns 'md=HEADER')",
    ),
    (
        "headers in other words above numbers",
        {},
        text("Teufe (m);Neigung;Azimut", ";"),
        'row 1 = "Teufe (m), Neigung, Azimut": expected a row of headers such as md_m, inc_deg, azi_deg, or headers in '
        "other words in the case: columns.md = {header = \"Teufe (m)\"} (for init: --columns 'md=Teufe (m)')",
    ),
    (
        "rows in quotes",
        {},
        "\n".join(f'"{row}"' for row in text(HEADERS).splitlines()),
        f'row 1 = "{HEADERS}": expected cells apart: remove the quotes around the whole row',
    ),
    (
        "a bearing",
        {},
        f"{HEADERS}\n0,0,0\n10,1,N38.5E",
        'row 3, azi_deg = "N38.5E": expected a number of degrees with decimals',
    ),
    (
        "apostrophes between thousands",
        {},
        f"{HEADERS}\n0,0,0\n1'030.5,1,0",
        'row 3, md_m = "1\'030.5": expected a number without separators of thousands',
    ),
    (
        "prose",
        {},
        "# A well\n\nDepth and azimuth of this well\nare not listed here.\n",
        'column inc_deg is missing: expected it among the headers "Depth", "and", "azimuth", "of", "this", "well", or '
        "its header in the case: columns.inc = {header = \"HEADER\"} (for init: --columns 'inc=HEADER')",
    ),
    (
        "no headers",
        {},
        "\n".join(ROWS),
        'row 1 = "0, 0, 0": expected a row of headers above the numbers, such as md_m, inc_deg, azi_deg',
    ),
    (
        "a header that is not there",
        {"columns": {"md": "Depth"}},
        TEXT,
        'columns.md = "Depth": expected one of the headers "md_m", "inc_deg", "azi_deg"',
    ),
    (
        "a header that is there twice",
        {"columns": {"md": "D (m)"}},
        text("D (m),inc,azi,d (M)"),
        'columns.md = "D (m)": expected a header that occurs once among "D (m)", "inc", "azi", "d (M)"',
    ),
    (
        "a null value",
        {},
        f"{HEADERS}\n0,0,0\n10,-999.25,0",
        'row 3, inc_deg = "-999.25": expected an inclination from 0 to 180 deg',
    ),
    (
        "a null azimuth",
        {},
        f"{HEADERS}\n0,0,0\n10,1,-999.25",
        'row 3, azi_deg = "-999.25": expected an azimuth from -720 to 720 deg',
    ),
    ("no depth", {}, f"{HEADERS}\n0,0,0\n,1,2", 'row 3, md_m = "": expected a number'),
    ("a word", {}, f"{HEADERS}\n0,0,0\n10,1,north", 'row 3, azi_deg = "north": expected a number'),
    ("digits of another script", {}, f"{HEADERS}\n0,0,0\n１０,1,2", 'row 3, md_m = "１０": expected a number'),
    ("an infinite depth", {}, f"{HEADERS}\n0,0,0\ninf,1,2", 'row 3, md_m = "inf": expected a finite number'),
    (
        "a negative depth",
        {},
        f"{HEADERS}\n-5,0,0\n10,0,0",
        'row 2, md_m = "-5": expected a measured depth of at least 0',
    ),
    (
        "depths in centimetres",
        {},
        f"{HEADERS}\n0,0,0\n250000,0,0",
        'row 3, md_m = "250000": expected a measured depth of at most 50 km',
    ),
    (
        "degrees under radians",
        {},
        text("md_m,inc_rad,azi_rad"),
        'row 4, inc_rad = "30.5": expected an inclination from 0 to 3.142 rad',
    ),
    (
        "rows upside down",
        {},
        f"{HEADERS}\n0,0,0\n20,0,0\n10,0,0",
        'row 4, md_m = "10": expected a measured depth greater than that of the station before',
    ),
    ("one station", {}, f"{HEADERS}\n0,0,0", "expected at least two different stations, found 1"),
    ("an empty file", {}, "\n \n", "expected a row of headers and a row for each station, the file is empty"),
    (
        "thousands or decimals",
        {},
        "md_m;inc;azi\n0;0;0\n1,234;3;4",
        'row 3, md_m = "1,234": expected a number whose comma has one meaning: this is 1.234 or 1234',
    ),
    (
        "separators of thousands",
        {},
        'md_m,inc,azi\n0,0,0\n"1,234.5",3,4',
        'row 3, md_m = "1,234.5": expected a number without separators of thousands',
    ),
    (
        "an empty cell between blanks",
        {},
        text("MD(m) Inc Azi TVD", " "),
        'row 2 = "0 0 0": expected 4 columns, as many as headers (separate columns by commas or tabs where cells are '
        "empty)",
    ),
    ("a sheet of a text", {"sheet": "A"}, TEXT, 'sheet = "A": expected no sheet for a text in columns'),
    (
        "a picture",
        {},
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        "expected a survey: text in columns, an Excel workbook (xlsx) or a WITSML trajectory (XML)",
    ),
    (
        "an old workbook",
        {},
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(512),
        "expected a workbook in the format xlsx, or a text: save it as one of them",
    ),
    ("half a workbook", {}, b"PK\x03\x04\0\0", "expected a workbook (xlsx) that can be read (File is not a zip file)"),
    (
        "a web page",
        {},
        "<html><body>404</body></html>",
        'expected a WITSML trajectory with stations, found the element "html"',
    ),
    (
        "half a WITSML file",
        {},
        witsml("S1")[:300],
        "expected a WITSML trajectory in XML (unclosed token: line 2, column 259)",
    ),
    (
        "WITSML with a document type",
        {},
        witsml("S1").replace("<traj", '<!DOCTYPE a [<!ENTITY b "c">]><traj', 1),
        "expected a WITSML trajectory without a document type (DOCTYPE)",
    ),
    (
        "WITSML without stations",
        {},
        witsml("S1", stations=""),
        'expected a WITSML trajectory with stations, found the element "trajectorys"',
    ),
    (
        "WITSML in km",
        {},
        witsml("S1").replace('<md uom="ft">', '<md uom="km">'),
        'trajectoryStation 1, md, uom = "km": expected a unit of m, ft or usft',
    ),
    (
        "WITSML of two units",
        {},
        witsml("S1").replace('<incl uom="dega">30', '<incl uom="rad">30'),
        'trajectoryStation 3, incl, uom = "rad": expected deg, the unit of the stations before',
    ),
    (
        "WITSML with a word",
        {},
        witsml("S1").replace(">30.5<", ">steep<"),
        'trajectoryStation 3, incl = "steep": expected a number',
    ),
    (
        "WITSML without an azimuth",
        {},
        witsml("S1").replace('<azi uom="dega">91</azi>', ""),
        'trajectoryStation 4, azi = "": expected a number',
    ),
    (
        "two trajectories",
        {},
        witsml("S1", "S2"),
        'sheet is missing: expected the name of the trajectory in wellbore.sheet (for init: --sheet): "S1", "S2"',
    ),
    ("another trajectory", {"sheet": "S3"}, witsml("S1", "T9"), 'sheet = "S3": expected one of the names S1, T9'),
    (
        "columns of WITSML",
        {"columns": {"md": "md"}},
        witsml("S1"),
        'columns = {"md": "md"}: expected no columns, since WITSML names its elements',
    ),
]

WRONG_WORKBOOKS: list[tuple[str, Keys, dict[str, list[list[object]]], str]] = [
    (
        "two sheets",
        {},
        {"Plan": SHEET, "Survey": SHEET, "Notes": [["x"]]},
        "sheet is missing: expected the name of the sheet that holds the survey in wellbore.sheet (for init: --sheet): "
        '"Plan", "Survey"',
    ),
    (
        "another sheet",
        {"sheet": "Survy"},
        {"Plan": SHEET, "Survey": SHEET},
        'sheet = "Survy": expected the sheet Survey',
    ),
    ("a word", {}, {"A": [*SHEET, ["", "TD", 60, 90]]}, 'row 10, MD = "TD": expected a number'),
    ("an empty workbook", {}, {"A": []}, "expected a row of headers and a row for each station, the file is empty"),
]
