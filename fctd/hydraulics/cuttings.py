"""Cuttings in the annulus: how fast they sink, how fast they rise with the mud, and what they weigh there.

An estimate for hole within 30° of vertical: in a steeper hole cuttings lie on the low side, and no slip velocity says
how the mud moves them.  Rotation, which helps, is left out.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array
from fctd.case.rheology import Rheology
from fctd.mechanics.topdrive import GRAVITY

STEEPEST: Final = np.radians(30.0)  # inclination up to which cuttings sink along the hole
# Least share of the mud's speed at which cuttings count as carried.
CARRIED: Final = 0.05


class Cuttings(NamedTuple):
    """What the bit cuts: rate of penetration [m/s], size [m] and density of the pieces [kg/m³]."""

    rate: float
    size: float = 0.00635
    density: float = 2600.0


def slip_speed(cuttings: Cuttings, viscosity: ArrayLike, density: ArrayLike) -> Array:
    """Speed (n,) at which cuttings sink in a mud at rest [m/s]; Moore 1974 (Bourgoyne et al. 1986, section 4.14).

    viscosity : apparent viscosity of the mud [Pa s]; density [kg/m³].  The friction factor of a piece is the largest of
    Moore's three, 40/Re, 22/√Re and 1.5; 0 where the mud is as dense as the pieces.
    """
    viscosity, density = np.asarray(viscosity, float), np.asarray(density, float)
    pull = 4 / 3 * GRAVITY * np.maximum(cuttings.density - density, 0.0) * cuttings.size
    slow = pull * cuttings.size / (40 * viscosity)
    between = (pull / 22 * np.sqrt(cuttings.size / (viscosity * density))) ** (2 / 3)
    return np.asarray(np.minimum(np.minimum(slow, between), np.sqrt(pull / (1.5 * density))))


def transport_ratio(
    cuttings: Cuttings, rheology: Rheology, density: ArrayLike, speed: Array, gap: ArrayLike, inclination: Array
) -> Array:
    """Speed of cuttings over that of the mud (n,) in annuli, negative where they sink; NaN where the hole is steep.

    speed : of the mud upwards [m/s]; gap : difference of radii [m]; inclination [rad].
    """
    rate = np.maximum(6 * np.abs(speed) / np.asarray(gap), 1e-3)
    slip = slip_speed(cuttings, rheology.stress(rate) / rate, density)
    ratio = 1 - slip / np.where(speed > 0, speed, np.nan)
    return np.where(inclination <= STEEPEST, ratio, np.nan)


def share_of_cuttings(cuttings: Cuttings, ratio: Array, bit_area: float, flow: float) -> Array:
    """Share (n,) of the annulus's volume that cuttings take (Bourgoyne et al. 1986, equation 4.138), 0 in steep hole.

    bit_area : of the hole at the bit [m²]; flow [m³/s].  Where they are hardly carried they pile up: the share is that
    of a ratio of 0.05.
    """
    cut = bit_area * cuttings.rate
    feed = cut / (cut + flow)
    carried = np.maximum(ratio, CARRIED)
    return np.where(np.isnan(ratio), 0.0, np.minimum(feed / np.where(np.isnan(ratio), 1.0, carried), 0.5))
