"""The columns of a survey as a case names them, where the headers of the file do not say enough."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import BeforeValidator

from fctd.case.errors import InputError, Table
from fctd.case.surveys.headers import Wanted, unit_of


class ColumnSpec(Table):
    """A column of a survey: its header, its unit, or both; the unit goes before one that the header names."""

    header: str | None = None
    unit: str | None = None


def _as_column(raw: object) -> object:
    """A header alone is written as a text."""
    if isinstance(raw, str):
        return {"header": raw}
    if not isinstance(raw, Mapping | ColumnSpec):
        raise InputError('a header in quotes or a table such as {header = "DEPTH", unit = "m"}', value=raw)
    return raw


Column = Annotated[ColumnSpec, BeforeValidator(_as_column, json_schema_input_type=str | ColumnSpec)]


def wanted(column: ColumnSpec) -> Wanted:
    """What the reader of a survey looks for."""
    return Wanted(column.header, None if column.unit is None else unit_of(column.unit))
