"""The steady string by root finding: its position, its loads and the readings of the rig, in milliseconds.

The string slides or turns at constant rates while its shape stands still; the forces are the stepper's own
(tangent.py).  Newton's method starts from the guess of a soft string (first_guess.py, continuation.py).
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.case.load import Case, check_bit_depth, naming_file
from fctd.case.operations import KINDS
from fctd.case.units import bare
from fctd.mechanics import state
from fctd.mechanics.contact import START_MD
from fctd.mechanics.laws import CODES
from fctd.mechanics.query import Walls
from fctd.model.drillstring import String, check_fit, fill, lay_out
from fctd.model.operations import SteadyRates, sensors, steady_rates
from fctd.model.wellbore import Wellbore, build_wellbore, hole_frame
from fctd.results.buckling import NOT_BUCKLED, UNKNOWN, Buckling, buckling_along, pipe_of
from fctd.results.notes import Note, string_notes
from fctd.results.profile import Loads, profile_table
from fctd.results.status import SteadyStatus
from fctd.steady import tangent
from fctd.steady.block_thomas import SIZE, negative_pivots, solve_with_pivoting
from fctd.steady.continuation import CONVERGED, NOT_FINITE, UNSOUND, Pace, add_pseudo_mass, converge, take_step
from fctd.steady.first_guess import MD, NODE, guess
from fctd.steady.tangent import (
    AXIAL_MOMENT,
    CONTACT_COLUMNS,
    FORCE,
    JOINT_BENDING,
    JOINT_COLUMNS,
    JOINT_TENSION,
    JOINT_TORQUE,
    NORMAL_FORCE,
    PLACE,
    POSE,
    QUATERNION,
    R_FT,
    R_MU_FN,
    Steady,
    assemble,
    frictionless_tangent,
    read_loads,
)

Array = NDArray[np.float64]

# Largest force out of balance at a body, over the weight of the string.
TOLERANCE = 1e-7
# Lateral imperfection of the first guess, so that a straight string may buckle [m].
SEED = 1e-4
# With large steps most strings converge in some eight iterations.  A string with little clearance needs a pseudo-time
# that shrinks when the imbalance rises; one that buckles needs small steps to converge or to find a stable shape.
# Fields of Pace: iterations, first pseudo-time [s], growth, shrink, largest lateral step [m].
ATTEMPTS = (
    (25, 0.2, 3.0, 1.0, 0.05),
    (60, 0.05, 3.0, 0.3, 0.02),
    (80, 0.1, 1.5, 1.0, 0.02),
    (200, 0.1, 1.1, 1.0, 0.01),
    (300, 0.05, 1.5, 0.3, 0.005),
)
LARGEST_TURN = 0.1  # [rad] per step


@dataclass(frozen=True)
class Equilibrium:
    """A steady string with the bit at one depth.

    status : loads are valid where ``status.has_loads``, also for ``locked_up``, ``under_resolved`` and ``unstable``;
    message : details.
    bit_depth [m]; hookload, weight_indicator, total_contact_force, imbalance [N]; surface_torque, drive_torque [N m];
    sum_r_ft, sum_r_mu_fn [N m] : torques of wall friction, Σ r F_t and Σ r μ F_n.
    """

    case: Case
    operation: str
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
    _shape: "Shape" = field(repr=False)

    @property
    def answered(self) -> bool:
        """Whether the numbers belong to a balance of forces."""
        return self.status.has_loads

    @cached_property
    def profile(self) -> pd.DataFrame:
        """The string from the top to the bit, a row per contact point; columns of ``profile_table``."""
        shape, mud = self._shape, self.case.mud.density
        points = shape.contacts[:, PLACE]
        return profile_table(shape.hole, shape.string, mud, shape.top, points, shape.walls, shape.loads)

    @property
    def buckling(self) -> Buckling:
        """Where the string is buckled; ``UNKNOWN`` where there are no loads."""
        if not self.answered:
            return UNKNOWN
        return self._shape.buckling if self.case.contact.enabled else NOT_BUCKLED

    @cached_property
    def notes(self) -> tuple[Note, ...]:
        """Warnings about the loads; empty where there are no loads."""
        if not self.answered:
            return ()
        shape, in_hole = self._shape, self.case.contact.enabled
        return string_notes(shape.string, shape.loads, self.hookload, shape.walls, shape.radius, in_hole=in_hole)


@dataclass(frozen=True)
class Shape:
    """The data of a profile: rows of ``tangent.read_loads`` (n, ...), and the place of the string's top.

    top (3,), radius (n,) of the contact points [m].
    """

    hole: Wellbore
    string: String
    top: Array
    joints: Array
    contacts: Array
    radius: Array
    owner: NDArray[np.int64]
    bit_tension: float
    bit_torque: float

    @cached_property
    def walls(self) -> Walls:
        """Walls beside the contact points."""
        return self.hole.walls(self.contacts[:, PLACE], self.owner)

    @property
    def loads(self) -> Loads:
        """Loads of the string."""
        tension, torque, bending = (self.joints[:, column] for column in (JOINT_TENSION, JOINT_TORQUE, JOINT_BENDING))
        return Loads(tension, torque, bending, self.contacts[:, NORMAL_FORCE], self.bit_tension, self.bit_torque)

    @cached_property
    def buckling(self) -> Buckling:
        """Where the string is buckled, in a hole with a wall."""
        tension = self.joints[:, JOINT_TENSION]
        if min(tension.min(), self.bit_tension) >= 0:
            return NOT_BUCKLED
        md, radius = self.walls.md, self.walls.radius
        pipe, top_md = pipe_of(self.string), self.string.top_md
        return buckling_along(self.hole, pipe, top_md, md, radius, tension, self.bit_tension)[1]


class Workspace:
    """The solver's arrays, allocated once for a whole chart.

    S : engine's buffer, for the constants of bodies and joints; P (n + 1, POSE) pose; G (n + 1, NODE) guess;
    R (n + 1, 6) imbalance; D, A, U (n + 1, 6, 6) tangent; W elimination; owner (n + 2,) pieces of the hole.
    """

    def __init__(self, segments: int) -> None:
        rows = segments + 2
        self.segments = segments
        self.S = state.new_state(segments)
        self.P, self.G, self.R = np.zeros((rows, POSE)), np.zeros((rows, NODE)), np.zeros((rows, SIZE))
        self.D, self.A, self.U = (np.zeros((rows, SIZE, SIZE)) for _ in range(3))
        self.W = np.zeros((rows, SIZE, SIZE + 1))
        self.owner = np.zeros(rows, np.int64)


class Solver:
    """Steady strings of one case: the hole is built once, the string laid out anew for each bit depth.

    hole : the case's hole, if it has been built already.
    """

    def __init__(self, case: Case, hole: Wellbore | None = None) -> None:
        self.case = case
        self.hole = build_wellbore(case) if hole is None else hole
        self.depths = case.depths
        self.geometry = self.hole.geometry if case.contact.enabled else state.OPEN
        self.law = CODES[case.contact.friction_law]
        self.work = Workspace(0)

    def lay_out(self, bit_depth: float) -> String:
        """The string with the bit at a depth [m]; raises InputError when string and hole do not fit there."""
        check_bit_depth(bit_depth, *self.depths, "bit_depth", f"{bit_depth:g} m")
        string = lay_out(self.case, bit_depth)
        check_fit(self.case, string, self.hole, bit_depth)
        return string

    # Of an iteration that diverged only the status is used; its numbers may overflow.
    @np.errstate(over="ignore", invalid="ignore")
    def solve(self, operation: str, rates: SteadyRates, bit_depth: float) -> Equilibrium:
        """The steady string at a bit depth [m]; raises InputError when string and hole do not fit there."""
        case, hole, string = self.case, self.hole, self.lay_out(bit_depth)
        n = string.segments
        if self.work.segments < n:
            self.work = Workspace(n)
        pipe = fill(self.work.S, string, case)
        on_bottom = KINDS[operation].on_bottom
        weight_on_bit = case.bit.weight_on_bit if on_bottom else 0.0
        _, (downhole,) = hole.at(np.array([bit_depth]))
        push = [float(-weight_on_bit * d) for d in downhole]
        laws = Steady(
            self.geometry, self.law, 1.0, rates.speed, rates.spin, push[0], push[1], push[2],
            case.bit.torque if on_bottom else 0.0,
        )  # fmt: skip
        weight = float(string.of("weight") @ string.length) + weight_on_bit
        # The stiffness of the shortest segments turns the rounding of positions into force.
        rounding = np.finfo(float).eps * bit_depth * float(state.row(self.work.S, state.K_AXIAL, n).max())
        allowed = max(TOLERANCE * weight, 16 * rounding)
        code, iterations, negative, kinks = self._balance(string, laws, weight_on_bit, allowed)

        w = self.work
        assemble(w.S, n, w.P, kinks, hole.pieces, w.owner, laws, w.R, w.D, w.A, w.U)
        joints, contacts = np.zeros((n + 1, JOINT_COLUMNS)), np.zeros((n + 1, CONTACT_COLUMNS))
        read_loads(w.S, n, w.P, kinks, hole.pieces, w.owner, laws, joints, contacts)
        top_axis = hole.at(np.array([string.top_md]))[1][0]
        # Half of a long segment is lumped at the top: the top drive carries its weight and mud load.
        half = 0.5 * string.length[0] if string.long_segment else 0.0
        hung, resisted = half * (pipe.weight - pipe.mud_axial * rates.speed), half * pipe.mud_spin * rates.spin
        hookload, torque = float(w.R[0, FORCE] @ top_axis) + hung, resisted - float(w.R[0, AXIAL_MOMENT])
        joints[1, [JOINT_TENSION, JOINT_TORQUE]] += hung, resisted
        imbalance = float(np.linalg.norm(w.R[1 : n + 1, FORCE], axis=1).max())
        # The hook load of a horizontal string is 0 within rounding.
        pushed = -hookload - case.rig.block_weight > n * allowed
        shape = Shape(
            hole, string, w.P[0, PLACE].copy(), joints[1:], contacts[1:], state.row(w.S, state.RADIUS, n).copy(),
            w.owner[1 : n + 1].copy(), -weight_on_bit, laws.bit_torque,
        )  # fmt: skip
        status, message = self._judge(code, negative, pushed, shape, imbalance)
        indicator, drive = sensors(case, operation, hookload, torque)
        normal, r_ft, r_mu_n = (float(contacts[:, k].sum()) for k in (NORMAL_FORCE, R_FT, R_MU_FN))
        return Equilibrium(
            case, operation, bit_depth, status, message, iterations, hookload, torque, indicator, drive,
            normal, r_ft, r_mu_n, imbalance, shape,
        )  # fmt: skip

    def _balance(self, string: String, laws: Steady, weight_on_bit: float, force: float) -> tuple[int, int, int, Array]:
        """Iterate to a stable balance, more carefully with every attempt, or else to the first balance found.

        Returns code, iterations, number of unstable modes and bends; leaves the pose in the workspace.
        """
        w, n, pieces = self.work, string.segments, self.hole.pieces
        kinks = np.zeros((n + 2, 4))
        kinks[:, 0] = 1.0
        total, code, negative = 0, NOT_FINITE, 0
        unstable: tuple[int, Array, NDArray[np.int64]] | None = None
        for iterations, tau, growth, shrink, shift in ATTEMPTS:
            guess(w.S, n, pieces, laws, string.top_md, -weight_on_bit, SEED, w.G, w.P)
            self._bend(string, kinks)
            w.owner[1 : n + 1] = np.searchsorted(pieces[:, START_MD], w.G[1 : n + 1, MD], side="right") - 1
            pace = Pace(iterations, tau, growth, shrink, shift, LARGEST_TURN, force, force)
            code, done = self._iterate(n, kinks, laws, pace)
            total += done
            if code != CONVERGED:
                continue
            frictionless_tangent(w.S, n, w.P, kinks, pieces, w.owner, laws, w.R, w.D, w.A, w.U)
            negative = negative_pivots(w.D, w.A, w.U, n)
            if negative == 0:
                return code, total, 0, kinks
            if unstable is None:
                unstable = negative, w.P.copy(), w.owner.copy()
        if unstable is not None:
            code, (negative, w.P[:], w.owner[:]) = CONVERGED, unstable
        return code, total, negative, kinks

    def _iterate(self, n: int, kinks: Array, laws: Steady, pace: Pace) -> tuple[int, int]:
        """Run the compiled iteration; steps with a near singular block are solved by ``solve_with_pivoting``."""
        w, pieces = self.work, self.hole.pieces
        done, tau = 0, pace.tau
        while True:
            code, k, tau = converge(
                w.S, n, w.P, kinks, pieces, w.owner, laws, pace._replace(iterations=pace.iterations - done),
                w.R, w.D, w.A, w.U, w.W, tau,
            )  # fmt: skip
            done += k
            if code != UNSOUND:
                return code, done
            assemble(w.S, n, w.P, kinks, pieces, w.owner, laws, w.R, w.D, w.A, w.U)
            add_pseudo_mass(w.S, n, tau, w.D)
            try:
                w.R[1 : n + 1] = solve_with_pivoting(w.D, w.A, w.U, w.R, n)
            except (np.linalg.LinAlgError, ValueError):
                return NOT_FINITE, done
            take_step(w.P, n, w.R, 1.0)
            done += 1

    def _bend(self, string: String, kinks: Array) -> None:
        """Write the bent housings into ``kinks``; the workspace must contain the first guess."""
        for k, component in enumerate(self.case.string.components[: len(string.sections)]):
            # The joint above the component's uppermost segment; joint 1 at the top drive has no bend.
            j = int(np.argmax(string.component == k)) + 1
            if component.bend == 0 or j == 1:
                continue
            _, direction = self.hole.at(self.work.G[j - 1 : j, MD])
            (high,), (right,) = hole_frame(direction)
            towards = np.cos(component.toolface) * high + np.sin(component.toolface) * right
            x, y, _ = tangent.in_frame(*self.work.P[j - 1, QUATERNION], *towards)
            half = 0.5 * component.bend
            kinks[j] = np.cos(half), *(np.sin(half) / np.hypot(x, y) * np.array([-y, x])), 0.0

    def _judge(
        self, code: int, negative: int, pushed: bool, shape: Shape, imbalance: float
    ) -> tuple[SteadyStatus, str]:
        """Status and message of a solution."""
        if code == NOT_FINITE:
            return SteadyStatus.NOT_FINITE, SteadyStatus.NOT_FINITE.message
        if self.geometry != state.OPEN:
            # The limit of a string in motion (faults.py): deeper in the wall than the hole's radius.
            outside = np.linalg.norm(shape.walls.offset, axis=1) + shape.radius > 2 * shape.walls.radius
            if outside.any():
                text = f"segment {int(np.argmax(outside)) + 1} lies deeper in the wall than the hole's radius"
                return SteadyStatus.DIVERGED, f"{text}: use a stiffer wall or a smaller load"
        if code != CONVERGED:
            return (
                SteadyStatus.MAX_ITERATIONS,
                f"forces are out of balance by {imbalance:.3g} N: the string may have no steady shape",
            )
        if pushed:
            return SteadyStatus.LOCKED_UP, SteadyStatus.LOCKED_UP.message
        if self.geometry != state.OPEN and not shape.buckling.resolved:
            return SteadyStatus.UNDER_RESOLVED, shape.buckling.shortfall
        if negative:
            modes = f"{negative} mode{'s' * (negative > 1)}"
            return SteadyStatus.UNSTABLE, f"without friction the balance is unstable in {modes}"
        return SteadyStatus.CONVERGED, ""


def equilibrium(
    case: Case, operation: str, bit_depth: float, speed: float | None = None, rpm: float | None = None
) -> Equilibrium:
    """The steady string of an operation with the bit at ``bit_depth`` [m].

    operation : a kind of operation.  speed [m/s], rpm : by default those of the case's operation of that kind, else
    the kind's defaults.  Weight on bit and bit torque are the case's.  Raises InputError for input that cannot be
    used; ``status`` says whether a balance was found.
    """
    with naming_file(case):
        depth = bare(bit_depth, "bit_depth", "a number of metres")
        return Solver(case).solve(operation, steady_rates(case, operation, speed, rpm), depth)
