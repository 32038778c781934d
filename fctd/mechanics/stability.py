"""The largest stable step of the stepper, from the stiffest mode of the string."""

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state

# Share of the largest stable step for each named ``step``.  The bound is exact for the axial mode of a uniform
# string and a few percent below the real limit where the wall or shear sets it; tension, overlap and
# curvature shift a mode by a fraction of that.
SHARES = {"auto": 0.8, "largest": 1.0}
# The quaternion update is exact to rounding below this angle per step [rad].
TURN_PER_STEP = 0.2


def stiffest_mode(S: Array, n: int, wall_stiffness: float, rock_stiffness: float = 0.0) -> float:
    """Upper bound of the highest angular frequency of string and wall [rad/s].

    Every body shares its mass and inertia equally between its two joints; no mode of the string is then
    faster than the fastest mode of a single joint with its two half-bodies (Irons & Treharne 1971, the
    theorem used for elements).  The wall spring under a body is taken with the joint above it.  For a
    uniform string this gives the exact 2c/Δz of the axial mode.  The rock under the bit has the lower half of the
    last body for itself.
    """

    def bodies(offset: int) -> Array:
        return S[offset + 1 : offset + 1 + n]

    def upper(offset: int) -> Array:
        return S[offset : offset + n]

    clamped = np.arange(n) == 0  # the top drive does not yield
    inverse_mass, inverse_jt, inverse_ja = (
        (np.where(clamped, 0.0, 2 * upper(k)), 2 * bodies(k))
        for k in (state.INVERSE_MASS, state.INVERSE_JT, state.INVERSE_JA)
    )
    axial = bodies(state.K_AXIAL) * (inverse_mass[0] + inverse_mass[1])
    rock = 2 * rock_stiffness * S[state.INVERSE_MASS + n]
    twist = bodies(state.K_TWIST) * (inverse_ja[0] + inverse_ja[1])

    # Lateral: unknowns (y, θ) of the upper and of the lower body.
    wall = wall_stiffness * bodies(state.TRIBUTARY)
    ones, zeros = np.ones(n), np.zeros(n)
    shear = np.stack([-ones, -upper(state.ARM_BOTTOM), ones, -bodies(state.ARM_TOP)], axis=1)
    bend = np.stack([zeros, -ones, zeros, ones], axis=1)
    touch = np.stack([zeros, zeros, ones, bodies(state.ARM_CONTACT)], axis=1)
    scale = np.sqrt(np.stack([inverse_mass[0], inverse_jt[0], inverse_mass[1], inverse_jt[1]], axis=1))
    stiffness = np.zeros((n, 4, 4))
    for k, shape in ((bodies(state.K_SHEAR), shear), (bodies(state.K_BEND), bend), (wall, touch)):
        scaled = shape * scale
        stiffness += k[:, None, None] * scaled[:, :, None] * scaled[:, None, :]
    lateral = np.linalg.eigvalsh(stiffness)[:, -1]
    return float(np.sqrt(max(axial.max(), rock, twist.max(), lateral.max())))


def stiffest_torsion(S: Array, n: int) -> float:
    """Upper bound of the highest angular frequency of the string's torsion [rad/s]; see ``stiffest_mode``."""
    inverse = 2 * S[state.INVERSE_JA : state.INVERSE_JA + n + 1]
    inverse[0] = 0.0  # the top drive does not yield
    return float(np.sqrt((S[state.K_TWIST + 1 : state.K_TWIST + 1 + n] * (inverse[:-1] + inverse[1:])).max()))


def stable_step(frequency: float, damping_time: float, spin: float) -> float:
    """Largest stable step [s] of symplectic Euler with explicit stiffness-proportional damping.

    frequency : stiffest mode [rad/s]; damping_time [s]; spin : fastest rotation of the run [rad/s].
    A mode is stable for ω²h² + 2ηω²h ≤ 4.
    """
    # √(η² + 4/ω²) − η without the difference, which loses its digits for a stiff string.
    softness = 4 / frequency**2
    step = softness / (np.sqrt(damping_time**2 + softness) + damping_time)
    return float(min(step, TURN_PER_STEP / spin) if spin > 0 else step)
