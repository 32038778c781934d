"""Labels at the ends of curves: each below the end of its curve, joined to it, clear of all others.

A label stands on one of several levels; a vertical line leads from the end of its curve down to it.
"""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import product
from typing import NamedTuple

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

SIZE = 8.0  # of the type [pt]
LEVEL = 12.0  # height of a level [pt]
GAP = 6.0  # from the line to its text [pt]
SAME = 5.0  # lines that are closer may run into each other's marker [pt]
HINTED = 1.06  # type on a screen is wider than its outlines by at most this
MARKER = 3.0  # half a marker at the end of a line [pt]
CLEAR = 2.0  # from a line to another text [pt]
AIR = 4.0  # between two texts [pt]
EQUAL = 0.5  # ends that are closer look the same [pt]


class Place(NamedTuple):
    """Place of a label: level, 0 the uppermost, and whether the text stands to the right of its line."""

    level: int
    right: bool


@contextmanager
def boxes() -> Iterator[None]:
    """A character that the font lacks is a box, without a warning of the package: a name of another script."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        yield


@cache
def width_of(text: str, size: float = SIZE, weight: str = "normal") -> float:
    """Width of a text [pt], with its dollar signs as they stand."""
    prop = FontProperties(family="DejaVu Sans", weight=weight, size=size)
    with boxes():
        width, _, _ = text_to_path.get_text_width_height_descent(text, prop, ismath=False)
    return HINTED * float(width)


def place(ends: Sequence[float], texts: Sequence[str], width: float) -> list[Place] | None:
    """Places of the labels with the fewest levels; None where they do not fit.

    ends : of the curves from the left edge of axes of a ``width`` [pt].
    """
    best: list[Place] | None = None
    for sides in product((True, False), repeat=len(ends)):
        spans = []
        for x, text, right in zip(ends, texts, sides, strict=True):
            near, far = (x + GAP, x + GAP + width_of(text)) if right else (x - GAP - width_of(text), x - GAP)
            spans.append((near, far))
        if any(near < 0 or far > width for near, far in spans):
            continue
        levels = _levels(ends, spans)
        if levels is not None and (best is None or max(levels) < max(found.level for found in best)):
            best = [Place(level, right) for level, right in zip(levels, sides, strict=True)]
    return best


def _levels(ends: Sequence[float], spans: Sequence[tuple[float, float]]) -> list[int] | None:
    """The level of every label, or None where the line of each of two labels would cross the other's text."""
    count = len(ends)
    taken = [_with_marker(span, end) for span, end in zip(spans, ends, strict=True)]

    def crosses(line: int, text: int) -> bool:
        near, far = taken[text]
        return near - CLEAR < ends[line] < far + CLEAR and abs(ends[line] - ends[text]) >= SAME

    levels = [0] * count
    settled: list[int] = []
    waiting = set(range(count))
    while waiting:
        # A label may be placed when every line that crosses its text has ended above it.
        free = [k for k in waiting if not any(crosses(other, k) for other in waiting - {k})]
        if not free:
            return None
        furthest = max(ends[one] for one in free)
        k = min(one for one in free if ends[one] > furthest - EQUAL)
        above = [levels[other] + 1 for other in settled if crosses(other, k) or _meet(taken[other], taken[k])]
        levels[k] = max(above, default=0)
        settled.append(k)
        waiting.remove(k)
    return levels


def _with_marker(span: tuple[float, float], end: float) -> tuple[float, float]:
    """The room of a label, from its marker to the end of its text."""
    return min(span[0], end - MARKER), max(span[1], end + MARKER)


def _meet(one: tuple[float, float], other: tuple[float, float]) -> bool:
    return one[0] < other[1] + AIR and other[0] < one[1] + AIR
