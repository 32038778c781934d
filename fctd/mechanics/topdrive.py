"""The top drive clamps the string's upper end, turns it and feeds pipe in; its reactions are hook load and torque.

It stands still and feeds pipe into the long segment, or it hangs from a block and moves along its axis with the string.
"""

import math
from typing import NamedTuple

from fctd.mechanics.drive import BY_SPEED, STIFF, Driller, Drive, turn
from fctd.mechanics.jit import entry, inlined
from fctd.mechanics.joints import hinge_gap, joint_loads, strain_energy
from fctd.mechanics.rotations import half_twist, turned
from fctd.mechanics.state import (
    ADDED_MASS,
    ARM_TOP,
    GIVEN_FORCE,
    GX,
    GY,
    GZ,
    HELD_BACK,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    J_AXIAL,
    J_TRANSVERSE,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    LOST_MUD,
    MASS,
    MUD_AXIAL,
    MUD_LATERAL,
    MUD_SPIN,
    QW,
    QX,
    QY,
    QZ,
    SUM_MUD_TORQUE,
    TURNS,
    UX,
    UY,
    UZ,
    VX,
    VY,
    VZ,
    WEIGHT,
    X,
    Y,
    Z,
    axis,
    joint_force,
    quaternion,
    spin,
    velocity,
)
from fctd.mechanics.waves import (
    TORSION,
    carried,
    energy_of_waves,
    loads_of_waves,
    move_waves,
    put_waves,
    swing_waves,
)

GRAVITY = 9.80665


class Motion(NamedTuple):
    """Feed and rotation of the top drive during one part of a run; a ramp when the ends differ.

    start, duration [s]; feed speed downwards [m/s] and rotation speed [rad/s] at both ends; drive : how the top follows
    the rotation; bit_from, bit_to : share of the weight and torque on the bit at both ends; driller : how the
    block follows them; flow_from, flow_to : of the mud that is pumped, at both ends [m³/s].
    """

    start: float
    duration: float
    feed_from: float
    feed_to: float
    spin_from: float
    spin_to: float
    drive: Drive = STIFF
    bit_from: float = 0.0
    bit_to: float = 0.0
    driller: Driller = BY_SPEED
    flow_from: float = 0.0
    flow_to: float = 0.0


class PerMetre(NamedTuple):
    """Properties per metre of the pipe fed in at the top, from which the long segment's follow by its length.

    mass [kg/m], weight (buoyed) [N/m], axial_inertia [kg m], EA [N], GJ, EI [N m^2], shear (κGA) [N],
    mud damping axial, lateral [N s/m^2], rotational [N s]; added_mass of the mud that moves sideways with it [kg/m];
    squeeze : by which share the pressure of the mud shortens it; beside : length of the longest segment below the long
    one [m], which tells what waves it may have; 0 : none; given : load along it towards the bit, given_loads.py [N/m].
    """

    mass: float
    weight: float
    axial_inertia: float
    EA: float
    GJ: float
    EI: float
    shear: float
    mud_axial: float
    mud_lateral: float
    mud_spin: float
    added_mass: float = 0.0
    squeeze: float = 0.0
    beside: float = 0.0
    given: float = 0.0


