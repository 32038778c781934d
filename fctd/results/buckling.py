"""Where a string is compressed beyond a buckling limit, and whether its segments are short enough to bend that way.

A compressed string lies on the wall like a beam on an elastic foundation of q/r: q is the lateral load a metre that
presses it there, r the radial clearance.  With compression F, buoyed weight w and the hole's tangent t,
q = |w sin α ⊥ − F dt/ds|: builds help, drops hurt, and a drop can take all of it away.
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.message import Message, quantity, span, within
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.model.drillstring import String
from fctd.model.wellbore import Wellbore

# Segments in a half wave of snaking and in a turn of the helix that follow the shape.
IN_HALF_WAVE, IN_TURN = 8, 12
# Limits of hanging pipe over (EI w²)^⅓, for the compression at its lower end (Lubinski 1950; Wu & Juvkam-Wold 1995).
HANGING_SINUSOIDAL, HANGING_HELICAL = 1.94, 5.55
# Modes by their numbers, and those of a buckled string.
NEITHER, SINUSOIDAL, HELICAL = 0, 1, 2
MODES: Final = ("none", "sinusoidal", "helical")
BUCKLED: Final = MODES[1:]
# Columns of a row: limits [N], mode, and the segment length that follows the shape there [m].
SINUSOIDAL_LIMIT, HELICAL_LIMIT, MODE, NEEDED = range(4)
ROW_COLUMNS = 4
# A string that can bend has more wall force and friction, and by them up to so many times the compression: the length
# that is advised is as much shorter as the half wave then is.
GROWN = 1.6
MOST_EXCESS = 1e3  # of a load over its limit, which may be 0


@dataclass(frozen=True)
class Buckling:
    """The part of a string that is buckled.

    mode : the worst one, none, sinusoidal or helical; unknown where there is no balance.  from_md, to_md : first and
    last contact point beyond either limit [m], NaN without one; between them may be points that are not.  longest :
    longest segment that is too long for the wave, or 0 [m]; segment_length : the length that would do, also when
    the compression grows by it, NaN where nothing is buckled [m].  excess : largest compression over its limit.
    """

    mode: str
    from_md: float = float("nan")
    to_md: float = float("nan")
    longest: float = 0.0
    segment_length: float = float("nan")
    excess: float = 0.0

    @property
    def resolved(self) -> bool:
        """Whether all segments of the stretch are short enough."""
        return self.longest == 0.0

    def columns(self) -> dict[str, str | float]:
        """The stretch as columns of charts and histories."""
        return {"buckling": self.mode, "buckled_from_md_m": self.from_md, "buckled_to_md_m": self.to_md}

    def __str__(self) -> str:
        return str(self.words)

    @property
    def words(self) -> Message:
        """The mode and its stretch."""
        if np.isnan(self.from_md):
            return Message(self.mode)
        return Message(f"{self.mode} from {span(self.from_md, self.to_md, 'm', '.0f')}")

    def shortfall(self, resolving: str = "detect") -> Message:
        """Where segments are too long, and the length that would do; resolving : ``solver.buckling`` of the case."""
        other = "" if resolving != "detect" else ', or solver.buckling = "resolve" (--resolve-buckling)'
        return Message(
            f"buckling is {within(self.words)}, where segments of {quantity(self.longest, 'm', '.3g')} cannot bend "
            "that way: "
            f"use segments of at most {quantity(self.segment_length, 'm')} there{other}"
        )


NOT_BUCKLED: Final = Buckling("none")
UNKNOWN: Final = Buckling("unknown")


class Pipe(NamedTuple):
    """What buckling depends on, of the n segments: EI [N m²], buoyed weight [N/m], contact radius, length [m].

    Where tool joints and bodies are segments of their own, they are those of the pipe as a whole.  middle : whether a
    segment touches at its middle.
    """

    EI: Array
    weight: Array
    radius: Array
    length: Array
    middle: NDArray[np.bool_]


def pipe_of(string: String) -> Pipe:
    """The pipe of a string."""
    radius = np.maximum(string.contact_radius(), string.of("wave_radius"))
    return Pipe(string.of("wave_stiffness"), string.wave_weight, radius, string.length, string.mid_contact())


def buckling_along(
    hole: Wellbore, pipe: Pipe, top_md: float, md: Array, hole_radius: Array, tension: Array, bit_tension: float
) -> tuple[Array, Buckling]:
    """Rows (n + 1, ROW_COLUMNS) of the top and the n contact points, and the buckled stretch.

    md, hole_radius (n,) : beside the contact points [m]; tension (n,) : effective, of the joints; bit_tension : at the
    lower end [N].

    Sinusoidal limit 2√(EI q/r) (Dawson & Paslay 1984), helical √2 times that (Chen, Lin & Cheatham 1990).  In nearly
    vertical hole these are below those of hanging pipe, which hold for the lower end of a compressed stretch, where
    its compression is largest: beyond them the whole stretch is buckled, up to the neutral point.  Without clearance
    a string cannot buckle: the limits are infinite.

    The half wave of snaking is π√(2EI/F), which is π(EI r/q)^¼ at the limit; the turn of the helix is twice as long.
    """
    rows = np.empty((len(md) + 1, ROW_COLUMNS))
    # Columns of tables are compiled for separately; copied, all callers share one function.
    md, hole_radius, tension = (np.ascontiguousarray(values) for values in (md, hole_radius, tension))
    mode, first, last, longest, needed, excess = find_buckling(
        hole.bends, float(top_md), md, hole_radius, tension, float(bit_tension), *pipe, rows
    )
    start, end = (float(md[k - 1]) if k else top_md for k in (first, last))
    return rows, buckling_of(mode, start, end, longest, needed, excess)


def buckling_of(mode: int, from_md: float, to_md: float, longest: float, needed: float, excess: float) -> Buckling:
    """The buckled part of a string from the numbers of ``find_buckling``."""
    if mode == NEITHER:
        return NOT_BUCKLED
    return Buckling(MODES[mode], from_md, to_md, longest, rounded_down(needed / GROWN**0.5), excess)


def rounded_down(length: float) -> float:
    """A length with two digits, at most the given one [m]."""
    step = 10.0 ** (np.floor(np.log10(length)) - 1)
    return float(f"{np.floor(length / step) * step:.2g}")


@inlined
def course_of(bends, k, s):
    """The row of ``bends`` above depth s, looked for from row k on."""
    while k < len(bends) - 2 and bends[k + 1, 0] <= s:
        k += 1
    while k > 0 and bends[k, 0] > s:
        k -= 1
    return k


@inlined
def tangent_of(bends, k, s):
    """Tangent of the hole and its curvature [1/m] at depth s near row k of ``bends``, three components of each."""
    span = bends[k + 1, 0] - bends[k, 0]
    bx, by, bz = (
        (bends[k + 1, 1] - bends[k, 1]) / span,
        (bends[k + 1, 2] - bends[k, 2]) / span,
        (bends[k + 1, 3] - bends[k, 3]) / span,
    )
    along = s - bends[k, 0]
    return bends[k, 1] + along * bx, bends[k, 2] + along * by, bends[k, 3] + along * bz, bx, by, bz


@inlined
def lateral_load(bends, k, s, weight, compression):
    """Lateral load of the weight and of weight and compression together [N/m], at depth s near row k of ``bends``."""
    tx, ty, tz, bx, by, bz = tangent_of(bends, k, s)
    # The weight across the hole is w (z − tz t); a compressed string presses to the outer side of its bend.
    across = tx * tx + ty * ty
    qx = -weight * tz * tx - compression * bx
    qy = -weight * tz * ty - compression * by
    qz = weight * across - compression * bz
    return abs(weight) * np.sqrt(across), np.sqrt(qx * qx + qy * qy + qz * qz)


@entry
def find_buckling(bends, top_md, md, hole_radius, tension, bit_tension, EI, weight, radius, length, middle, rows):
    """Update ``rows`` given hole, string and tension (see ``buckling_along``).

    Returns mode, first and last buckled row, longest segment that is too long, shortest length needed, excess.
    """
    n = len(md)
    compression, hangs = np.zeros(n + 1), np.zeros((n + 1, 2), np.bool_)
    k = 0
    for i in range(n + 1):
        j = max(i - 1, 0)  # the top has the section of the first segment
        below = tension[i] if i < n else bit_tension
        load = 0.5 * (tension[j] + below) if i and middle[j] else below
        F = compression[i] = max(-load, 0.0)
        s = md[j] if i else top_md
        k = course_of(bends, k, s)
        rows[i, MODE], rows[i, NEEDED] = NEITHER, np.inf
        clearance = hole_radius[j] - radius[j]
        if clearance <= 0:
            rows[i, SINUSOIDAL_LIMIT] = rows[i, HELICAL_LIMIT] = np.inf
            continue
        by_weight, q = lateral_load(bends, k, s, weight[j], F)
        hanging = np.cbrt(EI[j] * weight[j] ** 2)
        for m in range(2):
            factor, own = (2 * np.sqrt(2.0), HANGING_HELICAL * hanging) if m else (2.0, HANGING_SINUSOIDAL * hanging)
            lying = factor * np.sqrt(EI[j] * q / clearance)
            # A drop that takes the wall force away does not make inclined hole vertical.
            hangs[i, m] = own > max(lying, factor * np.sqrt(EI[j] * by_weight / clearance))
            rows[i, m] = own if hangs[i, m] else lying
            if lying < F and not hangs[i, m]:
                rows[i, MODE] = m + 1
    unmark_single(compression, rows, top_md, md, EI)
    for m in range(2):
        mark_hanging(compression, rows, hangs[:, m], m)

    mode, first, last, needed, excess = NEITHER, 0, 0, np.inf, 0.0
    for i in range(n + 1):
        if rows[i, MODE] == NEITHER:
            continue
        first = i if mode == NEITHER else first
        last, mode, F = i, max(mode, int(rows[i, MODE])), compression[i]
        half_wave = np.pi * np.sqrt(2 * EI[max(i - 1, 0)] / F)
        rows[i, NEEDED] = half_wave / IN_HALF_WAVE if rows[i, MODE] == SINUSOIDAL else 2 * half_wave / IN_TURN
        needed = min(needed, rows[i, NEEDED])
        excess = max(excess, F / max(rows[i, SINUSOIDAL_LIMIT], F / MOST_EXCESS))
    longest = 0.0
    for j in range(n):
        if length[j] > min(rows[j, NEEDED], rows[j + 1, NEEDED]) * (1 + 1e-9):
            longest = max(longest, length[j])
    return mode, first, last, longest, needed, excess


@inlined
def reach(compression, rows, i, k, span):
    """Length beyond row i, towards its neighbour k at a distance, over which the compression is beyond the limit."""
    excess, lack = compression[i] - rows[i, SINUSOIDAL_LIMIT], rows[k, SINUSOIDAL_LIMIT] - compression[k]
    return span * excess / (excess + lack) if lack < np.inf else 0.0


@kernel
def unmark_single(compression, rows, top_md, md, EI):
    """Update the mode of single rows beyond a limit: they are no stretch where they reach less far than a half wave.

    The limit is passed between two contact points where a line through both is 0.
    """
    n = len(md)
    for i in range(n + 1):
        above = i > 0 and rows[i - 1, MODE] != NEITHER
        below = i < n and rows[i + 1, MODE] != NEITHER
        if rows[i, MODE] == NEITHER or above or below:
            continue
        length = 0.0
        if i > 0:
            length += reach(compression, rows, i, i - 1, md[i - 1] - (md[i - 2] if i > 1 else top_md))
        if i < n:
            length += reach(compression, rows, i, i + 1, md[i] - (md[i - 1] if i > 0 else top_md))
        if length * np.sqrt(compression[i] / (2 * EI[max(i - 1, 0)])) < np.pi:
            rows[i, MODE], rows[i, NEEDED] = NEITHER, np.inf


@kernel
def mark_hanging(compression, rows, hangs, m):
    """Update the modes of compressed stretches of hanging pipe given which of their rows are beyond limit m."""
    start = 0
    while start < len(hangs):
        end, beyond = start, False
        while end < len(hangs) and hangs[end] and compression[end] > 0:
            beyond |= compression[end] > rows[end, m]
            end += 1
        if beyond:
            for i in range(start, end):
                rows[i, MODE] = max(rows[i, MODE], m + 1)
        start = end + 1
