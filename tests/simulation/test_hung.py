"""Stands are added and racked back in a run: no jolt, nothing is lost, the hook carries what hangs."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import equilibrium, simulate
from fctd.mechanics import state, topdrive
from fctd.mechanics.derrick import read_joint
from fctd.mechanics.energy import penetration
from fctd.mechanics.topdrive import GRAVITY
from fctd.results.ledger import LOSSES
from fctd.simulation.hung import Hung
from fctd.simulation.preparation import contact_points, prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import settle, start_from_rest
from fctd.simulation.simulate import Simulation
from tests.bodies import PLACE, at
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [150, 0, 0], [450, 60, 0], [1000, 60, 0]]
STRING = [pipe(60, None, outer=0.16, segment_length=20.0), pipe(None, None, segment_length=28.5)]
MUD = {"density": 1200.0}
RIG = {"feed": "stands", "connection_time": 5.0}
# Per metre of the pipe of tests.cases, by hand [N/m].
AIR = GRAVITY * 7850 * np.pi / 4 * (0.127**2 - 0.07**2)


def hanging(depth: float, components: list[dict[str, Any]] = STRING, **sections: Any) -> Run:
    """A settled run that is about to trip in from a depth [m] by 100 m."""
    moves = [trip(depth, depth + 100.0)]
    run, _ = prepare(make_case(BUILD, components, moves, mud=MUD, rig=RIG, **sections))
    settle(run)
    start_from_rest(run)
    return run


def joint(run: Run, j: int) -> np.ndarray:
    """Force of the springs of a joint [N] and its torque [N m], (4,)."""
    *force, twist = read_joint(run.S, j)
    return np.array([*force, run.S[state.K_TWIST + j] * twist])


def test_a_stand_joins_without_a_jolt() -> None:
    """At the table, with a torque in the string: no load of the string below changes, and the stand is at rest."""
    run = hanging(171.0)  # six stands
    hung = run.upper_end
    assert isinstance(hung, Hung)
    assert run.top[topdrive.BLOCK_HEIGHT] == pytest.approx(0, abs=1e-9)
    run.advance(topdrive.Motion(0.0, 5.0, 0.0, 0.0, 0.0, 3.0)._replace(start=run.time), 5.0)  # the string is twisted
    run.refresh()
    n, before, energy = run.segments, [joint(run, j) for j in (1, 2, 3)], run.energy()
    place = at(run.S, 1, PLACE)
    assert abs(before[0][3]) > 10
    hung._add(run)
    run.refresh()
    m = run.segments - n
    assert m == 1
    for j, wanted in enumerate(before, start=1):
        np.testing.assert_allclose(joint(run, j + m), wanted, rtol=1e-6, atol=0.02)
    np.testing.assert_array_equal(at(run.S, 1 + m, PLACE), place)
    # The block carries the weight in air of the stand as well, and the same torque.
    force = joint(run, 1)
    assert force[2] == pytest.approx(before[0][2] - AIR * 28.5, rel=1e-6)
    assert force[3] == pytest.approx(before[0][3], rel=1e-9)
    # The block is above the table by the stand and its stretch by the load.
    stretch = (-before[0][2] + 0.5 * AIR * 28.5) * 28.5 / float(run.string.of("EA")[0])
    assert run.top[topdrive.BLOCK_HEIGHT] == pytest.approx(28.5 + stretch, rel=1e-5)
    assert run.bit_depth == pytest.approx(171.0, abs=1e-3)
    assert run.energy().gravity - energy.gravity == pytest.approx(AIR * 28.5 * 14.25, rel=1e-3)
    # Racked back, it is the string that it was.
    hung._rack(run)
    run.refresh()
    assert run.segments == n
    assert run.top[topdrive.BLOCK_HEIGHT] == pytest.approx(0, abs=1e-9)
    for j, wanted in enumerate(before, start=1):
        np.testing.assert_allclose(joint(run, j), wanted, rtol=1e-6, atol=0.02)
    np.testing.assert_allclose(run.energy(), energy, rtol=1e-6, atol=1e-3)


@st.composite
def strings(draw: st.DrawFn) -> list[dict[str, Any]]:
    outers = draw(st.permutations([0.127, 0.15, 0.16]))[: draw(st.integers(1, 3))]
    parts = [
        pipe(draw(st.floats(6.0, 90.0)), None, outer, segment_length=draw(st.floats(5.0, 30.0))) for outer in outers
    ]
    return [*parts, pipe(None, None, segment_length=draw(st.floats(7.0, 30.0)))]


CONSTANTS = (
    state.MASS, state.J_TRANSVERSE, state.J_AXIAL, state.INVERSE_MASS, state.ARM_TOP, state.ARM_BOTTOM,
    state.ARM_CONTACT, state.RADIUS, state.TRIBUTARY, state.BUOYANCY, state.IN_MUD_AXIAL, state.IN_MUD_LATERAL,
    state.IN_MUD_SPIN, state.K_AXIAL, state.K_SHEAR, state.K_BEND, state.K_TWIST,
)  # fmt: skip


@settings(max_examples=15)
@given(parts=strings(), stand=st.floats(9.0, 36.0), depth=st.floats(20.0, 300.0), moves=st.integers(1, 3))
def test_in_and_out_is_the_same_string(parts: list[dict[str, Any]], stand: float, depth: float, moves: int) -> None:
    """Length, mass and count grow by those of the stands, and shrink by the same; no loss is forgotten."""
    case = make_case(BUILD, parts, [trip(depth, depth + 4 * stand)], mud=MUD, rig=RIG | {"stand_length": stand})
    run, _ = prepare(case)
    hung, S = run.upper_end, run.S
    assert isinstance(hung, Hung)
    run.refresh()
    tally, before = hung.tally, state.columns(state.copy_state(S))
    for k, row in enumerate(LOSSES.values()):
        state.row(S, row, run.segments)[:] = np.arange(run.segments) + k
    lost = [state.row(S, row, run.segments).sum() for row in LOSSES.values()]

    def check() -> None:
        run.refresh()
        string, n = run.string, run.segments
        assert n == string.segments == tally.count[hung.stands]
        assert float(string.length.sum()) == pytest.approx(tally.reach[hung.stands], abs=1e-6)
        mass = string.of("mass") * string.length
        np.testing.assert_allclose(state.row(S, state.MASS, n), mass)
        height = float(run.top[topdrive.BLOCK_HEIGHT])
        np.testing.assert_allclose(S[PLACE[0]], 0, atol=1e-6)
        assert S[PLACE[2]] == pytest.approx(-height, abs=1e-9)
        beyond = state.columns(S)[:, n + 1 : n + 9]
        np.testing.assert_array_equal(beyond, before[:, -8:])
        found = [state.row(S, row, n).sum() for row in LOSSES.values()]
        np.testing.assert_allclose(found, lost)

    for _ in range(moves):
        hung._add(run)
        check()
    for _ in range(moves):
        hung._rack(run)
        check()
    n = run.segments
    for row in CONSTANTS:
        np.testing.assert_array_equal(state.row(S, row, n), before[row // state.STRIDE, 1 : n + 1])


def test_the_hook_carries_what_hangs() -> None:
    """A vertical hole without a wall: below the table weight in mud, above it weight in air; in the slips nothing."""
    rig = RIG | {"block_weight": 2e5, "guide_friction": 1e3, "sheave_efficiency": 0.98}
    case = make_case(
        components=[pipe(None, None, segment_length=14.25)],
        operations=[trip(40.0, 80.0, speed=0.5), trip(80.0, 40.0, speed=0.5), rotation(40.0, 5.0)],
        mud=MUD | {"axial_damping": 40.0}, rig=rig, record={"interval": 1.0}, contact={"enabled": False},
    )  # fmt: skip
    result = simulate(case)
    assert result.status == "completed"
    history, drag = result.history, 40.0
    slips = history["in_slips"].to_numpy()
    height, depth = history["block_position_m"], history["bit_depth_m"]
    assert slips.sum() == 10
    np.testing.assert_allclose(height[slips], 0.0, atol=1e-3)
    assert (height[~slips] > -1e-3).all()
    assert height.max() < 28.52
    # The last second of each stroke that is long enough to come to rest: the pull, less the mud's drag.
    wanted = AIR * (height + depth) - AIR * 1200 / 7850 * depth
    still = slips & (np.append(slips[1:], False))
    np.testing.assert_allclose(history["hookload_N"][still], wanted[still], rtol=5e-3)
    cruising = np.flatnonzero(~slips & np.isclose(np.abs(depth.diff()), 0.5, atol=1e-3))
    sign = np.sign(depth.diff())
    away = history["hookload_N"] - wanted + sign * drag * 0.5 * depth
    assert np.abs(away.iloc[cruising]).mean() < 0.02 * wanted.mean()
    # The weight indicator: the sheaves and guides by the block's last motion, nothing of the string in the slips.
    inward = (200e3 - 1e3) / 0.98
    assert history["weight_indicator_N"][int(np.argmax(slips))] == pytest.approx(inward)
    resting = history.iloc[-1]
    assert resting["weight_indicator_N"] == pytest.approx((resting["hookload_N"] + 200e3 + 1e3) * 0.98)
    assert result.run["energy_error"] < 1e-3


def test_a_trip_in_and_out_of_a_deviated_well() -> None:
    """Reaming in, stands of three and of fewer segments: the ledger closes, and the steady string agrees."""
    reaming = {"kind": "trip_in", "from_md": 250.0, "to_md": 300.0, "speed": 0.5, "rpm": 60.0, "ramp_time": 5.0}
    moves = [reaming, trip(300.0, 240.0, speed=0.5)]
    case = make_case(BUILD, STRING, moves, mud=MUD | {"axial_damping": 5.0}, rig=RIG, record={"interval": 2.0})
    simulation = Simulation(case)
    for _ in simulation:
        pass
    result, run = simulation.result(), simulation.run
    assert result.status == "completed"
    assert result.run["energy_error"] < 1e-3
    assert result.history["bit_depth_m"].iloc[-1] == pytest.approx(240.0, abs=1e-6)
    assert (result.profile["md_m"].iloc[0]) == pytest.approx(-run.top[topdrive.BLOCK_HEIGHT], abs=0.02)
    last = result.history[result.history["operation"] == "trip_out"].iloc[-8:]
    steady = equilibrium(case, operation="trip_out", bit_depth=float(last["bit_depth_m"].mean()))
    pull = float((last["hookload_N"] - AIR * last["block_position_m"]).mean())
    weight = float((run.string.weight * run.string.length).sum())
    assert abs(pull - steady.hookload) < 0.005 * weight


@pytest.mark.slow
def test_a_sticking_string_stays_where_it_hangs_in_the_slips() -> None:
    """3 km that slid into a winding hole: the slips hold it, and friction what slid; the hook load had crept up by
    60 kN in half a minute, as segments that swung across lost their friction along the hole."""
    winding = [[float(md), 70.0 + 3 * (-1) ** k, 4.0 * (k % 3)] for k, md in enumerate(range(1000, 3400, 150))]
    string = [pipe(None, None, inner=0.1086, segment_length=28.5)]
    moves = [trip(2952.5, 2997.5, speed=0.5)]
    simulation = Simulation(make_case(
        [[0, 0, 0], [200, 0, 0], *winding], string, moves, wellbore={"geometry": "arcs"}, mud=MUD,
        contact={"friction_law": "karnopp"}, rig={"feed": "stands", "connection_time": 300.0},
    ))  # fmt: skip
    run = simulation.run
    places, loads = [], []
    for record in simulation:
        if record["in_slips"]:
            places.append(contact_points(run.S, run.segments))
            loads.append(record["hookload_N"])
        elif places:
            break
    touching = penetration(run.S, len(places[0])) > 0
    way = np.linalg.norm(places[-2] - places[-62], axis=1)[touching]
    assert len(loads) > 295
    assert np.ptp(loads[5:]) < 2e3
    # In an hour, from the last minute, when the swing of what hangs free has died.
    assert 60 * way.max() < 1e-6


def test_the_mean_of_a_trip_is_that_of_a_whole_stroke() -> None:
    """Six stands hang; two more and 3 m of a third are run, so that the last stroke lasts 2 s at full speed."""
    case = make_case(BUILD, STRING, [trip(171.0, 231.0, speed=0.5, ramp=4.0)], mud=MUD, rig=RIG)
    (row,) = simulate(case).operations.to_dict("records")
    assert 50 < row["hookload_periods"] * row["hookload_period_s"] <= 53


@pytest.mark.slow
def test_a_caliper_with_a_flow_curve_is_run_in_stands_as_its_round_hole_is() -> None:
    """Segments of 3 m, some wholly above the rotary table; a caliper that is wider below the bit changes nothing."""
    caliper = {"rows": [[10.0, 0.3], [500.0, 0.3], [550.0, 0.32], [600.0, 0.3], [990.0, 0.3]]}
    interval = {"to_md": 1000.0, "diameter": 0.3, "friction": 0.3}
    ends = []
    for hole in ({"geometry": "arcs"}, {"geometry": "sampled", "caliper": caliper}):
        case = make_case(
            BUILD, [pipe(None, None, segment_length=3.0)], [trip(160.0, 160.5, ramp=1.0)],
            wellbore={"intervals": [interval], **hole}, mud={"density": 1200.0, "viscosity": 0.05}, rig=RIG,
        )  # fmt: skip
        run = simulate(case)
        assert run.status == "completed"
        ends.append(run.history[["hookload_N", "bit_md_m"]].iloc[-1].to_numpy(float))
    np.testing.assert_allclose(ends[1], ends[0], rtol=1e-4)
