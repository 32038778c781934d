"""Loads of the wall on a steady string and their derivative, by a complex step through the engine's helpers.

A complex step of 1e-30 differentiates without a difference: the derivative is exact to rounding and needs no second
copy of the equations (Squire & Trapp 1998), so that a law of friction is written once.  The wall beside the contact
point has its gradient in closed form (wall_gradient.py).  A packed loop steps through the unknowns of the body.
"""

from functools import cache
from typing import Any, Final

import numpy as np

from fctd.mechanics.contact import HOLE_RADIUS, RADIUS_GAIN, STIFFNESS_GAIN, owner_of
from fctd.mechanics.dual import power, reciprocal, root
from fctd.mechanics.friction import limit_around, turning_limit
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.laws import LAWS, dispatch, steady_load
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import ARM_CONTACT, GIVEN_FRICTION, OPEN, RADIUS, STARTING_FORCE, STILL, TINY, TRIBUTARY
from fctd.steady.block_thomas import SIZE
from fctd.steady.pose import in_frame, place, quaternion, stepped
from fctd.steady.wall_gradient import wall_of

STEP = 1e-30
UNIT = 1 / STEP
# Shift and tilt, and then nothing: the spin of a body about its axis does not change the loads, and the loop over a
# whole packed operation is packed.
UNKNOWNS, DIRECTIONS = 5, 8
ONE_BY_ONE = STEP * np.eye(DIRECTIONS)


@inlined
def unit_of(x, y, z):
    """The direction of a vector; of one without length 0."""
    k = reciprocal(root(x * x + y * y + z * z) + TINY)
    return k * x, k * y, k * z


@inlined
def depth_of(laws, penetration):
    """The penetration of a linear wall that would press as this wall does [m]."""
    if laws.wall_exponent == 1:
        return penetration
    return laws.wall_reference * power(penetration / laws.wall_reference, laws.wall_exponent)


@inlined
def left_of_both(corners, net, fx, fy, fz, mx, my, mz, ax, ay, az, nx, ny, nz):
    """Friction at one place with the limits of two, as it is at both: force and moment (6) on a body with the axis a.

    corners : of ``Laws``; net : of ``friction.Sliding``, the share of the force around the body, and of the moment
    across its axis, that is left of both.
    """
    if corners is None:
        return fx, fy, fz, mx, my, mz
    cx, cy, cz = cross(ax, ay, az, nx, ny, nz)
    turn = (1 - net) * (fx * cx + fy * cy + fz * cz) * reciprocal(cx * cx + cy * cy + cz * cz + TINY)
    about = (1 - net) * (mx * ax + my * ay + mz * az)
    fx, fy, fz = fx - turn * cx, fy - turn * cy, fz - turn * cz
    return fx, fy, fz, net * mx + about * ax, net * my + about * ay, net * mz + about * az


@inlined
def loads_of_wall(
    steady_load, laws, spin, scale, nx, ny, nz, normal, factor, around, tx, ty, tz, w, qx, qy, qz, arm, radius, net
):
    """Loads of the wall on a body with its frame q, given the normal force on it [N] and the wall beside it.

    steady_load : of a law of friction; spin : rotation of the string there [rad/s]; scale : share of the friction;
    factor, around : friction factors along and around the string; radius [m] : at which it acts; net : of
    ``left_of_both``.  Returns force [N], global; moment about the centre
    [N m], in the body's frame: six scalars.
    """
    _, _, _, _, _, _, ax, ay, az = rotation_columns(w, qx, qy, qz)
    limit = scale * factor * normal
    fx, fy, fz, mx, my, mz, _ = steady_load(
        laws.speed, spin, limit, limit_around(laws.orthotropic, scale, around, normal), radius, ax, ay, az,
        nx, ny, nz, tx, ty, tz,
    )  # fmt: skip
    fx, fy, fz, mx, my, mz = left_of_both(laws.corners, net, fx, fy, fz, mx, my, mz, ax, ay, az, nx, ny, nz)
    if laws.at_axis:
        about = mx * ax + my * ay + mz * az
        mx, my, mz = about * ax, about * ay, about * az
    fx, fy, fz = fx - normal * nx, fy - normal * ny, fz - normal * nz
    ox, oy, oz = cross(arm * ax, arm * ay, arm * az, fx, fy, fz)
    ma, mb, mc = in_frame(w, qx, qy, qz, mx + ox, my + oy, mz + oz)
    return fx, fy, fz, ma, mb, mc


