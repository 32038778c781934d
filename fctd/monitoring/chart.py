"""Loads of the steady string over bit depth and friction factor: solved at nodes when needed, and interpolated."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet, Pair, changed, table_of
from fctd.case.load import Case
from fctd.case.operations import KINDS as OPERATIONS
from fctd.hydraulics.channel import has_flow_curve
from fctd.model.operations import drive_torque, rad_per_s, rates_of_all, string_load, weight_indicator
from fctd.model.section import section_of
from fctd.model.wellbore import build_wellbore
from fctd.monitoring.stretches import OF_KIND, Mode
from fctd.steady.equilibrium import Solver

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

Fit = Literal["open", "cased", "all"]

FACTORS: Final = np.array([0.0, 0.1, 0.2, 0.3, 0.45, 0.65])
# [m] between bit depths: within half of it hook load changes by less than 100 N, a hundredth of its noise.  Linear
# interpolation over a stand is worse: loads of a string in segments ripple with the place of its joints.
NODES: Final = 0.5
OF_BLOCK: Final = 0.1  # of the string's weight: a load that exceeds the block's by less is the block's
COARSE: Final = 120.0  # [m] between bit depths of the loads that the rules of stretches need
HELD: Final = 2  # place of the factor at which the derivative by the held one is taken
CASED_STEP: Final = 0.05  # of the held factor, for the derivative by it
KIND_OF: Final[Mapping[Mode, str]] = {mode: kind for kind, mode in OF_KIND.items()} | {
    "rotating_up": "rotate_off_bottom", "rotating_down": "rotate_off_bottom",
}  # fmt: skip


class Inverse(NamedTuple):
    """A friction factor, and its derivative by the reading [1/N or 1/(N m)]."""

    factor: float
    per_reading: float


class Relief(NamedTuple):
    """What a flow of mud takes off the hook load [N], and the share of the rotating torque that it leaves."""

    lift: float
    torque_share: float


NOTHING: Final = Relief(0.0, 1.0)


def fit_of(case: Case, fit: Fit | None) -> Fit:
    """The intervals whose factor is inferred: open hole where the case names kinds, else all."""
    kinds = {interval.kind for interval in case.wellbore.intervals}
    if fit is None:
        return "open" if "open" in kinds and None not in kinds else "all"
    if fit not in ("open", "cased", "all"):
        raise InputError("open, cased or all", key="fit", value=fit)
    if fit != "all":
        FrictionSet(**{fit: 0.0}).of(case.wellbore.intervals)  # raises InputError for kinds that are not there
    return fit


def _sliding(case: Case) -> Case:
    """The case whose trips slide, as strokes of a series do: one that turns is read as rotation."""
    turned = [of for of in case.operations if of.rpm and not OPERATIONS[of.kind].turns]
    slid = [of.model_copy(update={"rpm": 0.0}) if of in turned else of for of in case.operations]
    return case.model_copy(update={"operations": tuple(slid)}) if turned else case


class Chart:
    """Readings of the rig for the operations of a case at any bit depth, by the friction factor of some intervals.

    fit : the intervals; the others keep the factors of the case.  The factor is interpolated by Fritsch and Carlson's
    monotone cubics (1980) over the load; the load is that of the nearest of depths `NODES` apart.
    """

    def __init__(self, case: Case, fit: Fit | None = None) -> None:
        self.case, self.fit = (case := _sliding(case)), fit_of(case, fit)
        self.deepest = case.depths[1]
        hole = build_wellbore(case)
        intervals = case.wellbore.intervals

        def solver(factors: tuple[Pair, ...]) -> Solver:
            own = changed(intervals, factors)
            wellbore = case.wellbore.model_copy(update={"intervals": own})
            return Solver(case.model_copy(update={"wellbore": wellbore}), hole.with_friction(table_of(own)))

        self._own = Solver(case, hole)
        self._solvers = [solver(self.set_of(float(factor)).of(intervals)) for factor in FACTORS]
        held = tuple(
            factor.shifted(CASED_STEP if self.fit != "all" and interval.kind != self.fit else 0.0)
            for factor, interval in zip(self.set_of(float(FACTORS[HELD])).of(intervals), intervals, strict=True)
        )
        self._other = solver(held)
        # Of mud at rest: a reading is brought to mud at rest by ``relief``.
        self._rates = rates_of_all(case, list(OF_KIND), flow=0.0)
        self._reliefs: dict[tuple[str, float, float], Relief] = {}
        self._nodes: dict[tuple[str, float], Array] = {}
        self._coarse: dict[float, Array] = {}
        self._inverses: dict[tuple[Mode, float, float], PchipInterpolator | None] = {}
        self._stiffness = section_of(case.string.components[-1], case.mud.density).EA

    def set_of(self, factor: float) -> FrictionSet:
        """A friction factor of the intervals whose factor is inferred."""
        return FrictionSet(every=factor) if self.fit == "all" else FrictionSet(**{self.fit: factor})

    def loads(self, kind: str, depth: float) -> Array:
        """Hook load [N] of a trip, or surface torque [N m] of rotation, at `FACTORS`.

        NaN where there is no balance, or where string and hole do not fit.
        """
        key = (kind, self._near(depth))
        if key not in self._nodes:
            column = 1 if kind == "rotate_off_bottom" else 0
            self._nodes[key] = np.array([self._solve(solver, *key)[column] for solver in self._solvers])
        return self._nodes[key]

    def relief(self, mode: Mode, depth: float, flow: float) -> Relief:
        """What mud that is pumped [m³/s] takes off, at the case's own friction; nothing where the case does not say
        how its mud flows, and without a flow.  NaN without a balance."""
        if not self.relieves(flow):
            return NOTHING
        key = KIND_OF[mode], self._near(depth), round(flow, 4)
        if key not in self._reliefs:
            rest = self._solve(self._own, *key[:2])
            pumped = self._solve(self._own, *key)
            share = pumped[1] / rest[1] if rest[1] else 1.0
            self._reliefs[key] = Relief(rest[0] - pumped[0], share)
        return self._reliefs[key]

    def relieves(self, flow: float) -> bool:
        """Whether a flow [m³/s] changes loads, as far as the case says."""
        return flow > 0 and has_flow_curve(self.case)

    def at_rest(
        self, mode: Mode, depth: float, flow: float, rpm: float, *, gauge: float, torque: float
    ) -> tuple[float, float]:
        """Readings of weight indicator [N] and drive [N m] with a flow [m³/s], brought to the mud at rest of the
        curves: as they are without ``relief``, NaN without a balance."""
        relief = self.relief(mode, depth, flow)
        if relief == NOTHING:
            return gauge, torque
        rig, direction = self.case.rig, OPERATIONS[KIND_OF[mode]].direction
        raised = weight_indicator(rig, direction, string_load(rig, direction, gauge) + relief.lift)
        return float(raised), torque + self.turning(torque, rpm) * (1 / relief.torque_share - 1)

    def _near(self, depth: float) -> float:
        return float(np.clip(round(depth / NODES) * NODES, NODES, self.deepest))

    def readings(self, mode: Mode, depth: float, rpm: float) -> Array:
        """What the rig's sensor reads at these loads: weight indicator [N], or drive torque [N m] while rotating."""
        kind = KIND_OF[mode]
        loads = self.loads(kind, depth)
        if kind == "rotate_off_bottom":
            spin = rad_per_s(0.0 if np.isnan(rpm) else rpm)
            return np.array([drive_torque(self.case.rig, spin, load) for load in loads])
        direction = OPERATIONS[kind].direction
        return np.array([weight_indicator(self.case.rig, direction, load) for load in loads])

    def curve(self, mode: Mode, depth: float, factor: float, rpm: float = float("nan")) -> float:
        """The reading at a depth and a factor within `FACTORS`; NaN without a balance."""
        x, y = _monotone(FACTORS, self.readings(mode, depth, rpm))
        return float(_cubic(x, y)(factor, extrapolate=False)) if len(x) > 1 else float("nan")

    def invert(self, mode: Mode, depth: float, reading: float, rpm: float) -> Inverse | None:
        """The factor of a reading; None where the chart has no two loads there or the load does not depend on it.

        Beyond the loads of `FACTORS` the factor continues on a straight line: a reading below that of a frictionless
        string has a negative one.
        """
        key = (mode, depth, rpm)
        if key not in self._inverses:  # a reading is often repeated at the same depth, as in trials
            self._inverses[key] = self._inverse_at(*key)
        cubic = self._inverses[key]
        if cubic is None:
            return None
        inside = float(np.clip(reading, cubic.x[0], cubic.x[-1]))
        slope = float(cubic(inside, 1))
        return Inverse(float(cubic(inside)) + slope * (reading - inside), slope)

    def _inverse_at(self, mode: Mode, depth: float, rpm: float) -> PchipInterpolator | None:
        """Factor by reading."""
        factors, loads = _monotone(FACTORS, self.readings(mode, depth, rpm))
        if len(factors) < 2:
            return None
        if loads[0] > loads[-1]:
            factors, loads = factors[::-1], loads[::-1]
        return _cubic(loads, factors)

    def by_held(self, mode: Mode, depth: float) -> float:
        """Derivative of the string's load by the factor of the other kind of interval [N or N m]; 0 without one.

        It is taken at the factor ``FACTORS[HELD]`` of the intervals whose factor is inferred.
        """
        if self.fit == "all":
            return 0.0
        kind = KIND_OF[mode]
        more = self._solve(self._other, kind, self._near(depth))[1 if kind == "rotate_off_bottom" else 0]
        return float(np.nan_to_num((more - self.loads(kind, depth)[HELD]) / CASED_STEP))

    def slips_below(self, depth: Array) -> tuple[Array, Array]:
        """Weight indicator below which the load is that of the block, and below which a bit that stands still while
        the block moves hangs in the slips [N]: with a tenth and with half of the string's weight."""
        depth = np.clip(depth, 0.0, self.deepest)
        low, high = float(np.floor(depth.min() / COARSE)), float(np.ceil(depth.max() / COARSE))
        at = np.arange(low, high + 1) * COARSE
        string = np.interp(depth, at, [self._coarse_node(float(d))[0] for d in at])
        block = self.case.rig.block_weight
        return block + OF_BLOCK * string, block + 0.5 * string

    def reversal(self, depth: float) -> float:
        """Stretch at reversal: difference of hook loads up and down, which falls to 0 at the bit, over EA [m]."""
        spread = self._coarse_at(depth)[1]
        return float(spread * depth / (2 * self._stiffness))

    def locked_share(self, depth: float, torque: float, rpm: float) -> float:
        """Share of the rotating torque of the case's own friction that a reading [N m] is."""
        turning = float(self._coarse_at(depth)[2])
        return self.turning(torque, rpm) / turning if turning > 0 else 0.0

    def turning(self, torque: float, rpm: float) -> float:
        """The part of a drive's torque that turns the string [N m]."""
        return torque - drive_torque(self.case.rig, rad_per_s(0.0 if np.isnan(rpm) else rpm), 0.0)

    def _coarse_at(self, depth: float) -> Array:
        depth = min(depth, self.deepest)
        low = np.floor(depth / COARSE) * COARSE
        share = (depth - low) / COARSE
        loads: Array = (1 - share) * self._coarse_node(float(low)) + share * self._coarse_node(float(low + COARSE))
        return loads

    def _coarse_node(self, depth: float) -> Array:
        """Rotating hook load, hook load up minus down [N] and rotating torque [N m] at the case's own friction.

        Each is 0 where there is no steady string.
        """
        depth = min(max(depth, COARSE / 4), self.deepest)
        if depth not in self._coarse:
            turning, out, down = (self._solve(self._own, kind, depth) for kind in OF_KIND)
            self._coarse[depth] = np.nan_to_num([turning[0], max(out[0] - down[0], 0.0), turning[1]])
        return self._coarse[depth]

    def _solve(self, solver: Solver, kind: str, depth: float, flow: float = 0.0) -> tuple[float, float]:
        """Hook load and surface torque, NaN without a balance."""
        try:
            point = solver.solve(kind, self._rates[kind]._replace(flow=flow), depth)
        except InputError:
            return float("nan"), float("nan")
        return (point.hookload, point.surface_torque) if point.answered else (float("nan"), float("nan"))


def _cubic(x: Array, y: Array) -> PchipInterpolator:
    from scipy.interpolate import PchipInterpolator  # slow to import, and other commands do without

    return PchipInterpolator(x, y)


def _monotone(factors: Array, loads: Array) -> tuple[Array, Array]:
    """The factors whose loads go on in one direction, from the first on."""
    known = np.isfinite(loads)
    factors, loads = factors[known], loads[known]
    if len(loads) < 2 or loads[-1] == loads[0]:
        return factors[:0], loads[:0]
    sign = np.sign(loads[-1] - loads[0])
    keep = [0]
    for k in range(1, len(loads)):
        if sign * (loads[k] - loads[keep[-1]]) > 0:
            keep.append(k)
    return factors[keep], loads[keep]
