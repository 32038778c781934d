"""Every key of a case is drawn, or stands here with the reason why not: a new key is one or the other."""

import types
from collections.abc import Iterator
from typing import Any, Final, Literal, Union, get_args, get_origin

from fctd.case.errors import Table
from fctd.case.load import Case

# Keys that no draw has, and why.
ABSENT: Final = {
    "file": "the place of the case file, which no table says",
    "wellbore.survey": "stations in files: the statement of survey files writes them",
    "wellbore.columns": "headers of files: their readers have tests of their own (tests/case/test_surveys.py)",
    "wellbore.sheet": "as wellbore.columns",
    "wellbore.caliper.log": "rows in files: the reader has tests of its own (tests/case/test_calipers.py)",
    "wellbore.caliper.columns": "as wellbore.caliper.log",
    "contact.enabled": "without a wall a string hangs free of its hole, and most statements are about the wall",
    "solver.perturbed": "the statement of perturbed rows sets it",
}

# Words of keys with a list of them that no draw has, and why.
ABSENT_WORDS: Final = {
    ("operations.kind", "ream_in"): "the statements compare it at its default rates",
    ("solver.buckling", "feed"): "a fed row takes seconds, and has several balances (docs/steady.md)",
    ("string.components.contact", "sleeve"): "what a component without a word has; statements write it out",
}


def keys_of(model: type[Table] = Case, prefix: str = "") -> Iterator[str]:
    """The dotted keys of a model and of the tables in it, lists of tables without an index."""
    for name, field in model.model_fields.items():
        key = f"{prefix}{name}"
        tables = [part for part in parts(field.annotation) if isinstance(part, type) and issubclass(part, Table)]
        if not tables:
            yield key
        for table in tables:
            yield from keys_of(table, f"{key}.")


def choices_of(model: type[Table] = Case, prefix: str = "") -> Iterator[tuple[str, str]]:
    """The dotted keys of a model whose values are words of a list, with each of the words."""
    for name, field in model.model_fields.items():
        for part in parts(field.annotation):
            if get_origin(part) is Literal:
                yield from ((f"{prefix}{name}", word) for word in get_args(part) if word != field.default)
            elif isinstance(part, type) and issubclass(part, Table):
                yield from choices_of(part, f"{prefix}{name}.")


def parts(annotation: Any) -> Iterator[Any]:
    """The types that an annotation is made of."""
    if hasattr(annotation, "__metadata__"):
        yield from parts(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, types.UnionType, tuple):
        for argument in get_args(annotation):
            yield from parts(argument)
    else:
        yield annotation
