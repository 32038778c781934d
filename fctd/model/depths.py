"""Bit depths in the user's notation, and the default depths."""

from collections.abc import Sequence

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.case.units import LENGTH, argument, in_steps, typed
from fctd.model.operations import depth_range

MOST_DEPTHS = 10_000  # more is a slip in the step


def read_depth(text: str, case: Case, key: str, bare: str = "m", *, given: str | None = None) -> float:
    """A depth [m]: a length, ``shoe`` for the last casing shoe, ``td`` for the end of the hole.

    bare : unit of a bare number.  given : the whole value of the key, where the text is a part of it.  Raises
    InputError, which names the key.
    """
    word = text.strip().lower()
    if word == "td":
        return case.depths[1]
    if word == "shoe":
        shoes = case.shoes
        if not shoes:
            raise InputError("a depth, as the case has one interval and no shoe", key=key, value=given or text)
        return shoes[-1]
    return typed(text, LENGTH, key, bare)


def read_depths(text: str, case: Case, key: str, bare: str = "m") -> list[float]:
    """Bit depths [m] of FROM:TO:STEP, TO included, those below the top of the string; see ``read_depth``.

    Raises InputError, which names the key.
    """
    parts = text.split(":")
    if len(parts) != 3:
        raise InputError(
            "FROM:TO:STEP, such as 1750:2450:10, '5000 ft:8000 ft:30 ft' or shoe:td:50", key=key, value=text
        )
    first, last = (read_depth(part, case, key, bare, given=text) for part in parts[:2])
    step = 0.0 if parts[2].strip().startswith("-") else typed(parts[2], LENGTH, key, bare)
    if not (first <= last and step > 0):
        raise InputError("depths that rise: TO at least FROM, and a STEP above 0", key=key, value=text)
    if (last - first) / step >= MOST_DEPTHS:
        raise InputError(f"at most {MOST_DEPTHS} depths", key=key, value=text)
    hanging = [depth for depth in in_steps(first, last, step) if depth > case.string.top_md]
    if not hanging:
        raise InputError(f"a depth below string.top_md, {quantity(case.string.top_md, 'm')}", key=key, value=text)
    return hanging


def depth_of(value: float | str, case: Case, key: str) -> float:
    """A bit depth of a call from Python [m]: a number of metres, or a text as ``read_depth`` takes it."""
    return read_depth(value, case, key) if isinstance(value, str) else argument(value, LENGTH, key)


def depths_of(values: float | str | Sequence[float | str], case: Case, key: str) -> list[float]:
    """Bit depths of a call from Python [m], which rise: one, several, or those of a text FROM:TO:STEP.

    Raises InputError, which names the key, for others.
    """
    if isinstance(values, str) and ":" in values:
        return read_depths(values, case, key)
    if isinstance(values, str | float | int | np.number):
        return [depth_of(values, case, key)]
    if np.ndim(values) != 1:
        raise InputError("a list of bit depths", key=key, value=values)
    depths = [depth_of(value, case, f"{key}[{k}]") for k, value in enumerate(list(values))]
    if not depths:
        raise InputError("at least one bit depth", key=key, value=[])
    for before, here in zip([-np.inf, *depths], depths, strict=False):
        if not before < here < np.inf:
            raise InputError("finite bit depths, each below the one before", key=key, value=quantity(here, "m"))
    return depths


def usual_depths(case: Case, count: int) -> list[float]:
    """Even bit depths [m]: from the last shoe, or the middle of the hole, to its end or that of the string.

    A string whose top segment is the paper's long one fits only where the case moves it.
    """
    top, bottom = case.string.top_md, case.deepest
    if case.string.components[-1].long_segment and case.operations:
        _, low, high = depth_range(case)
    else:
        low = next((shoe for shoe in reversed(case.shoes) if top < shoe < bottom), top + 0.5 * (bottom - top))
        high = bottom
    if high - low < 1.0:
        low = top + 0.5 * (high - top)
    return [round(float(depth), 3) for depth in np.linspace(low, high, count)]
