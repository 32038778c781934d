"""The part of a string above its stuck point."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.model.drillstring import lay_out
from fctd.model.stuck import SHORTEST, above_stuck_point
from tests.cases import make_case, pipe

PARTS = [pipe(100, 10, outer=0.165, name="collars"), pipe(150, 15, outer=0.14, name="heavy"),
         pipe(None, None, segment_length=20.0)]  # fmt: skip


@given(bit=st.floats(400.0, 1000.0), share=st.floats(0.01, 1.0))
def test_what_is_above_is_that_of_the_whole_string(bit: float, share: float) -> None:
    """Each component keeps its place, but for a short end that the one above it takes over."""
    case = make_case(components=PARTS)
    md = share * bit
    whole, above = lay_out(case, bit), lay_out(above_stuck_point(case, bit, md), md)
    for name in ("collars", "heavy"):
        lengths = [
            string.length[[string.parts[k].component.name == name for k in string.component]].sum()
            for string in (whole, above)
        ]
        below = {"collars": 0.0, "heavy": 100.0}[name]
        kept = np.clip(below + lengths[0] - (bit - md), 0.0, lengths[0])
        assert lengths[1] == pytest.approx(kept, abs=SHORTEST + 1e-6)
    assert above.length.sum() == pytest.approx(md)


def test_loads_of_the_bit_stay_below() -> None:
    case = make_case(components=PARTS, bit={"weight_on_bit": 1e5, "torque": 1e3, "overpull": 1e4})
    bit = above_stuck_point(case, 900.0, 500.0).bit
    assert (bit.weight_on_bit, bit.torque, bit.overpull) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(("bit", "md", "message"), [
    (900.0, 901.0, r'stuck_at = "901 m": expected a depth below the string.s top at 0 m, down to its bit at 900 m'),
    (900.0, 0.0, 'stuck_at = "0 m"'),
    (1100.0, 500.0, 'bit_depth = "1100 m"'),
    (900.0, float("nan"), 'stuck_at = "nan m"'),
])  # fmt: skip
def test_a_depth_that_is_not_on_the_string_is_refused(bit: float, md: float, message: str) -> None:
    with pytest.raises(InputError, match=message):
        above_stuck_point(make_case(components=PARTS), bit, md)
