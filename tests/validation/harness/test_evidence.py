"""The arithmetic of the studies of the paper's claims, where an error would look like a finding."""

import numpy as np
import pandas as pd
import pytest

from fctd.mechanics.contact import DIRECTION, START
from fctd.simulation.preparation import prepare
from references.contact.for_loop import one_cylinder
from references.engines import Window
from references.engines.run import hann_means
from validation.cases import load, rotation
from validation.harness.study import Context, log_slope
from validation.parts.windows import TRIP_SPEED, TRIP_WINDOW, steady_trip
from validation.studies import (
    contact_operations,
    cylinder_ringing,
    engines_agree,
    friction_laws,
    long_segment,
    mud_effects,
    ownership,
    paper_times,
    rock_stiffness,
    segment_count,
    soft_stiff_map,
)
from validation.studies import well_profile as profile


def test_a_uniform_string_has_the_frequencies_of_a_quarter_wave():
    case = load("paper_well")
    pipe = case.string.components[1]
    length = {"length": 200.0, "segments": 20}
    even = case.model_copy(
        update={
            "string": case.string.model_copy(
                update={"components": (pipe.model_copy(update=length), *case.string.components[1:])}
            )
        }
    )
    axial, torsional = long_segment.continuous_frequencies(even)
    shear = pipe.youngs_modulus / (2 * (1 + pipe.poisson_ratio))
    for found, modulus in ((axial, pipe.youngs_modulus), (torsional, shear)):
        quarter = np.sqrt(modulus / pipe.density) / (4 * long_segment.BIT)
        assert found == pytest.approx(quarter * np.array([1, 3, 5, 7]), rel=1e-9)


def test_a_finely_cut_string_has_the_frequencies_of_the_continuous_one():
    case = long_segment.the_case(12.5, operations=rotation(long_segment.BIT, 1.0, 0.5))
    for chain, continuous in zip(
        long_segment.chain_frequencies(case), long_segment.continuous_frequencies(case), strict=True
    ):
        # Collars and the pipe below stay as they are.
        assert chain[:2] == pytest.approx(continuous[:2], rel=1e-3)


def test_start_ups_differ_by_their_largest_distance_over_the_span():
    time = np.linspace(0, 1, 101)
    frames = [
        pd.DataFrame(
            {
                "surface_torque_N_m": 10 * time + add,
                "hookload_N": 0.0,
                "operation": "rotate_off_bottom",
                "ramp_s": 2.0,
                "vertical": name,
            }
        )
        for name, add in (("long", np.where(time == 0.5, -1.0, 0.0)), ("cut", 0.2), ("cut twice as fine", 0.0))
    ]
    (row,) = long_segment.start_up_differences(pd.concat(frames)).to_dict("records")
    assert row["long_difference_percent"] == pytest.approx(10.0)
    assert row["long_mean_difference_percent"] == pytest.approx(10 / 101)
    assert row["cut_difference_percent"] == pytest.approx(2.0)


def test_changes_are_against_the_stiffest_wall_of_the_same_operation():
    rows = pd.DataFrame(
        {
            "stiffness_N_per_m": [1e6, 1e10] * 2,
            "operation": ["trip_in"] * 2 + ["trip_out"] * 2,
            "bit_depth_m": 2450.0,
            "hookload_kN": [99.0, 100.0, 202.0, 200.0],
            "torque_kN_m": [1e-13, 0.0, 2.0, 1.0],
            "contact_force_kN": [1.0, 2.0, 3.0, 3.0],
            "bending_moment_kN_m": [1.0, 1.0, 1.0, 1.0],
        }
    )
    found = rock_stiffness.changes(rows)
    assert found["hookload_change_percent"].to_list() == pytest.approx([-1.0, 0.0, 1.0, 0.0])
    assert np.isnan(found["torque_change_percent"].iloc[0])
    assert found["torque_change_percent"].iloc[2] == pytest.approx(100.0)
    assert found["contact_force_change_percent"].to_list() == pytest.approx([-50.0, 0.0, 0.0, 0.0])


