"""Survey files: sound ones of many kinds, and what exporters, spreadsheets and editors make of them."""

import io
import math
import zipfile
from random import Random
from xml.sax.saxutils import escape

from tests.fuzz.items import Item
from tests.fuzz.mutants import changed_bytes
from tests.strategies import toml
from validation.parts.random_paths import path

NAME = "survey.csv"
CASE = """name = "survey"
[wellbore]
survey = "survey.csv"
{columns}
survey_method = "{method}"
geometry = "{geometry}"
[[wellbore.intervals]]
to_md = "{to_md}"
diameter = "12.25 in"
friction = 0.2
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segment_length = "30 m"
{operation}
"""
OPERATION = """[[operations]]
kind = "rotate_off_bottom"
at_md = "400 m"
duration = "1 min"
rpm = 60
"""
FOOT, DEGREE = 1 / 0.3048, math.radians(1)
# Header, which value of a station stands below it, and what that is multiplied by.
Column = tuple[str, int, float]
LAYOUTS: list[list[Column]] = [
    [("md_m", 0, 1), ("inc_deg", 1, 1), ("azi_deg", 2, 1)],
    [("AZI_RAD", 2, DEGREE), ("Md_Ft", 0, FOOT), ("inc_rad", 1, DEGREE)],
    [("Measured Depth ( ft )", 0, FOOT), ("Inclination ( deg )", 1, 1), ("Azimuth Grid ( deg )", 2, 1)],
    [("depth (m)", 0, 1), ("TVD", 0, 0.9), ("inc (rad)", 1, DEGREE), ("azi_deg", 2, 1)],
    [("No", 0, 0), ("MD [feet]", 0, FOOT), ("Incl [°]", 1, 1), ("Azim GN [°]", 2, 1)],
    [("DEPT.M", 0, 1), ("DEVI", 1, 1), ("HAZI", 2, 1)],
]
ODD_HEADERS = [
    "md",
    "inc",
    "azi_grad",
    "md_km",
    "",
    "MD_M",
    "depth ( )",
    "[/x]",
    "\x1b",
    "é",
    "m" * 9000,
    '"',
    "inc_deg\n",
    "Azimuth",
    "MD (km)",
    "Depth",
]
ODD_CELLS = [
    *("nan", "NaN", "inf", "-inf", "1e999", "-999.25", "-999", "9999", "", " ", "x", "-", "1,5", "1e", "0x10", "1_0"),
    *(
        "5 m",
        "'1'",
        '"',
        '""1""',
        "１",
        "١",
        "1\x00",
        "1e300",
        "-1e300",
        "1e-300",
        "180",
        "180.0001",
        "200",
        "361",
        "-720",
    ),
    *("1d3", "true", "=A1", "[/x]", "\x1b[2J", "#N/A", "9" * 400, "1" + "0" * 140_000, "1e9", "60000"),
]


def survey(rng: Random) -> Item:
    """A case that reads a survey; two in five surveys are sound."""
    layout = rng.choice(LAYOUTS)
    sound = rng.random() < 0.4
    digits = rng.choice([1, 2, 6, 12])
    # Most are short, as the time goes into the checks; a few are those of a tool that logs every few centimetres.
    repeats = rng.choice([20, 400]) if rng.random() < 0.01 else 1
    rows = path(rng, spacing=rng.choice([5, 10, 30, 90]) / repeats, deepest=1500)
    table = [[header for header, _, _ in layout]]
    table += [[f"{row[k] * scale:.{digits}f}" for _, k, scale in layout] for row in rows]
    if not sound:
        for _ in range(rng.choice([1, 1, 2, 4])):
            _spoil(rng, table)
    content = rng.choice([_text, _text, _text, _text, _workbook, _witsml])(rng, table, sound)
    if not sound and rng.random() < 0.3:
        content = changed_bytes(rng, content)
    return Item(_case(rng, layout, sound).encode(), {NAME: content})


