"""The bare loop: a number of steps with a wall and damping, without schedule or records."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.mechanics import state, topdrive
from fctd.mechanics.moving_string import STILL, HoleWall, MovingString
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation

BUILD = [[0, 0, 0], [400, 0, 0], [850, 90, 0], [1200, 90, 0]]
ROTATE = rotation(1000, 30, ramp=10)


def string_of(**sections) -> MovingString:
    """The bare string of a case, without its case and schedule."""
    case = make_case(BUILD, [pipe(None, None, outer=0.102, segment_length=25.0)], [ROTATE], top_md=300.0, **sections)
    run, _ = prepare(case)
    return MovingString(
        S=run.S, top=run.top, owner=run.owner, segments=run.segments, pipe=run.pipe, laws=run.laws,
        wall=HoleWall(run.hole.pieces, case.wellbore.geometry), step=run.step,
    )  # fmt: skip


@pytest.mark.parametrize("law", ["coulomb", "paper"])
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_results_do_not_depend_on_the_steps_per_compiled_call(geometry: str, law: str) -> None:
    def after(at_once: int) -> MovingString:
        string = string_of(wellbore={"geometry": geometry}, contact={"friction_law": law})
        string = replace(string, at_once=at_once)
        string.advance(STILL._replace(spin_to=3.0), 3.0)
        return string

    whole, sliced = after(10**9), after(7 * 28)
    np.testing.assert_array_equal(state.columns(whole.S), state.columns(sliced.S))
    np.testing.assert_array_equal(whole.top, sliced.top)
    assert whole.steps == sliced.steps > 500


def test_damping_given_to_the_loop_brings_a_string_to_rest() -> None:
    string = string_of()
    laws = string.laws._replace(friction_scale=0.0, settling=5.0)
    fastest = []
    for duration in (1.0, 39.0):
        string.advance(STILL, duration, laws)
        fastest.append(np.abs(state.row(string.S, state.VZ, string.segments)).max())
    assert fastest[1] < 1e-3 * fastest[0]
    assert string.time == pytest.approx(40.0)
    string.refresh()
    string.check()
    assert string.energy().contact > 0


def test_sums_are_drained_once_and_are_those_of_the_time_since() -> None:
    parts, whole = string_of(), string_of()
    motion = STILL._replace(duration=1.0, spin_to=6.0)
    drained = []
    for _ in range(3):
        parts.advance(motion, 100 * parts.step)
        drained.append(parts.drain())
    whole.advance(motion, 300 * whole.step)
    assert whole.steps == parts.steps == 300
    for name, total in whole.drain()._asdict().items():
        np.testing.assert_allclose(sum(getattr(sums, name) for sums in drained), total, rtol=1e-9, atol=1e-9)
    assert drained[0].hookload > 0
    assert not any(np.any(part) for part in parts.drain())


def test_means_are_sums_over_their_time() -> None:
    string = string_of()
    string.advance(STILL, 2.0)
    sums = string.drain()
    mean = sums.over(2.0)
    assert mean.hookload == sums.hookload / 2
    np.testing.assert_array_equal(mean.tension, sums.tension / 2)


def test_clearing_leaves_motion_and_time() -> None:
    string = string_of()
    string.advance(STILL._replace(spin_to=6.0), 2.0)
    moving = state.row(string.S, state.VZ, string.segments).copy()
    string.clear()
    assert not any(np.any(part) for part in string.drain())
    assert not state.row(string.S, state.LOST_FRICTION, string.segments).any()
    assert not string.top[[topdrive.TOP_WORK, topdrive.FED_ENERGY]].any()
    assert string.steps == 0
    assert string.time == pytest.approx(2.0)
    np.testing.assert_array_equal(state.row(string.S, state.VZ, string.segments), moving)


def test_a_wall_of_cylinders_has_seams_and_one_of_arcs_has_none() -> None:
    pieces = np.empty((0, 0))
    assert (HoleWall(pieces, "cylinders").seams, HoleWall(pieces, "arcs").seams) == (True, False)
