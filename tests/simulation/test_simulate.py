"""Whole simulations on small strings: balances, laws, schedule, records, and failures."""

import re

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd import SimulationResult, simulate
from fctd.mechanics import state
from fctd.model.operations import schedule
from fctd.model.torsion import period_of
from fctd.results.columns import BUCKLED
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [400, 0, 0], [850, 90, 0], [1200, 90, 0]]
STRING = [pipe(None, None, outer=0.102, segment_length=25.0)]


def build_case(operation: dict | list, **sections):
    operations = operation if isinstance(operation, list) else [operation]
    return make_case(BUILD, STRING, operations, top_md=300.0, **sections)


def steady(result: SimulationResult, seconds: float = 10.0) -> pd.Series:
    assert result.status == "completed", result.message
    late = result.history[result.history.time_s > result.history.time_s.max() - seconds]
    return late.mean(numeric_only=True)


ROTATE = rotation(1000, 30, ramp=10)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("law", ["coulomb", "paper"])
def test_torque_balance_at_steady_rotation(geometry: str, law: str) -> None:
    """Top reaction = Σ r F_t without dampers, and + mud torque with them, within 0.5 %."""
    for mud in ({}, {"mud": {"rotational_damping": 0.5, "axial_damping": 1.0, "lateral_damping": 5.0}}):
        result = simulate(
            build_case(ROTATE, wellbore={"geometry": geometry}, contact={"friction_law": law}, **mud)
        )  # fmt: skip
        end = steady(result)
        losses = end.sum_r_ft_N_m + end.mud_torque_N_m
        assert end.surface_torque_N_m == pytest.approx(losses, rel=5e-3)
        assert (end.mud_torque_N_m > 100) == bool(mud)
        # In pure rotation the paper's Σ r μ F_n is the same number.
        assert end.sum_r_ft_N_m == pytest.approx(end.sum_r_mu_fn_N_m, rel=2e-3)


def test_mud_torque_is_the_damper_times_the_spin() -> None:
    mud = {"rotational_damping": 0.5}
    end = steady(simulate(build_case(ROTATE, mud=mud)))
    assert end.mud_torque_N_m == pytest.approx(0.5 * 700 * 2 * np.pi, rel=1e-3)


def test_rotating_hook_load_is_the_vertical_weight() -> None:
    """Contact forces of a rotating string have no component along the hole, whatever their size."""
    case = build_case(ROTATE)
    section = fctd.model.section.section_of(case.string.components[0], 0.0)
    radius = 450 / (np.pi / 2)
    assert steady(simulate(case)).hookload_N == pytest.approx(section.weight * (100 + radius), rel=3e-3)


def test_coulomb_rotation_climbs_the_wall_by_the_friction_angle() -> None:
    """N = q/√(1+μ²) at 180° − atan μ in the horizontal part, turning clockwise looking downhole."""
    case = build_case(ROTATE, mud={"lateral_damping": 50.0})
    result = simulate(case)
    part = result.profile[(result.profile.md_m > 900) & (result.profile.md_m < 980)]
    np.testing.assert_allclose(part.contact_angle_deg, 180 - np.degrees(np.arctan(0.2)), atol=0.1)
    weight = fctd.model.section.section_of(case.string.components[0], 0.0).weight * 25
    np.testing.assert_allclose(part.contact_force_N, weight / np.sqrt(1.04), rtol=5e-3)


def test_pick_up_and_slack_off_bracket_rotation() -> None:
    up = steady(simulate(build_case(trip(1000, 995, ramp=10))), 5)
    down = steady(simulate(build_case(trip(1000, 1005, ramp=10))), 5)
    still = steady(simulate(build_case(ROTATE)))
    assert up.hookload_N > 1.02 * still.hookload_N > 1.04 * down.hookload_N


def test_back_reaming_turns_drag_into_torque() -> None:
    """Sliding along and around at once: the resultant friction is shared by the ratio of the speeds."""
    ream = {"kind": "back_ream", "from_md": 1000, "to_md": 994, "speed": 0.2, "rpm": 60, "ramp_time": 10}
    end = steady(simulate(build_case(ream)), 5)
    up = steady(simulate(build_case(trip(1000, 995, ramp=10))), 5)
    around = 0.051 * 2 * np.pi
    share = around / np.hypot(around, 0.2)
    assert end.sum_r_ft_N_m == pytest.approx(share * end.sum_r_mu_fn_N_m, rel=0.02)
    assert end.hookload_N < up.hookload_N


