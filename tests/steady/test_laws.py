"""The laws of a steady string: the same from Python and from compiled code."""

import pytest

from fctd.mechanics import state
from fctd.steady.batch import laws_of
from fctd.steady.laws import hole_of, steady_laws
from tests.cases import hole_of as built
from tests.cases import make_case, pipe

MOTION = 0.5, 0.1, -2.0, 1.0, 2.0, -3.0, 40.0, 1


@pytest.mark.parametrize("contact", [{}, {"enabled": False}, {"law": "power", "friction_law": "paper"}])
def test_compiled_code_and_python_have_the_same_laws(contact: dict[str, object]) -> None:
    case = make_case([[0, 0, 0], [300, 0, 0]], [pipe(None, None, segment_length=10.0)], contact=contact)
    hole = hole_of(case, [built([[0, 0, 0], [300, 0, 0]])])
    laws = steady_laws(hole, *MOTION)
    assert laws == laws_of(hole, *MOTION)
    assert (laws.friction_scale, laws.speed, laws.spin, laws.bit_torque, laws.at_axis) == (0.5, 0.1, -2.0, 40.0, 1)
    assert (laws.wall_exponent, laws.wall_reference) == case.contact.wall_law
    assert laws.given == 1.0


def test_a_string_without_contact_is_in_no_hole_but_its_hole_has_a_shape() -> None:
    stations = [[0, 0, 0], [300, 0, 0]]
    case = make_case(stations, [pipe(None, None, segment_length=10.0)], contact={"enabled": False})
    hole = hole_of(case, [built(stations, geometry="arcs")])
    assert (hole.geometry, hole.with_wall) == (state.ARCS, state.OPEN)


def test_sets_of_friction_factors_are_tables_of_pieces() -> None:
    wellbore = built([[0, 0, 0], [300, 0, 0]])
    case = make_case([[0, 0, 0], [300, 0, 0]], [pipe(None, None, segment_length=10.0)])
    assert len(hole_of(case, [wellbore, wellbore.with_friction(0.4)]).pieces) == 2
