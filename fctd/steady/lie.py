"""Where a string lies across its hole, for the mud that flows past it."""

import numpy as np

from fctd.arrays import Array
from fctd.model.operations import steady_rates
from fctd.steady.batch import Row, solve_batch
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import hole_of
from fctd.steady.problem import Workspace
from fctd.steady.reading import SOLVED

RADIUS = 3  # column of the walls of an answer: the radius of the hole, after the offset from its axis


def lie_of(laid: LaidString) -> Array | None:
    """Offset of each segment over its clearance (n,), 0 to 1, as it lies while it rotates off bottom in mud at rest.

    None where no steady string is found.
    """
    kind, string = "rotate_off_bottom", laid.string
    row = Row(laid.at_rest, 0, kind, steady_rates(laid.case, kind, flow=0.0))
    (answer,) = solve_batch(laid.case, hole_of(laid.case, [laid.hole]), [row], Workspace(string.segments))
    if not answer.numbers[SOLVED]:
        return None
    offset = np.linalg.norm(answer.walls[:, :RADIUS], axis=1)
    # At the contact points, which are the lower ends of most segments.
    share = np.clip(offset / (answer.walls[:, RADIUS] - string.channel_radii[0]), 0.0, 1.0)
    return np.asarray(0.5 * (np.append(share[0], share[:-1]) + share))
