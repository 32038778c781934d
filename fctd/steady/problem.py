"""A string at one depth under the loads of one operation: arrays of the solver, and what its methods start from."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.contact import FACTOR, FACTOR_AROUND
from fctd.mechanics.query import WALL_COLUMNS, Walls
from fctd.model.bent_housings import bent_joints, kink_of
from fctd.model.operations import SteadyRates
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import buckling_along
from fctd.steady.block_thomas import SIZE, negative_pivots, solve_with_pivoting
from fctd.steady.continuation import NOT_FINITE, UNSOUND, Pace, add_pseudo_mass, converge, limits, take_step
from fctd.steady.first_guess import MD, NODE, find_owners, guess, lay_guess
from fctd.steady.held_friction import Held
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import hole_of, steady_laws
from fctd.steady.pose import PLACE, POSE, QUATERNION
from fctd.steady.reading import ANSWER, LONGEST, SHAPE, STEPS, TOP, Answer, read_shape, read_top
from fctd.steady.relaxation import Creep, relax
from fctd.steady.tangent import (
    CONTACT_COLUMNS,
    JOINT_COLUMNS,
    JOINT_TENSION,
    NORMAL_FORCE,
    Steady,
    assemble,
    frictionless_tangent,
)

# Lateral imperfection of the first guess, so that a straight string may buckle [m].
SEED = 1e-4
# A mode that takes longer to grow [s] is neutral within the imbalance of a balance, as that of a helix rolling round a
# vertical hole is: a kilometre of string swings back a hundred times as fast, in the square.
SLOWEST = 100.0
# Largest angle between a hole in which strings roll and the vertical [rad]: pipe of 300 N/m has 0.3 N/m to one side.
UPRIGHT = 1e-3


class Arrays(NamedTuple):
    """The solver's arrays as compiled code takes them, for n segments at most.

    S : engine's buffer, for the constants of bodies and joints; P (n + 2, POSE) pose; G (n + 2, NODE) guess;
    R (n + 2, 6) imbalance; D, A, U (n + 2, 6, 6) tangent; W elimination; owner (n + 2,) pieces of the hole.
    """

    S: Array
    P: Array
    G: Array
    R: Array
    D: Array
    A: Array
    U: Array
    W: Array
    owner: NDArray[np.int64]


class Workspace(Arrays):
    """The solver's arrays, allocated once for a whole chart."""

    __slots__ = ()

    def __new__(cls, segments: int) -> Self:
        """Arrays for a number of segments; of none, they only wait for ``for_segments``, since S is large."""
        rows = segments + 2
        D, A, U = (np.zeros((rows, SIZE, SIZE)) for _ in range(3))
        return super().__new__(
            cls, state.new_state(segments) if segments else np.zeros(0), np.zeros((rows, POSE)),
            np.zeros((rows, NODE)), np.zeros((rows, SIZE)), D, A, U, np.zeros((rows, SIZE, SIZE + 1)),
            np.zeros(rows, np.int64),
        )  # fmt: skip

    @property
    def segments(self) -> int:
        """The number of segments for which there is room."""
        return len(self.owner) - 2

    def for_segments(self, segments: int) -> "Workspace":
        """This, or a larger one where it is too small; the second has room to spare, as a chart goes deeper."""
        if self.segments >= segments:
            return self
        return Workspace(min(segments * 3 // 2, state.MAX_SEGMENTS) if self.segments else segments)

    @property
    def nbytes(self) -> int:
        """Memory of the arrays [B]; of a state its own columns."""
        return state.columns(self.S).nbytes + sum(array.nbytes for array in self[1:])


class Share(NamedTuple):
    """Loads as shares of those of the operation: of every friction factor, and of the weight on bit."""

    friction: float = 1.0
    weight: float = 1.0


FULL = Share()


# Brings given loads into balance with a string at a share of its loads, within iterations; returns code and iterations.
Settle = Callable[[Share, int], tuple[int, int]]


class Given(NamedTuple):
    """Loads that are given to the contact points: a force along the axis (n,) [N], a torque about it (n,) [N m], the
    share of the wall's friction in them (n,), and of points with such a share the contact loads (n, 3)."""

    force: Array
    torque: Array
    share: Array
    wall: Array


class Pose(NamedTuple):
    """A copy of the string's pose, of the pieces of hole beside it, and of its given loads where they depend on it."""

    P: Array
    owner: NDArray[np.int64]
    given: Given | None = None


class Reactions(NamedTuple):
    """Loads of a string: at the top, hookload [N] and torque [N m]; imbalance [N]; rows of ``read_loads`` (n, ...)."""

    hookload: float
    torque: float
    imbalance: float
    joints: Array
    contacts: Array


@dataclass
class Allowance:
    """Work that the relaxations of a row may still take, iterations times segments; its problems share it."""

    left: float


class Compressed(NamedTuple):
    """Top and contact points of a string, (n + 1, ...), against the buckling limits.

    md [m]; compression [N]; EI [N m²]; rows : of ``buckling_along``.
    """

    md: Array
    compression: Array
    EI: Array
    rows: Array


class Problem:
    """What the solver's iterations work on; the pose is in the workspace and changes in place.

    string, hole; weight : of the string and on the bit [N]; allowed : largest imbalance of a body when converged [N];
    at_axis : see ``tangent.Steady``; given : loads of contact points (wave_force.py), and settle : of a string with
    homogenised waves, brings them into balance with it; held : of one that is fed (feed.py); allowance : what
    relaxations may still take.
    """

    def __init__(
        self, case: Case, hole: Wellbore, work: Workspace, laid: LaidString, operation: str, rates: SteadyRates,
        allowance: Allowance,
    ) -> None:  # fmt: skip
        self.case, self.hole, self.work, self.rates = case, hole, work, rates
        self.laid = laid = laid.in_flow(rates)
        self.operation = operation
        self.string = laid.string
        self.n = self.string.segments
        self.fed = laid.put(work.S)
        self.weight_on_bit, self.bit_torque = laid.bit_loads(case, operation)
        self.weight, self.allowed = limits(
            work.S, self.n, self.string.bit_depth, self.weight_on_bit, self.fed, self._top_length
        )
        self.kinks = np.zeros((self.n + 2, 4))
        self.kinks[:, 0] = 1.0
        self.at_axis = 0
        rows = state.GIVEN_FORCE, state.GIVEN_TORQUE, state.GIVEN_FRICTION
        force, torque, share = (state.row(work.S, row, self.n) for row in rows)
        self.given = Given(force, torque, share, np.zeros((self.n, 3)))
        self.settle: Settle | None = None
        self.held: Held | None = None
        self.allowance = allowance

    @property
    def _top_length(self) -> float:
        """Length of a long segment at the top [m], else 0."""
        return float(self.string.length[0]) if self.string.long_segment else 0.0

    @property
    def is_driven(self) -> bool:
        """Whether rotation or the torque at the bit may drive the string round the hole."""
        return bool(self.rates.spin != 0 or self.bit_torque != 0)

    @property
    def can_roll(self) -> bool:
        """Whether the string turns in a vertical hole, with friction that drives it round and mud that resists."""
        if self.rates.spin == 0 or self.hole.geometry == state.OPEN or not self.has_friction:
            return False
        md = np.append(self.string.top_md, self.string.top_md + np.cumsum(self.string.length))
        across = np.linalg.norm(self.hole.at(md)[1][:, :2], axis=1)
        return bool((across < UPRIGHT).all() and state.row(self.work.S, state.MUD_LATERAL, self.n).any())

    @property
    def slides_down(self) -> bool:
        """Whether the block feeds it into the hole against friction, without rotation."""
        return bool(self.rates.speed > 0 and self.rates.spin == 0) and self.has_friction

    @property
    def has_friction(self) -> bool:
        """Whether a wall holds the string anywhere."""
        return bool(self.hole.pieces[:, [FACTOR, FACTOR_AROUND]].any())

    def laws(self, share: Share = FULL) -> Steady:
        """Motion, friction and bit loads at a share of the loads."""
        x, y, z = (-self.weight_on_bit * share.weight * self.laid.bit_axis).tolist()
        hole, (speed, spin, _) = hole_of(self.case, [self.hole]), self.rates
        torque = self.bit_torque * share.weight
        return steady_laws(hole, share.friction, speed, spin, x, y, z, torque, self.at_axis)._replace(held=self.held)

    def lay_guess(self, share: Share = FULL, above: float = 0.0) -> None:
        """Lay the string where a soft string would press on the hole; above [m] : its top is above where it will be."""
        w, top_md, tension = self.work, self.string.top_md - above, self.bit_tension(share)
        guess(
            w.S, self.n, self.hole.pieces, self.laws(share), top_md, tension, self.laid.pipe.radius, SEED, w.G, w.P
        )  # fmt: skip
        self._bend()
        self._find_owners()

    def lay_nodes(self) -> None:
        """Lay the string on the nodes of the workspace: offset, tension and torque."""
        w = self.work
        lay_guess(w.S, self.n, self.hole.pieces, self.laws().geometry, w.G, w.P)
        self._find_owners()

    def iterate(self, pace: Pace, share: Share = FULL) -> tuple[int, int]:
        """Newton's method from the pose; returns code and iterations."""
        w, n, pieces, kinks, laws = self.work, self.n, self.hole.pieces, self.kinks, self.laws(share)
        done, tau = 0, pace.tau
        while True:
            code, k, tau = converge(w, n, kinks, pieces, laws, pace._replace(iterations=pace.iterations - done), tau)
            done += k
            if code != UNSOUND:
                return code, done
            # A step with a near singular block.
            assemble(w.S, n, w.P, kinks, pieces, w.owner, laws, w.R, w.D, w.A, w.U)
            add_pseudo_mass(w.S, n, tau, w.D)
            try:
                w.R[1 : n + 1] = solve_with_pivoting(w.D, w.A, w.U, w.R, n)
            except (np.linalg.LinAlgError, ValueError):
                return NOT_FINITE, done
            take_step(w.P, n, w.R, 1.0)
            done += 1

    def relax(self, creep: Creep, share: Share = FULL) -> tuple[int, int]:
        """Let the string come to rest from the pose, within the allowance; returns code and iterations."""
        most = int(self.allowance.left // self.n)
        limited = creep._replace(iterations=min(creep.iterations, most))
        code, done = relax(self.work, self.n, self.kinks, self.hole.pieces, self.laws(share), limited)
        self.allowance.left -= done * self.n
        return code, done

    @property
    def is_spent(self) -> bool:
        """Whether the allowance has no iteration left."""
        return self.allowance.left < self.n

    def bare_tangent(self, share: Share, tau: float) -> None:
        """Fill the tangent without friction, with the pseudo-mass of a pseudo-time [s]."""
        w, laws = self.work, self.laws(share)._replace(held=None)
        frictionless_tangent(w.S, self.n, w.P, self.kinks, self.hole.pieces, w.owner, laws, w.R, w.D, w.A, w.U)
        add_pseudo_mass(w.S, self.n, tau, w.D)

    def unstable_modes(self, share: Share = FULL, tau: float = SLOWEST) -> int:
        """Number of modes in which the pose would leave its balance without friction, in less than a time [s]."""
        w = self.work
        self.bare_tangent(share, tau)
        return int(negative_pivots(w.D, w.A, w.U, self.n))

    def reactions(self, share: Share = FULL) -> Reactions:
        """Loads of the string in its pose."""
        w, n, laws = self.work, self.n, self.laws(share)
        args = w.S, n, w.P, self.kinks, self.hole.pieces, w.owner, laws
        assemble(*args, w.R, w.D, w.A, w.U)
        joints, contacts = np.zeros((n + 1, JOINT_COLUMNS)), np.zeros((n + 1, CONTACT_COLUMNS))
        hookload, torque, imbalance = read_top(
            *args, w.R, self.fed, self._top_length, self.laid.top_axis, joints, contacts
        )
        given = self.given.share > 0
        contacts[1:, NORMAL_FORCE:][given] = self.given.wall[given]
        return Reactions(hookload, torque, imbalance, joints[1:], contacts[1:])

    def answer(self, iterations: int) -> Answer:
        """What is read from the string in its pose; iterations : that it took."""
        n, found, numbers, string, hole = self.n, self.reactions(), np.zeros(ANSWER), self.string, self.hole
        walls = np.empty((n, WALL_COLUMNS))
        read_shape(
            hole.pieces, hole.geometry, self.case.contact.enabled, hole.bends, float(string.top_md), self.laid.pipe,
            string.contact_radius(), string.table, string.bodies, string.body_weight, self.laid.excess,
            self.bit_tension(), self.bit_torque,
            found.hookload, self.work.owner[1 : n + 1], found.joints, found.contacts, walls, numbers[SHAPE:],
        )  # fmt: skip
        if self.settle is not None:
            numbers[SHAPE + LONGEST] = 0.0  # its segments need not bend
        numbers[STEPS:TOP] = iterations, found.hookload, found.torque, found.imbalance, self.allowed
        numbers[TOP:SHAPE] = self.work.P[0, PLACE]
        return Answer(numbers, found.joints, found.contacts, walls)

    def walls(self, contacts: Array) -> Walls:
        """Walls beside the contact points (n, ...) of ``reactions``."""
        return self.hole.walls(contacts[:, PLACE], self.work.owner[1 : self.n + 1], self.string.contact_radius())

    def compressed(self, share: Share = FULL) -> Compressed:
        """The string in its pose against the buckling limits."""
        string, found = self.string, self.reactions(share)
        walls, tension = self.walls(found.contacts), found.joints[:, JOINT_TENSION]
        bit_tension = self.bit_tension(share)
        rows, _ = buckling_along(self.hole, self.laid.pipe, string.top_md, walls.md, walls.radius, tension, bit_tension)
        md, EI = np.append(string.top_md, walls.md), string.of("EI")
        return Compressed(md, -np.append(tension, bit_tension), np.append(EI[0], EI), rows)

    def bit_tension(self, share: Share = FULL) -> float:
        """Effective tension at the bit [N]."""
        return -self.weight_on_bit * share.weight

    def copy_pose(self) -> Pose:
        """A copy of the pose."""
        given = None if self.settle is None else Given(*(row.copy() for row in self.given))
        return Pose(self.work.P[: self.n + 1].copy(), self.work.owner[: self.n + 1].copy(), given)

    def put_pose(self, pose: Pose) -> None:
        """Put a copied pose back."""
        self.work.P[: self.n + 1], self.work.owner[: self.n + 1], given = pose
        for row, copied in zip(self.given, given or (), strict=False):
            row[:] = copied

    def _find_owners(self) -> None:
        find_owners(self.hole.pieces, self.n, self.work.G, self.work.owner)

    def _bend(self) -> None:
        """Write the bent housings into ``kinks``; the workspace must contain the first guess."""
        for j, part in bent_joints(self.string).items():
            _, (direction,) = self.hole.at(self.work.G[j - 1 : j, MD])
            x, y = kink_of(part, self.work.P[j - 1, QUATERNION], direction)
            self.kinks[j] = np.cos(0.5 * part.bend), x, y, 0.0
