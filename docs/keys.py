"""The table of case keys, made from the models that read the case."""

import inspect
import types
from collections.abc import Iterator
from typing import Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from fctd.case import units
from fctd.case.errors import Expects, Table
from fctd.case.load import Case
from fctd.case.operation_names import names_of
from fctd.case.operations import KINDS
from fctd.case.units import Quantity

HEAD = """# The keys of a case

`python -m docs` makes this page from the models that read a case. Write a quantity as a text with its unit, `"12 m"`,
or as a bare number in SI units. A default of "–" means that you may leave the key out. [A well of your
own](well.md) says how the keys belong together, and `examples/my_well.toml` uses most of them.

`name`, a text in quotes, stands at the top of the file, before the first table. `units = "field"` beside it shows the
results of the case in field units where a command has no `--units`; "si" (or "metric") is the default.

`--friction 0.2` and the override `friction` set the friction factor of every interval, `--friction cased=0.2,open=0.3`
those of intervals of a `kind`; in place of a factor stands `0.3/0.2` for one along the hole and another around it
(`rotational_friction`).
"""

UNITS = """## Units

The units that messages list. Each has its usual spellings (`in`, `"`, `inches`), in capitals too, and other units that
the package pint knows are read as well. [A well of your own](well.md#quantities) says what is refused.

| quantity | units, the first that of a bare number in the case file |
|---|---|
"""

OPERATIONS = """## The operations

`[[operations]]` are a list in the order of the run. `ramp_time` [s] is the time in which feed and rotation rise at the
start of an operation; `speed` [m/s] and `rpm` [rev/min] are positive, and the kind sets the direction. From the second
operation on you may leave out `from_md` or `at_md`: an operation starts where the one before it ends.

A kind has other names too, which files, tables and options take in its place, in any case of letters:

| kind | names |
|---|---|
"""


def page() -> str:
    """The whole page as Markdown: a section for each table of the case."""
    parts = [HEAD]
    parts += [_section(heading, table) for heading, table in _tables(Case)]
    parts.append(
        OPERATIONS
        + "".join(f"| `{kind}` | {', '.join(f'`{name}`' for name in names_of(kind)[1:])} |\n" for kind in KINDS)
    )
    parts += [_section(f'[[operations]], kind = "{kind}"', model) for kind, model in KINDS.items()]
    parts.append(UNITS + "".join(map(_units, _dimensions())))
    return "\n".join(parts)


def _tables(model: type[Table], prefix: str = "") -> Iterator[tuple[str, type[Table]]]:
    """The tables below a model with their headings in a case file, lists of tables in double brackets."""
    for name, field in model.model_fields.items():
        heading = f"{prefix}{name}"
        for part in _parts(field.annotation):
            if isinstance(part, type) and issubclass(part, Table) and part not in KINDS.values():
                yield (f"[[{heading}]]" if _is_list(field) else f"[{heading}]"), part
                yield from _tables(part, f"{heading}.")


def _parts(annotation: Any) -> list[Any]:
    """The members of a union, a tuple or an annotated type, else the annotation itself."""
    if get_origin(annotation) in (Union, types.UnionType, tuple):
        return [part for argument in get_args(annotation) for part in _parts(argument)]
    if hasattr(annotation, "__metadata__"):
        return _parts(get_args(annotation)[0])
    return [annotation]


def _is_list(field: FieldInfo) -> bool:
    return get_origin(field.annotation) is tuple


def _section(heading: str, table: type[Table]) -> str:
    rows = [
        f"| `{name}` | {_expected(field)} | {_default(field)} |"
        for name, field in table.model_fields.items()
        if not (name == "kind" and table in KINDS.values())
        and not any(isinstance(p, type) and issubclass(p, Table) for p in _parts(field.annotation))
    ]
    head = ["| key | expects | default |", "|---|---|---|"]
    return "\n".join([f"## `{heading}`", "", inspect.getdoc(table) or "", "", *head, *rows, ""])


def _dimensions() -> list[units.Dimension]:
    return [value for value in vars(units).values() if isinstance(value, units.Dimension)]


def _units(dimension: units.Dimension) -> str:
    """A row of the table of units; the unit of a bare number stands first."""
    own = dimension.unit
    others = [unit for unit in dimension.units if unit not in (own, own.replace("m^2", "m/m"))]
    return f"| {dimension.noun} | {', '.join(f'`{unit}`' for unit in (own, *others))} |\n"


def _expected(field: FieldInfo) -> str:
    """What a key expects, in the words of the message that refuses something else."""
    if field.description:
        return field.description
    wants = [item.expected for item in _metadata(field) if isinstance(item, Expects)]
    if wants:
        return f"a list, each {wants[0]}" if _is_list(field) else wants[0]
    parts = _parts(field.annotation)
    choices = [f"`{word}`" for part in parts if get_origin(part) is Literal for word in get_args(part)]
    if choices:
        return " or ".join(choices)
    return {str: "a text in quotes", bool: "true or false"}[parts[0]]


def _metadata(field: FieldInfo) -> list[Any]:
    """What is annotated to a field, to the members of its union or to the items of its list."""
    members = [item for argument in get_args(field.annotation) for item in getattr(argument, "__metadata__", ())]
    return [*field.metadata, *members]


class _Asked(dict[str, Any]):
    """The keys beside a default, none of them given; remembers the last one that the default asks for."""

    last = ""

    def __missing__(self, key: str) -> None:
        self.last = key


def _default(field: FieldInfo) -> str:
    if field.default_factory is not None:
        beside = _Asked()
        value = field.get_default(call_default_factory=True, validated_data=beside)
        if beside.last:
            return f"that of `{beside.last}`" if value is None else f"{_shown(field, value)} without `{beside.last}`"
        return "–" if value is None else _shown(field, value)
    if field.default is PydanticUndefined:
        return "required"
    if field.default is None or field.default == ():
        return "–"
    return _shown(field, field.default)


def _shown(field: FieldInfo, value: object) -> str:
    """A value with its unit."""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    written = [item.dimension.unit for item in _metadata(field) if isinstance(item, Quantity)]
    number = f"{value:g}" if isinstance(value, float) else f"{value}"
    return f"`{number} {written[0]}`" if written else f"`{number}`"