@pytest.mark.parametrize("operation", [ROTATE, trip(1000, 1006, ramp=10), trip(1000, 994, ramp=10)])
def test_energy_ledger_closes(operation: dict) -> None:
    """Within 0.1 % of the energy exchanged, at the default step."""
    result = simulate(build_case(operation, wellbore={"geometry": "arcs"}))
    assert result.run["energy_error"] < 1e-3
    terms = result.energy.iloc[-1]
    gains = terms.top_drive_work_J + terms.fed_pipe_J
    held = terms.kinetic_J + terms.gravity_J + terms.strain_J + terms.contact_J
    lost = terms.lost_friction_J + terms.lost_contact_J + terms.lost_mud_J + terms.lost_joints_J
    assert abs(gains - held - lost) < 1e-3 * lost


@pytest.mark.parametrize("operation", [rotation(1000, 40, ramp=15), trip(990, 1000, ramp=10)], ids=["turned", "fed"])
def test_mud_resists_all_of_a_long_segment(operation: dict) -> None:
    """Vertical, without wall: c L of the whole string, in loads, profile and ledger, as the steady solver has it."""
    mud = {"axial_damping": 40.0, "rotational_damping": 1.0}
    case = make_case(
        operations=[operation], components=[pipe(300, 6), pipe(None, 1)], mud=mud, contact={"enabled": False},
    )  # fmt: skip
    result = simulate(case)
    assert result.run["energy_error"] < 1e-3
    middle = result.history[(result.history.time_s > 20) & (result.history.time_s < 35)].mean(numeric_only=True)
    depth, turning = middle.bit_depth_m, operation["kind"] == "rotate_off_bottom"
    rate = 2 * np.pi if turning else 0.2
    weight = fctd.model.section.section_of(case.string.components[0], 0.0).weight
    expected = (weight * depth, depth * rate) if turning else ((weight - 40 * rate) * depth, 0.0)
    assert middle.hookload_N == pytest.approx(expected[0], rel=1e-3)
    assert (middle.surface_torque_N_m, middle.mud_torque_N_m) == pytest.approx((expected[1],) * 2, rel=1e-3, abs=1e-6)
    lost = result.energy.lost_mud_J
    inside = result.energy.time_s.between(20, 35)
    power = np.polyfit(result.energy.time_s[inside], lost[inside], 1)[0]
    assert power == pytest.approx((1.0 if turning else 40.0) * depth * rate**2, rel=5e-3)
    top, end = result.profile[result.profile.md_m == 0].iloc[-1], result.history.iloc[-1]
    assert (top.effective_tension_N, top.torque_N_m) == pytest.approx((end.hookload_N, end.surface_torque_N_m))
    steady = fctd.equilibrium(case, operation["kind"], 1000.0, **({"rpm": 60} if turning else {"speed": 0.2}))
    assert steady.surface_torque == pytest.approx(1000 * rate if turning else 0.0, rel=1e-6, abs=1e-6)
    assert steady.profile.torque_N_m.iloc[0] == pytest.approx(steady.surface_torque, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("operation", "damping"), [(ROTATE, 1e-5), (trip(1000, 995, ramp=5), 1e-3)])
def test_energy_error_falls_with_the_step(operation: dict, damping: float) -> None:
    """At first order to zero, also with a damper at the clamp that pulls on the pipe fed in."""
    errors = []
    for step in (0.8e-3, 0.2e-3):
        solver = {"step": step, "joint_damping": damping}
        result = simulate(build_case(operation, wellbore={"geometry": "arcs"}, solver=solver))
        errors.append(result.energy.residual_J.abs().max())
    assert errors[1] < 0.35 * errors[0], errors


