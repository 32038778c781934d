"""Pressures of mud that is pumped: where they are lost, what the pumps need, and the density that the hole feels."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import Computed, InputError
from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.message import Message, frame_of, quantity, within
from fctd.case.rheology import Rheology
from fctd.case.units import FLOW, FLOW_UNITS, MOST_FLOW, Number, Quantity
from fctd.hydraulics.channel import Channel, channel_of, has_flow_curve
from fctd.hydraulics.circuit import Circuit, circulate
from fctd.hydraulics.closed_forms import REGIMES, bore
from fctd.hydraulics.cuttings import Cuttings, share_of_cuttings, transport_ratio
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.depths import depths_of
from fctd.model.drillstring import String, lay_out
from fctd.model.fluids import SAME_PLACE, depth_at
from fctd.model.pieces import TO_MD
from fctd.model.string_in_hole import check_fit
from fctd.model.wellbore import Wellbore, build_wellbore

if TYPE_CHECKING:
    import pandas as pd

PUMPED: Final = Quantity(dimension=FLOW, above=0.0, at_most=MOST_FLOW, likely_units=FLOW_UNITS)
SHARE: Final = Number(noun="a share", at_least=0.0, at_most=1.0)
Row = dict[str, Any]
Progress = Callable[[int, int], None]
# Offset of the pipe over its clearance, or what finds it for a case with the bit at a depth [m]: distances from the bit
# (n,) [m], falling, and the offsets there; None for that of the case.
Eccentricity = float | Callable[[Case, float], tuple[Array, Array]] | None


@dataclass(frozen=True)
class Laid:
    """A string in its hole for the flow of mud: its segments are cut where the hole changes.

    ends, depth (n + 1,) : measured and true vertical depths of its top and of the lower ends of its segments [m].
    """

    case: Case
    hole: Wellbore
    string: String
    channel: Channel

    @cached_property
    def ends(self) -> Array:
        return self.string.top_md + np.append(0.0, np.cumsum(self.string.length))

    @cached_property
    def depth(self) -> Array:
        return depth_at(self.hole, self.ends)

    @cached_property
    def interval(self) -> NDArray[np.int64]:
        """Index (n,) of the interval of the hole beside each segment."""
        middle = 0.5 * (self.ends[1:] + self.ends[:-1])
        return np.minimum(np.searchsorted(self.hole.intervals[:, TO_MD], middle), len(self.hole.intervals) - 1)

    @cached_property
    def shoe(self) -> int | None:
        """Index into ``ends`` of the last end of an interval above the bit, None where there is none."""
        changes = self.hole.intervals[:-1, TO_MD]
        found = np.flatnonzero((np.abs(self.ends[1:, None] - changes) < SAME_PLACE).any(axis=1))
        return int(found[-1]) + 1 if len(found) else None

    def at_rest(self, md: Array) -> Array:
        """Pressures (k,) outside at measured depths [Pa], of mud at rest."""
        depth, fluids = depth_at(self.hole, md), self.string.fluids
        if fluids is None:
            return self.case.mud.density * GRAVITY * depth
        return fluids.outside.pressure(self.string.bit_depth - md, depth, self.hole, self.string.bit_depth)


def lay(case: Case, bit_depth: float, eccentricity: Eccentricity = None) -> Laid:
    """A case's string with the bit at a depth [m]; eccentricity : offset of the pipe over its clearance, 0 to 1.

    Raises InputError where string and hole do not fit.
    """
    given = case.mud.eccentricity if eccentricity is None else eccentricity
    if isinstance(given, str):
        raise InputError('a number, or "string", where the string lies', key="eccentricity", value=given)
    if not callable(given):
        try:
            SHARE.parse(given)
        except InputError as error:
            raise error.at("eccentricity") from None
    hole, string = build_wellbore(case), lay_out(case, bit_depth)
    check_fit(string, hole, bit_depth)
    ends = string.top_md + np.cumsum(string.length)
    changes = hole.intervals[:-1, TO_MD]
    changes = changes[(changes > string.top_md + SAME_PLACE) & (changes < bit_depth - SAME_PLACE)]
    new = changes[(np.abs(changes[:, None] - ends) > SAME_PLACE).all(axis=1)]
    cut = np.sort(np.append(ends, new))
    cut[-1] = bit_depth
    owner = string.component[np.searchsorted(ends, cut - SAME_PLACE)]
    string = replace(string, length=np.diff(cut, prepend=string.top_md), component=owner)
    if callable(given):
        above, share = given(case, bit_depth)
        middle = 0.5 * (string.above_bit[1:] + string.above_bit[:-1])
        return Laid(case, hole, string, channel_of(case, string, hole, np.interp(-middle, -above, share)))
    return Laid(case, hole, string, channel_of(case, string, hole, given))


@dataclass(frozen=True)
class Circulation:
    """Mud that is pumped through a laid string: flow [m³/s], its circuit, and cuttings where any are asked for."""

    laid: Laid
    flow: float
    circuit: Circuit
    cuttings: Cuttings | None = None

    @property
    def surface(self) -> float:
        """Pressure lost in the surface lines [Pa]."""
        rig, (_, *mud, density) = self.laid.case.rig, self.laid.channel.bore[0].tolist()
        return float(bore(0.5 * rig.surface_bore, Rheology(*mud), density, self.flow).gradient) * rig.surface_length

    @cached_property
    def tools(self) -> Array:
        """Pressure drops (n,) of tools [Pa]."""
        return np.asarray(self.laid.channel.tools * self.flow**2)

    @cached_property
    def bores(self) -> Array:
        """Pressures (n,) lost in the bores of the segments [Pa]."""
        return self.laid.channel.inside(self.flow) - self.tools

    @property
    def standpipe(self) -> float:
        """Pressure of the pumps [Pa]: all that is lost, and what columns of unlike muds add or take."""
        return self.surface + float(self.circuit.inside[0]) + self.laid.channel.surface

    @cached_property
    def speeds(self) -> Array:
        """Mean speeds (n,) of the mud upwards in the annuli [m/s]."""
        outer, wall = self.laid.channel.annulus[:, :2].T
        return np.asarray(self.flow / (np.pi * (wall**2 - outer**2)))

    @cached_property
    def ratios(self) -> Array:
        """Transport ratios (n,) of the cuttings; NaN without any, and in steep hole."""
        if self.cuttings is None or self.flow <= 0:
            return np.full(self.laid.string.segments, np.nan)
        outer, wall, _, *mud, density = self.laid.channel.annulus.T
        middle = 0.5 * (self.laid.ends[1:] + self.laid.ends[:-1])
        tilt = self.laid.hole.inclination(middle)
        return transport_ratio(self.cuttings, Rheology(*mud), density, self.speeds, wall - outer, tilt)

    @cached_property
    def equivalent(self) -> Array:
        """Equivalent circulating densities (n + 1,) at the ends of the segments [kg/m³]; NaN at the surface."""
        laid, pressure = self.laid, self.laid.at_rest(self.laid.ends) + self.circuit.outside
        if self.cuttings is not None:
            area = np.pi * float(laid.channel.annulus[-1, 1]) ** 2
            share = share_of_cuttings(self.cuttings, self.ratios, area, self.flow)
            heavier = share * (self.cuttings.density - laid.channel.annulus[:, -1]) * GRAVITY * np.diff(laid.depth)
            pressure[1:] += np.cumsum(heavier)
        deep = laid.depth > SAME_PLACE
        return np.where(deep, pressure / (GRAVITY * np.where(deep, laid.depth, 1.0)), np.nan)

    def summary(self) -> Row:
        """The row of ``hydraulics_of``."""
        area = self.laid.case.bit.nozzle_area
        jets = self.flow / area if area else np.nan
        drop, standpipe = self.circuit.bit_drop, self.standpipe
        shoe = self.laid.shoe
        return {
            "flow_m3_s": self.flow, "bit_depth_m": self.laid.string.bit_depth, "standpipe_Pa": standpipe,
            "surface_drop_Pa": self.surface, "bore_drop_Pa": float(self.bores.sum()),
            "tool_drop_Pa": float(self.tools.sum()), "bit_drop_Pa": drop,
            "annulus_drop_Pa": float(self.circuit.outside[-1]),
            "ecd_shoe_kg_m3": np.nan if shoe is None else float(self.equivalent[shoe]),
            "ecd_bit_kg_m3": float(self.equivalent[-1]),
            "bit_power_W": drop * self.flow, "pump_power_W": standpipe * self.flow,
            "impact_force_N": float(self.laid.channel.bore[-1, -1]) * self.flow * jets, "jet_speed_m_s": jets,
            "lift_N": self.circuit.lift, "reason": "none",
        }  # fmt: skip

    def parts(self) -> list[Row]:
        """The rows of ``pressure_parts``: surface lines, bores and tools down to the bit, annuli up from it."""
        laid, components = self.laid, self.laid.case.string.components
        rows = [self._row("surface", "", 0.0, laid.string.top_md, self.surface)]
        inside = _runs(laid.string.origin)
        for first, last in inside:
            name = components[laid.string.origin[first]].name
            ends = float(laid.ends[first]), float(laid.ends[last + 1])
            rows.append(self._row("bore", name, *ends, float(self.bores[first : last + 1].sum())))
            if (tool := float(self.tools[first : last + 1].sum())) > 0:
                rows.append(self._row("tool", name, *ends, tool))
        rows.append(self._row("bit", "", laid.string.bit_depth, laid.string.bit_depth, self.circuit.bit_drop))
        for first, last in reversed(_runs(laid.string.origin * len(laid.hole.intervals) + laid.interval)):
            of, lost = slice(first, last + 1), np.diff(self.circuit.outside)
            rows.append(
                self._row(
                    "annulus", components[laid.string.origin[first]].name, float(laid.ends[first]),
                    float(laid.ends[last + 1]), float(lost[of].sum()),
                )
                | {
                    "interval": int(laid.interval[first]) + 1,
                    "speed_m_s": float(np.average(self.speeds[of], weights=laid.string.length[of])),
                    "regime": REGIMES[int(self.circuit.annulus.regime[of].max())],
                    "ecd_kg_m3": float(self.equivalent[last + 1]),
                    "transport_ratio": min(self.ratios[of][~np.isnan(self.ratios[of])].tolist(), default=np.nan),
                }
            )  # fmt: skip
        return rows

    def _row(self, part: str, name: str, top: float, bottom: float, drop: float) -> Row:
        return {
            "flow_m3_s": self.flow, "bit_depth_m": self.laid.string.bit_depth, "part": part, "name": name,
            "interval": 0, "from_md_m": round(top, 6), "to_md_m": round(bottom, 6), "pressure_drop_Pa": drop,
            "speed_m_s": np.nan, "regime": "", "ecd_kg_m3": np.nan, "transport_ratio": np.nan,
        }  # fmt: skip


def _runs(values: Array | NDArray[np.int64]) -> list[tuple[int, int]]:
    """First and last index of every run of equal values."""
    starts = np.flatnonzero(np.diff(values, prepend=values[0] - 1))
    return list(zip(starts.tolist(), [*(starts[1:] - 1).tolist(), len(values) - 1], strict=True))


def circulation(
    case: Case, flow: float, bit_depth: float, eccentricity: Eccentricity = None, cuttings: Cuttings | None = None
) -> Circulation:
    """Mud that is pumped [m³/s] with the bit at a depth [m].

    Raises InputError where string and hole do not fit, and for a flow at which the mud inside falls freely.
    """
    laid = lay(case, bit_depth, eccentricity)
    solid = np.flatnonzero(laid.channel.bore[:, 0] <= 0)
    if flow > 0 and len(solid):
        key = f"{laid.string.key_of(int(solid[0]))}.inner_diameter"
        raise InputError("a bore above 0 with a flow through it", key=key, value=0.0)
    if (falling := laid.channel.free_fall(flow)) is not None:
        rate = quantity(6e4 * min(falling, MOST_FLOW), "L/min", ".0f")
        expected = f"more than {rate}, at which the denser fluid inside falls freely"
        raise InputError(expected, key="flow", value=Computed(quantity(6e4 * flow, "L/min", ".4g")))
    return Circulation(laid, flow, circulate(laid.channel, flow), cuttings)


def check_flows(case: Case) -> None:
    """Raise InputError for a mud of whose flow the case says nothing, and where none has friction."""
    mud = case.mud
    rows = (mud.inside or (mud,)) + (mud.outside or (mud,))
    if mud.curve is None and any(row.curve is None for row in rows):
        raise InputError(
            "readings of a viscometer such as {600 = 60, 300 = 40}, a table [mud.rheology], or mud.viscosity: the mud "
            "has no friction without them",
            key="mud.fann",
        )
    if not has_flow_curve(case):
        raise InputError("above 0, or mud.fann or mud.rheology: nothing has friction", key="mud.viscosity", value=0.0)


def circulations(
    case: Case, flows: Sequence[float], bit_depths: Sequence[float], eccentricity: Eccentricity = None,
    cuttings: Cuttings | None = None, progress: Progress | None = None,
) -> list[Circulation | Row]:  # fmt: skip
    """The circulation of every flow and bit depth, or a row with the reason where string and hole do not fit.

    Raises InputError where they fit at none of the depths.
    """
    check_flows(case)
    found: list[Circulation | Row] = []
    unfit: list[InputError] = []
    for flow in flows:
        for depth in bit_depths:
            try:
                check_bit_depth(depth, *case.depths, "bit_depths", quantity(depth, "m"))
                found.append(circulation(case, flow, depth, eccentricity, cuttings))
            except InputError as error:
                unfit.append(error)
                found.append(
                    {
                        "flow_m3_s": flow,
                        "bit_depth_m": depth,
                        "reason": Message(f"not_possible: {within(error.message)}"),
                    }
                )
            if progress is not None:
                progress(len(found), len(flows) * len(bit_depths))
    if len(unfit) == len(found):
        raise unfit[0]
    return found


def hydraulics_of(
    case: Case,
    flow: float | str | Sequence[float | str],
    bit_depths: float | str | Sequence[float | str] = (),
    eccentricity: Eccentricity = None,
    cuttings: Cuttings | None = None,
) -> pd.DataFrame:
    """A row for every flow and bit depth, SI: what the pumps need, and where it is lost.

    flow [m³/s], or texts with units.  bit_depths [m], or texts; without any the depth of the hole.  eccentricity :
    offset of the pipe over its clearance, 0 to 1, or ``fctd.lie_along``; without it that of the case.  cuttings :
    whose weight counts in the density.

    Columns: flow_m3_s, bit_depth_m, standpipe_Pa, surface_drop_Pa, bore_drop_Pa, tool_drop_Pa, bit_drop_Pa,
    annulus_drop_Pa, ecd_shoe_kg_m3 (at the last end of an interval above the bit), ecd_bit_kg_m3, bit_power_W,
    pump_power_W, impact_force_N, jet_speed_m_s, lift_N (that the flow takes off a vertical string), and reason.

    Raises InputError for unusable input, and where string and hole fit at none of the depths.

        >>> case = fctd.load_case("examples/pumped_well.toml")
        >>> lost = fctd.hydraulics_of(case, "2000 L/min")
        >>> round(lost["standpipe_Pa"][0] / 1e5)
        186
    """
    with naming_file(case):
        given = [flow] if isinstance(flow, str | float | int) else list(flow)
        flows = [_flow(one) for one in given]
        depths = depths_of(bit_depths, case, "bit_depths") if np.size(bit_depths) else [case.deepest]
        found = circulations(case, flows, depths, eccentricity, cuttings)
        return frame_of([of.summary() if isinstance(of, Circulation) else of for of in found])


def _flow(value: float | str) -> float:
    try:
        return PUMPED.parse(value)
    except InputError as error:
        raise error.at("flow") from None
