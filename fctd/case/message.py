"""Sentences of the program.  Their quantities are told in the reader's units; a user's text in them stays as it is.

A sentence is an f-string with its values in it: ``Message(f"the hole ends at {quantity(depth, 'm')}")``.  As a string
it is in SI units; `told` (systems.py) writes it in others.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Self, SupportsFloat

if TYPE_CHECKING:
    import pandas as pd

# Columns of tables that hold sentences.
SENTENCES: Final = ("friction_label", "reason")
# Round the values, unit and text of a quantity while its sentence is made; no text of a user has them.
_OPEN, _NEXT, _SHUT = f"⟦{os.urandom(4).hex()}:", "¦", "⟧"
_MARKED: Final = re.compile(f"{_OPEN}([^¦]+)¦([^¦]+)¦([^¦⟧]+)⟧")


class Numbers(NamedTuple):
    """Numbers of a sentence that have one unit: their values, the unit, and how they are written in it."""

    values: tuple[float, ...]
    unit: str
    written: str

    def __str__(self) -> str:
        """The numbers with their unit, in SI."""
        return f"{self.written}{'' if self.unit.startswith('°') else ' '}{self.unit}"


class Message(str):
    """A sentence, in SI units as a string."""

    parts: tuple[str | Numbers, ...]

    def __new__(cls, text: str) -> Self:
        """The sentence of an f-string; a sentence stays itself."""
        if isinstance(text, cls):
            return text
        found = _MARKED.split(text)
        parts: list[str | Numbers] = list(found[::4])
        for k in range(len(found) // 4):
            values, unit, written = found[4 * k + 1 : 4 * k + 4]
            parts.insert(2 * k + 1, Numbers(tuple(map(float, values.split(";"))), unit, written))
        message = super().__new__(cls, "".join(map(str, parts)))
        message.parts = tuple(parts)
        return message

    def __reduce__(self) -> tuple[Callable[..., Message], tuple[type[Message], tuple[str | Numbers, ...]]]:
        return _made, (type(self), self.parts)


def quantity(value: SupportsFloat, unit: str, digits: str = "g") -> str:
    """A quantity of a sentence, for an f-string: its value in a unit of sentences, and the format of its number."""
    return _mark(Numbers((float(value),), unit, f"{float(value):{digits}}"))


def span(first: SupportsFloat, last: SupportsFloat, unit: str, digits: str = "g", between: str = " to ") -> str:
    """Two numbers with one unit, "540 to 1500 m", as `quantity`."""
    both = float(first), float(last)
    return _mark(Numbers(both, unit, between.join(f"{value:{digits}}" for value in both)))


def within(text: str) -> str:
    """A sentence as a part of another one, for an f-string: its quantities stay what they are."""
    if not isinstance(text, Message):
        return text
    return "".join(part if isinstance(part, str) else _mark(part) for part in text.parts)


def joined(sentences: Iterable[str], between: str = "; ") -> Message:
    """Sentences as one."""
    return Message(between.join(map(within, sentences)))


def frame_of(rows: Sequence[Mapping[str, Any]] | pd.DataFrame) -> pd.DataFrame:
    """Rows as a table whose sentences keep their quantities, which a column of strings would lose; a table as it is."""
    import pandas as pd  # slow to import

    if isinstance(rows, pd.DataFrame):
        return rows
    table = pd.DataFrame(rows)
    for name in SENTENCES:
        if name in table:
            table[name] = pd.Series([row.get(name) for row in rows], index=table.index, dtype=object)
    return table


def kept(text: str) -> str | list[Any]:
    """A text as JSON keeps it: a sentence with quantities as the list of its parts."""
    return list(text.parts) if isinstance(text, Message) and len(text.parts) > 1 else text


def restored(text: str | list[Any]) -> str:
    """The text that `kept` gave; ValueError and TypeError for what it did not give."""
    if isinstance(text, str):
        return text
    return _made(Message, [part if isinstance(part, str) else Numbers(tuple(part[0]), *part[1:]) for part in text])


def _made(of: type[Message], parts: Iterable[str | Numbers]) -> Message:
    """A sentence of these parts, also in another process, whose marks are others."""
    return of("".join(part if isinstance(part, str) else _mark(part) for part in parts))


def _mark(numbers: Numbers) -> str:
    values = ";".join(map(repr, numbers.values))
    return f"{_OPEN}{values}{_NEXT}{numbers.unit}{_NEXT}{numbers.written}{_SHUT}"
