"""The row of headers of a table, its columns and their units."""

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

from fctd.case.errors import InputError, nearest, show
from fctd.case.systems import FLOW, FORCE, LENGTH, SPEED, SYSTEMS, TIME, TORQUE, System
from fctd.case.tables.fields import Column, Field
from fctd.case.units import Dimension

Line = tuple[int, list[str]]
"""Number of a line or row in its file, 0 where it has none, and its cells."""

TITLES: Final = 100  # rows that may stand above the headers
COMMENT: Final = "#"
_BRACKETS: Final = re.compile(r"\s*[\[(][^\])]*[\])]\s*$")


# Units of rigs, which sheets without units are in.
RIG_UNITS: Final[Mapping[System, Mapping[Dimension, str]]] = {
    system: {kind.dimension: kind.unit(system).replace("*", ".") for kind in (LENGTH, FORCE, TORQUE, SPEED, FLOW, TIME)}
    for system in SYSTEMS
}


_SHOWN: Final = 3  # examples in a message


class NoUnitError(InputError):
    """A table that does not say in which units some columns are."""


class Choice(NamedTuple):
    """What the user says of a column: its header and its unit, each may be absent."""

    header: str | None = None
    unit: str | None = None


Choices = Mapping[str, Choice]


@dataclass(frozen=True)
class TableForm:
    """The tables of one kind.

    fields : that it may have; example : headers for messages; row, most : what a row is, and how many there may be.
    needed : groups of fields, of each of which a table with these fields has one.  option : what stands before a key
    where the user chooses a column; remedy : how to choose a header for a key, or one of several, and a unit.  paste :
    the options that say key, header and unit of several columns; assumed : units of a table whose columns name none.
    """

    fields: tuple[Field, ...]
    example: str
    needed: Callable[[Collection[str]], Sequence[Sequence[str]]]
    row: str = "row"
    most: int | None = None
    option: str = ""
    remedy: Callable[[str, Sequence[str], str], str] = lambda key, headers, unit: ""
    assumed: Mapping[Dimension, str] | None = None
    paste: Callable[[Sequence[tuple[str, str, str]]], str] | None = None

    def lacking(self, found: Collection[str]) -> list[Sequence[str]]:
        """The groups of which a table with these fields has none."""
        return [group for group in self.needed(found) if not {*group} & {*found}]

    def field(self, key: str) -> Field:
        """The field of a key."""
        return next(field for field in self.fields if field.key == key)


def parse_choices(texts: Sequence[str], form: TableForm) -> dict[str, Choice]:
    """What options say of columns, "torque=TQX [kft.lbf]" or "md.unit=ft"; raises InputError for another form."""
    choices: dict[str, Choice] = {}
    for text in texts:
        left, _, right = (part.strip() for part in text.partition("="))
        key, dot, unit = left.partition(".")
        field = next((field for field in form.fields if field.key == key and not field.checking), None)
        if field is None or not right or (dot and (unit != "unit" or field.quantity is None)):
            keys = ", ".join(field.key for field in form.fields if not field.checking)
            raise InputError(f"KEY=HEADER or KEY.unit=UNIT, with one of the keys {keys}", key="--columns", value=text)
        if dot and field.unit_of(right) is None:
            raise InputError(field.accepted, key="--columns", value=text)
        before = choices.get(key, Choice())
        choices[key] = Choice(before.header, field.unit_of(right)) if dot else Choice(right, before.unit)
    return choices


def find_header(rows: Sequence[Line], form: TableForm, choices: Choices) -> tuple[int, set[str]]:
    """Index of the row of headers among the first rows, and the keys of the fields that it names.

    A comment may hold the headers where no other row does.
    """
    best, top, found = (-1, True), 0, set[str]()
    for index, (_, cells) in enumerate(rows[:TITLES]):
        texts = uncommented(cells)
        keys = {f.key for f in form.fields if _candidates(f, texts, choices.get(f.key, Choice()))}
        rank = len(keys), not is_comment(cells)
        if rank > best:
            best, top, found = rank, index, keys
        if best == (len(form.fields), True):
            break
    return top, found


