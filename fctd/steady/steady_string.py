"""The steady string of an answer: what is read from it as a row, with its status and the reason for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.case.message import Message, quantity, within
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.model.frames import steady_offsets
from fctd.model.operations import SteadyRates, drive_torque, weight_indicator
from fctd.model.string_in_hole import damping_of
from fctd.model.tortuosity import shortfall
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import NOT_BUCKLED, UNKNOWN, Buckling
from fctd.results.limits import WORST
from fctd.results.mesh_notes import mesh_notes
from fctd.results.notes import (
    Note,
    bent,
    flow_law,
    flow_lie,
    homogenised,
    limit_notes,
    rig_notes,
    several_balances,
)
from fctd.results.profile import profile_table
from fctd.results.status import SteadyStatus
from fctd.steady.continuation import CONVERGED, NOT_FINITE
from fctd.steady.laid_string import LaidString
from fctd.steady.pose import PLACE
from fctd.steady.reading import NOTED, OUTSIDE, SHAPE, SHARES, SUM_NORMAL, SUM_R_MU_FN, TOP, Answer
from fctd.steady.shape import Shape

if TYPE_CHECKING:
    import pandas as pd

    from fctd.steady.carried_shape import Carried
    from fctd.steady.feed import Fed


HOMOGENISED = "homogenised"  # the rung of strings whose waves have the wall force of the closed forms
ABOUT = 2  # column of ``damping_of``: about the axis
AT_FULL = "solved at its full friction alone, from which share of it on is not known"


@dataclass(frozen=True)
class Equilibrium:
    """A steady string with the bit at one depth.

    rates : of the operation.  status : loads are valid where ``status.has_loads``, also for ``locked_up``,
    ``under_resolved`` and ``unstable``; message : details.  method : the rung of the ladder (ladder.py) that found the
    string.  roll_rate : of a string that rolls round the hole [rad/s], against a clockwise rotation below 0, else NaN.
    lost_torque : of wall, mud and bit [N m], where a bent housing turns, else NaN.
    shape : of a buckled string whose segments follow it, snaking or helix, else none; hookload_low, hookload_high
    [N] : of both shapes where they differ, else NaN; slack_off_spent_at, locked_up_at : shares of the friction (of the
    weight on bit where the message says so) at which the hook load is −block weight and at which no push suffices;
    NaN where they were not found.  draw : of a row that may have several balances, finds its hook loads with noise of
    the size of rounding [N], NaN without loads (several_balances.py).  carried : of a resolved string, the shapes with
    which the next depth may begin.
    bit_depth [m]; hookload, weight_indicator, total_contact_force, imbalance [N]; surface_torque, drive_torque [N m];
    sum_r_ft, sum_r_mu_fn [N m] : torques of wall friction, Σ r F_t and Σ r μ F_n.
    """

    case: Case
    operation: str
    rates: SteadyRates
    bit_depth: float
    status: SteadyStatus
    message: str
    iterations: int
    hookload: float
    surface_torque: float
    weight_indicator: float
    drive_torque: float
    total_contact_force: float
    sum_r_ft: float
    sum_r_mu_fn: float
    imbalance: float
    _shape: Shape = field(repr=False)
    method: str
    shape: str = "none"
    hookload_low: float = float("nan")
    hookload_high: float = float("nan")
    slack_off_spent_at: float = float("nan")
    locked_up_at: float = float("nan")
    roll_rate: float = float("nan")
    lost_torque: float = float("nan")
    draw: Callable[[], tuple[float, ...]] | None = field(default=None, repr=False)
    carried: Carried | None = field(default=None, repr=False)
    fed: tuple[Fed, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "message", Message(self.message))

    @property
    def answered(self) -> bool:
        """Whether the numbers belong to a balance of forces."""
        return self.status.has_loads and bool(np.isfinite(self.hookload))

    def without_loads(self) -> Self:
        """A copy without hook load, torques and contact force, for a string that has no balance at its loads."""
        none = float("nan")
        return replace(
            self, hookload=none, surface_torque=none, weight_indicator=none, drive_torque=none,
            total_contact_force=none, sum_r_ft=none, sum_r_mu_fn=none,
        )  # fmt: skip

    @cached_property
    def profile(self) -> pd.DataFrame:
        """The string from the top to the bit, a row per contact point; columns of ``profile_table``."""
        shape, mud, points = self._shape, self.case.mud.density, self._shape.contacts[:, PLACE]
        in_hole = self.case.contact.enabled
        return profile_table(
            shape.hole, shape.laid.string, mud, shape.top, points, shape.walls, shape.loads, in_hole,
            shape.laid.friction,
        )  # fmt: skip

    @property
    def feeding(self) -> pd.DataFrame:
        """The path of a string that was fed from rest, a row per balance; empty for others.

        Columns: feed_m (of the block), hookload_N, bit_moved_m (along the hole), weight_on_bit_N, snapped.
        """
        import pandas as pd  # slow to import, and seldom needed

        names = ["feed_m", "hookload_N", "bit_moved_m", "weight_on_bit_N", "snapped"]
        start = self.fed[0].bit if self.fed else 0.0
        rows = [(of.feed, -of.push, of.bit - start, of.weight, of.snapped) for of in self.fed]
        return pd.DataFrame(rows, columns=names)

    @property
    def offsets(self) -> Array:
        """``steady_offsets`` of the profile's rows to the high side and to the right (n + 1, 2) [m], for pictures."""
        profile = self.profile
        md, high, right = (profile[name].to_numpy(float) for name in ("md_m", "offset_high_m", "offset_right_m"))
        return steady_offsets(md, self._shape.hole.at(md)[1], high, right)

    @property
    def lift(self) -> float:
        """What mud that flows takes off the load of the string along the hole [N], below 0 where it pulls it down."""
        circuit = self._shape.laid.circuit
        return 0.0 if circuit is None else circuit.lift

    @property
    def buckling(self) -> Buckling:
        """Where the string is buckled; ``UNKNOWN`` where there are no loads."""
        if not self.answered:
            return UNKNOWN
        return self._shape.buckling if self.case.contact.enabled else NOT_BUCKLED

    @property
    def shares(self) -> Array:
        """The largest share of each limit (limits, WORST), of ``find_shares``."""
        return self._shape.numbers[SHARES:].reshape(-1, WORST)

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """Warnings about the loads; empty where there are no loads."""
        if not self.answered:
            return ()
        shape = self._shape
        kind, string = KINDS[self.operation], shape.laid.string
        hanging = 0.0 if kind.direction or kind.on_bottom else self.hookload
        top = string.sections[string.component[0]]
        found = rig_notes(self.case.rig, self.case.limits, self.weight_indicator, self.drive_torque, top, hanging)
        if shape.numbers[NOTED] or not self.case.limits.all_used:
            found = (*limit_notes(self.shares, string, shape.walls, self.case.limits), *found)
        weight = float(string.weight @ string.length)
        if (other := several_balances(self.hookload, self.draw() if self.draw is not None else (), weight)) is not None:
            found = (*found, other)
        if (turned := bent(self.surface_torque, self.lost_torque)) is not None:
            found = (*found, turned)
        if (circuit := shape.laid.circuit) is not None:
            law = flow_law(circuit.doubted, weight)
            lies = flow_lie() if shape.laid.eccentricity is None else None
            found = (*found, *(note for note in (law, lies) if note is not None))
        if (falls := shape.laid.falling) is not None:
            found = (*found, falls)
        found = (*found, *mesh_notes(self.case, string))
        if self.method != HOMOGENISED:
            return found
        # How deep its long segments lie in the wall says nothing of the string's waves.
        return (*(note for note in found if note.code != "penetration"), homogenised(shape.buckling))


