"""The steady string by root finding: its position, its loads and the readings of the rig, in milliseconds.

The string slides or turns at constant rates while its shape stands still; the forces are the stepper's own
(tangent.py).  Newton's method starts from the guess of a soft string (first_guess.py, continuation.py).
"""

from dataclasses import replace
from functools import cached_property

import numpy as np

from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.units import LENGTH, argument
from fctd.mechanics import state
from fctd.model.drillstring import lay_out
from fctd.model.operations import SteadyRates, steady_rates
from fctd.model.string_in_hole import check_fit
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.status import SteadyStatus
from fctd.steady.balance import ATTEMPTS, IN_THE_OPEN, LARGEST_TURN, PATIENT, balance
from fctd.steady.batch import Hole, Row, hole_of, solve_batch
from fctd.steady.bisection import bisect, find_anew
from fctd.steady.carried_shape import Carried, begin, carry
from fctd.steady.climb import LARGEST_PUSH, SOUND_PUSH, Climb, climb, end_of, lock_up
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.helical_force import add_helical_force
from fctd.steady.laid_string import LaidString
from fctd.steady.post_buckling import Resolved, is_resolved, resolve
from fctd.steady.problem import Allowance, Problem, Workspace
from fctd.steady.reading import SOLVED, Answer
from fctd.steady.steady_string import Equilibrium, steady_string

# Shapes of a buckled string whose hook loads differ by more than this share of its weight are both stated.
APART = 0.01
TOO_MUCH = "resolving takes more work than solver.resolve_work allows a row"
TOO_FINE = f"resolving takes more than the {state.MAX_SEGMENTS} segments that a string may have: use smaller loads"
ANALYTIC = "the wall force of the helix is the analytic one, r F²/4EI"


