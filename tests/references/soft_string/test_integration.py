"""The two methods of the soft string agree in any hole, with hand calculations and with published numbers."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import equilibrium
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model import survey
from fctd.model.drillstring import lay_out
from fctd.model.section import section_of
from fctd.model.string_in_hole import check_fit
from fctd.model.wellbore import build_wellbore
from references.soft_string.integration import SoftString, soft_string, soft_string_ode
from tests.cases import make_case, pipe, trip
from validation.cases import load

# Arguments that an operation needs besides its name.
MOTIONS: dict[str, dict[str, float]] = {
    "trip_in": {},
    "trip_out": {},
    "rotate_off_bottom": {},
    "back_ream": {"speed": 0.3, "rpm": 60.0},
    "drill_rotating": {"speed": 0.01, "rpm": 120.0},
    "drill_sliding": {},
}
# Builds, turns both ways through north, drops, and builds past 90 deg.
SPATIAL = [[0, 5, 350], [400, 30, 20], [800, 60, 340], [1200, 40, 10], [1700, 95, 60]]


def well(stations: list[list[float]], law: str = "coulomb", top_md: float = 0.0, **more: Any) -> Case:
    """A case of two pipes in two hole intervals, with loads at the bit."""
    end = stations[-1][0]
    hole = {
        "intervals": [
            {"to_md": 0.4 * end, "diameter": 0.3, "friction": 0.15},
            {"to_md": end, "diameter": 0.2159, "friction": 0.3},
        ],
        **more,
    }
    components = [
        pipe(0.3 * end, None, segment_length=20.0, contact_diameter=0.17),
        pipe(None, None, outer=0.1, segment_length=20.0),
    ]
    return make_case(
        stations, components, top_md=top_md, wellbore=hole, contact={"friction_law": law}, mud={"density": 1300.0},
        bit={"weight_on_bit": "40 kN", "torque": "2 kN*m"},
    )  # fmt: skip


def scaled_difference(a: SoftString, b: SoftString) -> float:
    """Largest difference of the three sums, forces over the largest force, torque over it or over 1 cm times force."""
    force = max(abs(b.hookload), b.total_contact_force, 1.0)
    return max(
        abs(a.hookload - b.hookload) / force,
        abs(a.total_contact_force - b.total_contact_force) / force,
        abs(a.surface_torque - b.surface_torque) / max(b.surface_torque, 0.01 * force),
    )


@pytest.mark.slow
@pytest.mark.parametrize("survey_method", ["minimum_curvature", "average_angle"])
@pytest.mark.parametrize("operation", MOTIONS)
def test_the_recursion_converges_to_the_differential_form_at_second_order(operation: str, survey_method: str) -> None:
    case = well(SPATIAL, survey_method=survey_method)
    exact = soft_string_ode(case, operation, 1690.0, **MOTIONS[operation])
    elements = np.array([40.0, 20.0, 10.0, 5.0, 2.5])
    sums = [soft_string(case, operation, 1690.0, element=e, **MOTIONS[operation])[:3] for e in elements]
    errors = np.abs(np.array(sums) - exact[:3])
    for column in errors.T:
        if column.max() > 0:
            order = np.polyfit(np.log(elements), np.log(column), 1)[0]
            assert order == pytest.approx(2.0, abs=0.05)
            assert column[-1] < column[0] / 150


@pytest.mark.parametrize("operation", MOTIONS)
def test_profiles_agree_and_end_at_bit_and_surface(operation: str) -> None:
    case = well(SPATIAL)
    a = soft_string(case, operation, 1650.5, **MOTIONS[operation])
    b = soft_string_ode(case, operation, 1650.5, **MOTIONS[operation])
    np.testing.assert_allclose(a.profile.md, b.profile.md)
    assert np.all(np.diff(a.profile.md) > 0)
    np.testing.assert_allclose(a.profile.tension, b.profile.tension, rtol=0, atol=1e-5 * np.ptp(b.profile.tension))
    np.testing.assert_allclose(a.profile.torque, b.profile.torque, rtol=0, atol=1e-5 * max(b.surface_torque, 1))
    np.testing.assert_allclose(
        a.profile.side_force, b.profile.side_force, rtol=0, atol=1e-4 * b.profile.side_force.max()
    )
    weight = case.bit.weight_on_bit if operation.startswith("drill") else 0.0
    # Half an element from the ends of 350 N/m of pipe at most.
    assert b.profile.tension[-1] == pytest.approx(-weight, abs=350.0)
    assert b.profile.tension[0] == pytest.approx(b.hookload, abs=350.0)
    assert b.profile.torque[0] == pytest.approx(b.surface_torque, rel=1e-3)
    # Elements between breaks, none longer than a metre: the side force sums up to the contact force.
    edges = np.append(0.0, 0.5 * (a.profile.md[1:] + a.profile.md[:-1]))
    lengths = np.diff(np.append(edges, 1650.5))
    assert np.sum(b.profile.side_force * lengths) == pytest.approx(b.total_contact_force, rel=2e-3)


@pytest.mark.parametrize(("operation", "pull"), [("trip_out", 1.0), ("trip_in", -1.0), ("rotate_off_bottom", 0.0)])
def test_the_formulas_as_published_by_johancsik(operation: str, pull: float) -> None:
    """Inclination θ and azimuth α in place of vectors: F² = (T Δα sin θ)² + (T Δθ + w Δs sin θ)², T at the lower end
    and Δ counted upwards; first order in Δs, hence the small elements."""
    case = make_case(
        SPATIAL, [pipe(None, None, segment_length=20.0)], contact={"friction_law": "paper"},
        wellbore={"survey_method": "average_angle",
                  "intervals": [{"to_md": 1700, "diameter": 0.3, "friction": 0.3}]},
    )  # fmt: skip
    weight = float(lay_out(case, 1700.0).weight[0])
    md = np.linspace(0, 1700, 34001)
    _, inc, azi = survey.interpolate_angles(case.wellbore.trajectory, md).T
    tension = torque = 0.0
    for k in range(len(md) - 2, -1, -1):
        middle, step = 0.5 * (inc[k] + inc[k + 1]), md[k + 1] - md[k]
        across = tension * (inc[k] - inc[k + 1]) + weight * step * np.sin(middle)
        side = np.hypot(tension * (azi[k] - azi[k + 1]) * np.sin(middle), across)
        tension += weight * step * np.cos(middle) + pull * 0.3 * side
        torque += (pull == 0) * 0.3 * 0.0635 * side
    answer = soft_string_ode(case, operation, 1700.0)
    assert answer.hookload == pytest.approx(tension, rel=2e-4)
    assert answer.surface_torque == pytest.approx(torque, rel=2e-4)


@pytest.mark.parametrize("survey_method", ["minimum_curvature", "average_angle"])
@pytest.mark.parametrize("summation", [soft_string, soft_string_ode])
def test_loads_do_not_depend_on_azimuths_that_pass_north(summation: Any, survey_method: str) -> None:
    """The same well turned by 123 deg, so that no azimuth passes north, has the same loads."""
    turned = [[md, inc, (azi + 123) % 360] for md, inc, azi in SPATIAL]
    assert max(np.abs(np.diff(np.array(turned)[:, 2]))) < 180 < max(np.abs(np.diff(np.array(SPATIAL)[:, 2])))
    answers = [summation(well(s, survey_method=survey_method), "trip_out", 1700.0) for s in (SPATIAL, turned)]
    assert answers[0][:3] == pytest.approx(answers[1][:3], rel=1e-9)


@st.composite
def holes(draw: st.DrawFn) -> dict[str, Any]:
    """Two to five courses up to 120 deg inclination and any azimuth, bends of at most 0.4 deg/m or so."""
    stations = [[0.0, draw(st.floats(0, 60)), draw(st.floats(0, 360))]]
    for _ in range(draw(st.integers(2, 5))):
        length = draw(st.floats(150, 500))
        _, inc, azi = stations[-1]
        stations.append([
            stations[-1][0] + length,
            min(max(inc + draw(st.floats(-40, 40)), 0.0), 120.0),
            (azi + draw(st.floats(-60, 60))) % 360,
        ])  # fmt: skip
    return {
        "stations": stations,
        "law": draw(st.sampled_from(["coulomb", "paper"])),
        "survey_method": draw(st.sampled_from(["minimum_curvature", "average_angle"])),
    }


@pytest.mark.slow
@settings(max_examples=25)
@given(holes(), st.floats(0.3, 1.0), st.floats(0.0, 0.2))
def test_hook_load_rotating_in_place_is_the_weight_over_the_vertical_depth(
    hole: dict[str, Any], part: float, top: float
) -> None:
    """Friction then has no axial component: Σ w ΔTVD of the two pipes, for any contact."""
    end = hole["stations"][-1][0]
    case = well(**hole | {"survey_method": "minimum_curvature"}, top_md=top * end)
    depth = part * end
    joint = max(depth - 0.3 * end, top * end)
    courses = survey.minimum_curvature(case.wellbore.trajectory)
    down = survey.along_courses(courses, np.array([top * end, joint, depth]))[0][:, 2]
    below, above = (section_of(component, 1300.0).weight for component in case.string.components)
    expected = above * (down[1] - down[0]) + below * (down[2] - down[1])
    scale = above * end
    assert soft_string_ode(case, "rotate_off_bottom", depth).hookload == pytest.approx(expected, abs=1e-9 * scale)
    assert soft_string(case, "rotate_off_bottom", depth).hookload == pytest.approx(expected, abs=1e-5 * scale)


@pytest.mark.slow
@settings(max_examples=25)
@given(holes(), st.sampled_from(list(MOTIONS)), st.floats(0.5, 1.0))
def test_in_any_hole_both_summations_agree(hole: dict[str, Any], operation: str, part: float) -> None:
    case = well(**hole)
    depth = part * hole["stations"][-1][0]
    a = soft_string(case, operation, depth, **MOTIONS[operation])
    b = soft_string_ode(case, operation, depth, **MOTIONS[operation])
    # An element in which the wall force changes side has an error of its share of the load, so that the error has no
    # order but a bound for each element length.
    assert scaled_difference(a, b) < 5e-5
    half = soft_string(case, operation, depth, element=0.5, **MOTIONS[operation])
    assert scaled_difference(half, b) < 1e-5


def test_rotation_reduces_drag_only_with_law_coulomb() -> None:
    """Faster rotation reduces drag towards zero with law ``coulomb``, and does not change it with ``paper``."""
    stations = [[0, 0, 0], [500, 60, 0], [1500, 60, 0]]
    for law, falls in (("coulomb", True), ("paper", False)):
        case = well(stations, law)
        still = soft_string(case, "rotate_off_bottom", 1500.0).hookload
        drags = [
            soft_string(case, "back_ream", 1500.0, speed=0.2, rpm=rpm).hookload - still for rpm in (1, 60, 200, 1e5)
        ]
        sliding = soft_string(case, "trip_out", 1500.0).hookload - still
        if falls:
            assert sliding > drags[0] > drags[1] > drags[2] > drags[3] > 0
            assert drags[3] < 1e-3 * sliding
        else:
            assert drags == pytest.approx([sliding] * 4)


def test_bit_loads_pass_to_the_surface() -> None:
    """Straight down: hook load is weight less WOB, torque the bit's; off bottom the bit has neither."""
    case = well([[0, 0, 0], [1000, 0, 0]])
    weight = soft_string(case, "rotate_off_bottom", 1000.0).hookload
    for operation in ("drill_rotating", "drill_sliding"):
        answer = soft_string_ode(case, operation, 1000.0, **MOTIONS[operation])
        assert answer[:3] == pytest.approx((weight - 40e3, 2e3, 0.0), abs=1e-3)


