"""The rig's drive and its driller.

The drive is a motor with inertia and a controller of its speed, which turns the top of the string.

The motor follows Newton, J dΩ/dt = T_m − T, T the torque with which it turns the string.  The controller asks for
T_m = P e + I ∫e dt + c J dΩ/dt, e the planned rotation less Ω.  The last term makes the inertia appear smaller by the
share c.  A small torque wave from below then meets the impedance P + iω(1 − c)J + I/(iω) (Kyllingstad & Nessjøen
2009), and is absorbed where this equals ζ = I_p √(Gρ) of the pipe.

The autodriller moves the block by the weight on bit as seen at surface, the rotating tare less the hook load.
"""

import math
from typing import NamedTuple

from fctd.mechanics.jit import inlined


class Drive(NamedTuple):
    """The drive of a run.

    held : whether the top turns as planned whatever the torque; the other fields are then of no effect.
    inertia : of motor and gear, at the string [kg m^2].  apparent : what the controller leaves of it [kg m^2].
    proportional : P [N m s].  integral : I [N m].  limit : largest torque of the motor [N m].
    """

    held: bool
    inertia: float
    apparent: float
    proportional: float
    integral: float
    limit: float


STIFF = Drive(True, 0.0, 0.0, 0.0, 0.0, math.inf)


class Driller(NamedTuple):
    """Who feeds the string while it drills.

    by_weight : an autodriller, else the block moves as planned.  weight : wanted on the bit [N]; gain : block speed for
    a missing weight [m/s/N]; integral : the same for its sum over time [m/s^2/N].  taring : whether the mean hook load
    of this part of a run becomes the tare.
    """

    by_weight: bool
    weight: float
    gain: float
    integral: float
    taring: bool = False


BY_SPEED = Driller(False, 0.0, 0.0, 0.0)
TARING = BY_SPEED._replace(taring=True)


def least_inertia(spring: float, damper: float, integral: float, step: float) -> float:
    """The inertia [kg m^2] that an explicit step [s] needs on top of a spring and damper with an integral part.

    spring [N m/rad], damper [N m s/rad] : of the uppermost joint; integral [N m].  The motor alone would stand half of
    it, ω²h² + 2ch < 4; the other half is for the motion of the string below.
    """
    return (0.5 * (spring + integral) * step + damper) * step


@inlined
def turn(drive, planned, rate, behind, load, drag, dt):
    """Rotation [rad/s], angle behind the plan [rad] and motor torque [N m] after a step.

    planned, rate : planned and present rotation [rad/s]; load : torque that turns the string [N m], drag : of the mud
    on the top [N m s].  The proportional part acts on the mean of the rotations before and after the step, which is
    stable for every P.  At the torque limit the angle is not summed up, so that the drive does not overshoot for having
    waited.
    """
    held, half = drive.apparent / dt, 0.5 * drive.proportional
    wanted = drive.proportional * planned + drive.integral * behind - load
    after = ((held - half) * rate + wanted) / (held + half + drag)
    torque = load + drag * after + drive.inertia * (after - rate) / dt
    if abs(torque) > drive.limit:
        torque = math.copysign(drive.limit, torque)
        after = (drive.inertia * rate + dt * (torque - load)) / (drive.inertia + dt * drag)
        return after, behind, torque
    return after, behind + dt * (planned - after), torque
