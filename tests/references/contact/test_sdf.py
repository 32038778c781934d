"""Sampled distance: order of its error, points beyond its grids, rough holes, cells that are too large."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.model.wellbore import build_wellbore, find_contacts
from references import contact
from references.contact.sdf import Sdf, SdfOptions
from tests.references.wells import HOLE, RADIUS, bent_case, points_near_wall

SHORT = bent_case(
    stations=[[0, 0, 0], [4, 0, 0], [16, 4.8, 0]], intervals=[{"to_md": 16, "diameter": 2 * HOLE, "friction": 0.2}]
)
CELLS = (0.04, 0.03, 0.02, 0.015)


def near_wall(count: int, seed: int = 5) -> np.ndarray:
    rng = np.random.default_rng(seed)
    md, angle = rng.uniform(0.5, 15.5, count), rng.uniform(0, 2 * np.pi, count)
    return build_wellbore(SHORT).off_axis(md, angle, HOLE - RADIUS + rng.uniform(-0.01, 0.01, count))


@pytest.mark.parametrize(("interpolation", "order"), [("linear", 2.0), ("quadratic", 3.0)])
def test_the_error_falls_with_a_power_of_the_cell(interpolation: str, order: float) -> None:
    points = near_wall(400)
    exact = find_contacts(build_wellbore(SHORT), points, RADIUS)
    errors, turns = [], []
    for cell in CELLS:
        hits = contact.build("sdf", SHORT, cell=cell, interpolation=interpolation).query(points, np.full(400, RADIUS))
        errors.append(np.sqrt(np.mean((hits.penetration - exact.penetration) ** 2)))
        turns.append(np.sqrt(np.mean((1 - np.sum(hits.normal * exact.normal, axis=1)).clip(0))))
    assert np.polyfit(np.log(CELLS), np.log(errors), 1)[0] > 0.95 * order
    assert np.polyfit(np.log(CELLS), np.log(turns), 1)[0] > 0.95 * (order - 1)


@pytest.mark.slow
def test_distance_of_a_mesh_is_that_of_the_mesh() -> None:
    """The error that is left is the kink between two facets, over a cell."""
    points, radii = near_wall(300), np.full(300, RADIUS)
    mesh = contact.build("libigl", SHORT).query(points, radii)
    sampled = contact.build("sdf", SHORT, source="mesh").query(points, radii)
    assert np.abs(sampled.penetration - mesh.penetration).max() < 0.25 * 0.02 * np.pi / 48 + 2e-5
    assert np.abs(sampled.md - mesh.md).max() < 0.01


def test_points_beyond_the_grids_are_looked_up_in_the_wall() -> None:
    points, _ = points_near_wall("build", 30)
    case = bent_case()
    exact = find_contacts(build_wellbore(case), points, RADIUS)
    far = points + 0.4 * exact.normal
    hits = contact.build("sdf", case).query(far, np.full(30, RADIUS))
    np.testing.assert_allclose(hits.penetration, exact.penetration + 0.4, atol=1e-9)
    np.testing.assert_allclose(hits.md, exact.md, atol=1e-6)


def test_a_hole_past_90_degrees_whose_points_jump() -> None:
    far = bent_case(
        stations=[[0, 0, 0], [150, 120, 0], [300, 120, 0]],
        intervals=[{"to_md": 300, "diameter": 2 * HOLE, "friction": 0.2}],
    )
    method, hole = contact.build("sdf", far, cell="40 mm"), build_wellbore(far)
    for top, bottom in ((5.0, 100.0), (160.0, 290.0), (20.0, 200.0)):
        md = np.linspace(top, bottom, 40)
        hits = method.query(hole.at(md)[0], np.full(40, RADIUS))
        np.testing.assert_allclose(hits.md, md, atol=0.01)


@pytest.mark.slow
def test_a_washed_out_hole_is_sampled_from_its_mesh() -> None:
    """A washout of four metres, 30 % wider one way: a caliper's wall gives its mesh, and the mesh the distance."""
    rows = [[md, *2 * [HOLE * (1.3 if 6 <= md <= 10 else 1.0), HOLE]] for md in range(3, 14)]
    rough = bent_case(
        stations=[[0, 0, 0], [16, 0, 0]],
        intervals=[{"to_md": 16, "diameter": 2 * HOLE, "friction": 0.2, "kind": "open"}],
        geometry="sampled",
        caliper={"rows": rows, "values": "radius"},
    )
    hole = build_wellbore(rough)
    assert not hole.is_round
    fine = {"facets": 96, "ring_spacing": 0.25}
    mesh, sampled = contact.build("libigl", rough, **fine), contact.build("sdf", rough, cell="30 mm", **fine)
    points = hole.off_axis(np.linspace(4, 12, 200), np.linspace(0, 30, 200), np.full(200, HOLE - RADIUS))
    found, exact = (method.query(points, np.full(200, RADIUS)).penetration for method in (sampled, mesh))
    assert np.ptp(exact) > 0.01
    assert np.abs(found - exact).max() < 1e-3
    with pytest.raises(InputError, match="expected mesh"):
        contact.build("sdf", rough, source="hole")


@pytest.mark.parametrize(
    ("cell", "expected"), [("70 mm", "the clearance of the string"), ("1 mm", r"a larger cell, .* at most 4 GB")]
)
def test_a_cell_that_is_too_large_or_too_small_is_named_with_its_remedy(cell: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected) as error:
        contact.build("sdf", bent_case(), cell=cell)
    assert "sdf.cell" in str(error.value)


def test_the_bound_beside_the_axis_is_that_of_a_cone() -> None:
    near = Sdf(SHORT, SdfOptions(cell=0.04))
    assert near.error_bound(0.0)[0] <= 0.04 / np.sqrt(2)
