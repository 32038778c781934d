"""The controller of the rig's drive, one step at a time."""

import math

import numpy as np
import pytest

from fctd.mechanics import drive
from fctd.mechanics.drive import Drive, least_inertia
from tests.compiled import kept

turn = kept(drive.turn)
DT = 1e-3


def test_the_torque_is_that_of_the_controller_and_turns_motor_and_string() -> None:
    """T_m = P e + I ∫e dt + (J − J') dΩ/dt with the mean rotation of the step, and J dΩ/dt = T_m − T − drag Ω."""
    given = Drive(False, 2000.0, 300.0, 400.0, 150.0, math.inf)
    planned, before, behind, load, drag = 12.0, 9.0, 0.7, 5000.0, 30.0
    after, left, torque = turn(given, planned, before, behind, load, drag, DT)
    acceleration = (after - before) / DT
    asked = 400 * (planned - 0.5 * (before + after)) + 150 * behind + (2000 - 300) * acceleration
    assert torque == pytest.approx(asked)
    assert 2000 * acceleration == pytest.approx(torque - load - drag * after)
    assert left == pytest.approx(behind + DT * (planned - after))


def test_a_drive_that_turns_as_planned_without_load_does_nothing() -> None:
    given = Drive(False, 2000.0, 2000.0, 400.0, 150.0, math.inf)
    assert turn(given, 8.0, 8.0, 0.0, 0.0, 0.0, DT) == pytest.approx((8.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_at_its_limit_the_motor_gives_that_torque_and_does_not_sum_up(sign: float) -> None:
    given = Drive(False, 2000.0, 2000.0, 1e5, 1e5, 3000.0)
    after, behind, torque = turn(given, sign * 10.0, 0.0, 0.4, 0.0, 0.0, DT)
    assert torque == sign * 3000.0
    assert after == pytest.approx(sign * 3000 * DT / 2000)
    assert behind == 0.4


@pytest.mark.parametrize("damper", [0.0, 50.0, 5e3])
def test_the_least_inertia_is_stable_on_its_spring_and_damper(damper: float) -> None:
    """An explicit step on a spring and a damper stays bounded, at three times the step it does not."""

    def largest(step: float) -> float:
        given = Drive(False, inertia := least_inertia(5e4, damper, 200.0, DT), inertia, 0.0, 200.0, math.inf)
        rate, behind, angle, found = 1.0, 0.0, 0.0, []
        for _ in range(400):
            rate, behind, _ = turn(given, 0.0, rate, behind, 5e4 * angle + damper * rate, 0.0, step)
            angle += step * rate
            found.append(abs(rate))
        return float(np.max(found))

    assert largest(DT) < 3
    assert not largest(3 * DT) < 100  # NaN where it overflows