def find_columns(row: Line, form: TableForm, choices: Choices) -> dict[str, Column]:
    """The columns that a row of headers names, by key; InputError where one is missing that the form needs."""
    cells, name = uncommented(row[1]), _name(row)
    if len(cells) == 1 and re.search("[,;\t]", cells[0]):
        raise InputError("cells apart: remove the quotes around the whole row", key=name, value=cells[0])
    found, others = {}, ", ".join(map(show, cells))
    all_candidates = {field: _candidates(field, cells, choices.get(field.key, Choice())) for field in form.fields}
    taken = {column.place for candidates in all_candidates.values() for column in candidates if not column.wrong}
    for field, candidates in all_candidates.items():
        choice = choices.get(field.key, Choice())
        candidates = [column for column in candidates if not (column.wrong and column.place in taken)]
        if choice.header is not None and len(candidates) != 1:
            near = nearest(show(choice.header), [*map(show, cells)], "header")
            expected = f"a header that occurs once among {others}" if candidates else near
            raise InputError(expected, key=f"{form.option}{field.key}", value=choice.header)
        if len(candidates) > 1 and not candidates[0].wrong and not field.checking:
            names = [column.header for column in candidates]
            expected = f"one column of this quantity{_or('a choice', form.remedy(field.key, names, ''))}"
            raise InputError(expected, key=f"{name}, columns of {field.key}", value=names)
        if candidates:
            found[field.key] = replace(candidates[0], row=name)
    lacking = [_lacking(group, form, others) for group in form.lacking(found)]
    if lacking:
        raise InputError(lacking[0].expected, key=lacking[0].key, more=lacking[1:])
    return found


def find_units(rows: Sequence[Line], columns: Collection[Column]) -> list[Line]:
    """The rows of units between the headers and the first row of data, one as a rule; they may look like comments.

    Where the rows are numbered, the first cell of this row often is "#".
    """
    stated: list[Line] = []
    for number, cells in rows[:TITLES]:
        texts = [cell.strip() for cell in uncommented(cells)]
        if _is_units(texts, columns):
            stated.append((number, texts))
        elif not is_comment(cells) and any(cell_of(texts, column) for column in columns):
            break
    return stated


def with_units(
    columns: Mapping[str, Column],
    stated: Sequence[Line],
    titles: Sequence[Line],
    form: TableForm,
    choices: Choices,
    first: Sequence[str] = (),
) -> dict[str, Column]:
    """The columns with their units: that which the user says, else that of the header, else of the rows of units.

    titles : the rows above the headers; first : the first row below them.  Raises `no_unit` where there is none and the
    field needs one, InputError for others than the field's.
    """
    units = {key: _unit(column, stated, form, choices.get(key, Choice()).unit) for key, column in columns.items()}
    needing = {key: column for key, column in columns.items() if column.field.quantity and column.field.bare is None}
    lacking = {key: column for key, column in needing.items() if units[key] is None}
    usual = form.assumed or {}
    named = [(column.field, unit) for key, column in needing.items() if (unit := units[key]) is not None]
    agree = all(of.dimension in usual and _same(of, unit, usual[of.dimension]) for of, unit in named)
    assumed = usual if agree else {}
    if not all(column.field.dimension in assumed for column in lacking.values()):
        # A time is a date or a number, which needs a unit too; beside a date it has none.
        found_out = [column for key, column in columns.items() if units[key] == "" and not column.field.checking]
        numbers = [column for column in found_out if len(found_out) == 1 and _is_number(cell_of(first, column))]
        raise no_unit([*numbers, *lacking.values()], form, titles)
    units |= {key: assumed[column.field.dimension] for key, column in lacking.items()}
    return {key: replace(column, unit=units[key], assumed=key in lacking) for key, column in columns.items()}


def no_unit(columns: Sequence[Column], form: TableForm, titles: Sequence[Line] = ()) -> InputError:
    """The error of columns without a unit: `NoUnitError`, unless a title speaks of units, which it then names."""
    column, field = columns[0], columns[0].field
    if len(columns) > 1:
        return _no_units(columns, form)
    example = show(f"{column.header} ({field.example})")
    expected = f"a header with its unit, such as {example}"
    expected += _or("the unit", form.remedy(field.key, [column.header], field.example))
    units = field.dimension.spellings if field.dimension.listed else {}
    for title in titles:
        text = " ".join(filter(None, title[1]))
        if any(len(word) > 1 and word in units for word in re.findall(r"[^\W_]+", text.casefold())):
            return InputError(expected, key=f"{_name(title)}, a title", value=text)
    return NoUnitError(expected, key=column.row, value=column.header)


def _no_units(columns: Sequence[Column], form: TableForm) -> NoUnitError:
    """The error of several columns, with all that is to be said of them at once."""
    usual = form.assumed or {}
    units = [usual.get(column.field.dimension, column.field.example) for column in columns[:_SHOWN]]
    examples = [show(f"{column.header} ({unit})") for column, unit in zip(columns, units, strict=False)]
    expected = f"headers with their units, such as {', '.join(examples)}"
    if form.paste is not None:
        rigs = [column for column in columns if column.field.dimension in RIG_UNITS["field"]]
        field, metric = ([RIG_UNITS[name][column.field.dimension] for column in rigs] for name in ("field", "si"))
        line = form.paste([(column.field.key, column.header, unit) for column, unit in zip(rigs, field, strict=True)])
        others = ", ".join(dict.fromkeys(unit for unit in metric if unit not in field))
        expected += f", or the units by {line} (on a metric rig {others} in place of these)"
    else:
        expected += _or("each unit", form.remedy(columns[0].field.key, [columns[0].header], columns[0].field.example))
    return NoUnitError(expected, key=columns[0].row, value=[column.header for column in columns])