# Top drive's own numbers, shape (TOP_SIZE,): length of the long segment [m] (0: none), simulated time [s];
# sums since the last record of hook load [N s] and torque [N m s]; work done by the top drive and energy
# brought in by fed pipe since the start [J]; of the steps since the last record the extremes of hook load [N] and
# torque [N m], the angles by which top and bit turned [rad], and the time for which the bit stood still [s]; since the
# start the largest penetration of a wall of another law than the linear one [m]; height of the block above the rotary
# table, along its axis [m], and 1 where the string hangs from a block in a derrick, else 0 (derrick.py); rotation of a
# drive that is not stiff [rad/s] and its angle behind the plan [rad].
TOP_LENGTH, TOP_TIME, SUM_HOOKLOAD, SUM_TOP_TORQUE, TOP_WORK, FED_ENERGY = range(6)
HOOKLOAD_MIN, HOOKLOAD_MAX, TORQUE_MIN, TORQUE_MAX, TOP_ANGLE, BIT_ANGLE, BIT_STILL = range(6, 13)
TOP_PENETRATION, BLOCK_HEIGHT, IN_DERRICK, TOP_RATE, TOP_BEHIND = range(13, 18)
# In the same array the numbers of the bit (bit.py): how far it is pressed into the rock, below 0 off bottom [m]; hole
# made since the start [m]; sums since the last record of weight on bit [N s] and bit torque [N m s]; energy that it
# gave to the rock since the start [J]; weight on it [N] and torque on it [N m] in this step; its travel [m] and spin
# [rad/s] in the last step.
PRESSED, HOLE_MADE, SUM_BIT_WEIGHT, SUM_BIT_TORQUE, LOST_BIT, BIT_WEIGHT, BIT_TORQUE = range(18, 25)
BIT_MOVED, BIT_SPIN = 25, 26
# Of the autodriller: hook load off bottom [N], block speed of the integral part [m/s], feed since the start [m].
TARE, TOP_FEED, FED = range(27, 30)
# Of the hook load from step to step (readings.py): in the last step [N], its change in that step [N]; number and time
# [s] of the steps that were read, integrals over this time of the squares of the changes and of their changes [N^2 s].
PULL, PULL_CHANGE, PULL_STEPS, PULL_TIME, CHANGES, BENDS = range(30, 36)
# Work of the given loads since the start [J].
GIVEN_WORK = 36
TOP_SIZE = 37


def smooth_step(at, start, duration, first, last):
    """Smooth step from ``first`` to ``last``: no jump of acceleration, which would set the string ringing."""
    u = min(max((at - start) / duration, 0.0), 1.0)
    return first + (last - first) * u * u * (3 - 2 * u)


ramp = inlined(smooth_step)


@inlined
def set_long_segment(S, length, pipe):
    """Update the long segment (body 1 and joint 1) to its length [m].

    A massless arm with springs EA/L and GJ/L, half its weight lumped at the lower end (§6.2, §5.1): its
    stretch by its load and by its own weight is exact.  So is half its mass there, as long as it is short; where it is
    long against the segments below, the end moves along and turns with less, and waves within it have the rest.
    """
    half = 0.5 * length
    own = carried(length, pipe.beside)
    put_waves(S, length, pipe.beside, pipe.mass, pipe.axial_inertia, pipe.EA, pipe.GJ)
    S[ARM_TOP + 1] = length * (1 - pipe.squeeze)
    S[MASS + 1] = pipe.mass * own
    S[WEIGHT + 1] = pipe.weight * half
    S[J_AXIAL + 1] = pipe.axial_inertia * own
    S[J_TRANSVERSE + 1] = (pipe.mass + pipe.added_mass) * half * length * length / 3
    S[INVERSE_MASS + 1] = 1 / S[MASS + 1]
    # Sideways the end takes along what the waves have, as it does mud.
    S[ADDED_MASS + 1] = pipe.added_mass * half + pipe.mass * (half - own)
    S[HELD_BACK + 1] = S[INVERSE_MASS + 1] - 1 / (S[MASS + 1] + S[ADDED_MASS + 1])
    S[INVERSE_JA + 1] = 1 / S[J_AXIAL + 1]
    S[INVERSE_JT + 1] = 1 / S[J_TRANSVERSE + 1]
    S[MUD_AXIAL + 1] = pipe.mud_axial * half
    S[MUD_LATERAL + 1] = pipe.mud_lateral * half
    S[MUD_SPIN + 1] = pipe.mud_spin * half
    S[GIVEN_FORCE + 1] = pipe.given * half
    S[K_AXIAL + 1] = pipe.EA / length
    S[K_SHEAR + 1] = pipe.shear / length
    S[K_BEND + 1] = pipe.EI / length
    S[K_TWIST + 1] = pipe.GJ / length


@entry
def put_long_segment(S, length, pipe):
    """``set_long_segment`` for Python, which would compile an inlined function in every process."""
    set_long_segment(S, length, pipe)


@inlined
def long_segment_energy(S):
    """Kinetic, gravity and strain energy that depend on the long segment's length [J]."""
    vx, vy, vz = velocity(S, 1)
    wx, wy, wz = spin(S, 1)
    ax, ay, az = axis(S, 1)
    along = vx * ax + vy * ay + vz * az
    kinetic = 0.5 * S[MASS + 1] * (vx * vx + vy * vy + vz * vz)
    kinetic += 0.5 * S[ADDED_MASS + 1] * (vx * vx + vy * vy + vz * vz - along * along)
    kinetic += 0.5 * (S[J_TRANSVERSE + 1] * (wx * wx + wy * wy) + S[J_AXIAL + 1] * wz * wz)
    moving, strained = energy_of_waves(S)
    return kinetic + moving - S[WEIGHT + 1] * S[Z + 1] + strain_energy(S, 1) + strained


