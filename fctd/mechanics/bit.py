"""The bit on the bottom of the hole: its loads, and the bottom that moves on as it drills.

The rock is a spring under the bit, and the bottom moves on by Ω d/2π while the bit turns clockwise, d the depth of cut
(rock.py); nothing is divided by Ω.  At rest the torque of the rock is a limit, like that of friction: it may stop the
bit but not turn it.  The rock is the lower body of the free joint below the bit, so that the wall's friction sees a
bit that carries its load.  A motor turns the bit against the string at its own spin, and its torque is the bit's; the
energy in the ledger is what the string gives to motor and bit.
"""

import math

from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.rock import GIVEN_LOADS, bit_loads
from fctd.mechanics.state import (
    ARM_BOTTOM,
    CURVE,
    FX,
    FY,
    FZ,
    GIVEN_TORQUE,
    INVERSE_JA,
    LX,
    LY,
    LZ,
    NX,
    NY,
    NZ,
    OX,
    OY,
    OZ,
    TX,
    TY,
    TZ,
    UX,
    UY,
    UZ,
    WZ,
    axis,
    contact_point,
    global_spin,
    velocity,
)
from fctd.mechanics.topdrive import (
    BIT_MOVED,
    BIT_SPIN,
    BIT_TORQUE,
    BIT_WEIGHT,
    HOLE_MADE,
    LOST_BIT,
    PRESSED,
    SUM_BIT_TORQUE,
    SUM_BIT_WEIGHT,
    TOP_TIME,
    ramp,
)


@inlined
def bottom_axis(S, n):
    """Unit vector along the hole beside the bit, by the piece of hole that is stored there, else along the bit.

    Rock presses the bit along the hole, as it does the steady string's.  A weight that turned with the bit would follow
    it (Beck 1952): it never pushes a bit aside that swings, and so would keep a string from buckling at its lower end.
    """
    tx, ty, tz = S[TX + n], S[TY + n], S[TZ + n]
    if tx == 0 and ty == 0 and tz == 0:
        return axis(S, n)
    x, y, z = contact_point(S, n)
    nx, ny, nz = S[NX + n], S[NY + n], S[NZ + n]
    dx, dy, dz = x - S[OX + n], y - S[OY + n], z - S[OZ + n]
    sine = S[CURVE + n] * (dx * tx + dy * ty + dz * tz)
    cosine = 1 - S[CURVE + n] * (dx * nx + dy * ny + dz * nz)
    k = 1 / math.sqrt(cosine * cosine + sine * sine)
    sine, cosine = k * sine, k * cosine
    return cosine * tx + sine * nx, cosine * ty + sine * ny, cosine * tz + sine * nz


@inlined
def press_bit(S, top, n, rock, motion, dt):
    """Update the rock's loads on the bit, also in the free joint below it, given the loads of the joints above."""
    share = ramp(top[TOP_TIME] + 0.5 * dt, motion.start, motion.duration, motion.bit_from, motion.bit_to)
    ax, ay, az = axis(S, n)
    response = dt * S[INVERSE_JA + n]
    turned_by = ax * S[LX + n] + ay * S[LY + n] + az * S[LZ + n]
    free = rock.motor + S[WZ + n] + response * (turned_by + S[GIVEN_TORQUE + n])
    # The law takes the spin before this step: ``free`` is without the torque of the rock, and too fast.
    weight, limit = bit_loads(rock, top[PRESSED], share, rock.motor + S[WZ + n])
    torque = -min(limit, abs(free) / response)
    torque = torque if free > 0 else -torque
    tx, ty, tz = bottom_axis(S, n)
    S[FX + n + 1], S[FY + n + 1], S[FZ + n + 1] = weight * tx, weight * ty, weight * tz
    # The force on the bit acts an arm away from the centre of the last body.
    arm = weight * S[ARM_BOTTOM + n]
    mx, my, mz = cross(tx, ty, tz, arm * ax, arm * ay, arm * az)
    S[UX + n + 1], S[UY + n + 1], S[UZ + n + 1] = torque * ax + mx, torque * ay + my, torque * az + mz
    top[BIT_WEIGHT], top[BIT_TORQUE] = weight, torque


@inlined
def drill(S, top, n, rock, dt):
    """Update bit and bottom of the hole, sums and work, given the bit's loads and its velocity after the step.

    The bottom under a drag bit moves implicitly, with the weight at the end of the step.
    """
    tx, ty, tz = bottom_axis(S, n)
    vx, vy, vz = velocity(S, n)
    ax, ay, az = axis(S, n)
    swing = S[ARM_BOTTOM + n]
    sx, sy, sz = cross(*global_spin(S, n), swing * ax, swing * ay, swing * az)
    moved, spin = dt * ((vx + sx) * tx + (vy + sy) * ty + (vz + sz) * tz), S[WZ + n]
    weight, torque = top[BIT_WEIGHT], top[BIT_TORQUE]
    pressed = top[PRESSED] + moved
    made = 0.0
    if rock.law == GIVEN_LOADS:
        made = max(pressed, 0.0)  # the bottom is where the bit has been deepest
    elif rock.stiffness * pressed > rock.worn and spin + rock.motor > 0:
        turned = dt * (spin + rock.motor) * rock.advance / (2 * math.pi)
        made = turned * (rock.stiffness * pressed - rock.worn) / (1 + turned * rock.stiffness)
    top[PRESSED] = pressed - made
    top[HOLE_MADE] += made
    top[SUM_BIT_WEIGHT] += dt * weight
    top[SUM_BIT_TORQUE] -= dt * torque
    # An impulse changes the kinetic energy by its product with the mean velocity.  Weight and torque of a drag bit
    # follow its motion as springs do: with the velocity after the impulse a vibrating bit would gain energy.
    top[LOST_BIT] += 0.5 * weight * (top[BIT_MOVED] + moved) - 0.5 * dt * torque * (top[BIT_SPIN] + spin)
    top[BIT_MOVED], top[BIT_SPIN] = moved, spin
