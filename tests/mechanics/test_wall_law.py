"""The wall as a spring of another power: static depth, Hertz's rebound, energy, and the step that is stable."""

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics import dynamics, state, topdrive
from fctd.mechanics.energy import energy_of
from fctd.mechanics.state import Laws
from fctd.mechanics.wall_law import put_stiffness, tangent_over_linear
from tests.bodies import TO_WALL, VELOCITY, at, put, set_body
from tests.compiled import kept

update_velocities = kept(dynamics.update_velocities)

MASS, HOLE, RADIUS, STIFFNESS, REFERENCE = 400.0, 0.1, 0.06, 2e6, 1e-3
FACTOR = STIFFNESS * REFERENCE**-0.5  # k of F = k d^1.5 [N/m^1.5]


def body(depth: float) -> Array:
    S = state.new_state(1)
    set_body(S, 1, MASS, 300.0, 1.5)
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.K_WALL + 1] = RADIUS, HOLE, STIFFNESS
    put(S, 1, TO_WALL, [HOLE - RADIUS + depth, 0, 0])
    return S


def laws(exponent: float) -> Laws:
    return Laws(state.ARCS, 0, 1.0, 0.0, 0.0, 0.0, wall_exponent=exponent, wall_reference=REFERENCE)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_force_and_energy_at_a_depth(exponent: float) -> None:
    """K d₀ (d/d₀)^p, and its integral."""
    depth = 4e-3
    S, top = body(depth), np.zeros(topdrive.TOP_SIZE)
    put_stiffness(S, top, 1, laws(exponent))
    force = STIFFNESS * REFERENCE * (depth / REFERENCE) ** exponent
    assert S[state.K_WALL + 1] * depth == pytest.approx(force)
    assert energy_of(S, 1, exponent).contact == pytest.approx(force * depth / (exponent + 1))
    assert top[topdrive.TOP_PENETRATION] == pytest.approx(depth)
    assert S[state.MARGIN_END + 1] == -np.inf  # the next step looks up the wall's own stiffness


def test_a_point_off_the_wall_keeps_its_stiffness() -> None:
    S, top = body(-1e-3), np.zeros(topdrive.TOP_SIZE)
    put_stiffness(S, top, 1, laws(1.5))
    assert S[state.K_WALL + 1] == STIFFNESS
    assert top[topdrive.TOP_PENETRATION] == 0


@pytest.mark.parametrize("steps", [200, 400])
def test_a_body_rebounds_as_by_hertz(steps: int) -> None:
    """Contact time 2.9433 d/v with the largest depth d = (5 m v²/4k)^0.4, and the speed of the fall (Hertz 1882).

    2.9433 is 4/5 √π Γ(2/5)/Γ(9/10).
    """
    speed = 0.2
    deepest = (5 * MASS * speed**2 / (4 * FACTOR)) ** 0.4
    lasting = 2.943275 * deepest / speed
    S, top, dt = body(0.0), np.zeros(topdrive.TOP_SIZE), lasting / steps
    put(S, 1, VELOCITY, [speed, 0, 0])
    depth, time, largest = 0.0, 0.0, 0.0
    while time == 0 or depth > 0:
        S[state.K_WALL + 1] = STIFFNESS
        put_stiffness(S, top, 1, laws(1.5))
        update_velocities(S, state.LANES, laws(1.5), dt)
        depth += dt * at(S, 1, VELOCITY)[0]
        put(S, 1, TO_WALL, [HOLE - RADIUS + depth, 0, 0])
        time, largest = time + dt, max(largest, depth)
    time += depth / abs(at(S, 1, VELOCITY)[0])  # back to the moment at which it left the wall
    assert time == pytest.approx(lasting, rel=0.005)
    assert at(S, 1, VELOCITY)[0] == pytest.approx(-speed, rel=0.005)
    assert largest == pytest.approx(deepest, rel=0.005)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 3.0])
def test_the_tangent_is_the_slope_of_the_force(exponent: float) -> None:
    def force(depth: float) -> float:
        return REFERENCE * (depth / REFERENCE) ** exponent

    slope = (force(4.001e-3) - force(3.999e-3)) / 2e-6
    assert tangent_over_linear(exponent, REFERENCE, 4e-3) == pytest.approx(slope, rel=1e-6)
