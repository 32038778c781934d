"""The arrays of floats that all rooms pass on."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
