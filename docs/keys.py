"""The table of case keys, made from the models that read the case."""

import inspect
import types
from collections.abc import Iterator
from typing import Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from fctd.case.errors import Expects, Table
from fctd.case.load import KINDS, Case
from fctd.case.units import Quantity

HEAD = """# The keys of a case

Made by `python -m docs` from the models that read a case. A quantity is a text with its unit, `"12 m"`, or a bare number
in SI. A key without a default is required, unless its table says that it is one of two.
"""


def page() -> str:
    """The whole page as Markdown: a section a table of the case."""
    parts = [HEAD]
    parts += [_section(f"[{name}]", table) for name, table in _tables(Case)]
    parts += [_section(f'[[operations]], kind = "{kind}"', model) for kind, model in KINDS.items()]
    return "\n".join(parts)


def _tables(model: type[Table], prefix: str = "") -> Iterator[tuple[str, type[Table]]]:
    """The tables below a model with their headings in a case file, lists in double brackets."""
    for name, field in model.model_fields.items():
        for part in _parts(field.annotation):
            if isinstance(part, type) and issubclass(part, Table) and part not in KINDS.values():
                heading = f"{prefix}{name}"
                yield (f"[{heading}]" if get_origin(field.annotation) is tuple else heading), part
                yield from _tables(part, f"{heading}.")


def _parts(annotation: Any) -> list[Any]:
    """The members of a union or a tuple, else the annotation itself."""
    origin = get_origin(annotation)
    if origin in (Union, types.UnionType, tuple):
        return [part for argument in get_args(annotation) for part in _parts(argument)]
    return [annotation]


def _section(heading: str, table: type[Table]) -> str:
    rows = [
        f"| `{name}` | {_expected(field)} | {_default(field)} |"
        for name, field in table.model_fields.items()
        if name != "kind" and not any(isinstance(p, type) and issubclass(p, Table) for p in _parts(field.annotation))
    ]
    return "\n".join([f"## `{heading}`", "", inspect.getdoc(table) or "", "", "| key | expects | default |", "|---|---|---|", *rows, ""])


def _expected(field: FieldInfo) -> str:
    """What a key expects, in the words of the message that refuses something else."""
    for item in (*field.metadata, *(m for part in _parts(field.annotation) for m in getattr(part, "__metadata__", ()))):
        if isinstance(item, Expects):
            return item.expected
    choices = [repr(word) for part in _parts(field.annotation) if get_origin(part) is Literal for word in get_args(part)]
    if choices:
        return " or ".join(choice.replace("'", "`") for choice in choices)
    if field.description:
        return field.description
    names = [getattr(part, "__name__", str(part)) for part in _parts(field.annotation) if part is not type(None)]
    return {"str": "a text", "int": "a whole number", "bool": "true or false", "Path": "a file name"}.get(names[0], "see above")


def _default(field: FieldInfo) -> str:
    if field.default_factory is not None:
        return "depends on the keys beside it"
    if field.default is PydanticUndefined:
        return "required"
    if field.default is None or field.default == ():
        return "–"
    if isinstance(field.default, bool):
        return f"`{str(field.default).lower()}`"
    units = [item.dimension.unit for item in field.metadata if isinstance(item, Quantity)]
    return f"`{field.default:g} {units[0]}`" if units else f"`{field.default}`"