def test_pressures_on_ends_and_shoulders_carry_the_displaced_mud():
    case = load("paper_well")
    steel = np.pi / 4 * (200 * (0.158**2 - 0.065**2) + 1500 * (0.102**2 - 0.060**2))
    assert mud_effects.displaced(case, 0.0) == pytest.approx(9.80665 * 7850 * steel)
    assert mud_effects.displaced(case, 1200.0) == pytest.approx(9.80665 * (7850 - 1200) * steel)


def test_resistance_in_a_narrow_annulus_is_that_of_a_flat_gap():
    """But for its curvature, 2R²/(r + R)r."""
    radius, gap, viscosity = 0.1, 2.1e-3, 0.03
    turning = mud_effects.resistance(radius, radius + gap, viscosity)
    around, curved = 2 * np.pi * radius, 2 * (radius + gap) ** 2 / (2 * radius + gap) / radius
    assert turning == pytest.approx(viscosity * around / gap * radius**2 * curved, rel=1e-12)


def test_the_mud_of_a_case_resists_as_much_as_its_parts_do():
    keys, (_, turning) = mud_effects.damping_of(0.03)
    hole = 0.5 * 0.2159
    pipe, collar = mud_effects.resistance(0.051, hole, 0.03), mud_effects.resistance(0.079, hole, 0.03)
    assert turning == pytest.approx(2250 * pipe + 200 * collar)
    assert keys["mud__rotational_damping"] * mud_effects.BIT == pytest.approx(turning)


def test_mud_adds_to_the_soft_string_s_torque_what_it_adds_to_the_stiff_one_s():
    """They differ by as much as the torques without mud do."""
    thick = mud_effects.damped(None).iloc[-1]
    assert thick["torque_change_soft_percent"] == pytest.approx(thick["torque_change_percent"], rel=0.01)


def test_the_first_mode_of_even_damping_and_inertia_dies_at_half_their_ratio():
    case = load("paper_well")
    pipe = case.string.components[1]
    even = case.model_copy(
        update={
            "string": case.string.model_copy(
                update={"components": (pipe.model_copy(update={"length": 200.0}), *case.string.components[1:])}
            )
        }
    )
    inertia = 0.5 * pipe.density * np.pi * (0.051**2 - 0.030**2) * (0.051**2 + 0.030**2)
    assert mud_effects.mode_rate(even, 2.0) == pytest.approx(2.0 / mud_effects.BIT / (2 * inertia))


def test_a_decaying_swing_has_its_rate():
    time = np.arange(0.0, 150.0, 0.1)
    torque = 2400 + 1500 * np.exp(-0.012 * time) * np.sin(2 * np.pi * 0.233 * time)
    rate = mud_effects.decay_rate(pd.DataFrame({"time_s": time, "surface_torque_N_m": torque}))
    assert rate == pytest.approx(0.012, rel=0.03)


def test_a_swing_about_a_trend_has_its_size_and_frequency():
    time = np.arange(0.0, 80.0, cylinder_ringing.RECORD)
    about = cylinder_ringing.swing(800 - 0.3 * time + 15 * np.sin(2 * np.pi * 0.49 * time), cylinder_ringing.RECORD)
    about = about[np.isfinite(about)]
    assert np.abs(about).max() == pytest.approx(15, rel=0.05)
    assert cylinder_ringing.dominant(about, cylinder_ringing.RECORD) == pytest.approx(0.49, rel=0.01)


def test_segments_in_a_bend_are_an_eighth_of_what_fits_it():
    severity, clearance = 30.0, 0.02
    radius = 30.48 / np.radians(severity)
    assert soft_stiff_map.segment(severity, clearance) == pytest.approx(4 * np.sqrt(radius * clearance) / 8)
    assert soft_stiff_map.segment(60.0, 1e-4) == 0.2
    assert soft_stiff_map.segment(1.0, 0.1) == 1.0


def test_a_mapped_bend_has_its_severity_and_clearance():
    case = soft_stiff_map.case_of("6 3/4 in collar", 20.0, 0.01, soft_stiff_map.LIGHT)
    md, inclination, _ = case.wellbore.trajectory.T
    assert 30.48 * np.degrees(inclination[2] - inclination[1]) / (md[2] - md[1]) == pytest.approx(20.0)
    assert case.wellbore.intervals[0].diameter - case.string.components[0].contact_diameter == pytest.approx(0.02)
    assert case.operations[0].end_md == pytest.approx(md[-1])


