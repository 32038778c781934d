"""Loads at a stuck point: closed forms in straight and bent hole, and strings that are held in time."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.steady.equilibrium import Solver
from fctd.steady.stuck import StuckString, stuck_string, tension_at
from tests.cases import make_case, pipe
from tests.stuck_in_time import readings, stuck_well

MUD = {"density": 1200.0}


def stuck(case: Case, operation: str, bit: float, md: float) -> StuckString:
    return stuck_string(Solver(case), operation, steady_rates(case, operation), bit, md)


def bent(turn: float, friction: float = 0.25) -> Case:
    """Nearly weightless pipe of no stiffness to speak of in a bend by an angle [°] from 200 m on, 12 m a degree."""
    light = pipe(None, None, segment_length=5.0, density=1201.0)
    stations = [[0, 0, 0], [200, 0, 0], [200 + 12 * turn, turn, 0], [1500, turn, 0]]
    intervals = [{"to_md": 1500, "diameter": 0.2159, "friction": friction}]
    return make_case(stations, [light], mud=MUD, wellbore={"intervals": intervals})


@settings(max_examples=10)
@given(md=st.floats(100.0, 900.0), pull=st.floats(1e4, 1e6))
def test_in_a_straight_hole_the_pull_arrives_less_the_weight(md: float, pull: float) -> None:
    case = make_case(mud=MUD)
    weight = section_of(case.string.components[0], 1200.0).weight
    for operation in ("trip_out", "trip_in"):
        found = stuck(case, operation, 950.0, md).at_hookload(weight * md + pull)
        assert found is not None
        assert found[0] == pytest.approx(pull, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("turn", [30.0, 60.0, 90.0])
def test_round_a_bend_a_rope_keeps_its_share(turn: float) -> None:
    """Of a pull at the hook e^(-μβ) arrives, and of a pull at the stuck point e^(μβ) is at the hook."""
    string = stuck(bent(turn), "trip_out", 1450.0, 1400.0)
    first, last = (string.at_hookload(load) for load in (2e5, 4e5))
    assert first is not None
    assert last is not None
    share = np.exp(-0.25 * np.radians(turn))
    assert (last[0] - first[0]) / 2e5 == pytest.approx(share, rel=5e-3)


def test_a_torque_arrives_less_what_turns_the_string_above() -> None:
    """In a straight hole of 45° the wall holds r μ w sin θ/√(1 + μ²) of every metre, here of 400 m more of them."""
    case = make_case([[0, 45, 0], [1000, 45, 0]], [pipe(None, None, segment_length=10.0)], mud=MUD)
    section = section_of(case.string.components[0], 1200.0)
    taken = section.contact_radius * 0.2 / np.hypot(1, 0.2) * section.weight * np.sin(np.pi / 4) * 400
    shallow, deep = (stuck(case, "rotate_off_bottom", 950.0, md).at_torque(2e4) for md in (500.0, 900.0))
    assert shallow is not None
    assert deep is not None
    assert shallow[0] - deep[0] == pytest.approx(taken, rel=2e-3)


def test_a_string_that_is_stuck_at_its_bit_is_the_whole_one() -> None:
    case = bent(60.0)
    string = stuck(case, "trip_out", 1450.0, 1450.0)
    assert string.pulled(0.0).hookload == pytest.approx(string.free.hookload, abs=1.0)
    assert tension_at(string.pulled(1e5), 0.0) == pytest.approx(1e5)


def test_a_load_that_no_string_bears_has_no_answer() -> None:
    case = make_case([[0, 0, 0], [200, 0, 0], [650, 90, 0], [1000, 90, 0]], mud=MUD)
    assert stuck(case, "trip_in", 950.0, 900.0).at_hookload(-5e8) is None


@pytest.mark.slow(seconds=20)
@pytest.mark.parametrize("seed", ["a", "b", "c"])
def test_what_arrives_in_time(seed: str) -> None:
    """Random wells whose string is held by the stepper and pulled: tension just above the held body."""
    case, depth = stuck_well(f"stuck:{seed}", {"kind": "trip_out", "speed": 0.02, "ramp_time": 5.0})
    md, rows = readings(case, depth, 0.55 + 0.1 * "abc".index(seed))
    string = stuck(case, "trip_out", depth, md)
    for row in rows[100::50]:
        found = string.at_hookload(row.hookload)
        assert found is not None
        assert found[0] == pytest.approx(row.tension, rel=0.02)
