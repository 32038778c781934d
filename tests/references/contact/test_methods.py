"""One contract for every contact method of the registry: the exact hole within the geometric error of the method.

Cylinders, arcs, meshes and libraries are tested together here; most modules of the room have no test file of their own.
"""

import functools

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.model.wellbore import Wellbore, build_wellbore, find_contacts
from references import contact
from references.contact.tube_mesh import MeshMethod, curvature_at
from references.registry import absent
from tests.references.wells import HOLE, RADIUS, REGIONS, bent_case, points_near_wall
from validation.cases import load

CASE = bent_case()
# Mesh methods are tested with two resolutions, to show an error that does not depend on it.
MESHES = ("fcl", "coal", "bullet", "mujoco", "libigl", "trimesh")
SETTINGS = [("cylinders", {}), ("cylinders", {"cylinder_length": "6 m"}), ("arcs", {}), ("for_loop", {})]
SAMPLED_MESH = {"cell": "40 mm", "interpolation": "linear", "source": "mesh"}
SETTINGS += [("axis_frame", {}), ("sdf", {}), ("sdf", SAMPLED_MESH)]
SETTINGS += [
    (name, {"facets": facets, "ring_spacing": ring}) for name in MESHES for facets, ring in ((24, 3.0), (96, 1.0))
]
SETTINGS += [(name, {"query": "collide"}) for name in ("fcl", "coal")]
SETTINGS += [(name, {"smooth_normals": True}) for name in ("libigl", "bullet")]
FINE = {"facets": 96, "ring_spacing": 1.0}
IDS = ["-".join([name, *(f"{value}" for value in options.values())]) for name, options in SETTINGS]
BUILT: dict[str, contact.ContactMethod] = {}


@pytest.fixture(
    params=[
        pytest.param((key, setting), id=key, marks=pytest.mark.slow if setting[1] in (FINE, SAMPLED_MESH) else ())
        for key, setting in zip(IDS, SETTINGS, strict=True)
    ]
)
def method(request: pytest.FixtureRequest) -> contact.ContactMethod:
    """A method built for the case; skipped, with the name of its package, where that is missing."""
    key, (name, options) = request.param
    if contact.installed_version(name) is None:
        pytest.skip(f"package {absent(contact.method_class(name).distribution)}")
    if key not in BUILT:
        BUILT[key] = contact.build(name, CASE, **options)
    return BUILT[key]


@functools.cache
def exact_hole() -> Wellbore:
    return build_wellbore(CASE)


def truth(points):
    return find_contacts(exact_hole(), points, RADIUS)


@functools.cache
def curvature(region):
    """Curvature of the arcs of the hole [1/m]."""
    hole = exact_hole()
    md = np.linspace(*REGIONS[region], 500)
    turn = np.linalg.norm(np.diff(hole.at(md)[1], axis=0), axis=1)
    return float(turn.max() / (md[1] - md[0]))


@pytest.mark.parametrize("region", REGIONS)
def test_the_exact_hole_within_the_geometric_error(method: contact.ContactMethod, region: str) -> None:
    points, offset = points_near_wall(region, 120)
    exact = truth(points)
    hits = method.query(points, np.full(len(points), RADIUS))
    depth, turn = method.error_bound(curvature(region))
    # Two per cent more for the errors of mesh rings and overlaps at the ends of a bend.
    depth, rounding = 1.02 * depth, 1e-6

    touching = hits.penetration > 0
    assert (touching | (exact.penetration <= depth + rounding)).all(), "a contact was missed"
    assert (~touching | (exact.penetration >= -depth - rounding)).all(), "a false contact"
    known = np.isfinite(hits.penetration) if method.gives_clearance else touching
    assert known.sum() > 40
    error = hits.penetration - exact.penetration
    assert np.abs(error[known]).max() <= depth + rounding
    direction = np.arccos(np.clip(np.sum(hits.normal * exact.normal, axis=1)[known], -1, 1))
    # A lateral shift of the wall turns the normal by the shift over the distance from the axis.
    assert (direction <= turn + (depth + rounding) / offset[known] + 1e-6).all()
    assert np.allclose(np.linalg.norm(hits.normal[known], axis=1), 1, atol=1e-9)
    shift = curvature(region) * offset.max() * 3.0 + 1e-3
    assert np.abs(hits.md - exact.md)[known].max() <= shift


@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
@pytest.mark.parametrize("name", contact.METHODS)
def test_bends_of_hundreds_of_metres_between_two_stations(name: str, geometry: str) -> None:
    """A course is one arc or many cylinders; a mesh has enough rings in both."""
    if contact.installed_version(name) is None:
        pytest.skip(f"package {absent(contact.method_class(name).distribution)}")
    case, exact = load("s_shape", wellbore__geometry=geometry), build_wellbore(load("s_shape"))
    rng, n = np.random.default_rng(3), 200
    md, angle = rng.uniform(1, 519, n), rng.uniform(0, 2 * np.pi, n)
    radius = 0.084
    points = exact.off_axis(md, angle, HOLE - radius + rng.uniform(-0.01, 0.01, n))
    truth = find_contacts(exact, points, radius)
    method = contact.build(name, case)
    depth, _ = method.error_bound(float(curvature_at(exact, md).max()))
    # Meshes of cylinders have the errors of both.
    depth += case.wellbore.chord_tolerance if geometry == "cylinders" and isinstance(method, MeshMethod) else 1e-6
    hits = method.query(points, np.full(n, radius))
    known = np.isfinite(hits.penetration)
    assert known[truth.penetration > depth].all()
    assert known.sum() > 80
    assert np.abs(hits.penetration - truth.penetration)[known].max() <= depth


