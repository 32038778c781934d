"""Margins against closed forms: overpull, weight set down, torque, slips, bending to and fro; and against notes."""

from collections.abc import Sequence
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.load import Case
from fctd.case.pipes.catalogue import pipe_named
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.results.limits import LIMITS, SHARE
from fctd.steady.equilibrium import Solver, equilibrium
from fctd.steady.margins import (
    FATIGUE,
    HELIX,
    LOCK_UP,
    OVERPULL,
    SLACK_OFF,
    SNAKING,
    TORQUE,
    Loaded,
    Margin,
    margins,
)
from tests.cases import make_case, pipe
from validation.parts import random_wells

STEEL = np.pi / 4 * (0.127**2 - 0.07**2)
SECOND = np.pi / 64 * (0.127**4 - 0.07**4)
YIELD = 931e6
MUD = {"density": 1200.0}


def found(case: Case, operation: str, depth: float, **rates: Any) -> dict[str, Margin]:
    """The margins of a case by their limits."""
    solver = Solver(case)
    loaded = Loaded(solver, operation, steady_rates(case, operation, **rates), solver.lay_out(depth))
    return {of.limit: of for of in margins(loaded)}


def with_pull(case: Case, overpull: float) -> Case:
    return case.model_copy(update={"bit": case.bit.model_copy(update={"overpull": overpull})})


@given(factor=st.floats(1.0, 2.0), mud=st.floats(0.0, 2000.0), depth=st.floats(600.0, 1000.0))
def test_a_vertical_string_yields_where_its_capacity_is_reached(factor: float, mud: float, depth: float) -> None:
    case = make_case(mud={"density": mud}, limits={"design_factor": factor})
    weight = section_of(case.string.components[0], mud).weight * depth
    margin = found(case, "trip_out", depth)["yield"]
    assert margin.hookload_left == pytest.approx(YIELD * STEEL / factor - weight, abs=1.0)
    assert margin.force == pytest.approx(margin.hookload_left, abs=1.0)
    assert (margin.md, margin.part, margin.margin) == (0.0, "pipe", OVERPULL)
    assert margin.share == pytest.approx(factor * weight / (YIELD * STEEL), rel=1e-5)


def test_the_weaker_lower_section_gives_way_first() -> None:
    """At its upper end, where what hangs below it and the overpull add."""
    parts = [
        pipe(400, 20),
        pipe(300, 10, outer=0.11, yield_strength=400e6, name="weak"),
        pipe(None, None, segment_length=30.0),
    ]
    case = make_case(components=parts, mud=MUD)
    below = [section_of(part, 1200.0) for part in case.string.components]
    pulled = 400e6 * np.pi / 4 * (0.11**2 - 0.07**2) - 400 * below[0].weight - 300 * below[1].weight
    margin = found(case, "trip_out", 1000.0)["yield"]
    assert (margin.part, margin.limit) == ("weak", "yield")
    # Contact points lie at the ends of segments: the uppermost one of the section is a segment below its upper end.
    assert margin.force == pytest.approx(pulled, abs=31 * below[1].weight)
    assert 290 <= margin.md <= 331


@pytest.mark.slow
@pytest.mark.parametrize("turn", [30.0, 60.0, 90.0])
def test_overpull_grows_round_a_bend_as_a_rope_does(turn: float) -> None:
    """Nearly weightless pipe of no stiffness to speak of: at the hook e^(μβ) times what arrives at the bit."""
    bend = [[0, 0, 0], [200, 0, 0], [200 + 12 * turn, turn, 0], [1500, turn, 0]]
    light = pipe(None, None, segment_length=5.0, density=1201.0)
    case = make_case(
        bend, [light], mud=MUD, wellbore={"intervals": [{"to_md": 1500, "diameter": 0.2159, "friction": 0.25}]}
    )
    margin = found(case, "trip_out", 1450.0)["yield"]
    assert margin.hookload_left / margin.force == pytest.approx(np.exp(0.25 * np.radians(turn)), rel=5e-3)


