"""Textbook oracles: answers by their authors' own formulae, in the units of the field.

Guo & Liu, Applied Drilling Circulation Systems (2011), and Lapeyrouse, Formulas and Calculations for Drilling,
Production and Workover.  Pressures [psi], lengths [ft], diameters [in], densities [lb/gal], flow [gal/min].
"""

from collections.abc import Mapping

import numpy as np

from references.hydraulics.flow import Mud

INCH, FOOT, PSI, POUND_FORCE = 0.0254, 0.3048, 6894.757293168, 4.4482216152605
GALLON_A_MINUTE = 231 * INCH**3 / 60
FANN_DEGREE = 1.066 * POUND_FORCE / (100 * FOOT**2)  # [Pa] at the bob of a viscometer
YIELD_UNIT = POUND_FORCE / (100 * FOOT**2)  # [Pa] of a yield point in lbf/100 ft²


def yield_power_law(fann: Mapping[int, float]) -> Mud:
    """Herschel-Bulkley from the readings at 600, 300, 6 and 3 rev/min (Guo & Liu 2.11–2.14, a degree as in RP 13D)."""
    yielding = 2 * fann[3] - fann[6]
    n = 3.32 * np.log10((fann[600] - yielding) / (fann[300] - yielding))
    consistency = (fann[300] - yielding) / 511**n
    return Mud(yielding * FANN_DEGREE, float(consistency * FANN_DEGREE), float(n))


def turbulent_bore(density: float, flow: float, bore: float, viscosity: float, length: float) -> float:
    """Loss [psi] of a Bingham mud in turbulent flow, ρ^¾ v^1.75 μ^¼/(1800 d^1.25) (Guo & Liu, chapter 2)."""
    velocity = flow / (2.448 * bore**2)  # [ft/s]
    return float(density**0.75 * velocity**1.75 * viscosity**0.25 / (1800 * bore**1.25) * length)


def laminar_annulus(
    viscosity: float, yield_point: float, velocity: float, hole: float, pipe: float, length: float
) -> float:
    """Loss [psi] of a Bingham mud at a mean velocity [ft/s], [μv/(1000 g²) + τ_y/(200 g)] L (Guo & Liu, chapter 2)."""
    gap = hole - pipe
    return (viscosity * velocity / (1000 * gap**2) + yield_point / (200 * gap)) * length


def nozzles(density: float, flow: float, sizes: tuple[int, ...]) -> float:
    """Loss [psi] at the bit, 156.5 ρQ²/(ΣN²)², nozzles in 1/32 in: a discharge coefficient of 0.95."""
    return 156.5 * density * flow**2 / sum(size**2 for size in sizes) ** 2


def lapeyrouse_surge(fann: Mapping[int, float], hole: float, pipe: float, length: float, speed: float) -> float:
    """Surge [psi] of a plugged pipe run at a speed [ft/min] (Lapeyrouse, surge and swab pressures, method 2).

    v = (0.45 + d²/(D²−d²)) v_p, and 1.5 v at its highest: the author's factor for the acceleration.
    """
    n = 3.32 * np.log10(fann[600] / fann[300])
    consistency = fann[300] / 511**n
    gap = hole - pipe
    highest = 1.5 * (0.45 + pipe**2 / (hole**2 - pipe**2)) * speed
    rate = 2.4 * highest / gap * (2 * n + 1) / (3 * n)
    return float(rate**n * consistency * length / (300 * gap))


def burkhardt_surge(
    viscosity: float, yield_point: float, hole: float, pipe: float, length: float, speed: float, sign: int
) -> float:
    """Surge [psi] of a closed pipe in Bingham mud, run at a speed [ft/min] (Burkhardt 1961, in Guo & Liu 2.8).

    The wall moves down while the mud moves up, so that the effective velocity is v_m + κv_p: ``sign`` = 1.  The book
    subtracts κv_p for a pipe that is run in, ``sign`` = −1, which is why it prints 67 psi for 91.
    """
    pipe_speed = speed / 60
    displaced = pipe**2 / (hole**2 - pipe**2) * pipe_speed
    return laminar_annulus(viscosity, yield_point, displaced + sign * 0.45 * pipe_speed, hole, pipe, length)
