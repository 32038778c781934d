"""The contract for every contact method of the suite, and what the contract's holes do not have.

Cylinders, arcs, meshes and libraries are tested together here; most modules of the room have no test file of their own.
"""

import functools
from typing import Any

import numpy as np
import pytest

from fctd.arena.contract import DEMANDS, Demand, Trial, far_away, held, options, search
from fctd.case.errors import InputError
from fctd.model.wellbore import build_wellbore, find_contacts
from references import contact
from references.contact.tube_mesh import MeshMethod, curvature_at
from references.registry import absent
from tests.references.wells import HOLE, RADIUS, bent_case
from validation.cases import load

CASE = bent_case()
# Mesh methods are tested with two resolutions, to show an error that does not depend on it.
MESHES = ("fcl", "coal", "bullet", "mujoco", "libigl", "trimesh")
SETTINGS: list[tuple[str, dict[str, Any]]] = [("cylinders", {}), ("arcs", {}), ("for_loop", {})]
SETTINGS += [("cylinders", {"cylinder_length": "6 m"})]
SAMPLED_MESH: dict[str, Any] = {"cell": "40 mm", "interpolation": "linear", "source": "mesh"}
SETTINGS += [("axis_frame", {}), ("sdf", {}), ("sdf", SAMPLED_MESH)]
SETTINGS += [
    (name, {"facets": facets, "ring_spacing": ring}) for name in MESHES for facets, ring in ((24, 3.0), (96, 1.0))
]
SETTINGS += [(name, {"query": "collide"}) for name in ("fcl", "coal")]
SETTINGS += [(name, {"smooth_normals": True}) for name in ("libigl", "bullet")]
FINE: dict[str, Any] = {"facets": 96, "ring_spacing": 1.0}
IDS = ["-".join([name, *(f"{value}" for value in options.values())]) for name, options in SETTINGS]
# What is asked of each setting; the others are asked of each method, or are remarks.
HERE = [demand for demand in DEMANDS if demand not in (far_away, options, search)]


@functools.cache
def trials() -> dict[str, Trial]:
    return {}


def trial_of(name: str, chosen: dict[str, Any]) -> Trial:
    """A method in the holes of the contract; skipped, with the name of its package, where that is missing."""
    if contact.installed_version(name) is None:
        pytest.skip(f"package {absent(contact.method_class(name).distribution)}")
    return Trial(contact.method_class(name), chosen)


@pytest.fixture(
    params=[
        pytest.param((key, setting), id=key, marks=pytest.mark.slow if setting[1] in (FINE, SAMPLED_MESH) else ())
        for key, setting in zip(IDS, SETTINGS, strict=True)
    ]
)
def trial(request: pytest.FixtureRequest) -> Trial:
    key, (name, chosen) = request.param
    if key not in trials():
        trials()[key] = trial_of(name, chosen)
    return trials()[key]


@pytest.mark.parametrize("demand", HERE, ids=lambda demand: demand.__name__)
def test_the_contract(trial: Trial, demand: Demand) -> None:
    found = held(demand, trial)
    assert found.kept, found.says


@pytest.mark.slow(10)
@pytest.mark.parametrize("name", contact.METHODS)
def test_the_contract_far_from_the_origin(name: str) -> None:
    """A hole of nine kilometres takes meshes and grids some seconds to build."""
    found = held(far_away, trial_of(name, {}))
    assert found.kept, found.says


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
def test_bad_options_are_an_input_error(name: str, options: dict[str, Any], expected: str) -> None:
    if name in contact.METHODS and contact.installed_version(name) is None:
        pytest.skip(f"package {absent(contact.method_class(name).distribution)}")
    with pytest.raises(InputError) as error:
        contact.build(name, CASE, **options)
    assert expected in str(error.value)
