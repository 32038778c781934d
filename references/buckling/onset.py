"""Compression at which a pipe on the low side of its hole buckles, in closed form.

Lateral buckling on the wall: a pipe that turns by a small angle θ(s) up the wall rises by rθ²/2, so its weight acts
as an elastic foundation of q/r a unit of lateral displacement rθ, and EI r θ'''' + F r θ'' + q θ = 0.
Forces are compressive and positive [N].
"""

from typing import NamedTuple

import numpy as np


class Pipe(NamedTuple):
    """A pipe in its hole.

    EI [N m²] : bending stiffness; weight [N/m] : buoyed, > 0; clearance [m] : radius of the hole less that of the pipe.
    """

    EI: float
    weight: float
    clearance: float

    @property
    def onset(self) -> float:
        """2√(EI w/r) [N], the onset of snaking in a level hole (Dawson & Paslay 1984)."""
        return snaking_limit(self)

    @property
    def wave(self) -> float:
        """(EI r/w)^¼ [m], the length of the wave over 2π at the onset in a level hole."""
        return float((self.EI * self.clearance / self.weight) ** 0.25)

    @property
    def vertical(self) -> float:
        """(EI w²)^⅓ [N], the unit of force of a vertical pipe (Lubinski 1950)."""
        return float((self.EI * self.weight**2) ** (1 / 3))


# A pipe with a free lower end is a half-infinite beam on a foundation: it buckles at half the force (Hetényi 1946).
FREE_END = 0.5


def snaking_limit(pipe: Pipe, inclination: float = 0.5 * np.pi, build: float = 0.0) -> float:
    """Onset of snaking [N] at an inclination [rad], in a hole that builds by ``build`` [rad/m] (≥ 0).

    Compression F presses the pipe on the outer, low side of a build: q = w sin α + F κ.  With F = 2√(EI q/r)
    (Dawson & Paslay 1984) that is a quadratic equation for F, here solved so that κ → 0 loses no digits:
    F = (2EIκ/r)(1 + √(1 + r w sin α/(EI κ²))) (He & Kyllingstad 1995).
    """
    curved = pipe.EI * build / pipe.clearance
    straight = np.sqrt(pipe.EI * pipe.weight * np.sin(inclination) / pipe.clearance)
    return float(2 * (curved + np.hypot(curved, straight)))


def half_wave(pipe: Pipe, inclination: float = 0.5 * np.pi) -> float:
    """Half wave of snaking at the onset [m], π(EI r/(w sin α))^¼, in a straight hole."""
    return float(np.pi * pipe.wave / np.sin(inclination) ** 0.25)
