"""A tool of a WITSML string in pieces: its blades touch, and it is bent, where the file says and nowhere else."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Final

from fctd.case.pipes.catalogue import SAME_DIAMETER
from fctd.case.string import SHORT
from fctd.case.witsml.tubular import Bend, TubularPart

AT_AN_END: Final = 0.01  # [m]: a bend so near to an end is there


def pieces_of(part: TubularPart) -> tuple[TubularPart, ...]:
    """The pieces of a tool between its bends and its blades, from its lower end up.

    One that touches at a point, pipe, and a tool of which the file does not say where bends and blades are, is one.
    """
    length = part.length or 0.0
    blades = [
        (one, one.bottom, one.bottom + one.length) for one in part.blades if one.bottom is not None and one.length
    ]
    bends = [(one, one.distance) for one in part.bends if one.distance]
    placed = len(blades) == len(part.blades) and len(bends) == len(part.bends)
    within = max([0.0, *(top for *_, top in blades), *(at for _, at in bends)]) <= length + AT_AN_END
    wide = max((one.diameter for one in part.blades), default=0.0)
    elsewhere = max(part.widest or 0.0, part.joint or 0.0) > max(wide, part.outer or 0.0) + SAME_DIAMETER
    bent = any(distance < length - AT_AN_END for _, distance in bends)
    point = length <= SHORT * max(wide, part.outer or 0.0) and not bent
    if part.kind is not None or not (placed and within) or elsewhere or point or not (blades or bent):
        return (part,)
    ends = [*(distance for _, distance in bends), *(at for _, *both in blades for at in both)]
    return tuple(_cut(part, _apart(ends, length)))


def _apart(ends: list[float], length: float) -> list[float]:
    """Places of cuts [m] in order, without those at an end of the tool, or at another cut."""
    kept = [0.0]
    for end in sorted(ends):
        if end - kept[-1] > AT_AN_END and length - end > AT_AN_END:
            kept.append(end)
    return [*kept, length]


def _cut(part: TubularPart, ends: list[float]) -> Iterator[TubularPart]:
    for number, (bottom, top) in enumerate(pairwise(ends), start=1):
        middle = 0.5 * (bottom + top)
        blades = (
            one for one in part.blades if (one.bottom or 0.0) < middle < (one.bottom or 0.0) + (one.length or 0.0)
        )
        bends = (one for one in part.bends if abs((one.distance or 0.0) - top) <= AT_AN_END)
        yield replace(
            part, description=f"{part.description}, piece {number}".removeprefix(", "), length=top - bottom,
            widest=None, blades=tuple(blades), bends=tuple(Bend(one.angle, top - bottom) for one in bends),
        )  # fmt: skip
