"""Waves within the long segment: its four slowest standing waves between ends at rest, along it and in torsion.

The displacement of a uniform rod of length L is a line between its ends plus Σ q_k sin(kπx/L) (Craig & Bampton 1968).
With y_k = ½kπ q_k + u_top ± u_end (+ for odd k) each wave is a mass 2mL/(kπ)² that hangs on a spring 2EA/L between its
place y_k and that sum, and the ends have no share in it: they feel the springs alone.  What is left of the mass is put
on the ends; odd waves have all that is taken from there, 4mL/(kπ)² at each.  Places count from the string at rest
under its weight, so that weight and stretch stay those of the spring and half masses of §6.2.  Torsion has J and GJ for
m and EA.
"""

import math

from fctd.arrays import Array
from fctd.mechanics.jit import inlined
from fctd.mechanics.state import (
    FX,
    FY,
    FZ,
    LOST_MUD,
    LX,
    LY,
    LZ,
    WAVES,
    WZ,
    axis,
    global_spin,
    velocity,
)

# Waves of each kind; odd ones move with both ends, even ones with their difference.
COUNT = 4
# Numbers of a wave, first those along the segment, then those in torsion: how far its mass has moved beyond the ends
# [m, rad], its speed [m/s, rad/s], mass [kg, kg m²], spring [N/m, N m/rad], and the spring's load in this step
# [N, N m].
AHEAD, RATE, INERTIA, SPRING, LOAD, EACH = range(6)
TORSION = COUNT * EACH
# Share of the segment's mass that the waves leave at each end.
LEFT = 0.5 - 4 / math.pi**2 * sum(1 / k**2 for k in range(1, COUNT + 1, 2))
# The lower end keeps this many lengths of the longest segment below.  Its mass then never falls as the long segment
# grows, and each wave comes in where it is slower than those of such segments: no length needs shorter steps than the
# shortest.
KEPT = 2.0
# Length of the long segment over that of the longest below, at which springs and waves together are stiffest: of
# (1 + 4 (½ − 2/x) π²/4)/x, the first two waves.
STIFFEST = 2 * KEPT * math.pi**2 / (1 + math.pi**2 / 2)


@inlined
def carried(length, beside):
    """Length of pipe whose mass the lower end carries [m].

    beside : length of the longest segment below [m]; 0 : no waves.
    """
    half = 0.5 * length
    return half if beside == 0 else min(half, max(LEFT * length, KEPT * beside))


@inlined
def put_waves(S, length, beside, mass, inertia, EA, GJ):
    """Write masses and springs of the waves of a segment of ``length`` [m]; mass, inertia : per metre."""
    taken, share = 0.5 * length - carried(length, beside), 0.0
    for k in range(COUNT):
        part = 2 * length / ((k + 1) * math.pi) ** 2
        # The end gives its mass to one odd wave after the other; an even one, which needs none, goes with that before.
        if k % 2 == 0:
            share = min(max(0.5 * taken / part, 0.0), 1.0)
            taken -= 2 * part * share
        at = WAVES + EACH * k
        S[at + INERTIA], S[at + SPRING] = mass * part * share, 2 * share * EA / length
        at += TORSION
        S[at + INERTIA], S[at + SPRING] = inertia * part * share, 2 * share * GJ / length


@inlined
def sign(k):
    """Direction in which the lower end moves wave k, counted from 0."""
    return 1.0 - 2.0 * (k % 2)


@inlined
def speeds(S):
    """Speed along the top drive's axis and rotation, of the upper and of the lower end: four scalars."""
    ax, ay, az = axis(S, 0)
    u, v, w = velocity(S, 0)
    gx, gy, gz = global_spin(S, 0)
    x, y, z = velocity(S, 1)
    return u * ax + v * ay + w * az, x * ax + y * ay + z * az, gx * ax + gy * ay + gz * az, S[WZ + 1]


