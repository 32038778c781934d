"""What ends a run, and the segment it names."""

from collections.abc import Callable

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.mechanics.faults import UnstableError, check


def put(row: int, value: float) -> Callable[[np.ndarray], None]:
    def change(S: np.ndarray) -> None:
        S[row + 3] = value

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (put(state.WZ, np.nan), "not finite"),
        (put(state.PX, 0.16), "segment 3 has left the hole"),
        (put(state.AZ, -1.0), "folded at segment 3"),
        (put(state.QW, -1.0), "segment 3 is twisted"),
    ],
)
def test_a_fault_is_named(change: Callable[[np.ndarray], None], message: str) -> None:
    S = state.new_state(4)
    state.row(S, state.HOLE, 4)[:], state.row(S, state.RADIUS, 4)[:] = 0.1, 0.05
    check(S, 4)
    change(S)
    with pytest.raises(UnstableError, match=message):
        check(S, 4)
