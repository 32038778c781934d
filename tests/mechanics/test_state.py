"""The layout of the state buffer."""

import re
from pathlib import Path

import pytest

from fctd.mechanics import state, waves


def test_every_row_has_its_own_place() -> None:
    """Two quantities at one offset would overwrite each other silently; the offsets are written by hand."""
    source = Path(state.__file__).read_text()
    rows = [int(number) for number in re.findall(r"\b(\d+) \* STRIDE\b", source.split("class Laws")[0])]
    assert sorted(rows) == list(range(state.ROWS))


def test_the_stride_holds_the_largest_string_and_its_last_packed_operation() -> None:
    assert state.STRIDE >= state.MAX_SEGMENTS + 2 + state.LANES
    assert state.STRIDE & (state.STRIDE - 1)  # no power of two
    with pytest.raises(ValueError, match="at most 10000 segments"):
        state.new_state(state.MAX_SEGMENTS + 1)
    assert state.LEAST_COLUMNS >= 2 * waves.TORSION
