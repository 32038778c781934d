"""The soft string with friction that differs along and around the hole: closed forms, recursion, integration."""

from functools import partial

import numpy as np
import pytest

from fctd import Case
from fctd.model.section import section_of
from references.soft_string.closed_forms import capstan, drop, sum_up
from references.soft_string.directions import LAWS, associated, by_components, largest_turn
from references.soft_string.integration import soft_string, soft_string_ode
from references.soft_string.sliding import Motion, split_friction
from tests.cases import make_case, pipe

RADIUS = 0.0635  # of pipe of 5 in [m]
MOTION = Motion(1.0, 0.1, 2.0)


def test_equal_factors_are_coulombs_law_to_the_bit() -> None:
    for radius in (0.05, 0.1):
        one = split_friction("coulomb", 0.3, MOTION, radius)
        assert split_friction("coulomb", 0.3, MOTION, radius, 0.3) == one
        around, resultant = radius * MOTION.spin, np.hypot(MOTION.speed, radius * MOTION.spin)
        sine, cosine = around / resultant, MOTION.speed / resultant
        normal = 1 / np.sqrt(1 + (0.3 * sine) ** 2)
        assert one == (normal, 0.3 * cosine * normal, 0.3 * sine * normal)


@pytest.mark.parametrize("direction", LAWS.values())
def test_pure_motions_have_their_own_factor(direction) -> None:
    slid = split_friction("coulomb", 0.4, Motion(-1.0, 0.2, 0.0), RADIUS, 0.1, direction)
    assert slid == pytest.approx((1.0, -0.4, 0.0))
    turned = split_friction("coulomb", 0.4, Motion(0.0, 0.0, 3.0), RADIUS, 0.1, direction)
    assert turned == pytest.approx((1 / np.hypot(1, 0.1), 0.0, 0.1 / np.hypot(1, 0.1)))
    assert split_friction("paper", 0.4, MOTION, RADIUS, 0.1) == (1.0, 0.4, 0.1)
    assert direction(0.4, 0.1, 0.0, 0.0) == (0.0, 0.0)


def test_wall_and_friction_around_carry_the_load_together() -> None:
    for along, around in ((0.4, 0.1), (0.1, 0.4), (0.3, 0.0), (0.0, 0.3)):
        normal, drag, turning = split_friction("coulomb", along, MOTION, RADIUS, around)
        assert np.hypot(normal, turning) == pytest.approx(1.0)
        pair = [(force, factor) for force, factor in ((drag, along), (turning, around)) if factor]
        assert sum((force / (factor * normal)) ** 2 for force, factor in pair) == pytest.approx(1.0)


@pytest.mark.parametrize(("ratio", "degrees"), [(1.25, 6.4), (1.5, 11.5), (2.0, 19.5), (3.0, 30.0)])
def test_how_far_both_laws_are_apart(ratio: float, degrees: float) -> None:
    """Numbers of docs/theory.md."""
    assert np.degrees(largest_turn(1 / ratio)) == pytest.approx(degrees, abs=0.05)
    assert largest_turn(ratio) == pytest.approx(largest_turn(1 / ratio))
    one, other = (law(ratio, 1.0, 1.0, np.sqrt(ratio)) for law in (associated, by_components))
    assert one.along / other.along == pytest.approx(np.sqrt(ratio))


def bent(along: float, around: float) -> Case:
    """Pipe in a drop that is reamed back."""
    hole = {"to_md": 500, "diameter": 0.2159, "friction": along, "rotational_friction": around}
    back = [{"kind": "back_ream", "from_md": 460, "to_md": 459, "speed": MOTION.speed, "rpm": MOTION.spin * 30 / np.pi}]
    return make_case(
        [[0, 80, 0], [400, 20, 0], [500, 20, 0]], [pipe(None, None, segment_length=10.0)], back,
        wellbore={"intervals": [hole]},
    )  # fmt: skip


def test_recursion_and_integration_agree_with_the_closed_form() -> None:
    case = bent(0.4, 0.15)
    (part,) = case.string.components
    friction = split_friction("coulomb", 0.4, MOTION, RADIUS, 0.15)
    section = partial(
        drop, weight=section_of(part, 0.0).weight, radius=400.0 / np.radians(60.0),
        inclination_below=np.radians(20), inclination_above=np.radians(80),
    )  # fmt: skip
    ode = soft_string_ode(case, "back_ream", 400.0)
    exact = sum_up([section], friction, RADIUS)
    assert ode.hookload == pytest.approx(exact.hookload, rel=1e-9)
    assert ode.surface_torque == pytest.approx(exact.surface_torque, rel=1e-9)
    errors = [soft_string(case, "back_ream", 400.0, element=h).hookload - exact.hookload for h in (8.0, 4.0, 2.0)]
    orders = np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))
    np.testing.assert_allclose(orders, 2.0, atol=0.1)


@pytest.mark.parametrize(("along", "around"), [(0.4, 0.15), (0.15, 0.4), (0.3, 0.03)])
def test_capstan_that_slides_and_turns(along: float, around: float) -> None:
    """T₀ exp(f_a θ/√(1 + f_r²)) and r f_r/f_a of its drag as torque: by elements that fall with their square.

    The direction of sliding is one along the string, and so are f_a = μ_a² V/√(μ_a² V² + μ_r² r²Ω²) and f_r.  The wall
    bears N with N² + (f_r N)² = (T dθ)², so that dT = f_a N = f_a T dθ/√(1 + f_r²).
    """
    v_r, angle = RADIUS * MOTION.spin, np.radians(90.0)
    size = np.hypot(along * MOTION.speed, around * v_r)
    f_a, f_r = along**2 * MOTION.speed / size, around**2 * v_r / size
    pull = 1e5
    drag = pull * np.expm1(f_a * angle / np.hypot(1, f_r))
    friction = split_friction("coulomb", along, MOTION, RADIUS, around)
    loads = sum_up([partial(capstan, turn=angle)], friction, RADIUS, tension_at_bit=pull)
    assert loads.hookload - pull == pytest.approx(drag, rel=1e-12)
    assert loads.surface_torque == pytest.approx(RADIUS * f_r / f_a * drag, rel=1e-12)

    errors = []
    for count in (10, 20, 40):
        # Johancsik's recursion without weight: the load across an element is that of its mean tension.
        tension, half = pull, np.sin(0.5 * angle / count)
        for _ in range(count):
            tension *= (1 + friction.drag * half) / (1 - friction.drag * half)
        errors.append(tension - pull - drag)
    assert abs(errors[0]) < 3e-3 * drag
    np.testing.assert_allclose(np.log2(np.abs(errors[:-1]) / np.abs(errors[1:])), 2.0, atol=0.05)
