"""Fluids inside and outside a string: what they weigh along it, and their pressures.

A column lies along the string, from the surface down to the bit, and keeps its place there while the string moves.  The
weight of a metre of string is linear in the densities inside and outside, so that a segment in which fluids meet has
exactly the weight of their mean densities: nothing is cut where they meet.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import Computed, InputError
from fctd.case.fluids import OutsideSpec
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.wellbore import Wellbore

SAME_PLACE: Final = 1e-6  # [m]: an end of a row and a joint of the string in one place
# Largest difference of pressures at an open end [Pa]: what is left of measured densities and depths.
EQUAL: Final = 0.5e5
BAR: Final = 1e5


@dataclass(frozen=True)
class Column:
    """The fluids on one side of a string, rows from the surface down.

    end : of each row, above the bit, the last 0 [m]; density [kg/m³]; start : pressure at the upper end of a row that a
    plug seals off from the one above, else NaN [Pa]; surface : pressure at the surface [Pa].
    """

    end: tuple[float, ...]
    density: tuple[float, ...]
    start: tuple[float, ...]
    surface: float

    def mean_density(self, top: Array, bottom: Array) -> Array:
        """Mean densities (n,) [kg/m³] between distances from the bit (n,) [m]; those of equal rows exactly."""
        mean = np.full(len(top), self.density[0])
        for k, end in enumerate(self.end[:-1]):
            share = np.clip((end - bottom) / (top - bottom), 0.0, 1.0)
            mean += (self.density[k + 1] - self.density[k]) * share
        return mean

    def row_of(self, above: Array) -> Array:
        """Rows (n,) at distances from the bit [m]; where two meet that of the upper one."""
        return np.asarray((above[:, None] < np.array(self.end[:-1]) - SAME_PLACE).sum(axis=1))

    def pressure(self, above: Array, depth: Array, hole: Wellbore, bit_depth: float) -> Array:
        """Pressures (n,) [Pa] at distances from the bit and true vertical depths [m]."""
        row, weight, offset = self.row_of(above), GRAVITY * np.array(self.density), self._offsets(hole, bit_depth)
        return np.asarray(weight[row] * depth + offset[row])

    def mean_pressure(self, top: Array, bottom: Array, depth: Array, hole: Wellbore, bit_depth: float) -> Array:
        """Mean pressures (n,) [Pa] between distances from the bit (n,) [m]; depth (n,) : true vertical, halfway [m]."""
        offset = self._offsets(hole, bit_depth)
        mean = GRAVITY * self.density[0] * depth + offset[0]
        for k, end in enumerate(self.end[:-1]):
            below = np.clip(end, bottom, top)
            middle = depth_at(hole, bit_depth - 0.5 * (below + bottom))
            more = GRAVITY * (self.density[k + 1] - self.density[k]) * middle + (offset[k + 1] - offset[k])
            mean += more * (below - bottom) / (top - bottom)
        return np.asarray(mean)

    def _offsets(self, hole: Wellbore, bit_depth: float) -> Array:
        """Pressure of each row less its density times depth [Pa], exactly equal for rows that are."""
        met = hole.at(bit_depth - np.array(self.end[:-1]))[0][:, 2] if len(self.end) > 1 else np.zeros(0)
        offset = [self.surface]
        for k, depth in enumerate(met.tolist(), start=1):
            lighter = GRAVITY * (self.density[k - 1] - self.density[k]) * depth
            sealed = self.start[k] - GRAVITY * self.density[k] * depth
            offset.append(offset[-1] + lighter if math.isnan(self.start[k]) else sealed)
        return np.array(offset)


@dataclass(frozen=True)
class Fluids:
    """What is inside and outside a string; open_end : whether both meet at its lower end."""

    inside: Column
    outside: Column
    open_end: bool

    def pressures(self, above: Array, depth: Array, hole: Wellbore, bit_depth: float) -> tuple[Array, Array]:
        """Pressures (n,) inside and outside [Pa] at distances from the bit and true vertical depths [m]."""
        inside, outside = (side.pressure(above, depth, hole, bit_depth) for side in (self.inside, self.outside))
        return inside, outside

    def densities(self, top: Array, bottom: Array) -> tuple[Array, Array]:
        """Mean densities (n,) inside and outside [kg/m³] between distances from the bit (n,) [m]."""
        return self.inside.mean_density(top, bottom), self.outside.mean_density(top, bottom)

    def at_end(self, hole: Wellbore, bit_depth: float) -> tuple[float, float]:
        """Pressures inside and outside [Pa] at the lower end."""
        depth = depth_at(hole, np.array([bit_depth]))
        inside, outside = (float(side[0]) for side in self.pressures(np.zeros(1), depth, hole, bit_depth))
        return inside, outside

    def overweight(self, hole: Wellbore, bit_depth: float) -> float:
        """By how much the fluids inside press more on the lower end than those outside, no pressure at surface [Pa]."""
        inside, outside = self.at_end(hole, bit_depth)
        return inside - self.inside.surface - outside

    def check_end(self, hole: Wellbore, bit_depth: float) -> None:
        """Raise InputError for an open end through which fluid would flow."""
        inside, outside = self.at_end(hole, bit_depth)
        if self.open_end and abs(inside - outside) > EQUAL:
            flows = "fluid would flow out" if inside > outside else "fluid would flow in"
            level = GRAVITY * self.inside.density[0]
            if inside > outside and level > 0:
                flows = f"the level inside would fall by {quantity((inside - outside) / level, 'm', '.0f')}"
            raise InputError(
                f"true, or pressures that are equal within {quantity(EQUAL / BAR, 'bar')} at the open end: with "
                f"{quantity(inside / BAR, 'bar', '.1f')} inside and {quantity(outside / BAR, 'bar', '.1f')} outside "
                f"{flows}",
                key="mud.float",
                value=False,
            )


def fluids_of(case: Case, bit_depth: float) -> Fluids | None:
    """The fluids of a case's string with the bit at a depth [m]; None where both sides have one density.

    Raises InputError for rows that end above the bit.
    """
    mud = case.mud
    if not mud.given:
        return None
    starts = [(below.pressure or 0.0) if above.plug else math.nan for above, below in pairwise(mud.inside)]
    inside = _column("inside", mud.inside, [math.nan, *starts], mud.density, mud.inside_pressure, bit_depth)
    none = [math.nan] * max(len(mud.outside), 1)
    outside = _column("outside", mud.outside, none, mud.density, mud.outside_pressure, bit_depth)
    plugged = any(row.plug and row.to_md is not None and abs(row.to_md - bit_depth) < SAME_PLACE for row in mud.inside)
    return Fluids(inside, outside, case.end == "open" and not plugged and mud.packer_bore is None)


def _column(
    side: str, rows: Sequence[OutsideSpec], starts: Sequence[float], density: float, surface: float, bit_depth: float
) -> Column:
    if not rows:
        return Column((0.0,), (density,), (math.nan,), surface)
    last = rows[-1].to_md
    if last is not None and last < bit_depth - SAME_PLACE:
        raise InputError(
            f"left out, or a depth down to the bit, at {quantity(bit_depth, 'm')}",
            key=f"mud.{side}[{len(rows) - 1}].to_md",
            value=Computed(quantity(last, "m")),
        )
    ends = [0.0 if row.to_md is None or row.to_md > bit_depth - SAME_PLACE else bit_depth - row.to_md for row in rows]
    count = ends.index(0.0) + 1
    return Column(tuple(ends[:count]), tuple(row.density for row in rows[:count]), tuple(starts[:count]), surface)


def depth_at(hole: Wellbore, md: Array) -> Array:
    """True vertical depth (n,) [m] of the hole's axis at measured depths (n,) [m]; 0 above the rotary table."""
    return np.maximum(hole.at(md)[0][:, 2], 0.0)
