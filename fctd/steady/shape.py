"""The shape of a steady string: the data of its profile, its walls and its buckling."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics.query import Walls
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import NOT_BUCKLED, Buckling, buckling_along
from fctd.results.profile import Loads
from fctd.steady.laid_string import LaidString
from fctd.steady.tangent import JOINT_BENDING, JOINT_TENSION, JOINT_TORQUE, NORMAL_FORCE, PLACE

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """The data of a profile: rows of ``tangent.read_loads`` (n, ...), and the place of the string's top.

    top (3,) [m].
    """

    hole: Wellbore
    laid: LaidString
    top: Array
    joints: Array
    contacts: Array
    owner: NDArray[np.int64]
    bit_tension: float
    bit_torque: float

    @property
    def radius(self) -> Array:
        """Radii (n,) at the contact points [m]."""
        return self.laid.pipe.radius

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
        pipe, top_md = self.laid.pipe, self.laid.string.top_md
        return buckling_along(self.hole, pipe, top_md, md, radius, tension, self.bit_tension)[1]
