"""Mud that flows past a laid-out string: its pressures along the string, and what it does to the effective tension.

Flow is steady, incompressible and isothermal.  Mud that is pumped flows down the bore and up the annulus.  A string
that moves displaces mud: past a depth flows what the steel and the closed volume below it make room for, and an open
bore shares it with the annulus so that both have one pressure at the bit.  Tool joints that are not laid out as
segments of their own do not narrow the annulus.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.hydraulics.closed_forms import Loss, annulus, bore
from fctd.hydraulics.rheology import Rheology, along
from fctd.model.drillstring import String
from fctd.model.mud import hole_radius
from fctd.model.wellbore import Wellbore

# Within so much of the flow that the string displaces the flow through an open bore is known.
SHARED = 1e-9


@dataclass(frozen=True)
class Circuit:
    """Steady flow along a string, segments (n,) from the top down.

    above : distances from the bit (n + 1,) [m] of the string's top and of the lower ends of its segments; inside,
    outside : what friction adds to the pressures there [Pa], with no friction at the flow line; annulus : its losses;
    bore_flow : downwards, relative to the pipe [m³/s]; bit_drop : pressure from the bore to the annulus [Pa]; given :
    load on each segment along it, towards the bit (n,) [N]: the pull of the annulus, and the thrust of mud that speeds
    up in narrower bores and in the nozzles.
    """

    above: Array
    inside: Array
    outside: Array
    annulus: Loss
    bore_flow: float
    bit_drop: float
    given: Array

    @property
    def lift(self) -> float:
        """What the flow takes off the hook load of a string in a straight vertical hole [N]."""
        return -float(self.given.sum())

    def pressures(self, above: Array) -> tuple[Array, Array]:
        """What friction adds to the pressures inside and outside (k,) [Pa] at distances from the bit [m]."""
        inside, outside = (np.interp(-above, -self.above, side) for side in (self.inside, self.outside))
        return inside, outside


@dataclass(frozen=True)
class Channel:
    """What the mud of a laid-out string flows through, segments (n,) from the top down.

    above : distances from the bit (n + 1,) [m]; length [m]; wet : of it, with mud around [m]; annulus : rows of radii
    of pipe and hole [m], eccentricity, yield stress, consistency, index and density of the mud; bore : rows of radius,
    yield stress, consistency, index and density; tools : pressure drop over the square of the flow [Pa s²/m⁶];
    nozzles : their area, infinite where the case gives none [m²], and what their drop is over that of an ideal flow;
    end : of the string, "open", "closed" or "float", which lets mud out alone.
    """

    above: Array
    length: Array
    wet: Array
    annulus: Array
    bore: Array
    tools: Array
    nozzles: tuple[float, float]
    end: str

    @cached_property
    def _annulus(self) -> tuple[bytes, NDArray[np.int64]]:
        return _runs(self.annulus)

    @cached_property
    def _bore(self) -> tuple[bytes, NDArray[np.int64]]:
        return _runs(self.bore)

    def outside(self, through: float, speed: float) -> Loss:
        """Losses of the annulus (n,) at a flow out of the bit [m³/s] and a speed of the pipe downwards [m/s]."""
        rows, run = self._annulus
        return Loss(*(of[run] for of in _annulus_of(rows, through, speed)))

    def inside(self, through: float) -> Array:
        """Pressure lost along each segment's bore and tools (n,) [Pa] at a flow downwards [m³/s]."""
        rows, run = self._bore
        return np.asarray(_bore_of(rows, through)[run] * self.length + self.tools * through * abs(through))

    def bit_drop(self, through: float) -> float:
        """Pressure from the bore to the annulus at a flow out of the bit [Pa]."""
        area, worse = self.nozzles
        return 0.5 * float(self.bore[-1, -1]) * worse * through * abs(through) / area**2

    def out_of_bit(self, flow: float, speed: float, end: str) -> float:
        """Flow out of the bit [m³/s] while mud is pumped, or displaced at a speed downwards [m/s].

        Raises InputError for a flow through a closed end.
        """
        if flow > 0 and end == "closed":
            raise InputError('"open" or "float" with a flow through it', key="bit.end", value=end)
        if flow > 0 or speed == 0 or end == "closed" or (end == "float" and speed > 0):
            return flow
        return self._shared(speed)

    def _shared(self, speed: float) -> float:
        """Flow out of an open bit [m³/s] with which the pressures there are equal, while the string displaces mud."""
        (outside, run), (inside, of_bore) = self._annulus, self._bore
        around, within = np.bincount(run, self.wet), np.bincount(of_bore, self.length)
        tools = float(self.tools.sum())

        def higher(through: float) -> float:
            """Pressure outside less that inside [Pa]."""
            lost = float(_find_annulus(outside, through, speed).gradient @ around)
            lost += float(_find_bore(inside, through) @ within) + tools * through * abs(through)
            return lost + self.bit_drop(through)

        displaced = -float((np.pi * self.annulus[:, 0] ** 2).max()) * speed
        # Mud that a moving wall drags along may flow faster than what is displaced.
        while higher(displaced) * speed > 0:
            displaced *= 2
        low, high = sorted((displaced, 0.0))
        return float(brentq(higher, low, high, xtol=SHARED * abs(displaced), rtol=SHARED))

    def thrust(self, through: float) -> Array:
        """Thrust upwards on each segment (n,) [N] of mud that is pumped and speeds up at its lower end."""
        bores = np.pi * self.bore[:, 0] ** 2
        area = np.append(bores, min(self.nozzles[0], bores[-1]))
        return np.asarray(self.bore[:, -1] * through**2 * np.diff(1 / area))


