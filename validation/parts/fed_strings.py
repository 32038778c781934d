"""Buckled strings that slide down, drawn at random: their rows on several meshes, and the friction at which feed stops.

Feeding has a limit of its own: the least share of the friction at which a string that is fed from rest locks up.  The
solver's ``locked_up_at`` is that of a string which already slides while its friction grows.
"""

import time
from collections.abc import Iterable, Iterator, Sequence
from itertools import count
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case
from fctd.case.errors import InputError
from fctd.case.load import with_friction
from fctd.mechanics import state
from fctd.model import layouts
from fctd.model.frames import hole_frame
from fctd.model.operations import steady_rates
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.status import SteadyStatus
from fctd.steady.attempts import TOO_MUCH
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.carried_shape import shape_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from fctd.steady.feed import ARRIVING, End, FedString, Start
from fctd.steady.problem import Allowance, Problem, Share
from fctd.steady.steady_string import HOMOGENISED, Equilibrium
from fctd.steady.tangent import NORMAL_FORCE
from validation.cases.wells import real_well
from validation.harness.study import Context
from validation.parts import random_wells
from validation.parts.resolved_rows import CASED, DEPTH, horizontal_well

SEED = 34
WELLS = "horizontal", "random", "K05-ENC-05-S1"
KINDS = "drill_sliding", "trip_in"
FRICTION, WEIGHT = (0.1, 0.5), (20e3, 300e3)  # ranges of the factor, and of the weight on bit [N]
MORE_FRICTION, SHORT = (0.4, 0.8), 1600.0  # of trips in that are to lock up, with the bit at most so deep [m]
LEAST_DEPTH = 0.4  # of the depths that a string can reach
SEGMENT = 20.0  # of the horizontal well [m]
MESHES = (1.0, 0.7, 0.5)  # shares of the segments of the case
# Rows of one string are the same within this share of its weight, and their friction at lock-up within this one.
SAME_LOAD, SAME_FRICTION = 0.01, 0.02
# The limit of feeding is looked for from this share of ``locked_up_at`` on, first within a factor ``CLOSE`` of it, then
# farther down, or up to the friction at which the row is locked up; until it is known within the ratio ``KNOWN``.
LEAST, CLOSE, KNOWN = 0.1, 0.7, 1.05
EASED = 0.97  # share of the friction from one step to the next of a string that is locked up
AT_REST = Share(0.0, 0.0)
ARRIVES, NOT = "arrives", "not"
RAISED = "raised"  # the status of a row that ends in an exception


class Drawn(NamedTuple):
    """A string: its well, the case, the operation, the bit depth [m] and the friction factor."""

    well: str
    case: Case
    operation: str
    bit_depth: float
    friction: float


def drawn(context: Context, index: int, factors: tuple[float, float] = FRICTION) -> Drawn:
    """The string of an index, with a friction factor in a range; wells follow each other."""
    rng = Random(f"fed strings:{SEED}:{index}")
    well = WELLS[index % len(WELLS)]
    friction, weight = round(rng.uniform(*factors), 3), round(rng.uniform(*WEIGHT), -3)
    kind, deep = rng.choice(KINDS), rng.random()
    if well == "horizontal":
        case = horizontal_well(SEGMENT, "feed")
        top, bottom = CASED, DEPTH
    elif well == "random":
        case = Case.model_validate(random_wells.well(rng))
        top, bottom = case.depths
        top += LEAST_DEPTH * (bottom - top)
    else:
        fine: dict[str, Any] = {"segments": None, "segment_length": "10 m"}
        changes = {f"string__components__0__{key}": value for key, value in fine.items()}
        case = real_well(context, wellbore__geometry="arcs", **changes)
        top, bottom = LEAST_DEPTH * case.depths[1], case.depths[1]
    case = with_friction(case, friction).model_copy(
        update={
            "bit": case.bit.model_copy(update={"weight_on_bit": weight}),
            "solver": case.solver.model_copy(update={"buckling": "feed"}),
        }
    )
    return Drawn(well, case, kind, round(top + deep * (bottom - top), 2), friction)


def meshed(case: Case, share: float) -> Case:
    """The case with segments of a share of their length."""
    parts = []
    for of in case.string.components:
        assert of.segment_length is not None  # of every string that is drawn
        parts.append(of.model_copy(update={"segment_length": share * of.segment_length}))
    return layouts.with_components(case, tuple(parts))


def as_found(case: Case, point: Equilibrium) -> Case:
    """The case with the segments that the solver has chosen for a row."""
    return layouts.with_components(case, point._shape.laid.case.string.components)


