"""Closed forms agree with both methods of the soft string in the same well, and raise errors where not valid."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model.section import section_of
from references.soft_string import closed_forms
from references.soft_string.closed_forms import (
    SideChangeError,
    bend_in_parts,
    build,
    capstan,
    drop,
    hold,
    side_turn,
    vertical,
)
from references.soft_string.integration import soft_string, soft_string_ode
from references.soft_string.sliding import Friction, loads_at_bit, motion_of, split_friction
from tests.cases import make_case, pipe

DEG = np.pi / 180
STEP = 5.0  # [m] elements of the coarser recursion
MOTIONS: dict[str, tuple[str, float, float]] = {
    "pick-up": ("trip_out", 0.2, 0.0),
    "slack-off": ("trip_in", 0.2, 0.0),
    "rotation": ("rotate_off_bottom", 0.0, 60.0),
    "back-reaming": ("back_ream", 0.3, 60.0),
}


def bend(from_inclination: float, to_inclination: float, length: float) -> dict[str, float]:
    """Keywords of a build or drop, inclinations downwards in degrees."""
    above, below = from_inclination * DEG, to_inclination * DEG
    return {"radius": length / abs(below - above), "inclination_above": above, "inclination_below": below}


# Stations, and the sections from the bit upwards without their weight.  The wall force keeps its side in every bend and
# motion: tension exceeds weight in the build above a hold, weight exceeds tension in the build at the bit.
WELLS: dict[str, tuple[list[list[float]], list[tuple[Any, dict[str, float]]]]] = {
    "vertical": ([[0, 0, 0], [1000, 0, 0]], [(vertical, {"length": 1000})]),
    "hold": ([[0, 60, 300], [1000, 60, 300]], [(hold, {"length": 1000, "inclination": 60 * DEG})]),
    "build on a hold": (
        [[0, 0, 20], [300, 0, 20], [600, 40, 20], [2000, 40, 20]],
        [
            (hold, {"length": 1400, "inclination": 40 * DEG}),
            (build, bend(0, 40, 300)),
            (vertical, {"length": 300}),
        ],
    ),
    "build at the bit": ([[0, 40, 0], [400, 70, 0]], [(build, bend(40, 70, 400))]),
    "build past 90 deg at the bit": ([[0, 75, 0], [400, 105, 0]], [(build, bend(75, 105, 400))]),
    "drop": (
        [[0, 60, 100], [500, 60, 100], [1000, 20, 100], [1300, 20, 100]],
        [
            (hold, {"length": 300, "inclination": 20 * DEG}),
            (drop, bend(60, 20, 500)),
            (hold, {"length": 500, "inclination": 60 * DEG}),
        ],
    ),
    "drop from past 90 deg": ([[0, 110, 0], [800, 30, 0]], [(drop, bend(110, 30, 800))]),
    "horizontal turn": (
        [[0, 90, 330], [200, 90, 330], [1000, 90, 75], [1300, 90, 75]],
        [
            (hold, {"length": 300, "inclination": 90 * DEG}),
            (side_turn, {"radius": 800 / (105 * DEG), "turn": 105 * DEG}),
            (hold, {"length": 200, "inclination": 90 * DEG}),
        ],
    ),
}


def case_of(stations: list[list[float]], law: str) -> Case:
    return make_case(
        stations,
        [pipe(None, None, segment_length=50.0, contact_diameter=0.16)],
        contact={"friction_law": law},
        mud={"density": 1200.0},
        wellbore={"intervals": [{"to_md": stations[-1][0], "diameter": 0.2159, "friction": 0.25}]},
    )


def closed(case: Case, sections: list[tuple[Any, dict[str, float]]], motion: Any) -> closed_forms.Loads:
    """The loads by closed forms for a case of one pipe and one friction factor."""
    section = section_of(case.string.components[0], case.mud.density)
    friction = split_friction(
        case.contact.friction_law, case.wellbore.intervals[0].friction, motion, section.contact_radius
    )
    climbs = [partial(form, weight=section.weight, **keywords) for form, keywords in sections]
    return closed_forms.sum_up(climbs, friction, section.contact_radius)


def extrapolated(*arguments: Any, **motion: float) -> Sequence[float]:
    """Johancsik's recursion, extrapolated from two element lengths (error of second order, `test_integration`)."""
    coarse = np.array(soft_string(*arguments, **motion, element=STEP)[:3])
    fine = np.array(soft_string(*arguments, **motion, element=0.5 * STEP)[:3])
    return [float(value) for value in (4 * fine - coarse) / 3]