@inlined
def share_of_friction(S, j, laws):
    """Share of its friction with which the wall itself acts on body j."""
    return laws.friction_scale * (1.0 - S[GIVEN_FRICTION + j])


@inlined
def spin_of(S, j, laws):
    """Rotation of body j [rad/s]: none below a swivel."""
    return laws.spin * (1.0 - S[STILL + j])


@inlined
def starting(S, j, C, i, laws):
    """Force along body j [N] and torque about it [N m] with which bow springs hold it that piece i compresses."""
    if laws.geometry == OPEN or C[i, HOLE_RADIUS] > S[RADIUS + j]:
        return 0.0, 0.0
    turning = C[i, HOLE_RADIUS] * spin_of(S, j, laws)
    share = laws.friction_scale * S[STARTING_FORCE + j] / (root(laws.speed * laws.speed + turning * turning) + TINY)
    return share * laws.speed, share * turning * C[i, HOLE_RADIUS]


@inlined
def contact_place(S, j, P):
    """The contact point of body j [m]."""
    x, y, z = place(P, j)
    arm = S[ARM_CONTACT + j]
    _, _, _, _, _, _, ax, ay, az = rotation_columns(*quaternion(P, j))
    return x + arm * ax, y + arm * ay, z + arm * az


@inlined
def moved(q, dx, dy, dz):
    """A quantity beside a point that moves by d/i."""
    return complex(q[0], q[1] * dx + q[2] * dy + q[3] * dz)


@inlined
def reach_of(own, radius, reach, dx, dy, dz):
    """Distance from the axis of a body that moves by d/i to the place of the wall that it touches [m].

    own : of ``Steady``; reach : of ``Beside``.
    """
    if own is None:
        return radius
    return moved(reach, dx, dy, dz)


@cache
def differentiate_with(steady_load: Any) -> Any:
    """A function that fills the loads of the wall on a body and their derivatives, by the steady load of a law."""

    @inlined
    def differentiate(laws, spin, scale, w, qx, qy, qz, arm, radius, tributary, wall, K):
        """Fill K (12 × DIRECTIONS, flat) with derivatives of force and moment, and in its lower half with both."""
        xx, xy, xz, yx, yy, yz, _, _, _ = rotation_columns(w, qx, qy, qz)
        depth = depth_of(laws, complex(wall.beyond[0] + radius, STEP))
        pressed, slope = tributary * depth.real, tributary * depth.imag * UNIT
        for k in range(DIRECTIONS):
            a, b = ONE_BY_ONE[3, k], ONE_BY_ONE[4, k]
            dx = ONE_BY_ONE[0, k] + arm * (b * xx - a * yx)
            dy = ONE_BY_ONE[1, k] + arm * (b * xy - a * yy)
            dz = ONE_BY_ONE[2, k] + arm * (b * xz - a * yz)
            cw, cx, cy, cz = stepped(w, qx, qy, qz, complex(0.0, a), complex(0.0, b))
            nx, ny, nz = unit_of(moved(wall.x, dx, dy, dz), moved(wall.y, dx, dy, dz), moved(wall.z, dx, dy, dz))
            normal = moved(wall.stiffness, dx, dy, dz) * complex(pressed, slope * moved(wall.beyond, dx, dy, dz).imag)
            fx, fy, fz, ma, mb, mc = loads_of_wall(
                steady_load, laws, spin, scale, nx, ny, nz, normal,
                moved(wall.factor, dx, dy, dz), moved(wall.around, dx, dy, dz),
                moved(wall.tx, dx, dy, dz), moved(wall.ty, dx, dy, dz), moved(wall.tz, dx, dy, dz),
                cw, cx, cy, cz, arm, reach_of(laws.own, radius, wall.reach, dx, dy, dz), moved(wall.net, dx, dy, dz),
            )  # fmt: skip
            K[k], K[8 + k], K[16 + k] = fx.imag * UNIT, fy.imag * UNIT, fz.imag * UNIT
            K[24 + k], K[32 + k], K[40 + k] = ma.imag * UNIT, mb.imag * UNIT, mc.imag * UNIT
            K[48 + k], K[56 + k], K[64 + k] = fx.real, fy.real, fz.real
            K[72 + k], K[80 + k], K[88 + k] = ma.real, mb.real, mc.real

    return differentiate


differentiate_by_law: Final = dispatch([differentiate_with(law.steady_load) for law in LAWS])


