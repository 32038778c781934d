"""The flow curve of a mud: shear stress over shear rate, with a yield stress (Herschel & Bulkley 1926)."""

from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array

# Shear rates of the oilfield viscometer (bob 1, rotor 1) at 300 and 600 rev/min [1/s]; API RP 13B-1.
RATE_300, RATE_600 = 511.0, 1022.0
# Least index of a curve's upper end: a mud that is nearly all yield stress has none.
FLATTEST: Final = 0.1


class Rheology(NamedTuple):
    """τ = τ_y + K γⁿ: yield stress [Pa], consistency K [Pa sⁿ] and index n [-], scalars or arrays (n,)."""

    yield_stress: float | Array
    consistency: float | Array
    index: float | Array  # type: ignore[assignment]  # of the curve; nobody searches this tuple

    @classmethod
    def newtonian(cls, viscosity: float | Array) -> Self:
        """A fluid of one viscosity [Pa s]."""
        return cls(0.0, viscosity, 1.0)

    def stress(self, rate: ArrayLike) -> Array:
        """Shear stress [Pa] at shear rates of at least 0 [1/s]."""
        return np.asarray(self.yield_stress + self.consistency * np.asarray(rate, float) ** self.index)

    @property
    def upper_index(self) -> Array:
        """Slope of the curve between 300 and 600 rev/min of the viscometer, RP 13D's n_p; 1 without viscosity."""
        low, high = self.stress(RATE_300), self.stress(RATE_600)
        rise = np.divide(high, low, out=np.full_like(low, RATE_600 / RATE_300), where=low > 0)
        return np.maximum(np.log2(rise), FLATTEST)
