"""Contact methods of rivals: the contract of all methods, and how far single precision takes them from the mesh."""

import numpy as np
import pytest

from fctd.arena.contract import Trial
from fctd.case.errors import InputError
from fctd.model.wellbore import build_wellbore
from references import contact
from references.rivals import METHODS
from tests.references.contact import test_methods as contract
from tests.references.contact.test_methods import test_the_contract as test_the_contract
from tests.references.wells import HOLE, RADIUS, bent_case

pytestmark = pytest.mark.rivals

# Largest distance from the mesh in double precision [m]: to 1 km about the origin of the well, to 8 km in chunks.
WITHIN = {"embree": 1e-4, "warp": 1e-4, "rapier": 2e-4}
MESH = {"facets": 24, "ring_spacing": 3.0}
SETTINGS = [
    (name, {**mesh, **more}) for name in METHODS for mesh in (MESH, contract.FINE) for more in ({}, {"origin": "well"})
]


@pytest.fixture(params=SETTINGS, ids=[f"{name}-{'-'.join(map(str, options.values()))}" for name, options in SETTINGS])
def trial(request: pytest.FixtureRequest) -> Trial:
    """A method of a rival in the holes of the contract."""
    return contract.trial_of(*request.param)


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_bends_of_hundreds_of_metres_between_two_stations(name: str, geometry: str) -> None:
    contract.test_bends_of_hundreds_of_metres_between_two_stations(name, geometry)


def off_the_mesh(depth: float, name: str, origin: str) -> float:
    """Largest distance [m] from the mesh in double precision, in a build and a turn that end at this depth [m]."""
    stations = [[0, 0, 0], [depth - 540, 0, 0], [depth - 240, 60, 0], [depth, 60, 55], [depth + 20, 60, 55]]
    size = [{"to_md": stations[-1][0], "diameter": 2 * HOLE, "friction": 0.2}]
    case, rng, n = bent_case(stations=stations, intervals=size), np.random.default_rng(5), 400
    md, angle = depth - rng.uniform(0.0, 540.0, n), rng.uniform(0, 2 * np.pi, n)
    points = build_wellbore(case).off_axis(md, angle, HOLE - RADIUS + rng.uniform(-0.015, 0.015, n))
    found, mesh = (
        contact.build(each, case, **MESH, **more).query(points, np.full(n, RADIUS))
        for each, more in ((name, {"origin": origin}), ("fcl", {}))
    )
    np.testing.assert_allclose(found.md, mesh.md, atol=0.01)
    return float(np.abs(found.penetration - mesh.penetration).max())


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize(("depth", "origin"), [(1000.0, "well"), (1000.0, "chunk"), (8000.0, "chunk")])
def test_single_precision_is_near_the_mesh(name: str, depth: float, origin: str) -> None:
    assert off_the_mesh(depth, name, origin) <= WITHIN[name]


@pytest.mark.parametrize("name", ["warp", "rapier"])
def test_chunks_are_what_keeps_it_there(name: str) -> None:
    """Embree is asked for a face alone, which is seldom a wrong one."""
    assert off_the_mesh(8000.0, name, "well") > 50 * off_the_mesh(8000.0, name, "chunk")


def test_a_point_on_the_axis_has_a_wall() -> None:
    """A ray needs a direction there."""
    points = np.array([[0.0, 0.0, 20.0], [0.0, 0.0, 31.0]])
    for name in METHODS:
        hits = contact.build(name, contract.CASE, **MESH).query(points, np.full(2, RADIUS))
        depth = contact.build(name, contract.CASE, **MESH).error_bound(0.0)[0]
        np.testing.assert_allclose(hits.penetration, RADIUS - HOLE, atol=depth)


def test_warp_without_a_gpu_is_told() -> None:
    import warp

    if warp.is_cuda_available():
        assert contact.build("warp", contract.CASE, device="cuda", **MESH).pieces > 0
        return
    with pytest.raises(InputError, match=r'device = "cuda": expected "cpu", since there is no GPU of CUDA'):
        contact.build("warp", contract.CASE, device="cuda", **MESH)
