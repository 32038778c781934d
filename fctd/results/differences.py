"""What differs between the inputs of cases, key by key, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from math import isclose
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from fctd.case.errors import MISSING, InputError, join_key
from fctd.case.key_quantities import quantities_of
from fctd.case.load import Case
from fctd.case.raw_case import look_up
from fctd.case.spellings import split
from fctd.case.systems import kind_with, signed
from fctd.case.text import counted, printable
from fctd.case.units import Quantity
from fctd.results.unit_systems import System, shown

ALIKE: Final = 1e-9  # share of a number by which two spellings of it may differ
# Keys of the files of a survey and a caliper: what they hold is compared, and the files may have any names.
_OF_SURVEY: Final = "survey", "columns", "sheet", "stations"
_OF_CALIPER: Final = "log", "columns", "sheet"


class Difference(NamedTuple):
    """A key that differs between cases.

    key : dotted, or with more words for what is no single value, as the stations of a survey.  values : of each case,
    SI once validated, None where it has none; written : as its user wrote it; quantity : that the key is declared with.
    """

    key: str
    values: tuple[Any, ...]
    written: tuple[Any, ...]
    quantity: Quantity | None = None

    def texts(self, units: System = "si") -> list[str]:
        """The value of each case: in the unit that it is written with, with field units in theirs."""
        if self.quantity is None or not all(value is None or _is_number(value) for value in self.values):
            return [_word(value) for value in self.values]
        unit, factor = _unit_of(self.quantity, self.written, units)
        texts: list[str] = []
        for digits in range(5, 18):  # as many as tell the values apart
            texts = [_word(value) if value is None else f"{value / factor:.{digits}g}{unit}" for value in self.values]
            if all(
                _same(*pair) == (text == other)
                for pair, (text, other) in zip(combinations(self.values, 2), combinations(texts, 2), strict=True)
            ):
                break
        return texts

    def sentence(self, names: Sequence[str], units: System = "si") -> str:
        """The key with the values and the cases that have them: "mud.density: 1.2 sg (A and C), 1.3 sg (B)".

        Of more than two cases with the same value, the last of the line, only the number is told.
        """
        having: dict[str, list[str]] = {}
        for text, name in zip(self.texts(units), names, strict=True):
            having.setdefault(text, []).append(name)
        usual = max(having, key=lambda text: len(having[text]))
        words = {text: in_a_row(those) for text, those in having.items()}
        if len(having[usual]) > 2:
            words = {text: of for text, of in words.items() if text != usual}
            words[usual] = f"the other {len(having[usual])}"
        values = ", ".join(f"{text} ({of})" for text, of in words.items())
        return printable(f"{self.key}: {values}")


def in_a_row(names: Sequence[str]) -> str:
    """Names as a text: "A, B and C"."""
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))


def differences(cases: Sequence[Case], units: System = "si") -> list[Difference]:
    """What differs between cases, in the order of the keys of a case; names of cases and files, and units of
    display, do not count.

    Values are compared once validated, so that 5 in and 127 mm are the same, and so is a default that one case writes.
    A value that a case derives from another key differs with that key alone.  units : of depths in the words of a
    survey.  Reads surveys and calipers; raises InputError where one cannot be used.

    >>> from fctd import load_case
    >>> light, heavy = (load_case("examples/my_well.toml", {"mud.density": mud}) for mud in ("1250 kg/m^3", "1.4 sg"))
    >>> [found.sentence(["light", "heavy"]) for found in differences([light, heavy])]
    ['mud.density: 1250 kg/m³ (light), 1400 kg/m³ (heavy)']
    """
    dumps = [case.model_dump(exclude={"file", "name", "units"}) for case in cases]
    for dump in dumps:
        for key in _OF_SURVEY:
            dump["wellbore"].pop(key)
        for key in _OF_CALIPER if dump["wellbore"]["caliper"] else ():
            dump["wellbore"]["caliper"].pop(key, None)
    found = [*_surveys(cases, units), *_calipers(cases), *_below("", dumps, [case.written for case in cases])]
    return found or list(_below("", dumps, dumps))  # of cases that Python made, with values that nobody wrote


def _surveys(cases: Sequence[Case], units: System) -> Iterator[Difference]:
    """The stations, where they are not the same: how many there are, and from where on they differ."""
    holes = [case.wellbore.model_copy(update={"survey_smoothing": None}) for case in cases]
    stations = [hole.trajectory for hole in holes]
    most = min(map(len, stations))
    alike = [np.isclose(of[:most], stations[0][:most], rtol=ALIKE, atol=ALIKE).all(axis=1) for of in stations]
    common = int(np.logical_and.reduce(alike).argmin()) if not np.all(alike) else most
    if common == max(map(len, stations)):
        return
    metre = shown("bit_depth_m", units)
    above = stations[0][common - 1, 0] * metre.factor if common else 0.0
    words = [
        ", ".join([*([] if hole.survey is None else [hole.survey.name]), counted(len(of), "station")])
        + f" to {of[-1, 0] * metre.factor:.1f} {metre.label}"
        for hole, of in zip(holes, stations, strict=True)
    ]
    where = f"another path below {above:.1f} {metre.label}" if common > 1 else "another path"
    yield Difference(f"wellbore survey, {where}", tuple(words), tuple(words))


def _calipers(cases: Sequence[Case]) -> Iterator[Difference]:
    """The files of the calipers, where they hold other radii."""
    found = [case.wellbore.calipers for case in cases]
    first = found[0]
    for of in found[1:]:
        if first is None or of is None:
            same = of is first
        else:
            same = np.array_equal(of.md, first.md) and np.array_equal(of.radii, first.radii, equal_nan=True)
        if not same:
            specs = [case.wellbore.caliper for case in cases]
            logs = tuple(None if spec is None else spec.log for spec in specs)
            yield Difference("wellbore caliper, other radii", logs, logs)
            return


def _below(key: str, values: Sequence[Any], written: Sequence[Any], told: str = "") -> Iterator[Difference]:
    """The differences below a key, of the values that cases have there and what their users wrote.

    told : the key as it is told, where an item of a list has its name in place of an index.
    """
    if all(_same(value, values[0]) for value in values[1:]):
        return
    found: list[Difference] = []
    if all(value is None or isinstance(value, Mapping) for value in values):
        for name in dict.fromkeys(name for value in values for name in value or ()):
            here, texts = ([_at(table, name) for table in of] for of in (values, written))
            found += _below(join_key(key, name), here, texts, join_key(told, name))
    elif all(value is None or _is_list(value) for value in values):
        found += _items(key, values, written)
    # A value that nobody wrote follows from another one, which is told.
    if not found and any(text is not None for text in written) and any(text != written[0] for text in written):
        quantity = next(iter(quantities_of(key)), None)
        found = [Difference(told, tuple(values), tuple(written), quantity)]
    yield from found


def _items(key: str, values: Sequence[Any], written: Sequence[Any]) -> Iterator[Difference]:
    """The differences of lists of tables: items of unlike lists are paired by their names where all have one."""
    names = [[_name(item) for item in value or ()] for value in values]
    named = all(None not in of and len({*of}) == len(of) for of in names)
    permuted = any(of != names[0] and sorted(of) == sorted(names[0]) for of in names if named)
    if named and (permuted or len({*map(len, names)}) > 1):
        common = [name for name in names[0] if all(name in of for of in names)]
        in_order = all([name for name in of if name in common] == common for of in names)
        lists = ["; ".join(name for name in of if not (in_order and name in common)) or None for of in names]
        yield Difference(key, tuple(lists), tuple(lists))
        for name in common:
            places = [of.index(name) for of in names]
            here, texts = ([_at(table, k) for table, k in zip(of, places, strict=True)] for of in (values, written))
            own = join_key(key, places[0])
            yield from _below(own, here, texts, own if len({*places}) == 1 else f"{key}.{name}")
        return
    for k in range(max(map(len, names))):
        here, texts = ([_at(table, k) for table in of] for of in (values, written))
        if any(item is None for item in here):
            labels = tuple(None if item is None else _name(item) or "a table" for item in here)
            yield Difference(join_key(key, k), labels, labels)
        else:
            yield from _below(join_key(key, k), here, texts, join_key(key, k))


def _at(table: Any, part: str | int) -> Any:
    """What stands at a name or an index of a table or list; None where there is nothing."""
    found = look_up(table, part)
    return None if found is MISSING else found


def _name(item: Any) -> Any:
    """The name of an item of a list, or else its kind."""
    return next((item[name] for name in ("name", "kind") if item.get(name)), None)


def _is_list(value: Any) -> bool:
    return isinstance(value, list | tuple) and all(isinstance(item, Mapping) for item in value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _same(one: Any, other: Any) -> bool:
    """Whether two values are the same but for rounding."""
    if _is_number(one) and _is_number(other):
        return isclose(one, other, rel_tol=ALIKE)
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return all(_same(one.get(name), other.get(name)) for name in {*one, *other})
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(map(_same, one, other))
    return bool(one == other)


def _unit_of(quantity: Quantity, written: Sequence[Any], units: System) -> tuple[str, float]:
    """The unit in which a quantity is told, with a blank before it, and what it is in SI."""
    unit = next(filter(None, map(_written_unit, written)), quantity.dimension.unit)
    if units == "field":
        unit = unit if (kind := kind_with(unit)) is None else kind.unit(units)
    return f" {signed(unit)}", quantity.dimension.factor(unit)


def _written_unit(text: Any) -> str | None:
    """The unit of a text as its user wrote it; None of what has none."""
    try:
        found = split(text) if isinstance(text, str) else None
    except (InputError, ArithmeticError):  # a grade of steel
        return None
    return None if found is None else found.unit


def _word(value: Any) -> str:
    """A value without a unit in words."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.12g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {_word(of)}" for name, of in value.items() if of is not None)
    if isinstance(value, list | tuple):
        return ", ".join(map(_word, value)) or "none"
    return value.name if isinstance(value, Path) else str(value)
