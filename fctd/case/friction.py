"""Friction as it is planned: one factor for the whole hole, or one for each kind of interval.

A factor is one number for all directions, or a pair, along and around the hole.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final, Self, TypeVar, get_args

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import MISSING, InputError, nearest
from fctd.case.message import Message, quantity, within
from fctd.case.units import FRICTION, in_steps
from fctd.case.wall import IntervalKind, IntervalSpec

KINDS: Final[tuple[str, ...]] = get_args(IntervalKind)
_FORM: Final = (
    "a factor such as 0.25, a list of them such as 0.1,0.2,0.3, a fan FROM:TO:STEP such as 0.1:0.4:0.1, or factors by "
    "kind such as cased=0.2,open=0.3, where each factor but those of a fan may be a pair such as 0.3/0.2, along and "
    "around the hole"
)
_MOST_IN_FAN: Final = 100  # more is a slip in the step
_MOST_PARTS: Final = 4  # intervals that the label of a case's own factors lists

T = TypeVar("T")


@dataclass(frozen=True)
class Pair:
    """Kinetic friction factors along the hole and around it."""

    along: float
    around: float

    def __str__(self) -> str:
        return f"{self.along:g}/{self.around:g}"

    def shifted(self, by: float) -> Self:
        """Both factors and a number more."""
        return type(self)(self.along + by, self.around + by)


Factor = float | Pair


@dataclass(frozen=True)
class FrictionSet:
    """Kinetic friction factors: ``every`` for all intervals, or those of kinds; a kind without one keeps the case's."""

    every: Factor | None = None
    cased: Factor | None = None
    open: Factor | None = None

    @property
    def by_kind(self) -> dict[str, Factor]:
        """Factor of each kind that has one."""
        return {kind: factor for kind in KINDS if (factor := getattr(self, kind)) is not None}

    @property
    def factors(self) -> tuple[float, ...]:
        """All factors of the set."""
        some = tuple(self.by_kind.values()) if self.every is None else (self.every,)
        return tuple(
            number for one in some for number in ((one.along, one.around) if isinstance(one, Pair) else (one,))
        )

    @property
    def override(self) -> float | str | dict[str, float | str]:
        """The value of the override "friction" that sets these factors (`load_case`)."""
        return {kind: _written(factor) for kind, factor in self.by_kind.items()} if self.every is None else (
            _written(self.every)
        )  # fmt: skip

    @property
    def label(self) -> str:
        """A name for tables and pictures: "0.25", "0.3/0.2", "cased 0.20, open 0.30/0.25"."""
        if self.every is not None:
            return _short(self.every)
        return ", ".join(f"{kind} {_two_digits(factor)}" for kind, factor in self.by_kind.items())

    def of(self, intervals: Sequence[IntervalSpec]) -> tuple[Pair, ...]:
        """The factors of each interval.  Raises InputError as `pick` does."""
        if self.every is not None:
            return (_pair(self.every),) * len(intervals)
        picked = pick(self.by_kind, [interval.kind for interval in intervals])
        return tuple(own if new is None else _pair(new) for own, new in zip(pairs_of(intervals), picked, strict=True))


# One set of factors as a call from Python takes it.
FrictionChoice = float | str | Mapping[str, float | str] | FrictionSet


def pairs_of(intervals: Sequence[IntervalSpec]) -> tuple[Pair, ...]:
    """The factors of intervals as they stand."""
    return tuple(Pair(interval.friction, interval.friction_around) for interval in intervals)


def table_of(intervals: Sequence[IntervalSpec]) -> Array:
    """The factors of intervals (k, 2), as `Wellbore.with_friction` takes them."""
    return np.array([(interval.friction, interval.friction_around) for interval in intervals])


def own_friction(intervals: Sequence[IntervalSpec]) -> dict[str, float]:
    """The friction factors of intervals along and around the hole, NaN where they differ, by column."""
    factors = table_of(intervals)
    same = (factors == factors[0]).all(axis=0)
    return dict(zip(("friction", "rotational_friction"), np.where(same, factors[0], np.nan).tolist(), strict=True))


