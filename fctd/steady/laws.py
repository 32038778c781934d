"""The hole of a case as compiled code takes it, and the laws of a steady string in it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.law_names import CODES
from fctd.model.wellbore import Wellbore
from fctd.steady.tangent import Steady


class Hole(NamedTuple):
    """The hole with its sets of friction factors: a table of pieces for each of them.

    with_wall : its geometry, or OPEN where the string does not touch it; bends : of ``Wellbore``; wall_exponent,
    wall_reference, orthotropic : as in ``Laws``; own : True where fittings have a contact of their own, else None;
    corners : as in ``Laws``.
    """

    pieces: Array
    geometry: int
    with_wall: int
    law: int
    bends: Array
    wall_exponent: float
    wall_reference: float
    orthotropic: bool | None
    own: bool | None
    corners: bool | None


def hole_of(case: Case, holes: Sequence[Wellbore]) -> Hole:
    """The hole of a case; holes : it with each set of friction factors, all of them orthotropic or none."""
    geometry = holes[0].geometry
    pieces = np.stack([hole.pieces for hole in holes]) if len(holes) > 1 else holes[0].pieces[None]
    with_wall = geometry if case.contact.enabled else state.OPEN
    law = CODES[case.contact.friction_law]
    exponent, reference = map(float, case.contact.wall_law)
    own = True if any(part.has_own_contact for part in case.string.components) else None
    of = holes[0]
    return Hole(pieces, geometry, with_wall, law, of.bends, exponent, reference, of.orthotropic, own, of.corners)


def steady_laws(
    hole: Hole, friction_scale: float, speed: float, spin: float, x: float, y: float, z: float, torque: float,
    at_axis: int,
) -> Steady:  # fmt: skip
    """The laws of a string in a hole: motion, share of the friction, force (x, y, z) and torque on the bit.

    batch.py compiles it, too.
    """
    return Steady(
        hole.with_wall, hole.law, friction_scale, speed, spin, x, y, z, torque, at_axis, hole.wall_exponent,
        hole.wall_reference, 1.0, hole.orthotropic, None, hole.own, hole.corners,
    )  # fmt: skip
