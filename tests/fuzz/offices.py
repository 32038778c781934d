"""Survey files as offices write them, with the stations that are meant: each is read rightly, or refused.

Title rows, rows of units with any first cell, station numbers, two azimuths, merged headers, decimal commas,
separators of thousands, byte order marks, repeated headers and footers, as text, as columns of blanks and as workbooks.
"""

import io
import tempfile
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from random import Random

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import InputError
from fctd.case.surveys.stations import UNITS, to_radians
from fctd.case.systems import System
from fctd.model.new_case import read_survey

Table = list[list[str]]
FOOT = 0.3048
# Names of the depth without a unit, and the words of its units.
DEPTHS = [
    *("MD", "M.D.", "Measured Depth", "Meas. Depth", "Depth", "DEPT", "M.Depth", "M Depth", "M. Depth", "MDepth"),
    *("Depth M", "DEPTH M", "Depth MD", "M-Depth", "MD RKB", "Measured Depth from RKB", "Along Hole Depth", "m_depth"),
]
WORDS = {"m": ["m", "M", "metres", "Meters"], "ft": ["ft", "FT", "feet", "Feet", "ft."]}
INCLINATIONS = ["Inc", "Incl.", "Inclination", "Inclin", "DEVI", "Drift", "Deviation", "Hole Angle Inc"]
AZIMUTHS = ["Azi", "Azim", "Azimuth", "AZIMUTH", "Azi Grid", "Azim. Grid", "Azimuth (True)", "HAZI", "Direction"]
DEGREES = ["deg", "(deg)", "°", "[°]", "degrees", "DEG"]
NUMBERS = ["#", "No", "No.", "Sta.", "Station", "", "Stn", "Row"]
FIRST = ["#", "", "-", "No", "(ft)", "(m)", "1", "Unit", "Units:", "*", "# "]
TITLES = [
    *("Well: A-1", "Survey report, final", "Date: 12.05.2019", "Operator: X, field Y; block 7", "MD, Inc, Azi in rows"),
    *("RKB elevation: 25.3 m", "KB 82 ft above MSL", "# exported by a tool", "Magnetic declination;1,25;deg", "1"),
    *("Depth reference: drill floor", "Page 1 of 3", "Survey depths and angles", "All angles in degrees", "=" * 40),
]
FOOTERS = [
    *(
        "End of survey",
        "* interpolated station",
        "Projected to bit",
        "# printed 2019",
        "Page 3 of 3",
        "Total",
        "-" * 30,
    ),
]


@dataclass(frozen=True)
class Office:
    """A file: its content; stations (n, 3) that are meant [m, deg, deg], None where nobody can say.

    unit : of its depths; said : whether it stands anywhere in the file.
    """

    content: bytes
    stations: NDArray[np.float64] | None
    unit: str
    said: bool


