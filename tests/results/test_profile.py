"""Stress and buckling limits of a profile, against hand calculation."""

import math

import numpy as np
import pytest

from fctd import equilibrium, simulate
from fctd.model.drillstring import lay_out
from fctd.model.frames import hole_frame
from fctd.model.wellbore import build_wellbore
from fctd.plots.facts import heading_of_profile
from fctd.results.profile import Loads, place_in_words, profile_table
from tests.cases import make_case, pipe, rotation, trip

LONG = [pipe(100, 4), pipe(None, 1)]


def test_loads_and_stress_of_a_hanging_string() -> None:
    """Vertical string in mud, turned: tension, pressure and torque by hand."""
    mud = {"density": 1200.0, "rotational_damping": 2.0}
    case = make_case([[0, 0, 0], [1000, 0, 0]], [pipe(1000, 20)], mud=mud)
    profile = equilibrium(case, "rotate_off_bottom", 1000.0, rpm=30).profile
    outer, inner = 0.0635, 0.035
    area, polar = math.pi * (outer**2 - inner**2), math.pi / 2 * (outer**4 - inner**4)
    middle = profile.iloc[10]
    tension = 500 * 9.80665 * area * (7850 - 1200)
    torque = 500 * 2.0 * math.pi
    assert middle["effective_tension_N"] == pytest.approx(tension, rel=1e-6)
    assert middle["torque_N_m"] == pytest.approx(torque, rel=1e-6)
    assert middle["true_tension_N"] == pytest.approx(tension - 1200 * 9.80665 * middle["md_m"] * area, rel=1e-6)
    stress = math.hypot(tension / area, math.sqrt(3) * torque * outer / polar)
    assert middle["von_mises_Pa"] == pytest.approx(stress, rel=1e-4)


def test_the_top_has_the_section_of_the_uppermost_pipe() -> None:
    """One segment of thicker pipe at the top: the stress there is the whole weight over its own steel."""
    case = make_case(components=[pipe(980, 20), pipe(None, 1, outer=0.14)])
    point = equilibrium(case, "rotate_off_bottom", 1000.0)
    area = math.pi * (0.07**2 - 0.035**2)
    top, first, second = (point.profile.iloc[k] for k in range(3))
    assert top["von_mises_Pa"] == pytest.approx(point.hookload / area, rel=1e-3)
    # It touches nothing; clearance is that of the segment below it.
    assert not top[["contact_force_N", "contact_angle_deg", "offset_high_m", "offset_right_m"]].any()
    assert top["clearance_m"] == first["clearance_m"] < second["clearance_m"]


def test_a_rounding_error_to_the_left_of_the_high_side_is_the_high_side() -> None:
    case = make_case([[0, 60, 0], [300, 60, 0]], [pipe(None, 3)])
    string, hole = lay_out(case, 300.0), build_wellbore(case)
    points, directions = hole.at(np.array([100.0, 200.0, 300.0]))
    high, right = hole_frame(directions)
    walls = hole.walls(points)._replace(offset=0.01 * high - 1e-19 * right)
    zeros = np.zeros(3)
    table = profile_table(hole, string, 0.0, points[0], points, walls, Loads(zeros, zeros, zeros, zeros), True)
    assert list(table["contact_angle_deg"]) == [0.0] * 4
    np.testing.assert_allclose(table["offset_high_m"][1:], 0.01)


