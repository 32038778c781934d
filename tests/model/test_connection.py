"""Tool joints: torque at yield and make-up torque, against a maker's sheet, and the note on a torque beyond it."""

import math
from typing import Any

import pytest

from fctd import equilibrium
from fctd.case.pipes.catalogue import INCH, catalogue, pipe_named
from fctd.model.connection import MAKE_UP, make_up_torque, threads, yield_torque
from tests.cases import make_case

FOOT_POUND = 1.3558179483314004
NC50 = threads()["nc50"]


def test_nc50_has_the_torques_of_the_maker_s_sheet() -> None:
    """6 5/8 x 3 1/4 in: 51,200 ft lbf at yield, 30,700 at most to make up (scribd.com/document/552214615)."""
    torque = yield_torque(NC50, 6.625 * INCH, 3.25 * INCH)
    assert torque / FOOT_POUND == pytest.approx(51_200, rel=0.002)
    assert MAKE_UP * torque / FOOT_POUND == pytest.approx(30_700, rel=0.002)


def test_pin_and_box_are_alike_at_the_printed_diameter() -> None:
    """Balance OD of the same sheet, 6.390 in: a wider box makes the connection no stronger, a narrower one weaker."""
    torque = yield_torque(NC50, 6.625 * INCH, 3.25 * INCH)
    assert yield_torque(NC50, 6.40 * INCH, 3.25 * INCH) == pytest.approx(torque, rel=1e-9)
    assert yield_torque(NC50, 6.37 * INCH, 3.25 * INCH) < 0.995 * torque


def test_only_a_connection_that_a_printed_torque_confirms_has_a_make_up_torque() -> None:
    known = {pipe.name for pipe in catalogue() if make_up_torque(pipe) is not None}
    assert known == {"5 in 19.5 S-135 NC50"}
    assert make_up_torque(pipe_named("5 in 19.5 S-135 4 1/2 IF, premium")) == make_up_torque(
        pipe_named("5 in 19.5 S-135 NC50")
    )


@pytest.mark.parametrize("change", [0.98, 1.0])
def test_torque_beyond_the_make_up_torque_is_noted(change: float) -> None:
    """A bit torque at the limit: a limit that is 2 % lower is passed."""
    limit = make_up_torque(pipe_named("5 in 19.5 S-135 NC50"))
    assert limit is not None
    assert limit / FOOT_POUND == pytest.approx(30_700, rel=0.002)
    part: dict[str, Any] = {"pipe": "5 in 19.5 S-135 NC50", "segment_length": 100.0}
    bit = {"weight_on_bit": 1e3, "torque": 0.99 * limit / change}
    case = make_case(components=[part], bit=bit, mud={"density": 1200.0})
    notes = equilibrium(case, "drill_rotating", 900.0, rpm=60).notes
    assert [note.code for note in notes] == (["make_up"] if change < 1 else [])
    assert not math.isinf(limit)
