"""The upper end of a run, fed or hung: its string reaches the bit, here and at other depths."""

import numpy as np
import pytest

from fctd.mechanics import state, topdrive
from fctd.mechanics.topdrive import Motion
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, trip

STRING = [pipe(60, 4), pipe(None, 1)]


@pytest.mark.parametrize(("feed", "in_derrick"), [("long_segment", False), ("stands", True)])
def test_the_string_reaches_the_bit(feed: str, in_derrick: bool) -> None:
    components = STRING if not in_derrick else [pipe(60, 4), pipe(None, None, segment_length=28.5)]
    run, _ = prepare(make_case(None, components, [trip(300.0, 340.0, 0.5, 1.0)], rig={"feed": feed}))
    end = run.upper_end
    assert (end.in_derrick, end.in_slips, end.start_depth) == (in_derrick, False, pytest.approx(300.0))
    assert end.longest.length.sum() >= 300.0
    run.refresh()
    assert sum(run.laid_out.length) + run.laid_out.top_md == pytest.approx(run.bit_depth) == 300.0
    run.advance(Motion(0.0, 2.0, 0.5, 0.5, 0.0, 0.0), 2.0)
    run.refresh()
    assert run.bit_depth == pytest.approx(301.0, abs=1e-3)
    assert sum(run.laid_out.length) + run.laid_out.top_md == pytest.approx(run.bit_depth)
    end.begin(run)
    assert end.start_depth == pytest.approx(run.bit_depth, abs=1e-9)
    probe = state.copy_state(run.S)
    string = end.at_depth(330.0, run, probe)
    assert string.bit_depth == 330.0
    masses = (string.of("mass") * string.length)[1:]  # half of a long segment moves with the top drive
    np.testing.assert_allclose(state.row(probe, state.MASS, string.segments)[1:], masses)
    assert end.direction("trip_out") == (1 if in_derrick else -1)  # a block moved down last
    assert ("in_slips" in end.columns(run)) == in_derrick
    assert end.drills_on(run, Motion(0.0, 2.0, 0.5, 0.5, 0.0, 0.0)) is None
    assert run.top[topdrive.IN_DERRICK] == in_derrick
