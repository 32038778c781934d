"""The quantities that keys of a case are declared with."""

import types
from collections.abc import Iterator
from typing import Any, Union, get_args, get_origin

from fctd.case.errors import Table
from fctd.case.load import Case
from fctd.case.raw_case import split_key
from fctd.case.units import Quantity


def unit_of(key: str) -> str:
    """The unit of a bare number in a key of the case, "" of a number without one."""
    units = {quantity.dimension.unit for quantity in quantities_of(key)}
    return units.pop() if len(units) == 1 else ""


def quantities_of(key: str) -> list[Quantity]:
    """The quantities of a dotted key, one for each kind of table that may stand there; none of a plain number.

    >>> [quantity.noun for quantity in quantities_of("string.components[0].length")]
    ['a length']
    """
    return list(_below(Case, [part for part in split_key(key) if isinstance(part, str)]))


def _below(model: type[Table], names: list[str]) -> Iterator[Quantity]:
    """The quantities of the fields that a path of names leads to."""
    field = model.model_fields.get(names[0]) if names else None
    for annotation in () if field is None else (field.annotation, *field.metadata):
        for part in _parts(annotation):
            if isinstance(part, Quantity) and len(names) == 1:
                yield part
            elif isinstance(part, type) and issubclass(part, Table) and len(names) > 1:
                yield from _below(part, names[1:])


def _parts(annotation: Any) -> Iterator[Any]:
    """The types and the constraints that an annotation is made of."""
    if hasattr(annotation, "__metadata__"):
        yield from annotation.__metadata__
        yield from _parts(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, types.UnionType, tuple):
        for argument in get_args(annotation):
            yield from _parts(argument)
    else:
        yield annotation
