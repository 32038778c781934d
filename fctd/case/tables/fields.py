"""The fields that a table may have, and how a header names one of them, and its unit.

A header names a field by words, in any case, beside words that say which of its readings it is, with a unit in
brackets, after an underscore, a dot or a blank: "md_m", "Measured Depth (ft)", "Average Hookload kkgf", "DEPT.M".
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from fctd.case.units import Dimension, Quantity

_LONGEST: Final = 60  # characters of a header
_LETTER: Final = re.compile(r"[^\W\d_]")
_AROUND: Final = " \t\n_.,;:()[]-"  # a unit
# What stands in place of a unit, as in "torque_kNxm" and "Torque [foo]"; the header of another field has a blank there.
_IN_PLACE_OF_A_UNIT: Final = re.compile(r"\s*[(\[_]")


@dataclass(frozen=True)
class Field:
    """A field of a table.

    key : its name in messages and options.  names : in words, apart by commas; those after a semicolon count where no
    header has one of those before, and a letter beside its unit.  quantity : dimension and bounds, None of a text.
    beside : words that may stand beside a name.  bare : unit of a header without one, "" where the reader finds out,
    None where it must be there.  example : a unit for messages.  optional : whether a header with a wrong unit is left
    alone, not refused.  checking : whether it is read only to check the others: nobody chooses it, and the first of
    several counts.
    """

    key: str
    names: str
    quantity: Quantity | None = None
    beside: str = ""
    bare: str | None = None
    example: str = ""
    optional: bool = False
    checking: bool = False

    @property
    def dimension(self) -> Dimension:
        """The dimension of a field that is no text."""
        assert self.quantity is not None
        return self.quantity.dimension

    @property
    def accepted(self) -> str:
        """The accepted units, for messages."""
        *others, last = self.dimension.units
        return f"a unit of {', '.join(others)} or {last}"

    def read(self, header: str, place: int = 0) -> "Column | None":
        """The column that a header at a place names; None for that of another field, a number, and a sentence."""
        if len(header) > _LONGEST or not _LETTER.search(header):
            return None
        names = ((rank, name) for rank, pattern in enumerate(self._names) if (name := pattern.search(header)))
        rank, name = next(names, (0, None))
        if name is None:
            return None
        rest = self._known.sub(" ", header)
        unit, words = self._accepted(rest), rest.strip(_AROUND).split()
        if unit is None and len(name.group()) == 1:
            return None
        if unit is not None or not words:
            return Column(self, place, header, unit, rank)
        instead = self.quantity and (_IN_PLACE_OF_A_UNIT.match(rest) or all(map(self._accepted, words)))
        return Column(self, place, header, None, rank, wrong=True) if instead else None

    def unit_of(self, cell: str) -> str | None:
        """The accepted unit that a cell holds, as "ft" of "( Feet )" and "kN*m" of "kN_m"; None for another text."""
        return self._accepted(cell) or self._accepted(self._known.sub(" ", cell))

    def unit_in(self, header: str) -> str | None:
        """The unit at the end of a header of any words; None where there is none."""
        ends = (header[place.start() :] for place in re.finditer(r"[\s_.(\[]", header))
        return next(filter(None, map(self._accepted, ends)), None)

    @cached_property
    def _names(self) -> list[re.Pattern[str]]:
        """The names of each rank."""
        return [_any_of(names.split(",")) for names in self.names.split(";")]

    @cached_property
    def _known(self) -> re.Pattern[str]:
        """Names and the words beside them."""
        return _any_of([*re.split("[,;]", self.names), *self.beside.split()])

    def _accepted(self, text: str) -> str | None:
        """A unit as people write it in headers, ``kN_m`` a product and ``m_s`` a quotient; None for another text."""
        if self.quantity is None:
            return None
        unit = text.strip(_AROUND).removeprefix("in ")
        return self.dimension.unit_of(unit.replace("_", "*")) or self.dimension.unit_of("/".join(unit.rsplit("_", 1)))


@dataclass(frozen=True)
class Column:
    """A column of a table: its field, its place among the cells, its header, and its unit where one is known.

    rank : how clear its name is, 0 the clearest.  wrong : whether the header has another text in place of a unit, or
    several.  assumed : whether the table does not name its unit.  row : name of the row of headers.
    """

    field: Field
    place: int
    header: str
    unit: str | None = None
    rank: int = 0
    wrong: bool = False
    assumed: bool = False
    row: str = "headers"

    @property
    def factor(self) -> float:
        """SI units in one of the column's."""
        return self.field.dimension.factor(self.unit or self.field.dimension.unit)

    def may_be(self, thousands: str) -> bool:
        """Whether a number with commas between thousands is one that the field can have."""
        most = None if self.field.quantity is None else self.field.quantity.at_most
        return most is None or abs(float(thousands.replace(",", ""))) * self.factor <= most


def _any_of(names: Iterable[str]) -> re.Pattern[str]:
    """Names, the longest first, whose words are apart by anything but letters and digits, or by nothing."""
    each = sorted((r"[\W_]*".join(name.split()) for name in names), key=len, reverse=True)
    return re.compile(rf"(?<![^\W_])(?:{'|'.join(each)})(?![^\W_])", re.IGNORECASE)