def test_fed_pipe_brings_its_strain_energy() -> None:
    """Lowering a vertical string: each metre enters with T²/2EA and, half of it lumped, with ¼ m v²."""
    case = make_case(operations=[trip(900, 960, speed=0.5)], components=[pipe(800, 16), pipe(None, 1)])
    result = simulate(case)
    section = fctd.model.section.section_of(case.string.components[1], 0.0)
    long = result.history.bit_depth_m - 800
    tension = result.history.hookload_N - 0.5 * section.weight * long
    expected = 60 * ((tension**2).mean() / (2 * section.EA) + 0.25 * section.mass * 0.5**2)
    assert result.energy.fed_pipe_J.iloc[-1] == pytest.approx(expected, rel=0.01)


def test_many_turns_of_twist_are_kept() -> None:
    """A soft long segment winds up by several turns; torque still balances."""
    components = [pipe(300, 12, outer=0.102), pipe(None, 1, outer=0.102, torsional_stiffness=2e4)]
    stations = [[0, 0, 0], [500, 0, 0], [950, 90, 0], [1200, 90, 0]]
    damping = {"rotational_damping": 2.0}
    result = simulate(make_case(stations, components, [rotation(780, 120, rpm=60, ramp=60)], mud=damping))
    end = steady(result)
    assert end.surface_torque_N_m * 480 / 2e4 > 4 * np.pi
    assert end.surface_torque_N_m == pytest.approx(end.sum_r_ft_N_m + end.mud_torque_N_m, rel=0.02)


def test_schedule_stops_between_operations_and_hits_its_depths() -> None:
    case = build_case([trip(990, 994, ramp=2), rotation(994, 10, ramp=2), trip(994, 991, ramp=2)])
    phases = schedule(case.operations)
    travelled = sum(0.5 * (m.feed_from + m.feed_to) * m.duration for m, _ in phases)
    assert travelled == pytest.approx(1.0)
    result = simulate(case)
    ends = result.history.groupby("operation", sort=False).bit_depth_m.last()
    np.testing.assert_allclose(ends, [994, 994, 991], atol=1e-4)
    assert result.run["simulated_s"] == pytest.approx(sum(m.duration for m, _ in phases))


def test_short_trips_shorten_their_ramps() -> None:
    phases = schedule(build_case([trip(990, 990.5, speed=1.0, ramp=10)]).operations)
    assert sum(0.5 * (m.feed_from + m.feed_to) * m.duration for m, _ in phases) == pytest.approx(0.5)


def test_profiles_are_kept_at_the_depths_asked_for() -> None:
    case = build_case(trip(990, 995), record={"interval": 0.5, "profile_at": [992.0, 993.5]})
    depths = simulate(case).profile.bit_depth_m.unique()
    assert len(depths) == 3
    np.testing.assert_allclose(depths, [992, 993.5, 995], atol=0.11)


def test_sensors_add_block_offset_and_sheaves() -> None:
    rig = {
        "block_weight": 3e5, "sheave_efficiency": 0.97, "guide_friction": 1e4, "torque_offset": 500,
        "torque_per_rpm": 2.0,
    }  # fmt: skip
    for operation, exponent in ((trip(1000, 995), 1), (trip(1000, 1005), -1), (ROTATE, 0)):
        end = steady(simulate(build_case(operation, rig=rig)), 5)
        assert end.weight_indicator_N == pytest.approx((end.hookload_N + 3e5 + exponent * 1e4) * 0.97**exponent)
        assert end.drive_torque_N_m == pytest.approx(end.surface_torque_N_m + 500 + 2 * operation.get("rpm", 0))


def test_true_tension_is_effective_less_buoyancy() -> None:
    """At the bit of an off-bottom string the mud's pressure compresses the steel: −ρ g z (A_o − A_i)."""
    result = simulate(make_case(operations=[rotation(1000, 1, ramp=1)], mud={"density": 1200}))
    area = np.pi / 4 * (0.127**2 - 0.07**2)
    bit = result.profile.iloc[-1]
    assert bit.effective_tension_N == 0
    assert bit.true_tension_N == pytest.approx(-1200 * 9.80665 * 1000 * area, rel=1e-3)


