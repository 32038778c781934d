"""Strings that lie side by side in one block of memory."""

import gc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import torque_drag
from fctd.mechanics import state
from fctd.mechanics.state_memory import Blocks, columns_of
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, trip

ROWS, STRIDE, LANES = 5, 19 * 8, 8
BUILD = [[0, 0, 0], [600, 0, 0], [900, 45, 0], [1500, 45, 0]]


@given(steps=st.lists(st.tuples(st.integers(1, 18), st.integers(0, 40)), min_size=1, max_size=40))
def test_no_two_strings_share_a_column(steps: list[tuple[int, int]]) -> None:
    """States of many widths, of which others are given up meanwhile, hold what was written to them."""
    blocks = Blocks(ROWS, STRIDE, LANES)
    kept: list[tuple[np.ndarray, float]] = []
    for number, (lines, give_up) in enumerate(steps, start=1):
        S = blocks.take(lines * LANES)
        own = columns_of(S, ROWS, STRIDE)
        assert own.shape == (ROWS, lines * LANES)
        assert not own.any()
        assert S[1:].ctypes.data % 64 == 0
        own[:] = number
        kept.append((S, float(number)))
        if give_up < len(kept):
            del kept[give_up]
        for each, value in kept:
            assert (columns_of(each, ROWS, STRIDE) == value).all()
    S = own = each = np.zeros(0)
    kept.clear()
    assert blocks.nbytes <= ROWS * STRIDE * 8


def test_a_part_of_a_state_keeps_its_columns() -> None:
    blocks = Blocks(ROWS, STRIDE, LANES)
    part = blocks.take(LANES)[STRIDE : STRIDE + LANES]
    part[:] = 7.0
    assert not columns_of(blocks.take(LANES), ROWS, STRIDE).any()
    assert (part == 7.0).all()


def test_a_string_needs_the_memory_of_its_columns() -> None:
    strings = [state.new_state(60) for _ in range(250)]
    assert len({S.ctypes.data // (8 * state.ROWS * state.STRIDE) for S in strings}) < 10
    assert state.columns(strings[0]).nbytes < 70e3


def test_strings_leave_their_neighbours_alone() -> None:
    """Trips by stands and by a long segment, and charts, find the same numbers between strings of NaN, which stay."""
    bottom = [pipe(30, 3), pipe(60, 5)]
    stands = make_case(BUILD, [*bottom, pipe(None, 12)], [trip(420, 450)], rig={"feed": "stands"})
    fed = make_case(BUILD, [*bottom, pipe(None, 1)], [trip(420, 450)])

    def numbers() -> bytes:
        found = []
        for case in (stands, fed):
            run, phases = prepare(case)
            run.advance(phases[0].motion, 2.0)
            found.append(state.columns(run.S).tobytes())
            found.append(torque_drag(case, "trip_out", [400.0, 430.0], threads=2)["hookload_N"].to_numpy().tobytes())
        return b"".join(found)

    alone = numbers()
    gc.collect()
    strings = [state.new_state(8 * (k % 9) + 8) for k in range(500)]
    neighbours = strings[::2]
    for S in neighbours:
        state.columns(S)[:] = np.nan
    del strings
    assert numbers() == alone
    assert all(np.isnan(state.columns(S)).all() for S in neighbours)


def test_a_copy_is_a_string_of_its_own() -> None:
    S = state.new_state(5)
    copied = state.copy_state(S)
    state.row(S, state.MASS, 5)[:] = 3.0
    assert not state.row(copied, state.MASS, 5).any()
    state.put_state(copied, S)
    assert np.array_equal(state.columns(S), state.columns(copied))
    with pytest.raises(ValueError, match="broadcast"):
        state.put_state(state.new_state(60), S)
