"""Many steady strings of a case in one compiled call: layout, first guess, Newton's method, readings.

A row is a string at one depth under the loads of one operation, in a hole with one set of friction factors.  It does
not depend on the rows beside it, nor on the thread that solves it.  A row that is not in a stable balance after the
first attempt (balance.py) is left to the methods in Python.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import accumulate
from threading import local
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.model.operations import SteadyRates
from fctd.model.string_in_hole import damping_of
from fctd.model.string_rows import WAVE_RADIUS, WAVE_STIFFNESS, fill_rows, find_contacts
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import Pipe
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.block_thomas import negative_pivots
from fctd.steady.continuation import CONVERGED, Pace, converge, limits
from fctd.steady.first_guess import axis_at, find_owners, guess, piece_at
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import Hole, hole_of, steady_laws
from fctd.steady.problem import SEED, Workspace
from fctd.steady.reading import (
    ALLOWED,
    ANSWER,
    HOOKLOAD,
    IMBALANCE,
    SHAPE,
    SHAPE_COLUMNS,
    SOLVED,
    STEPS,
    TOP,
    TORQUE,
    Answer,
    read_shape,
    read_top,
)
from fctd.steady.tangent import frictionless_tangent

Scalar = TypeVar("Scalar", bound=np.generic)
Part = TypeVar("Part")
Found = TypeVar("Found")

ITERATIONS, TAU, GROWTH, SHRINK, SHIFT, NARROW = ATTEMPTS[0]
# Columns of the loads of a row.
SPEED, SPIN, WEIGHT_ON_BIT, BIT_TORQUE, LOADS = 0, 1, 2, 3, 4

laws_of = inlined(steady_laws)


class Row(NamedTuple):
    """A row of a batch; friction : index of the hole."""

    laid: LaidString
    friction: int
    operation: str
    rates: SteadyRates


class Strings(NamedTuple):
    """Strings of a case, one after the other.

    first (m + 1,) : of their segments in length [m], component and bodies (N,), see ``String``; long_segment (m,);
    bit_depth (m,) [m];
    sections : a row for each component; weights (3, N) : of ``String.weights``; damping (N, 3), squeeze (N,), given
    (N,), per_metre : see ``fill_rows``; excess (N + m,) : pressure inside less that outside [Pa], at the top and the
    contact points of each string.
    """

    first: NDArray[np.int64]
    length: Array
    component: NDArray[np.int64]
    bodies: NDArray[np.int64]
    long_segment: NDArray[np.bool_]
    bit_depth: Array
    top_md: float
    sections: Array
    weights: Array
    damping: Array
    squeeze: Array
    given: Array
    excess: Array
    per_metre: bool


NO_ROOM = Workspace(0)
# The arrays of each thread, kept from one chart to the next: to clear new ones takes as long as a row.
_OWN = local()
UNSOLVED = Answer(np.zeros(ANSWER), *(np.zeros((0, k)) for k in SHAPE_COLUMNS))


def on_threads(solve: Callable[[Part], Found], parts: Iterable[Part], threads: int) -> Iterator[Found]:
    """``solve(part)`` of each part, in their order, on a number of threads.

    A thread does all of a part, its Python too: threads that wait for another one's stand idle.  A few parts beyond
    those that the threads work on are solved ahead, so that the answers of a long chart do not fill the memory.
    """
    if threads == 1:  # in this thread, whose clock then counts the work
        yield from map(solve, parts)
        return
    waiting = deque[Future[Found]]()
    with ThreadPoolExecutor(threads) as pool:
        for part in parts:
            if len(waiting) == 2 * threads:
                yield waiting.popleft().result()
            waiting.append(pool.submit(solve, part))
        while waiting:
            yield waiting.popleft().result()


class Batches:
    """``solve_batch`` of one batch after the other, on any number of threads.

    holes : the case's, with each set of friction factors.
    """

    def __init__(self, case: Case, holes: Sequence[Wellbore]) -> None:
        self._case = case
        # Two kinds of compiled code, for factors that are equal along and around the string and for others: a row does
        # not depend on whether its chart needs both.
        self._kinds = [hole.orthotropic for hole in holes]
        self._places = [self._kinds[:k].count(kind) for k, kind in enumerate(self._kinds)]
        self._holes = {
            kind: hole_of(case, [hole for hole in holes if hole.orthotropic == kind]) for kind in set(self._kinds)
        }

    def solve(self, rows: Sequence[Row]) -> list[Answer]:
        """What the first attempt finds of rows."""
        longest = max((row.laid.string.segments for row in rows), default=0)
        _OWN.work = work = getattr(_OWN, "work", NO_ROOM).for_segments(longest)
        found: dict[int, Answer] = {}
        for kind, hole in self._holes.items():
            of_kind = {k: row for k, row in enumerate(rows) if self._kinds[row.friction] == kind}
            there = [row._replace(friction=self._places[row.friction]) for row in of_kind.values()]
            found |= dict(zip(of_kind, solve_batch(self._case, hole, there, work), strict=True))
        return [found[k] for k in range(len(rows))]


def solve_batch(case: Case, hole: Hole, rows: Sequence[Row], work: Workspace) -> list[Answer]:
    """What the first attempt finds of rows of a case; work : for as many segments as the longest string has.

    Nothing of a string with a bent housing, which only the methods in Python know.
    """
    straight = [row for row in rows if not row.laid.is_bent]
    if len(straight) < len(rows):
        found = iter(solve_batch(case, hole, straight, work))
        return [UNSOLVED if row.laid.is_bent else next(found) for row in rows]
    if not rows:
        return []
    flowing = [row.laid.in_flow(row.rates) for row in rows]
    laid = {id(of): of for of in flowing}
    places = {key: k for k, key in enumerate(laid)}
    which = np.array([(places[id(of)], row.friction) for of, row in zip(flowing, rows, strict=True)])
    loads = np.array(
        [
            (row.rates.speed, row.rates.spin, *of.bit_loads(case, row.operation))
            for of, row in zip(flowing, rows, strict=True)
        ],
        float,
    )
    packed = _pack(case, list(laid.values()))
    answers = np.zeros((len(rows), ANSWER))
    most = max(of.string.segments for of in laid.values()) + 1
    joints, contacts, walls = (np.zeros((len(rows), most, k)) for k in SHAPE_COLUMNS)
    solve_rows(hole, packed, which, loads, work, answers, joints, contacts, walls)
    ends = [of.string.segments + 1 for of in flowing]
    return [Answer(answers[k], *(of[k, 1:end] for of in (joints, contacts, walls))) for k, end in enumerate(ends)]


def _joined(arrays: Sequence[NDArray[Scalar]], axis: int = 0) -> NDArray[Scalar]:
    """Arrays one after the other; a single one as it is, since a steady string alone has no time to copy."""
    return arrays[0] if len(arrays) == 1 else np.concatenate(arrays, axis)


def _pack(case: Case, laid: Sequence[LaidString]) -> Strings:
    strings = [of.string for of in laid]
    first = np.array([0, *accumulate(string.segments for string in strings)])
    still, total = all(of.circuit is None for of in laid), int(first[-1])
    return Strings(
        first,
        _joined([string.length for string in strings]),
        _joined([string.component for string in strings]),
        _joined([string.bodies for string in strings]),
        np.array([string.long_segment for string in strings]),
        np.array([string.bit_depth for string in strings], float),
        float(case.string.top_md),
        max((string.table for string in strings), key=len),
        _joined([string.weights for string in strings], axis=1),
        _joined([damping_of(case, of.string, of.hole) for of in laid]),
        _joined([of.squeeze for of in laid]),
        np.zeros(total) if still else _joined([of.given for of in laid]),
        np.zeros(total + len(strings)) if still and not case.mud.given else _joined([of.excess for of in laid]),
        case.wellbore.stiffness_per_length is not None,
    )


@entry
def solve_rows(hole, strings, which, loads, w, answers, joints, contacts, walls):
    """Fill answers (r, ANSWER), joints, contacts and walls (r, n + 1, ...) of rows.

    which (r, 2) : string and set of friction factors; loads (r, LOADS); w : the ``Workspace``.
    """
    most = len(w.owner)
    kinks = np.zeros((most, 4))
    kinks[:, 0] = 1.0
    middle, radius, tributary = np.empty(most, np.bool_), np.empty(most), np.empty(most)
    stiffness, clearing = np.empty(most), np.empty(most)
    for r in range(len(which)):
        k = which[r, 0]
        first, last = strings.first[k], strings.first[k + 1]
        n, long_segment = last - first, strings.long_segment[k]
        length, component = strings.length[first:last], strings.component[first:last]
        weight, body_weight = strings.weights[0][first:last], strings.weights[1][first:last]
        fed = fill_rows(
            w.S, length, component, strings.sections, weight, long_segment, strings.damping[first:last],
            strings.squeeze[first:last], strings.given[first:last], strings.per_metre,
        )  # fmt: skip
        find_contacts(length, component, strings.sections, long_segment, middle, radius, tributary)
        for j in range(n):
            section = strings.sections[component[j]]
            stiffness[j], clearing[j] = section[WAVE_STIFFNESS], max(radius[j], section[WAVE_RADIUS])
        pipe = Pipe(stiffness[:n], strings.weights[2][first:last], clearing[:n], length, middle[:n])
        solve_row(
            w, n, kinks, hole.pieces[which[r, 1]], hole, pipe, radius[:n], fed, length[0] if long_segment else 0.0,
            strings.top_md, strings.bit_depth[k], strings.sections, strings.bodies[first:last], body_weight,
            strings.excess[first + k : last + k + 1], loads[r], answers[r], joints[r, : n + 1],
            contacts[r, : n + 1], walls[r, 1 : n + 1],
        )  # fmt: skip


@kernel
def solve_row(
    w, n, kinks, C, hole, pipe, radius, fed, top_length, top_md, bit_depth, sections, component, body_weight, excess,
    loads, answer, joints, contacts, walls,
):  # fmt: skip
    """Fill the answer of one string, whose constants are in the workspace; its pose is then there too."""
    S, P, G, R, D, A, U, _W, owner = w
    pressing, torque = loads[WEIGHT_ON_BIT], loads[BIT_TORQUE]
    i = piece_at(C, C.shape[0] - 1, bit_depth)
    _, _, _, bx, by, bz = axis_at(C, hole.geometry, i, bit_depth)
    bit = -pressing * bx, -pressing * by, -pressing * bz
    laws = laws_of(hole, 1.0, loads[SPEED], loads[SPIN], *bit, torque, 0)
    _, allowed = limits(S, n, bit_depth, pressing, fed, top_length)
    guess(S, n, C, laws, top_md, -pressing, pipe.radius, SEED, G, P)
    find_owners(C, n, G, owner)
    pace = Pace(ITERATIONS, TAU, GROWTH, SHRINK, SHIFT, NARROW, LARGEST_TURN, allowed, allowed)
    code, steps, _ = converge(w, n, kinks, C, laws, pace, TAU)
    if code != CONVERGED:
        return
    # The forces out of balance are still in R.
    axis = np.empty(3)
    _, _, _, axis[0], axis[1], axis[2] = axis_at(C, hole.geometry, piece_at(C, 0, top_md), top_md)
    hookload, reaction, imbalance = read_top(S, n, P, kinks, C, owner, laws, R, fed, top_length, axis, joints, contacts)
    frictionless_tangent(S, n, P, kinks, C, owner, laws, R, D, A, U)
    if negative_pivots(D, A, U, n) > 0:
        return
    answer[SOLVED], answer[STEPS], answer[ALLOWED] = 1.0, steps, allowed
    answer[HOOKLOAD], answer[TORQUE], answer[IMBALANCE] = hookload, reaction, imbalance
    answer[TOP], answer[TOP + 1], answer[TOP + 2] = P[0, 0], P[0, 1], P[0, 2]
    read_shape(
        C, hole.geometry, hole.with_wall != state.OPEN, hole.bends, top_md, pipe, radius, sections, component,
        body_weight, excess, -pressing, torque, hookload, owner[1 : n + 1], joints[1:], contacts[1:], walls,
        answer[SHAPE:],
    )  # fmt: skip
