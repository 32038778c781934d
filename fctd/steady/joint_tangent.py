"""Loads of the joints of a steady string and their derivative, in closed form.

The unknowns of a joint are shift, tilt and spin of its lower body and the tilt of its upper one; a shift or a spin of
the upper body acts as the opposite one of the lower.  With the names of ``joint_loads``, tilts ω_a and ω_b of the two
bodies turn their axes and change the twist by (a + b)·(ω_b − ω_a)/(1 + a·b): it is taken half-way between both.  All
else follows by the rules of products and chains, written once for any direction; a packed loop takes the unknowns as
eight directions.
"""

import numpy as np

from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import arms_to_gap, cross, gap, halfway, joint_loads
from fctd.mechanics.rotations import angle_over_sine, rotation_columns, twist_angle
from fctd.mechanics.state import ARM_BOTTOM, ARM_TOP, K_AXIAL, K_BEND, K_SHEAR, K_TWIST
from fctd.steady.block_thomas import BLOCK, INDEX_BITS, SIZE
from fctd.steady.pose import SPIN, quaternion, times

# Unknowns of a joint: shift, tilt and spin of the lower body, in the order of its own, and tilt of the upper.
UNKNOWNS = 8
DIRECTIONS = np.eye(UNKNOWNS)
# Loads of a joint: force on the lower body, global; moments about the centres of the upper and of the lower body, each
# in its own frame.
LOADS = 9
UPPER, LOWER = 3, 6
STEP = 1e-30


@inlined
def dot(ax, ay, az, bx, by, bz):
    """a · b."""
    return ax * bx + ay * by + az * bz


@inlined
def differentiate_joint(S, j, P, kinks, L, K):
    """Fill L (LOADS,) with the loads of joint j and K (LOADS × UNKNOWNS, flat) with their derivatives.

    kinks (n + 2, 4) : bend of the upper body's end, a quaternion in its frame.
    """
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    ka, ks, kb, kt = S[K_AXIAL + j], S[K_SHEAR + j], S[K_BEND + j], S[K_TWIST + j]
    ex, ey, ez = P[j, 0] - P[j - 1, 0], P[j, 1] - P[j - 1, 1], P[j, 2] - P[j - 1, 2]
    pw, px, py, pz = quaternion(P, j - 1)
    # Frames of the upper and of the lower body, their third columns u and b, and the axis a of the upper one's end.
    fxx, fxy, fxz, fyx, fyy, fyz, ux, uy, uz = rotation_columns(pw, px, py, pz)
    gxx, gxy, gxz, gyx, gyy, gyz, bx, by, bz = rotation_columns(*quaternion(P, j))
    pw, px, py, pz = times(pw, px, py, pz, kinks[j, 0], kinks[j, 1], kinks[j, 2], kinks[j, 3])
    _, _, _, _, _, _, ax, ay, az = rotation_columns(pw, px, py, pz)
    dx, dy, dz = gap(ex, ey, ez, ux, uy, uz, bx, by, bz, bottom, top)
    twist = twist_angle(pw, px, py, pz, *quaternion(P, j)) + P[j, SPIN] - P[j - 1, SPIN]
    fx, fy, fz, cx, cy, cz, _ = joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt)
    px, py, pz, qx, qy, qz = arms_to_gap(ux, uy, uz, bx, by, bz, dx, dy, dz, bottom, top)
    ox, oy, oz = cross(px, py, pz, fx, fy, fz)
    hx, hy, hz = cross(qx, qy, qz, fx, fy, fz)
    ox, oy, oz, hx, hy, hz = -cx - ox, -cy - oy, -cz - oz, cx + hx, cy + hy, cz + hz
    m1, m2, m3 = dot(fxx, fxy, fxz, ox, oy, oz), dot(fyx, fyy, fyz, ox, oy, oz), dot(ux, uy, uz, ox, oy, oz)
    l1, l2, l3 = dot(gxx, gxy, gxz, hx, hy, hz), dot(gyx, gyy, gyz, hx, hy, hz), dot(bx, by, bz, hx, hy, hz)
    L[0], L[1], L[2], L[3], L[4], L[5], L[6], L[7], L[8] = fx, fy, fz, m1, m2, m3, l1, l2, l3

    # What the derivatives share, by the names of ``joint_loads``.
    sx, sy, sz, share = halfway(ax, ay, az, bx, by, bz)
    along = share * dot(sx, sy, sz, dx, dy, dz)
    offset = (ka - ks) * along
    ratio = angle_over_sine(complex(dot(ax, ay, az, bx, by, bz), STEP))
    bend, slope = kb * ratio.real + offset * along, kb * ratio.imag / STEP
    torque = 2 * share * kt * twist
    nx, ny, nz = cross(bx, by, bz, ax, ay, az)
    rx, ry, rz = ax - bx, ay - by, az - bz
    for k in range(UNKNOWNS):
        tilt_x, tilt_y, turn_x, turn_y = DIRECTIONS[6, k], DIRECTIONS[7, k], DIRECTIONS[3, k], DIRECTIONS[4, k]
        # Tilts of both bodies, and by them the changes of u, a, b and d, of c and of the twist.
        wx, wy, wz = tilt_x * fxx + tilt_y * fyx, tilt_x * fxy + tilt_y * fyy, tilt_x * fxz + tilt_y * fyz
        vx, vy, vz = turn_x * gxx + turn_y * gyx, turn_x * gxy + turn_y * gyy, turn_x * gxz + turn_y * gyz
        dux, duy, duz = cross(wx, wy, wz, ux, uy, uz)
        dax, day, daz = cross(wx, wy, wz, ax, ay, az)
        dbx, dby, dbz = cross(vx, vy, vz, bx, by, bz)
        ddx, ddy, ddz = gap(
            DIRECTIONS[0, k], DIRECTIONS[1, k], DIRECTIONS[2, k], dux, duy, duz, dbx, dby, dbz, bottom, top
        )
        dtwist = 2 * share * dot(sx, sy, sz, vx - wx, vy - wy, vz - wz) + DIRECTIONS[5, k]
        dc = dot(dax, day, daz, bx, by, bz) + dot(ax, ay, az, dbx, dby, dbz)
        dsx, dsy, dsz = dax + dbx, day + dby, daz + dbz
        dshare = -2 * share * dc  # of the share, over the share
        dalong = share * (dot(dsx, dsy, dsz, dx, dy, dz) + dot(sx, sy, sz, ddx, ddy, ddz)) + along * dshare
        doffset = (ka - ks) * dalong
        dfx = -ks * ddx - doffset * sx - offset * dsx
        dfy = -ks * ddy - doffset * sy - offset * dsy
        dfz = -ks * ddz - doffset * sz - offset * dsz
        dbend = slope * dc + 2 * offset * dalong
        dtorque = 2 * share * kt * dtwist + torque * dshare
        # Couple bend (b × a) − torque s + ½ offset (a − b) × d.
        ix, iy, iz = cross(dbx, dby, dbz, ax, ay, az)
        jx, jy, jz = cross(bx, by, bz, dax, day, daz)
        kx, ky, kz = cross(dax - dbx, day - dby, daz - dbz, dx, dy, dz)
        lx, ly, lz = cross(
            rx, ry, rz, offset * ddx + doffset * dx, offset * ddy + doffset * dy, offset * ddz + doffset * dz
        )
        dcx = dbend * nx + bend * (ix + jx) - dtorque * sx - torque * dsx + 0.5 * (offset * kx + lx)
        dcy = dbend * ny + bend * (iy + jy) - dtorque * sy - torque * dsy + 0.5 * (offset * ky + ly)
        dcz = dbend * nz + bend * (iz + jz) - dtorque * sz - torque * dsz + 0.5 * (offset * kz + lz)
        dpx, dpy, dpz, dqx, dqy, dqz = arms_to_gap(dux, duy, duz, dbx, dby, dbz, ddx, ddy, ddz, bottom, top)
        ix, iy, iz = cross(dpx, dpy, dpz, fx, fy, fz)
        jx, jy, jz = cross(px, py, pz, dfx, dfy, dfz)
        kx, ky, kz = cross(dqx, dqy, dqz, fx, fy, fz)
        lx, ly, lz = cross(qx, qy, qz, dfx, dfy, dfz)
        ix, iy, iz = -dcx - ix - jx, -dcy - iy - jy, -dcz - iz - jz
        jx, jy, jz = dcx + kx + lx, dcy + ky + ly, dcz + kz + lz
        K[0 + k], K[8 + k], K[16 + k] = dfx, dfy, dfz
        # In a frame that tilts by w the moment m changes by −w × m.
        K[24 + k] = dot(fxx, fxy, fxz, ix, iy, iz) - tilt_y * m3
        K[32 + k] = dot(fyx, fyy, fyz, ix, iy, iz) + tilt_x * m3
        K[40 + k] = dot(ux, uy, uz, ix, iy, iz) + tilt_y * m1 - tilt_x * m2
        K[48 + k] = dot(gxx, gxy, gxz, jx, jy, jz) - turn_y * l3
        K[56 + k] = dot(gyx, gyy, gyz, jx, jy, jz) + turn_x * l3
        K[64 + k] = dot(bx, by, bz, jx, jy, jz) + turn_y * l1 - turn_x * l2


