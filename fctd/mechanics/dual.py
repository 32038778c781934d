"""Square root, reciprocal and power without branches, for differentiation by a complex step.

numba's complex square root and division guard against overflow, which costs a dozen branches and keeps a loop
from packing.  A complex step of 1e-30 needs no such guard: the first-order rule is exact to rounding.  For a float
these are the plain operations.
"""

import numpy as np
from numba import types
from numba.extending import overload

from fctd.mechanics.jit import INLINED
from fctd.mechanics.state import TINY


def root(x):
    """√x."""
    return np.sqrt(x)


def reciprocal(x):
    """1/x."""
    return 1 / x


def power(x, p):
    """x^p of x ≥ 0 with p ≥ 1."""
    return x**p


@overload(root, jit_options=INLINED)
def _root(x):
    if isinstance(x, types.Complex):

        def rule(x):
            value = np.sqrt(x.real)
            return complex(value, 0.5 * x.imag / (value + TINY))

        return rule
    return lambda x: np.sqrt(x)


@overload(reciprocal, jit_options=INLINED)
def _reciprocal(x):
    if isinstance(x, types.Complex):

        def rule(x):
            value = 1 / x.real
            return complex(value, -x.imag * value * value)

        return rule
    return lambda x: 1 / x


@overload(power, jit_options=INLINED)
def _power(x, p):
    if isinstance(x, types.Complex):

        def rule(x, p):
            return complex(x.real**p, p * x.real ** (p - 1) * x.imag)

        return rule
    return lambda x, p: x**p
