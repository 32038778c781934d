"""Free points: the drillers' formula in straight hole, friction in bent hole, and strings that are held in time."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.steady.free_point import free_point
from tests.cases import make_case, pipe
from tests.stuck_in_time import readings, stuck_well

INCH, FOOT, POUND = 0.0254, 0.3048, 4.4482216152605
PIPE = {"name": "pipe", "outer_diameter": "5 in", "inner_diameter": "4.276 in", "segment_length": 30.0}
PULLED = {"pull": "30 klbf", "stretch": "24 in"}


def vertical(**part: Any) -> Case:
    return make_case([[0, 0, 0], [5000, 0, 0]], [PIPE | part], mud={"density": 1200.0})


def found(case: Case, depth: float, **measured: Any) -> Any:
    return free_point(case, depth, **measured).iloc[0]


def test_the_free_point_of_the_drillers_formula() -> None:
    """5 in 19.5 lb/ft, plain end 17.93, 24 in by 30,000 lb: 735,294·24·17.93/30,000 = 10,547 ft (free point tables).

    Both go by the section: the mass with tool joints, 23.52 lb/ft, does not lead to 13,835 ft.
    """
    for mass in (None, "23.52 lb/ft"):
        row = found(vertical(**({} if mass is None else {"linear_mass": mass})), 5000.0, **PULLED)
        for name in ("free_point_md_m", "straight_md_m"):
            assert row[name] / FOOT == pytest.approx(10_547, rel=1e-3)


def test_tool_joints_stretch_less() -> None:
    """By the share of a joint that they are, and their steel: EA of the joint is 1.046 times that of its body."""
    joint = {"length": "31.7 ft", "tool_joint_length": "21 in", "tool_joint_diameter": "6.625 in",
             "tool_joint_inner": "3.25 in"}  # fmt: skip
    row = found(vertical(joint=joint), 5000.0, **PULLED)
    share, body, steel = 21 / 12 / 31.7, 5**2 - 4.276**2, 6.625**2 - 3.25**2
    assert row["free_point_md_m"] / row["straight_md_m"] == pytest.approx(
        1 / (1 - share * (1 - body / steel)), rel=1e-3
    )


def test_a_tapered_string_goes_on_with_its_next_section() -> None:
    """800 m of pipe and 100 m of collars, stuck 60 m above the bit, by stretch and by twist."""
    parts = [pipe(100, 10, outer=0.165), pipe(None, None, segment_length=10.0, inner_diameter=0.1)]
    case = make_case(components=parts, mud={"density": 1200.0})
    steel = [np.pi / 4 * (outer**2 - inner**2) for outer, inner in ((0.165, 0.07), (0.127, 0.1))]
    polar = [np.pi / 32 * (outer**4 - inner**4) for outer, inner in ((0.165, 0.07), (0.127, 0.1))]
    stretch = 1e5 / 206.8e9 * (800 / steel[1] + 40 / steel[0])
    twist = 1e4 * 2.6 / 206.8e9 * (800 / polar[1] + 40 / polar[0]) / (2 * np.pi)
    table = free_point(case, 900.0, pull=1e5, stretch=stretch, torque=1e4, turns=twist)
    for name in ("free_point_md_m", "straight_md_m"):
        assert table[name].to_numpy() == pytest.approx(840.0, rel=1e-3)


@pytest.mark.slow
def test_friction_round_a_bend_makes_the_formula_too_shallow() -> None:
    """A rope that keeps e^(-μβ) of its pull below 60°: its stretch below is that of so much less pull."""
    light = pipe(None, None, segment_length=12.0, density=1201.0)
    stations = [[0, 0, 0], [500, 0, 0], [860, 60, 0], [2500, 60, 0]]
    intervals = [{"to_md": 2500, "diameter": "8.5 in", "friction": 0.3}]
    case = make_case(stations, [light], mud={"density": 1200.0}, wellbore={"intervals": intervals})
    angle, steel = np.pi / 3, np.pi / 4 * (0.127**2 - 0.07**2)
    kept = np.exp(-0.3 * angle)
    # In the bend the pull falls from all to what is kept, and its mean is (1 - kept)/μβ.
    length = 500 + 360 * (1 - kept) / (0.3 * angle) + kept * (2000 - 860)
    row = found(case, 2400.0, pull=4e5, stretch=4e5 * length / (206.8e9 * steel), first_hookload=4e5)
    assert row["free_point_md_m"] == pytest.approx(2000.0, rel=5e-3)
    assert row["straight_md_m"] == pytest.approx(length, rel=1e-3)
    assert (row["last_force_N"] - row["first_force_N"]) / 4e5 == pytest.approx(kept, rel=5e-3)


def test_without_friction_the_formula_holds_in_a_bent_hole() -> None:
    """Where the string is taut at the first reading already, and moves across the hole no more."""
    case = make_case([[0, 0, 0], [300, 0, 0], [800, 50, 40], [1500, 70, 90]], [PIPE], mud={"density": 1200.0})
    row = found(case, 1400.0, pull=3e5, stretch=0.4, first_hookload=1.2e6, friction=0.0)
    assert row["free_point_md_m"] == pytest.approx(row["straight_md_m"], rel=1e-2)


@pytest.mark.parametrize(("measured", "reason"), [
    ({"pull": 1e5, "stretch": 50.0}, "a string that is stuck at its bit moves less, by a factor of"),
    ({"pull": 1e5, "stretch": 1e-3}, "30 m of string would move more under that load"),
    ({"torque": 1e4, "turns": 500.0}, "moves less, by a factor of"),
])  # fmt: skip
def test_readings_of_no_depth_have_a_reason(measured: dict[str, float], reason: str) -> None:
    row = found(vertical(), 4000.0, **measured)
    assert reason in row["reason"]
    assert np.isnan(row["free_point_md_m"])
    assert np.isfinite(row["straight_md_m"])


@pytest.mark.parametrize(("measured", "told"), [
    ({}, "pull is missing: expected pull and stretch, or torque and turns"),
    ({"pull": 1e5}, "stretch is missing: expected pull and stretch together"),
    ({"turns": 3.0}, "torque is missing"),
    ({"pull": -1e5, "stretch": 1.0}, "pull = -100000.0: expected a force above 0"),
    ({"pull": 1e5, "stretch": float("nan")}, "stretch = nan: expected a length above 0"),
    ({"pull": "1 m", "stretch": 1.0}, 'pull = "1 m": expected a force'),
    ({"pull": "4 MN", "stretch": 1.0}, 'pull = "4000 kN": expected less than the string bears, 3168 kN'),
    ({"torque": 2e5, "turns": 9.0}, 'torque = "200 kN*m": expected less than the string bears, 100.5 kN*m'),
    ({"torque": 1e4, "turns": "two"}, 'turns = "two": expected a number of turns'),
    ({"torque": 1e4, "turns": 1.0, "first_torque": -1.0}, "first_torque = -1.0: expected a torque of at least 0"),
    ({"torque": 1e4, "turns": 1.0, "first_hookload": 1e5}, "first_hookload = 100000.0: expected pull and stretch"),
])  # fmt: skip
def test_readings_that_are_none_are_refused(measured: dict[str, Any], told: str) -> None:
    with pytest.raises(InputError) as refused:
        free_point(vertical(), 4000.0, **measured)
    assert told in str(refused.value)


def test_no_torque_passes_a_swivel() -> None:
    parts = [pipe(100, 10, name="liner", swivel=True), pipe(None, None, segment_length=20.0)]
    with pytest.raises(InputError, match="none, since no torque passes the swivel above liner"):
        free_point(make_case(components=parts), 900.0, torque=1e4, turns=1.0)


@pytest.mark.slow(seconds=30)
@pytest.mark.parametrize("seed", ["a", "b", "c"])
def test_the_free_point_of_a_string_that_is_held_in_time(seed: str) -> None:
    """Random wells: the block's travel and the hook load, the turns and the torque, lead to the body that is held."""
    share = 0.55 + 0.1 * "abc".index(seed)
    case, depth = stuck_well(f"free:{seed}", {"kind": "trip_out", "speed": 0.02, "ramp_time": 5.0})
    md, rows = readings(case, depth, share)
    first, last = rows[120], rows[-2]
    pulled = {"pull": last.hookload - first.hookload, "stretch": last.travel - first.travel}
    row = found(case, depth, **pulled, first_hookload=first.hookload)
    assert row["free_point_md_m"] == pytest.approx(md, rel=0.02)
    turning = {"kind": "rotate_off_bottom", "rpm": 6.0, "ramp_time": 5.0, "duration": 60.0}
    case, depth = stuck_well(f"free:{seed}", turning)
    md, rows = readings(case, depth, share)
    first, last = rows[120], rows[-2]
    twisted = {"torque": last.torque - first.torque, "turns": (last.time - first.time) / 10}
    row = found(case, depth, **twisted, first_torque=first.torque)
    assert row["free_point_md_m"] == pytest.approx(md, rel=0.02)
    assert row["last_arrived_N_m"] == pytest.approx(last.arrived, rel=0.02)