@inlined
def spring_tension(S):
    """Pull of the springs of joint 1 along the top drive's axis [N], without its damper."""
    ax, ay, az = axis(S, 0)
    bx, by, bz = axis(S, 1)
    dx, dy, dz = hinge_gap(S, 1)
    loads = joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, 0.0, S[K_AXIAL + 1], S[K_SHEAR + 1], 0.0, 0.0)
    return -(loads[0] * ax + loads[1] * ay + loads[2] * az)


@inlined
def planned_speeds(top, motion, dt):
    """Feed [m/s] and rotation [rad/s] of the top drive during this step, taken at its middle."""
    now = top[TOP_TIME] + 0.5 * dt
    feed = ramp(now, motion.start, motion.duration, motion.feed_from, motion.feed_to)
    rate = ramp(now, motion.start, motion.duration, motion.spin_from, motion.spin_to)
    return feed, rate


@inlined
def top_torque(S):
    """Torque with which the top turns joint 1 and the waves within the long segment [N m]."""
    ax, ay, az = axis(S, 0)
    return -(S[UX + 1] * ax + S[UY + 1] * ay + S[UZ + 1] * az) - loads_of_waves(S, TORSION)[0]


@inlined
def joint_pull(S):
    """Pull of joint 1 along the top drive's axis [N], without the waves."""
    ax, ay, az = axis(S, 0)
    fx, fy, fz = joint_force(S, 1)
    return loads_of_waves(S, 0)[1] - (fx * ax + fy * ay + fz * az)


@inlined
def hanging_load(S, top, pipe):
    """Pull of the string on the top drive [N], with the half of a long segment that hangs on it."""
    return 0.5 * (pipe.weight + pipe.given) * top[TOP_LENGTH] + joint_pull(S) + loads_of_waves(S, 0)[0]


@entry
def load_on_top(S, top, pipe):
    """``hanging_load`` for Python."""
    return hanging_load(S, top, pipe)


@inlined
def feed_by_weight(S, top, motion, pipe, dt):
    """Speed of the block downwards [m/s] by an autodriller.  The tare grows by the load of the pipe that is fed."""
    share = ramp(top[TOP_TIME] + 0.5 * dt, motion.start, motion.duration, motion.bit_from, motion.bit_to)
    tare = top[TARE] + (pipe.weight + pipe.given) * top[FED]
    missing = share * motion.driller.weight - (tare - hanging_load(S, top, pipe))
    top[TOP_FEED] += dt * motion.driller.integral * missing
    return top[TOP_FEED] + motion.driller.gain * missing


@inlined
def take_tare(S, top, motion, pipe, dt):
    """Update the tare of the autodriller: the mean hook load since the start of this part of the run."""
    elapsed = top[TOP_TIME] + dt - motion.start
    top[TARE] += (hanging_load(S, top, pipe) - top[TARE]) * min(dt / elapsed, 1.0)
    top[FED] = 0.0


@inlined
def turn_top(S, top, pipe, drive, planned, dt):
    """Rotation of the top after this step [rad/s] by a drive that is not stiff; adds the work on its inertia.

    That is what the inertia gains, by the mean of the rotations before and after the step.  By the one after it a jolt
    would cost ½ J ΔΩ² more, and a drive that hides J from the string follows every jolt.
    """
    load, drag, before = top_torque(S), 0.5 * pipe.mud_spin * top[TOP_LENGTH], top[TOP_RATE]
    rate, behind, torque = turn(drive, planned, before, top[TOP_BEHIND], load, drag, dt)
    top[TOP_RATE], top[TOP_BEHIND] = rate, behind
    top[TOP_WORK] += 0.5 * dt * (before + rate) * (torque - load - drag * rate)
    return rate


