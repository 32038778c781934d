"""A pipe that moves along its hole: closed below, or open, with mud that flows up its bore.

Mud is incompressible and at rest below the bit, so that what the pipe displaces flows up annulus and bore.
"""

import numpy as np
from scipy.optimize import brentq

from references.hydraulics import quadrature
from references.hydraulics.flow import Annulus, Answer, Mud


def closed(annulus: Annulus, mud: Mud, speed: float) -> Answer:
    """A closed pipe that moves down at a speed [m/s]: the annulus takes all that it displaces."""
    return quadrature.solve(annulus, mud, annulus.displaced * speed, speed)


def open_ended(annulus: Annulus, bore: float, mud: Mud, speed: float) -> tuple[Answer, float]:
    """An open pipe with a bore of radius ``bore`` [m], and the flow [m³/s] up the bore relative to the pipe.

    Annulus and bore lose the same pressure, since both begin at the bit and end at the surface.  The gradient lies
    between zero and that of a closed pipe; up to the yield stress the bore stands.
    """
    if speed < 0:
        flow = -open_ended(annulus, bore, mud, -speed)[1]
        return quadrature.solve(annulus, mud, annulus.displaced * speed - flow, speed), flow
    highest = closed(annulus, mud, speed).gradient

    def beside(gradient: float) -> Answer:
        return quadrature.solve(annulus, mud, annulus.displaced * speed - bore_flow(bore, mud, gradient), speed)

    if highest == 0:
        return closed(annulus, mud, speed), 0.0
    shared = brentq(lambda gradient: beside(gradient).gradient - gradient, 0.0, highest, xtol=1e-12 * highest)
    return beside(shared), bore_flow(bore, mud, shared)


def bore_flow(bore: float, mud: Mud, gradient: float) -> float:
    """Laminar flow [m³/s] through a bore of radius ``bore`` [m] that loses ``gradient`` [Pa/m] along the flow.

    With s the yield stress over that at the wall, q = π R³ n γ_w (1−s) [(1−s)²/(3n+1) + 2s(1−s)/(2n+1) + s²/(n+1)]
    (Skelland 1967), and γ_w the rate at the wall.
    """
    wall = 0.5 * abs(gradient) * bore
    if wall <= mud.yield_stress:
        return 0.0
    n, s = mud.index, mud.yield_stress / wall
    shape = (1 - s) ** 2 / (3 * n + 1) + 2 * s * (1 - s) / (2 * n + 1) + s**2 / (n + 1)
    rate = float(mud.shear_rate(np.array(wall)))
    return float(np.sign(gradient) * np.pi * bore**3 * n * rate * (1 - s) * shape)
