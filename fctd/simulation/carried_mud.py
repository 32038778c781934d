"""Mud that a moving string takes along: its mass and damping sideways, and the boundary layers along the string.

All of it acts on motion that changes, at the present depth and rotation, and leaves steady loads as they are.
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.topdrive import PerMetre
from fctd.model.drillstring import String
from fctd.model.mud import AT_REST, added_mass, hole_radius, lateral_damping, layer_drag
from fctd.model.wellbore import Wellbore


class Sideways(NamedTuple):
    """Per metre of every segment (n,): lateral damping [N s/m²] and mass of mud that moves along [kg/m]."""

    damping: Array
    added_mass: Array


def sideways(case: Case, string: String, hole: Wellbore, rpm: float) -> Sideways:
    """What the mud does to lateral motion of a string that rotates at ``rpm``, or rests."""
    mud, n = case.mud, string.segments
    damping, mass = np.full(n, mud.lateral_damping or 0.0), np.zeros(n)
    if mud.unsteady:
        outer, around = string.of("outer"), hole_radius(hole, string.top_md, string.length)
        inside, outside = string.densities or (None, mud.density)
        mass = added_mass(outer, string.of("inner"), around, outside, inside)
        if mud.lateral_damping is None:
            damping = lateral_damping(outer, around, outside, mud.unsteady, rpm / 60 if rpm else AT_REST)
    return Sideways(damping, mass)


def layers(case: Case, string: String, rate: float) -> Array:
    """Drag of the mud's boundary layers by their lag, per metre of every segment (n,) [N s/m²]; rate [1/s] : theirs.

    An axial damping that the case gives replaces it.
    """
    mud = case.mud
    if not mud.unsteady or mud.axial_damping is not None:
        return np.zeros(string.segments)
    inside, outside = string.densities or (None, mud.density)
    return layer_drag(string.of("outer"), string.of("inner"), outside, mud.unsteady, rate, inside)


def take_along(
    S: Array, case: Case, string: String, hole: Wellbore, pipe: PerMetre, rpm: float, rate: float, *,
    in_derrick: bool = False,
) -> PerMetre:  # fmt: skip
    """Update a state's lateral damping, added mass and boundary layers; returns the pipe fed at the top with its own.

    string : laid out at its present depth; rate [1/s] : of the layers; in_derrick : whether its upper part is in air
    (mechanics/derrick.py).  The kinetic energy of mud that joins a moving body, or leaves it, is booked as a loss to
    the mud; a layer that joins one moves with it.
    """
    n = string.segments
    drag = layers(case, string, rate) * string.length
    found = sideways(case, string, hole, rpm)
    damping, mass = (per_metre * string.length for per_metre in found)
    if string.long_segment:  # its upper half moves with the top drive; sideways its end moves what its waves have
        held = 0.5 * pipe.mass * string.length[0] - S[state.MASS + 1]
        damping[0], mass[0], drag[0] = 0.5 * damping[0], 0.5 * mass[0] + held, 0.5 * drag[0]
    if in_derrick:
        share = state.row(S, state.IMMERSED, n)
        state.row(S, state.IN_MUD_LATERAL, n)[:] = damping
        damping, mass, drag = share * damping, share * mass, share * drag
    velocity, axis = (
        np.stack([state.row(S, offset, n) for offset in rows])
        for rows in ((state.VX, state.VY, state.VZ), (state.AX, state.AY, state.AZ))
    )
    along = (velocity * axis).sum(axis=0)
    square = (velocity**2).sum(axis=0) - along**2
    present, speed = state.row(S, state.LAYER_DRAG, n), state.row(S, state.LAYER_SPEED, n)
    speed[:] = np.where(present == 0, along, speed)
    present[:] = drag
    added, inverse = state.row(S, state.ADDED_MASS, n), state.row(S, state.INVERSE_MASS, n)
    inertia, steel = state.row(S, state.J_TRANSVERSE, n), state.row(S, state.MASS, n)
    # Spread along the segment as its own mass is, the mud has a moment of inertia in proportion.
    turning = inertia * (steel + mass) / (steel + added)
    across = state.row(S, state.WX, n) ** 2 + state.row(S, state.WY, n) ** 2
    state.row(S, state.LOST_MUD, n)[:] -= 0.5 * ((mass - added) * square + (turning - inertia) * across)
    added[:], inertia[:], state.row(S, state.INVERSE_JT, n)[:] = mass, turning, 1 / turning
    state.row(S, state.MUD_LATERAL, n)[:] = damping
    state.row(S, state.HELD_BACK, n)[:] = inverse - 1 / (steel + mass)
    return pipe._replace(mud_lateral=float(found.damping[0]), added_mass=float(found.added_mass[0]))
