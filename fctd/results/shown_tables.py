"""Tables as people read them: cells of text with their numbers, which screen, notebook and files draw as they are."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.case.text import printable
from fctd.results.case_facts import Row
from fctd.results.unit_systems import System, in_field_units
from fctd.results.workbook import Heading, heading_of

if TYPE_CHECKING:
    import pandas as pd

NONE: Final = "–"  # of a cell without a value
# Columns of words of the program, and of its sentences; other texts are the user's.
_WORDS: Final = ("margin", "limit", "status", "buckling", "notes", "shape")
_SENTENCES: Final = ("reason", "friction_label")


class Cell(NamedTuple):
    """A cell of a table: its text, and the number that it shows, None of other texts.

    The number is in the unit of the text; files that hold numbers show it with the digits of the text.
    """

    text: str
    number: float | None = None


@dataclass(frozen=True)
class Table:
    """A table: its title, the heads of its columns (none of a table of facts), rows of cells, and lines below it."""

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()

    @cached_property
    def numeric(self) -> tuple[bool, ...]:
        """Whether each column has numbers alone, and stands to the right."""
        columns = list(zip(*self.rows, strict=True)) or [()] * len(self.heads)
        return tuple(
            any(cell.number is not None for cell in column)
            and all(cell.number is not None or cell.text in (NONE, "") for cell in column)
            for column in columns
        )


def text(value: object) -> Cell:
    """A text of the case or of the program, on one line and without characters that do not print."""
    return Cell(printable(str(value)))


def number(value: float, digits: int) -> Cell:
    """A number with digits after the point; a dash for one that is not finite."""
    return Cell(f"{value:z.{digits}f}", float(value)) if math.isfinite(value) else Cell(NONE)


def short(value: float, digits: int = 4) -> Cell:
    """A number with so many digits in all."""
    if not math.isfinite(value):
        return Cell(NONE)
    return number(value, 0) if abs(value) >= 10**digits else Cell(f"{value:z.{digits}g}", float(value))


def facts(title: str, rows: Iterable[Row]) -> Table:
    """A table of facts, one a row, whose values are numbers where they can be read as such."""
    return Table(
        title, (), tuple((text(what), _read(value), text(more.replace("^3", "³"))) for what, value, more in rows)
    )


def _read(value: str) -> Cell:
    try:
        found = float(value)
    except ValueError:
        return text(value)
    return Cell(value, found) if math.isfinite(found) else text(value)


def frame_table(
    title: str, frame: pd.DataFrame, columns: Sequence[str], units: System, words: Mapping[str, str] | None = None,
    notes: Sequence[str] = (),
) -> Table:  # fmt: skip
    """Columns of an SI table, with heads and digits as a workbook has them; those without any value are left out.

    words : heads of columns in place of those of their names.
    """
    kept = frame[[name for name in columns if name in frame and (frame[name].notna() & (frame[name] != "none")).any()]]
    shown = in_field_units(kept) if units == "field" else kept
    heads, cells = [], []
    for k, name in enumerate(map(str, kept)):
        heading = heading_of(str(shown.columns[k]))
        heads.append(_named(heading.text, (words or {}).get(name, "")))
        cells.append([_cell(name, value, heading, units) for value in shown.iloc[:, k]])
    return Table(title, tuple(heads), tuple(zip(*cells, strict=True)), tuple(map(printable, notes)))


def _named(heading: str, word: str) -> str:
    """A heading with another word, and its unit."""
    if not word:
        return heading
    return f"{word} {heading[heading.rindex('(') :]}" if heading.endswith(")") else word


def _cell(column: str, value: Any, heading: Heading, units: System) -> Cell:
    if not isinstance(value, str):
        return number(float(value) * heading.factor, len(heading.format.partition(".")[2]))
    if column == "operation":
        return Cell(KINDS[value].label)
    if column in _WORDS:
        return Cell(NONE if value == "none" else value.replace("_", " "))
    if column in _SENTENCES:
        return Cell(NONE) if value == "none" else text(told(value, units))
    return Cell(NONE) if column == "part" and value == "none" else text(value)
