"""Pressures of mud that a moving string displaces: surge and swab, and the fastest trip that the hole bears."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import InputError
from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.message import Message, frame_of, quantity, within
from fctd.case.operation_names import kinds_of
from fctd.case.operations import KINDS
from fctd.case.units import MOST_FLOW, SPEED, argument, unit_hint
from fctd.hydraulics.circuit import Circuit, circulate
from fctd.hydraulics.closed_forms import REGIMES
from fctd.hydraulics.pressures import Eccentricity, Laid, Progress, Row, check_flows, lay
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.depths import depths_of
from fctd.model.fluids import depth_at
from fctd.model.string_in_hole import check_end

if TYPE_CHECKING:
    import pandas as pd

TRIPS: Final = ("trip_in", "trip_out")
ENDS: Final = ("open", "closed", "float")
FASTEST: Final = 2.0  # [m/s]: trips are not faster than the hoist
SLOWEST: Final = 1e-3  # [m/s]: what is slower is no trip
PLACES: Final = 200  # along the open hole, at which the window is looked at
HALVINGS: Final = 20  # of the range of speeds


@dataclass(frozen=True)
class Trip:
    """A string that moves without pumps: its direction, 1 down and −1 up, and its end."""

    laid: Laid
    direction: int
    end: str

    def moved(self, speed: float) -> Circuit:
        """The flow that the string displaces at a speed [m/s]."""
        return circulate(self.laid.channel, 0.0, self.direction * speed, self.end)

    @cached_property
    def window(self) -> tuple[Array, Array, Array, Array]:
        """Depths (k,) of the open hole [m], pressures of mud at rest, of pores and of fractures there [Pa]."""
        case, hole = self.laid.case, self.laid.hole
        bottom = min(case.depths[1], hole.total_depth)
        md = np.linspace(max((shoe for shoe in case.shoes if shoe < bottom), default=0.0), bottom, PLACES)
        md = md[md > 0]  # at the table a window has no width, and rounding would leave it
        depth, rows = depth_at(hole, md), case.wellbore.window
        tvd = [row.tvd for row in rows]
        pore, fracture = (
            GRAVITY * depth * np.interp(depth, tvd, [getattr(row, side) for row in rows])
            for side in ("pore", "fracture")
        )
        return md, self.laid.at_rest(md), pore, fracture

    def left(self, speed: float) -> tuple[float, float]:
        """The least that is left of the window at a speed [m/s], negative beyond it [Pa], and its depth [m]."""
        md, rest, pore, fracture = self.window
        change = np.zeros(len(md))
        if speed > 0:
            change = self.moved(speed).pressures(np.maximum(self.laid.string.bit_depth - md, 0.0))[1]
        left = np.minimum(rest + change - pore, fracture - rest - change)
        k = int(np.argmin(left))
        return float(left[k]), float(md[k])

    def fastest(self, most: float) -> tuple[float, float, str]:
        """The fastest speed within the window up to a limit [m/s], the depth that sets it [m], and a reason for 0."""
        for speed, reason in ((0.0, "mud at rest is outside the window"), (SLOWEST, "yield stress of the mud alone")):
            left, md = self.left(speed)
            if left < 0:
                return 0.0, md, reason
        if self.left(most)[0] >= 0:
            return most, np.nan, "none"
        low, high = SLOWEST, most
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.left(middle)[0] >= 0 else (low, middle)
        return low, self.left(high)[1], "none"


def trips_at(
    case: Case, bit_depth: float, operation: Sequence[str], end: Sequence[str], eccentricity: Eccentricity
) -> list[Trip]:
    """The trips of kinds and ends with the bit at a depth [m].

    Raises InputError where string and hole do not fit, and for fluid that falls freely through an end.
    """
    laid = lay(case, bit_depth, eccentricity)
    check_end(laid.string, laid.hole)
    unheld = next((one for one in end if one != "closed"), None)
    if unheld is not None and (rate := laid.channel.free_fall(0.0)) is not None:
        falls = quantity(6e4 * min(rate, MOST_FLOW), "L/min", ".0f")
        raise InputError(f'"closed", as the denser fluid inside falls freely at {falls}', key="end", value=unheld)
    return [Trip(laid, KINDS[kind].direction, one) for kind in operation for one in end]


def surge_pressures(
    case: Case,
    speeds: float | str | Sequence[float | str],
    bit_depths: float | str | Sequence[float | str] = (),
    operation: str | Sequence[str] = TRIPS,
    end: str | Sequence[str] = (),
    eccentricity: Eccentricity = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """A row for every operation, end, speed and bit depth, SI: what a trip at constant speed adds to the pressure.

    speeds [m/s], bit_depths [m], or texts with units; without depths that of the hole.  operation : trip_in or
    trip_out; end : "open", "closed" or "float", by default that of the case.  eccentricity : see ``hydraulics_of``.

    Columns: operation, end, speed_m_s, bit_depth_m, surge_Pa at the bit (negative for a swab), shoe_surge_Pa at the
    last end of an interval above the bit, density_bit_kg_m3 (equivalent, of mud at rest and surge), into_bore_m3_s
    (through the bit), regime (the most turbulent along the annulus), lift_N (of a vertical string), and
    reason.  Raises InputError for unusable input, and where string and hole fit at none of the depths.

        >>> case = fctd.load_case("examples/pumped_well.toml")
        >>> run_in = fctd.surge_pressures(case, ["0.5 m/s"], [3000], "trip_in", "closed")
        >>> round(float(run_in["surge_Pa"].iloc[0]) / 1e5, 1)
        11.5
    """
    with naming_file(case):
        given = [speeds] if isinstance(speeds, str | float | int) else list(speeds)
        rates = [argument(speed, SPEED, "speeds") for speed in given]
        for speed, rate in zip(given, rates, strict=True):
            if not 0 <= rate <= units.FASTEST:
                hint = "" if isinstance(speed, str) else unit_hint(rate, units.A_MINUTE)
                raise InputError(f"a speed of 0 to {quantity(units.FASTEST, 'm/s')}{hint}", key="speeds", value=speed)
        asked = _asked(case, bit_depths, operation, end, eccentricity)
        rows: list[Row] = []
        for trips, depth, reason in _laid(case, *asked, progress):
            named = [(kind, one) for kind in asked[1] for one in asked[2]]
            for k, (kind, one) in enumerate(named):
                for speed in rates:
                    row = {"operation": kind, "end": one, "speed_m_s": speed, "bit_depth_m": depth}
                    rows.append(row | (_moved(trips[k], speed) if trips else {}) | {"reason": reason})
    return frame_of(rows)


def fastest_trips(
    case: Case,
    bit_depths: float | str | Sequence[float | str] = (),
    operation: str | Sequence[str] = TRIPS,
    end: str | Sequence[str] = (),
    eccentricity: Eccentricity = None,
    most: float | str = FASTEST,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """A row for every operation, end and bit depth, SI: the fastest trip within the window of the hole.

    The arguments are those of ``surge_pressures``; most : speed of the hoist [m/s].  The open hole, from the last shoe
    to its end, is looked at, also below the bit, where pressure changes as at the bit.

    Columns: operation, end, bit_depth_m, fastest_m_s (0 where none is possible), md_m (where the window ends, NaN where
    the hoist sets the speed), time_s (of the trip between the first depth and this one, with the connections of
    [rig]), and reason.  Raises InputError, also for a case without a window.

        >>> case = fctd.load_case("examples/pumped_well.toml")
        >>> round(float(fctd.fastest_trips(case, [3000], "trip_out", "closed")["fastest_m_s"].iloc[0]), 2)
        0.64
    """
    with naming_file(case):
        if not case.wellbore.window:
            raise InputError("rows of tvd, pore and fracture, within which a trip stays", key="wellbore.window")
        hoist = argument(most, SPEED, "most")
        asked = _asked(case, bit_depths, operation, end, eccentricity)
        rows: list[Row] = []
        for trips, depth, reason in _laid(case, *asked, progress):
            named = [(kind, one) for kind in asked[1] for one in asked[2]]
            for k, (kind, one) in enumerate(named):
                speed, md, why = trips[k].fastest(hoist) if trips else (np.nan, np.nan, reason)
                row = {"operation": kind, "end": one, "bit_depth_m": depth, "fastest_m_s": speed, "md_m": md}
                rows.append(row | {"time_s": np.nan, "reason": why})
        table = frame_of(rows)
        for _, of in table.groupby(["operation", "end"], sort=False):
            table.loc[of.index, "time_s"] = _time(case, of["bit_depth_m"].to_numpy(), of["fastest_m_s"].to_numpy())
    return table


def _time(case: Case, depth: Array, speed: Array) -> Array:
    """Time from the first depth to each (n,) [s], at the mean slowness between depths, and connections; NaN beyond a
    depth without a trip."""
    slowness = np.divide(1.0, speed, out=np.full(len(speed), np.nan), where=speed > 0)
    moving = np.diff(depth) * 0.5 * (slowness[1:] + slowness[:-1])
    connections = np.diff(depth) / case.rig.stand_length * case.rig.connection_time
    return np.append(0.0, np.cumsum(moving + connections))


def _asked(
    case: Case, bit_depths: float | str | Sequence[float | str], operation: str | Sequence[str],
    end: str | Sequence[str], eccentricity: Eccentricity,
) -> tuple[list[float], list[str], list[str], Eccentricity]:  # fmt: skip
    """Depths [m], operations, ends and eccentricity that are asked for, checked."""
    check_flows(case)
    depths = depths_of(bit_depths, case, "bit_depths") if np.size(bit_depths) else [case.deepest]
    kinds = kinds_of(operation)
    ends = [end] if isinstance(end, str) else list(end) or [case.end]
    for key, given, known in (("operation", kinds, TRIPS), ("end", ends, ENDS)):
        for one in given:
            if one not in known:
                raise InputError(" or ".join(f'"{word}"' for word in known), key=key, value=one)
    return depths, kinds, ends, eccentricity


def _laid(
    case: Case,
    depths: list[float],
    kinds: list[str],
    ends: list[str],
    eccentricity: Eccentricity,
    progress: Progress | None,
) -> list[tuple[list[Trip], float, str]]:
    """The trips at every depth, or none and the reason; raises InputError where string and hole fit at no depth."""
    found: list[tuple[list[Trip], float, str]] = []
    unfit: list[InputError] = []
    for depth in depths:
        try:
            check_bit_depth(depth, *case.depths, "bit_depths", quantity(depth, "m"))
            found.append((trips_at(case, depth, kinds, ends, eccentricity), depth, "none"))
        except InputError as error:
            unfit.append(error)
            found.append(([], depth, Message(f"not_possible: {within(error.message)}")))
        if progress is not None:
            progress(len(found), len(depths))
    if len(unfit) == len(depths):
        raise unfit[0]
    return found


def _moved(trip: Trip, speed: float) -> Row:
    circuit, laid = trip.moved(speed), trip.laid
    surge, depth = float(circuit.outside[-1]), float(laid.depth[-1])
    rest = float(laid.at_rest(laid.ends[-1:])[0])
    return {
        "surge_Pa": surge, "shoe_surge_Pa": np.nan if laid.shoe is None else float(circuit.outside[laid.shoe]),
        "density_bit_kg_m3": (rest + surge) / (GRAVITY * depth) if depth > 0 else np.nan,
        "into_bore_m3_s": -circuit.bore_flow, "regime": REGIMES[int(circuit.annulus.regime.max())],
        "lift_N": circuit.lift,
    }  # fmt: skip
