"""Bending to and fro of drill pipe that turns in a dog-leg (Lubinski 1961; API RP 7G, 8.1).

The stress amplitudes are those that RP 7G bears without end in air: mud lowers them, and those who wrote later editions
doubt them.  They are told beside what is computed, and nothing is judged by them.
"""

import math

from fctd.case.pipes.grades import OF_DRILL_PIPE
from fctd.model.capacity import PSI

# Yield strengths within this share are those of a grade.
SAME = 0.01


def endless_amplitude(yield_strength: float, tension_stress: float) -> float | None:
    """Amplitude of the bending stress [Pa] that drill pipe bears without end in air under a tension [Pa].

    Of the grades E-75 and S-135, by their yield strength [Pa]; None of others.  0 where the tension leaves nothing.
    """
    of_tension = tension_stress / PSI
    grades = {name: 1e3 * ksi * PSI for name, ksi in OF_DRILL_PIPE.items()}
    if math.isclose(yield_strength, grades["E-75"], rel_tol=SAME):
        bears = 19500 - 10 / 67 * of_tension - 0.6 / 670**2 * (of_tension - 33500) ** 2
    elif math.isclose(yield_strength, grades["S-135"], rel_tol=SAME):
        bears = 20000 * (1 - of_tension / 145000)
    else:
        return None
    return max(bears, 0.0) * PSI


def dogleg_of(stress: float, tension: float, outer: float, stiffness: float, modulus: float, joint: float) -> float:
    """Curvature of a hole [1/m] that bends pipe to a stress [Pa] at its tool joints, where tension bends it most.

    tension [N]; outer diameter, length of a joint [m]; stiffness EI [N m²]; modulus E [Pa].
    """
    x = 0.5 * joint * math.sqrt(max(tension, 0.0) / stiffness)
    return 2 * stress / (modulus * outer) * (math.tanh(x) / x if x > 0 else 1.0)
