"""Mud that flows past a laid-out string: its pressures along the string, and what it does to the effective tension.

Flow is steady, incompressible and isothermal.  Mud that is pumped flows down the bore and up the annulus.  A string
that moves displaces mud: past a depth flows what the steel and the closed volume below it make room for, and an open
bore shares it with the annulus so that both have one pressure at the bit.
"""

from dataclasses import dataclass

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.hydraulics.channel import Channel, has_flow_curve
from fctd.hydraulics.closed_forms import Loss, excess


@dataclass(frozen=True)
class Circuit:
    """Steady flow along a string, segments (n,) from the top down.

    above : distances from the bit (n + 1,) [m] of the string's top and of the lower ends of its segments; inside,
    outside : what flow adds to the pressures there [Pa], with no friction at the flow line, and inside also what brings
    unlike columns into balance at the bit; annulus : its losses; bore_flow : downwards, relative to the pipe [m³/s];
    bit_drop : pressure from the bore to the annulus [Pa]; given : load on each segment along it, towards the bit (n,)
    [N]: the pull of the annulus, and the thrust of mud that speeds up in narrower bores and in the nozzles.
    """

    above: Array
    inside: Array
    outside: Array
    annulus: Loss
    bore_flow: float
    bit_drop: float
    given: Array

    @property
    def doubted(self) -> float:
        """By how much the law of the annulus may make the lift too large [N]: where its mud mostly yields."""
        return float(np.abs(self.given) @ excess(self.annulus))

    @property
    def too_high(self) -> float:
        """By what share the law of the annulus may make its pressure too high."""
        lost = np.abs(np.diff(self.outside))
        return float(lost @ excess(self.annulus)) / max(float(lost.sum()), 1e-300)

    @property
    def lift(self) -> float:
        """What the flow takes off the hook load of a string in a straight vertical hole [N]."""
        return -float(self.given.sum())

    def pressures(self, above: Array) -> tuple[Array, Array]:
        """What flow adds to the pressures inside and outside (k,) [Pa] at distances from the bit [m]."""
        inside, outside = (np.interp(-above, -self.above, side) for side in (self.inside, self.outside))
        return inside, outside


def circulate(channel: Channel, flow: float, speed: float = 0.0, end: str | None = None) -> Circuit:
    """Steady flow along a string: pumped downwards [m³/s], or displaced by its speed downwards [m/s], or both.

    end : of the string where it is not that of the channel.  Raises InputError for a flow through a closed end.
    """
    end = channel.end if end is None else end
    through = channel.out_of_bit(flow, speed, end)
    outside, inside = channel.outside(through, speed), channel.inside(through)
    drop = channel.bit_drop(through)
    around, below = np.zeros((2, len(inside) + 1))
    np.cumsum(outside.gradient * channel.wet, out=around[1:])
    # The pressures on both sides of the bit differ by its drop, whatever the columns weigh.
    met = channel.heavier if flow > 0 else 0.0
    if flow == 0 and through != 0:
        met = channel.held(end)
        # Mud at rest in a bore bears what is less than its yield stress; its column begins without friction.
        if inside.any():
            inside *= -(around[-1] + drop + met) / inside.sum()
    below[:-1] = np.cumsum(inside[::-1])[::-1]
    given = -outside.lift * channel.wet
    if flow > 0:
        given -= channel.thrust(through)
    return Circuit(channel.above, around[-1] + drop + met + below, around, outside, through, drop, given)


def flows(case: Case, flow: float, speed: float) -> bool:
    """Whether mud that is pumped [m³/s], or displaced at a speed [m/s], acts on the string of a case."""
    return (flow > 0 or (speed != 0 and has_flow_curve(case))) and case.mud.densest > 0
