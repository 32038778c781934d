"""Friction as it is planned: one factor for the whole hole, or one for each kind of interval."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final, TypeVar, get_args

import numpy as np

from fctd.case.errors import MISSING, InputError, nearest
from fctd.case.units import FRICTION
from fctd.case.wall import IntervalKind, IntervalSpec

KINDS: Final[tuple[str, ...]] = get_args(IntervalKind)
_FORM: Final = (
    "a factor such as 0.25, a list of them such as 0.1,0.2,0.3, or factors by kind such as cased=0.2,open=0.3"
)
_MOST_PARTS: Final = 4  # intervals that the label of a case's own factors lists

T = TypeVar("T")


@dataclass(frozen=True)
class FrictionSet:
    """Kinetic friction factors: ``every`` for all intervals, or those of kinds; a kind without one keeps the case's."""

    every: float | None = None
    cased: float | None = None
    open: float | None = None

    @property
    def by_kind(self) -> dict[str, float]:
        """Factor of each kind that has one."""
        return {kind: factor for kind in KINDS if (factor := getattr(self, kind)) is not None}

    @property
    def factors(self) -> tuple[float, ...]:
        """All factors of the set."""
        return tuple(self.by_kind.values()) if self.every is None else (self.every,)

    @property
    def override(self) -> float | dict[str, float]:
        """The value of the override "friction" that sets these factors (`load_case`)."""
        return self.by_kind if self.every is None else self.every

    @property
    def label(self) -> str:
        """A name for tables and pictures, "0.25" or "cased 0.20, open 0.30"."""
        if self.every is not None:
            return f"{self.every:g}"
        return ", ".join(f"{kind} {_two_digits(factor)}" for kind, factor in self.by_kind.items())

    def of(self, intervals: Sequence[IntervalSpec]) -> tuple[float, ...]:
        """The factor of each interval.  Raises InputError as `pick` does."""
        if self.every is not None:
            return (self.every,) * len(intervals)
        picked = pick(self.by_kind, [interval.kind for interval in intervals])
        return tuple(i.friction if new is None else new for i, new in zip(intervals, picked, strict=True))


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
    """Sets of ``--friction`` options, each once: "0.25", "0.1,0.2,0.3" or "cased=0.20,open=0.30"."""
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
            return [FrictionSet(every=_factor(part)) for part in parts]
        if all(len(pair) == 2 for pair in pairs) and len({pair[0] for pair in pairs}) == len(pairs):
            return [friction_set({kind: _factor(factor) for kind, factor in pairs})]
    except InputError as error:
        raise InputError(error.expected, key=key, value=text) from None
    raise InputError(_FORM, key=key, value=text)


def _factor(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        raise InputError(_FORM) from None
    return FRICTION.parse(number)


def friction_set(value: object) -> FrictionSet:
    """A factor, factors by kind such as {"cased": 0.2, "open": 0.3}, or a set, as a set; InputError for others."""
    if isinstance(value, FrictionSet):
        return value
    if not isinstance(value, Mapping):
        return FrictionSet(every=FRICTION.parse(value))
    for kind in value:
        if kind not in KINDS:
            raise InputError(nearest(kind, KINDS, "kind"), value=dict(value))
    if not value:
        raise InputError(_FORM, value={})
    return FrictionSet(**{kind: FRICTION.parse(factor) for kind, factor in value.items()})


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
    """The factors of a case as it stands: "0.25", or "case's own: 0.2 down to 1500 m, 0.3 below"."""
    label = factors_label(intervals)
    return label if label.replace(".", "").isdecimal() else f"case's own: {label}"


def factors_label(intervals: Sequence[IntervalSpec]) -> str:
    """The factors of intervals: "0.25", "0.2 down to 1500 m, 0.3 below", or of many intervals "0.11 to 0.16"."""
    ends: list[tuple[float, float]] = []  # factor, lower end
    for interval in intervals:
        if ends and ends[-1][0] == interval.friction:
            ends.pop()
        ends.append((interval.friction, interval.to_md))
    if len(ends) == 1:
        return f"{ends[0][0]:g}"
    if len(ends) > _MOST_PARTS:
        factors = [factor for factor, _ in ends]
        return f"{min(factors):g} to {max(factors):g}"
    parts = ", ".join(f"{factor:g} down to {to_md:g} m" for factor, to_md in ends[:-1])
    return f"{parts}, {ends[-1][0]:g} below"


def _two_digits(factor: float) -> str:
    return f"{factor:.2f}" if round(factor, 2) == factor else f"{factor:g}"