@pytest.mark.parametrize("summation", [soft_string, soft_string_ode])
def test_friction_follows_the_hole_and_weight_and_radius_follow_the_pipe(summation: Any) -> None:
    """Slant at 60 deg, by hand: shoe at 400 m, joint of the pipes at 630 m with the bit at 930 m of 1000 m."""
    case = well([[0, 60, 0], [1000, 60, 0]], "paper")
    pipe_below, pipe_above = (section_of(component, 1300.0) for component in case.string.components)
    # metres, pipe, friction: from the bit upwards
    parts = [(300, pipe_below, 0.3), (230, pipe_above, 0.3), (400, pipe_above, 0.15)]
    across = np.sin(np.pi / 3)
    weight = sum(length * part.weight * 0.5 for length, part, _ in parts)
    drag = sum(length * part.weight * across * factor for length, part, factor in parts)
    arm = sum(length * part.weight * across * factor * part.contact_radius for length, part, factor in parts)
    assert pipe_below.contact_radius == 0.085
    expected = {
        "trip_out": (weight + drag, 0.0),
        "trip_in": (weight - drag, 0.0),
        "rotate_off_bottom": (weight, arm),
        "back_ream": (weight + drag, arm),
        "drill_rotating": (weight - drag - 40e3, arm + 2e3),
        "drill_sliding": (weight - drag - 40e3, 2e3),
    }
    for operation, loads in expected.items():
        assert summation(case, operation, 930.0, **MOTIONS[operation])[:2] == pytest.approx(loads, rel=1e-9)