def scaled(case: Case, share: float) -> Case:
    """The case with a share of its friction factors."""
    intervals = tuple(i.model_copy(update={"friction": share * i.friction}) for i in case.wellbore.intervals)
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": intervals})})


def weight_of(case: Case, depth: float) -> float:
    """Weight of a string in mud [N]."""
    string = Solver(case).lay_out(depth).string
    return float(string.weight @ string.length)


class Row(NamedTuple):
    """A row as it was found, None where it raised, then why; processor time [s]."""

    point: Equilibrium | None
    seconds: float
    raised: str = ""

    @property
    def status(self) -> str:
        """Its status in words."""
        return RAISED if self.point is None else str(self.point.status)

    @property
    def is_buckled(self) -> bool:
        """Whether the string buckles, or has no balance in which it would not."""
        point = self.point
        return point is None or point.status != SteadyStatus.CONVERGED or point.buckling.mode != NOT_BUCKLED.mode

    @property
    def lacks_segments(self) -> bool:
        """Whether its waves take more segments than a string may have."""
        if self.point is None:
            return False
        buckling = self.point._shape.buckling
        return (buckling.to_md - buckling.from_md) / buckling.segment_length > state.MAX_SEGMENTS

    @property
    def lacks_work(self) -> bool:
        """Whether its segments are those of the case, since resolving takes more work than a row may."""
        return self.point is not None and TOO_MUCH in self.point.message

    @property
    def arrival(self) -> str:
        """Whether the string slides at its friction: ``ARRIVES``, ``NOT`` where no push moves it, else its status."""
        if self.point is None or self.point.status not in (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP):
            return self.status
        return ARRIVES if self.point.answered else NOT

    @property
    def facts(self) -> dict[str, Any]:
        """The row for a table."""
        point = self.point
        if point is None:
            return {"status": RAISED, "reason": self.raised, "seconds": self.seconds}
        return {
            "status": str(point.status), "shape": point.shape, "method": point.method,
            "segments": len(point._shape.joints), "hookload_kN": point.hookload / 1e3,
            "slack_off_spent_at": point.slack_off_spent_at, "locked_up_at": point.locked_up_at,
            "balances_fed": len(point.fed), "snaps": sum(of.snapped for of in point.fed),
            "iterations": point.iterations, "seconds": self.seconds, "reason": point.message,
        }  # fmt: skip


def solve(case: Case, operation: str, bit_depth: float) -> Row:
    """A row with its time.  Input that cannot be used raises; any other exception is a finding, and is the row's."""
    began = time.process_time()
    try:
        point = Solver(case).solve(operation, steady_rates(case, operation), bit_depth)
    except InputError:
        raise
    except Exception as error:
        return Row(None, time.process_time() - began, f"{type(error).__name__}: {error}")
    return Row(point, time.process_time() - began)


def again(string: Drawn) -> list[float]:
    """Processor times [s] of a string's row, which is solved three times more."""
    return [solve(string.case, string.operation, string.bit_depth).seconds for _ in range(3)]


def solved(string: Drawn) -> Row | None:
    """The row of a string, None where string and hole do not fit at its depth."""
    try:
        return solve(string.case, string.operation, string.bit_depth)
    except InputError:
        return None


class Compared(NamedTuple):
    """Rows of one string on its meshes: spread of the hook loads [% of the weight] and of the friction at lock-up [%],
    NaN where a row has none, and what differs, empty where they are the same."""

    load: float
    friction: float
    differs: str


def compare(rows: Sequence[Row], weight: float) -> Compared:
    """Whether the rows of a string of a weight [N] are the same."""
    points = [row.point for row in rows if row.point is not None]
    loads = np.array([of.hookload if of.answered else np.nan for of in points])
    locked = np.array([of.locked_up_at for of in points])
    load = 100 * float(np.ptp(loads)) / weight if len(loads) else np.nan
    friction = 100 * float(locked.max() / locked.min() - 1) if len(locked) else np.nan
    differs = []
    if len({row.status for row in rows}) > 1 or len(points) < len(rows):
        differs.append("status")
    if np.isnan(loads).any() and not np.isnan(loads).all():
        differs.append("loads or none")
    if load > 100 * SAME_LOAD:
        differs.append("hook load")
    if friction > 100 * SAME_FRICTION:
        differs.append("friction at lock-up")
    return Compared(load, friction, ", ".join(differs))


