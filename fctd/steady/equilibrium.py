"""The steady string by root finding: its position, its loads and the readings of the rig, in milliseconds.

The string slides or turns at constant rates while its shape stands still; the forces are the stepper's own
(tangent.py).  Newton's method starts from the guess of a soft string (first_guess.py, continuation.py).
"""

from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice, own_friction
from fctd.case.load import Case, check_bit_depth, naming_file, with_friction
from fctd.case.message import quantity
from fctd.case.operation_names import kinds_of
from fctd.case.solver import RESOLVING
from fctd.mechanics import state
from fctd.model.depths import depth_of
from fctd.model.drillstring import lay_out
from fctd.model.operations import SteadyRates, rates_of_all, steady_rates
from fctd.model.string_in_hole import check_end, check_fit
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.results.buckling import NOT_BUCKLED
from fctd.steady.batch import Row, solve_batch
from fctd.steady.carried_shape import Carried
from fctd.steady.continuation import CONVERGED
from fctd.steady.findings import Findings
from fctd.steady.ladder import NEWTON, look_for
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import Hole, hole_of
from fctd.steady.problem import Allowance, Problem, Workspace
from fctd.steady.reading import SOLVED, Answer
from fctd.steady.several_balances import draw, may_move
from fctd.steady.steady_string import Equilibrium, steady_string


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
        check_bit_depth(bit_depth, *self.depths, "bit_depth", quantity(bit_depth, "m"))
        string = lay_out(self.case, bit_depth)
        check_fit(string, self.hole, bit_depth)
        check_end(string, self.hole)
        return LaidString(self.case, self.hole, string, lie_of)

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
        point = steady_string(self.case, self.hole, operation, rates, laid, answer, CONVERGED, 0, NEWTON)
        as_cut = self.case.solver.buckling not in RESOLVING and self.case.contact.helical_force != "analytic"
        return point if as_cut or point.buckling.mode == NOT_BUCKLED.mode else None

    @cached_property
    def friction(self) -> dict[str, float]:
        """See ``own_friction``."""
        return own_friction(self.case.wellbore.intervals)

    @cached_property
    def _hole(self) -> Hole:
        return hole_of(self.case, [self.hole])

    # Of an iteration that diverged only the status is used; its numbers may overflow.
    @np.errstate(over="ignore", invalid="ignore")
    def solve_problem(self, problem: Problem, above: Carried | None = None) -> Equilibrium:
        """The steady string of a problem, by the first rung of the ladder (ladder.py) that finds it.

        The problem then has the pose of the answer, except for a resolved string, whose segments are others.
        above : the shapes of the row above, with which a resolved string begins.
        """
        so_far = Findings(self.case, problem, above, self.problem, self.answer)
        point = look_for(so_far)
        if not may_move(point, so_far):
            return point
        again = partial(_solved, problem.operation, problem.rates, problem.string.bit_depth)
        return replace(point, draw=partial(draw, again, self.case))

    def problem(self, operation: str, rates: SteadyRates, laid: LaidString, cut: Case | None = None) -> Problem:
        """A laid-out string as a problem; cut : the case with other segments, of which it has been laid out."""
        case = self.case if cut is None else cut
        self.work = self.work.for_segments(laid.string.segments)
        return Problem(case, self.hole, self.work, laid, operation, rates, Allowance(self.case.solver.resolve_work))

    def answer(self, problem: Problem, code: int, iterations: int, negative: int, method: str) -> Equilibrium:
        """The steady string of a problem in its pose; code, negative, method : see ``steady_string``."""
        answer, laid = problem.answer(iterations), problem.laid
        return steady_string(
            self.case, self.hole, problem.operation, problem.rates, laid, answer, code, negative, method
        )


def _solved(operation: str, rates: SteadyRates, bit_depth: float, case: Case) -> Equilibrium:
    return Solver(case).solve(operation, rates, bit_depth)


def equilibrium(
    case: Case,
    operation: str,
    bit_depth: float | str,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    *,
    friction: FrictionChoice | None = None,
) -> Equilibrium:
    """The steady string of an operation with the bit at ``bit_depth`` [m], or a text: "8000 ft", "td" or "shoe".

    operation : a kind of operation.  speed [m/s], rpm, flow [m³/s], or texts with units : by default those of the
    case's operation of that kind, else the kind's defaults, and for what drills, rotates or reams the flow of the case,
    the largest of its operations.  rpm : only for kinds that rotate by their name.  friction : factors as one
    set of ``torque_drag``, None for the case's own.  Weight on bit and bit torque are the case's.  Raises InputError
    for input that cannot be used; ``status`` says whether a balance was found.
    """
    with naming_file(case):
        depth = depth_of(bit_depth, case, "bit_depth")
        case = with_friction(case, friction)
        (kind,) = kinds_of([operation])
        return Solver(case).solve(kind, rates_of_all(case, [kind], speed, rpm, flow)[kind], depth)


def lie_of(laid: LaidString) -> Array | None:
    """Offset of each segment over its clearance (n,), 0 to 1, as it lies while it rotates off bottom in mud at rest.

    None where no steady string is found.
    """
    kind, string = "rotate_off_bottom", laid.string
    # On the segments of the string that lies there, buckled or not.
    case = laid.case.model_copy(update={"solver": laid.case.solver.model_copy(update={"buckling": "detect"})})
    point = Solver(case, laid.hole).solve_string(kind, steady_rates(case, kind, flow=0.0), laid.at_rest)
    if not point.answered:
        return None
    walls = point._shape.walls
    share = np.clip(np.linalg.norm(walls.offset, axis=1) / (walls.radius - string.channel_radii[0]), 0.0, 1.0)
    # At the contact points, which are the lower ends of most segments.
    return np.asarray(0.5 * (np.append(share[0], share[:-1]) + share))


def lie_along(case: Case, bit_depth: float) -> tuple[Array, Array]:
    """Where a case's string lies with the bit at a depth [m]: distances from the bit (n,) [m], falling, and ``lie_of``.

    For the ``eccentricity`` of ``hydraulics_of``, ``surge_pressures`` and ``fastest_trips``.  Raises InputError where
    string and hole do not fit, or no steady string is found.

        >>> case = fctd.load_case("examples/pumped_well.toml")
        >>> above, share = fctd.lie_along(case, 3000.0)
        >>> bool(share[-1] > share[0])  # beside the bit it lies farther aside than in the vertical hole at the top
        True
    """
    laid = Solver(case).lay_out(bit_depth)
    share = lie_of(laid)
    if share is None:
        raise InputError("a bit depth at which the solver finds a steady string", key="eccentricity")
    return 0.5 * (laid.string.above_bit[:-1] + laid.string.above_bit[1:]), share