def circulate(channel: Channel, flow: float, speed: float = 0.0, end: str | None = None) -> Circuit:
    """Steady flow along a string: pumped downwards [m³/s], or displaced by its speed downwards [m/s], or both.

    end : of the string where it is not that of the channel.  Raises InputError for a flow through a closed end.
    """
    through = channel.out_of_bit(flow, speed, channel.end if end is None else end)
    outside, inside = channel.outside(through, speed), channel.inside(through)
    drop = channel.bit_drop(through)
    around, below = np.zeros((2, len(inside) + 1))
    np.cumsum(outside.gradient * channel.wet, out=around[1:])
    below[:-1] = np.cumsum(inside[::-1])[::-1]
    given = -outside.lift * channel.wet
    if flow > 0:
        given -= channel.thrust(through)
    return Circuit(channel.above, around[-1] + drop + below, around, outside, through, drop, given)


def flows(case: Case, flow: float, speed: float) -> bool:
    """Whether mud that is pumped [m³/s], or displaced at a speed [m/s], acts on the string of a case."""
    return case.mud.densest > 0 and (flow > 0 or (speed != 0 and has_flow_curve(case)))


def channel_of(case: Case, string: String, hole: Wellbore, eccentricity: float | Array = 0.0) -> Channel:
    """The channel of a laid-out string; eccentricity (n,) : offset of the pipe over its clearance, 0 to 1."""
    n, length = string.segments, string.length
    inside, outside = flow_curves(case, string)
    densities = string.densities or (case.mud.density, case.mud.density)
    bottom = string.top_md + np.cumsum(length)
    around = (string.of("outer"), hole_radius(hole, string.top_md, length), eccentricity, *outside, densities[1])
    within = (string.of("inner"), *inside, densities[0])
    return Channel(
        string.above_bit, length, np.clip(bottom, 0.0, length), _table(n, around), _table(n, within),
        tool_drops(case, string), nozzles_of(case), end_of(case),
    )  # fmt: skip


def _table(n: int, columns: Sequence[ArrayLike]) -> Array:
    table = np.empty((n, len(columns)))
    for k, column in enumerate(columns):
        table[:, k] = column
    return table


def _runs(table: Array) -> tuple[bytes, NDArray[np.int64]]:
    """The rows of a table (n, k) without those that repeat the row above, as bytes, and which of them each row is."""
    new = np.ones(len(table), np.bool_)
    np.any(table[1:] != table[:-1], axis=1, out=new[1:])
    return table[new].tobytes(), np.cumsum(new) - 1


def _find_annulus(rows: bytes, through: float, speed: float) -> Loss:
    outer, hole, eccentricity, *mud, density = np.frombuffer(rows).reshape(-1, 7).T
    displaced = np.pi * outer**2 * speed
    return annulus(outer, hole, Rheology(*mud), density, through + displaced, speed, eccentricity)


def _find_bore(rows: bytes, through: float) -> Array:
    inner, *mud, density = np.frombuffer(rows).reshape(-1, 5).T
    return bore(inner, Rheology(*mud), density, through).gradient


# The strings of a chart have the same few rows at most depths.
_annulus_of, _bore_of = lru_cache(maxsize=1024)(_find_annulus), lru_cache(maxsize=1024)(_find_bore)


def has_flow_curve(case: Case) -> bool:
    """Whether any mud of the case has friction."""
    muds = (case.mud, *case.mud.inside, *case.mud.outside)
    return any(curve.yield_stress or curve.consistency for mud in muds if (curve := mud.curve) is not None)


def flow_curves(case: Case, string: String) -> tuple[Rheology, Rheology]:
    """Flow curves inside and outside every segment (n,)."""
    middle = 0.5 * (string.above_bit[:-1] + string.above_bit[1:])
    fluids = string.fluids
    inside = along(case.mud, case.mud.inside, None if fluids is None else fluids.inside, middle)
    outside = along(case.mud, case.mud.outside, None if fluids is None else fluids.outside, middle)
    return inside, outside


def tool_drops(case: Case, string: String) -> Array:
    """Pressure drop of tools over the square of the flow (n,) [Pa s²/m⁶], each spread over its segments."""
    drops = np.zeros(string.segments)
    inside = case.mud.density if string.densities is None else string.densities[0]
    for k, part in enumerate(case.string.components):
        of = string.origin == k
        if part.pressure_drop and part.at_flow and of.any():
            share = np.where(of, string.length, 0.0) / string.length[of].sum()
            drops += share * part.pressure_drop * inside / (part.at_density * part.at_flow**2)
    return drops


def nozzles_of(case: Case) -> tuple[float, float]:
    """Area of the nozzles, infinite where the case gives none [m²], and their drop over that of an ideal flow."""
    return case.bit.nozzle_area or np.inf, 1 / case.bit.discharge**2


def end_of(case: Case) -> str:
    """The end of the string: "open", "closed", or with a "float"."""
    return case.end
