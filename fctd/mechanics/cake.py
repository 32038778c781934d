"""Differential sticking: mud pressure holds a string that rests in the cake on a permeable wall.

The pressure of the mud beyond that of the rock, Δp, acts on the width b in which the cake seals the string from the
mud, and adds Δp b to the wall's force per metre, with the cake's own friction factor.
"""

import math

from fctd.mechanics.contact import OVERBALANCE
from fctd.mechanics.friction import ON_AXIS, along_wall, factor_around, wall_normal
from fctd.mechanics.jit import inlined, kernel
from fctd.mechanics.joints import cross
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import (
    ARM_BOTTOM,
    ARM_CONTACT,
    CAKE_AGE,
    CAKE_AROUND,
    CAKE_IMPULSE,
    FRICTION,
    HOLE,
    INVERSE_JT,
    INVERSE_MASS,
    K_WALL,
    MARGIN_END,
    RADIUS,
    STUCK,
    SUM_R_MU_N,
    VX,
    VY,
    VZ,
    WX,
    WY,
    axis,
    global_spin,
    lateral_inverse_mass,
    quaternion,
    radial,
    velocity,
)


@inlined
def sealed_width(hole, radius, cake):
    """Width b [m] of a string of ``radius`` that a cake seals in a hole of radius ``hole`` [m].

    The chord in which the circles of string and cake intersect while the string touches the rock: b = 2√((R − h)² − x²)
    with x = R − h(2R − h)/(2(R − r)) (Outmans 1958).
    """
    x = hole - cake * (2 * hole - cake) / (2 * (hole - radius)) if hole > radius else 0.0
    if x <= hole - radius:
        return 2 * radius  # sunk into the cake to more than half its diameter
    # (R − h)² − x² as a product, whose first factor does not lose the digits of a thin cake.
    beyond = cake * (2 * radius - cake) / (2 * (hole - radius))
    return 2 * math.sqrt(beyond * (hole - cake + x))


@inlined
def thickness(laws, age):
    """Thickness [m] of cake of an age [s]: it grows as √t, as filtration does, to its final thickness."""
    return laws.cake_thickness * math.sqrt(min(age / laws.cake_time, 1.0))


@inlined
def length_of(S, j):
    """Length of string that rests at contact point j [m]: half of each segment beside it, the whole if in the middle.

    The paper's long segment has no length below its centre, and adds none.
    """
    own, below = 2 * S[ARM_BOTTOM + j], 2 * S[ARM_BOTTOM + j + 1]
    return own if S[ARM_CONTACT + j] == 0 and own > 0 else 0.5 * (own + below)


@inlined
def slide_past(S, j, nx, ny, nz):
    """Speed at which the surface of body j slides along the wall of global normal n [m/s]."""
    ax, ay, az = axis(S, j)
    arm, r = S[ARM_CONTACT + j], S[RADIUS + j]
    u, v, w = velocity(S, j)
    gx, gy, gz = cross(*global_spin(S, j), arm * ax + r * nx, arm * ay + r * ny, arm * az + r * nz)
    sx, sy, sz = along_wall(u + gx, v + gy, w + gz, nx, ny, nz)
    return math.sqrt(sx * sx + sy * sy + sz * sz)


@inlined
def suck(S, j, force, dt):
    """Push body j to the wall with a force [N] at its contact point.

    Resolved along the body as the wall's own force is: mud moves along with the body sideways and not along it.
    """
    _, nx, ny, nz = wall_normal(S, j)
    h, k = dt * force * lateral_inverse_mass(S, j), dt * force * S[INVERSE_MASS + j]
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    S[VX + j] += h * (xx * nx + yx * ny) + k * zx * nz
    S[VY + j] += h * (xy * nx + yy * ny) + k * zy * nz
    S[VZ + j] += h * (xz * nx + yz * ny) + k * zz * nz
    q = dt * force * S[ARM_CONTACT + j] * S[INVERSE_JT + j]
    S[WX + j], S[WY + j] = S[WX + j] - q * ny, S[WY + j] + q * nx


@kernel
def press_into_cake(S, owner, n, C, laws, dt):
    """Update the cake below every contact point, and press the string and the wall together there, given walls.

    Cake grows below a point that sticks.  A point that slides leaves it behind: its age, a mean over the length of
    string that the point stands for, falls by the share of this length that lies on fresh wall.  The wall is rigid to
    this pressure: it moves towards the string by as much as the pressure would press the string into it.
    """
    for j in range(1, n + 1):
        S[CAKE_IMPULSE + j] = S[CAKE_AROUND + j] = 0.0
        pressure = C[owner[j], OVERBALANCE]
        px, py, pz = radial(S, j)
        distance = math.sqrt(px * px + py * py + pz * pz)
        depth = distance - S[HOLE + j] + S[RADIUS + j]
        if pressure == 0 or (depth <= 0 and S[CAKE_AGE + j] == 0):
            S[CAKE_AGE + j] = 0.0
            continue
        length = length_of(S, j)
        k = 1 / (distance + ON_AXIS)
        nx, ny, nz = k * px, k * py, k * pz
        if S[STUCK + j] > 0:
            S[CAKE_AGE + j] += dt
        elif length > 0:
            S[CAKE_AGE + j] *= max(1 - slide_past(S, j, nx, ny, nz) * dt / length, 0.0)
        force = pressure * length * sealed_width(S[HOLE + j], S[RADIUS + j], thickness(laws, S[CAKE_AGE + j]))
        if depth * S[K_WALL + j] + force <= 0:
            S[CAKE_AGE + j] = 0.0  # torn off
            continue
        suck(S, j, force, dt)
        S[HOLE + j] -= force / S[K_WALL + j]
        # The moved wall is valid for this step only; an empty interval makes the next step look it up again.
        S[MARGIN_END + j] = -math.inf
        # The cake has one factor for both directions.
        around = factor_around(S, j, laws.orthotropic)
        S[CAKE_IMPULSE + j] = laws.friction_scale * (laws.cake_friction - S[FRICTION + j]) * force * dt
        S[CAKE_AROUND + j] = laws.friction_scale * (laws.cake_friction - around) * force * dt
        S[SUM_R_MU_N + j] += S[RADIUS + j] * S[CAKE_AROUND + j]
