"""The tube mesh: closed except at its ends, normals out of the hole, vertices on the wall, second-order errors."""

import dataclasses

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.model.pieces import RUN_OUT
from fctd.model.wellbore import build_wellbore, find_contacts
from references import contact
from references.contact.tube_mesh import TubeOptions, build_tube, check_tube
from tests.references.wells import HOLE, RADIUS, bent_case, points_near_wall

CASE = bent_case()


def tube_of(facets: int = 24, ring_spacing: float = 3.0, **wellbore):
    return build_tube(bent_case(**wellbore), TubeOptions(facets=facets, ring_spacing=ring_spacing))


def test_lateral_surface_is_closed_and_normals_point_out_of_the_hole() -> None:
    tube = tube_of()
    outline = tube.mesh.outline()
    assert len(outline.entities) == 2
    assert tube.mesh.is_winding_consistent
    hole = build_wellbore(CASE)
    centres = tube.mesh.triangles_center
    inside = (centres[:, 2] > 0) & (tube.md_near(centres) < 240)
    outwards = find_contacts(hole, centres[inside], 0.0).normal
    assert (np.sum(outwards * tube.normals[inside], axis=1) > 0.97).all()


def test_vertices_lie_on_the_wall_of_the_exact_hole() -> None:
    tube = tube_of()
    vertices = np.asarray(tube.mesh.vertices)
    depth = find_contacts(build_wellbore(CASE), vertices, 0.0).penetration
    # A ring between two bends is normal to the mean of their chords, tilted by at most κℓ/2.
    tilt = np.radians(12) / 30 * 3.0 / 2
    assert np.abs(depth).max() < 1.1 * HOLE * tilt**2 / 2
    assert tube.md[[0, -1]] == pytest.approx([-RUN_OUT, 240 + RUN_OUT])
    assert np.diff(tube.md).max() <= 3.0 + 1e-9


def test_errors_of_facets_are_the_sagittas_of_facet_and_chord() -> None:
    """Both of second order; for a 311 mm hole the error is 1.3 mm with 24 facets and 0.08 mm with 96."""
    for facets, sagitta in ((24, 1.33e-3), (96, 0.083e-3)):
        tube = dataclasses.replace(tube_of(facets), radius=0.1556)
        assert tube.error_bound(0.0)[0] == pytest.approx(sagitta, rel=0.01)
    hole = build_wellbore(CASE)

    def worst(facets: int, ring: float) -> float:
        tube = tube_of(facets, ring)
        centres = tube.mesh.triangles_center
        md = tube.md_near(centres)
        edges = np.asarray(tube.mesh.vertices)[np.asarray(tube.mesh.edges_unique)].mean(axis=1)
        bend = (tube.md_near(edges) > 62) & (tube.md_near(edges) < 118)
        assert np.isfinite(md).all()
        return float(np.abs(find_contacts(hole, edges[bend], 0.0).penetration).max())

    bend = np.radians(12) / 30
    for facets, ring in ((24, 0.2), (240, 6.0), (240, 3.0)):
        sagittas = HOLE * (1 - np.cos(np.pi / facets)) + bend * ring**2 / 8
        # The outer side of the bend is longer than the axis by the share κR.
        assert worst(facets, ring) == pytest.approx(sagittas, rel=bend * HOLE)


def test_a_change_of_size_has_rings_of_its_own() -> None:
    sizes = [{"to_md": 100, "diameter": 0.3, "friction": 0.2}, {"to_md": 240, "diameter": 0.2, "friction": 0.2}]
    tube = tube_of(intervals=sizes)
    assert {100.0, 100.2} <= set(np.round(tube.md, 9))
    vertices = np.asarray(tube.mesh.vertices).reshape(len(tube.md), 24, 3)
    radius = np.linalg.norm(vertices - tube.centres[:, None], axis=2)
    np.testing.assert_allclose(radius[tube.md <= 100], 0.15, rtol=1e-9)
    np.testing.assert_allclose(radius[tube.md >= 100.2], 0.1, rtol=1e-9)


def test_ring_axis_and_facet_beside_a_point() -> None:
    """Of the middle of each face: its ring, a foot across the chord of the axis, and its facet, of two faces."""
    tube = tube_of()
    middles, faces = np.asarray(tube.mesh.triangles_center), np.arange(tube.triangles)
    ring = tube.ring_above(middles)
    np.testing.assert_array_equal(ring, faces // (2 * tube.facets))
    span = tube.centres[ring + 1] - tube.centres[ring]
    across = middles - tube.axis_beside(ring, middles)
    np.testing.assert_allclose(np.sum(across * span, axis=1), 0, atol=1e-9)
    for share in (0.5, 1.3):  # inside and beyond the wall
        np.testing.assert_array_equal(tube.face_beside(ring, middles + (share - 1) * across) // 2, faces // 2)


def test_a_missing_triangle_and_a_turned_one_are_found() -> None:
    import trimesh

    tube = tube_of()
    check_tube(tube)
    faces = np.asarray(tube.mesh.faces)
    vertices = np.asarray(tube.mesh.vertices)
    holed = trimesh.Trimesh(vertices, np.delete(faces, 500, axis=0), process=False)
    with pytest.raises(InputError, match="51 open edges"):
        check_tube(dataclasses.replace(tube, mesh=holed))
    turned = faces.copy()
    turned[500] = turned[500][::-1]
    with pytest.raises(InputError, match="point out of the hole"):
        check_tube(dataclasses.replace(tube, mesh=trimesh.Trimesh(vertices, turned, process=False)))
    with pytest.raises(InputError, match="point out of the hole"):
        check_tube(dataclasses.replace(tube, mesh=trimesh.Trimesh(vertices, faces[:, ::-1], process=False)))


def test_spacing_longer_than_the_hole_and_too_many_triangles() -> None:
    with pytest.raises(InputError, match="at most the length of the hole, 240 m"):
        tube_of(ring_spacing=241.0)
    with pytest.raises(InputError, match="triangles"):
        tube_of(facets=100_000, ring_spacing=0.5)


def test_smooth_normals_lean_less_than_those_of_facets() -> None:
    points, _ = points_near_wall("turn", 200)
    exact, worst = find_contacts(build_wellbore(bent_case()), points, RADIUS), []
    for smooth in (False, True):
        hits = contact.build("libigl", bent_case(), smooth_normals=smooth).query(points, np.full(200, RADIUS))
        worst.append(np.arccos(np.clip(np.sum(hits.normal * exact.normal, axis=1), -1, 1)).max())
        np.testing.assert_allclose(np.linalg.norm(hits.normal, axis=1), 1, atol=1e-12)
    assert worst[1] < 0.5 * worst[0]
