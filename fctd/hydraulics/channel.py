"""What the mud of a laid-out string flows through, and its losses there at a flow out of the bit.

Tool joints that are not laid out as segments of their own narrow neither annulus nor bore.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.rheology import FlowSpec, Rheology
from fctd.case.units import MOST_FLOW
from fctd.hydraulics.closed_forms import Loss, annulus, bore
from fctd.model.drillstring import String
from fctd.model.fluids import EQUAL, Column
from fctd.model.mud import hole_radius
from fctd.model.wellbore import Wellbore

FRICTIONLESS = Rheology.newtonian(0.0)
# Short tools that fill more of the hole's diameter are bits and stabilisers, which let mud pass between their blades;
# pipe is taken to leave at least a gap.
BLADED, FULLEST = 0.9, 0.98
# Within so much of the flow that the string displaces the flow through an open bore is known.
SHARED = 1e-10
# Number of flows through an open bore between whose pressures the flow is looked for; of finer tables.
FLOWS, FINER = 257, 2
# Column of the rows of annuli; that of bores is two to the left.
YIELD_STRESS = 3


@dataclass(frozen=True)
class Channel:
    """What the mud of a laid-out string flows through, segments (n,) from the top down.

    above : distances from the bit (n + 1,) [m]; length [m]; wet : of it, with mud around [m]; annulus : rows of radii
    of pipe and hole [m], eccentricity, yield stress, consistency, index and density of the mud; bore : rows of radius,
    yield stress, consistency, index and density; tools : pressure drop over the square of the flow [Pa s²/m⁶];
    nozzles : their area, infinite where the case gives none [m²], and what their drop is over that of an ideal flow;
    end : of the string, "open", "closed" or "float", which lets mud out alone, "plugged", or "packed", which is open
    below a packer; of mud at rest heavier : by how much the pressure outside is larger at the end, surface : the
    pressure inside at the surface [Pa].
    """

    above: Array
    length: Array
    wet: Array
    annulus: Array
    bore: Array
    tools: Array
    nozzles: tuple[float, float]
    end: str
    heavier: float = 0.0
    surface: float = 0.0

    @property
    def overweight(self) -> float:
        """By how much the fluids inside alone press more on the end than those outside, at rest [Pa]."""
        return -(self.heavier + self.surface)

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

    def bit_drop(self, through: Any) -> Any:
        """Pressure from the bore to the annulus at a flow out of the bit [Pa]."""
        area, worse = self.nozzles
        return 0.5 * float(self.bore[-1, -1]) * worse * through * abs(through) / area**2

    def out_of_bit(self, flow: float, speed: float, end: str) -> float:
        """Flow out of the bit [m³/s] while mud is pumped, or displaced at a speed downwards [m/s].

        Raises InputError for a flow through a closed end, or below a packer.
        """
        if flow > 0 and end == "closed":
            raise InputError('"open" or "float" with a flow through it', key="bit.end", value=end)
        if flow > 0 and end == "plugged":
            raise InputError("false with a flow through the string", key="mud.inside.plug", value=True)
        if flow > 0 and end == "packed":
            raise InputError("left out with a flow, as no mud returns past the packer", key="mud.packer_bore")
        if flow > 0 or speed == 0 or end in ("closed", "plugged") or (end == "float" and speed > 0):
            return flow
        held = self.held(end)
        if held and float(self.outside(0.0, speed).gradient @ self.wet) + held >= 0:
            return 0.0  # the swab does not open the float
        return self._shared(speed, held)

    def held(self, end: str) -> float:
        """Pressure that a float bears at rest [Pa], which a swab must overcome before it opens; else 0."""
        return max(self.heavier, 0.0) if end == "float" else 0.0

    def free_fall(self, flow: float) -> float | None:
        """Flow at which the fluid inside falls freely through the end [m³/s]; None where pumps, at a flow, hold it.

        The weight of a column that is heavier than that outside drives the flow, and friction, tools and nozzles hold
        it back.  It is infinite where they do not hold it at ``MOST_FLOW``, as without a flow curve.
        """
        if self.end in ("closed", "plugged") or self.overweight <= (0.0 if flow > 0 else EQUAL):
            return None
        if self._of_pumps(flow) >= 0:
            return None
        from scipy.optimize import brentq  # slow to import, and columns of equal weight need none

        if self._of_pumps(MOST_FLOW) < 0:
            return math.inf
        return float(brentq(self._of_pumps, flow, MOST_FLOW, rtol=SHARED))

    def _of_pumps(self, flow: float) -> float:
        """Pressure at the top of the bore that a flow out of the bit needs [Pa]; that at rest is left out."""
        lost = self.inside(flow).sum() + self.outside(flow, 0.0).gradient @ self.wet + self.bit_drop(flow)
        return float(lost) - self.overweight

    def _shared(self, speed: float, held: float) -> float:
        """Flow out of an open bit [m³/s] with which the pressures there are equal, while the string displaces mud.

        held : pressure outside less that inside at rest [Pa].

        It is looked for between the flows of a table, and of finer ones for muds with a yield stress, whose gradients
        rise steeply from rest; between two flows the gradients are taken as straight.
        """
        from scipy.optimize import brentq  # slow to import, and mud at rest needs none

        (outside, run), (inside, of_bore) = self._annulus, self._bore
        around, within = np.bincount(run, self.wet), np.bincount(of_bore, self.length)
        tools = float(self.tools.sum())
        yields = self.annulus[:, YIELD_STRESS].any() or self.bore[:, YIELD_STRESS - 2].any()
        # The annulus is left by less than the string displaces and half of what would move with its wall.
        most = 0.5 * np.pi * float((self.annulus[:, :2] ** 2).sum(axis=1).max()) * speed
        low, high = 0.0, -most
        for k in range(1 + FINER * bool(yields)):
            flows, *gradients = (_table_of_flows if k == 0 else _find_table)(outside, inside, low, high, speed)
            lost = gradients[0] @ around + gradients[1] @ within
            higher = held + lost + tools * flows * np.abs(flows) + self.bit_drop(flows)  # outside than inside
            at = min(max(int(np.argmax(higher * speed <= 0)), 1), len(flows) - 1)
            low, high = flows[at - 1 : at + 1].tolist()
        below, above = lost[at - 1 : at + 1].tolist()

        def between(through: float) -> float:
            straight = below + (above - below) * (through - low) / (high - low)
            return float(held + straight + tools * through * abs(through) + self.bit_drop(through))

        return float(brentq(between, low, high, xtol=SHARED * abs(most), rtol=SHARED))

    def thrust(self, through: float) -> Array:
        """Thrust upwards on each segment (n,) [N] of mud that is pumped and speeds up at its lower end."""
        bores = np.pi * self.bore[:, 0] ** 2
        area = np.append(bores, min(self.nozzles[0], bores[-1]))
        return np.asarray(self.bore[:, -1] * through**2 * np.diff(1 / area))


def has_flow_curve(case: Case) -> bool:
    """Whether a case says how its mud flows, in or around the string."""
    mud = case.mud
    return mud.resists or any(row.resists for rows in (mud.inside, mud.outside) for row in rows)


def flow_curves(case: Case, string: String) -> tuple[Rheology, Rheology]:
    """Flow curves inside and outside every segment (n,), those halfway along it.

    A row of fluid that says nothing of its flow has the curve of the mud, and a mud that says nothing has no friction.
    """
    middle, fluids, mud = 0.5 * (string.above_bit[:-1] + string.above_bit[1:]), string.fluids, case.mud

    def along(rows: Sequence[FlowSpec], column: Column | None) -> Rheology:
        curves = [row.curve or mud.curve or FRICTIONLESS for row in rows or (mud,)]
        index = np.zeros(len(middle), int) if column is None else column.row_of(middle)
        return Rheology(*np.array(curves, float)[index].T)

    inside, outside = (None, None) if fluids is None else (fluids.inside, fluids.outside)
    return along(mud.inside, inside), along(mud.outside, outside)


def channel_of(case: Case, string: String, hole: Wellbore, eccentricity: float | Array = 0.0) -> Channel:
    """The channel of a laid-out string; eccentricity (n,) : offset of the pipe over its clearance, 0 to 1."""
    n, length, wide = string.segments, string.length, hole_radius(hole, string.top_md, string.length)
    inside, outside = flow_curves(case, string)
    densities = string.densities or (case.mud.density, case.mud.density)
    bottom, (outer, inner) = string.top_md + np.cumsum(length), string.channel_radii
    bladed = (string.of("point") != 0) & (string.of("tool_joint") == 0) & (outer > BLADED * wide)
    wet = np.where(bladed, 0.0, np.clip(bottom, 0.0, length))
    around = (np.minimum(outer, FULLEST * wide), wide, eccentricity, *outside, densities[1])
    within, packed = (inner, *inside, densities[0]), case.mud.packer_bore is not None
    return Channel(
        string.above_bit, length, wet, _table(n, around), _table(n, within),
        _tools(string, densities[0]), (case.bit.nozzle_area or np.inf, case.bit.discharge**-2),
        "plugged" if any(row.plug for row in case.mud.inside) else "packed" if packed else case.end,
        _heavier(string, hole, packed),
        0.0 if string.fluids is None else string.fluids.inside.surface,
    )  # fmt: skip


def _heavier(string: String, hole: Wellbore, packed: bool) -> float:
    """Pressure outside less that inside at the end of a string, of mud at rest [Pa]."""
    if string.fluids is None or packed:  # a packer keeps both sides apart
        return 0.0
    inside, outside = string.fluids.at_end(hole, string.bit_depth)
    return outside - inside


def _tools(string: String, density: Array | float) -> Array:
    """Pressure drop of the tools in each segment over the square of the flow (n,) [Pa s²/m⁶], spread along a tool.

    density : of the mud inside [kg/m³].
    """
    drops = np.zeros(string.segments)
    for k, part in enumerate(string.parts):
        tool = part.component
        if tool.pressure_drop is not None and tool.at_flow is not None:
            laid = np.where(string.origin == part.origin, string.length, 0.0)
            each = np.where(string.component == k, laid, 0.0) / laid.sum()
            drops += tool.pressure_drop / tool.at_flow**2 * (density / tool.at_density) * each
    return drops


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


def _find_annulus(rows: bytes, through: float | Array, speed: float) -> Loss:
    outer, hole, eccentricity, *mud, density = np.frombuffer(rows).reshape(-1, 7).T
    displaced = np.pi * outer**2 * speed
    return annulus(outer, hole, Rheology(*mud), density, through + displaced, speed, eccentricity)


def _find_bore(rows: bytes, through: float | Array) -> Array:
    inner, *mud, density = np.frombuffer(rows).reshape(-1, 5).T
    return bore(inner, Rheology(*mud), density, through).gradient


def _find_table(outside: bytes, inside: bytes, low: float, high: float, speed: float) -> tuple[Array, Array, Array]:
    """Flows (m,) out of the bit between two [m³/s], and the gradients of annulus and bore at each [Pa/m]."""
    flows = np.linspace(low, high, FLOWS)
    through = flows[:, None]
    return flows, _find_annulus(outside, through, speed).gradient, _find_bore(inside, through)


# The strings of a chart have the same few rows at most depths.
_annulus_of, _bore_of = lru_cache(maxsize=1024)(_find_annulus), lru_cache(maxsize=1024)(_find_bore)
_table_of_flows = lru_cache(maxsize=64)(_find_table)
