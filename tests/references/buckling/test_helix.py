"""The helix in closed form: least energy, balance across the wall, and the laws of a helix that slides."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from references.buckling import helix
from references.buckling.onset import Pipe

PIPE = Pipe(EI=1.2e6, weight=260.0, clearance=0.044)
FORCE = 2.0 * PIPE.onset
FRICTION = 0.3


def test_turning_has_the_least_energy() -> None:
    def energy(rate: float) -> float:
        return float(PIPE.clearance**2 * (PIPE.EI * rate**4 - FORCE * rate**2) / 2)

    rate = helix.turning(PIPE, FORCE)
    assert energy(rate) < min(energy(0.99 * rate), energy(1.01 * rate))
    assert helix.pitch(PIPE, FORCE) == pytest.approx(2 * np.pi / rate)


def test_wall_balances_compression_and_bending() -> None:
    """u = r e^(iθ): EI u'''' + F u'' = −N e^(iθ); the moment is EI |u''|."""
    rate, r = helix.turning(PIPE, FORCE), PIPE.clearance
    assert helix.wall_force(PIPE, FORCE) == pytest.approx(FORCE * r * rate**2 - PIPE.EI * r * rate**4)
    assert helix.bending_moment(PIPE, FORCE) == pytest.approx(PIPE.EI * r * rate**2)


def test_vertical_shortening_is_that_of_its_slope() -> None:
    length = FORCE / PIPE.weight
    slope = quad(lambda x: 0.5 * (PIPE.clearance * helix.turning(PIPE, FORCE - PIPE.weight * x)) ** 2, 0, length)[0]
    assert helix.vertical_shortening(PIPE, FORCE) == pytest.approx(slope)


@pytest.mark.parametrize(
    ("law", "extra"), [(helix.pushed_force, 0.0), (helix.pushed_force_tan, PIPE.weight)], ids=["reciprocal", "tan"]
)
def test_pushed_force_solves_its_equation(law, extra: float) -> None:  # type: ignore[no-untyped-def]
    length = 0.4 * helix.lock_up_length(PIPE, FORCE, FRICTION)

    def growth(_: float, force: np.ndarray) -> np.ndarray:
        return FRICTION * (extra + PIPE.clearance * force**2 / (4 * PIPE.EI))

    exact = solve_ivp(growth, (0, length), [FORCE], rtol=1e-10).y[0, -1]
    assert law(PIPE, FORCE, FRICTION, length) == pytest.approx(exact, rel=1e-7)


def test_lock_up() -> None:
    length = helix.lock_up_length(PIPE, FORCE, FRICTION)
    assert helix.pushed_force(PIPE, FORCE, FRICTION, 0.999 * length) == pytest.approx(1000 * FORCE)
    assert helix.pushed_force(PIPE, FORCE, FRICTION, 1.001 * length) == np.inf
    assert helix.pushed_force_tan(PIPE, FORCE, FRICTION, length) == np.inf


def test_tan_law_has_too_much_friction_just_above_the_helical_limit() -> None:
    """By w over r F²/4EI = 2w: half as much again at 2√2 √(EIw/r)."""
    short = 0.01

    force = np.sqrt(2) * PIPE.onset
    tan, reciprocal = (
        law(PIPE, force, FRICTION, short) - force for law in (helix.pushed_force_tan, helix.pushed_force)
    )
    assert tan / reciprocal == pytest.approx(1.5, rel=1e-3)