def test_a_bend_is_as_far_off_as_the_worst_of_its_operations():
    rows = pd.DataFrame(
        {
            "string": ["pipe"] * 3 + ["collar"],
            "hold_m": 600.0,
            "severity_deg_per_100ft": [30.0, 30.0, 10.0, 30.0],
            "clearance_mm": 5.0,
            "hookload_percent": [-4.0, 1.0, 2.0, 0.5],
            "torque_percent": [np.nan, 3.0, np.nan, -9.0],
        }
    )
    assert soft_stiff_map.largest(rows).to_list() == [4.0, 2.0, 9.0]
    assert soft_stiff_map.largest(rows, "severity >= 30 and string == 'pipe'").to_list() == [4.0]


def test_the_bends_that_decide_are_those_of_the_least_and_the_largest_number():
    columns = ["string", "hold_m", "severity_deg_per_100ft", "clearance_mm", "hookload_percent", "torque_percent"]
    pipe, collar = soft_stiff_map.STRINGS
    rows = [
        (pipe, 600.0, 30.0, 5.0, -4.0, 9.0),
        (pipe, 25.0, 30.0, 50.0, -1.0, 0.5),
        (collar, 600.0, 60.0, 5.0, 2.0, -20.0),
        (collar, 25.0, 20.0, 5.0, 3.0, 77.0),
        (collar, 600.0, 20.0, 5.0, 1.0, 6.0),
        (collar, 600.0, 10.0, 50.0, -8.0, 5.0),
        (pipe, 600.0, 20.0, 50.0, 1.0, 10.0),
    ]
    found = list(soft_stiff_map.deciding(pd.DataFrame(rows, columns=columns)).values())
    assert found[:3] == [
        (pipe, 30.0, 0.05, soft_stiff_map.LIGHT),
        (collar, 20.0, 0.005, soft_stiff_map.LIGHT),
        (collar, 10.0, 0.05, soft_stiff_map.HEAVY),
    ]


def test_a_ratio_to_zero_is_nan():
    assert friction_laws.ratio_of(4.5, 1.5) == 3.0
    assert np.isnan(friction_laws.ratio_of(0.0, 1e-13))


def test_the_papers_runs_as_speeds():
    runs = paper_times.implied().set_index("paper_run")
    whole = runs.loc["FCTD, the whole survey depth, 0 to 2250 m"]
    assert whole["real_time_up_to_m_s"] == pytest.approx(2250 / 14400)
    assert whole["real_time_factor_at_half_a_metre_a_second"] == pytest.approx(4500 / 14400)
    assert runs.loc["Adams, the same", "took_per_m_s"] == pytest.approx(0.08)


def test_the_exact_well_is_smooth_and_as_long_as_its_measured_depth():
    md = np.linspace(0.0, 4300.0, 86_001)
    step = np.diff(profile.exact(md), axis=0)
    assert np.linalg.norm(step, axis=1) == pytest.approx(0.05, rel=1e-6)
    cosine = np.sum(step[1:] * step[:-1], axis=1) / 0.05**2
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 0.01
    assert profile.exact(np.array([2000.0]))[0, :2] == pytest.approx([43.790401] * 2, abs=1e-5)


def test_the_well_summed_up_is_the_closed_form():
    md = np.array([1750.0, 2000.0, 2250.0, 2450.0, 4300.0])
    assert profile.integrated(md) == pytest.approx(profile.exact(md), abs=1e-6)


def test_the_average_angle_s_second_route_finds_as_much():
    rows = profile.run(Context(quick=True)).tables["methods"]
    average = rows[rows["method"] == "average angle"]
    assert average["off_integrated_m"].to_numpy() == pytest.approx(average["off_m"].to_numpy(), rel=1e-6)
    # One build of 58°: its chord is longer than the arc's by half of the angle over its sine.
    assert average["off_m"].iloc[1] > 500 * (1 - np.sinc(29 / 180))


def test_a_connection_of_two_minutes_makes_the_papers_trip_real_time():
    """2250 m in 4 h, stands of 28 m run at half a metre a second."""
    assert 2250 / 28 * (56 + paper_times.connection(14400 / 2250)) == pytest.approx(14400)


