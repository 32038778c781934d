"""Strings that are fed in time: what slides, and when the hook load has settled."""

import pandas as pd
import pytest

from validation.parts import slid_strings
from validation.parts.resolved_rows import DEPTH, horizontal_well
from validation.parts.slid_strings import FED, MOST, SETTLED, Slid, slide

STEP = 0.1  # [m] between records
Records = list[tuple[float, float, float]]


def records(change: float) -> Records:
    """A push that changes by so many weights in every ``FED``, over twice that length; depth, bit and push."""
    return [(k * STEP, k * STEP, 0.5 + change * k * STEP / FED) for k in range(round(2 * FED / STEP) + 1)]


@pytest.mark.parametrize(("change", "settled"), [(0.5 * SETTLED, True), (2.0 * SETTLED, False)])
def test_a_hook_load_has_settled_where_it_hardly_changes_in_ten_metres(change: float, settled: bool) -> None:
    assert slid_strings._has_settled(records(change), 0.0) == settled


def test_a_hook_load_has_not_settled_before_ten_metres_are_fed() -> None:
    assert not slid_strings._has_settled(records(0.0)[: round(0.9 * FED / STEP)], 0.0)


@pytest.mark.parametrize(("share", "push", "slides"), [(1.0, 0.5, True), (0.4, 0.5, False), (1.0, 1.1 * MOST, False)])
def test_a_string_slides_where_its_bit_follows_and_no_rig_is_exceeded(share: float, push: float, slides: bool) -> None:
    assert Slid("completed", share, push, FED, pd.DataFrame()).slides == slides


def test_the_stepper_has_no_bit_on_bottom() -> None:
    with pytest.raises(ValueError, match="drill_sliding does not slide into the hole off bottom"):
        slide(horizontal_well(20.0, "detect"), "drill_sliding", DEPTH)