@inlined
def read_top_drive(S, top, pipe, fed, turned_by, dt):
    """Update the sums of hook load and torque, work and fed energy, given the loads of joint 1.

    fed [m], turned_by [rad] : feed and rotation of the top drive in this step.
    """
    # Half of the long segment's weight is lumped at its lower end.  The other half hangs on the top drive and moves
    # with it; it contributes impulses of the mud's drag and of given loads [N s] and the mud's torque [N m s].
    tension, waves = joint_pull(S), loads_of_waves(S, 0)[0]
    half = 0.5 * top[TOP_LENGTH]
    hanging = tension + waves + pipe.weight * half
    drag, mud_torque = pipe.mud_axial * half * fed, pipe.mud_spin * half * turned_by
    given = pipe.given * half
    torque = top_torque(S)
    top[SUM_HOOKLOAD] += dt * (hanging + given) - drag
    top[GIVEN_WORK] += given * fed
    top[SUM_TOP_TORQUE] += dt * torque + mud_torque
    S[SUM_MUD_TORQUE + 1] += mud_torque
    lost = (drag * fed + mud_torque * turned_by) / dt
    S[LOST_MUD + 1] += lost
    top[TOP_WORK] += torque * turned_by + lost - given * fed
    if top[IN_DERRICK] > 0:
        top[TOP_WORK] -= tension * fed
    elif fed != 0:
        # The pipe passes the clamp stretched, (1 + T/EA) times its unstretched length.
        raised = hanging * fed * (1 + (tension + waves) / pipe.EA)
        top[TOP_WORK] -= raised
        # Energy of the longer pipe by a central difference about the length at which the loads were taken: a
        # one-sided difference would leave an error of ½k dL² per step in the ledger.  The joint's damper pulls on
        # the pipe that passes the clamp, and stores no energy.
        damped = (tension - spring_tension(S)) * fed + waves * fed
        set_long_segment(S, top[TOP_LENGTH] - 0.5 * fed, pipe)
        before = long_segment_energy(S)
        set_long_segment(S, top[TOP_LENGTH] + 0.5 * fed, pipe)
        top[FED_ENERGY] += raised - damped + long_segment_energy(S) - before
        set_long_segment(S, top[TOP_LENGTH], pipe)
    # Quaternions represent twist within two turns.  Past half a turn a whole one is moved into TURNS, and the top
    # drive's quaternion changes sign, as a turn would change it.
    w, x, y, z = quaternion(S, 0)
    cosine, sine = half_twist(w, x, y, z, *quaternion(S, 1))
    if cosine < 0:
        S[TURNS + 1] += 2 * math.pi if sine > 0 else -2 * math.pi
        S[QW], S[QX], S[QY], S[QZ] = -w, -x, -y, -z


@inlined
def drive_top(S, top, motion, pipe, dt, settling=0.0):
    """Update the top drive's readings over this step, given joint loads; returns feed [m/s] and rotation [rad/s].

    It also updates the waves within the long segment; settling : their artificial damping [1/s].
    """
    if pipe.beside > 0:
        swing_waves(S, pipe.mud_axial / pipe.mass, pipe.mud_spin / pipe.axial_inertia, settling, dt)
    feed, rate = planned_speeds(top, motion, dt)
    if motion.driller.by_weight:
        feed = feed_by_weight(S, top, motion, pipe, dt)
    elif motion.driller.taring:
        take_tare(S, top, motion, pipe, dt)
    top[FED] += dt * feed
    if not motion.drive.held:
        rate = turn_top(S, top, pipe, motion.drive, rate, dt)
    read_top_drive(S, top, pipe, dt * feed, dt * rate, dt)
    return feed, rate


@inlined
def move_top_drive(S, top, pipe, feed, rate, dt):
    """Move the top drive with the bodies: clock, feed [m/s], rotation [rad/s] and the pipe's speed in the clamp."""
    top[TOP_TIME] += dt
    ax, ay, az = axis(S, 0)
    if top[IN_DERRICK] > 0:
        top[BLOCK_HEIGHT] -= dt * feed
        S[X] += dt * feed * ax
        S[Y] += dt * feed * ay
        S[Z] += dt * feed * az
    elif feed != 0:
        top[TOP_LENGTH] += dt * feed
        set_long_segment(S, top[TOP_LENGTH], pipe)
    w, x, y, z = quaternion(S, 0)
    S[QW], S[QX], S[QY], S[QZ] = turned(w, x, y, z, 0.0, 0.0, dt * rate)
    S[VX], S[VY], S[VZ] = feed * ax, feed * ay, feed * az
    S[GX], S[GY], S[GZ] = rate * ax, rate * ay, rate * az
    if pipe.beside > 0:
        move_waves(S, dt)
