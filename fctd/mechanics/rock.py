"""The law of a drag bit in rock (Detournay & Defournay 1992).

Of the weight W, the wear flats carry W_f = min(W, σ a l) and the cutting edges the rest, with a depth of cut
d = (W − W_f)/(ζ ε a) for each turn and the torque ε a² d/2 + μ γ a W_f/2.
"""

import math
from typing import NamedTuple

from fctd.mechanics.jit import inlined

NO_ROCK, DRAG_BIT, GIVEN_LOADS = 0, 1, 2


class Rock(NamedTuple):
    """Rock and bit as the step needs them.

    law : NO_ROCK, DRAG_BIT or GIVEN_LOADS.  stiffness : of the rock under the bit [N/m].  worn : weight that the wear
    flats carry, σ a l [N].  advance : depth of cut for the rest of the weight, 1/(ζ ε a) [m/N].  cutting, rubbing :
    torque for the weight on the cutting edges, a/2ζ, and on the wear flats, μ γ a/2 [N m/N].  weight [N],
    torque [N m] : the given loads.  weakening, weakening_spin : torque is 1 + weakening · exp(−|Ω|/weakening_spin)
    times that of the law [rad/s].  motor : spin of the bit against the string [rad/s].
    """

    law: int
    stiffness: float = 0.0
    worn: float = 0.0
    advance: float = 0.0
    cutting: float = 0.0
    rubbing: float = 0.0
    weight: float = 0.0
    torque: float = 0.0
    weakening: float = 0.0
    weakening_spin: float = 1.0
    motor: float = 0.0


NOTHING = Rock(NO_ROCK)


@inlined
def bit_loads(rock, pressed, share, spin):
    """Weight on bit [N] and the torque of the law [N m] at a spin of the bit [rad/s].

    pressed : of the bit into the rock [m]; share : of the given loads that acts.
    """
    weight, torque = share * rock.weight, share * rock.torque
    if rock.law == DRAG_BIT:
        weight = rock.stiffness * max(pressed, 0.0)
        flats = min(weight, rock.worn)
        torque = rock.cutting * (weight - flats) + rock.rubbing * flats
    return weight, torque * (1 + rock.weakening * math.exp(-abs(spin) / rock.weakening_spin))
