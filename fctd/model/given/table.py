"""A table of a new case with what a file gives, and with blanks where it gives nothing that can be used."""

import textwrap
from collections.abc import Callable

from fctd.case.systems import Kind, System
from fctd.model.first_runs import aligned, entry
from fctd.model.new_case import FILL_IN, WIDEST, Blank, Block

Writer = Callable[[Kind, float], str]


def writer(units: System) -> Writer:
    """Writes SI values in the units of a system, with nine digits: files have them with the noise of a conversion."""
    return lambda kind, value: f"{value / kind.si(units):.9g} {kind.unit(units)}"


class GivenTable:
    """The lines of a table, and its blanks.

    key : of the table in the case, such as "string.components[0]"; file : that gives it.
    """

    def __init__(self, heading: str, comment: str, key: str, file: str, write: Writer) -> None:
        self._lines, self._key, self._file, self._write = [aligned(heading, comment)], key, file, write
        self.blanks: list[Blank] = []

    @property
    def block(self) -> Block:
        """The lines."""
        return tuple(self._lines)

    def text(self, key: str, text: str, comment: str = "") -> None:
        """A line with a text."""
        self._lines.append(entry(key, text, comment))

    def line(self, line: str, comment: str = "") -> None:
        """A line as it is."""
        self._lines.append(aligned(line, comment))

    def value(self, key: str, kind: Kind, value: float, comment: str = "") -> None:
        """A line with a quantity, of which the SI value is given."""
        self.text(key, self._write(kind, value), comment)

    def blank(self, key: str, expected: str, found: str) -> None:
        """A key to be filled in, below a comment that says what to write and what the file has."""
        blank = Blank(f"{self._key}.{key}", expected, f"{self._file}: {found}")
        self.blanks.append(blank)
        self.remark(f"Fill in {blank}.")
        self._lines.append(aligned(f'{key} = ""', FILL_IN))

    def remark(self, text: str) -> None:
        """Lines of comment."""
        self._lines += textwrap.wrap(text, WIDEST, initial_indent="# ", subsequent_indent="# ")