def steady_string(
    case: Case,
    hole: Wellbore,
    operation: str,
    rates: SteadyRates,
    laid: LaidString,
    answer: Answer,
    code: int,
    negative: int,
    method: str,
) -> Equilibrium:
    """The steady string of an answer.

    code : of the iteration; negative : number of unstable modes; method : name of the rung that found it (ladder.py).
    """
    kind, numbers, laid = KINDS[operation], answer.numbers, laid.in_flow(rates)
    at_bit = laid.bit_loads(case, operation)
    shape = Shape(
        hole, laid, numbers[TOP:SHAPE], answer.joints, answer.contacts, answer.walls, numbers[SHAPE:],
        -at_bit.weight, at_bit.torque,
    )  # fmt: skip
    _, iterations, hookload, torque, imbalance, allowed = numbers[:TOP].tolist()
    # The hook load of a horizontal string is 0 within rounding.
    pushed = -hookload - case.rig.push > laid.string.segments * allowed
    status, message = _judge(case, code, negative, pushed, shape, imbalance)
    indicator = weight_indicator(case.rig, kind.direction, hookload)
    drive = drive_torque(case.rig, rates.spin, torque)
    normal, r_ft, r_mu_n = shape.numbers[SUM_NORMAL : SUM_R_MU_FN + 1].tolist()
    return Equilibrium(
        case, operation, rates, laid.string.bit_depth, status, message, int(iterations), hookload, torque,
        indicator, drive, normal, r_ft, r_mu_n, imbalance, shape, method,
        lost_torque=_lost_torque(case, hole, laid, rates, r_ft + at_bit.torque),
    )  # fmt: skip


def _lost_torque(case: Case, hole: Wellbore, laid: LaidString, rates: SteadyRates, wall_and_bit: float) -> float:
    """Torque of wall, mud and bit on a string with a bent housing that turns [N m], else NaN."""
    if not (laid.is_bent and rates.spin):
        return float("nan")
    about = damping_of(case, laid.string, hole)[:, ABOUT]
    return wall_and_bit + rates.spin * float(about @ laid.string.length)


def _judge(
    case: Case, code: int, negative: int, pushed: bool, shape: Shape, imbalance: float
) -> tuple[SteadyStatus, str]:
    """Status and message of a solution."""
    in_hole = case.contact.enabled
    if code == NOT_FINITE:
        return SteadyStatus.NOT_FINITE, SteadyStatus.NOT_FINITE.message
    if in_hole and (outside := int(shape.numbers[OUTSIDE])):
        text = f"segment {outside} lies deeper in the wall than the hole's radius"
        return SteadyStatus.DIVERGED, f"{text}: use a stiffer wall or a smaller load"
    if code != CONVERGED:
        return (
            SteadyStatus.MAX_ITERATIONS,
            f"the iterations end with forces out of balance by {quantity(imbalance, 'N', '.3g')}",
        )
    coarse = in_hole and not shape.buckling.resolved
    lacks = shape.buckling.shortfall(case.solver.buckling) if coarse else ""
    if pushed:
        text = f"{SteadyStatus.LOCKED_UP.message}; {AT_FULL}"
        return SteadyStatus.LOCKED_UP, f"{text}; {within(lacks)}" if coarse else text
    if coarse:
        return SteadyStatus.UNDER_RESOLVED, lacks
    winding = case.wellbore.tortuosity
    if winding is not None and (lacks := shortfall(winding, shape.laid.string.longest)):
        return SteadyStatus.UNDER_RESOLVED, lacks
    if negative:
        return SteadyStatus.UNSTABLE, f"without friction the balance is unstable in {counted(negative, 'mode')}"
    return SteadyStatus.CONVERGED, ""