def changed(intervals: Sequence[IntervalSpec], factors: Sequence[Pair]) -> tuple[IntervalSpec, ...]:
    """Intervals with other kinetic factors, one pair for each; static ones are scaled along."""
    return tuple(
        interval.model_copy(
            update={
                "friction": new.along,
                "rotational_friction": _own_around(new),
                "static_friction": interval.static_friction and (1 + interval.static_excess) * new.along,
            }
        )
        for interval, new in zip(intervals, factors, strict=True)
    )


def pick(by_kind: Mapping[str, T], kinds: Sequence[object]) -> list[T | None]:
    """What each interval gets by its kind, None where its kind is not asked for.

    Raises InputError for an unknown kind, for an interval without a kind, and for a kind that no interval has.
    """
    for kind in by_kind:
        if kind not in KINDS:
            raise InputError(nearest(kind, KINDS, "kind"), key="friction", value=dict(by_kind))
    for i, has in enumerate(kinds):
        if has not in KINDS:
            expected, value = '"cased" or "open", since friction is given by kind', MISSING if has is None else has
            raise InputError(expected, key=f"wellbore.intervals[{i}].kind", value=value)
    lacking = [kind for kind in by_kind if kind not in kinds]
    if lacking or not by_kind:
        expected = f"factors of kinds that the intervals have, {' and '.join(dict.fromkeys(map(str, kinds)))}"
        raise InputError(expected, key="friction", value=dict(by_kind))
    return [by_kind.get(str(has)) for has in kinds]


def parse_frictions(texts: Iterable[str], key: str) -> list[FrictionSet]:
    """Sets of ``--friction`` options, each once: "0.25", "0.1,0.2,0.3", "0.1:0.4:0.1" or "cased=0.20,open=0.30"."""
    return list(dict.fromkeys(found for text in texts for found in _parse(text, key)))


def _parse(text: str, key: str) -> list[FrictionSet]:
    parts = [part.strip() for part in text.split(",")]
    for whole, digits in pairwise(parts):
        if whole == "0" and digits.isdecimal():  # "0,2" is 0.2 in half of the world
            expected = f"0.{digits} with a point, or two factors, 0.0,{digits}: a comma separates factors"
            raise InputError(expected, key=key, value=text)
    pairs = [tuple(word.strip() for word in part.split("=")) for part in parts]
    try:
        if all(len(pair) == 1 for pair in pairs):
            return [FrictionSet(every=factor) for part in parts for factor in _factors(part)]
        if all(len(pair) == 2 for pair in pairs) and len({pair[0] for pair in pairs}) == len(pairs):
            return [friction_set({kind: _factor(factor) for kind, factor in pairs})]
    except InputError as error:
        raise InputError(error.expected, key=key, value=text) from None
    raise InputError(_FORM, key=key, value=text)


def _factors(text: str) -> list[Factor]:
    """A factor, or those of a fan."""
    ends = text.split(":")
    if len(ends) != 3:
        return [_factor(text)]
    first, last, step = (_one_factor(end) for end in ends)
    if not (first <= last and step > 0) or (last - first) / step >= _MOST_IN_FAN:
        raise InputError(
            f"a fan FROM:TO:STEP with TO at least FROM, a STEP above 0, and at most {_MOST_IN_FAN} factors"
        )
    return list(in_steps(first, last, step))


def _factor(text: str) -> Factor:
    return _parse_pair(text) if "/" in text else _one_factor(text)


def _parse_pair(text: str) -> Factor:
    along, around = (_one_factor(part) for part in text.split("/", 1))
    return along if along == around else Pair(along, around)


