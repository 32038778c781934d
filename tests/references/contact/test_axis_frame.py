"""Contact at fixed measured depths: exact where a node was found, and off by the arc's distance from its tangent."""

import numpy as np
import pytest

from fctd.model.wellbore import build_wellbore, find_contacts
from references import contact
from tests.references.wells import HOLE, RADIUS, bent_case

BEND = np.radians(12) / 30  # curvature of the build [1/m]


@pytest.mark.parametrize("way", [0.25, 0.5, 1.0])
def test_a_node_that_slid_is_off_by_its_way_squared(way: float) -> None:
    """On the outside of the bend, in its plane: κs²/2 deeper than it is, by the section where it was found."""
    case = bent_case()
    hole, method, radii = build_wellbore(case), contact.build("axis_frame", case, drift=1.2), np.full(20, RADIUS)
    md = np.linspace(65, 110, 20)
    offset, low_side = np.full(20, HOLE - RADIUS + 0.005), np.full(20, np.pi)
    found = method.query(hole.off_axis(md, low_side, offset), radii)
    np.testing.assert_allclose(found.penetration, 0.005, atol=1e-9)
    moved = hole.off_axis(md + way, low_side, offset)
    after, exact = method.query(moved, radii), find_contacts(hole, moved, RADIUS)
    error = exact.penetration - after.penetration
    np.testing.assert_allclose(error, 0.5 * BEND * way**2, rtol=0.03)
    assert (np.abs(error) <= method.error_bound(BEND)[0]).all()
    np.testing.assert_allclose(after.md, md, atol=1e-6)


def test_a_node_beyond_its_drift_is_found_anew() -> None:
    case = bent_case()
    hole, method, radii = build_wellbore(case), contact.build("axis_frame", case), np.full(2, RADIUS)
    angle, offset = np.zeros(2), np.full(2, HOLE - RADIUS)
    method.query(hole.off_axis(np.array([70.0, 100.0]), angle, offset), radii)
    moved = hole.off_axis(np.array([70.5, 101.5]), angle, offset)
    np.testing.assert_allclose(method.query(moved, radii).md, [70.0, 101.5], atol=1e-6)


def test_a_node_past_the_end_of_the_hole_keeps_its_section(monkeypatch: pytest.MonkeyPatch) -> None:
    """A string with its bit at the end stretches beyond it; its last node was searched anew at each step."""
    case = bent_case()
    hole, method, radii = build_wellbore(case), contact.build("axis_frame", case), np.full(1, RADIUS)
    end, along = (part[0] for part in hole.at(np.array([hole.total_depth])))
    aside = np.cross(along, [0.0, 0.0, 1.0])
    point = (end + 2.0 * along + (HOLE - RADIUS + 0.004) * aside / np.linalg.norm(aside))[None]
    found = method.query(point, radii)
    np.testing.assert_allclose(found.penetration, 0.004, atol=1e-9)
    np.testing.assert_allclose(found.md, hole.total_depth + 2.0, atol=1e-6)
    monkeypatch.setattr(hole.__class__, "walls", None)  # which the search asks
    np.testing.assert_array_equal(method.query(point, radii).penetration, found.penetration)