@inlined
def swing_waves(S, rate_of_mud, spin_of_mud, settling, dt):
    """Update the waves' speeds, and the loads of joint 1 on the lower end by those of the waves' springs.

    rate_of_mud, spin_of_mud : damping by mud over mass and over inertia [1/s], which act on a wave against the ends;
    settling : artificial damping as that of the bodies [1/s].
    """
    if S[WAVES + INERTIA] == 0:
        return
    above, below, turning, spinning = speeds(S)
    pull, torque, slow = 0.0, 0.0, 1 + dt * settling
    for k in range(COUNT):
        for kind, mud, top, end in ((0, rate_of_mud, above, below), (TORSION, spin_of_mud, turning, spinning)):
            at = WAVES + kind + EACH * k
            beyond = S[at + RATE] - top - sign(k) * end
            if S[at + INERTIA] == 0:
                continue
            damper = mud * S[at + INERTIA]
            load = S[at + SPRING] * S[at + AHEAD] + damper * beyond
            S[at + LOAD] = load
            S[at + RATE] = (S[at + RATE] - dt * load / S[at + INERTIA]) / slow
            S[LOST_MUD + 1] += dt * damper * beyond * beyond
            if kind == 0:
                pull += sign(k) * load
            else:
                torque += sign(k) * load
    ax, ay, az = axis(S, 0)
    bx, by, bz = axis(S, 1)
    S[FX + 1], S[FY + 1], S[FZ + 1] = S[FX + 1] + pull * ax, S[FY + 1] + pull * ay, S[FZ + 1] + pull * az
    S[LX + 1], S[LY + 1], S[LZ + 1] = S[LX + 1] + torque * bx, S[LY + 1] + torque * by, S[LZ + 1] + torque * bz


@inlined
def move_waves(S, dt):
    """Update the waves' places, given the new speeds of both ends; without waves they move with the ends."""
    above, below, turning, spinning = speeds(S)
    for k in range(COUNT):
        for kind, ends in ((0, above + sign(k) * below), (TORSION, turning + sign(k) * spinning)):
            at = WAVES + kind + EACH * k
            if S[at + INERTIA] > 0:
                S[at + AHEAD] += dt * (S[at + RATE] - ends)
            else:
                S[at + AHEAD], S[at + RATE], S[at + LOAD] = 0.0, ends, 0.0


@inlined
def loads_of_waves(S, kind):
    """Loads of the waves' springs on the upper and on the lower end; kind : 0, or ``TORSION`` [N, N m]."""
    upper, lower = 0.0, 0.0
    for k in range(COUNT):
        load = S[WAVES + kind + EACH * k + LOAD]
        upper += load
        lower += sign(k) * load
    return upper, lower


@inlined
def energy_of_waves(S):
    """Kinetic and strain energy of the waves [J]."""
    kinetic = strain = 0.0
    for wave in range(2 * COUNT):
        at = WAVES + EACH * wave
        kinetic += 0.5 * S[at + INERTIA] * S[at + RATE] ** 2
        strain += 0.5 * S[at + SPRING] * S[at + AHEAD] ** 2
    return kinetic, strain


def hung(S: Array, kind: int) -> list[tuple[float, float, float]]:
    """Direction of the lower end, mass and spring of each wave that there is; kind : 0, or ``TORSION``."""
    places = [WAVES + kind + EACH * k for k in range(COUNT)]
    waves = [(1.0 - 2.0 * (k % 2), float(S[at + INERTIA]), float(S[at + SPRING])) for k, at in enumerate(places)]
    return [wave for wave in waves if wave[1] > 0]


def stiffness_in_torsion(S: Array) -> float:
    """Of all springs of waves that the top drive turns [N m/rad]."""
    return sum(spring for _, _, spring in hung(S, TORSION))


def still(S: Array) -> None:
    """Put the waves of a state to rest."""
    for wave in range(2 * COUNT):
        for number in (AHEAD, RATE, LOAD):
            S[WAVES + EACH * wave + number] = 0.0
