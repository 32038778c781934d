"""Viscous mud around a string: damping along, around and sideways, and the mud that moves sideways with it.

Flow is laminar, the annulus concentric and at rest but for the string; eccentricity, tool joints and flow would add to
the coefficients.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.topdrive import PerMetre

if TYPE_CHECKING:
    from fctd.model.drillstring import String

Array = NDArray[np.float64]

# A string at rest is struck and swings at about this frequency [Hz].
AT_REST = 1.0
# Largest shares of the hole's radius, lateral and steady: the coefficients grow without bound where a body fills its
# hole.  With the first they are those of 2 mm around a stabiliser.
FULLEST, FULL = 0.98, 1 - 1e-6


def lateral_damping(
    radius: ArrayLike, hole: ArrayLike, density: float, viscosity: float, frequency: float = AT_REST
) -> Array:
    """Damping of lateral motion per metre [N s/m²] of cylinders of ``radius`` in holes [m], by the boundary layers.

    density [kg/m³]; viscosity [Pa s]; frequency of the motion [Hz].  Chen, Wambsganss & Jendrzejczyk 1976, for layers
    that are thin beside the gap.
    """
    radius = np.asarray(radius, float)
    k = filled(radius, hole)
    layer = np.sqrt(viscosity / density * frequency)
    return np.asarray(4 * np.pi**1.5 * density * radius * layer * (1 + k**3) / (1 - k**2) ** 2)


def added_mass(radius: ArrayLike, inner: ArrayLike, hole: ArrayLike, density: float) -> Array:
    """Mass of mud per metre [kg/m] that moves sideways with pipes of outer and inner radius [m] in holes [m].

    The mud inside moves with the pipe; that outside flows around it (potential flow in a concentric annulus).
    """
    radius, inner = np.asarray(radius, float), np.asarray(inner, float)
    k = filled(radius, hole)
    return np.asarray(density * np.pi * (radius**2 * (1 + k**2) / (1 - k**2) + inner**2))


def resistance(radius: ArrayLike, hole: ArrayLike, viscosity: float) -> tuple[Array, Array]:
    """Damping per metre of steady motion: axial [N s/m²] and rotational [N s] (Couette flow)."""
    k = filled(radius, hole, FULL)
    outside = np.asarray(radius, float) ** 2
    return np.asarray(-2 * np.pi * viscosity / np.log(k)), np.asarray(4 * np.pi * viscosity * outside / (1 - k**2))


def filled(radius: ArrayLike, hole: ArrayLike, most: float = FULLEST) -> Array:
    """Radius of the string over that of its hole, at most ``most``."""
    return np.minimum(np.asarray(radius, float) / np.asarray(hole, float), most)


def hole_radius(case: Case, string: String) -> Array:
    """Radius of the hole beside the middle of every segment (n,) [m]."""
    intervals = case.wellbore.intervals
    middle = string.top_md + np.cumsum(string.length) - 0.5 * string.length
    index = np.searchsorted([interval.to_md for interval in intervals], middle)
    return np.array([0.5 * interval.diameter for interval in intervals])[np.minimum(index, len(intervals) - 1)]


def steady_resistance(case: Case, string: String) -> tuple[Array, Array]:
    """Axial [N s/m²] and rotational [N s] damping per metre of the segments (n,), given or by a given viscosity."""
    mud, n = case.mud, string.segments
    axial, rotational = mud.axial_damping or 0.0, mud.rotational_damping or 0.0
    if not mud.viscosity:
        return np.full(n, axial), np.full(n, rotational)
    along, around = resistance(string.of("outer"), hole_radius(case, string), mud.viscosity)
    return (
        along if mud.axial_damping is None else np.full(n, axial),
        around if mud.rotational_damping is None else np.full(n, rotational),
    )


class Sideways(NamedTuple):
    """Per metre of every segment (n,): lateral damping [N s/m²] and mass of mud that moves along [kg/m]."""

    damping: Array
    added_mass: Array


def sideways(case: Case, string: String, rpm: float) -> Sideways:
    """What the mud does to lateral motion of a string that rotates at ``rpm``, or rests."""
    mud, n = case.mud, string.segments
    damping, mass = np.full(n, mud.lateral_damping or 0.0), np.zeros(n)
    if mud.sideways:
        outer, hole = string.of("outer"), hole_radius(case, string)
        mass = added_mass(outer, string.of("inner"), hole, mud.density)
        if mud.lateral_damping is None:
            damping = lateral_damping(outer, hole, mud.density, mud.sideways, rpm / 60 if rpm else AT_REST)
    return Sideways(damping, mass)


def take_along(
    S: Array, case: Case, string: String, pipe: PerMetre, rpm: float, *, in_derrick: bool = False
) -> PerMetre:
    """Update a state's lateral damping and added mass; returns the pipe fed at the top with its own.

    string : laid out at its present depth; in_derrick : whether its upper part is in air (mechanics/derrick.py).  The
    kinetic energy of mud that joins a moving body, or leaves it, is booked as a loss to the mud.
    """
    n = string.segments
    found = sideways(case, string, rpm)
    damping, mass = (per_metre * string.length for per_metre in found)
    if string.long_segment:  # its upper half moves with the top drive
        damping[0], mass[0] = 0.5 * damping[0], 0.5 * mass[0]
    if in_derrick:
        share = state.row(S, state.IMMERSED, n)
        state.row(S, state.IN_MUD_LATERAL, n)[:] = damping
        damping, mass = share * damping, share * mass
    velocity, axis = (
        np.stack([state.row(S, offset, n) for offset in rows])
        for rows in ((state.VX, state.VY, state.VZ), (state.AX, state.AY, state.AZ))
    )
    square = (velocity**2).sum(axis=0) - (velocity * axis).sum(axis=0) ** 2
    added, inverse = state.row(S, state.ADDED_MASS, n), state.row(S, state.INVERSE_MASS, n)
    state.row(S, state.LOST_MUD, n)[:] -= 0.5 * (mass - added) * square
    added[:] = mass
    state.row(S, state.MUD_LATERAL, n)[:] = damping
    state.row(S, state.HELD_BACK, n)[:] = inverse - 1 / (state.row(S, state.MASS, n) + mass)
    return pipe._replace(mud_lateral=float(found.damping[0]), added_mass=float(found.added_mass[0]))
