"""Workloads of timings: states in motion, queries with correct results, a ledger that detects a missing loss."""

import numpy as np
import pytest

from fctd import find_contacts
from fctd.mechanics import state as rows
from fctd.mechanics.energy import energy_of
from fctd.simulation.preparation import contact_points
from references.timing import workloads
from references.timing.workloads import NoWall, asking, copy_of, fallen, free_query, moving, without_wall
from validation.parts.speed_kernel import chain


@pytest.fixture(scope="module")
def turning():
    return moving(chain(20), 6.0)


def test_a_moving_string_turns_over_its_whole_length(turning):
    run, motion = turning
    spin = rows.row(run.S, rows.WZ, run.segments)
    assert motion.spin_to == pytest.approx(2 * np.pi)
    assert np.abs(spin).min() > 0.1  # no denormal numbers ahead of a first wave
    assert workloads.touching(run) > 0.3


def test_a_fallen_string_lies_on_the_wall_and_turns():
    run, motion = fallen(chain(50), 0.4)
    assert workloads.touching(run) > 0.1
    assert rows.row(run.S, rows.WZ, 50) == pytest.approx(motion.spin_to)
    assert run.S[rows.LOST_FRICTION + 1] == 0


def test_a_copy_does_not_change_the_original(turning):
    run, motion = turning
    before = rows.copy_state(run.S)
    copy_of(run).advance(motion, 0.1)
    assert np.array_equal(rows.columns(run.S), rows.columns(before))


def test_an_empty_query_is_the_step_without_a_wall(turning):
    run, motion = turning
    compiled, queried = without_wall(run), asking(without_wall(run), NoWall())
    compiled.advance(motion, 0.2)
    queried.advance(motion, 0.2)
    found, expected = (rows.columns(run.S)[: rows.AX // rows.STRIDE] for run in (queried, compiled))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_the_timed_queries_have_the_same_results_as_find_contacts(geometry, monkeypatch):
    run, _ = moving(chain(20, wellbore__geometry=geometry), 1.0)
    n, radius = run.segments, rows.row(run.S, rows.RADIUS, run.segments)
    points = contact_points(run.S, n)
    truth = find_contacts(run.hole, points, radius).penetration
    kept = []
    query = workloads.query_walls
    monkeypatch.setattr(workloads, "query_walls", lambda *call: (query(*call), kept.append(call[-1])))
    free_query(run)(2)
    assert len(kept) == 2
    out = kept[-1]
    assert np.linalg.norm(out[:, :3], axis=1) - out[:, 3] + radius == pytest.approx(truth, abs=1e-9)
    workloads.find_walls(run, 2)
    wall = [rows.row(run.S, row, n) for row in (rows.PX, rows.PY, rows.PZ, rows.HOLE)]
    # Across a wall that leans at a seam the penetration is less, by half the square of its tilt.
    leaning = 1e-3 if geometry == "cylinders" else 0.0
    assert np.linalg.norm(wall[:3], axis=0) - wall[3] + radius == pytest.approx(truth, abs=1e-9, rel=leaning)


def test_the_ledger_closes_and_detects_a_missing_loss(turning):
    run, motion = copy_of(turning[0]), turning[1]
    before = energy_of(run.S, run.segments)
    run.advance(motion, 2.0)
    run.refresh()
    now = energy_of(run.S, run.segments)
    assert workloads.energy_error(run, before, now) < 1e-3
    rows.row(run.S, rows.LOST_FRICTION, run.segments)[:] *= 0.9
    assert workloads.energy_error(run, before, now) > 0.02
