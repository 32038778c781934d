"""A helix as the shape of a string wherever it has the lower energy.

In a level hole a helix has w r − r² F²/8EI a metre more energy than the straight string (clearance r, weight w,
compression F).  That of snaking, by Mitchell's equation, is equal to it at 1.45 times the onset 2√(EI w/r).  Snaking
never becomes a helix by more load alone: the helix is laid into the string, with θ′ = √(F/2EI) (Lubinski, Althouse &
Logan 1962), and comes to rest from there.  A torque M winds it in its own sense, of the lower energy, with
θ′ = [1.5M + √(2.25M² + 8EIF)]/4EI (Miska & Cunha 1995).
"""

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.model.frames import carried_frame
from fctd.results.buckling import SINUSOIDAL_LIMIT
from fctd.steady.first_guess import MD, OFFSET, TENSION, TORQUE
from fctd.steady.problem import FULL, Problem, Reactions, Share
from fctd.steady.tangent import JOINT_TENSION, JOINT_TORQUE

# Compression over the sinusoidal limit above which the helix has the lower energy.
LOWER_ENERGY = 1.45
# A helix of fewer turns is not laid, and not laid anew for fewer turns more.
LEAST_TURNS = 1.0
# Share of the turns laid that a string at rest must have to count as a helix.
STILL = 0.7


def winding_rate(EI: Array, compression: Array, torque: Array) -> Array:
    """Rate θ′ (n,) of a helix wound in the sense of its torque [rad/m]."""
    push, twist = np.maximum(compression, 0.0), 1.5 * np.abs(torque)
    return np.asarray((twist + np.sqrt(twist**2 + 8 * EI * push)) / (4 * EI))


class Helix:
    """Lays a helix into a string while its loads grow, wherever the helix has the lower energy.

    turns : laid last.  beyond (n,) : which contact points it goes through.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.turns = 0.0
        self.beyond = np.zeros(problem.n, np.bool_)

    def prepare(self, share: Share) -> bool:
        """Lay the helix, if it is at least a turn longer than before; returns whether it was.

        share : loads of the balance that the string is in.
        """
        problem, n, string = self.problem, self.problem.n, self.problem.string
        found = problem.reactions(share)
        beyond, rate, turns = self._due(share, found)
        if turns < self.turns + LEAST_TURNS:
            return False
        if found.joints[beyond, JOINT_TORQUE].sum() > 0:
            rate = -rate
        walls = problem.walls(found.contacts)
        self.turns, self.beyond = turns, beyond
        low, right = carried_frame(problem.hole.at(walls.md)[1])
        offset = walls.offset.copy()
        # From the lower end of each stretch upwards, beginning where the string lies.
        angle = np.arctan2((offset * right).sum(axis=1), (offset * low).sum(axis=1))
        clearance = walls.radius - string.contact_radius()
        for j in range(n - 1, -1, -1):
            if not beyond[j]:
                continue
            if j + 1 < n and beyond[j + 1]:
                angle[j] = angle[j + 1] + rate[j + 1] * string.length[j + 1]
            offset[j] = clearance[j] * (np.cos(angle[j]) * low[j] + np.sin(angle[j]) * right[j])
        nodes = problem.work.G
        nodes[0, MD] = string.top_md
        nodes[:n, TENSION], nodes[n, TENSION] = found.joints[:, JOINT_TENSION], problem.bit_tension(share)
        nodes[:n, TORQUE] = found.joints[:, JOINT_TORQUE]
        nodes[1 : n + 1, OFFSET : OFFSET + 3] = offset
        problem.lay_nodes()
        return True

    def is_due(self, share: Share) -> bool:
        """Whether it would be laid into the string in its pose; nothing is laid."""
        return self._due(share, self.problem.reactions(share))[2] >= self.turns + LEAST_TURNS

    def take_up(self, share: Share) -> None:
        """Count the turns of the string in its pose as laid."""
        self.beyond = self._due(share, self.problem.reactions(share))[0]
        self.turns = self._turns()

    def is_wound(self) -> bool:
        """Whether a part of the string in its pose is a helix where that has the lower energy, in whatever sense.

        A string that snakes stays on its side of the hole, and each turn of a helix passes the other one.
        """
        self.beyond, _, due = self._due(FULL, self.problem.reactions())
        angle = self._angle()
        passed = np.abs(np.diff(np.floor((angle + np.pi) / (2 * np.pi))))
        return due >= LEAST_TURNS and float(passed[self.beyond[1:] & self.beyond[:-1]].sum()) > LEAST_TURNS

    def stands(self) -> bool:
        """Whether the string in its pose still has most of the turns that were laid."""
        return self.turns > 0 and self._turns() > STILL * self.turns

    def _due(self, share: Share, found: Reactions) -> tuple[NDArray[np.bool_], Array, float]:
        """Contact points (n,) in which a helix has the lower energy, its rate (n,) [rad/m] there and its turns."""
        problem, string = self.problem, self.problem.string
        here = problem.compressed(share)
        compression = here.compression[1:]
        beyond = self.beyond | (compression > LOWER_ENERGY * here.rows[1:, SINUSOIDAL_LIMIT])
        rate = winding_rate(string.of("EI"), compression, found.joints[:, JOINT_TORQUE])
        return beyond, rate, float((rate * string.length)[beyond].sum()) / (2 * np.pi)

    def _turns(self) -> float:
        """Turns of the string in its pose about the hole's axis, in the part through which the helix goes."""
        angle = self._angle()
        both = self.beyond[1:] & self.beyond[:-1]
        return float(abs(np.diff(angle)[both].sum())) / (2 * np.pi)

    def _angle(self) -> Array:
        """Angle of the contact points (n,) round the hole from its low side, which grows on from turn to turn [rad]."""
        problem = self.problem
        walls = problem.walls(problem.reactions().contacts)
        low, right = carried_frame(problem.hole.at(walls.md)[1])
        return np.unwrap(np.arctan2((walls.offset * right).sum(axis=1), (walls.offset * low).sum(axis=1)))
