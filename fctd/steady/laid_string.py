"""A string laid out at one bit depth: what its steady strings of all operations and friction factors have in common."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics.topdrive import PerMetre
from fctd.model.drillstring import String
from fctd.model.operations import BitLoads, bit_loads
from fctd.model.string_in_hole import excess_pressure, fill
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import Pipe, pipe_of


@dataclass(frozen=True)
class LaidString:
    """A string in its hole, whose friction factors do not matter."""

    case: Case
    hole: Wellbore
    string: String

    def put(self, S: Array) -> PerMetre:
        """Write the string into a buffer of the engine; returns the pipe at the top."""
        return fill(S, self.string, self.case, self.hole)

    @cached_property
    def excess(self) -> Array:
        """See ``excess_pressure``."""
        return excess_pressure(self.string, self.hole)

    @cached_property
    def _packed(self) -> float:
        """Push of the fluids on an end that moves in a seal bore [N]: the area of the bore times their difference.

        Of the steel the bore leaves the ring to its inner radius open to the pressure inside, and that to its outer one
        to the pressure outside.  What is left of both in the effective tension is the bore alone.
        """
        bore = self.case.mud.packer_bore
        return 0.0 if bore is None else 0.25 * float(np.pi) * bore**2 * float(self.excess[-1])

    def bit_loads(self, case: Case, operation: str) -> BitLoads:
        """Loads at the lower end in an operation: those of a case on its bit, and what pushes on a packer."""
        own = bit_loads(case, operation)
        if case.mud.packer_bore is None:
            return own
        return own._replace(weight=own.weight + self._packed) if self._packed else own

    @cached_property
    def is_bent(self) -> bool:
        """Whether a housing in it is bent."""
        return any(part.component.bend != 0 for part in self.string.parts)

    @cached_property
    def pipe(self) -> Pipe:
        """What buckling depends on."""
        return pipe_of(self.string)

    @cached_property
    def top_axis(self) -> Array:
        """Tangent (3,) of the hole at the string's top."""
        return self._tangent(self.string.top_md)

    @cached_property
    def bit_axis(self) -> Array:
        """Tangent (3,) of the hole at the bit."""
        return self._tangent(self.string.bit_depth)

    def _tangent(self, md: float) -> Array:
        direction: Array = self.hole.at(np.array([md]))[1][0]
        return direction
