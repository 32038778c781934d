"""The settling of a string before its first step, and its start from rest."""

import numpy as np
import pytest

from fctd.arrays import Contacts
from fctd.mechanics import state, topdrive
from fctd.mechanics.faults import UnstableError
from fctd.model.wellbore import Wellbore, find_contacts
from fctd.simulation import settling
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import relaxing, settle, start_from_rest
from tests.cases import make_case, pipe, rotation

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [1400, 60, 0]]


def velocities(run: Run) -> np.ndarray:
    """(3, n) [m/s]."""
    return np.stack([state.row(run.S, row, run.segments) for row in (state.VX, state.VY, state.VZ)])


def test_settling_ends_where_the_imbalance_is_small() -> None:
    """The imbalance is that of the forces alone: what moves the string in a step from rest without the drag."""
    given = {"contact": {"damping": 1e4}, "solver": {"shape_damping": 0.0}}
    run, _ = prepare(make_case(BUILD, [pipe(None, 40)], [rotation(1000, 1)], **given))
    seen: list[tuple[float, float]] = []
    residual = settle(run, 1e-3, progress=lambda *values: seen.append(values))
    assert residual == seen[-1][1] < 1e-3 <= min(values[1] for values in seen[:-1])
    laws, weight = relaxing(run)
    # A window is the drag's time constant; one more step after each measures the imbalance.
    assert seen[0][0] == pytest.approx(1 / laws.settling)
    assert run.time == pytest.approx(seen[-1][0] + len(seen) * run.step)
    start_from_rest(run)
    run.advance(settling.STILL, run.step, laws)
    mass = state.row(run.S, state.MASS, run.segments)
    # At rest joints and walls do not damp, so that it is somewhat smaller.
    assert 0.5 * residual < np.abs(mass * velocities(run)).max() / run.step / weight < residual


def test_a_string_that_does_not_settle_is_an_error() -> None:
    run, _ = prepare(make_case(components=[pipe(1000, 4)], operations=[rotation(1000, 1)]))
    times: list[float] = []
    with pytest.raises(UnstableError, match=r"forces are out of balance by .* of the weight after 400 s"):
        settle(run, 0.0, progress=lambda now, _: times.append(now))
    assert 400 - 1 / relaxing(run)[0].settling < times[-1] <= 400


@pytest.mark.slow
def test_the_imbalance_of_a_string_that_still_falls_is_that_of_its_forces() -> None:
    """After a window it gains speed still; from rest at the same place the forces alone set it in motion.

    Without damping in joints and wall, whose forces depend on the speed, and in steps in which forces hardly change.
    """
    undamped = {"contact": {"damping": 0.0}, "solver": {"joint_damping": 0.0, "shape_damping": 0.0, "step": 1e-5}}
    run, _ = prepare(make_case(BUILD, [pipe(None, 40)], [rotation(1000, 1)], **undamped))
    laws, weight = relaxing(run)
    for _ in range(8):
        residual = settle(run, np.inf)
        start_from_rest(run)
        run.advance(settling.STILL, run.step, laws)
        force = np.abs(state.row(run.S, state.MASS, run.segments) * velocities(run)).max() / run.step
        assert residual == pytest.approx(force / weight, rel=0.02)


@pytest.mark.slow
def test_the_imbalance_on_average_is_that_of_the_motion_in_the_window() -> None:
    """Gain of speed, and the drag of the mean speed: here of 1000 speeds in each of two windows."""
    case = make_case(BUILD, [pipe(None, 40)], [rotation(1000, 1)], solver={"step": 1e-5})
    run, _ = prepare(case)
    laws, weight = relaxing(run)
    window = 1 / laws.settling
    expected = []
    for _ in range(2):
        speeds = [velocities(run)]
        for _ in range(1000):
            run.advance(settling.STILL, window / 1000, laws)
            speeds.append(velocities(run))
        mean = (0.5 * (speeds[0] + speeds[-1]) + np.sum(speeds[1:-1], axis=0)) / 1000
        pull = (speeds[-1] - speeds[0]) / window + laws.settling * mean
        expected.append(np.abs(state.row(run.S, state.MASS, run.segments) * pull).max() / weight)
    again, _ = prepare(case)
    seen: list[tuple[float, float]] = []
    settling._settle_on_average(again, lambda *values: seen.append(values))
    assert [now for now, _ in seen[:2]] == pytest.approx([window, 2 * window])
    assert [imbalance for _, imbalance in seen[:2]] == pytest.approx(expected, rel=0.02)