def test_speed_and_rpm_come_from_the_arguments_or_from_the_case() -> None:
    stations = [[0, 0, 0], [500, 60, 0], [1500, 60, 0]]
    raw = well(stations).model_dump()
    planned = {"kind": "back_ream", "from_md": 1400.0, "to_md": 1300.0, "speed": 0.2, "rpm": 90.0}
    case = Case.model_validate(raw | {"operations": [planned]})
    assert soft_string(case, "back_ream", 1400.0)[:3] == soft_string(case, "back_ream", 1400.0, speed=0.2, rpm=90)[:3]
    assert soft_string(case, "back_ream", 1400.0, rpm=10).hookload > soft_string(case, "back_ream", 1400.0).hookload
    turning = Case.model_validate(raw | {"operations": [trip(1300, 1400) | {"rpm": 30.0}]})
    assert soft_string(turning, "trip_in", 1400.0).surface_torque > 0
    assert soft_string(turning, "trip_in", 1400.0, rpm=0).surface_torque == 0


WRONG: list[tuple[str, float, dict[str, float], str, str]] = [
    ("trip_inn", 900, {}, "operation", "the operation trip_in"),
    ("trip_in", 1001, {}, "bit_depth", "within survey and intervals, 1000 m"),
    ("trip_in", float("nan"), {}, "bit_depth", "within survey"),
    ("trip_in", 0, {}, "string.top_md", "less than the bit depth"),
    ("trip_in", 900, {"speed": 0.0}, "speed", "above 0"),
    ("trip_in", 900, {"rpm": -1.0}, "rpm", "at least 0"),
    ("trip_in", 900, {"rpm": 10.0}, "speed", "above 0, as an argument or in an operation"),
    ("rotate_off_bottom", 900, {"speed": 0.1}, "speed", "0 for this operation"),
    ("rotate_off_bottom", 900, {"rpm": 0.0}, "rpm", "above 0"),
    ("back_ream", 900, {"rpm": 60.0}, "speed", "above 0"),
    ("back_ream", 900, {"speed": 0.1}, "rpm", "above 0"),
    ("drill_sliding", 900, {"rpm": 10.0}, "rpm", "0 for this operation"),
    ("drill_rotating", 900, {"speed": float("inf"), "rpm": 60.0}, "speed", "above 0"),
    ("trip_in", 900, {"element": 0.0}, "element", "a length above 0"),
]