def is_comment(cells: Sequence[str]) -> bool:
    """Whether a row is a comment."""
    return bool(cells) and cells[0].startswith(COMMENT)


def uncommented(cells: list[str]) -> list[str]:
    """The cells without the sign of a comment."""
    return [cells[0].lstrip(COMMENT).strip(), *cells[1:]] if is_comment(cells) else cells


def cell_of(cells: Sequence[str], column: Column) -> str:
    """The text of a row in a column, "" where the row is shorter."""
    return cells[column.place] if column.place < len(cells) else ""


def _is_number(cell: str) -> bool:
    """Whether a cell is a plain number."""
    return re.fullmatch(r"[+-]?[\d.,]*\d", cell) is not None


def _name(row: Line) -> str:
    """A row in messages."""
    return f"row {row[0]}" if row[0] else "headers"


def _lacking(group: Sequence[str], form: TableForm, headers: str) -> InputError:
    """The error of a table with none of the fields of a group."""
    fields = [form.field(key) for key in group[:3]]
    wanted = " or ".join("_".join(filter(None, (field.key, field.example))) for field in fields)
    remedy = _or("its header", form.remedy(group[0], ["HEADER"], ""))
    return InputError(f"it among the headers {headers}{remedy}", key=f"column {wanted}")


def _or(what: str, remedy: str) -> str:
    return f", or {what} {remedy}" if remedy else ""


def _same(field: Field, one: str, other: str) -> bool:
    """Whether two units are one, in two spellings."""
    return one == other or (not field.dimension.listed and field.dimension.factor(one) == field.dimension.factor(other))


def _unit(column: Column, stated: Sequence[Line], form: TableForm, said: str | None) -> str | None:
    """The unit of one column, checked; None for a text, and where there is none and the field needs one."""
    field = column.field
    if field.quantity is None:
        return None
    if said is not None:
        unit = field.unit_of(said)
        if unit is None:
            raise InputError(field.accepted, key=f"{form.option}{field.key}", value=said)
        return unit
    if column.wrong:
        raise InputError(field.accepted, key=column.row, value=column.header)
    unit, by = column.unit, "the header"
    for row in stated:
        cell = cell_of(row[1], column)
        below = field.unit_of(cell) if cell else None
        if below is None and (not cell or field.bare == ""):
            continue
        if below is None or (unit is not None and not _same(field, below, unit)):
            expected = field.accepted if unit is None else f"{unit}, as {by} says"
            raise InputError(expected, key=f"{_name(row)}, {column.header}", value=cell)
        unit, by = below, _name(row)
    return field.bare if unit is None else unit


def _is_units(row: Sequence[str], columns: Collection[Column]) -> bool:
    """Whether one cell or more is a unit and none is a number; "M" alone may be the end of "Depth M".

    Headers that come again hold units, too, and are none.
    """
    if all(cell_of(row, column) == column.header for column in columns):
        return False
    cells = [(column.field, cell_of(row, column)) for column in columns if column.field.quantity is not None]
    if {cell for _, cell in cells if cell} == {"M"} or any(re.search(r"\d", cell) for _, cell in cells):
        return False
    return any(cell and field.unit_of(cell) for field, cell in cells)


def _candidates(field: Field, cells: Sequence[str], choice: Choice) -> list[Column]:
    """The columns that may be meant: those of the header that the user says, else those with the clearest names."""
    if choice.header is not None:
        # The user may write the unit in brackets behind a header that has none, or leave it out.
        bare, unit = _plain(_BRACKETS.sub("", choice.header)), field.unit_in(choice.header)
        plain = [_plain(cell) for cell in cells]
        places = [k for k, cell in enumerate(plain) if cell in (_plain(choice.header), bare)]
        places = places or [k for k, cell in enumerate(plain) if _BRACKETS.sub("", cell) == bare]
        return [Column(field, k, cells[k], unit or field.unit_in(cells[k])) for k in places]
    found = [column for place, cell in enumerate(cells) if (column := field.read(cell, place)) is not None]
    clearest = [column for column in found if column.rank == min(column.rank for column in found)]
    usable = [column for column in clearest if not column.wrong]
    return usable or ([] if field.optional else clearest)


def _plain(header: str) -> str:
    return " ".join(header.casefold().split())