def test_a_stretched_string_settles_on_average_up_to_a_thousandth_of_its_weight() -> None:
    """Pulled out by a metre at its lower end, it takes more windows than the fewest."""
    run, _ = prepare(make_case(BUILD, [pipe(None, 40)], [rotation(1000, 1)]))
    state.row(run.S, state.Z, run.segments)[:] += np.linspace(0.0, 1.0, run.segments)
    seen: list[float] = []
    residual = settling._settle_on_average(run, lambda _, imbalance: seen.append(imbalance))
    assert len(seen) > 3
    assert residual == seen[-1] < 1e-3 <= min(seen[:-1])


def test_a_string_that_is_lost_while_it_settles_is_an_error_at_once() -> None:
    run, _ = prepare(make_case(components=[pipe(1000, 4)], operations=[rotation(1000, 1)]))
    state.row(run.S, state.X, run.segments)[2] = np.nan
    with pytest.raises(UnstableError, match="a position or velocity is not finite"):
        settle(run)


class Shaking:
    """The hole's own contacts, deeper and shallower in turn, as from meshes with facets."""

    name = "shaking"

    def __init__(self, hole: Wellbore, by: float) -> None:
        self.hole, self.by, self.asked = hole, by, 0

    def query(self, points: np.ndarray, radii: np.ndarray) -> Contacts:
        self.asked += 1
        hits = find_contacts(self.hole, points, radii)
        return hits._replace(penetration=hits.penetration + self.by * (-1) ** self.asked)


@pytest.mark.slow
def test_a_wall_that_jumps_is_settled_against_on_average(monkeypatch: pytest.MonkeyPatch) -> None:
    case = make_case([[0, 0, 0], [300, 40, 60]], [pipe(None, 10)], [rotation(300, 1)])
    hole = prepare(case)[0].hole
    run, _ = prepare(case, Shaking(hole, 1e-6))
    seen: list[tuple[float, float]] = []
    residual = settle(run, progress=lambda *values: seen.append(values))
    laws, _ = relaxing(run)
    on_average = seen[next(k for k in range(1, len(seen)) if seen[k][0] < seen[k - 1][0]) :]
    assert [now for now, _ in on_average] == pytest.approx([k / laws.settling for k in (1, 2, 3)])
    assert residual == on_average[-1][1] < 1e-3
    monkeypatch.setattr(settling, "SETTLED_ON_AVERAGE", residual / 1e6)
    monkeypatch.setattr(settling, "LONGEST_SETTLING", 20.0)
    seen.clear()
    with pytest.raises(UnstableError, match=r"forces are out of balance by .* of the weight after 20 s"):
        settle(run, progress=lambda *values: seen.append(values))
    assert 20 - 1 / laws.settling < seen[-1][0] <= 20


def test_a_start_from_rest() -> None:
    """No speed, no sums, no clock, and axes and walls of the present places."""
    run, _ = prepare(make_case(BUILD, [pipe(None, 40)], [rotation(1000, 1)]))
    settled = state.copy_state(run.S)
    rates = (state.VX, state.VY, state.VZ, state.WX, state.WY, state.WZ)
    for offset in (*rates, state.SUM_NORMAL, state.AX, state.PX):
        state.row(run.S, offset, run.segments)[:] = 3.0
    run.top[topdrive.TOP_TIME] = 5.0
    start_from_rest(run)
    for offset in (*rates, state.SUM_NORMAL):
        assert not state.row(run.S, offset, run.segments).any()
    assert run.time == 0.0
    axes = [state.row(each, state.AX, run.segments) for each in (run.S, settled)]
    np.testing.assert_allclose(*axes, atol=1e-12)
