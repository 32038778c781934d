"""A string laid out at one bit depth: what its steady strings of all operations and friction factors have in common."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.topdrive import PerMetre
from fctd.model.drillstring import String, fill
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import Pipe, pipe_of

Array = NDArray[np.float64]

# The rows of the engine's buffer that ``fill`` writes.
CONSTANTS = slice(state.MASS // state.STRIDE, state.K_TWIST // state.STRIDE + 1)


@dataclass(frozen=True)
class LaidString:
    """A string in its hole.

    constants (k, n) : of bodies and joints, rows of the engine's buffer; fed : pipe at the top; pipe : what buckling
    depends on; weight : of the string [N]; stiffest : of the axial joints [N/m]; top_axis, bit_axis (3,) : tangents of
    the hole at the string's top and at the bit.
    """

    string: String
    constants: Array
    fed: PerMetre
    pipe: Pipe
    weight: float
    stiffest: float
    top_axis: Array
    bit_axis: Array

    def put(self, S: Array) -> None:
        """Write the constants into a buffer."""
        _constants(S, self.string.segments)[:] = self.constants


# Absurd stiffnesses overflow; ``not_finite`` is their steady status.
@np.errstate(over="ignore", invalid="ignore")
def lay(case: Case, hole: Wellbore, string: String, S: Array) -> LaidString:
    """A laid-out string with what follows from it; the friction factors of the hole do not matter.

    S : a buffer of the engine, in which the constants are computed: a new one takes as long as a third of a solve.
    """
    n = string.segments
    fed = fill(S, string, case)
    weight = float(string.of("weight") @ string.length)
    stiffest = float(state.row(S, state.K_AXIAL, n).max())
    # One after the other: the rounding of a depth must not depend on how many there are.
    top, bit = (hole.at(np.array([md]))[1][0] for md in (string.top_md, string.bit_depth))
    return LaidString(string, _constants(S, n).copy(), fed, pipe_of(string), weight, stiffest, top, bit)


def _constants(S: Array, segments: int) -> Array:
    """View (k, n) of the constants of bodies 1..n."""
    return S.reshape(state.ROWS, state.STRIDE)[CONSTANTS, 1 : 1 + segments]