class Solver:
    """Steady strings of one case: the hole is built once, the string laid out anew for each bit depth.

    hole : the case's hole, if it has been built already.  work : arrays that another solver has left.
    """

    def __init__(self, case: Case, hole: Wellbore | None = None, work: Workspace | None = None) -> None:
        self.case = case
        self.hole = build_wellbore(case) if hole is None else hole
        self.depths = case.depths
        self.geometry = self.hole.geometry if case.contact.enabled else state.OPEN
        self.work = Workspace(0) if work is None else work

    def lay_out(self, bit_depth: float) -> LaidString:
        """The string with the bit at a depth [m]; raises InputError when string and hole do not fit there."""
        check_bit_depth(bit_depth, *self.depths, "bit_depth", f"{bit_depth:g} m")
        string = lay_out(self.case, bit_depth)
        check_fit(string, self.hole, bit_depth)
        return LaidString(self.case, self.hole, string)

    def solve(self, operation: str, rates: SteadyRates, bit_depth: float) -> Equilibrium:
        """The steady string at a bit depth [m]; raises InputError when string and hole do not fit there."""
        return self.solve_string(operation, rates, self.lay_out(bit_depth))

    def solve_string(self, operation: str, rates: SteadyRates, laid: LaidString) -> Equilibrium:
        """The steady string of a laid-out string; the layout depends neither on operation nor on friction.

        Raises InputError when a resolved string has too many segments.
        """
        self.work = self.work.for_segments(laid.string.segments)
        answer = solve_batch(self.case, self._hole, [Row(laid, 0, operation, rates)], self.work)[0]
        return self.finish(operation, rates, laid, answer)

    def finish(self, operation: str, rates: SteadyRates, laid: LaidString, answer: Answer) -> Equilibrium:
        """The steady string of a row of a batch, by other methods where its first attempt found none.

        Raises InputError when a resolved string has too many segments.
        """
        point = self.first(operation, rates, laid, answer)
        return point if point is not None else self.solve_problem(self.problem(operation, rates, laid))

    def first(self, operation: str, rates: SteadyRates, laid: LaidString, answer: Answer) -> Equilibrium | None:
        """The steady string of a row of a batch whose first attempt is the answer, else None.

        Several threads may call it.
        """
        if not answer.numbers[SOLVED]:
            return None
        point = steady_string(self.case, self.hole, operation, rates, laid, answer, CONVERGED, 0)
        as_cut = self.case.solver.buckling != "resolve" and self.case.contact.helical_force != "analytic"
        return point if as_cut or point.buckling.mode == NOT_BUCKLED.mode else None

    @cached_property
    def _hole(self) -> Hole:
        return hole_of(self.case, [self.hole])

    # Of an iteration that diverged only the status is used; its numbers may overflow.
    @np.errstate(over="ignore", invalid="ignore")
    def solve_problem(self, problem: Problem, above: Carried | None = None) -> Equilibrium:
        """The steady string of a problem, by whatever methods it needs.

        The problem then has the pose of the answer, except for a resolved string, whose segments are others.
        above : the shapes of the row above, with which a resolved string begins.
        """
        point = self.settle(problem, above)
        # Of an unstable balance the solver's pose may be another.
        buckled = point.answered and point.status != SteadyStatus.UNSTABLE and point.buckling.mode == "helical"
        if buckled and not point.buckling.resolved and self.case.contact.helical_force == "analytic":
            return self.with_helical_force(problem, point)
        return point

    def settle(self, problem: Problem, above: Carried | None = None) -> Equilibrium:
        """The string of a problem as its segments can lie, or resolved where the case says so."""
        analytic = self.case.contact.helical_force == "analytic"
        if self.geometry == state.OPEN:
            code, iterations, negative = balance(problem, IN_THE_OPEN)
            return self.answer(problem, code, iterations, negative)
        code, iterations, negative = balance(problem, (*ATTEMPTS, *PATIENT) if analytic else ATTEMPTS)
        point = self.answer(problem, code, iterations, negative)
        unsolved = code != CONVERGED or negative > 0
        if self.case.solver.buckling == "resolve" and (unsolved or point.buckling.mode != NOT_BUCKLED.mode):
            resolved = self.resolve(problem, iterations, above)
            if resolved.status == SteadyStatus.UNDER_RESOLVED:
                return replace(resolved, message=f"{TOO_FINE}; {resolved.message}")
            if resolved.status != SteadyStatus.MAX_ITERATIONS:
                return resolved
            problem = self.problem(problem.operation, problem.rates, problem.laid)
            point = self.stable(problem, point, code) if unsolved else point
            found = point.message or str(point.status)
            return replace(point, message=f"{TOO_MUCH}; with the segments of the case: {found}")
        return self.stable(problem, point, code) if unsolved else point

    def stable(self, problem: Problem, point: Equilibrium, code: int) -> Equilibrium:
        """The string of a problem followed from small loads, where its balance ``point`` is none or an unstable one."""
        analytic = self.case.contact.helical_force == "analytic"  # needs loads to begin with
        problem.at_axis = 1
        path, coarse = bisect(problem), False
        path.iterations += point.iterations
        if not path.balances and not analytic:
            problem.at_axis = 0
            found, iterations, negative = balance(problem, PATIENT)
            path.iterations += iterations
            if found == CONVERGED and negative == 0:
                return self.answer(problem, found, path.iterations, negative)
            problem.at_axis = 1
        if path.pose is None:
            coarse = bool(path.balances) and not is_resolved(problem, path) and not analytic
            if coarse:
                problem.put_pose(path.balances[-1].pose)
            else:
                path = climb(problem, path=path if path.balances else None)
                lock_up(problem, path)
        followed = self.follow(problem, path)
        out_of_wall = point.status in (SteadyStatus.DIVERGED, SteadyStatus.NOT_FINITE)
        if out_of_wall and not followed.answered and (code == CONVERGED or not path.balances):
            return point
        coarse = coarse and not followed._shape.buckling.resolved
        if code != CONVERGED and coarse and followed.status == SteadyStatus.UNSTABLE and not path.rolls:
            # Whether the string has a shape is not known: its segments cannot bend into it.
            message = f"{followed.message}; {followed._shape.buckling.shortfall(self.case.solver.buckling)}"
            return replace(followed, status=SteadyStatus.UNDER_RESOLVED, message=message)
        if code != CONVERGED or followed.answered or followed.status == SteadyStatus.LOCKED_UP:
            return followed
        message = f"the string would leave this balance, and {followed.message}"
        return replace(point, status=SteadyStatus.UNSTABLE, message=message, iterations=path.iterations)

    def with_helical_force(self, problem: Problem, point: Equilibrium) -> Equilibrium:
        """The string with the wall force of a helix where its segments cannot bend into one.

        point : without that force, in the pose of the problem.
        """
        allowed = problem.allowed
        added = add_helical_force(problem, Pace(*ATTEMPTS[0], LARGEST_TURN, allowed, allowed))
        wound = self.answer(problem, CONVERGED, point.iterations + added.iterations, problem.unstable_modes())
        if added.settled:
            says = wound.message and problem.added.any()
            return replace(wound, message=f"{wound.message}; {ANALYTIC}") if says else wound
        pushed = -wound.hookload > self.case.rig.push
        status = SteadyStatus.LOCKED_UP if pushed or added.endless else SteadyStatus.UNSTABLE
        end = (
            f"the push exceeds {LARGEST_PUSH:g} times the string's weight"
            if added.endless
            else "no steady shape was found"
        )
        spent = "slack-off is spent, and " if pushed else ""
        return replace(wound.without_loads(), status=status, message=f"{spent}{end}; {ANALYTIC}")

    def resolve(self, problem: Problem, iterations: int, above: Carried | None = None) -> Equilibrium:
        """The buckled string of a problem on segments that can bend as it does, in the shape of the lower energy."""
        bit_depth, allowance = problem.string.bit_depth, problem.allowance

        def lay_finer(case: Case) -> Problem:
            laid = LaidString(case, self.hole, lay_out(case, bit_depth))
            finer = self.problem(problem.operation, problem.rates, laid, case)
            finer.at_axis, finer.allowance = 1, allowance
            return finer

        if above is not None:
            begun = begin(self.case, above, bit_depth, lay_finer)
            point = None if begun is None else self.of_lower_energy(begun, iterations)
            if point is not None and point.status == SteadyStatus.CONVERGED:
                return point
            problem = self.problem(problem.operation, problem.rates, problem.laid)
            allowance = problem.allowance
        problem.at_axis = 1
        coarse = climb(problem, most=SOUND_PUSH)
        return self.of_lower_energy(resolve(self.case, coarse, problem, lay_finer), iterations)

    def of_lower_energy(self, resolved: Resolved, iterations: int) -> Equilibrium:
        """The answer of a resolved string: its helix, where it has one, with the hook loads of both shapes."""
        problem, snaking, helix = resolved
        point = self.follow(problem, snaking)
        if helix is None:
            chosen = replace(point, shape="snaking")
        else:
            wound = point if helix is snaking else self.follow(problem, helix)
            chosen = replace(wound, shape="helix")
            loads = [p.hookload for p in (point, wound) if p.answered]
            if len(loads) == 2 and abs(loads[1] - loads[0]) > APART * problem.weight:
                chosen = replace(chosen, hookload_low=min(loads), hookload_high=max(loads))
        carried = carry(resolved) if chosen.status == SteadyStatus.CONVERGED else None
        return replace(chosen, iterations=chosen.iterations + iterations, carried=carried)

    def follow(self, problem: Problem, path: Climb) -> Equilibrium:
        """The string at the end of a path: with loads where the path reaches them, and with what ends the path."""
        if path.pose is not None:
            problem.put_pose(path.pose)
        negative = problem.unstable_modes() if path.pose is not None else 0
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

    def problem(self, operation: str, rates: SteadyRates, laid: LaidString, cut: Case | None = None) -> Problem:
        """A laid-out string as a problem; cut : the case with other segments, of which it has been laid out."""
        case = self.case if cut is None else cut
        self.work = self.work.for_segments(laid.string.segments)
        return Problem(case, self.hole, self.work, laid, operation, rates, Allowance(self.case.solver.resolve_work))

    def answer(self, problem: Problem, code: int, iterations: int, negative: int) -> Equilibrium:
        """The steady string of a problem in its pose; code, negative : see
        ``steady_string``."""
        answer = problem.answer(iterations)
        laid = problem.laid
        return steady_string(self.case, self.hole, problem.operation, problem.rates, laid, answer, code, negative)


def equilibrium(
    case: Case,
    operation: str,
    bit_depth: float | str,
    speed: float | str | None = None,
    rpm: float | str | None = None,
) -> Equilibrium:
    """The steady string of an operation with the bit at ``bit_depth`` [m], or a text such as "8000 ft".

    operation : a kind of operation.  speed [m/s] or a text with its unit, rpm : by default those of the case's
    operation of that kind, else the kind's defaults.  Weight on bit and bit torque are the case's.  Raises InputError
    for input that cannot be used; ``status`` says whether a balance was found.
    """
    with naming_file(case):
        depth = argument(bit_depth, LENGTH, "bit_depth")
        return Solver(case).solve(operation, steady_rates(case, operation, speed, rpm), depth)