@pytest.mark.parametrize("law", ["coulomb", "paper"])
@pytest.mark.parametrize("name", MOTIONS)
@pytest.mark.parametrize("well", WELLS)
def test_closed_forms_recursion_and_differential_form_agree(well: str, name: str, law: str) -> None:
    stations, sections = WELLS[well]
    operation, speed, rpm = MOTIONS[name]
    case, depth = case_of(stations, law), float(stations[-1][0])
    expected = closed(case, sections, motion_of(case, operation, speed, rpm))
    moving = {"speed": speed, "rpm": rpm}
    assert soft_string_ode(case, operation, depth, **moving)[:3] == pytest.approx(expected, rel=1e-9, abs=1e-6)
    assert extrapolated(case, operation, depth, **moving) == pytest.approx(expected, rel=1e-6, abs=1e-6)


TO_HORIZONTAL = [[0, 0, 0], [500, 0, 0], [950, 90, 0], [1150, 90, 0]]


@pytest.mark.parametrize("law", ["coulomb", "paper"])
@pytest.mark.parametrize("name", ["slack-off", "rotation"])
def test_a_build_whose_wall_force_changes_side_is_refused_and_done_in_two_parts(name: str, law: str) -> None:
    operation, speed, rpm = MOTIONS[name]
    case = case_of(TO_HORIZONTAL, law)
    motion = motion_of(case, operation, speed, rpm)
    horizontal, kick_off = (hold, {"length": 200, "inclination": 90 * DEG}), (vertical, {"length": 500})
    curve = bend(0, 90, 450)
    with pytest.raises(SideChangeError, match=r"changes side .* above the lower end") as refusal:
        closed(case, [horizontal, (build, curve), kick_off], motion)
    change = refusal.value
    assert change.above_lower_end == pytest.approx((90 * DEG - change.inclination) * curve["radius"])
    answer = soft_string_ode(case, operation, 1150.0, speed=speed, rpm=rpm)
    # At this place, and at no other in the bend, the integrated side force is zero.
    inside = (answer.profile.md > 500) & (answer.profile.md < 950)
    nearest = answer.profile.md[inside][np.argmin(answer.profile.side_force[inside])]
    assert 950 - change.above_lower_end == pytest.approx(nearest, abs=0.5)
    # Two closed forms, one on each side of the place.
    weight = section_of(case.string.components[0], case.mud.density).weight
    parts: list[tuple[Any, dict[str, float]]] = [
        (build, curve | {"inclination_above": change.inclination}),
        (build, curve | {"inclination_below": change.inclination}),
    ]
    expected = closed(case, [horizontal, *parts, kick_off], motion)
    assert closed(case, [horizontal, (bend_in_parts, curve), kick_off], motion) == pytest.approx(expected, rel=1e-12)
    # Measured: at most 2e-10 with a restart of the integration at the kink, 9e-10 without.
    assert answer[:3] == pytest.approx(expected, rel=5e-10, abs=1e-6)
    # The kink rules out extrapolation of the recursion, not its order: with short elements it agrees too.
    fine = soft_string(case, operation, 1150.0, speed=speed, rpm=rpm, element=0.25)
    assert fine[:3] == pytest.approx(expected, rel=1e-6, abs=1e-6)
    # Tension and load in the error are those of the lower part.
    lower = build(hold(0.0, -0.25, weight=weight, length=200, inclination=90 * DEG)[0], -0.25, weight=weight,
                  **(curve | {"inclination_above": change.inclination}))  # fmt: skip
    if name == "slack-off":
        assert (change.tension, change.load) == pytest.approx(lower, rel=1e-9)