def _text(rng: Random, table: list[list[str]], sound: bool) -> bytes:
    """The table as an exporter, a spreadsheet or an editor writes it."""
    separator = rng.choice([*[","] * 6, ";", "\t", "|"] if sound else [*[","] * 9, ";", "\t", "|", " ", ", ", ",,"])
    quote = rng.choice(["{}", "{}", '"{}"', " {} "])
    end = rng.choice(["\n", "\n", "\r\n", "\r", "\n\n"])
    rows = [separator.join(map(quote.format, row)) for row in table]
    if separator in ";\t" and rng.random() < 0.5:
        rows[1:] = [row.replace(".", ",") for row in rows[1:]]
    if rng.random() < 0.2:
        rows[:0] = ["Well A-1", "# survey, final"]
    encoding = rng.choice([*["utf-8"] * 5, "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
    return end.join(rows).encode(encoding, errors="replace")


def _workbook(rng: Random, table: list[list[str]], sound: bool) -> bytes:
    """The table as sheets of a workbook; changed bytes reach the cells, as the parts are stored as they are."""
    import xlsxwriter

    content, stored = io.BytesIO(), io.BytesIO()
    with xlsxwriter.Workbook(content, {"in_memory": True, "strings_to_numbers": rng.random() < 0.8}) as book:
        for _ in range(1 if sound else rng.choice([1, 1, 2])):
            sheet = book.add_worksheet()
            for number, row in enumerate(table[:500]):
                sheet.write_row(number + 2, 1, [cell[:30_000].lstrip("=") for cell in row[:50]])
    with zipfile.ZipFile(content) as parts, zipfile.ZipFile(stored, "w") as out:
        for name in parts.namelist():
            out.writestr(name, parts.read(name))
    return stored.getvalue()


def _witsml(rng: Random, table: list[list[str]], sound: bool) -> bytes:
    """The cells of the table as a trajectory, by chance in a case that has columns for a text."""
    tags = ["md", "incl", "azi", "tvd", "dls"]
    units = [rng.choice(["m", "ft"]), *rng.choice([["dega", "dega"], ["rad", "rad"]]), "m", "dega/m"]
    stations = [
        "".join(
            f'<{tag} uom="{unit}">{escape(cell)}</{tag}>' for tag, unit, cell in zip(tags, units, row, strict=False)
        )
        for row in table[1:]
    ]
    each = "".join(f"<trajectoryStation>{station}</trajectoryStation>" for station in stations)
    names = "" if sound else rng.choice(["", "", "<!DOCTYPE x>", "<trajectory><trajectoryStation/></trajectory>"])
    text = (
        '<?xml version="1.0"?>\n<trajectorys xmlns="http://www.witsml.org/schemas/1series">'
        f"{names}<trajectory>{each}</trajectory></trajectorys>"
    )
    return text.encode()


def _spoil(rng: Random, table: list[list[str]]) -> None:
    """Change cells, rows or headers, the table being [headers, *rows]."""
    if not table:
        return
    k, how = rng.randrange(len(table)), rng.randrange(10)
    if how == 0:
        del table[k : rng.choice([k + 1, len(table)])]
    elif how == 1:
        table.insert(rng.randrange(len(table) + 1), list(table[k]))
    elif how == 2:
        table.insert(
            rng.randrange(len(table) + 1), rng.choice([[], [""], ["# a remark"], ["", "", ""], ["m", "deg", "deg"]])
        )
    elif how == 3:
        other = rng.randrange(len(table))
        table[k], table[other] = table[other], table[k]
    elif how == 4:
        table[k] = table[k][: rng.randrange(len(table[k]) + 1)]
    elif how == 5:
        table[k] = table[k] + ["0"] * rng.choice([1, 3, 20_000])
    elif how == 6 and table[0]:
        table[0][rng.randrange(len(table[0]))] = rng.choice(ODD_HEADERS)
    elif table[k]:
        # One bad cell, or a whole column of them.
        place, cell = rng.randrange(len(table[k])), rng.choice(ODD_CELLS)
        for row in table[1:] if how == 7 else [table[k]]:
            row[place : place + 1] = [cell]


def _case(rng: Random, layout: list[Column], sound: bool) -> str:
    """The case that reads it, with columns where the headers are not the usual ones, or wrong ones."""
    keys = {k: header for header, k, _ in layout if header not in ("TVD", "No")}
    columns = {name: keys[k] for k, name in enumerate(("md", "inc", "azi"))}
    usual = "TVD" not in [header for header, _, _ in layout] or rng.random() < 0.5
    if not sound and rng.random() < 0.2:
        columns[rng.choice(["md", "inc", "azi"])] = rng.choice([*ODD_HEADERS, *columns.values()])
        usual = False
    geometry = rng.choice(["arcs", "cylinders"])
    method = "minimum_curvature" if geometry == "arcs" else rng.choice(["minimum_curvature", "average_angle"])
    return CASE.format(
        columns="" if usual else f"columns = {toml(columns)}",
        method=method,
        geometry=geometry,
        to_md=rng.choice(["40 km", "1 km"]),
        operation=rng.choice(["", OPERATION]),
    )
