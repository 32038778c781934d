"""Closed forms of friction: exact limits, signs, and published examples."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.rheology import Rheology
from fctd.hydraulics.closed_forms import LAMINAR, REGIMES, TRANSITIONAL, TURBULENT, Loss, annulus, bore, clinging
from references.hydraulics.flow import Annulus, Mud
from references.hydraulics.quadrature import solve

INCH, FT, PSI, PPG, GPM, FANN = 0.0254, 0.3048, 6894.757, 119.8264, 6.30902e-5, 0.511
PIPE, HOLE = 2.5 * INCH, 4.25 * INCH
# 60, 40, 8 and 6 of the viscometer by RP 13D's rule: yield stress 2 θ3 − θ6.
INDEX = float(np.log2((60 - 4) / (40 - 4)))
MUD = Rheology(4 * FANN, 36 * FANN / 511**INDEX, INDEX)


def exact_newtonian(
    outer: float, hole: float, viscosity: float, flow: float, speed: float = 0.0
) -> tuple[float, float]:
    """Gradient and lift of laminar flow in a concentric annulus whose inner wall moves (Bird, Stewart & Lightfoot)."""
    widening = np.log(hole / outer)
    conductance = np.pi / (8 * viscosity) * (hole**4 - outer**4 - (hole**2 - outer**2) ** 2 / widening)
    dragged = np.pi * speed * ((hole**2 - outer**2) / (2 * widening) - outer**2)  # the wall's, against `flow`
    gradient = (flow + dragged) / conductance
    lift = np.pi * (hole**2 - outer**2) / (2 * widening) * gradient + 2 * np.pi * viscosity * speed / widening
    return float(gradient), float(lift)


def test_clinging_constant_is_exact() -> None:
    """Four ratios as printed in closed form; half the speed in a slot, none around a wire."""
    assert clinging([0.3, 0.5, 0.7, 0.9]).tolist() == pytest.approx([0.3164, 0.3880, 0.4411, 0.4825], abs=1e-4)
    assert clinging([1 - 1e-6, 1e-100]).tolist() == pytest.approx([0.5, 0.002], abs=3e-4)


@given(st.floats(0.005, 0.2), st.floats(1e-3, 0.2), st.floats(1e-5, 1e-3))
def test_laminar_newtonian_flow_in_a_bore_is_poiseuilles(radius: float, viscosity: float, flow: float) -> None:
    found = bore(radius, Rheology.newtonian(viscosity), 0.0, flow)
    assert found.gradient == pytest.approx(8 * viscosity * flow / (np.pi * radius**4), rel=1e-12)
    assert [part.item() for part in found[1:]] == [0.0, LAMINAR, 0.0]


@given(st.floats(0.3, 0.98), st.floats(1e-3, 0.2), st.floats(-0.05, 0.05), st.floats(-2.0, 2.0))
def test_laminar_newtonian_flow_in_an_annulus_is_that_of_a_slot(
    ratio: float, viscosity: float, flow: float, speed: float
) -> None:
    """Mean velocity and moving wall count exactly; the conductance of the slot is at most 2.5 % below."""
    found = annulus(ratio * 0.1, 0.1, Rheology.newtonian(viscosity), 0.0, flow, speed)
    area = np.pi * 0.01 * (1 - ratio**2)
    slot = 12 * viscosity / (0.1 * (1 - ratio)) ** 2 * (flow / area + float(clinging(ratio)) * speed)
    assert found.gradient == pytest.approx(slot, rel=1e-9, abs=1e-12)
    gradient, lift = exact_newtonian(ratio * 0.1, 0.1, viscosity, flow, speed)
    assert found.gradient == pytest.approx(gradient, rel=0.025, abs=1e-12)
    more = np.pi * 0.01 * (1 - ratio**2) / (-2 * np.log(ratio)) * (found.gradient - gradient)
    assert found.lift == pytest.approx(lift + more, rel=1e-9, abs=1e-9)


def test_a_newtonian_mud_in_an_annulus_of_the_field() -> None:
    """5 in × 8½ in, 25 L/s of 20 mPa s without inertia: 126.251 Pa/m exactly, a slot 0.46 % more."""
    exact, _ = exact_newtonian(PIPE, HOLE, 0.02, 0.025)
    assert exact == pytest.approx(126.251, abs=1e-3)
    assert annulus(PIPE, HOLE, Rheology.newtonian(0.02), 0.0, 0.025).gradient / exact == pytest.approx(1.0046, abs=1e-4)


def test_yield_power_law_against_the_exact_flow() -> None:
    """10,000 ft of 5 in in 8½ in, 400 gpm, 12 ppg: RP 13D 233.4 psi (exactly 235.3), lift 36.2 kN; bore 537.6 psi."""
    found = annulus(PIPE, HOLE, MUD, 12 * PPG, 400 * GPM)
    assert found.gradient * 1e4 * FT / PSI == pytest.approx(233.4, abs=0.3)
    assert found.lift * 1e4 * FT == pytest.approx(36.2e3, rel=0.01)
    inside = bore(2.138 * INCH, MUD, 12 * PPG, 400 * GPM)
    assert inside.gradient * 1e4 * FT / PSI == pytest.approx(537.6, rel=1e-3)
    assert (found.regime.item(), inside.regime.item()) == (LAMINAR, TURBULENT)


def test_closed_pipe_pushes_mud_past_itself() -> None:
    """Casing of 10¾ in in 14¾ in at 110 ft/min: lift 25.6 kN in 2,000 m of a Newtonian mud of 37 cP; 91.0 psi in 6,400
    ft of a Bingham mud (κ v added to the mean velocity, as Burkhardt 1961; exactly 88.5)."""
    outer, hole, speed = 5.375 * INCH, 7.375 * INCH, 110 * FT / 60
    displaced = np.pi * outer**2 * speed
    newtonian = annulus(outer, hole, Rheology.newtonian(0.037), 1000.0, displaced, speed)
    assert newtonian.lift * 2000 == pytest.approx(25.6e3, rel=0.005)
    bingham = annulus(outer, hole, Rheology(6 * 0.4788, 0.037, 1.0), 15.5 * PPG, displaced, speed)
    assert bingham.gradient * 6400 * FT / PSI == pytest.approx(91.0, rel=0.002)
    assert (newtonian.regime.item(), bingham.regime.item()) == (LAMINAR, LAMINAR)


def test_turbulent_newtonian_flow_in_a_bore_is_blasiuss() -> None:
    speed, density, viscosity = 3.0, 1000.0, 1e-3
    found = bore(0.05, Rheology.newtonian(viscosity), density, np.pi * 0.05**2 * speed)
    friction = 0.0791 * (density * speed * 0.1 / viscosity) ** -0.25
    assert found.gradient == pytest.approx(2 * friction * density * speed**2 / 0.1, rel=0.01)


@pytest.mark.parametrize(("reynolds", "smooth", "rough"), [(1e5, 2, 12), (3e5, 7, 24), (6.4e5, 12, 34), (1e6, 15, 40)])
def test_water_in_a_bore_loses_less_than_in_pipe_by_what_the_guide_says(
    reynolds: float, smooth: int, rough: int
) -> None:
    """Per cent below Colebrook (1939), 5 in pipe smooth and with 0.046 mm, as docs/hydraulics.md has them."""
    wide = 4.276 * INCH
    speed = reynolds * 1e-3 / (1000.0 * wide)
    found = float(bore(0.5 * wide, Rheology.newtonian(1e-3), 1000.0, np.pi / 4 * wide**2 * speed).gradient)
    for roughness, below in ((0.0, smooth), (0.046e-3, rough)):
        root = 0.1  # of Darcy's friction factor
        for _ in range(50):
            root = 1 / (-2 * np.log10(roughness / wide / 3.7 + 2.51 / (reynolds * root)))
        assert round(100 * (1 - found / (root**2 * 500.0 * speed**2 / wide))) == below


@pytest.mark.parametrize("index", [0.4, 0.7, 1.0, 1 / 3])
@pytest.mark.parametrize("ratio", [0.3, 0.6, 0.9])
def test_clinging_constant_of_a_power_law(ratio: float, index: float) -> None:
    """The mean velocity of mud that the pipe alone moves, by the trapezoidal rule: r τ is constant, γ ∝ r^(−1/n)."""
    radius = np.linspace(ratio, 1.0, 20_001)
    velocity = np.append(np.cumsum(0.5 * (radius[1:] ** (-1 / index) + radius[:-1] ** (-1 / index))[::-1])[::-1], 0.0)
    mean = np.trapezoid(velocity / velocity[0] * radius, radius) * 2 / (1 - ratio**2)
    assert clinging(ratio, index) == pytest.approx(mean, rel=1e-5)
    assert clinging(ratio, 1 - 1e-9) == pytest.approx(float(clinging(ratio)), rel=1e-8)


@pytest.mark.parametrize("mud", [MUD, Rheology(5.0, 0.1, 0.8), Rheology(0.0, 0.6, 0.5)])
@pytest.mark.parametrize("ratio", [0.6, 0.85])
def test_pressure_has_no_jump_where_flow_and_drag_cancel(mud: Rheology, ratio: float) -> None:
    """From mud that a pipe alone moves to a closed pipe: exact to 0.4 of the stress at the walls, and 0.05 closed."""
    exact, speed = Annulus(ratio * 0.1, 0.1), 0.5
    flow = np.linspace(-float(clinging(ratio)) * exact.area * speed, exact.displaced * speed, 201)
    found = annulus(exact.pipe, exact.hole, mud, 1e-6, flow, speed)
    assert (np.diff(found.gradient) > 0).all()
    assert np.diff(found.gradient).max() < 0.1 * found.gradient.max()
    for k in range(0, 201, 20):
        answer = solve(exact, Mud(*mud), float(flow[k]), speed)
        full = 2 * max(abs(answer.pipe_stress), abs(answer.hole_stress)) / exact.gap
        assert found.gradient[k] == pytest.approx(answer.gradient, abs=(0.05 if k == 200 else 0.4) * full)


@dataclass(frozen=True)
class Flows:
    """Annulus and flow of a random well."""

    outer: float
    rheology: Rheology
    density: float
    flow: float
    speed: float
    eccentricity: float

    def loss(self, factor: float = 1.0) -> Loss:
        """Loss with flow and speed times a factor, in a hole of 0.1 m radius."""
        flow, speed = factor * self.flow, factor * self.speed
        return annulus(self.outer, 0.1, self.rheology, self.density, flow, speed, self.eccentricity)


MUDS = st.builds(Rheology, st.floats(0.0, 20.0), st.floats(0.0, 2.0), st.floats(0.2, 1.2))
FLOWS = st.builds(
    Flows, st.floats(0.02, 0.1), MUDS, st.floats(0.0, 2500.0), st.floats(-0.1, 0.1), st.floats(-3.0, 3.0),
    st.floats(0.0, 1.0),
)  # fmt: skip


@given(FLOWS)
def test_losses_are_odd_in_flow_and_speed_together_and_finite(flows: Flows) -> None:
    there, back, rest = flows.loss(), flows.loss(-1.0), flows.loss(0.0)
    assert (there.gradient, there.lift) == (-back.gradient, -back.lift)
    assert there[2:] == back[2:]
    assert [part.item() for part in rest[:3]] == [0.0, 0.0, LAMINAR]
    assert np.isfinite(there).all()
    assert 0 <= there.yield_share <= 1


@pytest.mark.parametrize("mud", [Rheology.newtonian(0.02), MUD, Rheology(0.0, 0.6, 0.5)])
@pytest.mark.parametrize("eccentricity", [0.0, 0.8])
def test_pressure_and_lift_grow_without_jumps_over_the_regimes(mud: Rheology, eccentricity: float) -> None:
    flow = np.geomspace(1e-3, 0.5, 2000)
    for found in (annulus(PIPE, HOLE, mud, 1400.0, flow, 0.0, eccentricity), bore(0.05, mud, 1400.0, flow)):
        assert set(found.regime.tolist()) == {LAMINAR, TRANSITIONAL, TURBULENT} == set(range(len(REGIMES)))
        assert (np.diff(found.regime) >= 0).all()
        steps = np.diff(np.log(found.gradient)) / np.diff(np.log(flow))
        assert steps.min() > 0
        assert steps.max() < 8.0


def test_eccentricity_lowers_the_pressure() -> None:
    """Of a Newtonian mud in a narrow annulus laminar flow has 1 / (1 + 1.5 e²) of it, the factor within 5 %."""
    e = np.linspace(0.0, 1.0, 11)
    found = annulus(0.085, 0.1, Rheology.newtonian(0.02), 0.0, 0.01, 0.0, e)
    assert found.gradient / found.gradient[0] == pytest.approx(1 / (1 + 1.5 * e**2), rel=0.05)
    fast = annulus(0.085, 0.1, Rheology.newtonian(1e-3), 1000.0, 0.1, 0.0, np.array([0.0, 0.9]))
    assert fast.regime.tolist() == [TURBULENT] * 2
    assert fast.gradient[1] / fast.gradient[0] == pytest.approx(0.68, abs=0.05)  # Haciislamoglu & Cartalos 1994


def test_a_hole_that_is_filled_has_finite_losses() -> None:
    found = annulus([0.1, 0.1 - 1e-9, 0.11], 0.1, MUD, 1200.0, 0.01, 0.5, 1.0)
    assert np.isfinite(found).all()


def test_a_mud_without_stress_loses_nothing_and_a_solid_bar_neither() -> None:
    still = annulus(PIPE, HOLE, Rheology.newtonian(0.0), 1200.0, 0.03, 1.0)
    assert [part.item() for part in still[:2]] == [0.0, 0.0]
    assert bore([0.0, 0.05], MUD, 1200.0, 0.0).gradient.tolist() == [0.0, 0.0]
