"""Cost of a contact query: every contact method from Python, and FCTD's compiled queries.

Times are those of a set of points near the wall; the record has ``ns_per_point`` and the errors relative to the exact
arcs of the hole.
"""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe
from benchmarks.strings import LEAD, chain
from fctd import build_wellbore, find_contacts
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import frame
from fctd.mechanics.query import query_walls
from references import contact
from references.registry import absent
from references.timing.workloads import find_walls, moving

POINTS, RADIUS = 240, 0.051
ROUNDS = 25
COMPILED_CALLS = 40  # per round


def points_near_wall(count: int) -> NDArray[np.float64]:
    """Seeded points near the wall of the curved chain's hole, in its vertical, build and horizontal sections."""
    hole = ExactHole(chain(wellbore__geometry="arcs").wellbore)
    return frame(hole, count, seed=7, radius=RADIUS, md=(1000.0, 2440.0)).places


def errors(penetration: NDArray[np.float64], points: NDArray[np.float64]) -> dict[str, float]:
    """Largest error of penetration [m] and share of contacts missed [%], relative to the exact arcs."""
    exact = find_contacts(build_wellbore(chain(wellbore__geometry="arcs")), points, RADIUS).penetration
    known = np.isfinite(penetration)
    return {
        "penetration_error_m": float(np.abs(penetration - exact)[known].max()),
        "missed_percent": 100 * float(((exact > 0) & ~(penetration > 0)).mean()),
    }


def note_cost(benchmark: BenchmarkFixture, points: int) -> None:
    """Add the median time per point to the record."""
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_point"] = 1e9 * benchmark.stats.stats.median / points


@pytest.mark.parametrize("name", [*contact.METHODS, *contact.REGISTRY.plugins()])
def bench_query_from_python(benchmark: BenchmarkFixture, name: str) -> None:
    """One call for all points."""
    if contact.installed_version(name) is None:
        pytest.skip(absent(contact.method_class(name).distribution))
    method, points = contact.build(name, chain()), points_near_wall(POINTS)
    radii = np.full(POINTS, RADIUS)
    describe(benchmark, "query from Python", points=POINTS, pieces=method.pieces)
    benchmark.extra_info |= errors(method.query(points, radii).penetration, points)
    benchmark.pedantic(method.query, args=(points, radii), rounds=ROUNDS, warmup_rounds=2)
    note_cost(benchmark, POINTS)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def bench_query_compiled(benchmark: BenchmarkFixture, geometry: str) -> None:
    """Compiled query of free points with the piece of the last call, as the steady solver and users call it."""
    hole, points = build_wellbore(chain(wellbore__geometry=geometry)), points_near_wall(POINTS)
    owner, out = hole.owners(points), np.empty((POINTS, 7))

    def query() -> None:
        for _ in range(COMPILED_CALLS):
            query_walls(hole.pieces, hole.geometry, points, owner, out)

    describe(benchmark, "query compiled", points=POINTS, pieces=len(hole.pieces))
    benchmark.pedantic(query, rounds=ROUNDS, warmup_rounds=2)
    penetration = np.linalg.norm(out[:, :3], axis=1) - out[:, 3] + RADIUS
    benchmark.extra_info |= errors(penetration, points)
    note_cost(benchmark, POINTS * COMPILED_CALLS)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def bench_query_in_step(benchmark: BenchmarkFixture, geometry: str) -> None:
    """The same query inside a step: the piece of the last step, packed arithmetic."""
    run, _ = moving(chain(wellbore__geometry=geometry), LEAD)
    times = 2000
    describe(benchmark, "query compiled", points=run.segments, pieces=len(run.hole.pieces))
    benchmark.pedantic(find_walls, args=(run, times), rounds=ROUNDS, warmup_rounds=2)
    note_cost(benchmark, run.segments * times)


def bench_find_contacts(benchmark: BenchmarkFixture) -> None:
    """``fctd.find_contacts`` as a user calls it: the piece of every point is searched anew."""
    hole: Any = build_wellbore(chain())
    points = points_near_wall(POINTS)
    describe(benchmark, "query from Python", points=POINTS, pieces=len(hole.pieces))
    hits = benchmark.pedantic(find_contacts, args=(hole, points, RADIUS), rounds=5, warmup_rounds=1)
    benchmark.extra_info |= errors(hits.penetration, points)
    note_cost(benchmark, POINTS)