@inlined
def add_wall(S, j, P, C, owner, laws, R, D, K):
    """Add the wall beside contact point j to the forces out of balance R and to the tangent −∂R, and update its owner.

    K (12 × DIRECTIONS, flat) : work.
    """
    x, y, z = contact_place(S, j, P)
    i = owner_of(C, owner[j], laws.geometry, x, y, z)
    owner[j] = i
    wall = wall_of(laws.own, S, j, C, i, laws.geometry, x, y, z)
    if wall.beyond[0] + S[RADIUS + j] < 0:
        return
    w, qx, qy, qz = quaternion(P, j)
    differentiate_by_law(
        laws.friction, laws, spin_of(S, j, laws), share_of_friction(S, j, laws), w, qx, qy, qz, S[ARM_CONTACT + j],
        S[RADIUS + j],
        S[TRIBUTARY + j], wall, K,
    )  # fmt: skip
    for i in range(SIZE):
        R[j, i] += K[DIRECTIONS * (SIZE + i)]
        for k in range(UNKNOWNS):
            D[j, i, k] -= K[DIRECTIONS * i + k]


@inlined
def leave_out_change_along(S, j, P, C, i, laws, D):
    """Take out of the tangent how the normal force on body j from arc i changes along the hole.

    At a shoe between arcs the wall closes in along the hole but presses square to it: a move along the hole changes the
    force across it, and not the other way round.  The half of it in a symmetric part is no stiffness of the string.
    Between cylinders, and where a hole is sampled, the wall leans (stored_walls.lean_wall): its force has an energy.
    """
    if C[i, RADIUS_GAIN] == 0 and C[i, STIFFNESS_GAIN] == 0:
        return
    x, y, z = contact_place(S, j, P)
    wall = wall_of(laws.own, S, j, C, i, laws.geometry, x, y, z)
    penetration = wall.beyond[0] + S[RADIUS + j]
    if penetration < 0:
        return
    tx, ty, tz = wall.tx[0], wall.ty[0], wall.tz[0]
    closes = moved(wall.beyond, tx, ty, tz).imag
    depth = depth_of(laws, complex(penetration, STEP * closes))
    change = S[TRIBUTARY + j] * (
        wall.stiffness[0] * depth.imag * UNIT + moved(wall.stiffness, tx, ty, tz).imag * depth.real
    )
    w, qx, qy, qz = quaternion(P, j)
    xx, xy, xz, yx, yy, yz, ax, ay, az = rotation_columns(w, qx, qy, qz)
    arm = S[ARM_CONTACT + j]
    nx, ny, nz = unit_of(wall.x[0], wall.y[0], wall.z[0])
    ma, mb, mc = in_frame(w, qx, qy, qz, *cross(arm * ax, arm * ay, arm * az, nx, ny, nz))
    about_x, about_y = -arm * (yx * tx + yy * ty + yz * tz), arm * (xx * tx + xy * ty + xz * tz)
    for row, load in ((0, nx), (1, ny), (2, nz), (3, ma), (4, mb), (5, mc)):
        for k, shift in ((0, tx), (1, ty), (2, tz), (3, about_x), (4, about_y)):
            D[j, row, k] -= change * load * shift


@inlined
def read_wall(S, j, P, C, i, laws):
    """Normal force on body j from piece i [N], friction torque r F_t about its axis [N m] and r μ F_n [N m]."""
    x, y, z = contact_place(S, j, P)
    wall = wall_of(laws.own, S, j, C, i, laws.geometry, x, y, z)
    penetration = wall.beyond[0] + S[RADIUS + j]
    if penetration < 0:
        return 0.0, 0.0, 0.0
    normal = wall.stiffness[0] * S[TRIBUTARY + j] * depth_of(laws, penetration)
    scale = share_of_friction(S, j, laws)
    limit = scale * wall.factor[0] * normal
    around = limit_around(laws.orthotropic, scale, wall.around[0], normal)
    nx, ny, nz = unit_of(wall.x[0], wall.y[0], wall.z[0])
    _, _, _, _, _, _, ax, ay, az = rotation_columns(*quaternion(P, j))
    radius = S[RADIUS + j] if laws.own is None else wall.reach[0]
    _, _, _, _, _, _, torque = steady_load(
        laws.friction, laws.speed, spin_of(S, j, laws), limit, around, radius, ax, ay, az, nx, ny, nz,
        wall.tx[0], wall.ty[0], wall.tz[0],
    )  # fmt: skip
    return normal, -torque, radius * turning_limit(limit, around)
