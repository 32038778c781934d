"""The shape of a steady string: the data of its profile, its walls and its buckling."""

from dataclasses import dataclass

from fctd.arrays import Array
from fctd.mechanics.query import Walls, walls_in
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import Buckling, buckling_of
from fctd.results.profile import Loads
from fctd.steady.laid_string import LaidString
from fctd.steady.reading import EXCESS, MODE
from fctd.steady.tangent import JOINT_BENDING, JOINT_TENSION, JOINT_TORQUE, NORMAL_FORCE


@dataclass(frozen=True)
class Shape:
    """The data of a profile: rows of ``tangent.read_loads`` and ``query.query_walls`` (n, ...), the place of the
    string's top.

    top (3,) [m]; numbers : of ``reading.read_shape``.
    """

    hole: Wellbore
    laid: LaidString
    top: Array
    joints: Array
    contacts: Array
    beside: Array
    numbers: Array
    bit_tension: float
    bit_torque: float

    @property
    def radius(self) -> Array:
        """Radii (n,) at the contact points [m]."""
        return self.laid.string.contact_radius()

    @property
    def walls(self) -> Walls:
        """Walls beside the contact points."""
        return walls_in(self.beside)

    @property
    def loads(self) -> Loads:
        """Loads of the string."""
        tension, torque, bending = (self.joints[:, column] for column in (JOINT_TENSION, JOINT_TORQUE, JOINT_BENDING))
        return Loads(tension, torque, bending, self.contacts[:, NORMAL_FORCE], self.bit_tension, self.bit_torque)

    @property
    def buckling(self) -> Buckling:
        """Where the string is buckled, in a hole with a wall."""
        mode, *stretch = self.numbers[MODE : EXCESS + 1].tolist()
        return buckling_of(int(mode), *stretch)