class Feeding:
    """A row's string that is fed from rest on the segments of the row, at shares of its friction.

    It begins in the shape at rest that it has with the segments of the case.
    """

    def __init__(self, case: Case, point: Equilibrium) -> None:
        problem = self._problem(case, point)
        torque, problem.bit_torque = problem.bit_torque, 0.0
        code, _, _ = balance(problem, ATTEMPTS, AT_REST)
        self.start = Start(shape_of(problem, AT_REST), False) if code == CONVERGED else None
        problem.bit_torque = torque
        self.problem = self._problem(as_found(case, point), point)
        self.problem.at_axis = 1
        self.share = AT_REST

    @staticmethod
    def _problem(case: Case, point: Equilibrium) -> Problem:
        solver = Solver(case)
        return solver.problem(point.operation, steady_rates(case, point.operation), solver.lay_out(point.bit_depth))

    def at(self, share: float, arriving: float = ARRIVING) -> End:
        """How feeding ends at a share of the friction, off bottom and then onto it, with the work of a row."""
        string, end = self._fed(share, arriving)
        self.share = Share(share, 0.0)
        string.let_go()
        return end

    def profile(self) -> pd.DataFrame:
        """The shape in which feeding ended last: measured depth, angle from the high side and force of each contact."""
        contacts = self.problem.reactions(self.share).contacts
        walls = self.problem.walls(contacts)
        high, right = hole_frame(self.problem.hole.at(walls.md)[1])
        up, aside = np.sum(walls.offset * high, axis=1), np.sum(walls.offset * right, axis=1)
        return pd.DataFrame(
            {
                "md_m": walls.md,
                "contact_angle_deg": np.degrees(np.arctan2(aside, up)) % 360,
                "contact_force_N": contacts[:, NORMAL_FORCE],
            }
        )

    def _fed(self, share: float, arriving: float = ARRIVING) -> tuple[FedString, End]:
        """A string that was fed, and how that ended."""
        problem = self.problem
        problem.allowance = Allowance(problem.case.solver.resolve_work)
        string = FedString(problem, share, arriving)
        if self.start is None or not string.begin(self.start):
            return string, End.LOST
        end = string.trip()
        if end == End.ARRIVED and problem.weight_on_bit > 0:
            end = string.press(problem.weight_on_bit)
        return string, end

    def unloading_limit(self, locked: float) -> float:
        """Share of the friction at which a string that is locked up arrives as its friction falls, NaN where none does.

        locked : a share at which feeding from rest locks up.
        """
        string, end = self._fed(locked)
        weight, share, found = self.problem.weight_on_bit, locked, float("nan")
        while end == End.LOCKED and share > CLOSE * locked:
            share *= EASED
            if not string.ease(share):
                break
            if (pressed := string.path[-1].weight) > 0:
                end = End.ARRIVED if pressed >= weight else string.feed_on(weight)
            elif (end := string.trip()) == End.ARRIVED and weight > 0:
                end = string.press(weight)
            found = share if end == End.ARRIVED else found
        string.let_go()
        return found

    def limit(self, about: float) -> tuple[float, float]:
        """Shares of the friction between which feeding locks up, near a share ``about`` and below 1.

        The lower one is NaN where no share from ``LEAST`` of that on arrives.
        """
        low, high = CLOSE * min(about, 1.0), min(about / CLOSE, 1.0)
        if self.at(low) == End.ARRIVED:
            if high < 1.0 and self.at(high) == End.ARRIVED:
                low, high = high, 1.0
        else:
            low, high = CLOSE * low, low
            while self.at(low) != End.ARRIVED:
                low, high = CLOSE * low, low
                if low < LEAST * about:
                    return float("nan"), high
        while high > KNOWN * low:
            middle = (low * high) ** 0.5
            low, high = (middle, high) if self.at(middle) == End.ARRIVED else (low, middle)
        return low, high


Locked = tuple[Drawn, Equilibrium]


def locked_of(strings: Iterable[tuple[Drawn, Row]]) -> Iterator[Locked]:
    """The strings that no push moves, locked up at a known share of their friction, on segments that follow them."""
    for string, row in strings:
        point = row.point
        if point is None or row.arrival != NOT or point.shape == "none" or point.method == HOMOGENISED:
            continue
        if np.isfinite(point.locked_up_at):
            yield string, point


def trips(context: Context) -> Iterator[tuple[Drawn, Row]]:
    """Short strings that buckle as they trip in, with more friction; without end.

    They hang at the rotary table, as the stepper moves them by stands.
    """
    for index in count():
        string = drawn(context, index, MORE_FRICTION)
        if string.operation != "trip_in" or string.bit_depth > SHORT or string.case.string.top_md > 0:
            continue
        row = solved(string)
        if row is not None and row.is_buckled:
            yield string, row