def _one_factor(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        raise InputError(_FORM) from None
    return FRICTION.parse(number)


def _given(value: object) -> Factor:
    """A factor, a pair, or a text such as "0.3/0.2"; InputError for others."""
    text = str(_written(value)) if isinstance(value, Pair) else value
    if not (isinstance(text, str) and "/" in text):
        return FRICTION.parse(text)
    try:
        return _parse_pair(text)
    except InputError as error:
        raise InputError(error.expected, value=text) from None


def split_factor(value: object) -> tuple[object, object]:
    """The values of `friction` and `rotational_friction` of an override; None for the latter sets both alike.

    A text such as "0.3/0.2" is a pair; raises InputError for one that is none.  Validation judges other values.
    """
    if not (isinstance(value, str) and "/" in value):
        return value, None
    pair = _pair(_parse_pair(value))
    return pair.along, _own_around(pair)


def friction_set(value: object) -> FrictionSet:
    """A factor, a pair such as "0.3/0.2", either by kind such as {"cased": 0.2, "open": "0.4/0.3"}, or a set, as a set.

    Raises InputError for others.
    """
    if isinstance(value, FrictionSet):
        return value
    if not isinstance(value, Mapping):
        return FrictionSet(every=_given(value))
    for kind in value:
        if kind not in KINDS:
            raise InputError(nearest(kind, KINDS, "kind"), value=dict(value))
    if not value:
        raise InputError(_FORM, value={})
    return FrictionSet(**{kind: _given(factor) for kind, factor in value.items()})


def friction_sets(value: Any) -> list[FrictionSet]:
    """One or several of what `friction_set` takes; InputError with the key ``friction`` for others."""
    value = value.tolist() if isinstance(value, np.ndarray) else value
    several = isinstance(value, Iterable) and not isinstance(value, str | Mapping)
    try:
        found = [friction_set(one) for one in (value if several else [value])]
    except InputError as error:
        raise error.at("friction") from None
    if not found:
        raise InputError("at least one friction factor", key="friction", value=[])
    return found


def own_label(intervals: Sequence[IntervalSpec]) -> str:
    """The factors of a case as it stands: "0.25", "0.3/0.2", or "case's own: 0.2 down to 1500 m, 0.3 below"."""
    label = factors_label(intervals)
    return label if label.replace(".", "").replace("/", "").isdecimal() else Message(f"case's own: {within(label)}")


def factors_label(intervals: Sequence[IntervalSpec]) -> Message:
    """The factors of intervals: "0.25", "0.2 down to 1500 m, 0.3/0.2 below", or of many intervals "0.11 to 0.16"."""
    ends: list[tuple[Pair, float]] = []  # factors, lower end
    for pair, interval in zip(pairs_of(intervals), intervals, strict=True):
        if ends and ends[-1][0] == pair:
            ends.pop()
        ends.append((pair, interval.to_md))
    if len(ends) == 1:
        return Message(_short(ends[0][0]))
    if len(ends) > _MOST_PARTS:
        along, around = ([getattr(pair, name) for pair, _ in ends] for name in ("along", "around"))
        if along == around:
            return Message(f"{min(along):g} to {max(along):g}")
        return Message(f"{min(along):g} to {max(along):g} along, {min(around):g} to {max(around):g} around")
    parts = ", ".join(f"{_short(pair)} down to {quantity(to_md, 'm')}" for pair, to_md in ends[:-1])
    return Message(f"{parts}, {_short(ends[-1][0])} below")


def _pair(factor: Factor) -> Pair:
    return factor if isinstance(factor, Pair) else Pair(factor, factor)


def _own_around(pair: Pair) -> float | None:
    """The value of `rotational_friction`: None where both factors are equal."""
    return None if pair.around == pair.along else pair.around


def _written(factor: Factor) -> float | str:
    """A factor as an override takes it, with all of its digits."""
    return f"{factor.along!r}/{factor.around!r}" if isinstance(factor, Pair) else factor


def _short(factor: Factor) -> str:
    if isinstance(factor, Pair):
        return f"{factor.along:g}" if factor.along == factor.around else str(factor)
    return f"{factor:g}"


def _two_digits(factor: Factor) -> str:
    if isinstance(factor, Pair):
        return f"{_two_digits(factor.along)}/{_two_digits(factor.around)}"
    return f"{factor:.2f}" if round(factor, 2) == factor else f"{factor:g}"
