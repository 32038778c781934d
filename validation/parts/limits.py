"""Locked strings beside the limit of their feeding: how feed ends there, and the shapes in which it does."""

import numpy as np
import pandas as pd

from fctd.model.perturbed import with_noise
from fctd.steady.feed import End
from validation.harness.study import Context
from validation.parts.fed_strings import ARRIVES, MORE_FRICTION, NOT, Feeding, Locked, drawn, locked_of, solve

BELOW, ABOVE = 0.95, 1.05  # of the friction at lock-up, on the same mesh
SHAPE = ["string", "by", "md_m", "contact_angle_deg", "contact_force_N"]  # columns of shapes
QUICK = 1744  # index of the one trip of the quick runs, which takes ten seconds
# Seeds of noise of the size of rounding, tried in turn: in 5 of 14 draws feed ends where no shape is found that slides
# on; in the others the string locks up at the same friction to 12 digits.
DRAWS = (0, 1, 2, 3, 4, 5, 6, 7)


def quick_trip(context: Context) -> Locked:
    """The one trip of the quick runs, in the first draw in which it is locked up with a shape."""
    one = drawn(context, QUICK, MORE_FRICTION)
    cases = (one.case, *(with_noise(one.case, seed) for seed in DRAWS))
    locked = next(
        locked_of((one._replace(case=case), solve(case, one.operation, one.bit_depth)) for case in cases), None
    )
    if locked is None:
        raise RuntimeError(f"string {QUICK} is not locked up with a shape with any noise")
    return locked


def middle(low: float, high: float) -> float:
    """The limit between two shares; the upper one where no lower one is known."""
    return (low * high) ** 0.5 if np.isfinite(low) else high


def fed(feeding: Feeding, share: float) -> str:
    """How feeding ends at a share of the friction."""
    end = feeding.at(share)
    return ARRIVES if end == End.ARRIVED else NOT if end == End.LOCKED else str(end)


def shape(profile: pd.DataFrame, string: str, by: str) -> pd.DataFrame:
    """A profile for the table of shapes."""
    return profile.assign(string=string, by=by)[SHAPE]