def test_stress_and_buckling_of_a_bent_string_in_tension_and_in_compression() -> None:
    """Row by row: |T|/A + M r_o/I and the torque's shear; the limits are those of the buoyed weight."""
    mud = {"density": 1200.0}
    case = make_case(
        [[0, 0, 0], [200, 0, 0], [600, 60, 0], [900, 60, 0]], [pipe(900, 90)], mud=mud,
        bit={"weight_on_bit": 34e4, "torque": 2e3}, wellbore={"geometry": "arcs"},
    )  # fmt: skip
    point = equilibrium(case, "drill_rotating", 900.0)
    assert point.answered
    profile = point.profile
    outer, inner = 0.0635, 0.035
    area, second = math.pi * (outer**2 - inner**2), math.pi / 4 * (outer**4 - inner**4)
    tension, bending = profile["effective_tension_N"].to_numpy(), profile["bending_moment_N_m"].to_numpy()
    assert tension.max() > 0 > tension.min()
    assert (bending * outer / second)[20:60].min() > 1e7
    normal = np.abs(tension) / area + bending * outer / second
    shear = profile["torque_N_m"] * outer / (2 * second)
    np.testing.assert_allclose(profile["von_mises_Pa"], np.hypot(normal, math.sqrt(3) * shear), rtol=1e-9)
    # On the slant below the build, by hand.
    lying = profile[profile["md_m"] > 610].iloc[0]
    weight, EI = 9.80665 * area * (7850 - 1200), 206.8e9 * second
    sinusoidal = 2 * math.sqrt(EI * weight * math.sin(math.radians(60)) / ((0.2159 - 0.127) / 2))
    assert lying["sinusoidal_limit_N"] == pytest.approx(sinusoidal, rel=1e-6)
    assert lying["helical_limit_N"] == pytest.approx(math.sqrt(2) * sinusoidal, rel=1e-6)
    # In bend and slant row by row.
    inclined = profile[profile["inclination_deg"] > 1]
    modes = np.where(
        inclined["effective_tension_N"] < -inclined["helical_limit_N"],
        "helical",
        np.where(inclined["effective_tension_N"] < -inclined["sinusoidal_limit_N"], "sinusoidal", "none"),
    )
    assert list(inclined["buckling"]) == list(modes)
    assert {"sinusoidal", "none"} == set(modes)
    # The vertical part above is compressed beyond 5.55 (EI w²)^⅓ at its lower end.
    pushed = (profile["md_m"] < 200) & (tension < 0)
    assert set(profile["buckling"][pushed]) == {"helical"}
    assert tension[pushed].min() < -5.55 * (EI * weight**2) ** (1 / 3)
    assert (point.status, point.buckling.mode) == ("under_resolved", "helical")


def test_a_stabiliser_s_row_has_the_load_in_its_middle() -> None:
    """Vertical, in air: the weight below the middle of a short component, and half of the mud's torque on it."""
    components = [pipe(30, 3), pipe(2, 1, contact_diameter=0.2), pipe(None, None, segment_length=10.0)]
    case = make_case([[0, 0, 0], [200, 0, 0]], components, mud={"rotational_damping": 2.0})
    middle = equilibrium(case, "rotate_off_bottom", 192.0, rpm=30).profile.iloc[-4]
    assert middle["md_m"] == pytest.approx(161.0, abs=0.01)
    weight = 9.80665 * 7850 * math.pi / 4 * (0.127**2 - 0.07**2)
    assert middle["effective_tension_N"] == pytest.approx(31 * weight, rel=1e-6)
    assert middle["torque_N_m"] == pytest.approx(31 * 2.0 * math.pi, rel=1e-6)


def test_a_string_that_hangs_below_the_surface_in_slant_hole() -> None:
    """Without friction: the top holds w L cos I along the hole, under the mud of its own depth."""
    slant = {"intervals": [{"to_md": 900, "diameter": 0.2159, "friction": 0.0}], "geometry": "arcs"}
    case = make_case(
        [[0, 60, 200], [900, 60, 200]], [pipe(None, None, segment_length=10.0)], top_md=500.0, wellbore=slant,
        mud={"density": 1200.0},
    )  # fmt: skip
    point = equilibrium(case, "rotate_off_bottom", 900.0)
    area = math.pi * (0.0635**2 - 0.035**2)
    hanging = 9.80665 * area * (7850 - 1200) * 400 * 0.5
    assert point.hookload == pytest.approx(hanging, rel=1e-4)
    top = point.profile.iloc[0]
    assert top["md_m"] == 500.0
    assert top["inclination_deg"] == pytest.approx(60.0)
    pressure = 1200 * 9.80665 * 250
    assert top["true_tension_N"] == pytest.approx(hanging - pressure * area, rel=1e-4)


@pytest.mark.parametrize("segments", [20, 1])
@pytest.mark.parametrize(("kind", "sign"), [("trip_out", 1), ("trip_in", -1)])
def test_mud_drags_against_the_motion(kind: str, sign: int, segments: int) -> None:
    """Vertical: the hook carries the weight and c L v more when hoisting, less when lowering."""
    case = make_case([[0, 0, 0], [1000, 0, 0]], [pipe(None, segments)], mud={"axial_damping": 30.0})
    weight = 1000 * 9.80665 * 7850 * math.pi / 4 * (0.127**2 - 0.07**2)
    point = equilibrium(case, kind, 1000.0, speed=0.5)
    assert point.hookload == pytest.approx(weight + sign * 30.0 * 1000 * 0.5, rel=1e-8)


