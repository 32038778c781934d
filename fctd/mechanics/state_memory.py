"""Where the states of strings lie: side by side in blocks of memory, each string in columns of its own.

A row of a state is a constant offset into its buffer (state.py), so every string needs rows that are as far apart as
those of the longest one.  Of a block with such rows a string of 60 segments uses 80 columns of 10,040.  The others are
for other strings: a state is the same block seen from another column on, which compiled code does not notice.

A string has the columns of its packed operations and a cache line on either side, so that no two strings share one.
Its columns are free again when nothing refers to its state or to a part of it.
"""

from collections import deque
from itertools import count
from threading import Lock

import numpy as np

from fctd.arrays import Array


class Blocks:
    """Blocks of ``rows`` rows that are ``stride`` columns apart, whose columns are given out in whole ``lanes``."""

    def __init__(self, rows: int, stride: int, lanes: int) -> None:
        self.rows, self.stride, self.lanes = rows, stride, lanes
        self._lock = Lock()
        self._numbers = count()
        self._blocks: dict[int, tuple[Array, list[tuple[int, int]]]] = {}
        # Ranges that are no longer in use.  The garbage collector may end a range at any place of a program, also while
        # this thread has the lock, so an ended range waits here for the next call.
        self._ended: deque[tuple[int, int, int]] = deque()

    def take(self, width: int) -> Array:
        """The state of a string with ``width`` columns, a multiple of the lanes: zeros.

        Its column 1 begins a cache line.  It ends with the last column of the last row.
        """
        with self._lock:
            self._collect()
            number, first = self._find(width)
            block = self._blocks[number][0]
        place = Place(self, number, block, first, (self.rows - 1) * self.stride + width, width)
        state = np.asarray(place)
        columns_of(state, self.rows, self.stride)[:] = 0.0
        return state

    @property
    def nbytes(self) -> int:
        """Memory of all blocks [B], as the system has promised it."""
        with self._lock:
            self._collect()
            return sum(block.nbytes for block, _ in self._blocks.values())

    def end(self, number: int, first: int, width: int) -> None:
        """Note that a range of columns is no longer in use."""
        self._ended.append((number, first, width))

    def _find(self, width: int) -> tuple[int, int]:
        """A block and the first of free columns in it, which are then taken."""
        for number, (_, free) in self._blocks.items():
            for k, (first, end) in enumerate(free):
                if end - first >= width:
                    free[k : k + 1] = [(first + width, end)] if end - first > width else []
                    return number, first
        number = next(self._numbers)
        self._blocks[number] = self._new_block(), [(width, self.stride)] if width < self.stride else []
        return number, 0

    def _new_block(self) -> Array:
        """Zeros whose second column begins a cache line.

        numpy aligns to less than a cache line, and a load across two lines takes twice as long.
        """
        numbers = np.zeros(self.rows * self.stride + self.lanes)
        first = -(numbers.ctypes.data // numbers.itemsize + 1) % self.lanes
        return numbers[first : first + self.rows * self.stride]

    def _collect(self) -> None:
        """Make the columns free whose use has ended; of the blocks that are free altogether one stays."""
        while self._ended:
            number, first, width = self._ended.popleft()
            free = self._blocks[number][1]
            joined: list[tuple[int, int]] = []
            for start, end in sorted([*free, (first, first + width)]):
                if joined and joined[-1][1] == start:
                    joined[-1] = joined[-1][0], end
                else:
                    joined.append((start, end))
            free[:] = joined
        empty = [number for number, (_, free) in self._blocks.items() if free == [(0, self.stride)]]
        for number in empty[1:]:
            del self._blocks[number]


class Place:
    """Columns of a block, whose owner is the state that numpy makes of it; its parts refer to that state."""

    def __init__(self, blocks: Blocks, number: int, block: Array, first: int, size: int, width: int) -> None:
        self._block, self._end = block, (blocks, number, first, width)
        self.__array_interface__ = block[first : first + size].__array_interface__

    def __del__(self) -> None:
        blocks, number, first, width = self._end
        blocks.end(number, first, width)


def columns_of(state: Array, rows: int, stride: int) -> Array:
    """A state as a matrix (rows, width) of its own columns."""
    width = len(state) - (rows - 1) * stride
    return np.lib.stride_tricks.as_strided(state, (rows, width), (stride * state.itemsize, state.itemsize))
