"""Closed and open pipes: the flow through the bore in closed form, and mud that is neither lost nor made."""

import numpy as np
import pytest
from scipy.integrate import quad

from references.hydraulics.flow import Annulus, Mud
from references.hydraulics.tripping import bore_flow, closed, open_ended

ANNULUS, BORE = Annulus(0.0635, 0.108), 0.0543
MUD = Mud(2.0, 0.35, 0.64)


@pytest.mark.parametrize("mud", [Mud(0.0, 0.02, 1.0), Mud(3.0, 0.03, 1.0), MUD])
def test_bore_by_integration(mud: Mud) -> None:
    """∫ π r² γ dr, and nothing below the yield stress."""
    gradient = 200.0
    edge = 2 * mud.yield_stress / gradient
    flow = quad(lambda r: np.pi * r**2 * mud.shear_rate(np.array(0.5 * gradient * r)), edge, BORE)[0]
    assert bore_flow(BORE, mud, gradient) == pytest.approx(flow, rel=1e-9)
    assert bore_flow(BORE, mud, -gradient) == -bore_flow(BORE, mud, gradient)
    assert bore_flow(BORE, mud, 1.99 * mud.yield_stress / BORE) == 0.0


@pytest.mark.parametrize("speed", [0.5, -0.5])
def test_open_pipe_shares_the_flow_at_equal_pressure(speed: float) -> None:
    answer, through = open_ended(ANNULUS, BORE, MUD, speed)
    assert bore_flow(BORE, MUD, answer.gradient) == pytest.approx(through, rel=1e-9)
    assert 0 < answer.gradient / closed(ANNULUS, MUD, speed).gradient < 1
    assert through / (ANNULUS.displaced * speed) > 0


def test_a_bore_too_narrow_to_flow_is_closed() -> None:
    answer, through = open_ended(ANNULUS, 0.002, MUD, 0.5)
    assert through == 0.0
    assert answer == closed(ANNULUS, MUD, 0.5)
