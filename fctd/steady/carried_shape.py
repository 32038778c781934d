"""The shapes of a buckled string at the depth above, with which those of a resolved row begin.

A string that goes deeper takes its shape along: above the bit compression and wave hardly change.  From there it comes
to rest in some fifty iterations, where the path from small loads (climb.py) takes a thousand.
"""

from collections.abc import Callable
from typing import Any, Final, NamedTuple, Self

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model import layouts
from fctd.model.frames import carried_frame
from fctd.steady.climb import STEP_ITERATIONS, Climb, come_to_rest, keep
from fctd.steady.continuation import CONVERGED
from fctd.steady.first_guess import MD, OFFSET, TENSION, TORQUE
from fctd.steady.helix import Helix
from fctd.steady.post_buckling import LAYOUTS, Resolved, is_resolved, lay_helix, needed_lengths, shorter
from fctd.steady.problem import FULL, Problem, Share
from fctd.steady.tangent import JOINT_TENSION, JOINT_TORQUE

LEAST_CLEARANCE: Final = 1e-6  # [m]


class CarriedShape(NamedTuple):
    """A shape of a string, by the ends of its n segments from the top to the bit; all (n + 1,).

    above_bit [m]; low, right : offset from the hole's axis along ``carried_frame``, as shares of the clearance;
    tension [N], torque [N m] : of the joint there, and at the bit.
    """

    above_bit: Array
    low: Array
    right: Array
    tension: Array
    torque: Array

    def lay(self, problem: Problem, above: float = 0.0) -> None:
        """Lay a string in this shape, with its bit at another depth; above [m] : its top is above where it will be."""
        problem.lay_guess(above=above)
        nodes, n = problem.work.G, problem.n
        above_bit = problem.string.bit_depth - above - nodes[: n + 1, MD]
        low, right, tension, torque = (np.interp(-above_bit, -self.above_bit, of)[:, None] for of in self[1:])
        first, second = carried_frame(problem.hole.at(nodes[1 : n + 1, MD])[1])
        clearance = problem.walls(problem.reactions().contacts).radius - problem.string.contact_radius()
        nodes[1 : n + 1, OFFSET : OFFSET + 3] = clearance[:, None] * (low[1:] * first + right[1:] * second)
        nodes[: n + 1, TENSION], nodes[: n + 1, TORQUE] = tension[:, 0], torque[:, 0]
        problem.lay_nodes()


class Carried(NamedTuple):
    """What a row begins with: the shapes of the row above, and the segments in which they stand.

    above_bit (m,) [m], falling; needed (m,) : the largest length of a segment there [m].  snaking : None where its
    loads are those of the helix; helix : None where no part of the string has that shape.
    """

    above_bit: Array
    needed: Array
    snaking: CarriedShape | None
    helix: CarriedShape | None

    def facts(self) -> dict[str, Any]:
        """The shapes as JSON takes them, to the last bit."""
        return {name: None if of is None else np.asarray(of).tolist() for name, of in self._asdict().items()}

    @classmethod
    def restore(cls, facts: dict[str, Any]) -> Self:
        """The shapes of ``facts``."""
        snaking, helix = (of and CarriedShape(*map(np.array, of)) for of in (facts["snaking"], facts["helix"]))
        return cls(np.array(facts["above_bit"]), np.array(facts["needed"]), snaking, helix)


def carry(resolved: Resolved) -> Carried | None:
    """What the next depth begins with; None where a shape has no pose at the loads of the operation."""
    problem, snaking, helix = resolved
    if snaking.pose is None or (helix is not None and helix.pose is None):
        return None
    md, needed = needed_lengths(problem, snaking if helix is None else helix)
    wave = None if helix is snaking else _shape(problem, snaking)
    return Carried(problem.string.bit_depth - md, needed, wave, None if helix is None else _shape(problem, helix))


def begin(case: Case, above: Carried, bit_depth: float, lay: Callable[[Case], Problem]) -> Resolved | None:
    """The shapes of a string that begins with those of the row above.

    None where it does not come to rest in them, and where a helix is due that the row above has not: then the path
    from small loads decides.  lay : makes a problem of a case with other segments.
    """
    first = above.snaking if above.helix is None else above.helix
    assert first is not None  # a row above has one of them
    needed, iterations = (bit_depth - above.above_bit, above.needed), 0
    for _ in range(LAYOUTS):
        finer = layouts.with_components(case, layouts.resolved(case, bit_depth, *needed))
        if layouts.segments_in_hole(finer, bit_depth) > state.MAX_SEGMENTS:
            return None
        problem = lay(finer)
        path = _rest(problem, first, iterations)
        if path is None or (above.helix is not None and not _is_wound(problem, path)):
            return None
        if is_resolved(problem, path):
            break
        # What is compressed reaches higher than before.
        needed, first, iterations = (
            shorter(needed, needed_lengths(problem, path)),
            _shape(problem, path),
            path.iterations,
        )
    else:
        return None
    if above.helix is None:
        return None if Helix(problem).is_due(FULL) else Resolved(problem, path, None)
    if above.snaking is None:
        return Resolved(problem, path, path)
    snaking = _rest(problem, above.snaking, path.iterations)
    return None if snaking is None else Resolved(problem, snaking, path)


def _rest(problem: Problem, shape: CarriedShape, iterations: int) -> Climb | None:
    """The path of one balance to which a string comes from a shape, if any; iterations : those before."""
    shape.lay(problem)
    code, done = come_to_rest(problem, STEP_ITERATIONS, FULL)
    path = Climb(iterations=iterations + done)
    if code != CONVERGED:
        return None
    keep(problem, path, FULL)
    path.pose = path.balances[-1].pose
    return path


def _is_wound(problem: Problem, path: Climb) -> bool:
    """Whether the string is a helix wherever that is due; a longer one is laid anew."""
    helix = Helix(problem)
    helix.take_up(FULL)
    return lay_helix(problem, helix, path, FULL) and helix.turns > 0


def _shape(problem: Problem, path: Climb) -> CarriedShape:
    """The shape at the end of a path."""
    assert path.pose is not None  # the caller has looked
    problem.put_pose(path.pose)
    return shape_of(problem)


def shape_of(problem: Problem, share: Share = FULL) -> CarriedShape:
    """The shape of a string in its pose, in balance with these loads."""
    found, bit_depth = problem.reactions(share), problem.string.bit_depth
    walls = problem.walls(found.contacts)
    # A bit at gauge has none.
    clearance = np.maximum(walls.radius - problem.string.contact_radius(), LEAST_CLEARANCE)
    low, right = ((walls.offset * of).sum(axis=1) / clearance for of in carried_frame(problem.hole.at(walls.md)[1]))
    return CarriedShape(
        bit_depth - np.append(problem.string.top_md, walls.md),
        np.append(0.0, low),
        np.append(0.0, right),
        np.append(found.joints[:, JOINT_TENSION], problem.bit_tension(share)),
        np.append(found.joints[:, JOINT_TORQUE], found.joints[-1, JOINT_TORQUE]),
    )
