"""Snaking of a pipe with ends: Mitchell's energy by finite differences, relaxed from waves of a given length.

The waves of a pipe without ends cannot get lost, so that they stand in a whole band (band.py).  At an end they can:
waves come in or leave there until the half wave is one that the end lets stand (Cross, Daniels, Hohenberg & Siggia
1983, of convection between walls).  A hinged end on the low side, θ = θ'' = 0, is a passage of the wave itself and
lets all of the band stand; a clamped one, θ = θ' = 0, lets little of it stand.  Units as in mitchell.py.
"""

import numpy as np
from scipy.linalg import LinAlgError, solve_banded

from fctd.arrays import Array
from references.buckling.mitchell import UNIT, snaking

POINTS = 20  # in a half wave
STEPS, REST = 4000, 1e-9  # at most; largest unbalanced θ'''' of a pipe at rest
LONGEST, LARGEST = 1e6, 0.5  # time step, and turn in it [rad]


class RestlessError(RuntimeError):
    """The pipe has not come to rest."""


def taken(ratio: float, half_wave: float, length: float, clamped: bool) -> float:
    """Half wave in the middle half of a pipe of a length that was laid in others; NaN where it has none.

    ratio : F over the onset; raises NoShapeError where such half waves do not buckle, and RestlessError.
    """
    shape = snaking(UNIT, ratio * UNIT.onset, half_wave)
    cells = round(length / half_wave * POINTS)
    h = length / cells
    at = np.linspace(0, length, cells + 1)[1:-1]
    # The ends of the laid waves are let down to the low side.
    angle = shape.waves(at) * np.minimum(1, np.minimum(at, length - at))
    angle = _relaxed(angle, h, ratio, clamped)
    part, where = angle[cells // 4 : 3 * cells // 4], at[cells // 4 : 3 * cells // 4]
    k = np.flatnonzero(np.diff(np.sign(part)))
    if len(k) < 2:
        return float("nan")
    return float(np.diff(where[k] - part[k] * h / (part[k + 1] - part[k])).mean())


def _relaxed(angle: Array, h: float, ratio: float, clamped: bool) -> Array:
    """Angles at rest inside the pipe: each implicit step along −dE/dθ lowers the energy; the step length adapts."""
    step = 1.0
    for _ in range(STEPS):
        slope = _slope(angle, h, ratio, clamped)
        if np.abs(slope).max() < REST:
            return angle
        bands = _bands(angle, h, ratio, clamped)
        while True:
            damped = bands.copy()
            damped[2] += 1 / step
            try:
                turn = solve_banded((2, 2), damped, -slope)
            except LinAlgError:
                turn = np.full_like(angle, np.inf)
            now = angle + turn
            if np.abs(turn).max() < LARGEST and _energy(now, h, ratio, clamped) <= _energy(angle, h, ratio, clamped):
                break
            if np.abs(turn).max() < REST:
                return angle
            step *= 0.5
        angle, step = now, min(1.5 * step, LONGEST)
    raise RestlessError(f"snaking laid at {ratio:.4g} times the onset has not come to rest in {STEPS} steps")


def _parts(angle: Array, h: float) -> tuple[Array, Array]:
    """θ' between the points (n + 1,) and θ'' at them (n,); θ = 0 at both ends."""
    whole = np.pad(angle, 1)
    return np.diff(whole) / h, np.diff(whole, 2) / h**2


def _energy(angle: Array, h: float, ratio: float, clamped: bool) -> float:
    """Of the whole pipe.  At a clamped end θ'' is that of a mirrored wave, 2θ₁/h², over half a cell."""
    first, second = _parts(angle, h)
    of_ends = (angle[0] ** 2 + angle[-1] ** 2) / h**4 if clamped else 0.0
    straight = 0.5 * (second**2).sum() + (0.5 * first**4 - ratio * first**2).sum() + (1 - np.cos(angle)).sum()
    return float(h * (straight + of_ends))


def _slope(angle: Array, h: float, ratio: float, clamped: bool) -> Array:
    """dE/dθ over h (n,)."""
    first, second = _parts(angle, h)
    found = np.diff(np.pad(second, 1), 2) / h**2 - np.diff(2 * first**3 - 2 * ratio * first) / h + np.sin(angle)
    if clamped:
        found[[0, -1]] += 2 * angle[[0, -1]] / h**4
    return np.asarray(found)


def _bands(angle: Array, h: float, ratio: float, clamped: bool) -> Array:
    """d²E/dθ² over h, as the bands (5, n) of ``solve_banded``."""
    first, _ = _parts(angle, h)
    stiff = (6 * first**2 - 2 * ratio) / h**2
    bands = np.zeros((5, len(angle)))
    bands[0, 2:] = bands[4, :-2] = 1 / h**4
    bands[1, 1:] = bands[3, :-1] = -4 / h**4 - stiff[1:-1]
    bands[2] = 6 / h**4 + stiff[:-1] + stiff[1:] + np.cos(angle)
    bands[2, [0, -1]] += (1.0 if clamped else -1.0) / h**4
    return bands