@pytest.mark.parametrize("inclination", [120.0, 170.0])
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_a_hole_that_turns_back_upwards(inclination: float, geometry: str) -> None:
    """Past 90 degrees the hook load is that of the vertical reach minus the push of the leg beyond the lowest point.

    Without friction, which would let a string that is pushed up to its buckling limit and turns roll around its hole.
    """
    stations = [[0, 0, 0], [500, 0, 0], [1500, inclination, 0], [2300, inclination, 0]]
    smooth = {"geometry": geometry, "intervals": [{"to_md": 2300, "diameter": 0.2159, "friction": 0.0}]}
    case = make_case(stations, [pipe(2200, 88)], [rotation(2200, 20)], wellbore=smooth)
    weight = fctd.model.section.section_of(case.string.components[0], 0.0).weight
    depth = fctd.build_wellbore(case).at(np.array([2200.0]))[0][0, 2]
    assert steady(simulate(case), 5).hookload_N == pytest.approx(weight * depth, abs=1e-3 * weight * 2200)


def test_without_walls_nothing_touches() -> None:
    result = simulate(make_case(operations=[rotation(1000, 1, ramp=1)], contact={"enabled": False}))
    assert result.history.contact_count.max() == 0
    assert result.history.total_contact_force_N.max() == 0


def test_an_unstable_run_stops_names_the_time_and_keeps_its_records() -> None:
    """A string pushed into a hole with high friction leaves through the wall, without any change by the test."""
    gripping = {"intervals": [{"to_md": 1200, "diameter": 0.2159, "friction": 3.0}]}
    result = simulate(build_case(trip(1000, 1070, speed=1.0), wellbore=gripping))
    assert result.status == "unstable"
    assert re.match(r"at \d+ s: (segment \d+ has left the hole|the string has folded)", result.message)
    assert len(result.history) > 3
    extent = [column.name for column in BUCKLED]  # NaN where the string is not buckled
    assert np.isfinite(result.history.select_dtypes("number").drop(columns=extent).to_numpy()).all()


def test_an_interrupted_run_keeps_its_records() -> None:
    def stop(now: float, total: float, factor: float) -> None:
        if now > 3:
            raise KeyboardInterrupt

    result = simulate(build_case(ROTATE), progress=stop)
    assert result.status == "interrupted"
    assert 3 <= result.history.time_s.max() < 6


def test_settling_reports_how_far_it_is() -> None:
    seen: list[tuple[float, float]] = []
    simulate(build_case(rotation(1000, 1, ramp=1)), settling=lambda *args: seen.append(args))
    times, imbalances = zip(*seen, strict=True)
    assert len(seen) > 3
    np.testing.assert_allclose(np.diff(times), times[0])
    assert imbalances[-1] < 1e-6 < imbalances[0]


def test_progress_reports_simulated_and_total_time() -> None:
    seen = []
    simulate(build_case(rotation(1000, 5, ramp=1)), progress=lambda *args: seen.append(args))
    times, totals, factors = zip(*seen, strict=True)
    assert list(times) == pytest.approx([1, 2, 3, 4, 5])
    assert set(totals) == {5.0}
    assert min(factors) > 0


def test_default_damping_keeps_a_sliding_string_quiet() -> None:
    """Without any, compressed rigid segments chatter along the wall at their highest frequency; the default
    loses next to nothing and stops it."""
    lost, swings = [], []
    for given in ({"contact": {"damping": 0}, "solver": {"joint_damping": 0, "shape_damping": 0}}, {}):
        result = simulate(build_case(trip(1000, 1070, speed=1.0), **({"wellbore": {"geometry": "arcs"}} | given)))
        last, late = result.energy.iloc[-1], result.history[result.history["time_s"] > 30]
        lost.append((last.lost_contact_J + last.lost_joints_J) / last.lost_friction_J)
        swings.append((late["hookload_max_N"] - late["hookload_min_N"]).mean())
    assert lost[1] < 1e-3
    assert swings[1] < 0.5 * swings[0]


def test_two_runs_are_the_same_to_the_last_bit() -> None:
    first, second = (simulate(build_case(rotation(1000, 5, ramp=1))) for _ in range(2))
    pd.testing.assert_frame_equal(first.history, second.history, check_exact=True)


