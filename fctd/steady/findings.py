"""What the rungs of the ladder (ladder.py) share of a row: its problem, and what they have found of it so far."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from fctd.case.load import Case
from fctd.case.solver import RESOLVING
from fctd.model.drillstring import lay_out
from fctd.model.operations import SteadyRates
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.status import SteadyStatus
from fctd.steady.bisection import find_anew
from fctd.steady.carried_shape import Carried
from fctd.steady.climb import Climb, end_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.laid_string import LaidString
from fctd.steady.problem import Problem
from fctd.steady.steady_string import Equilibrium

# The problem of a laid-out string, on the segments of a case.
Lay = Callable[[str, SteadyRates, LaidString, Case], Problem]
# The steady string of a problem in its pose: code of the iteration, iterations, unstable modes, name of the rung.
Read = Callable[[Problem, int, int, int, str], Equilibrium]


@dataclass
class Findings:
    """A row of a case, and what has been found of it so far.

    problem : with the segments of the case, in the pose that the last rung has left; above : the shapes of the row
    above, if any; rung : name of the one at work, which every string that it finds carries.
    first : Newton's string from the guess; code : of the iteration; is_stable : whether that string is a balance in
    which it would stay.  resolved : the string on finer segments; why_homogenised : why it is none that
    slides, beside too many segments and too much work; is_fed_in_part : whether its work was spent before feed came to
    its end.  path : balances at less than the loads, if any, and
    those at the loads; ended : the string at the path's end; is_coarse : whether the segments are too long for more
    steps of it.  found : the string whose loads the row has, before any are added.
    """

    case: Case
    problem: Problem
    above: Carried | None
    lay: Lay
    read: Read
    rung: str = ""
    code: int = CONVERGED
    is_stable: bool = False
    resolved: Equilibrium | None = None
    why_homogenised: str = ""
    is_fed_in_part: bool = False
    path: Climb = field(default_factory=Climb)
    ended: Equilibrium | None = None
    is_coarse: bool = False
    first: Equilibrium = field(init=False)
    found: Equilibrium = field(init=False)

    @property
    def is_analytic(self) -> bool:
        """Whether the wall force of a helix is added in closed form, which begins with a balance without it."""
        return self.case.contact.helical_force == "analytic"

    @property
    def is_to_be_resolved(self) -> bool:
        """Whether the string needs segments that can bend as it does, and the case asks for them."""
        is_as_cut = self.is_stable and self.first.buckling.mode == NOT_BUCKLED.mode
        return self.case.solver.buckling in RESOLVING and not is_as_cut

    @property
    def is_to_be_carried(self) -> bool:
        """Whether the row begins with the shapes of the row above; a string that is fed begins at rest."""
        return self.is_to_be_resolved and self.above is not None and not self.is_to_be_fed

    @property
    def is_to_be_fed(self) -> bool:
        """Whether the string is fed from rest: it slides down, and the case asks for it."""
        return self.is_to_be_resolved and self.case.solver.buckling == "feed" and self.problem.slides_down

    @property
    def lacks_segments(self) -> bool:
        """Whether the string that was resolved needs more segments than it may have."""
        return self.resolved is not None and self.resolved.status == SteadyStatus.UNDER_RESOLVED

    @property
    def has_no_balance(self) -> bool:
        """Whether no balance is known, at whatever share of the loads."""
        return self.ended is None and not self.path.balances

    @property
    def has_left_hole(self) -> bool:
        """Whether Newton's string lies outside the hole, and no path says more of it."""
        is_outside = self.first.status in (SteadyStatus.DIVERGED, SteadyStatus.NOT_FINITE)
        return is_outside and (self.code == CONVERGED or not self.path.balances)

    @property
    def is_locked_up(self) -> bool:
        """Whether the path ends where no push moves the string."""
        return self.ended is not None and self.ended.status == SteadyStatus.LOCKED_UP

    @property
    def is_too_coarse(self) -> bool:
        """Whether it is not known if the string has a shape, since its segments cannot bend into it."""
        return (
            self.is_coarse
            and self.ended is not None
            and self.ended.status == SteadyStatus.UNSTABLE
            and not self.ended._shape.buckling.resolved
            and not self.path.rolls
        )

    @property
    def lacks_helix(self) -> bool:
        """Whether the string that was found needs the wall force of a helix into which its segments cannot bend."""
        found = self.found
        # Of an unstable balance the solver's pose may be another.
        is_wound = found.answered and found.status != SteadyStatus.UNSTABLE and found.buckling.mode == "helical"
        return self.is_analytic and is_wound and not found.buckling.resolved

    @property
    def may_roll(self) -> bool:
        """Whether the string that was found has no steady shape, and turns where it can roll round the hole."""
        return self.found.status == SteadyStatus.UNSTABLE and not self.is_analytic and self.problem.can_roll

    def answer(self, problem: Problem, code: int, iterations: int, negative: int) -> Equilibrium:
        """The string of a problem in its pose; code, negative : see ``steady_string``."""
        return self.read(problem, code, iterations, negative, self.rung)

    def lay_anew(self) -> Problem:
        """The problem on the segments of the case, after others have been laid out, with all of its allowance."""
        old = self.problem
        self.problem = self.lay(old.operation, old.rates, old.laid, self.case)
        return self.problem

    def lay_finer(self, case: Case) -> Problem:
        """The problem on the segments of another case, which shares the allowance."""
        own = self.problem
        laid = LaidString(case, own.hole, lay_out(case, own.string.bit_depth), own.laid.lie)
        other = self.lay(own.operation, own.rates, laid, case)
        other.at_axis, other.allowance = 1, own.allowance
        return other

    def end_of(self, problem: Problem, path: Climb) -> Equilibrium:
        """The string at the end of a path: with loads where the path reaches them, and with what ends the path."""
        if path.pose is not None:
            problem.put_pose(path.pose)
        # Whether the long segments of homogenised waves would stay where they lie says nothing of the string.
        is_judged = path.pose is not None and problem.settle is None
        negative = problem.unstable_modes() if is_judged else 0
        point = self.answer(problem, CONVERGED, path.iterations, negative)
        spent = path.spent_at if path.spent_at > path.least else float("nan")  # the message gives the bound
        point = replace(point, slack_off_spent_at=spent, locked_up_at=path.locked_at)
        if path.pose is None:  # but that of smaller loads
            status = SteadyStatus.MAX_ITERATIONS if path.is_cut else SteadyStatus.UNSTABLE
            if np.fmin(path.spent_at, path.locked_at) < 1:
                status = SteadyStatus.LOCKED_UP
            point = replace(point.without_loads(), status=status, message=status.message)
        if point.status not in (SteadyStatus.LOCKED_UP, SteadyStatus.UNSTABLE, SteadyStatus.MAX_ITERATIONS):
            return point
        if path.pose is None:
            find_anew(problem, path)
        return replace(point, message=end_of(problem, path) or point.message)
