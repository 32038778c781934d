"""Sentences of the program.  Their quantities are told in the reader's units; a user's text in them stays as it is.

A sentence is an f-string with its values in it: ``Message(f"the hole ends at {quantity(depth, 'm')}")``.  As a string
it is in SI units; `told` writes it in others.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple, Self, SupportsFloat

if TYPE_CHECKING:
    import pandas as pd

System = Literal["si", "field"]

# Units of sentences, and those of the field in their place.
FIELD: Final = {
    "m": "ft", "mm": "in", "km": "ft", "m/s": "ft/min", "m/h": "ft/h", "kN": "klbf", "N": "lbf", "kN·m": "kft·lbf",
    "N·m": "ft·lbf", "MPa": "ksi", "bar": "psi", "kg/m^3": "ppg", "kg/m": "lb/ft", "L/min": "gpm", "K": "°F",
}  # fmt: skip
# Columns of tables that hold sentences.
SENTENCES: Final = ("friction_label", "reason")
_PINTS: Final = {"ppg": "lb/gal", "gpm": "gallon/min", "°F": "degR"}
_DOG_LEG: Final = {"°/30 m": "°/100 ft", "deg/30 m": "deg/100 ft"}
# Round the values, unit and text of a quantity while its sentence is made; no text of a user has them.
_OPEN, _NEXT, _SHUT = f"⟦{os.urandom(4).hex()}:", "¦", "⟧"
_MARKED: Final = re.compile(f"{_OPEN}([^¦]+)¦([^¦]+)¦([^¦⟧]+)⟧")
_NUMBER: Final = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


class Numbers(NamedTuple):
    """Numbers of a sentence that have one unit: their values, the unit, and how they are written in it."""

    values: tuple[float, ...]
    unit: str
    written: str

    def text(self, units: System) -> str:
        """The numbers with their unit."""
        blank = "" if self.unit.startswith("°") else " "
        if units == "si" or self.unit not in FIELD | _DOG_LEG:
            return f"{self.written}{blank}{self.unit}"
        if self.unit in _DOG_LEG:  # as large as before, so with as many digits
            return f"{self.values[0] * 30.48 / 30:.3g}{blank}{_DOG_LEG[self.unit]}"
        from fctd.case.spellings import conversion  # which refuses input with a sentence

        unit, values = FIELD[self.unit], iter(self.values)
        factor = conversion(self.unit.replace("·", "*"), _PINTS.get(unit, unit.replace("·", "*")))
        return f"{_NUMBER.sub(lambda number: _short(next(values) * factor, number[0]), self.written)} {unit}"


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
        message = super().__new__(cls, "".join(part if isinstance(part, str) else part.text("si") for part in parts))
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


def told(text: object, units: System) -> str:
    """A sentence in a system of units; another text as it is."""
    if not isinstance(text, Message):
        return str(text)
    return "".join(part if isinstance(part, str) else part.text(units) for part in text.parts)


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


def _short(value: float, before: str) -> str:
    """A number with one digit more than it had before, three or four."""
    digits = len(before.split("e")[0].lstrip("-0.").replace(".", ""))
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.{min(max(digits + 1, 3), 4)}g}"
