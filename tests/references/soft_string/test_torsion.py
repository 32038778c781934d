"""Discs on torsion springs agree with the wave equation, and their dry friction with the torque of the soft string."""

import numpy as np
import pytest

from fctd.model.section import section_of
from references.soft_string.integration import soft_string
from references.soft_string.torsion import twisted
from tests.cases import make_case, pipe, rotation

SPIN, STEP = 2.0, 0.0005  # [rad/s], [s]


def turned(time):
    """An angle that grows at a constant rate from the first step on."""
    return SPIN * time


def test_torque_of_a_free_string_turned_at_once_is_given_by_its_impedance():
    """Torque Ω √(GJ · ρJ) until the wave returns from the free end, then the negative value until it returns again."""
    case = make_case([[0, 0, 0], [1000, 0, 0]], [pipe(1000, 200)], [rotation(1000, 1, ramp=1)])
    part = section_of(case.string.components[0], 0.0)
    back = 2 * 1000 / np.sqrt(part.GJ / part.axial_inertia)
    torque = twisted(case, 1000.0, turned, 1.8 * back, STEP)
    time = STEP * np.arange(1, len(torque) + 1)
    impedance = np.sqrt(part.GJ * part.axial_inertia)
    for first, last, sign in ((0.1, 0.9, 1), (1.2, 1.7, -1)):
        mean = torque[(time > first * back) & (time < last * back)].mean()
        assert mean == pytest.approx(sign * SPIN * impedance, rel=0.02)


def test_a_string_turned_slowly_needs_the_soft_string_s_torque():
    case = make_case([[0, 0, 0], [100, 0, 0], [400, 60, 0], [600, 60, 0]], [pipe(600, 24)], [rotation(600, 1, ramp=1)])
    steady = soft_string(case, "rotate_off_bottom", 600.0).surface_torque
    # The oscillation after the start has a zero mean.
    torque = twisted(case, 600.0, lambda time: 0.2 * time, 60.0, 0.002)
    assert torque[len(torque) // 2 :].mean() == pytest.approx(steady, rel=0.01)
    # A twist below the friction limit does not reach the bit: it remains stored in the string.
    torque = twisted(case, 600.0, lambda time: np.minimum(0.01 * time, 0.01), 20.0, 0.002)
    assert 0 < torque[-1] < 0.5 * steady


def test_friction_next_to_the_top_drive_is_left_out():
    """With two segments in a straight hole friction acts only below the middle of the first, on three quarters."""
    case = make_case([[0, 60, 0], [600, 60, 0]], [pipe(600, 2)], [rotation(600, 1, ramp=1)])
    whole = soft_string(case, "rotate_off_bottom", 600.0).surface_torque
    torque = twisted(case, 600.0, lambda time: 0.2 * time, 60.0, 0.002)
    assert torque[len(torque) // 2 :].mean() == pytest.approx(0.75 * whole, rel=0.01)


def test_a_long_segment_is_a_spring_with_half_its_inertia():
    case = make_case([[0, 0, 0], [1000, 0, 0]], [pipe(1000, 1)], [rotation(1000, 1, ramp=1)])
    part = section_of(case.string.components[0], 0.0)
    period = 2 * np.pi / np.sqrt(part.GJ / 1000 / (0.5 * part.axial_inertia * 1000))
    torque = twisted(case, 1000.0, turned, period, STEP)
    # (Ω/ω) sin ωt of twist.
    assert torque.max() == pytest.approx(SPIN * np.sqrt(0.5 * part.GJ * part.axial_inertia), rel=0.01)
    assert STEP * np.argmax(torque) == pytest.approx(period / 4, rel=0.02)