@inlined
def by_upper(K, load, k):
    """Derivative of a load by unknown k of the upper body."""
    return K[UNKNOWNS * load + 3 + k] if 3 <= k < 5 else -K[UNKNOWNS * load + k]


@inlined
def add_joint(S, j, P, kinks, R, D, A, U, L, K):
    """Add joint j to the forces out of balance R and to the tangent −∂R/∂(unknowns), and set all that it alone fills.

    R (n + 1, 6); D, A, U (flat) : blocks of the bodies on themselves, of a body against the one above and of that
    against it.  L, K : work of ``differentiate_joint``.
    """
    differentiate_joint(S, j, P, kinks, L, K)
    for i in range(3):
        R[j, i], R[j, 3 + i] = L[i], L[LOWER + i]
        R[j - 1, i] -= L[i]
        R[j - 1, 3 + i] += L[UPPER + i]
    lower, upper = (j * BLOCK) & INDEX_BITS, ((j - 1) * BLOCK) & INDEX_BITS
    for i in range(3):
        force, moment = SIZE * i, SIZE * (3 + i)
        for k in range(SIZE):
            U[lower + force + k] = K[UNKNOWNS * i + k]
        for k in range(SIZE):
            U[lower + moment + k] = -K[UNKNOWNS * (UPPER + i) + k]
        for k in range(SIZE):
            D[lower + force + k] = -K[UNKNOWNS * i + k]
        for k in range(SIZE):
            D[lower + moment + k] = -K[UNKNOWNS * (LOWER + i) + k]
        for k in range(SIZE):
            D[upper + force + k] += by_upper(K, i, k)
            D[upper + moment + k] -= by_upper(K, UPPER + i, k)
        for k in range(SIZE):
            A[lower + force + k] = -by_upper(K, i, k)
            A[lower + moment + k] = -by_upper(K, LOWER + i, k)
