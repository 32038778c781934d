"""Lowering the beam: the time integration, its energy, and its slow limit."""

import numpy as np
import pandas as pd
import pytest

from fctd.case.surveys.stations import to_radians
from fctd.model.section import Section
from references.beams.dynamics import generalised_alpha, lower
from references.beams.elements import Beam, Surroundings
from references.beams.planar_hole import PlanarHole

# 50 mm pipe into a bend of 2 deg/m with 25 mm of clearance.
PIPE = Section(9.86, 96.7, 4.2e-3, 2.1e-3, 2.6e8, 4.2e4, 5.5e4, 6.2e7, 0.025, 0.015, 0.025, 931e6)
HOLE = PlanarHole(to_radians(np.array([[0, 0, 0], [6, 0, 0], [24, 36, 0]], dtype=float)))
DEEP = 4.0  # [m] lowered, from the start of the bend


def pipe(**around):
    given = {"clearance": 0.025, "stiffness": 1e6, "radius": 0.025, "weight": PIPE.weight} | around
    return Beam(np.linspace(0.0, 10.0, 11), PIPE, Surroundings(HOLE, **given))


def lowered(model, speed, steps, high_frequency=None, records=5):
    """Lower smoothly by DEEP; without high_frequency through equilibria."""
    duration = 2 * DEEP / speed

    def top(time):
        u = time / duration
        return -4.0 + DEEP * u * u * (3 - 2 * u)

    scheme = None if high_frequency is None else generalised_alpha(high_frequency)
    return lower(model, top, np.linspace(0, duration, records + 1), duration / steps, scheme)


def work(ledger):
    return (ledger["top_work_J"] - ledger["gravity_J"]).abs().max()


@pytest.mark.parametrize("share", [0.0, 0.5, 0.8, 1.0])
def test_scheme_damps_the_fastest_modes_and_is_second_order(share):
    am, af, gamma, beta = generalised_alpha(share)

    def amplification(omega):
        # One step of q'' = −ω²q on (q, v, a), step 1: solve for the new acceleration.
        q, v, a = np.eye(3)
        inertia = (1 - am) + (1 - af) * beta * omega**2
        known = am * a + af * omega**2 * q + (1 - af) * omega**2 * (q + v + (0.5 - beta) * a)
        new = -known / inertia
        return np.array([q + v + (0.5 - beta) * a + beta * new, v + (1 - gamma) * a + gamma * new, new])

    assert np.abs(np.linalg.eigvals(amplification(1e6))).max() == pytest.approx(share, abs=2e-2)
    slow = 0.01
    # Two of the roots are the oscillation, the third is spurious.
    phases = np.abs(np.angle(np.linalg.eigvals(amplification(slow))))
    phase = phases[(phases > 1e-6) & (phases < 1)].mean()
    assert phase == pytest.approx(slow, rel=2e-4)


@pytest.mark.slow
def test_energy_balance_of_the_dynamic_beam_closes():
    model = pipe(friction=0.2, creep=0.05, lateral_damping=50.0, axial_damping=20.0)
    ledgers = [lowered(model, 1.0, steps, 1.0).ledger for steps in (50, 100)]
    last = ledgers[-1].iloc[-1]
    assert last["lost_friction_J"] > 1
    assert last["lost_mud_J"] > 1
    assert last["strain_J"] > 10
    left = [ledger["residual_J"].abs().max() / work(ledger) for ledger in ledgers]
    assert left[-1] < 5e-4
    # Second order except at the instants at which contact begins.
    assert left[-1] < left[0] / 2.5


def test_a_missing_force_would_show_in_the_ledger():
    """The residual is far below the loss to the mud."""
    ledger = lowered(pipe(lateral_damping=50.0, axial_damping=20.0), 1.0, 100, 1.0).ledger
    assert ledger["lost_mud_J"].iloc[-1] > 10 * ledger["residual_J"].abs().max()


@pytest.mark.slow
def test_static_work_is_stored_or_lost_to_friction():
    model = pipe(friction=0.2, creep=1e-3)
    ledger = lowered(model, 1.0, 100).ledger
    assert (ledger["kinetic_J"] == 0).all()
    assert ledger["residual_J"].abs().max() < 0.02 * work(ledger)
    assert ledger["lost_friction_J"].is_monotonic_increasing
    assert work(lowered(pipe(), 1.0, 100).ledger) < work(ledger)


@pytest.mark.slow
def test_slow_lowering_tends_to_equilibrium():
    """Difference of the states of first order in the speed, below 1 % of the clearance at the lowest speed."""
    still, slowed = lowered(pipe(), 1.0, 20).states, pipe(lateral_damping=20.0)
    away = [np.abs(lowered(slowed, speed, 100, 0.8).states - still).max() for speed in (4, 1, 0.25)]
    assert away[0] > 3 * away[1] > 9 * away[2]
    assert away[2] < 0.01 * 0.025


def test_top_follows_its_path_and_stays_fixed_laterally():
    model = pipe()
    top = model.dofs(0.0)
    states = lowered(model, 2.0, 50, 0.8).states
    assert states[-1][top] == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert states[-2][top[1:]] == pytest.approx([0.0, 0.0])


def test_recorded_pressure_is_that_of_the_states():
    model = pipe()
    found = lowered(model, 1.0, 20, records=20)
    q = found.states[-1]
    here = model.wall_load(q, np.zeros_like(q))
    before = model.wall_load(found.states[-2], np.zeros_like(q))
    assert found.pressure[-1] == pytest.approx(0.5 * (here.pressure + before.pressure), rel=1e-6, abs=1e-6)
    assert found.md[-1] == pytest.approx(here.md)
    assert isinstance(found.ledger, pd.DataFrame)
    assert (here.pressure < 0).any()
    assert (here.pressure > 0).any()