def office(rng: Random) -> Office:
    """A file of a seed."""
    unit = rng.choice(["m", "ft"])
    digits, values = rng.choice([0, 1, 2, 2, 3]), _path(rng, unit)
    sure = True  # that somebody can say what is meant
    texts: Table = [[f"{value:.{digits}f}" for value in row] for row in values]
    meant = np.array(texts, dtype=float) * [UNITS["md"][unit], 1.0, 1.0]

    # The columns: header, cell of the row of units, cells below.
    where = rng.choice(["header", "header", "row", "row", "row", "both", "against", "title", "nowhere"])
    depth, word = rng.choice(DEPTHS), rng.choice(WORDS[unit])
    below = rng.choice(["{}", "({})", "[{}]", "{}RKB" if word in ("m", "ft") else "{}"]).format(word)
    if where in ("header", "both", "against"):
        depth = rng.choice([f"{depth} ({word})", f"{depth} [{word}]", f"{depth}_{word}", f"{depth} ( {word} )"])
    if where == "against":
        other = "ft" if unit == "m" else "m"
        below, sure = rng.choice([other, f"({other})"]), False
    has_row = where in ("row", "both", "against") or rng.random() < 0.2
    angle = rng.choice(DEGREES)
    inclination, azimuth = rng.choice(INCLINATIONS), rng.choice(AZIMUTHS)
    columns = [
        (depth, below if where in ("row", "both", "against") else "", [row[0] for row in texts]),
        (inclination, angle if has_row else "", [row[1] for row in texts]),
        (azimuth, angle if has_row else "", [row[2] for row in texts]),
    ]
    if rng.random() < 0.2:
        rng.shuffle(columns)
    more = rng.random()
    if more < 0.1:  # a second azimuth
        columns.append(("Azi True" if azimuth != "Azi True" else "Azi", angle, [f"{5 + k}" for k in range(len(texts))]))
        sure = False
    elif more < 0.15:  # the same depth in the other unit beside it, headers merged
        factor = 1 / FOOT if unit == "m" else FOOT
        columns.insert(1, ("", "ft" if unit == "m" else "m", [f"{factor * row[0]:.2f}" for row in values]))
    if rng.random() < 0.5:
        columns.append(("TVD", below if has_row else "", [f"{0.9 * row[0]:.{digits}f}" for row in values]))
    if rng.random() < 0.3:
        columns.append(("DLS", "deg/30m" if has_row else "", [f"{rng.uniform(0, 3):.{digits}f}" for _ in texts]))
    if rng.random() < 0.2:
        columns.append(("Comment", "", [rng.choice(["", "", "casing point", "gyro"]) for _ in texts]))
    if rng.random() < 0.4:
        columns.insert(0, (rng.choice(NUMBERS), rng.choice(FIRST), [str(k + 1) for k in range(len(texts))]))
    heads = [[head for head, _, _ in columns]]
    if rng.random() < 0.08:  # "Measured" stands above "Depth"
        heads = [[head.partition(" ")[0] for head in heads[0]], [head.partition(" ")[2] for head in heads[0]]]
    if has_row:
        heads.append([cell for _, cell, _ in columns])
    rows = [list(row) for row in zip(*(cells for _, _, cells in columns), strict=True)]

    kind = rng.choice(["text", "text", "text", "text", "blanks", "workbook"])
    separator = rng.choice([",", ",", ";", ";", "\t", "|"]) if kind == "text" else "  "
    style = _style(rng, separator)
    rows = [[_written(cell, style) for cell in row] for row in rows]
    page = rng.choice([0, 0, 0, 10])
    body: Table = []
    for k, row in enumerate(rows):
        if page and k and k % page == 0:
            body += [[f"Page {k // page + 1}"]] * (rng.random() < 0.3) + [list(head) for head in heads]
        if rng.random() < 0.01:
            body.append([rng.choice(["# casing", "", "#"])])
        body.append(row)
    titles = [[title] for title in rng.sample(TITLES, rng.choice([0, 0, 1, 3]))]
    if where == "title":
        titles.insert(0, [rng.choice(["All depths in {}", "Depths: {}", "Units: {}, degrees"]).format(WORDS[unit][-2])])
    if rng.random() < 0.1:
        titles.append(["", "Survey data", ""])
    footers = [[rng.choice(FOOTERS)]] if rng.random() < 0.15 else []
    table = titles + heads + body + footers
    # What a spreadsheet makes a number is one: the "1.030" of thousands is lost there, and nobody can tell.
    as_numbers = rng.random() < 0.7 and style.thousands != "."
    if kind == "workbook":
        content = _workbook(rng, table, as_numbers)
    else:
        content = _text(rng, table, separator, kind == "blanks")
    return Office(content, meant if sure else None, unit, where != "nowhere")


def amiss(file: Office, system: System, folder: Path) -> tuple[str, str]:
    """What became of a file, "read" or "refused", and what is wrong with that, "" where nothing is.

    system : units for which the case is made, in which a file without a unit is read with a note.
    """
    path = folder / "survey"
    path.write_bytes(file.content)
    try:
        found = read_survey(path, system)
    except InputError:
        return "refused", ""
    assumed = found.note.startswith("the file names no unit")
    if file.stations is None:
        return "read", "read, and nobody can say what is meant"
    if assumed and file.said:
        return "read", f"said to name no unit, and names {file.unit}"
    meant = file.stations
    if assumed:
        meant = meant * [UNITS["md"]["m" if system == "si" else "ft"] / UNITS["md"][file.unit], 1.0, 1.0]
    keep = [0, *(k for k, (one, two) in enumerate(pairwise(meant), start=1) if np.any(np.abs(two - one) > 1e-9))]
    expected = to_radians(meant[keep])
    got = found.stations[-len(expected) :]
    if len(found.stations) - len(expected) not in (0, 1) or not np.allclose(got, expected, rtol=1e-9, atol=1e-9):
        return "read", f"read as {got[-1].tolist()}, meant is {expected[-1].tolist()}"
    return "read", ""


