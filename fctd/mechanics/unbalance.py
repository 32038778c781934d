"""Unbalance: a body whose centre of mass lies beside its axis is thrown outwards as it turns."""

from fctd.mechanics.jit import inlined
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import INVERSE_JA, UNBALANCE, VX, VY, VZ, WZ, lateral_inverse_mass, quaternion, velocity


@inlined
def swing_unbalance(S, n, dt):
    """Update velocity and spin of every body by the force m e ω² along its own x and its reaction on the spin.

    m e : unbalance [kg m]; ω : spin about the body's axis.  The force moves the body sideways with a power that the
    spin pays for: the couple is −m e ω u, u the velocity along x.  The spin changes so slowly that m e dω/dt is left
    out, and so is the moment of the weight about the axis.
    """
    for j in range(1, n + 1):
        unbalance = S[UNBALANCE + j]
        x, y, z = rotation_columns(*quaternion(S, j))[:3]
        vx, vy, vz = velocity(S, j)
        c = S[WZ + j]
        gained = dt * unbalance * c * c * lateral_inverse_mass(S, j)
        # The velocity in the middle of the step, so that the powers of force and couple cancel.
        u = x * vx + y * vy + z * vz + 0.5 * gained
        S[VX + j], S[VY + j], S[VZ + j] = vx + gained * x, vy + gained * y, vz + gained * z
        S[WZ + j] = c - dt * S[INVERSE_JA + j] * unbalance * c * u
