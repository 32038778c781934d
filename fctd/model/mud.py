"""Viscous mud around a string: damping around and sideways, and the mud that moves with it.

Flow is laminar, the annulus concentric and at rest but for the string; eccentricity, tool joints and flow would add to
the coefficients.  What mud does to motion along the hole, which displaces it, is in ``fctd.hydraulics``.
"""

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array
from fctd.model.pieces import RADIUS, TO_MD
from fctd.model.sampled_hole import mean_radii
from fctd.model.wellbore import Wellbore

# A string at rest is struck and swings at about this frequency [Hz].
AT_REST = 1.0
# Largest share of the hole's radius: the coefficients grow without bound where a body fills its hole.  With this they
# are those of 2 mm around a stabiliser; what a gauge tool wedges in less is contact, not a film of mud.
FULLEST = 0.98


def lateral_damping(
    radius: ArrayLike, hole: ArrayLike, density: ArrayLike, viscosity: float, frequency: float = AT_REST
) -> Array:
    """Damping of lateral motion per metre [N s/m²] of cylinders of ``radius`` in holes [m], by the boundary layers.

    density [kg/m³]; viscosity [Pa s]; frequency of the motion [Hz].  Chen, Wambsganss & Jendrzejczyk 1976, for layers
    that are thin beside the gap.
    """
    radius = np.asarray(radius, float)
    k = filled(radius, hole)
    around = np.asarray(density, float)
    layer = np.sqrt(viscosity / np.where(around > 0, around, np.inf) * frequency)
    return np.asarray(4 * np.pi**1.5 * around * radius * layer * (1 + k**3) / (1 - k**2) ** 2)


def added_mass(
    radius: ArrayLike, inner: ArrayLike, hole: ArrayLike, density: ArrayLike, inside: ArrayLike | None = None
) -> Array:
    """Mass of mud per metre [kg/m] that moves sideways with pipes of outer and inner radius [m] in holes [m].

    density, inside : of the mud outside, and of that inside where it is another [kg/m³].  The mud inside moves with the
    pipe; that outside flows around it (potential flow in a concentric annulus).
    """
    radius, inner = np.asarray(radius, float), np.asarray(inner, float)
    k, outside = filled(radius, hole), np.asarray(density, float)
    alike = outside * np.pi * (radius**2 * (1 + k**2) / (1 - k**2) + inner**2)
    return np.asarray(alike if inside is None else alike + (np.asarray(inside) - outside) * np.pi * inner**2)


def resistance(radius: ArrayLike, hole: ArrayLike, viscosity: float) -> Array:
    """Damping per metre of steady rotation [N s] (Couette flow)."""
    k = filled(radius, hole)
    return np.asarray(4 * np.pi * viscosity * np.asarray(radius, float) ** 2 / (1 - k**2))


def layer_drag(
    radius: ArrayLike, inner: ArrayLike, density: ArrayLike, viscosity: float, rate: float,
    inside: ArrayLike | None = None,
) -> Array:  # fmt: skip
    """Drag per metre [N s/m²] of the mud's boundary layers by their lag, on pipes of outer and inner radius [m].

    density, inside : of the mud outside, and of that inside where it is another [kg/m³].

    rate [1/s] : angular frequency at which both parts of it, drag and mass, are those of a plane wall that swings along
    itself, (1 + i) √(ρμω/2) on a unit of area (Stokes 1851).  The layers, √(2ν/ω) thick, are thin beside the pipe.
    """
    radius, inner = np.asarray(radius, float), np.asarray(inner, float)
    outside = np.sqrt(2 * np.asarray(density) * viscosity * rate)
    alike = 2 * np.pi * (radius + inner) * outside
    if inside is None:
        return np.asarray(alike)
    return np.asarray(alike + 2 * np.pi * inner * (np.sqrt(2 * np.asarray(inside) * viscosity * rate) - outside))


def filled(radius: ArrayLike, hole: ArrayLike, most: float = FULLEST) -> Array:
    """Radius of the string over that of its hole, at most ``most``."""
    return np.asarray(np.minimum(np.asarray(radius, float) / np.asarray(hole, float), most))


def hole_radius(hole: Wellbore, top_md: float, length: Array) -> Array:
    """Radius of the hole (n,) [m] beside segments of these lengths [m] below ``top_md``.

    It is that of the interval beside the middle of a segment, and in a hole that is not round the mean over the segment
    of circles of the same area.
    """
    bottom = top_md + np.cumsum(length)
    if not hole.is_round:
        return mean_radii(hole.wall_along(), bottom - length, bottom)
    index = np.searchsorted(hole.intervals[:, TO_MD], bottom - 0.5 * length)
    return np.asarray(hole.intervals[np.minimum(index, len(hole.intervals) - 1), RADIUS])