def test_without_friction_the_side_changes_at_half_the_sine_of_the_bit() -> None:
    """By hand: T = wR (sin I₂ − sin I), so the load T/R − w sin I is zero where sin I = ½ sin I₂; its
    integral is wR [2 cos I + I sin I₂] on either side."""
    w, radius, below, above = 200.0, 300.0, 80 * DEG, 10 * DEG
    place = np.arcsin(0.5 * np.sin(below))
    geometry = {"weight": w, "radius": radius, "inclination_below": below, "inclination_above": above}
    with pytest.raises(SideChangeError) as refusal:
        build(0.0, 0.0, **geometry)
    assert refusal.value.inclination == pytest.approx(place, rel=1e-12)
    assert refusal.value.tension == pytest.approx(0.5 * w * radius * np.sin(below), rel=1e-12)

    def primitive(inclination: float) -> float:
        return float(w * radius * (2 * np.cos(inclination) + inclination * np.sin(below)))

    whole = bend_in_parts(0.0, 0.0, **geometry)
    assert whole.tension_above == pytest.approx(w * radius * (np.sin(below) - np.sin(above)), rel=1e-12)
    load = (primitive(place) - primitive(below)) + (primitive(place) - primitive(above))
    assert whole.load == pytest.approx(load, rel=1e-12)


def test_a_drop_in_compression_and_a_build_beyond_horizontal_may_change_side_more_than_once() -> None:
    """A drop in compression can have a zero of the load, a build that starts past 90 deg two zeros."""
    steep = {"weight": 200.0, "radius": 300.0, "inclination_below": 5 * DEG, "inclination_above": 80 * DEG}
    with pytest.raises(SideChangeError):
        drop(-30e3, -0.2, **steep)
    assert drop(30e3, -0.2, **steep).tension_above > 30e3
    long = {"weight": 200.0, "radius": 300.0, "inclination_below": 175 * DEG, "inclination_above": 5 * DEG}
    places, loads = [], []
    tension, below = 10e3, long["inclination_below"]
    for _ in range(2):
        with pytest.raises(SideChangeError) as refusal:
            build(tension, 0.1, **(long | {"inclination_below": below}))
        tension, below = refusal.value.tension, refusal.value.inclination
        places.append(below / DEG)
        loads.append(refusal.value.load)
        assert tension == pytest.approx(200.0 * 300.0 * np.sin(below), rel=1e-9)
    assert places[0] > 90 > places[1]
    last = build(tension, 0.1, **(long | {"inclination_below": below}))
    assert bend_in_parts(10e3, 0.1, **long) == pytest.approx((last.tension_above, sum(loads) + last.load))


def test_a_capstan_is_any_bend_without_weight() -> None:
    """T₁ = T₂ e^(μθ), 20 kN over 90 deg with μ 0.3 by hand: 20 e^0.4712 = 32.04 kN."""
    assert capstan(20e3, 0.3, turn=90 * DEG).tension_above == pytest.approx(32.04e3, rel=1e-4)
    for tension in (20e3, -20e3):
        for drag in (0.3, -0.3, 0.0):
            expected = capstan(tension, drag, turn=1.2)
            curve = {"weight": 0.0, "radius": 300.0, "inclination_below": 1.5, "inclination_above": 0.3}
            assert build(tension, drag, **curve) == pytest.approx(expected, rel=1e-12)
            assert side_turn(tension, drag, weight=0.0, radius=300.0, turn=1.2) == pytest.approx(expected, rel=1e-12)
            nearly = side_turn(tension, drag, weight=1e-6, radius=300.0, turn=1.2)
            assert nearly == pytest.approx(expected, rel=1e-6)
    assert capstan(-20e3, 0.3, turn=1.2).tension_above == pytest.approx(-20e3 * np.exp(-0.36))


@pytest.mark.parametrize("tension", [40e3, 90e3])
def test_forms_with_no_friction_are_the_limit_of_little(tension: float) -> None:
    """The load of a bend is a quotient by the drag, for which the forms use its limit at zero drag."""
    curve = {"weight": 200.0, "radius": 300.0, "inclination_below": 80 * DEG, "inclination_above": 55 * DEG}
    for form, geometry in ((bend_in_parts, curve), (side_turn, {"weight": 200.0, "radius": 300.0, "turn": 1.0})):
        none, little = form(tension, 0.0, **geometry), form(tension, 1e-9, **geometry)
        assert little == pytest.approx(none, rel=1e-8)


