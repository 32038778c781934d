"""What pipe bears: tension, torsion, both together, burst, collapse, and tension in the slips (API RP 7G, TR 5C3).

Capacities are computed from geometry and yield strength; none is copied from a table.  They agree with the tables that
are printed by API's conventions: shear yields at 0.577 of the yield strength, burst of new pipe allows for a wall that
is an eighth thinner, burst of worn pipe has its own wall and the nominal diameter.  Collapse is that of API TR 5C3
(2008, the same as ISO 10400), whose four regimes are fitted to steel.
"""

import math
from dataclasses import dataclass
from typing import Final

from fctd.case.pipes.catalogue import Pipe
from fctd.case.pipes.grades import KSI

PSI: Final = KSI / 1e3  # [Pa]
SHEAR: Final = 0.577  # of the yield strength, API's 1/√3
ELASTIC: Final = 46.95e6  # of steel [psi]
# Young's modulus [Pa] and Poisson's ratio of steel, and how far another steel's modulus may be from it.
STEEL_MODULUS, STEEL_RATIO, STEEL_WITHIN = 206.8e9, 0.3, 0.1
# Yield strengths for which the polynomials of TR 5C3 serve [psi].  Below some 17 ksi the bounds of its regimes lose
# their order, and the pressures between them their sense.
FITTED: Final = 20e3, 200e3
THINNEST: Final = 0.875  # of the nominal wall, of new pipe
# The wedge of a slip: its taper, 9° 27′ 45″, and the friction of its back; Reinhold & Spiri (1959).
SLIP_TAPER, SLIP_FRICTION = math.radians(9 + 27 / 60 + 45 / 3600), 0.08


@dataclass(frozen=True)
class Body:
    """The body of a pipe: diameters [m], yield strength and Young's modulus [Pa], Poisson's ratio.

    wall_share : of the nominal wall that is left, as wear takes it from outside; ``outer`` is the nominal diameter.
    """

    outer: float
    inner: float
    yield_strength: float
    wall_share: float = 1.0
    modulus: float = STEEL_MODULUS
    poisson: float = STEEL_RATIO

    @property
    def wall(self) -> float:
        """The wall that is left [m]."""
        return 0.5 * self.wall_share * (self.outer - self.inner)

    @property
    def worn_outer(self) -> float:
        """Outer diameter with the wall that is left [m]."""
        return self.inner + 2 * self.wall

    @property
    def area(self) -> float:
        """Of the steel [m²]."""
        return math.pi / 4 * (self.worn_outer**2 - self.inner**2)

    @property
    def section_modulus(self) -> float:
        """Bending moment over the stress at the outer fibre [m³]."""
        return math.pi / 32 * (self.worn_outer**4 - self.inner**4) / self.worn_outer

    @property
    def is_steel(self) -> bool:
        """Whether its modulus is that of a steel."""
        return abs(self.modulus / STEEL_MODULUS - 1) <= STEEL_WITHIN

    @property
    def tension(self) -> float:
        """Tension at which the body yields [N]."""
        return self.yield_strength * self.area

    @property
    def torsion(self) -> float:
        """Torque at which the outer wall yields [N m]."""
        return self.torsion_under(0.0)

    def torsion_under(self, tension: float) -> float:
        """Torque at which the outer wall yields under a tension [N] (RP 7G A.9.2) [N m]; 0 beyond its capacity."""
        left = self.yield_strength**2 - (tension / self.area) ** 2
        return SHEAR * 2 * self.section_modulus * math.sqrt(max(left, 0.0))

    @property
    def burst(self) -> float:
        """Pressure inside at which the body yields (Barlow) [Pa]."""
        share = THINNEST if self.wall_share == 1.0 else 1.0
        return burst_of(self.yield_strength, self.outer, share * self.wall)

    @property
    def collapse(self) -> float:
        """Pressure outside at which the body collapses (API TR 5C3, minimum values) [Pa].

        A body of another material than steel yields, or collapses elastically at a pressure in proportion to
        E/(1 − ν²): the regimes between both are fitted to steel.
        """
        strength, ratio = self.yield_strength / PSI, self.worn_outer / self.wall
        if self.is_steel:
            return PSI * collapse_of(strength, ratio)
        softer = self.modulus / STEEL_MODULUS * (1 - STEEL_RATIO**2) / (1 - self.poisson**2)
        return PSI * min(2 * strength * (ratio - 1) / ratio**2, softer * ELASTIC / (ratio * (ratio - 1) ** 2))

    def tension_in_slips(self, length: float, friction: float = SLIP_FRICTION) -> float:
        """Tension at which slips of a length [m] crush the body (Reinhold & Spiri 1959) [N].

        It is too high by about a fifth beside tests of slips that do not grip evenly (IADC/SPE 74488).
        """
        gripping = 1 / math.tan(SLIP_TAPER + math.atan(friction))
        x = self.worn_outer * gripping / (2 * length)
        return self.tension / math.sqrt(1 + x + x * x)


def body_of(pipe: Pipe) -> Body | None:
    """The body of a pipe of the catalogue; None without a grade."""
    if pipe.yield_strength is None:
        return None
    return Body(pipe.outer, pipe.inner, pipe.yield_strength, pipe.wall_share)


def burst_of(yield_strength: float, outer: float, wall: float) -> float:
    """Pressure inside at which a pipe yields by Barlow's formula, 2 Y t/D [Pa]; diameter and wall [m]."""
    return 2 * yield_strength * wall / outer


def collapse_of(strength: float, ratio: float) -> float:
    """Collapse pressure of steel [psi] by yield strength [psi] and ratio of diameter to wall; also compiled.

    Of TR 5C3's four regimes.  Below the strengths of ``FITTED`` it is in proportion to the strength, above them it is
    that of the largest: so it stays continuous, and on the safe side of yield and of elastic collapse.
    """
    y = min(max(strength, FITTED[0]), FITTED[1])
    below = min(strength / y, 1.0)
    a = 2.8762 + 0.10679e-5 * y + 0.21301e-10 * y**2 - 0.53132e-16 * y**3
    b = 0.026233 + 0.50609e-6 * y
    c = -465.93 + 0.030867 * y - 0.10483e-7 * y**2 + 0.36989e-13 * y**3
    at = 3 * (b / a) / (2 + b / a)
    f = ELASTIC * at**3 / (y * (at - b / a) * (1 - at) ** 2)
    g = f * b / a
    of_yield = (math.sqrt((a - 2) ** 2 + 8 * (b + c / y)) + a - 2) / (2 * (b + c / y))
    if ratio <= of_yield:
        return below * 2 * y * (ratio - 1) / ratio**2
    if ratio <= y * (a - f) / (c + y * (b - g)):
        return below * (y * (a / ratio - b) - c)
    if ratio <= (2 + b / a) / (3 * b / a):
        return below * y * (f / ratio - g)
    return below * ELASTIC / (ratio * (ratio - 1) ** 2)