@pytest.mark.parametrize(("operation", "depth", "more", "key", "expected"), WRONG)
def test_wrong_arguments_are_named(
    operation: str, depth: float, more: dict[str, float], key: str, expected: str
) -> None:
    with pytest.raises(InputError, match=expected) as refusal:
        soft_string(make_case(), operation, depth, **more)
    assert refusal.value.key == key


def test_stations_that_no_arc_joins_are_refused() -> None:
    with pytest.raises(InputError, match="a circular arc can join"):
        soft_string_ode(make_case([[0, 90, 0], [500, 90, 180]]), "trip_in", 400.0)


def test_johancsiks_third_example() -> None:
    """Regression against published numbers (Johancsik, Friesen & Dawson 1984, example 3), within 0.5 %."""
    case = load("johancsik3")
    published = {"trip_out": 1462e3, "trip_in": 594e3, "rotate_off_bottom": 930e3}
    for summation in (soft_string, soft_string_ode):
        for operation, hookload in published.items():
            assert summation(case, operation, 3718.0).hookload == pytest.approx(hookload, rel=0.005)
        assert summation(case, "rotate_off_bottom", 3718.0).surface_torque == pytest.approx(35.2e3, rel=0.005)


def test_other_readings_of_johancsiks_third_example_miss_the_published_numbers() -> None:
    """The numbers in the comments of the case file for other readings of the example."""
    buoyed = load("johancsik3", mud__density=0.0)
    assert soft_string_ode(buoyed, "rotate_off_bottom", 3718.0).hookload == pytest.approx(1094e3, rel=5e-4)
    climbing = load("johancsik3", contact__friction_law="coulomb")
    assert soft_string_ode(climbing, "rotate_off_bottom", 3718.0).surface_torque == pytest.approx(32.8e3, rel=1e-3)
    thick = load("johancsik3", string__components__0__outer_diameter="8 in")
    assert soft_string_ode(thick, "rotate_off_bottom", 3718.0).surface_torque == pytest.approx(36.3e3, rel=2e-3)


