"""Bad input: the exception that every module raises, and the base class of a case's tables.

The message of a bad value is one line, for example
`paper_well.toml: string.components[0].length = "-2 m": expected a length above 0`.
"""

from __future__ import annotations

import difflib
import json
import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from enum import Enum
from os import PathLike
from typing import Any, Final

from pydantic import BaseModel, ConfigDict, ValidationInfo, model_validator

from fctd.case.message import Message, within
from fctd.case.text import printable

_LONGEST_VALUE: Final = 80  # characters of a value shown in a message
_DEEPEST: Final = 100  # tables in each other


class Missing(Enum):
    """The type of `MISSING`; an enum so that it stays itself when an error is pickled."""

    VALUE = "missing"


MISSING: Final = Missing.VALUE
"""The value of an absent key. None is a value: an override with None deletes the key."""


class InputError(ValueError):
    """The user's input cannot be used.

    file: the file with the bad value, or None; key: dotted path, list indices in brackets, or "";
    value: as the user wrote it, or MISSING; expected: the accepted input, a noun phrase;
    more: further problems of the same input, each on its own line of the message; lines: of a file, to be pasted into
    it, below the message.
    """

    def __init__(
        self,
        expected: str,
        *,
        key: str = "",
        value: object = MISSING,
        file: str | PathLike[str] | None = None,
        more: Sequence[InputError] = (),
        lines: Sequence[str] = (),
    ) -> None:
        super().__init__(Message(expected))
        self.file = file
        self.key = key
        self.value = Message(value) if type(value) is str else value
        self.expected = Message(expected)
        self.more = tuple(more)
        self.lines = tuple(lines)

    def in_file(self, file: str | PathLike[str]) -> InputError:
        """The same error with this file, unless it names a file already."""
        more = [other.in_file(file) for other in self.more]
        file = file if self.file is None else self.file
        return type(self)(self.expected, key=self.key, value=self.value, file=file, more=more, lines=self.lines)

    def at(self, key: str) -> InputError:
        """The same error with `key` put before its key."""
        more = [other.at(key) for other in self.more]
        key = join_key(key, self.key)
        return InputError(self.expected, key=key, value=self.value, file=self.file, more=more, lines=self.lines)

    def __str__(self) -> str:
        return str(self.message)

    @property
    def message(self) -> Message:
        """All of it as a sentence."""
        file = "" if self.file is None else f"{self.file}: "
        line = printable(f"{file}{self._subject()}expected {within(self.expected)}")
        return Message("\n".join([line, *(within(other.message) for other in self.more), *map(printable, self.lines)]))

    def _subject(self) -> str:
        if self.value is MISSING:
            return f"{self.key} is missing: " if self.key else ""
        return f"{self.key} = {show(self.value)}: " if self.key else f"{show(self.value)}: "


@contextmanager
def naming(file: str | PathLike[str] | None) -> Iterator[None]:
    """Add a file, unless it is None, to an InputError that is raised inside and names none."""
    try:
        yield
    except InputError as error:
        raise (error if file is None else error.in_file(file)) from error.__cause__


class Computed(Message):
    """A value that the program computed: messages show it without quotes."""


def show(value: object) -> str:
    """A value as a case file writes it, cut to a readable length; a path is not cut, since its end matters most."""
    if isinstance(value, Computed):
        return within(value)
    if isinstance(value, PathLike):
        return json.dumps(str(value), ensure_ascii=False)
    if _is_deep(value):
        return "a table" if isinstance(value, dict) else f"a {type(value).__name__}"
    try:
        text = repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False, default=str)
    # Thousands of digits, keys that are no strings, thousands of tables.
    except (ValueError, TypeError, RecursionError):
        text = {dict: "a table", int: "a long number"}.get(type(value), f"a {type(value).__name__}")
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 3] + "..."


def _is_deep(value: object) -> bool:
    """Whether tables or lists lie deeper in each other than anybody reads; how deep json goes is Python's affair."""
    level = [value]
    for _ in range(_DEEPEST):
        level = level[:_DEEPEST]  # one table of a level says enough
        level = [
            inner
            for one in level
            for inner in (one.values() if isinstance(one, dict) else one if isinstance(one, list | tuple) else ())
        ]
        if not level:
            return False
    return True


