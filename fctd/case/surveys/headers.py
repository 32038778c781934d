"""The columns of a survey: which header names which quantity, and in which unit.

A header names a quantity by the words of the field, in any case and order, with a unit in brackets, after an
underscore, after a blank or in the row below: "md_m", "Measured Depth (ft)", "Azimuth Grid [°]", "DEPT.M".  The M of
"M.Depth", "M Depth" and "Depth M" may be that of "measured": it is no unit.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, get_args

from fctd.case.errors import InputError, show
from fctd.case.surveys.stations import UNITS, StationKey

Row = tuple[int, list[str]]
"""Number of a row in its file, and its cells."""

KEYS: Final[tuple[StationKey, ...]] = get_args(StationKey)
TITLES: Final = 100  # rows that may stand above the headers
COMMENT: Final = "#"
_REFERRED: Final = re.compile("(m|ft)(?:md|rkb|kb|rt|brt)")
_MEASURED: Final = re.compile(r"^\W*m[\W_]*(?=dep)", re.IGNORECASE)
_DEPTH_MEASURED: Final = re.compile(r"(?:(?<=(?i:depth))|(?<=(?i:dept)))[\s,;:-]+M(?![^\W_])(?!\s*[)\]])")
_BY: Final = "in"  # "Depth in feet": no inch beside another unit
_LONGEST: Final = 60  # characters of a header
_LETTER: Final = re.compile(r"[^\W\d_]")

# A header names a quantity if all its words are names or additions of that quantity and one of them is a name.
_NAMES: Final[dict[StationKey, frozenset[str]]] = {
    "md": frozenset({"md", "depth", "dept", "measureddepth", "ahd", "dmea", "mdrkb", "mdkb", "mdrt", "mdbrt"}),
    "inc": frozenset({"inc", "incl", "inclin", "inclination", "devi", "dev", "deviation", "drift"}),
    "azi": frozenset({"az", "azi", "azim", "azm", "azmth", "azimuth", "hazi", "direction"}),
}
# A letter names an angle where its unit stands beside it ("I_deg") and no other header names the quantity.
_LETTERS: Final[dict[StationKey, str]] = {"inc": "i", "azi": "a"}
_HOLE: Final = frozenset({"angle", "hole", "well", "wellbore", "borehole", "survey"})
_NORTH: Final = frozenset({"grid", "true", "magnetic", "mag", "north", "gn", "tn", "mn", "corrected"})
_REFERENCE: Final = frozenset({"rkb", "kb", "rt", "rte", "brt"})
_ADDITIONS: Final[dict[StationKey, frozenset[str]]] = {
    "md": frozenset({"measured", "meas", "along", "hole", "survey", "station", "from", "below"}) | _REFERENCE,
    "inc": _HOLE,
    "azi": _HOLE | _NORTH,
}
# "Depth" alone may be the vertical depth where another column says that it is the measured one.
_PLAIN_DEPTH: Final = frozenset({"depth", "dept", "dmea", "hole", "survey", "station"}) | _REFERENCE

_WORDS_OF: Final[dict[str, tuple[str, ...]]] = {
    "m": ("m", "meter", "meters", "metre", "metres", "mtr"),
    "ft": ("ft", "foot", "feet"),
    "usft": ("usft", "ftus"),
    "deg": ("deg", "degs", "dega", "degree", "degrees"),
    "rad": ("rad", "radian", "radians"),
}
# These are no units of a survey: they are known so that a message can say so.
_OTHERS: Final = ("km", "cm", "mm", "in", "inch", "inches", "yd", "gon", "gons", "grad", "grads", "gradians")
_UNIT_WORDS: Final = {word: unit for unit, words in _WORDS_OF.items() for word in words} | {w: w for w in _OTHERS}


class NoUnitError(InputError):
    """A survey that does not say in which unit its depths are."""


@dataclass(frozen=True)
class Wanted:
    """What the case says about a column: its header and its unit, each may be absent."""

    header: str | None = None
    unit: str | None = None


@dataclass(frozen=True)
class Column:
    """A column of a survey: its index among the cells, its header and the unit that the header names."""

    place: int
    header: str
    unit: str | None


def unit_of(text: str) -> str | None:
    """The unit that a text names, such as "ft" for "Feet", "( ft )" or "ftRKB"; None for another text."""
    words = _words(text)
    units = [unit for unit in map(_as_unit, words) if unit is not None]
    return units[0] if len(units) == 1 and all(_as_unit(word) or word in _ADDITIONS["md"] for word in words) else None


def find_header(rows: Sequence[Row], columns: Mapping[StationKey, Wanted]) -> tuple[int, int]:
    """Index of the row of headers among the first rows, and how many of the three quantities it names.

    A comment may hold the headers where no other row does.
    """
    best, top = (-1, True), 0
    for index, (_, cells) in enumerate(rows[:TITLES]):
        rank = _score(_uncommented(cells), columns), not is_comment(cells)
        if rank > best:
            best, top = rank, index
        if best == (len(KEYS), True):
            break
    return top, best[0]


def find_columns(row: Row, columns: Mapping[StationKey, Wanted]) -> list[Column]:
    """The columns of measured depth, inclination and azimuth in a row of headers; InputError if one is not there."""
    number, cells = row
    cells = _uncommented(cells)
    return [_find(key, number, cells, columns.get(key, Wanted())) for key in KEYS]


def units(row: Row, found: Sequence[Column], below: Sequence[Row], columns: Mapping[StationKey, Wanted]) -> list[str]:
    """The unit of each column: the one that the case says, else that of the header, else of the rows below it.

    Angles without a unit are in degrees.  Raises `NoUnitError` for a depth without one, InputError for other units.
    """
    return [
        _unit(key, row, column, below, columns.get(key, Wanted()).unit) for key, column in zip(KEYS, found, strict=True)
    ]


def find_units(rows: Sequence[Row], found: Sequence[Column]) -> list[Row]:
    """The rows of units between the headers and the first station, one as a rule; they may look like comments.

    Where the stations are numbered, the first cell of this row often is "#".
    """
    stated: list[Row] = []
    for number, cells in rows[:TITLES]:
        row = number, _uncommented(cells)
        if _is_units(row, found):
            stated.append(row)
        elif not is_comment(cells) and any(cell_of(row, column) for column in found):
            break
    return stated


def unit_in_titles(rows: Sequence[Row]) -> Row | None:
    """The first of the rows above the headers that speaks of feet or metres, of the depths or of something else."""
    for number, cells in rows:
        text = " ".join(filter(None, cells))
        if any(len(word) > 1 and _as_unit(word) in UNITS["md"] for word in _words(text)):
            return number, [text]
    return None


def _is_units(row: Row, found: Sequence[Column]) -> bool:
    """Whether of the three cells one or more is a unit and none is a number; "M" alone may be the end of "Depth M"."""
    cells = [cell_of(row, column) for column in found]
    if {cell for cell in cells if cell} == {"M"}:
        return False
    return any(map(unit_of, cells)) and not any(re.search(r"\d", cell) for cell in cells)


def is_comment(cells: Sequence[str]) -> bool:
    """Whether a row is a comment."""
    return bool(cells) and cells[0].startswith(COMMENT)


def cell_of(row: Row, column: Column) -> str:
    """The text of a row in a column, "" where the row is shorter."""
    return row[1][column.place] if column.place < len(row[1]) else ""


def _uncommented(cells: list[str]) -> list[str]:
    if not is_comment(cells):
        return cells
    first, *others = cells
    return [first.lstrip(COMMENT).strip(), *others]


def _words(text: str) -> list[str]:
    """Lower-case words of a header; the dots of "M.D." are dropped, and a degree sign is a word."""
    text = _DEPTH_MEASURED.sub(" measured", _MEASURED.sub("measured ", text))
    text = re.sub(r"\b([a-z])\.([a-z])\b", r"\1\2", text.casefold())
    return re.findall(r"[^\W_]+", re.sub("[°º˚]", " deg ", text))


def _as_unit(word: str) -> str | None:
    """The unit of a word; "mMD" and "ftRKB" are units with the reference of the depth."""
    referred = _REFERRED.fullmatch(word)
    return _UNIT_WORDS.get(referred[1] if referred else word)


def _named_unit(header: str) -> str | None:
    """The unit in a header, or several; a header that is nothing but "M" is a name."""
    found = [_as_unit(word) for word in _words(header)]
    units = list(dict.fromkeys(unit for unit in found if unit is not None))
    if len(units) > 1 and _BY in units:
        units.remove(_BY)
    return " and ".join(units) if units and (None in found or re.search(r"[(\[]", header)) else None


def _normal(header: str) -> str:
    return " ".join(header.casefold().split())


def _candidates(key: StationKey, cells: Sequence[str], wanted: Wanted) -> list[Column]:
    """The columns that may be meant."""
    if wanted.header is not None:
        places = [k for k, cell in enumerate(cells) if _normal(cell) == _normal(wanted.header)]
        return [Column(k, cells[k], _named_unit(cells[k])) for k in places]
    found, explicit, letters = [], [], []
    for place, cell in enumerate(cells):
        if len(cell) > _LONGEST or not _LETTER.search(cell):  # a sentence, or a number
            continue
        words = {word for word in _words(cell) if _as_unit(word) is None}
        if words & _NAMES[key] and words <= _NAMES[key] | _ADDITIONS[key]:
            column = Column(place, cell, _named_unit(cell))
            found.append(column)
            if key == "md" and not words <= _PLAIN_DEPTH:
                explicit.append(column)
        elif words == {_LETTERS.get(key)} and _named_unit(cell) in UNITS[key]:
            letters.append(Column(place, cell, _named_unit(cell)))
    fitting = [column for column in explicit or found if column.unit is None or column.unit in UNITS[key]]
    return fitting or explicit or found or letters


def _score(cells: Sequence[str], columns: Mapping[StationKey, Wanted]) -> int:
    return sum(bool(_candidates(key, cells, columns.get(key, Wanted()))) for key in KEYS)


def _find(key: StationKey, number: int, cells: Sequence[str], wanted: Wanted) -> Column:
    found = _candidates(key, cells, wanted)
    if len(found) == 1:
        return found[0]
    others = ", ".join(map(show, cells))
    if found and wanted.header is None:
        names = " or ".join(f"{{header = {show(column.header)}}}" for column in found)
        raise InputError(
            f"one column of this quantity, or a choice in the case: columns.{key} = {names} "
            f"(for init: --columns '{key}={found[0].header}')",
            key=f"row {number}, columns of {key}",
            value=[column.header for column in found],
        )
    if found:
        raise InputError(f"a header that occurs once among {others}", key=f"columns.{key}", value=wanted.header)
    if wanted.header is not None:
        raise InputError(f"one of the headers {others}", key=f"columns.{key}", value=wanted.header)
    examples = " or ".join(f"{key}_{unit}" for unit in list(UNITS[key])[:2])
    expected = f"it among the headers {others}, or another header named in columns (for init: --columns '{key}=HEADER')"
    raise InputError(expected, key=f"column {examples}")


def _unit(key: StationKey, row: Row, column: Column, below: Sequence[Row], said: str | None) -> str:
    """The unit of one column, checked."""
    if said is not None:
        return said
    accepted = accepted_units(key)
    place, text = f"row {row[0]}", column.header
    unit, by = column.unit, "the header"
    for other in below:
        cell = cell_of(other, column)
        if not cell:
            continue
        stated = unit_of(cell)
        if stated is None or (unit is not None and stated != unit):
            expected = f"a unit of {accepted}" if unit is None else f"{unit}, as {by} says"
            raise InputError(expected, key=f"row {other[0]}, {column.header}", value=cell)
        unit, by, place, text = stated, f"row {other[0]}", f"row {other[0]}, {column.header}", cell
    if unit is None and key != "md":
        return "deg"
    if unit is None:
        raise NoUnitError(
            f'a header with its unit, such as "{text} (m)", or the unit in the case: '
            f'columns = {{md = {{header = {show(text)}, unit = "m"}}}} (or "ft"; for init: --columns md.unit=m)',
            key=place,
            value=text,
        )
    if unit not in UNITS[key]:
        raise InputError(f"a unit of {accepted}", key=place, value=text)
    return unit


def accepted_units(key: StationKey) -> str:
    """The units of a quantity in words."""
    return " or ".join(list(UNITS[key])[:2])
