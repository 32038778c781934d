"""The table of pieces of a hole."""

import numpy as np
import pytest

from fctd.mechanics import contact
from fctd.model.wellbore import build_wellbore
from tests.cases import hole_of, make_case


def test_the_pieces_of_cylinders_overlap_but_at_the_end() -> None:
    hole = hole_of([[0, 0, 0], [40, 0, 0], [40.1, 0, 0], [60, 0, 0]], cylinder_length=10.0, overlap=0.2)
    overlap, length = hole.pieces[:, contact.OVERLAP], hole.pieces[:, contact.LENGTH]
    # No further than half of the next one, which is 100 mm long after 40 m; nothing follows the last.
    np.testing.assert_allclose(overlap, [0.2, 0.2, 0.2, 0.05, 0.2, 0.2, 0.0])
    np.testing.assert_allclose(length, [20.2, 10.2, 10.2, 10.05, 0.3, 10.15, 19.95])
    np.testing.assert_allclose(hole.pieces[:, contact.START_MD], [-10, 10, 20, 30, 40, 40.1, 50.05])
    np.testing.assert_allclose(hole.pieces[:, contact.ALONE_TO], [*(length - overlap)[:-1], np.inf])
    np.testing.assert_allclose(hole.pieces[:, contact.ALONE_FROM], [-np.inf, *overlap[:-1]], atol=1e-9)


def test_a_point_is_alone_beyond_the_overlap_and_the_wedge_of_the_joint() -> None:
    """Where two cylinders meet at an angle, both hold points up to the radius times that angle from the joint.

    The margin is twice the diameter times the angle.
    """
    intervals = [
        {"to_md": 50, "diameter": 0.3, "friction": 0.1},
        {"to_md": 100, "diameter": 0.2, "friction": 0.3},
    ]
    hole = hole_of([[0, 0, 0], [100, 60, 0]], cylinder_length=10.0, overlap=0.1, intervals=intervals)
    bend = 2 * np.sin(0.5 * np.radians(6.0))
    radius = np.array([0.15] * 4 + [0.1] * 5)
    np.testing.assert_allclose(hole.pieces[1:, contact.ALONE_FROM], 0.1 + 4 * radius * bend, rtol=1e-6)


def test_arcs_have_a_straight_piece_at_each_end() -> None:
    hole = hole_of([[0, 10, 30], [300, 40, 30], [400, 40, 120]], geometry="arcs")
    np.testing.assert_allclose(hole.pieces[:, contact.START_MD], [-10, 0, 300, 400])
    np.testing.assert_allclose(hole.pieces[:, contact.LENGTH], [10, 300, 100, 10])
    np.testing.assert_array_equal(hole.pieces[[0, -1], contact.CURVATURE], 0.0)
    assert hole.pieces[1, contact.CURVATURE] == pytest.approx(np.radians(30) / 300)


def test_arcs_lead_through_every_size_of_hole() -> None:
    sizes = [(400, 0.32, 0.1), (600, 0.28, 0.2), (1000, 0.22, 0.3)]
    intervals = [{"to_md": to_md, "diameter": diameter, "friction": friction} for to_md, diameter, friction in sizes]
    hole = hole_of([[0, 0, 0], [1000, 30, 0]], intervals=intervals, geometry="arcs", overlap=0.2)
    walls = hole.walls(hole.at(np.array([399.9, 400.1, 400.3, 599.9, 600.05, 600.3]))[0])
    np.testing.assert_allclose(walls.radius, [0.16, 0.15, 0.14, 0.14, 0.1325, 0.11], atol=1e-9)
    np.testing.assert_allclose(walls.friction, [0.1, 0.15, 0.2, 0.2, 0.225, 0.3], atol=1e-9)


def test_arcs_without_a_shoe_change_at_once() -> None:
    intervals = [{"to_md": 500, "diameter": 0.32, "friction": 0.1}, {"to_md": 1000, "diameter": 0.22, "friction": 0.3}]
    hole = hole_of([[0, 0, 0], [1000, 30, 0]], intervals=intervals, geometry="arcs", overlap=0.0)
    walls = hole.walls(hole.at(np.array([499.99, 500.01]))[0])
    np.testing.assert_allclose(np.stack([walls.radius, walls.friction], axis=1), [[0.16, 0.1], [0.11, 0.3]])


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_below_the_last_interval_the_hole_stays_as_it_is(geometry: str) -> None:
    intervals = [
        {"to_md": 300, "diameter": 0.32, "friction": 0.1},
        {"to_md": 500, "diameter": 0.2159, "friction": 0.3, "stiffness": 5e6},
    ]
    hole = hole_of([[0, 0, 0], [1000, 30, 0]], intervals=intervals, geometry=geometry)
    walls = hole.walls(hole.at(np.array([200.0, 499.0, 501.0, 999.0]))[0])
    np.testing.assert_allclose(np.stack(walls[1:4], axis=1), [[0.16, 1e7, 0.1], *[[0.10795, 5e6, 0.3]] * 3])


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_pieces_carry_what_sticks_in_their_interval(geometry: str) -> None:
    """The excess of the static factor is a share of the kinetic one, which other kinetic factors leave as it is."""
    sticking = {"static_friction": 0.3, "decay_speed": 0.4, "overbalance": 5e6}
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.1},
        {"to_md": 1000, "diameter": 0.22, "friction": 0.2, **sticking},
    ]
    case = make_case(
        [[0, 0, 0], [1000, 30, 0]],
        wellbore={"intervals": intervals, "geometry": geometry},
        contact={"friction_law": "stribeck"},
        mud={"cake": {"friction": 0.1}},
    )
    hole = build_wellbore(case)
    columns = [contact.STATIC_EXCESS, contact.DECAY_SPEED, contact.OVERBALANCE]
    for found in (hole, hole.with_friction(0.5)):
        np.testing.assert_allclose(found.pieces[0, columns], 0.0)
        np.testing.assert_allclose(found.pieces[-1, columns], [0.5, 0.4, 5e6])
