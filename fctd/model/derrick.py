"""The derrick above a hole: a first piece without a wall, along the tangent of the hole at the rotary table."""

from dataclasses import replace

import numpy as np

from fctd.mechanics import contact
from fctd.mechanics.state import CYLINDERS
from fctd.model.wellbore import RUN_OUT, Wellbore

# Radius of the piece above the rotary table, which no string reaches [m].
OPEN_AIR = 1e3


def with_derrick(hole: Wellbore, height: float) -> Wellbore:
    """The same hole, with its wall beginning at the rotary table and a derrick of a height [m] above it."""
    pieces = hole.pieces.copy()
    tangent = pieces[0, contact.DIRECTION : contact.DIRECTION + 3].copy()
    above = height
    if hole.geometry == CYLINDERS:
        # The first cylinder ends at the table.
        pieces[0, contact.START : contact.START + 3] += RUN_OUT * tangent
        pieces[0, contact.START_MD] += RUN_OUT
        pieces[0, [contact.LENGTH, contact.ALONE_TO]] -= RUN_OUT
        pieces[0, contact.ALONE_FROM] = 0.0
        if len(pieces) == 1:
            pieces[0, contact.ALONE_TO] = np.inf
        pieces = np.vstack([pieces[:1], pieces])
        pieces[0, contact.LENGTH] = 0.0
        pieces[0, contact.OVERLAP] = 0.0
        above += RUN_OUT
    pieces[0, contact.START : contact.START + 3] -= above * tangent
    pieces[0, contact.START_MD] -= above
    pieces[0, contact.LENGTH] += above
    pieces[0, [contact.HOLE_RADIUS, contact.STIFFNESS, contact.FACTOR]] = OPEN_AIR, 0.0, 0.0
    if hole.geometry == CYLINDERS:
        pieces[0, contact.ALONE_FROM], pieces[0, contact.ALONE_TO] = -np.inf, pieces[0, contact.LENGTH]
    else:
        pieces[0, contact.HALF_SINE] = 0.5 * pieces[0, contact.LENGTH]
    return replace(hole, pieces=pieces, derrick=height)
