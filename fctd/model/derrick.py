"""The derrick above a hole: a first piece along the tangent of the hole at the rotary table.

It guides the pipe without friction.  A joint that swung freely above the table would enter the hole beyond its wall: in
the model pipe touches at its joints alone, and the rotary table would not hold it between them.
"""

from dataclasses import replace

import numpy as np

from fctd.mechanics import contact
from fctd.mechanics.state import CYLINDERS
from fctd.model.pieces import RUN_OUT
from fctd.model.wellbore import Wellbore


def with_derrick(hole: Wellbore, height: float) -> Wellbore:
    """The same hole, with its friction beginning at the rotary table and a derrick of a height [m] above it."""
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
    pieces[0, [contact.FACTOR, contact.FACTOR_AROUND]] = 0.0
    if hole.geometry == CYLINDERS:
        pieces[0, contact.ALONE_FROM], pieces[0, contact.ALONE_TO] = -np.inf, pieces[0, contact.LENGTH]
    else:
        pieces[0, contact.HALF_SINE] = 0.5 * pieces[0, contact.LENGTH]
    return replace(hole, pieces=pieces, derrick=height)
