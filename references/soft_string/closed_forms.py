"""Closed forms of the soft string for one section of hole: vertical, hold, build, drop, side turn, capstan.

Derived here from the differential form in `soft_string` (Sheppard, Wick & Burgess 1987); Aadnøy & Andersen 2001
treat the same sections for pick-up and slack-off.  Every function integrates one section of constant weight w
[N/m], curvature 1/R and friction from its lower to its upper end:

    tension_below, drag, geometry  →  Climb(tension_above, load),

where ``drag`` is the signed axial friction per load across the hole (`sliding.Friction.drag`): μ picking up, −μ
slacking off, 0 rotating in place, smaller where the string also rotates and the law is ``coulomb``.
``load`` is ∫|q| ds [N]; contact force is Friction.normal times it, torque is radius × Friction.turning times it:
rotating, μ for law ``paper`` and μ/√(1 + μ²) for ``coulomb``.  `sum_up` evaluates a whole string.  All this holds for
factors that differ along and around the hole: where the whole string has one radius, speed and rotation, its friction
has one direction, and ``drag`` is one number, f_a/√(1 + f_r²).

Each form is exact where it is valid, and raises an error elsewhere: InputError for wrong geometry, and
`SideChangeError` for a build or drop in which the load across the hole passes through zero.
Tensions are effective [N], < 0 in compression; lengths [m]; angles [rad]; inclination 0 is down, > π/2 upwards.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from fctd.case.errors import InputError
from references.soft_string.sliding import Friction

# A load across the hole below this share of its terms is a rounding error, without a sign.
SIDE_TOLERANCE = 1e-9


class Climb(NamedTuple):
    """Effective tension at the upper end of a section [N], and load across the hole ∫|q| ds [N] along it."""

    tension_above: float
    load: float


Section = Callable[[float, float], Climb]
"""A section of a string: (tension_below [N], drag) → Climb."""


class Loads(NamedTuple):
    """Hook load [N], surface torque [N m], total contact force [N]."""

    hookload: float
    surface_torque: float
    total_contact_force: float


class SideChangeError(ValueError):
    """The closed form of a bend is not valid, since the wall force changes from one side of the hole to the other.

    inclination [rad], tension [N] : where it changes; above_lower_end [m] : distance of that place along the hole from
    the lower end; load [N] : ∫|q| ds from the lower end to that place.
    """

    def __init__(self, inclination: float, tension: float, above_lower_end: float, load: float) -> None:
        self.inclination, self.tension = inclination, tension
        self.above_lower_end, self.load = above_lower_end, load
        super().__init__(
            f"the wall force changes side {above_lower_end:.6g} m above the lower end of the bend, at "
            f"{np.degrees(inclination):.6g} deg with {tension:.6g} N: use bend_in_parts"
        )


def vertical(tension_below: float, drag: float = 0.0, *, weight: float, length: float) -> Climb:
    """T₁ = T₂ + wL: a soft string has no wall force in a vertical hole."""
    return hold(tension_below, drag, weight=weight, length=length, inclination=0.0)


def hold(tension_below: float, drag: float, *, weight: float, length: float, inclination: float) -> Climb:
    """Straight and slant: T₁ = T₂ + wL (cos I + drag sin I), load wL sin I; any inclination from 0 to π."""
    _check(weight=weight, length=length, inclination=inclination)
    load = weight * length * np.sin(inclination)
    return Climb(float(tension_below + weight * length * np.cos(inclination) + drag * load), float(load))


def build(
    tension_below: float,
    drag: float,
    *,
    weight: float,
    radius: float,
    inclination_below: float,
    inclination_above: float,
) -> Climb:
    """Bend in a vertical plane, inclination larger at the lower end, radius R > 0 [m].

    The load is |T/R − w sin I|: tension pulls the string to the high side, weight to the low side.  With
    a = drag on the high side and −drag on the low side, dT/dI = −wR cos I − a (T − wR sin I), so

        T(I) = A sin I + B cos I + C e^(−aI),   A = −wR (1 − a²)/(1 + a²),   B = −2a wR/(1 + a²),

    C from T at the lower end, and load = ±∫(T − wR sin I) dI.
    Valid while T − wR sin I keeps its sign; else raises SideChangeError.
    """
    if not inclination_below > inclination_above:
        raise InputError("less than inclination_below in a build", key="inclination_above", value=inclination_above)
    return _bend(tension_below, drag, weight, radius, inclination_below, inclination_above)


def drop(
    tension_below: float,
    drag: float,
    *,
    weight: float,
    radius: float,
    inclination_below: float,
    inclination_above: float,
) -> Climb:
    """Bend in a vertical plane, inclination smaller at the lower end: the build with −R.

    The load is |T/R + w sin I|; valid while that keeps its sign, so always in tension.
    """
    if not inclination_below < inclination_above:
        raise InputError("more than inclination_below in a drop", key="inclination_above", value=inclination_above)
    return _bend(tension_below, drag, weight, radius, inclination_below, inclination_above)


def side_turn(tension_below: float, drag: float, *, weight: float, radius: float, turn: float) -> Climb:
    """Turn in the horizontal plane (inclination π/2 throughout) by an angle ``turn`` [rad], to the left or right.

    The load is √(T²/R² + w²); with T = wR sinh x the equation is dx = drag dφ:
    T₁ = wR sinh(asinh(T₂/wR) + drag φ), load wR (sinh x₁ − sinh x₂)/drag.
    """
    _check(weight=weight, radius=radius, turn=turn)
    if weight == 0:
        return capstan(tension_below, drag, turn=turn)
    scale = weight * radius
    below = float(np.arcsinh(tension_below / scale))
    half = 0.5 * drag * turn
    # sinh x₁ − sinh x₂ = 2 cosh(mean) sinh(half the difference), which has the limit wR cosh x₂ φ.
    load = scale * np.cosh(below + half) * turn * (np.sinh(half) / half if half else 1.0)
    return Climb(float(scale * np.sinh(below + 2 * half)), float(load))


def capstan(tension_below: float, drag: float, *, turn: float) -> Climb:
    """Any bend by an angle ``turn`` [rad] of a string without weight: T₁ = T₂ e^(±drag·turn), − in compression.

    The limit of every bend for T/R ≫ w.
    """
    _check(turn=turn)
    exponent = drag * turn * float(np.sign(tension_below))
    growth = np.expm1(exponent) / exponent if exponent else 1.0
    return Climb(float(tension_below * np.exp(exponent)), float(abs(tension_below) * turn * growth))


def bend_in_parts(
    tension_below: float,
    drag: float,
    *,
    weight: float,
    radius: float,
    inclination_below: float,
    inclination_above: float,
) -> Climb:
    """A build or drop by successive closed forms, a new one where the wall force changes side."""
    below, load = inclination_below, 0.0
    while True:
        try:
            last = _bend(tension_below, drag, weight, radius, below, inclination_above)
        except SideChangeError as change:
            below, tension_below, load = change.inclination, change.tension, load + change.load
        else:
            return Climb(last.tension_above, load + last.load)


def sum_up(
    sections: Iterable[Section],
    friction: Friction,
    contact_radius: float,
    tension_at_bit: float = 0.0,
    torque: float = 0.0,
) -> Loads:
    """A whole string of one pipe, sections from the bit upwards; tension [N] and torque [N m] at the bit."""
    tension, contact = tension_at_bit, 0.0
    for section in sections:
        tension, load = section(tension, friction.drag)
        torque += contact_radius * friction.turning * load
        contact += friction.normal * load
    return Loads(tension, torque, contact)


class _Bend(NamedTuple):
    """The part of a vertical bend up to a change of side: T(I) with scale = wR (build) or −wR (drop), and a."""

    below: float
    tension_below: float
    scale: float
    a: float

    def free(self, inclination: float) -> float:
        """The particular solution A sin I + B cos I."""
        a, square = self.a, 1 + self.a**2
        return float(self.scale * ((a**2 - 1) * np.sin(inclination) - 2 * a * np.cos(inclination)) / square)

    def tension(self, inclination: float) -> float:
        """T(I) [N]."""
        decay = np.exp(self.a * (self.below - inclination))
        return float(self.free(inclination) + (self.tension_below - self.free(self.below)) * decay)

    def lift(self, inclination: float) -> float:
        """T ∓ wR sin I [N]: > 0 where tension exceeds the weight across the hole."""
        return float(self.tension(inclination) - self.scale * np.sin(inclination))

    def load(self, inclination: float) -> float:
        """|∫(T ∓ wR sin I) dI| [N] from the lower end up to I."""
        a, square, turn = self.a, 1 + self.a**2, self.below - inclination
        cosines = np.cos(self.below) - np.cos(inclination)
        sines = np.sin(self.below) - np.sin(inclination)
        growth = np.expm1(a * turn) / a if a else turn
        steady = 2 * self.scale * (cosines - a * sines) / square
        return float(abs(steady + (self.tension_below - self.free(self.below)) * growth))


def _bend(
    tension_below: float, drag: float, weight: float, radius: float, inclination_below: float, inclination_above: float
) -> Climb:
    """Build, or drop where inclination_below is the smaller; raises SideChangeError."""
    _check(weight=weight, radius=radius, inclination_below=inclination_below, inclination_above=inclination_above)
    below, above = inclination_below, inclination_above
    sense = 1.0 if below > above else -1.0
    scale = sense * weight * radius
    lift = tension_below - scale * np.sin(below)
    if abs(lift) <= SIDE_TOLERANCE * (abs(tension_below) + abs(scale)):
        # No load at the lower end: there dL/dI = −2 (±wR) cos I, so above it tension exceeds weight for I < π/2.
        lift = np.cos(below + 1e-6 * (above - below))
    sign = 1.0 if lift > 0 else -1.0
    bend = _Bend(below, tension_below, scale, drag * sign * sense)
    # By the same equation the lift has the same slope at all its zeros on one side of π/2, so that equal signs at
    # both ends of a part on one side exclude a zero between them.
    stops = [0.5 * np.pi, above] if (below - 0.5 * np.pi) * (above - 0.5 * np.pi) < 0 else [above]
    start = below
    for stop in stops:
        if sign * bend.lift(stop) < -SIDE_TOLERANCE * (abs(bend.tension(stop)) + abs(scale)):
            place = float(brentq(bend.lift, start, stop, xtol=1e-15))
            raise SideChangeError(place, bend.tension(place), radius * abs(below - place), bend.load(place))
        start = stop
    return Climb(bend.tension(above), bend.load(above))


def _check(**given: float) -> None:
    """Raise InputError for a number that is not finite or negative, a zero radius, or an inclination above π."""
    for key, value in given.items():
        most = np.pi * (1 + 1e-12) if key.startswith("inclination") else np.inf
        least = "above" if key == "radius" else "at least"
        if not np.isfinite(value) or value < 0 or value > most or (key == "radius" and value == 0):
            expected = "an angle from 0 to π rad" if np.isfinite(most) else f"a number {least} 0"
            raise InputError(expected, key=key, value=value)