def test_points_of_a_straight_well_lie_where_they_were_made(monkeypatch):
    monkeypatch.setattr(ownership, "WELLS", {name: ownership.WELLS[name] for name in ("build to 60°", "build to 120°")})
    gentle, turned_back = ownership.run(Context(quick=True)).tables["owners"].to_dict("records")
    assert gentle["elsewhere_percent"] == gentle["wrong_owner_percent"] == 0
    assert turned_back["elsewhere_percent"] == pytest.approx(turned_back["wrong_owner_percent"], abs=0.2)
    assert turned_back["elsewhere_percent"] > 10


def test_a_library_is_timed_without_the_cost_of_the_call(monkeypatch):
    """Invented times; the cost of a mesh is divided by that of the paper's search and test."""
    ns = {contact_operations.ONE: 2.0, contact_operations.SEARCH: 98.0, contact_operations.ASKING: 150.0}
    ns |= {contact_operations.TREE: 300.0, contact_operations.LIBRARY: 650.0}

    def told(actions, counts, rounds):
        for action in actions.values():
            action()
        assert counts[contact_operations.ONE] == counts[contact_operations.TREE] == 100 * run.segments
        return {name: np.full(rounds, ns[name]) for name in actions}

    monkeypatch.setattr(contact_operations, "in_rounds", told)
    run, _ = prepare(load("scaled_section"))
    found = contact_operations.times(run, True, 1).set_index("what")
    assert found["over_one_cylinder"].to_dict() == pytest.approx(
        {contact_operations.ONE: 1.0, contact_operations.SEARCH: 49.0, contact_operations.TREE: 150.0}
        | ({contact_operations.LIBRARY: 250.0} if contact_operations.LIBRARY in found.index else {})
    )
    assert found.loc[contact_operations.TREE, "over_search_and_test"] == pytest.approx(3.0)


def test_the_test_of_one_cylinder_is_the_papers_and_finds_the_distance_from_its_axis():
    run, _ = prepare(load("paper_well", operations=rotation(2000.0, 1.0, 0.5)))
    points = contact_operations.spheres(run)[0] + np.array([0.03, -0.02, 0.0])
    owners, pieces = run.hole.owners(points), run.hole.pieces
    away = points - pieces[owners, START : START + 3]
    axes = pieces[owners, DIRECTION : DIRECTION + 3]
    across = away - np.sum(away * axes, axis=1)[:, None] * axes
    assert one_cylinder(pieces, points, owners) == pytest.approx(np.sum(across**2, axis=1), abs=1e-7)
    assert np.isinf(one_cylinder(pieces, points, np.zeros_like(owners))[-1])


def test_a_long_segment_twists_otherwise_than_the_pipe_it_represents(monkeypatch):
    assert 10 < long_segment.twisting((2.0,))[2.0] < 13
    monkeypatch.setattr(long_segment, "WATCHED", 1.0)
    monkeypatch.setattr(long_segment, "the_case", lambda vertical, the_case=long_segment.the_case: the_case(37.5))
    assert long_segment.twisting((2.0,)) == {2.0: 0.0}


def test_finite_elements_are_compared_with_the_soft_string_and_the_segments():
    bend = soft_stiff_map.PIPE, 60.0, 0.02, soft_stiff_map.LIGHT
    row = soft_stiff_map.by_finite_elements(*bend, 4)
    assert row["segments_off_percent"] < 1.0
    stiff = pd.DataFrame(soft_stiff_map.compare(*bend)).set_index("operation")
    assert row["hookload_percent"] == pytest.approx(stiff.loc["trip_in", "hookload_percent"], abs=1.0)
    assert row["torque_percent"] == pytest.approx(stiff.loc["rotate_off_bottom", "torque_percent"], rel=0.02)
    assert row["largest_percent"] == max(abs(row["hookload_percent"]), abs(row["torque_percent"]))


