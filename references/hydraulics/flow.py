"""What both routes of the referee share: the mud's flow curve, the annulus, and how an answer is read.

Flow is laminar, steady and without slip.  Annular flow is positive upwards relative to the earth; the pipe's speed is
positive downwards.  With the radius r, the upward velocity u(r) is −speed at the pipe and 0 at the hole, the shear
stress τ has the sign of du/dr, and the balance of a ring of mud under the friction pressure gradient g is

    d(rτ)/dr = −g r,    so that    τ = C/r − g r/2.

The mud pulls the pipe up by f = 2πr_o τ(r_o) a metre, and f + π r_o² g = 2πC for any flow curve.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError


class Mud(NamedTuple):
    """Herschel-Bulkley: τ = yield_stress + consistency γⁿ, in [Pa] and [Pa sⁿ]; Newtonian is (0, μ, 1)."""

    yield_stress: float
    consistency: float
    index: float  # type: ignore[assignment]  # of the curve; nobody searches this tuple

    def shear_rate(self, stress: Array) -> Array:
        """γ [1/s] with the sign of the stress [Pa]; zero up to the yield stress."""
        excess = np.maximum(np.abs(stress) - self.yield_stress, 0.0) / self.consistency
        return np.copysign(excess ** (1 / self.index), stress)

    def fluidity(self, stress: Array) -> Array:
        """dγ/dτ [1/(Pa s)]; zero up to the yield stress."""
        excess = np.maximum(np.abs(stress) - self.yield_stress, 0.0) / self.consistency
        return np.where(excess > 0, excess ** (1 / self.index - 1), 0.0) / (self.index * self.consistency)


class Annulus(NamedTuple):
    """Radii [m] of the pipe's outer wall and of the hole, concentric."""

    pipe: float
    hole: float

    @property
    def area(self) -> float:
        """Of the annulus [m²]."""
        return float(np.pi * (self.hole**2 - self.pipe**2))

    @property
    def gap(self) -> float:
        """[m]."""
        return self.hole - self.pipe

    @property
    def displaced(self) -> float:
        """Area of the closed pipe [m²]."""
        return float(np.pi * self.pipe**2)


class Answer(NamedTuple):
    """Flow along a metre of annulus.

    gradient [Pa/m] : friction pressure that is lost upwards; lift [N/m] : pull of the mud on the pipe, upwards, with
    the pipe's area times the gradient; zero_shear [m] : radius without shear, NaN where all shear has one sign or
    nothing flows; pipe_stress, hole_stress [Pa] : shear of the mud on either wall, positive upwards;
    yield_share : yield stress over the larger of the two, 0 without flow.
    """

    gradient: float
    lift: float
    zero_shear: float
    pipe_stress: float
    hole_stress: float
    yield_share: float


REST = Answer(0.0, 0.0, float("nan"), 0.0, 0.0, 0.0)


def read(annulus: Annulus, mud: Mud, gradient: float, moment: float) -> Answer:
    """The answer of a gradient g [Pa/m] and the constant C [N/m] of rτ = C − g r²/2."""
    pipe = moment / annulus.pipe - 0.5 * gradient * annulus.pipe
    hole = 0.5 * gradient * annulus.hole - moment / annulus.hole
    square = 2 * moment / gradient if gradient else np.inf
    inside = annulus.pipe**2 <= square <= annulus.hole**2
    return Answer(
        gradient=float(gradient),
        lift=float(2 * np.pi * moment),
        zero_shear=float(np.sqrt(square)) if inside else float("nan"),
        pipe_stress=float(pipe),
        hole_stress=float(hole),
        yield_share=float(mud.yield_stress / max(abs(pipe), abs(hole))),
    )


def check(annulus: Annulus, mud: Mud) -> None:
    """Raises InputError for an annulus without a gap, and for a mud without viscosity."""
    if not 0 < annulus.pipe < annulus.hole:
        raise InputError("radii above 0, that of the pipe below that of the hole", key="annulus", value=tuple(annulus))
    if not (mud.yield_stress >= 0 and mud.consistency > 0 and mud.index > 0):
        raise InputError("a yield stress of 0 or more, consistency and index above 0", key="mud", value=tuple(mud))


def start(annulus: Annulus, mud: Mud, flow: float, speed: float) -> tuple[float, float]:
    """A shear rate [1/s] of the flow [m³/s] past the pipe's speed [m/s], and the mud's stress [Pa] at it."""
    rate = (abs(flow) / annulus.area + abs(speed)) / annulus.gap
    return rate, mud.yield_stress + mud.consistency * rate**mud.index


def step_share(slope: Callable[[float], float]) -> float:
    """Share of Newton's step, at most 1, that a convex function takes: at its end the slope is well below that at 0.

    slope : of the function along the step, by the share; it rises, from a value below 0.
    Raises RuntimeError where rounding hides the rise.
    """
    before, short, share = slope(0.0), 0.0, 1.0
    beyond = share
    for _ in range(100):
        after = slope(share)
        if abs(after) <= 0.9 * abs(before):
            return share
        short, beyond = (share, beyond) if after < 0 else (short, share)
        if beyond == short:
            return share
        share = 0.5 * (short + beyond)
    raise RuntimeError(f"the slope {before:g} along a step of Newton's method does not fall")