def test_a_string_is_laid_with_its_bodies_and_its_clamp_along_the_hole() -> None:
    """Quaternions and axes agree, also at the top of a string that hangs in a bend, and where the hole turns."""
    turning = [[0, 0, 0], [450, 45, 30], [900, 90, 120]]
    run, _ = prepare(make_case(turning, [pipe(300, 5)], [rotation(600, 5)], 300.0, {"geometry": "arcs"}))
    rows = slice(0, run.segments + 1)
    w, x, y, z = (run.S[row:][rows] for row in (state.QW, state.QX, state.QY, state.QZ))
    axes = np.stack([run.S[row:][rows] for row in (state.AX, state.AY, state.AZ)])
    np.testing.assert_allclose([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axes, atol=1e-12)
    np.testing.assert_allclose(axes[:, 0], run.hole.at(np.array([300.0]))[1][0], atol=1e-12)


@pytest.mark.parametrize(("ramp", "swings"), [(0.2, True), (10.0, False)])
def test_a_run_says_that_the_wave_of_its_start_has_not_died(ramp: float, swings: bool) -> None:
    """A vertical string that is picked up at 1 m/s at once: the wave is ρcAv = 0.4 MN·s/m times 1 m/s, and the string
    weighs 0.7 MN.  Slowly started, it hardly swings."""
    moves = [trip(980, 960, speed=1.0, ramp=ramp)]
    case = make_case(components=[pipe(100, 10), pipe(None, 1)], operations=moves, record={"interval": 0.05})
    result = simulate(case)
    codes = [note.code for note in result.notes]
    assert ("hookload" in codes) == swings


def test_a_whirling_string_says_so_and_the_mud_s_damping_holds_it() -> None:
    """13⅜ in casing in 17½ in hole, friction factor 0.5, 120 rev/min, in segments so long that it rolls up the wall.

    With damping it is the steady string; without it the segments roll at r Ω, less what the joints take.
    """
    stations = [[0, 0, 0], [240, 0, 0], [684, 90, 0], [3000, 90, 0]]
    intervals = [{"to_md": 3000, "diameter": 0.4445, "friction": 0.5}]
    casing = [pipe(None, None, outer=0.3397, inner=0.3153, segment_length=25.0)]
    results = []
    for mud in ({"viscosity": 0}, {}):
        case = make_case(
            stations, casing, [rotation(3000, 27, rpm=120, ramp=10)],
            wellbore={"intervals": intervals, "geometry": "arcs"}, mud={"density": 1200.0, **mud},
        )  # fmt: skip
        results.append(simulate(case))
    whirling, damped = results
    assert "whirl" in {note.code for note in whirling.notes}
    assert "mud.viscosity" in whirling.message
    assert whirling.history["lateral_speed_m_s"].iloc[-1] > 0.5 * 0.17 * 4 * np.pi
    assert "whirl" not in {note.code for note in damped.notes}
    still = fctd.equilibrium(damped.case, "rotate_off_bottom", 3000, rpm=120)
    (row,) = damped.operations.to_dict("records")
    assert row["hookload_mean_N"] == pytest.approx(still.hookload, rel=1e-3)
    assert row["surface_torque_mean_N_m"] == pytest.approx(still.surface_torque, rel=1e-3)


def test_a_loss_factor_damps_torsion_at_its_first_frequency() -> None:
    """A swing falls by e^(−πη) in a period; without contact, which alone would damp it."""
    swings = []
    for eta in (0.0, 0.05):
        case = make_case(
            components=[pipe(None, 20)], operations=[rotation(1000, 30, ramp=0.5)], contact={"enabled": False},
            solver={"loss_factor": eta}, record={"interval": 0.1},
        )  # fmt: skip
        history, period = simulate(case).history, period_of(prepare(case)[0].string)
        first, last = (history[(history.time_s > t) & (history.time_s <= t + 3 * period)] for t in (5, 5 + 12 * period))
        swings.append(last.surface_torque_max_N_m.max() / first.surface_torque_max_N_m.max())
    assert swings[0] > 0.99
    assert swings[1] == pytest.approx(np.exp(-np.pi * 0.05 * 12), rel=0.05)
