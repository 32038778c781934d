"""The free point of a stuck string, from how far it stretches or twists under a load that is added at the surface.

The string is laid out down to a depth, held there, and loaded as at both readings; the free point is the depth at which
its upper end moves as far as was measured.  Friction is in it, and so are the sides of the hole between which a string
moves as it is pulled tight.  Beside it stands what the drillers' formula finds: the same pipe bodies in a straight hole
without friction, L = ΔL·EA/ΔF and L = Δφ·GJ/ΔT, section by section.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from scipy.optimize import brentq

from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import Message, frame_of, quantity, within
from fctd.case.string import ComponentSpec
from fctd.case.units import FORCE, LENGTH, TORQUE, Dimension, argument, bare
from fctd.model.depths import depth_of
from fctd.model.operations import SteadyRates, steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.margins import swivel_of, weakest
from fctd.steady.steady_string import Equilibrium
from fctd.steady.stuck import StuckString, ends_of, stuck_string

if TYPE_CHECKING:
    import pandas as pd

STRETCH, TWIST = "stretch", "twist"
NEAR: Final = 0.1  # [m]: a free point is found within this; its strings are cut anew at every depth
SHALLOWEST: Final = 30.0  # [m] below the top of the string: a free point nearer to the rig is a slip of a reading
BESIDE: Final = 10.0  # [m]: places beside the free point, for what an error of the reading makes of it
MOST: Final = 1e9  # N, N m, m or turns: no reading is larger
Row = dict[str, Any]
# Columns of numbers, in the order of the table.
NUMBERS: Final = (
    "free_point_md_m", "straight_md_m", "per_percent_m", "first_hookload_N", "pull_N", "stretch_m", "first_force_N",
    "last_force_N", "first_torque_N_m", "torque_N_m", "turns", "first_arrived_N_m", "last_arrived_N_m",
)  # fmt: skip


@dataclass
class Held:
    """A string with its bit at a depth [m], whose free point is sought; kind : of how it is loaded."""

    solver: Solver
    kind: str
    rates: SteadyRates
    bit_depth: float

    def __post_init__(self) -> None:
        self.whole = self.solver.solve(self.kind, self.rates, self.bit_depth)
        if not self.whole.answered:
            raise InputError(
                f"a free string that is found (its status is {self.whole.status}: {within(self.whole.message)})",
                key="bit_depth", value=quantity(self.bit_depth, "m"),
            )  # fmt: skip

    def at(self, md: float) -> StuckString:
        """The string that is stuck at a depth [m]."""
        return stuck_string(self.solver, self.kind, self.rates, self.bit_depth, md, self.whole)

    def find(self, moved: Callable[[StuckString], float], measured: float) -> Row:
        """The depth [m] at which the upper end moves as far as measured, with a reason where there is none.

        moved : by how much that of a string moves between both readings, NaN where a reading has no steady string.
        """

        @cache
        def missing(md: float) -> float:
            return moved(self.at(md)) - measured

        top, bottom = self.solver.case.string.top_md + SHALLOWEST, self.bit_depth
        none: Row = {"free_point_md_m": np.nan, "per_percent_m": np.nan}
        least, most = missing(top), missing(bottom)
        if not np.isfinite([least, most]).all():
            return none | {"reason": "a reading has no steady string: check both loads"}
        if least > 0:
            return none | {
                "reason": Message(
                    f"{quantity(SHALLOWEST, 'm')} of string would move more under that load: check the readings"
                )
            }
        if most < 0:
            times = measured / (most + measured)
            return none | {"reason": f"a string that is stuck at its bit moves less, by a factor of {times:.3g}"}
        md = float(brentq(missing, top, bottom, xtol=NEAR))
        low, high = max(md - BESIDE, top), min(md + BESIDE, bottom)
        slope = (missing(high) - missing(low)) / (high - low)
        return {"free_point_md_m": md, "per_percent_m": 0.01 * measured / slope, "reason": "none"}


def free_point(
    case: Case,
    bit_depth: float | str = "td",
    *,
    pull: float | str | None = None,
    stretch: float | str | None = None,
    first_hookload: float | str | None = None,
    torque: float | str | None = None,
    turns: float | None = None,
    first_torque: float | str = 0.0,
    friction: FrictionChoice | None = None,
) -> pd.DataFrame:
    """The free point of a stuck string with its bit at a depth [m], a row for each pair of readings, SI.

    pull [N] : by how much more the hook was pulled between two marks, and ``stretch`` [m] : how far the pipe came up;
    first_hookload [N] : of the string at the first mark, by default that of the free string picking up.  torque [N m] :
    by how much it grew, and ``turns`` : of the pipe at the surface; first_torque [N m] : from which it grew.  Texts
    have units.  friction : None for the case's own.

    Columns: by (stretch or twist), bit_depth_m, free_point_md_m, straight_md_m (of the drillers' formula, below the bit
    where it finds more than the string), per_percent_m (depth for a hundredth more stretch or turns), first_hookload_N,
    pull_N, stretch_m, first_force_N and last_force_N (tensions that arrive at the free point), first_torque_N_m,
    torque_N_m, turns, first_arrived_N_m and last_arrived_N_m (torques there), and reason.  NaN where a number does not
    apply.  Raises InputError for unusable input.

        >>> case = fctd.load_case("examples/my_well.toml")
        >>> found = fctd.free_point(case, pull="200 kN", stretch="0.6 m").iloc[0]
        >>> round(found["free_point_md_m"]), round(found["straight_md_m"])
        (2305, 2111)
    """
    with naming_file(case):
        depth = depth_of(bit_depth, case, "bit_depth")
        solver = Solver(with_friction(case, friction))
        rows: list[Row] = []
        pulled = _pair("pull", pull, FORCE, "stretch", stretch)
        twisted = _pair("torque", torque, TORQUE, "turns", turns)
        if pulled is not None:
            first = None if first_hookload is None else _above_0("first_hookload", first_hookload, FORCE)
            rows.append(_by_stretch(_held(solver, "trip_out", depth), *pulled, first))
        elif first_hookload is not None:
            raise InputError("pull and stretch beside it", key="first_hookload", value=first_hookload)
        if twisted is not None:
            before = argument(first_torque, TORQUE, "first_torque")
            if not 0 <= before <= MOST:
                raise InputError("a torque of at least 0", key="first_torque", value=first_torque)
            held = _held(solver, "rotate_off_bottom", depth)
            if swivel := swivel_of(held.whole._shape.laid):
                raise InputError(f"none, since no torque passes the swivel above {swivel}", key="torque", value=torque)
            rows.append(_by_twist(held, *twisted, before))
        if not rows:
            raise InputError("pull and stretch, or torque and turns, that were measured", key="pull")
    return frame_of(rows)


def _pair(
    key: str, load: float | str | None, dimension: Dimension, beside: str, moved: float | str | None
) -> tuple[float, float] | None:
    """A load and what it moved, both above 0; None where neither is given."""
    if load is None and moved is None:
        return None
    if load is None or moved is None:
        raise InputError(f"{key} and {beside} together", key=key if load is None else beside)
    return _above_0(key, load, dimension), _above_0(beside, moved, None if beside == "turns" else LENGTH)


def _above_0(key: str, value: float | str, dimension: Dimension | None) -> float:
    found = bare(value, key, "a number of turns") if dimension is None else argument(value, dimension, key)
    if not 0 < found <= MOST:
        noun = "a number of turns" if dimension is None else dimension.noun
        raise InputError(f"{noun} above 0", key=key, value=value)
    return found


def _held(solver: Solver, kind: str, depth: float) -> Held:
    return Held(solver, kind, steady_rates(solver.case, kind)._replace(flow=0.0), depth)


def _by_stretch(held: Held, pull: float, stretch: float, first: float | None) -> Row:
    start = held.whole.hookload if first is None else first
    bears = weakest(held.whole._shape.laid, "tension")
    if start + pull > bears:
        expected = (
            f"less than the string bears, {quantity(bears / 1e3, 'kN', '.0f')}, with the "
            f"{quantity(start / 1e3, 'kN', '.0f')} before the pull"
        )
        raise InputError(expected, key="pull", value=quantity(pull / 1e3, "kN"))

    def marks(string: StuckString) -> list[tuple[float, Equilibrium]]:
        found = (string.at_hookload(load) for load in (start, start + pull))
        return [(np.nan, string.free) if one is None else one for one in found]

    def moved(string: StuckString) -> float:
        first, last = marks(string)
        return _lower_end(*last) - _lower_end(*first)

    found = held.find(moved, stretch)
    arrived = _arrived(held, found, lambda string: [force for force, _ in marks(string)])
    return _row(held, STRETCH, found) | {
        "straight_md_m": _straight(held, stretch / pull, _axial), "first_hookload_N": start, "pull_N": pull,
        "stretch_m": stretch, "first_force_N": arrived[0], "last_force_N": arrived[1],
    }  # fmt: skip


def _by_twist(held: Held, torque: float, turns: float, first: float) -> Row:
    bears = weakest(held.whole._shape.laid, "torsion")
    if first + torque > bears:
        expected = (
            f"less than the string bears, {quantity(bears / 1e3, 'kN*m', '.1f')}, with the "
            f"{quantity(first / 1e3, 'kN*m', '.1f')} before"
        )
        raise InputError(expected, key="torque", value=quantity(torque / 1e3, "kN*m"))

    def wound(string: StuckString, at: float) -> tuple[float, float]:
        """Turns of the upper end and torque at the lower one of a surface torque [N m]."""
        unloaded = string.pressed(0.0, 0.0)
        if unloaded.answered and at <= unloaded.surface_torque:  # friction takes all of it on the way down
            return _turns(unloaded, unloaded.surface_torque - at), 0.0
        met = string.at_torque(at)
        return (np.nan, np.nan) if met is None else (_turns(met[1]), met[0])

    def moved(string: StuckString) -> float:
        return wound(string, first + torque)[0] - wound(string, first)[0]

    found = held.find(moved, turns)
    if np.isnan(found["free_point_md_m"]) and first + torque <= held.whole.surface_torque:
        found["reason"] = Message(f"{within(found['reason'])}; friction takes that torque on its way to the bit")
    arrived = _arrived(held, found, lambda string: [wound(string, at)[1] for at in (first, first + torque)])
    return _row(held, TWIST, found) | {
        "straight_md_m": _straight(held, 2 * np.pi * turns / torque, _torsional), "first_torque_N_m": first,
        "torque_N_m": torque, "turns": turns, "first_arrived_N_m": arrived[0], "last_arrived_N_m": arrived[1],
    }  # fmt: skip


def _arrived(held: Held, found: Row, at: Callable[[StuckString], list[float]]) -> list[float]:
    """What arrives at the free point at both readings."""
    md = found["free_point_md_m"]
    return at(held.at(md)) if np.isfinite(md) else [np.nan, np.nan]


def _row(held: Held, by: str, found: Row) -> Row:
    of = dict.fromkeys(NUMBERS, np.nan)
    return {"by": by, "bit_depth_m": held.bit_depth, **of, **found}


def _lower_end(force: float, point: Equilibrium) -> float:
    """Where the lower end of a string is along the hole [m], with the stretch of half a segment below its last spring.

    A place that is fixed at the top moves at its lower end as far as the stuck string does at its top.
    """
    string = point._shape.laid.string
    return float(point._shape.walls.md[-1] + 0.5 * string.length[-1] * force / string.of("EA")[-1])


def _turns(point: Equilibrium, less: float = 0.0) -> float:
    """By how many turns a string is wound up, with so much less torque everywhere [N m], but none below 0."""
    torque = np.maximum(ends_of(point)[1] - less, 0.0)
    string = point._shape.laid.string
    return float(0.5 * (torque[1:] + torque[:-1]) @ (string.length / string.of("GJ"))) / (2 * np.pi)


def _axial(body: ComponentSpec) -> float:
    """EA of the body alone [N]."""
    return body.youngs_modulus * np.pi / 4 * (body.outer_diameter**2 - body.inner_diameter**2)


def _torsional(body: ComponentSpec) -> float:
    """GJ of the body alone [N m²]."""
    rigidity = body.youngs_modulus / (2 * (1 + body.poisson_ratio))
    return rigidity * np.pi / 32 * (body.outer_diameter**4 - body.inner_diameter**4)


def _straight(held: Held, compliance: float, stiffness: Callable[[ComponentSpec], float]) -> float:
    """The depth [m] down to which bodies in a straight hole move so much per unit of load, by their stiffness.

    Below the bit the lowest body goes on.
    """
    left, lengths = held.bit_depth - held.solver.case.string.top_md, []
    for body in held.solver.case.string.components:
        lengths.append(left if body.length is None else min(body.length, left))
        left -= lengths[-1]
    md, moved = held.bit_depth - sum(lengths), 0.0
    for body, length in reversed(list(zip(held.solver.case.string.components, lengths, strict=True))):
        within = min((compliance - moved) * stiffness(body), length)
        md, moved = md + within, moved + within / stiffness(body)
    return md + (compliance - moved) * stiffness(held.solver.case.string.components[0])