def test_the_hoist_lifts_block_and_string() -> None:
    case = make_case(mud=MUD, rig={"hoist_capacity": 1e6, "block_weight": 150e3, "guide_friction": 10e3})
    weight = section_of(case.string.components[0], 1200.0).weight * 900
    margin = found(case, "trip_out", 900.0)["hoist"]
    assert margin.force == pytest.approx(1e6 - 160e3 - weight, rel=1e-6)
    assert margin.share == pytest.approx((160e3 + weight) / 1e6, rel=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_the_note_of_the_limit_comes_at_its_margin(seed: int) -> None:
    """Random wells in space: below the margin there is no note of it, above it there is one at its place."""
    rng = Random(f"margins:{seed}")
    case = Case.model_validate(random_wells.well(rng) | {"limits": {"design_factor": 1.1}})
    depth = case.depths[1]
    margin = next(of for of in found(case, "trip_out", depth).values() if of.margin == OVERPULL)
    assert margin.force > 0
    below, above = (equilibrium(with_pull(case, share * margin.force), "trip_out", depth) for share in (0.999, 1.001))
    assert margin.limit not in {note.code for note in below.notes}
    (note,) = (of for of in above.notes if of.code == margin.limit)
    assert note.place == pytest.approx(margin.md, abs=0.1)
    assert above.hookload == pytest.approx(margin.hookload, rel=2e-3)


def torques(case: Case) -> dict[str, Margin]:
    return found(case, "rotate_off_bottom", 900.0)


@pytest.mark.parametrize("factor", [1.0, 1.25])
def test_torque_until_yield_under_the_tension_that_is_there(factor: float) -> None:
    """A straight string: von Mises of its weight and the torque; the drive has 20 kN m."""
    case = make_case(mud=MUD, limits={"design_factor": factor}, rig={"largest_torque": 20e3})
    stress = 900 * section_of(case.string.components[0], 1200.0).weight / STEEL
    left = np.sqrt(((YIELD / factor) ** 2 - stress**2) / 3) * 2 * SECOND / 0.0635
    margin = torques(case)
    assert margin["yield"].torque == pytest.approx(left, rel=1e-6)
    assert margin["yield"].surface_torque_left == pytest.approx(left, rel=1e-6)
    assert margin["drive"].torque == pytest.approx(20e3, rel=1e-6)
    assert {of.margin for of in margin.values()} == {TORQUE, FATIGUE}


@pytest.mark.parametrize("share", [1.0, 0.8])
def test_torque_until_the_share_of_the_make_up_torque(share: float) -> None:
    """NC50 of 6 5/8 by 2 3/4 in: the catalogue's own make-up torque, which is below that of the body."""
    named = {"name": "pipe", "pipe": "5 in 19.5 S-135 NC50", "segment_length": 30.0}
    case = make_case(components=[named], mud=MUD, limits={"torque_share": share})
    make_up = section_of(case.string.components[0], 1200.0).make_up
    margin = torques(case)
    assert set(margin) == {"make_up", FATIGUE}
    assert margin["make_up"].torque == pytest.approx(share * make_up, rel=1e-6)


def test_weight_is_set_down_until_the_level_string_snakes_and_winds() -> None:
    """Dawson & Paslay (1984) and the helix √2 times it (Chen, Lin & Cheatham 1990); without friction at the bit."""
    level = make_case(
        [[0, 90, 0], [600, 90, 0]], [pipe(None, None, segment_length=10.0)], mud=MUD,
        wellbore={"intervals": [{"to_md": 600, "diameter": 0.2159, "friction": 0.0}]}, rig={"block_weight": 1e6},
    )  # fmt: skip
    section = section_of(level.string.components[0], 1200.0)
    onset = 2 * np.sqrt(section.EI * section.weight / (0.5 * (0.2159 - 0.127)))
    margin = found(level, "trip_in", 500.0)
    assert margin[SNAKING].force == pytest.approx(onset, rel=5e-3)
    assert margin[HELIX].force == pytest.approx(np.sqrt(2.0) * onset, rel=5e-3)
    assert margin[SLACK_OFF].reason.startswith("not below")  # a block of 1 MN pushes with more than two weights


def test_a_vertical_string_is_set_down_until_its_weight_and_the_block_are() -> None:
    """Without friction; with it the helix of its lower part takes some of the weight."""
    hole = {"intervals": [{"to_md": 1000, "diameter": 0.2159, "friction": 0.0}]}
    smooth, rough = (make_case(mud=MUD, rig={"block_weight": 20e3}, wellbore=of) for of in (hole, {}))
    weight = section_of(smooth.string.components[0], 1200.0).weight * 900
    margin = found(smooth, "trip_in", 900.0)
    assert margin[SLACK_OFF].force == pytest.approx(weight + 20e3, rel=3e-3)
    assert margin[SLACK_OFF].hookload == pytest.approx(-20e3, abs=3e-3 * weight)
    assert margin[SNAKING].force < margin[HELIX].force < margin[SLACK_OFF].force
    assert np.isnan(margin[LOCK_UP].force)  # nothing holds it
    braked = found(rough, "trip_in", 900.0)
    assert 0.8 * margin[SLACK_OFF].force < braked[SLACK_OFF].force < 0.95 * margin[SLACK_OFF].force


def test_a_turning_string_is_bent_to_and_fro_by_the_curvature_of_its_hole() -> None:
    """E κ d/2 in a long bend; as often as it turns."""
    bend = [[0, 0, 0], [100, 0, 0], [460, 60, 0], [1500, 60, 0]]
    case = make_case(bend, [pipe(None, None, segment_length=10.0)], mud=MUD)
    margin = found(case, "rotate_off_bottom", 1400.0, rpm=90)[FATIGUE]
    assert margin.bending_stress == pytest.approx(206.8e9 * np.radians(60) / 360 * 0.0635, rel=0.05)
    assert margin.cycles_per_hour == pytest.approx(5400)
    assert 90 <= margin.md <= 470


PREMIUM = {"pipe": "5 in 19.5 S-135 NC50, premium", "segment_length": 100.0}
NEW_MASS = 23.52  # [lb/ft], of new pipe with tool joints


def test_slips_bear_the_string_and_no_more() -> None:
    """5 in S-135 premium: 403,000 lbf in slips of 16½ in (Reinhold & Spiri)."""
    case = make_case(components=[PREMIUM], rig={"slip_length": "16.5 in"})
    margin = found(case, "rotate_off_bottom", 900.0)["slips"]
    assert margin.hookload == pytest.approx(403e3 * 4.4482216, rel=5e-3)
    weight = 900 * GRAVITY * NEW_MASS * 0.45359237 / 0.3048
    assert margin.hookload_left == pytest.approx(margin.hookload - weight, rel=1e-4)


def test_premium_pipe_weighs_what_new_pipe_does_and_yields_earlier() -> None:
    """560,800 lbf of S-135 premium (the maker's sheet), at the top of a straight string."""
    margin = found(make_case(components=[PREMIUM]), "trip_out", 900.0)["yield"]
    assert margin.hookload == pytest.approx(560.8e3 * 4.4482216, rel=1e-3)
    assert margin.force == pytest.approx(margin.hookload - 900 * GRAVITY * NEW_MASS * 0.45359237 / 0.3048, rel=1e-4)


@pytest.mark.parametrize(
    ("named", "collapses"),
    [
        # Elastic for 55 ksi and for what half of it leaves, 35.8 ksi: 515 psi whatever its strength.
        ("20 in 94 K-55 casing", 515.0),
        # 52.1 ksi are left of 80: A 2.982, B 0.0526, C 1119 psi of the plastic regime, 20.39 of diameter to wall.
        ("9 5/8 in 47 N-80 casing", 52.11e3 * (2.9825 / 20.392 - 0.052606) - 1119.3),
    ],
)
def test_tension_lowers_the_yield_strength_of_casing_in_the_formula_of_its_regime(named: str, collapses: float) -> None:
    """API TR 5C3 (2008): at half of the strength, counted from the pressure inside, √(1 − 3/16) − 1/4 = 0.651 are left.

    An ellipse of the collapse pressure would leave 0.651 of it.
    """
    of = pipe_named(named)
    assert of.yield_strength is not None
    outside, pressure = np.pi / 4 * of.outer**2, 20e5 + 1200 * GRAVITY * 100
    pull = 0.5 * of.yield_strength * (outside - np.pi / 4 * of.inner**2) + pressure * outside
    mud = {"density": 1200.0, "inside": [{"density": 0.0}], "outside_pressure": 20e5, "float": True}
    hole = {"intervals": [{"to_md": 100.0, "diameter": 0.7, "friction": 0.0}]}
    part = {"pipe": named, "segment_length": 10.0}
    case = make_case([[0, 0, 0], [100, 0, 0]], [part], wellbore=hole, mud=mud, bit={"overpull": pull})
    shares = equilibrium(case, "trip_out", 100.0).shares
    share = shares[[limit.code for limit in LIMITS].index("collapse"), SHARE]
    assert pressure / share == pytest.approx(collapses * 6894.757, rel=2e-3)


@pytest.mark.parametrize(
    ("operation", "changes", "limit"),
    [
        ("trip_out", {"limits": {"design_factor": 10.0}, "mud": {"density": 0.0}, "depth": 1000.0}, "yield"),
        ("trip_out", {"rig": {"hoist_capacity": 100e3}}, "hoist"),
        ("rotate_off_bottom", {"rig": {"largest_torque": 1e3, "torque_offset": 2e3}}, "drive"),
    ],
)
def test_a_string_beyond_its_limit_already_has_no_margin(operation: str, changes: dict[str, Any], limit: str) -> None:
    depth = changes.pop("depth", 900.0)
    weak = [pipe(None, None, segment_length=50.0, yield_strength=500e6)]
    margin = found(make_case(components=weak, **changes), operation, depth)[limit]
    assert margin.share > 1
    assert np.isnan(margin.force)
    assert margin.reason.startswith("beyond it already")


def test_overpull_below_the_margin_that_is_asked_for_is_said() -> None:
    left = found(make_case(mud=MUD), "trip_out", 900.0)["yield"].hookload_left
    reasons: Sequence[str] = [
        found(make_case(mud=MUD, limits={"overpull_margin": share * left}), "trip_out", 900.0)["yield"].reason
        for share in (0.98, 1.02)
    ]
    assert reasons[0] == "none"
    assert "limits.overpull_margin" in reasons[1]


# What limits the string by default; then of each key the operation, its limit, the load there, and how many times that
# is as large with the limit 2 % lower.  The capacity of slips goes with less than their length.
GIVEN: dict[str, dict[str, float]] = {
    "rig": {"hoist_capacity": 1.5e6, "largest_torque": 30e3, "slip_length": 0.4},
    "limits": {"design_factor": 1.1, "torque_share": 0.9},
    "pipe": {"yield_strength": 900e6},
}
LOWERED: dict[tuple[str, str], tuple[str, str, str, float, float]] = {
    ("pipe", "yield_strength"): ("trip_out", "yield", "hookload", 0.98, 1e-6),
    ("limits", "design_factor"): ("trip_out", "yield", "hookload", 0.98, 1e-6),
    ("limits", "torque_share"): ("rotate_off_bottom", "make_up", "surface_torque", 0.98, 1e-6),
    ("rig", "hoist_capacity"): ("trip_out", "hoist", "hookload", 0.98, 1e-6),
    ("rig", "largest_torque"): ("rotate_off_bottom", "drive", "surface_torque", 0.98, 1e-6),
    ("rig", "slip_length"): ("rotate_off_bottom", "slips", "hookload", 0.9925, 2e-3),
}


@pytest.mark.parametrize("key", LOWERED)
def test_a_limit_that_is_lowered_by_two_per_cent_lowers_the_load_at_it(key: tuple[str, str]) -> None:
    operation, limit, load, times, within = LOWERED[key]

    def at_limit(change: float) -> float:
        tables = {table: dict(values) for table, values in GIVEN.items()}
        tables[key[0]][key[1]] *= change
        part = {"name": "pipe", "pipe": "5 in 19.5 S-135 NC50", "segment_length": 30.0} | tables.pop("pipe")
        return float(getattr(found(make_case(components=[part], mud=MUD, **tables), operation, 900.0)[limit], load))

    lower = 1 / 0.98 if key[1] == "design_factor" else 0.98  # a larger factor leaves less
    assert at_limit(lower) / at_limit(1.0) == pytest.approx(times, rel=within)


def test_a_limit_of_resolved_joints_names_the_component_of_the_case() -> None:
    """And is that of the coarse string, whose bending closed forms have."""
    stations = [[0, 0, 0], [300, 0, 0], [700, 40, 20], [1200, 40, 20]]
    at_limit = []
    for cut in ({"joint_segments": 4}, {"segment_length": 9.6}):
        parts = [pipe(60, 12, outer=0.165, name="collars"), {"pipe": "5 in 19.5 S-135 NC50", "name": "dp"} | cut]
        overpull = found(make_case(stations, parts, mud=MUD), "trip_out", 1150.0)["yield"]
        assert overpull.part == "dp"
        at_limit.append(overpull.hookload)
    assert at_limit[0] == pytest.approx(at_limit[1], rel=0.02)


def test_slips_bear_less_by_the_design_factor() -> None:
    bare, careful = (
        found(make_case(rig={"slip_length": "16.5 in"}, limits=limits), "rotate_off_bottom", 900.0)["slips"]
        for limits in ({}, {"design_factor": 1.25})
    )
    assert careful.hookload == pytest.approx(bare.hookload / 1.25, rel=1e-12)
    assert careful.share == pytest.approx(1.25 * bare.share, rel=1e-12)


@pytest.mark.parametrize("segment", [10.0, 50.0])
def test_the_upper_end_of_a_weaker_lower_section_is_where_it_gives_way(segment: float) -> None:
    """Whatever its segments are: its strength less what hangs below its upper end."""
    parts = [pipe(400.0, None, segment_length=segment, outer=0.089, inner=0.07, yield_strength=500e6, name="lower"),
             pipe(None, None, segment_length=segment, name="upper")]  # fmt: skip
    case = make_case(components=parts, mud=MUD)
    margin = found(case, "trip_out", 900.0)["yield"]
    lower = section_of(case.string.components[0], 1200.0)
    capacity = 500e6 * np.pi / 4 * (0.089**2 - 0.07**2)
    assert margin.force == pytest.approx(capacity - 400 * lower.weight, rel=1e-4)
    assert margin.part == "lower"


def test_tension_lowers_the_collapse_pressure_along_an_ellipse() -> None:
    """Of empty drill pipe in mud: from Y the share r = (T - p A_o)/A_s Y leaves √(1 - 3/4 r²) - r/2 (API RP 7G)."""
    parts = [pipe(None, None, segment_length=50.0, outer=0.127, inner=0.112, yield_strength=517e6)]
    mud = {"density": 1900.0, "inside": [{"density": 0.0}], "float": True}
    margin = found(make_case(components=parts, mud=mud), "trip_out", 900.0)
    (limit,) = (of for of in margin.values() if of.margin == OVERPULL)
    assert limit.limit == "collapse"
    section = section_of(make_case(components=parts).string.components[0], 1900.0, 0.0)
    pressure, outer = 1900 * GRAVITY * 900, np.pi / 4 * 0.127**2
    steel = outer - np.pi / 4 * 0.112**2
    share = (limit.force - pressure * outer) / steel / 517e6
    assert section.collapse * (np.sqrt(1 - 0.75 * share**2) - 0.5 * share) == pytest.approx(pressure, rel=0.01)


def test_connections_that_are_not_known_are_said_and_used_is_of_the_limit_that_is_named() -> None:
    named = {"name": "pipe", "pipe": "5 in 19.5 S-135 NC50", "segment_length": 30.0}
    both = torques(make_case(components=[pipe(100, 5, name="collars"), named], mud=MUD))["make_up"]
    assert both.reason == "the torque that the connections of collars bear is not known, and left out"
    alone = torques(make_case(components=[named], mud=MUD))["make_up"]
    assert alone.reason == "none"
    assert alone.share == pytest.approx(0.0, abs=1e-6)  # it hangs straight, and no torque is used


@pytest.mark.parametrize("own", [0.0, 15e3, 60e3])
def test_weight_and_torque_at_a_limit_are_those_of_the_bit_in_all(own: float) -> None:
    """A level string without friction snakes and yields at the same loads whatever the case has on its bit."""
    level = make_case(
        [[0, 90, 0], [600, 90, 0]], [pipe(None, None, segment_length=10.0)], mud=MUD,
        wellbore={"intervals": [{"to_md": 600, "diameter": 0.2159, "friction": 0.0}]},
        rig={"block_weight": 1e6, "largest_torque": 20e3}, bit={"weight_on_bit": own, "torque": own / 10},
    )  # fmt: skip
    section = section_of(level.string.components[0], 1200.0)
    onset = 2 * np.sqrt(section.EI * section.weight / (0.5 * (0.2159 - 0.127)))
    margin = found(level, "drill_rotating", 500.0)
    assert margin[SNAKING].force == pytest.approx(onset, rel=5e-3)
    assert margin[SNAKING].hookload_left == pytest.approx(onset - own, abs=5e-3 * onset)
    assert margin["drive"].torque == pytest.approx(20e3, rel=1e-6)
    assert margin["drive"].surface_torque_left == pytest.approx(20e3 - own / 10, rel=1e-6)
    assert (margin[SNAKING].reason == "beyond it already with 60 kN on the bit") == (own > onset)