def campaign(seed: int, indices: range) -> tuple[int, int, list[str]]:
    """Files read and refused, and what was wrong, by seed and index."""
    counts, offences = {"read": 0, "refused": 0}, []
    with tempfile.TemporaryDirectory(prefix="fctd-office-") as folder:
        for index in indices:
            rng = Random(f"office:{seed}:{index}")
            became, wrong = amiss(office(rng), rng.choice(["si", "field"]), Path(folder))
            counts[became] += 1
            if wrong:
                offences.append(f"{seed}:{index} {wrong}")
    return counts["read"], counts["refused"], offences


def _path(rng: Random, unit: str) -> list[list[float]]:
    """Stations in a unit and degrees, which begin at 0 or below, of a well of some kilometres or of 20 m."""
    step = rng.choice([9.7, 29.3, 94.1]) / (1.0 if unit == "m" else FOOT) if rng.random() < 0.95 else 1.03
    count, start = rng.randint(4, 45), rng.choice([0.0, 0.0, 0.0, 12.3 * step])
    azimuth, inclination = rng.uniform(0, 330), 0.0
    rows = []
    for k in range(count):
        inclination = min(inclination + rng.choice([0.0, 0.4, 1.7]), 89.0)
        azimuth += rng.uniform(0, 0.9)
        rows.append([start + step * k * rng.uniform(0.999, 1.001), inclination, azimuth % 360])
    return rows


@dataclass(frozen=True)
class _Style:
    point: str
    thousands: str


def _style(rng: Random, separator: str) -> _Style:
    """How numbers are written: decimal point or comma, thousands by nothing, commas, points, blanks or apostrophes."""
    point = rng.choice([".", ".", ","]) if separator != "  " else rng.choice([".", ".", ".", ","])
    others = [sign for sign in (",", ".", " ", "'", "\u00a0", "\u202f") if sign != point]
    return _Style(point, rng.choice(others) if rng.random() < 0.25 else "")


def _written(cell: str, style: _Style) -> str:
    try:
        float(cell)
    except ValueError:
        return cell
    whole, _, after = cell.partition(".")
    if style.thousands and len(whole) > 3:
        whole = f"{int(whole):,}".replace(",", style.thousands)
    return f"{whole}{style.point}{after}" if after else whole


def _text(rng: Random, table: Table, separator: str, blanks: bool) -> bytes:
    """A text whose cells are parted by a separator, which cells in quotes may hold, or are columns of a fixed width."""
    if blanks:
        wide = [max((len(row[k]) for row in table if len(row) > max(k, 1)), default=0) for k in range(12)]
        lines = ["  ".join(cell.rjust(wide[k]) for k, cell in enumerate(row)) for row in table]
    else:
        quoted, tail = rng.choice(["none", "all", "needed", "needed"]), separator * rng.choice([0, 0, 0, 1, 3])
        lines = []
        for row in table:
            cells = [
                f'"{cell}"' if quoted == "all" or (quoted == "needed" and separator in cell) else cell for cell in row
            ]
            lines.append(separator.join(cells) + tail)
    end = rng.choice(["\n", "\n", "\r\n", "\r"])
    encoding = rng.choice(["utf-8", "utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
    return end.join(lines).encode(encoding, errors="replace")


def _workbook(rng: Random, table: Table, as_numbers: bool) -> bytes:
    import xlsxwriter

    content = io.BytesIO()
    with xlsxwriter.Workbook(content, {"in_memory": True, "strings_to_numbers": as_numbers}) as book:
        sheet = book.add_worksheet()
        right = rng.choice([0, 0, 1])
        for number, row in enumerate(table):
            sheet.write_row(number, right, [cell if not cell.startswith("=") else f" {cell}" for cell in row])
    return content.getvalue()