def test_methods_without_clearance_return_no_values_for_clear_points(method: contact.ContactMethod) -> None:
    points, _ = points_near_wall("build", 60)
    hits = method.query(points, np.full(60, RADIUS))
    clear = hits.penetration <= 0
    assert clear.any()
    for part in hits:
        assert np.isfinite(part[~clear]).all()
    if method.gives_clearance:
        assert np.isfinite(hits.penetration[clear]).all()
    else:
        assert (hits.penetration[clear] == -np.inf).all()
        assert np.isnan(hits.normal[clear]).all()
        assert np.isnan(hits.md[clear]).all()


def test_points_beyond_the_wall_are_deeper_than_their_radius(method: contact.ContactMethod) -> None:
    """A distance has no sign.  Methods without clearance compute the overlap of two surfaces, which is largest while
    the centre of the sphere is still inside the hole."""
    points, _ = points_near_wall("build", 30)
    exact = truth(points)
    wanted = np.maximum(0.08, 0.08 + exact.penetration) if method.gives_clearance else np.full(30, 0.7 * RADIUS)
    beyond = points + (wanted - exact.penetration)[:, None] * exact.normal
    hits = method.query(beyond, np.full(30, RADIUS))
    depth, _ = method.error_bound(curvature("build"))
    assert np.abs(hits.penetration - wanted).max() <= 1.02 * depth + 1e-6
    assert (np.sum(hits.normal * exact.normal, axis=1) > 0.9).all()


@pytest.mark.parametrize("name", ["cylinders", "arcs"])
def test_points_that_jump_in_a_well_past_90_degrees_are_searched_anew(name: str) -> None:
    """They also lie between the end planes of a distant piece, where a search from their last piece would stop."""
    far = bent_case(
        stations=[[0, 0, 0], [450, 120, 0], [1000, 120, 0]],
        intervals=[{"to_md": 1000, "diameter": 2 * HOLE, "friction": 0.2}],
    )
    method, hole = contact.build(name, far), build_wellbore(far)
    radii = np.full(40, RADIUS)
    for top, bottom in ((5.0, 200.0), (700.0, 990.0), (20.0, 400.0)):
        md = np.linspace(top, bottom, 40)
        hits = method.query(hole.at(md)[0], radii)
        np.testing.assert_allclose(hits.md, md, atol=0.01)


def test_each_point_has_its_own_radius(method: contact.ContactMethod) -> None:
    points, _ = points_near_wall("turn", 60)
    radii = np.where(np.arange(60) % 2, RADIUS, RADIUS + 0.02)
    hits, same = method.query(points, radii), method.query(points, np.full(60, RADIUS + 0.02))
    wide = radii > RADIUS
    np.testing.assert_allclose(hits.penetration[wide], same.penetration[wide], atol=1e-9)
    both = (hits.penetration > 0) & (same.penetration > 0) & ~wide
    assert both.sum() > 5
    np.testing.assert_allclose((same.penetration - hits.penetration)[both], 0.02, atol=2e-6)


def test_results_do_not_depend_on_earlier_queries(method: contact.ContactMethod) -> None:
    points, _ = points_near_wall("build", 50)
    others, _ = points_near_wall("turn", 50, seed=8)
    radii = np.full(50, RADIUS)
    first = method.query(points, radii)
    method.query(others, radii)
    for before, after in zip(first, method.query(points, radii), strict=True):
        np.testing.assert_allclose(after, before, atol=1e-12)


def test_a_query_with_another_number_of_points(method: contact.ContactMethod) -> None:
    points, _ = points_near_wall("build", 70)
    many = method.query(points, np.full(70, RADIUS))
    one = method.query(points[3:4], np.full(1, RADIUS))
    assert one.penetration.shape == (1,)
    assert one.normal.shape == (1, 3)
    np.testing.assert_allclose(one.penetration[0], many.penetration[3], atol=1e-12)


@pytest.mark.parametrize("name", contact.METHODS)
def test_every_class_has_the_name_of_its_registry_entry(name: str) -> None:
    assert contact.method_class(name).name == name


@pytest.mark.parametrize(
    ("name", "options", "expected"),
    [
        ("fcll", {}, "fcl"),
        ("fcl", {"facets": 0}, "fcl.facets = 0: expected a whole number at least 3"),
        ("coal", {"facets": 2}, "coal.facets = 2"),
        ("bullet", {"ring_spacing": "0 m"}, "bullet.ring_spacing"),
        (
            "trimesh",
            {"ring_spacing": "300 m"},
            'ring_spacing = "300 m": expected at most the length of the hole, 240 m',
        ),
        ("bullet", {"facets": 400, "ring_spacing": 1.0}, "at most the 174762 triangles that bullet accepts"),
        ("fcl", {"query": "guess"}, "fcl.query"),
        ("libigl", {"smooth_normals": "maybe"}, "expected true or false"),
        ("fcl", {"ring": 1}, "ring_spacing"),
        ("arcs", {"facets": 4}, "facets"),
        ("cylinders", {"cylinder_length": "0.1 m"}, "overlap"),
    ],
)
def test_bad_options_are_an_input_error(name: str, options: dict, expected: str) -> None:
    if name in contact.METHODS and contact.installed_version(name) is None:
        pytest.skip(f"package {absent(contact.method_class(name).distribution)}")
    with pytest.raises(InputError) as error:
        contact.build(name, CASE, **options)
    assert expected in str(error.value)