def test_johancsiks_third_example_is_a_case_for_the_stiff_engine() -> None:
    """The string fits its hole, in segments of about 10 m, and has the published weight."""
    case = load("johancsik3")
    string = lay_out(case, 3718.0)
    check_fit(string, build_wellbore(case), 3718.0)
    assert 5 < string.length.min() <= string.length.max() < 15
    pounds = float(np.sum(string.of("mass") * string.length)) / 0.45359237
    pipe_feet = 3718 / 0.3048 - 372 - 840
    assert pounds == pytest.approx(372 * 146.9 + 840 * 46.9 + 20 * pipe_feet, rel=1e-6)


@pytest.mark.parametrize("operation", ["trip_out", "trip_in"])
def test_fluids_by_depth_are_those_of_the_engine(operation: str) -> None:
    """A floated string with a plug in the bend: the soft string weighs its pieces, the engine its segments."""
    mud = {"density": 1200.0, "inside": [{"to_md": 701.0, "density": 1200.0, "plug": True}, {"density": 0}],
           "float": True}  # fmt: skip
    hole = {"intervals": [{"to_md": 1500.0, "diameter": 0.3111, "friction": 0.3}], "geometry": "arcs"}
    part = pipe(None, None, outer=0.244475, inner=0.2204974, contact_diameter=0.3, segment_length=5.0)
    case = make_case([[0, 0, 0], [300, 0, 0], [900, 70, 0], [1500, 70, 0]], [part], wellbore=hole, mud=mud)
    string = lay_out(case, 1500.0)
    point, soft = equilibrium(case, operation, 1500.0), soft_string(case, operation, 1500.0)
    assert point.hookload == pytest.approx(soft.hookload, abs=2e-3 * float(string.weight @ string.length))
    assert soft.hookload == pytest.approx(soft_string_ode(case, operation, 1500.0).hookload, rel=1e-6)


@pytest.mark.parametrize("key", ["centralisers", "swivel"])
def test_fittings_and_swivels_are_refused(key: str) -> None:
    given = {"centralisers": {"every": 12.0, "diameter": 0.2}, "swivel": True}[key]
    lower = pipe(300.0, None, **{key: given}) if key == "centralisers" else pipe(300.0, 10, swivel=True)
    with pytest.raises(InputError, match="none, for the soft string") as refusal:
        soft_string(make_case(components=[lower, pipe(None, None, segment_length=20.0)]), "trip_in", 900.0)
    assert refusal.value.key == f"string.components[0].{key}"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("every", "off", "torque", "pick_up"), [(30, 0.0, -0.7, -0.2), (30, 1.0, -12, -3.6), (10, 0.5, -29, -9.9)]
)
def test_wiggles_cost_a_soft_string_torque_that_a_stiff_one_with_clearance_lacks(
    every: int, off: float, torque: float, pick_up: float
) -> None:
    """The shares that docs/calibrate.md states, in percent; seeds differ by a tenth of them."""
    md = np.arange(0.0, 3451.0, every)
    azimuth = 40 + off * np.random.default_rng(9200002).standard_normal(len(md))
    stations = np.column_stack((md, np.interp(md, [300, 900], [0, 30]), azimuth)).tolist()
    collar = pipe(150, None, 0.165, 0.071, contact_diameter=0.1683)
    string = [collar, pipe(None, None, 0.127, 0.1086, contact_diameter=0.1683, linear_mass=32.0)]
    hole = {"intervals": [{"to_md": 3450.0, "diameter": 0.2159, "friction": 0.25}], "geometry": "arcs",
            "survey_method": "minimum_curvature", "stiffness_per_length": 2e7}  # fmt: skip
    case = make_case(stations, string, mud={"density": 1200.0}, wellbore=hole)
    turning, out = (equilibrium(case, kind, 3450.0) for kind in ("rotate_off_bottom", "trip_out"))
    soft = soft_string(case, "rotate_off_bottom", 3450.0, rpm=60.0)
    assert 100 * (turning.surface_torque / soft.surface_torque - 1) == pytest.approx(torque, rel=0.15, abs=0.1)
    share = out.hookload / soft_string(case, "trip_out", 3450.0).hookload - 1
    assert 100 * share == pytest.approx(pick_up, rel=0.15, abs=0.1)