def test_the_naive_model_at_its_own_size_is_a_thousandth_of_the_chain():
    model, chain = engines_agree.small(), load("curved_chain")
    assert model.string.components[0].outer_diameter == pytest.approx(chain.string.components[0].outer_diameter / 1e3)
    assert model.string.components[0].youngs_modulus == chain.string.components[0].youngs_modulus
    assert model.operations[0].start_md == pytest.approx(engines_agree.BIT / 1e3)
    # By similarity: what a stiff wall of the whole chain would be.
    assert model.wellbore.stiffness == pytest.approx(1e4)


def test_the_stepper_s_moments_are_compared_with_its_own_largest_count():
    found = segment_count.step_through("4.5°/30 m", (5, 10)).set_index("segments")
    assert found.loc[10, ["torque_off_largest_percent", "moment_off_largest_percent"]].to_list() == [0, 0]
    assert segment_count.moment_error(np.array([1.0, 2.0]), np.array([3.0, 4.0])) == pytest.approx(100 * 2 / 12.5**0.5)
    few, many = found["torque_kN_m"]
    assert found.loc[5, "torque_off_largest_percent"] == pytest.approx(100 * abs(few / many - 1))
    assert 5 < found.loc[5, "moment_off_largest_percent"] < 200


def test_the_papers_equations_give_the_wall_and_cost_what_it_says():
    a, t = np.array([1.0, 2.0, 3.0]), np.array([1.3, 2.4, 4.0])
    ab = np.array([0.0, 0.0, 2.0])
    at = contact_operations.paper_arm(a, t)
    away = contact_operations.paper_location(ab, 4.0, at)
    assert away == pytest.approx(0.25)
    assert contact_operations.paper_penetration(away, 0.45) == pytest.approx(0.05)
    assert contact_operations.paper_direction(a, ab, 4.0, ab @ at, t, 0.5) == pytest.approx([0.6, 0.8, 0.0])
    assert contact_operations.paper_location(ab, 4.0, [0.3, 0.4, 2.1]) is None
    assert contact_operations.paper_location(ab, 4.0, [0.3, 0.4, -0.1]) is None
    assert [row["arithmetic"] for row in contact_operations.paper_rows()] == [13, 3, 2, 14]


def test_in_straight_hole_coulomb_shares_one_force_and_the_paper_gives_two():
    found = friction_laws.in_straight_hole(np.array([0.5])).set_index("law")
    assert found["off_percent"].max() < 0.1
    assert found.loc["paper", "friction_over_mu_N"] == pytest.approx(np.sqrt(2))
    assert found.loc["coulomb", "friction_over_mu_N"] == pytest.approx(1.0)
    arm = found["torque_kN_m"] / found["drag_kN"]
    assert arm["coulomb"] == pytest.approx(2 * arm["paper"], rel=1e-3)


@pytest.mark.parametrize("power", [0.0, 1.0, 2.0])
def test_a_slope_is_the_power(power: float) -> None:
    step = np.array([1e-3, 5e-4, 1.25e-4])
    assert log_slope(step, 7 * step**power) == pytest.approx(power)


@pytest.mark.parametrize("segments", [60, 170])
def test_the_well_of_the_engines_has_the_segments_that_it_is_named_after(segments: int) -> None:
    """Collars and pipe together; the long segment above is one more."""
    collars, pipe, _ = engines_agree.well(segments, Window(44.0, 2.0)).string.components
    assert collars.segments + pipe.segments == segments


@pytest.mark.parametrize("kind", ["trip_in", "trip_out"])
def test_a_steady_trip_passes_its_depth_in_the_middle_of_what_is_read(kind: str) -> None:
    (trip,) = load("paper_well", operations=steady_trip(kind, 2000.0)).operations
    assert trip.kind == kind
    half = 0.5 * TRIP_WINDOW * TRIP_SPEED
    assert trip.end_md == 2000.0 + (half if kind == "trip_in" else -half)
    # What is left before the window is more than the ramp takes.
    assert abs(trip.start_md - 2000.0) - half > 0.5 * trip.ramp_time * TRIP_SPEED


def test_a_swing_hardly_changes_a_mean() -> None:
    time = np.linspace(0, 1, 400)
    rows = pd.DataFrame({"time_s": time, "load": 5 + np.cos(6.5 * np.pi * time), "operation": "trip_in"})
    assert abs(rows["load"].mean() - 5) > 0.03
    assert hann_means(rows)["load"] == pytest.approx(5, abs=0.01)
