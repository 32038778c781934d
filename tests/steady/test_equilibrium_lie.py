"""Where a string lies across its hole: on the axis where the hole is vertical, on the low side where it is not."""

import numpy as np
import pytest

from fctd import equilibrium, hydraulics_of, lie_along
from fctd.case.errors import InputError
from fctd.steady.equilibrium import Solver, lie_of
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


def test_a_string_without_a_steady_lie_is_taken_as_concentric_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    mud = {"density": 1200.0, "viscosity": 0.03, "eccentricity": "string"}
    case = make_case([[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]], SLEEVES, mud=mud)
    known = equilibrium(case, "trip_in", 1100.0)
    monkeypatch.setattr("fctd.steady.equilibrium.lie_of", lambda laid: None)
    unknown = equilibrium(case, "trip_in", 1100.0)
    concentric = case.model_copy(update={"mud": case.mud.model_copy(update={"eccentricity": 0.0})})
    assert unknown.lift == equilibrium(concentric, "trip_in", 1100.0).lift > known.lift
    assert "flow_lie" in {note.code for note in unknown.notes}
    with pytest.raises(InputError, match="a bit depth at which the solver finds a steady string"):
        lie_along(case, 1100.0)


def test_pressures_of_a_flow_may_be_those_of_the_string_where_it_lies() -> None:
    mud = {"density": 1200.0, "viscosity": 0.03, "eccentricity": "string"}
    case = make_case([[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]], SLEEVES, mud=mud)
    lost = [
        float(hydraulics_of(case, 0.03, [1100.0], eccentricity)["annulus_drop_Pa"].iloc[0])
        for eccentricity in (0.0, lie_along, 1.0)
    ]
    assert lost[0] > lost[1] > lost[2] > 0


def test_a_string_that_the_first_attempt_does_not_find_has_the_lie_of_its_row() -> None:
    """A bent housing is left to the methods in Python: its string was taken as concentric."""
    mud = {"density": 1200.0, "viscosity": 0.03, "eccentricity": "string"}
    motor = pipe(8.0, 2, outer=0.165, inner=0.07, bend=0.01)
    case = make_case([[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]], [motor, *SLEEVES], mud=mud)
    found = equilibrium(case, "trip_in", 1100.0)
    assert "flow_lie" not in {note.code for note in found.notes}
    laid = Solver(case).lay_out(1100.0)
    straight = Solver(make_case([[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]], SLEEVES, mud=mud))
    share, other = lie_of(laid), lie_of(straight.lay_out(1100.0))
    assert share is not None
    assert other is not None
    slant = (laid.string.above_bit[:-1] > 50) & (laid.string.above_bit[1:] < 300)
    assert share[slant] == pytest.approx(other[-2], abs=0.02)
