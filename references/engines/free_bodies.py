"""A string of free rigid bodies in another engine, coupled by FCTD's joint wrenches.

In every step FCTD's compiled code computes the wrenches of joints and weight from the present poses of the bodies and
hands them over; the other engine computes inertia, contact and friction.  Top drive and fed pipe are FCTD's.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import InputError
from fctd.mechanics import state
from fctd.mechanics.dynamics import load, padded_columns, update_axes
from fctd.mechanics.energy import Energy, energy_of
from fctd.mechanics.jit import entry
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.topdrive import Motion, move_top_drive
from fctd.model.chords import LONGEST_CYLINDER
from fctd.simulation.run import Run
from references.contact.tube_mesh import Tube, TubeOptions, build_tube, curvature_at
from references.engines import StepOptions

# Largest error of the triangles over the clearance of the string; with more the string lies in another hole.
LARGEST_ERROR = 0.5
# Largest error of facets in an arc [m], about that across a hole.  A string that FCTD hands over on the arc is pressed
# into the facets by this depth; 2 mm of a wall of 1e7 N/m store a tenth of the energy that the curved chain converts
# in half a second.
CHORD = 5e-4
# A contact point faster than this slides [m/s]; if friction opposite to sliding is below this share of μN, the run
# gets a note.
SLIDING, LEAST_SHARE = 1e-2, 0.98


# Features of a string of free bodies: those of joints, top drive and feed, which are FCTD's, and a plain wall.
HONOURS = frozenset(
    {"wall", "no_wall", "middle_contact", "bends", "drive", "feed", "incline", "joint_damping", "loss_factor"}
)


class Bodies(Protocol):
    """The bodies of a string in another engine.

    friction_error : why its friction may not oppose sliding.  Poses (n, 13) : centre of mass [m], quaternion (body to
    global, scalar first), velocity [m/s], spin [rad/s], all global.
    """

    friction_error: str

    def step(self, poses: Array, wrenches: Array, dt: float) -> Array:
        """Poses after a step of dt [s] under wrenches (n, 6): force [N], moment [N m] about the centres of mass."""

    def contacts(self) -> tuple[NDArray[np.int64], Array]:
        """Contacts of the last step: body of each (c,), from 1, and (c, 7) place [m], normal force [N], friction
        force on the body [N]."""

    def close(self) -> None:
        """Release the resources of the engine."""


class FreeBodyOptions(StepOptions, TubeOptions):
    """Step and tube: cylinders exactly, arcs by chords within the tolerance [m]."""

    ring_spacing: units.PositiveLength = LONGEST_CYLINDER
    chord_tolerance: units.PositiveLength | None = CHORD


def tube_of(run: Run, options: FreeBodyOptions) -> Tube | None:
    """The hole of a run as triangles, None where contact is off; axes and walls of the run have to be up to date.

    Raises InputError if the error of the triangles exceeds LARGEST_ERROR of the clearance.
    """
    if not run.case.contact.enabled:
        return None
    tube = build_tube(run.case, options)
    n = run.segments
    clearance = float((state.row(run.S, state.HOLE, n) - state.row(run.S, state.RADIUS, n)).min())
    error, _ = tube.error_bound(float(curvature_at(run.hole, tube.md).max()))
    if error > LARGEST_ERROR * clearance:
        raise InputError(
            f"triangles that miss the wall by at most {LARGEST_ERROR:g} of the clearance of {1e3 * clearance:.3g} mm: "
            "more facets, a smaller ring_spacing or chord_tolerance",
            key="facets, ring_spacing, chord_tolerance",
            value=f"{1e3 * error:.3g} mm",
        )
    return tube


@entry
def _wrenches(S, top, n, laws, motion, pipe, dt, out):  # type: ignore[no-untyped-def]
    """Loads at the present poses; out (n, 6) force and moment about the centre of mass; returns feed and spin rate."""
    update_axes(S, padded_columns(n))
    feed, rate = load(S, top, n, laws, motion, pipe, dt)
    for j in range(1, n + 1):
        fx, fy, fz = state.joint_force(S, j)
        gx, gy, gz = state.joint_force(S, j + 1)
        row = out[j - 1]
        row[0], row[1], row[2] = fx - gx, fy - gy, fz - gz + S[state.WEIGHT + j]
        row[3] = S[state.LX + j] + S[state.UX + j + 1]
        row[4] = S[state.LY + j] + S[state.UY + j + 1]
        row[5] = S[state.LZ + j] + S[state.UZ + j + 1]
    return feed, rate


@entry
def place_bodies(S, poses):  # type: ignore[no-untyped-def]
    """Update the bodies from poses (n, 13)."""
    for j in range(1, len(poses) + 1):
        p = poses[j - 1]
        w, x, y, z = state.quaternion(S, j)
        # Of the two quaternions of an orientation the one nearer to the last: twist is computed from it.
        sign = 1.0 if w * p[3] + x * p[4] + y * p[5] + z * p[6] > 0 else -1.0
        w, x, y, z = sign * p[3], sign * p[4], sign * p[5], sign * p[6]
        S[state.X + j], S[state.Y + j], S[state.Z + j] = p[0], p[1], p[2]
        S[state.QW + j], S[state.QX + j], S[state.QY + j], S[state.QZ + j] = w, x, y, z
        S[state.VX + j], S[state.VY + j], S[state.VZ + j] = p[7], p[8], p[9]
        xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
        S[state.WX + j] = xx * p[10] + xy * p[11] + xz * p[12]
        S[state.WY + j] = yx * p[10] + yy * p[11] + yz * p[12]
        S[state.WZ + j] = zx * p[10] + zy * p[11] + zz * p[12]


@entry
def move_top(S, top, pipe, feed, rate, dt):  # type: ignore[no-untyped-def]
    """``move_top_drive`` for Python."""
    move_top_drive(S, top, pipe, feed, rate, dt)


@entry
def _sum_contacts(S, body, contacts, before, poses, dt, slid):  # type: ignore[no-untyped-def]
    """Update sums and losses from contacts (c, 7) of the step from poses ``before`` to ``poses``.

    slid (2,) [N s] : impulses of friction opposite to sliding, and of μN, summed over the points that slide.
    """
    for k in range(len(body)):
        j = body[k]
        c, p, q = contacts[k], before[j - 1], poses[j - 1]
        ax, ay, az = state.axis(S, j)
        rx, ry, rz = c[0] - p[0], c[1] - p[1], c[2] - p[2]
        normal, fx, fy, fz = c[3], c[4], c[5], c[6]
        mx, my, mz = ry * fz - rz * fy, rz * fx - rx * fz, rx * fy - ry * fx
        # Power of the friction impulses with the velocity after the step, as in FCTD's ledger.
        power = fx * q[7] + fy * q[8] + fz * q[9] + mx * q[10] + my * q[11] + mz * q[12]
        limit = S[state.FRICTION + j] * normal
        vx, vy, vz = q[7] + q[11] * rz - q[12] * ry, q[8] + q[12] * rx - q[10] * rz, q[9] + q[10] * ry - q[11] * rx
        # The normal is the part of the lever across the axis; motion along it (bouncing) is not sliding.
        arm = rx * ax + ry * ay + rz * az
        nx, ny, nz = rx - arm * ax, ry - arm * ay, rz - arm * az
        into = (vx * nx + vy * ny + vz * nz) / np.sqrt(nx * nx + ny * ny + nz * nz)
        speed = np.sqrt(max(vx * vx + vy * vy + vz * vz - into * into, 0.0))
        if speed > SLIDING:
            slid[0] -= dt * power / speed
            slid[1] += dt * limit
        S[state.SUM_NORMAL + j] += dt * normal
        S[state.SUM_R_MU_N + j] += dt * S[state.RADIUS + j] * limit
        S[state.SUM_FRICTION_TORQUE + j] -= dt * (mx * ax + my * ay + mz * az)
        S[state.LOST_FRICTION + j] -= dt * power


def poses_of(run: Run) -> Array:
    """Poses (n, 13) of the bodies of a run, as in ``Bodies``; axes have to be up to date."""
    n = run.segments
    rows = (
        state.X, state.Y, state.Z, state.QW, state.QX, state.QY, state.QZ,
        state.VX, state.VY, state.VZ, state.GX, state.GY, state.GZ,
    )  # fmt: skip
    return np.stack([state.row(run.S, offset, n) for offset in rows], axis=1)


class FreeBodies:
    """Steps a run through another engine's bodies.

    watch : whether contacts are read after every step, for sums and ledger; timings switch it off.
    """

    def __init__(self, run: Run, bodies: Bodies, step: float) -> None:
        self._run, self._bodies, self.step = run, bodies, step
        self.watch = run.laws.geometry != state.OPEN
        self._wrenches = np.empty((run.segments, 6))
        self._poses = poses_of(run)
        self._slid = np.zeros(2)
        # Without the damping of the shape in space, which acts on the noise of these engines' contacts: with it the
        # torque of MuJoCo in the S-shaped well is 0.1 % off in place of 3 %, but 8 % of the work goes into the joints,
        # and the energy does not close.
        self._laws = run.laws._replace(shape_damping=0.0)

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        run, bodies, n = self._run, self._bodies, self._run.segments
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        dt = duration / steps
        for _ in range(steps):
            feed, rate = _wrenches(run.S, run.top, n, self._laws, motion, run.pipe, dt, self._wrenches)
            before = self._poses
            self._poses = bodies.step(before, self._wrenches, dt)
            if self.watch:
                _sum_contacts(run.S, *bodies.contacts(), before, self._poses, dt, self._slid)
            place_bodies(run.S, self._poses)
            move_top(run.S, run.top, run.pipe, feed, rate, dt)
        run.steps += steps

    def refresh(self) -> None:
        """See ``Stepper.refresh``; every step has updated poses and velocities."""
        self._run.refresh()

    def energy(self) -> Energy:
        """See ``Stepper.energy``."""
        return energy_of(self._run.S, self._run.segments)

    def note(self) -> str:
        """See ``Stepper.note``: the error of friction where it deviates from Coulomb's law."""
        against, limit = self._slid
        if limit == 0 or against > LEAST_SHARE * limit:
            return ""
        return (
            f"friction opposite to sliding is {against / limit:.1%} of μN, 100 % by Coulomb's law: "
            f"{self._bodies.friction_error}"
        )

    def close(self) -> None:
        """See ``Stepper.close``."""
        self._bodies.close()


def wall_stiffness(run: Run) -> Array:
    """Stiffness of the wall at the contact points (n,) [N/m]: that of the stiffest interval of the hole."""
    return np.asarray(run.hole.stiffest_wall * state.row(run.S, state.TRIBUTARY, run.segments))