def test_contact_angle_and_offset_of_a_string_on_the_low_side() -> None:
    profile = equilibrium(
        make_case([[0, 60, 200], [300, 60, 200]], [pipe(None, None, segment_length=10.0)]), "trip_out", 300.0
    ).profile.iloc[5:-1]
    np.testing.assert_allclose(profile["contact_angle_deg"], 180.0, atol=0.1)
    np.testing.assert_allclose(profile["clearance_m"], (0.2159 - 0.127) / 2)
    assert (profile["offset_high_m"] <= -profile["clearance_m"]).all()
    assert (profile["buckling"] == "none").all()


@pytest.mark.parametrize("components", [[pipe(None, 8)], LONG], ids=["segments", "long segment"])
@pytest.mark.parametrize("kind", ["trip_in", "rotate_off_bottom", "drill_rotating"])
def test_the_ends_carry_hook_load_and_weight_on_bit(components: list[dict[str, object]], kind: str) -> None:
    case = make_case([[0, 0, 0], [400, 0, 0]], components, bit={"weight_on_bit": 20e3, "torque": 1e3})
    point = equilibrium(case, kind, 300.0)
    top, bit = point.profile.iloc[0], point.profile.iloc[-1]
    assert top["effective_tension_N"] == pytest.approx(point.hookload, rel=1e-6)
    # In vertical hole the hook carries the weight less what stands on the bit; the wall has next to no share.
    weight = 300 * 7850 * 9.80665 * math.pi / 4 * (0.127**2 - 0.07**2)
    on_bit = 20e3 if kind == "drill_rotating" else 0.0
    assert point.hookload == pytest.approx(weight - on_bit, abs=0.005 * 20e3)
    assert top["torque_N_m"] == pytest.approx(point.surface_torque, abs=1e-3)
    assert bit["bending_moment_N_m"] == 0.0
    assert bit["effective_tension_N"] == (-20e3 if kind == "drill_rotating" else 0)


@pytest.mark.parametrize("operation", [rotation(300, 2), trip(300, 310, speed=0.5)], ids=["rotating", "fed"])
def test_the_stepper_s_long_segment_hangs_from_the_hook(operation: dict[str, object]) -> None:
    result = simulate(make_case([[0, 0, 0], [400, 0, 0]], LONG, [operation]))
    last = result.profile.groupby("bit_depth_m").get_group(result.profile["bit_depth_m"].max()).iloc[0]
    # The profile has the length at the interval's end, the hook load its mean: half a metre of pipe, 0.1 %.
    assert last["effective_tension_N"] == pytest.approx(result.history["hookload_N"].iloc[-1], rel=1e-3)


@pytest.mark.parametrize(
    ("place", "unit", "words"),
    [
        (3812.1, (1 / 0.3048, "ft"), "12500 ft + 7 ft of stretch"),
        (3812.1, (1.0, "m"), "3810 m + 2 m of stretch"),
        (3810.3, (1.0, "m"), "3810 m"),
        (3809.9, (1.0, "m"), "3810 m"),
        (12.4, (1.0, "m"), "12 m"),
    ],
)
def test_a_place_below_the_tally_is_said_as_stretch(place: float, unit: tuple[float, str], words: str) -> None:
    """12,507 ft in a well of 12,500 ft is no place of the hole."""
    assert place_in_words(place, 3810.0, *unit) == words


def test_the_worst_places_of_a_long_string_are_said_as_stretch() -> None:
    """Title of its picture, notes, and its least tension; 5,000 m of hanging pipe are 4.6 m longer."""
    case = make_case([[0, 0, 0], [5000, 0, 0]], [pipe(None, None, yield_strength=1e8)])
    point = equilibrium(case, "rotate_off_bottom", 5000.0)
    assert point.profile["md_m"].iloc[-1] > 5004.0
    title, _ = heading_of_profile([point], "si", ())
    assert "bit at 5000 m + 5 m of stretch" in title
