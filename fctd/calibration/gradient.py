"""Friction that grows or falls linearly in depth within the intervals of a kind, as where cuttings lie in the hole.

``friction.KIND.gradient`` is the share of the factor of its kind by which friction is larger at the lower end, and
smaller at the upper one.  An interval has one factor, so that the intervals of the kind are cut into pieces.
"""

import re
from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Final

import numpy as np

from fctd.case.load import Case

# Pieces of a kind: the factor of each is off by a tenth of the gradient at most.
PIECES: Final = 10


def gradient_of(name: str) -> str:
    """The kind of an unknown that is a gradient, "" for another."""
    found = re.fullmatch(r"friction\.(cased|open)\.gradient", name)
    return found[1] if found else ""


def in_pieces(case: Case, names: Iterable[str]) -> Case:
    """The case with the intervals of every kind that has a gradient among the unknowns in pieces of equal length.

    A kind that has as many intervals already, as that of a calibrated case, stays.
    """
    intervals = case.wellbore.intervals
    kinds = {gradient_of(name) for name in names} - {""}
    kinds -= {kind for kind in kinds if sum(interval.kind == kind for interval in intervals) >= PIECES}
    if not kinds & {interval.kind for interval in intervals}:
        return case
    ends, found = _ends(case), []
    for (top, bottom), interval in zip(ends, intervals, strict=True):
        count = 1
        if interval.kind in kinds:
            whole = sum(b - a for (a, b), other in zip(ends, intervals, strict=True) if other.kind == interval.kind)
            count = max(round(PIECES * (bottom - top) / whole), 1)
        for to_md in np.linspace(top, bottom, count + 1)[1:].tolist():
            found.append(interval.model_copy(update={"to_md": to_md}))
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": tuple(found)})})


def multipliers(case: Case, values: Mapping[str, float]) -> list[float]:
    """By how much the gradients among the values of unknowns multiply the factor of each interval."""
    found = [1.0] * len(case.wellbore.intervals)
    for name, value in values.items():
        kind = gradient_of(name)
        of_kind = [i for i, interval in enumerate(case.wellbore.intervals) if kind and interval.kind == kind]
        if of_kind:
            ends = _ends(case)
            top, bottom = ends[of_kind[0]][0], ends[of_kind[-1]][1]
            for i in of_kind:
                found[i] = 1 + value * (sum(ends[i]) - top - bottom) / (bottom - top)
    return found


def _ends(case: Case) -> list[tuple[float, float]]:
    """Upper and lower end of each interval [m]."""
    return [*pairwise([0.0, *(interval.to_md for interval in case.wellbore.intervals)])]
