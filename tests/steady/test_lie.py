"""Where a string lies across its hole: on the axis where the hole is vertical, on the low side where it is not."""

import numpy as np
import pytest

from fctd.steady.equilibrium import Solver
from fctd.steady.lie import lie_of
from tests.cases import make_case, pipe

SLEEVES = [pipe(None, None, outer=0.127, contact_diameter=0.168, segment_length=20.0)]


def test_pipe_lies_on_its_tool_joints_in_slant_hole_and_hangs_in_the_middle_of_vertical_hole() -> None:
    case = make_case([[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]], SLEEVES, mud={"eccentricity": "string"})
    laid = Solver(case).lay_out(1150.0)
    share = lie_of(laid)
    assert share is not None
    depth = np.cumsum(laid.string.length)
    hole = 2 * float(laid.hole.intervals[0, 1])
    assert (share[depth < 300] < 0.2).all()
    on_joints = (hole - 0.168) / (hole - 0.127)
    assert share[(depth > 900) & (depth < 1100)] == pytest.approx(on_joints, rel=0.06)  # the wall gives way
    assert laid.eccentricity == pytest.approx(share)


def test_a_case_may_say_where_it_lies() -> None:
    case = make_case([[0, 0, 0], [500, 0, 0]], SLEEVES, mud={"eccentricity": 0.3})
    assert Solver(case).lay_out(400.0).eccentricity == 0.3
