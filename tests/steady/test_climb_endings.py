"""Strings that Newton's method does not find directly: each ends with loads, or with what keeps it from them."""

import re
from random import Random

import pytest

from fctd import load_case
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from tests.fuzz.wells import well

# Wells of the fuzzer's seeds: those of short strings among 200.
SEEDS = (27, 3, 4, 5, 7, 8, 10, 11, 12, 14, 17, 18, 21, 44, 63, 22, 24, 140, 181, 188)
ANSWERS = {SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP, SteadyStatus.UNSTABLE, SteadyStatus.UNDER_RESOLVED}


def solver_of(seed, tmp_path, overrides=None):
    path = tmp_path / "case.toml"
    path.write_bytes(well(Random(seed)).content)
    return Solver(load_case(path, overrides or {}))


def drilled(solver, kind):
    """The string with its bit at six tenths of the depths that can be reached."""
    top, *_, bottom = solver.depths
    return solver.solve(kind, steady_rates(solver.case, kind), round(top + 0.6 * (bottom - top), 2))


@pytest.mark.parametrize("seed", SEEDS)
def test_every_string_has_an_answer_or_a_reason(seed, tmp_path):
    solver = solver_of(seed, tmp_path)
    for kind in ("trip_in", "drill_rotating", "drill_sliding"):
        point = drilled(solver, kind)
        assert point.status in ANSWERS, (kind, point.status, point.message)
        assert point.answered or "%" in point.message, (kind, point.status, point.message)
        assert (point.status == "converged") == (point.message == "")


def test_a_torque_at_the_bit_does_not_roll_a_buckled_string_round_vertical_hole(tmp_path):
    """Nothing there holds it at an angle, and nothing drives it: the torque does no work on a string that rolls."""
    turned = drilled(solver_of(124, tmp_path), "drill_sliding")
    still = drilled(solver_of(124, tmp_path, {"bit.torque": 0}), "drill_sliding")
    assert turned.case.bit.torque > 0
    assert turned.status in ("converged", "under_resolved")
    assert still.status == turned.status
    assert turned.hookload == pytest.approx(still.hookload, rel=1e-3)


def test_a_reason_says_at_which_shares_a_shape_was_found(tmp_path):
    """No further shape was said to be found beyond 66.9 % of the friction of this row; at 72 to 94 % it converges."""
    solver = solver_of(910092, tmp_path)
    rates = steady_rates(solver.case, "drill_rotating")
    point = solver.solve("drill_rotating", rates, 618.92)
    said, _, anew = point.message.partition("; begun anew the string has one at ")
    words = re.search(
        r"the continuation found a steady shape at (\S+) % of the friction and none at (\S+) %(.*)$", said
    )
    assert words is not None, point.message
    found, least = float(words[1]), float(words[2])
    assert 66.9 < found < least < 100
    assert words[3].endswith("100 %")
    shares = [found, *(float(share) for share in re.findall(r"(\S+) %", anew))]
    assert all(share >= least for share in shares[1:])
    bore = solver.case.wellbore
    for share in shares:
        less = [part.model_copy(update={"friction": 0.01 * share * part.friction}) for part in bore.intervals]
        hole = bore.model_copy(update={"intervals": tuple(less)})
        alike = Solver(solver.case.model_copy(update={"wellbore": hole})).solve("drill_rotating", rates, 618.92)
        assert alike.status == "converged", (share, alike.message)