def test_the_effective_factors_of_the_two_laws() -> None:
    """Slides: μ; turns in place: μ/√(1+μ²) by law ``coulomb``, μ by ``paper``; both at 45 deg by hand."""
    case = case_of([[0, 0, 0], [1000, 0, 0]], "coulomb")
    turning, sliding = motion_of(case, "rotate_off_bottom", 0.0, 60.0), motion_of(case, "trip_in", 0.2, 0.0)
    root = np.sqrt(1 + 0.3**2)
    assert split_friction("coulomb", 0.3, turning, 0.08) == pytest.approx((1 / root, 0.0, 0.3 / root))
    assert split_friction("coulomb", 0.3, sliding, 0.08) == pytest.approx((1.0, -0.3, 0.0))
    assert split_friction("paper", 0.3, turning, 0.08) == pytest.approx((1.0, 0.0, 0.3))
    assert split_friction("paper", 0.3, sliding, 0.08) == pytest.approx((1.0, -0.3, 0.0))
    both = motion_of(case, "back_ream", 0.08 * 2 * np.pi, 60.0)
    normal = 1 / np.sqrt(1 + 0.5 * 0.3**2)
    part = 0.3 * normal * np.sqrt(0.5)
    assert split_friction("coulomb", 0.3, both, 0.08) == pytest.approx((normal, part, part))
    assert split_friction("paper", 0.3, both, 0.08) == pytest.approx((1.0, 0.3, 0.3))


@pytest.mark.parametrize("speed", [1e-3, 0.05, 0.4, 5.0])
def test_coulomb_friction_balances_the_load_and_is_the_factor_times_the_wall_force(speed: float) -> None:
    case = case_of([[0, 0, 0], [1000, 0, 0]], "coulomb")
    for operation, sign in (("back_ream", 1.0), ("drill_rotating", -1.0)):
        normal, drag, turning = split_friction("coulomb", 0.4, motion_of(case, operation, speed, 60.0), 0.08)
        assert normal**2 + turning**2 == pytest.approx(1.0)
        assert np.hypot(drag, turning) == pytest.approx(0.4 * normal)
        assert drag / turning == pytest.approx(sign * speed / (0.08 * 2 * np.pi))


def test_weight_on_bit_and_bit_torque_act_only_while_drilling() -> None:
    case = make_case(bit={"weight_on_bit": "50 kN", "torque": "3 kN*m"})
    for operation in ("drill_rotating", "drill_sliding"):
        assert loads_at_bit(case, operation) == (-50e3, 3e3)
    for operation in ("trip_in", "trip_out", "rotate_off_bottom", "back_ream"):
        assert loads_at_bit(case, operation) == (0.0, 0.0)
    sections = [
        partial(vertical, weight=250.0, length=1000.0),
        partial(hold, weight=250.0, length=10.0, inclination=1.0),
    ]
    loads = closed_forms.sum_up(sections, Friction(1.0, 0.0, 0.2), 0.08, tension_at_bit=-50e3, torque=3e3)
    assert loads.hookload == pytest.approx(-50e3 + 250e3 + 2500 * np.cos(1.0))
    assert loads.surface_torque == pytest.approx(3e3 + 0.08 * 0.2 * 2500 * np.sin(1.0))


WRONG: list[tuple[Any, dict[str, float], str, str]] = [
    (vertical, {"weight": -1.0, "length": 10.0}, "weight", "at least 0"),
    (vertical, {"weight": 1.0, "length": float("nan")}, "length", "at least 0"),
    (hold, {"weight": 1.0, "length": 10.0, "inclination": 3.2}, "inclination", "0 to π"),
    (build, {"weight": 1.0, **bend(60, 20, 100)}, "inclination_above", "less than inclination_below"),
    (drop, {"weight": 1.0, **bend(20, 60, 100)}, "inclination_above", "more than inclination_below"),
    (build, {"weight": 1.0, **bend(-5, 20, 100)}, "inclination_above", "0 to π"),
    (build, {"weight": 1.0, **bend(5, 20, 100), "radius": 0.0}, "radius", "above 0"),
    (side_turn, {"weight": 1.0, "radius": 100.0, "turn": -1.0}, "turn", "at least 0"),
    (capstan, {"turn": -1.0}, "turn", "at least 0"),
]


@pytest.mark.parametrize(("form", "geometry", "key", "expected"), WRONG)
def test_wrong_geometry_is_named(form: Any, geometry: dict[str, float], key: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected) as refusal:
        form(1e4, 0.2, **geometry)
    assert refusal.value.key == key