def join_key(*parts: str | int) -> str:
    """("operations", 0, "speed") as "operations[0].speed"; parts may be dotted keys themselves."""
    key = ""
    for part in parts:
        text = f"[{part}]" if isinstance(part, int) else part
        key += text if not key or not text or text.startswith("[") else f".{text}"
    return key


# What people write for a key, in lower case without what stands between words.
_WORDS: Final = {
    "bit.weight_on_bit": "wob weightonbit",
    "bit.torque": "tob bittorque torqueonbit",
    "density": "weight mudweight",
    "mud.density": "mw mudweight density muddensity",
    "rig.block_weight": "blockweight topdriveweight",
    "friction": "ff cof frictionfactor",
    "outer_diameter": "od",
    "inner_diameter": "id",
    "linear_mass": "ppf weight linearweight nominalweight",
    "yield_strength": "grade",
    "speed": "rop",
}


def known_keys(table: Mapping[Any, Any], keys: Collection[str], owner: str = "") -> dict[str, Any]:
    """The table without the keys that are None, or an InputError that names the nearest known key."""
    for key, value in table.items():
        if key not in keys:
            if key == "units":  # in TOML a key below a table is a key of that table
                raise InputError("it above the first table of the case file", key=key, value=value)
            word = re.sub(r"[\W_]", "", str(key)).lower()
            meant = [known for known, words in _WORDS.items() if word in words.split()]
            here, elsewhere = [known for known in meant if known in keys], [known for known in meant if "." in known]
            if here or elsewhere:
                raise InputError(f"the key {(here or elsewhere)[0]}", key=str(key), value=value)
            raise InputError(nearest(key, keys, "key") + owner, key=str(key), value=value)
    return {key: value for key, value in table.items() if value is not None}


def nearest(word: object, choices: Collection[str], noun: str) -> str:
    """The accepted words in place of a wrong one: those that it is a part of, the nearest, or all when none is near."""
    part = str(word).strip('"').casefold()
    within = [choice for choice in choices if len(part) > 1 and part in choice.casefold()]
    near = within if len(within) == 1 else difflib.get_close_matches(str(word), [] if within else choices, n=1)
    choices = within or choices
    nouns = re.sub(r"(?<![aeiou])y$", "ie", noun) + "s"
    return f"the {noun} {near[0]}" if near else f"one of the {nouns} {', '.join(choices)}"


class Expects(ABC):
    """Metadata of a pydantic field that describes the accepted input."""

    @property
    @abstractmethod
    def expected(self) -> str:
        """The accepted input, a noun phrase."""


class Table(BaseModel):
    """A table of a case file, immutable. A key that is None, as an override may set it, is absent."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    @model_validator(mode="before")
    @classmethod
    def _check_keys(cls, raw: Any, info: ValidationInfo) -> Any:
        if not isinstance(raw, Mapping):
            return raw  # pydantic reports the wrong type
        # `file` is accepted from a stored case, which is validated without context, and not from a case file.
        keys = [key for key in cls.model_fields if key != "file" or info.context is None]
        of_a_kind = "kind" in keys and cls.model_fields["kind"].is_required()
        written = known_keys(raw, keys, owner=f" of {raw['kind']}" if of_a_kind else "")
        for key, field in cls.model_fields.items():
            if field.is_required() and key not in written:
                wants = [item.expected for item in field.metadata if isinstance(item, Expects)]
                raise InputError(wants[0] if wants else field.description or "a value", key=key)
        return written


def exclusive(table: Table, first: str, second: str, *, required: bool = False) -> None:
    """Raise InputError where both of two alternative keys are given, or neither where one is required."""
    given = [key for key in (first, second) if getattr(table, key) is not None]
    if len(given) == 2:
        raise InputError(f"{first} or {second}, not both", key=second)
    if required and not given:
        raise InputError(f"{first} or {second}", key=first)
