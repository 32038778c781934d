"""Tables as people read them: cells of text with their numbers, which screen, notebook and files draw as they are."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

from fctd.case import operations
from fctd.case.message import SENTENCES
from fctd.case.systems import KINDS, SHOWN_APART, Kind, ending, signed, told
from fctd.case.text import printable
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import System, digits_of, in_field_units, kind_of, shown

if TYPE_CHECKING:
    import pandas as pd

NONE: Final = "–"  # of a cell without a value
# Columns of words of the program; those of its sentences are SENTENCES, other texts are the user's.
_WORDS: Final = ("margin", "limit", "status", "buckling", "notes", "shape")
# Units at the end of a name, the longer ones first, and the digits after the point of the first kind with each.
_DIGITS: Final = {
    unit: number for kind in reversed(KINDS) for unit, number in zip(kind.units, kind.digits, strict=True)
}
_UNITS: Final = sorted(
    {*_DIGITS, *(kind.dimension.unit for kind in SHOWN_APART), "rad/s"}, key=lambda unit: (-len(unit), unit)
)


class Cell(NamedTuple):
    """A cell of a table: its text, and the number that it shows, None of other texts.

    The number is in the unit of the text; files that hold numbers show it with the digits of the text.
    """

    text: str
    number: float | None = None


# What, how much, and its unit or what else there is to say.
Fact: TypeAlias = tuple[str, Cell, str]


class Head(NamedTuple):
    """The head of a column: its words, the unit of its numbers, and whether it has numbers; None: as its cells tell."""

    words: str
    unit: str = ""
    numbers: bool | None = None

    def __str__(self) -> str:
        return f"{self.words} ({self.unit})" if self.unit else self.words


@dataclass(frozen=True)
class Table:
    """A table: its title, the heads of its columns (none of a table of facts), rows of cells, and lines below it.

    struck : rows that are struck through, on screens and pages.
    """

    title: str
    heads: tuple[Head | str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()
    struck: frozenset[int] = frozenset()

    @cached_property
    def numeric(self) -> tuple[bool, ...]:
        """Whether each column has numbers, and stands to the right: as its head says, else where it has them alone."""
        columns = list(zip(*self.rows, strict=True)) or [()] * len(self.heads)
        said = [head.numbers if isinstance(head, Head) else None for head in self.heads or [""] * len(columns)]
        return tuple(
            any(cell.number is not None for cell in column)
            and all(cell.number is not None or cell.text in (NONE, "") for cell in column)
            if numbers is None else numbers
            for numbers, column in zip(said, columns, strict=True)
        )  # fmt: skip


def text(value: object) -> Cell:
    """A text of the case or of the program, on one line and without characters that do not print."""
    return Cell(printable(str(value)))


def number(value: float, digits: int, none: str = NONE) -> Cell:
    """A number with digits after the point; none : of one that is not finite."""
    return Cell(f"{value:z.{digits}f}", float(value)) if math.isfinite(value) else Cell(none)


def short(value: float, digits: int = 4, none: str = NONE) -> Cell:
    """A number with so many digits in all; none : of one that is not finite."""
    if not math.isfinite(value) or abs(value) >= 10 ** (digits - 1):
        return number(value, 0, none)
    return Cell(f"{value:z.{digits}g}", float(value))


def quantity(kind: Kind, value: float | None, units: System) -> Cell:
    """A value [SI] with the digits of its kind, a dash for None."""
    return Cell(NONE) if value is None else number(value * kind.shown(units).factor, kind.digits_in(units))


def of_column(name: str, value: float, units: System, digits: int | None = None) -> Cell:
    """A value [SI] of a column of results; digits : after the point, default: those of the column."""
    return number(value * shown(name, units).factor, digits_of(name, units) if digits is None else digits)


def shown_table(
    heads: Iterable[Head | str], rows: Iterable[Iterable[object]], title: str = "", notes: tuple[str, ...] = (),
    struck: Iterable[int] = (),
) -> Table:  # fmt: skip
    """A table of cells and of what becomes cells of text, a dash for None."""
    made = ([cell if isinstance(cell, Cell) else text(NONE if cell is None else cell) for cell in row] for row in rows)
    return Table(title, tuple(heads), tuple(map(tuple, made)), notes, frozenset(struck))


def facts(title: str, rows: Iterable[tuple[object, ...]]) -> Table:
    """A table of facts, one a row: what, its value, and its unit or what else there is to say."""
    return shown_table((), rows, title)


def quantities(
    title: str, columns: Sequence[tuple[str, Kind | None]], rows: Iterable[Sequence[Any]], units: System,
    notes: tuple[str, ...] = (),
) -> Table:  # fmt: skip
    """A table of values [SI] and texts.

    columns : words of each, and the kind of its values, None of texts.  rows : values, None for a dash, or cells.
    """
    heads = (Head(words) if kind is None else Head(words, kind.label(units), True) for words, kind in columns)
    made = (
        (
            value if kind is None or isinstance(value, Cell) else quantity(kind, value, units)
            for value, (_, kind) in zip(row, columns, strict=True)
        )
        for row in rows
    )
    return shown_table(heads, made, title, notes)


class Heading(NamedTuple):
    """How people see a column: its head, the factor of its numbers, and their digits; None of plain numbers."""

    head: Head
    factor: float
    digits: int | None

    def cell(self, value: Any) -> Cell:
        """A value of the column; texts, counts and answers of yes or no are as they are, NaN is empty."""
        if isinstance(value, bool) or not isinstance(value, Real):
            return Cell(str(value))
        if isinstance(value, Integral) and not self.head.unit:
            return Cell(str(value), int(value))
        found = float(value) * self.factor
        return short(found, none="") if self.digits is None else number(found, self.digits, none="")


def heading_of(column: str) -> Heading:
    """The heading of a column of a table, in SI or in field units: ``hookload_N`` is "hook load (kN)", in kN."""
    unit = next((unit for unit in _UNITS if column.endswith(ending(unit))), "")
    stem, kind = column.removesuffix(ending(unit)) if unit else column, kind_of(column)
    known = COLUMNS.get(column) or next((of for of in COLUMNS.values() if unit and of.stem == stem), None)
    label = stem.replace("hookload", "hook_load").replace("_", " ") if known is None else known.label
    factor, digits = 1.0, _DIGITS.get(unit, 3 if unit else None)
    if kind is not None and unit == kind.dimension.unit:
        factor, unit, digits = kind.shown("si").factor, kind.unit("si"), kind.digits_in("si")
    digits = digits if known is None or known.digits is None else known.digits
    return Heading(Head(label, signed(unit).replace("deg", "°")), factor, digits)


def written_table(frame: pd.DataFrame) -> Table:
    """All of a table, in SI or in field units, as files for people have it: its codes and texts are as they are."""
    headings = [heading_of(str(name)) for name in frame.columns]
    cells = [map(heading.cell, frame.iloc[:, k]) for k, heading in enumerate(headings)]
    return Table("", tuple(heading.head for heading in headings), tuple(zip(*cells, strict=True)))


def frame_table(
    title: str, frame: pd.DataFrame, columns: Sequence[str], units: System, words: Mapping[str, str] | None = None,
    notes: Sequence[str] = (), most: int = 0,
) -> Table:  # fmt: skip
    """Columns of an SI table, with heads and digits as a workbook has them; those without any value are left out.

    words : heads of columns in place of those of their names.  most : rows of a longer table, half of them its first
    and half its last ones; 0 for all.
    """
    kept = frame[[name for name in columns if name in frame and (frame[name].notna() & (frame[name] != "none")).any()]]
    half = most // 2 if 0 < most < len(kept) else 0
    if half:
        kept = kept.iloc[[*range(half), *range(-half, 0)]]
    read = in_field_units(kept) if units == "field" else kept
    heads, cells = [], []
    for k, name in enumerate(map(str, kept)):
        heading = heading_of(str(read.columns[k]))
        heads.append(Head((words or {}).get(name) or heading.head.words, heading.head.unit))
        cells.append([_cell(name, value, heading, units) for value in read.iloc[:, k]])
    rows = list(zip(*cells, strict=True))
    if half:
        rows.insert(half, (Cell("…"),) * len(heads))
    return Table(title, tuple(heads), tuple(rows), tuple(map(printable, notes)))


def _cell(column: str, value: Any, heading: Heading, units: System) -> Cell:
    if not isinstance(value, str):
        cell = heading.cell(value)
        return cell if cell.text else Cell(NONE)
    if column == "operation":
        return Cell(operations.KINDS[value].label)
    if column in _WORDS:
        return Cell(NONE if value == "none" else value.replace("_", " "))
    if column in SENTENCES:
        return Cell(NONE) if value == "none" else text(told(value, units))
    return Cell(NONE) if column == "part" and value == "none" else text(value)
