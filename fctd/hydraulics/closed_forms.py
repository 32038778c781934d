"""Friction of mud in a bore and in an annulus, and its pull on the pipe: closed forms (API RP 13D 2006).

RP 13D takes the annulus for a slot and adds the stresses of the yield stress and of the flow; laminar, transitional and
turbulent friction run into each other.  Its laminar gradient is exact in a Newtonian bore, and that of a slot in a
Newtonian annulus, 0.5 % high at a ratio of radii of 0.6.

Annular flow is positive upwards, the speed of a pipe downwards.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array
from fctd.case.rheology import Rheology
from fctd.hydraulics.eccentric_share import pull_square
from fctd.model.mud import filled

LAMINAR: Final = 0
TRANSITIONAL: Final = 1
TURBULENT: Final = 2
# Share of the yield stress in the stress at a wall from which on the laminar law is too high, the largest share that
# was compared with exact flow, and by how much it is too high there (study annular_flow).
YIELDING, MOST_YIELDING, TOO_HIGH = 0.25, 0.9, 0.4
REGIMES: Final = ("laminar", "transitional", "turbulent")
FILLED: Final = 1 - 1e-6  # share of a hole that a pipe fills at most
# Reynolds number below which the laminar law alone is left, and one above all flow: powers stay within floats.
SLOWEST, FASTEST = 1.0, 1e20
# Of a wall that moves: the shear rate that it gives to the mud over speed and gap, and within how much of it the yield
# stress turns its sign.  Against exact laminar flow, 400 random annuli with a ratio of radii above 0.45, they leave
# errors of 1 % in the mean of a closed pipe, and of a tenth of the stress where flow and drag cancel.
SHEARED, SMOOTH = 2.0, 0.3
STRAIGHT: Final = 1e-4  # power of a velocity that is as good as that of a Newtonian mud
# Indices for which the factors of eccentricity are fitted.
FITTED = 0.4, 1.0


class Loss(NamedTuple):
    """Friction of steady flow along parts of a string (n,).

    gradient : friction pressure lost per metre in the direction of positive flow [Pa/m]; lift : pull of the mud on the
    pipe per metre, upwards, with what the friction pressure does to its effective tension [N/m]; regime : `LAMINAR`,
    `TRANSITIONAL` or `TURBULENT`; yield_share : of the yield stress in the stress at the wall.
    """

    gradient: Array
    lift: Array
    regime: Array
    yield_share: Array


def excess(loss: Loss) -> Array:
    """By what share the laminar law may be too high (n,), 0 where little of the stress at the wall is yield stress.

    No smaller than the largest errors of the study annular_flow: 5 % at a share of 0.45, 37 % at 0.9.
    """
    beyond = np.clip((loss.yield_share - YIELDING) / (MOST_YIELDING - YIELDING), 0.0, None)
    return np.where(loss.regime < TURBULENT, TOO_HIGH * beyond**1.5, 0.0)


class _Wall(NamedTuple):
    """Stress at the wall: signed [Pa], its rise above the laminar one, shear rate [1/s], Reynolds number and limits.

    yield_share : of the yield stress in the larger of the stresses of two walls.
    """

    stress: Array
    rise: Array
    rate: Array
    reynolds: Array
    limits: tuple[Array, Array]
    yield_share: Array

    @property
    def regime(self) -> Array:
        low, high = self.limits
        return np.where(self.reynolds > high, TURBULENT, np.where(self.reynolds > low, TRANSITIONAL, LAMINAR))


def bore(inner: ArrayLike, rheology: Rheology, density: ArrayLike, flow: ArrayLike) -> Loss:
    """Loss in bores of radius `inner` [m] at a flow downwards [m³/s]; density [kg/m³].

    The gradient has the sign of the flow.  Shear of the wall and pressure cancel in the effective tension: no lift.  A
    solid bar loses nothing here; its caller refuses flow through it.
    """
    radius = np.asarray(inner, float)
    area = np.pi * radius**2
    open_ = area > 0
    width = np.where(open_, 2 * radius, np.inf)
    wall = _wall(np.asarray(flow) / np.where(open_, area, np.inf), width, rheology, density, slot=0)
    gradient = 4 * wall.stress / width
    return Loss(*np.broadcast_arrays(gradient, 0.0, wall.regime, wall.yield_share))


def annulus(
    outer: ArrayLike, hole: ArrayLike, rheology: Rheology, density: ArrayLike, flow: ArrayLike, speed: ArrayLike = 0.0,
    eccentricity: ArrayLike = 0.0,
) -> Loss:  # fmt: skip
    """Loss between pipes and holes of radii `outer` and `hole` [m] at an annular flow upwards [m³/s].

    density [kg/m³]; speed : of the pipe, downwards [m/s]; eccentricity : offset over clearance, 0 to 1.

    A moving pipe acts on the pressure by its clinging constant (Burkhardt 1961), and shears the mud at both walls,
    which takes stress off where flow and drag cancel.  It drags mud along, for which other muds than Newtonian ones
    have their apparent viscosity at the sum of the shear rates of flow and drag.
    Turbulent flow has the ratio of lift and gradient that laminar flow in the same annulus has.  An eccentric pipe
    lowers the gradient by the factor of Haciislamoglu & Cartalos 1994, and what it bears of the shear is that of
    ``pull_square``; it drags mud along as a concentric one does.
    """
    wide = np.asarray(hole, float)
    radius = filled(outer, wide, FILLED) * wide
    widening = 2 * np.log(wide / radius)  # of area, its logarithm
    area = np.pi * radius**2 * np.expm1(widening)
    width, ratio, moves = 2 * (wide - radius), radius / wide, np.any(speed)
    velocity = np.asarray(flow) / area
    if moves:
        velocity = velocity + clinging(ratio, rheology.index) * np.asarray(speed)
    wall = _wall(velocity, width, rheology, density, slot=1, speed=speed)
    gradient = 4 * wall.stress / width
    if np.any(eccentricity):
        gradient = gradient * _eccentric(ratio, eccentricity, rheology, wall)
    lift = np.pi * pull_square(radius, wide, eccentricity, rheology.index, wall.yield_share) * gradient
    if moves:
        drag = 2 * np.asarray(speed) / (radius * widening)
        rate = wall.rate + np.abs(drag)
        dragged = rheology.stress(rate) * wall.rise * (drag / np.where(rate > 0, rate, 1.0))
        lift = lift + 2 * np.pi * radius * dragged
    return Loss(*np.broadcast_arrays(gradient, lift, wall.regime, wall.yield_share))


def clinging(ratio: ArrayLike, index: ArrayLike = 1.0) -> Array:
    """Share of a pipe's speed that counts as speed of the mud, for the ratio of radii of pipe and hole (0 to 1).

    Exact for mud that the pipe alone moves, of a power law with an index, laminar and concentric; a Newtonian one is
    exact in any laminar flow.
    """
    widening = -2 * np.log(np.asarray(ratio, float))
    power = 0.5 * (1 - 1 / np.asarray(index, float)) * widening  # velocity falls with a power of the radius
    newtonian = np.abs(power) < STRAIGHT
    exponent = np.where(newtonian, -1.0, power)
    shape = _mean_power(exponent + widening) / _mean_power(widening) - 1
    return np.where(newtonian, 1 / widening - 1 / np.expm1(widening), shape / np.expm1(-exponent))


def _mean_power(exponent: Array) -> Array:
    """(1 − exp(−x))/x, 1 at 0."""
    return np.divide(-np.expm1(-exponent), exponent, out=np.ones_like(exponent), where=exponent != 0)


def _wall(
    velocity: Array, width: Array, rheology: Rheology, density: ArrayLike, slot: int, speed: ArrayLike = 0.0
) -> _Wall:
    """Stress at walls that are `width` apart [m], of a round bore (slot 0) or a slot (slot 1, width twice its gap).

    speed : of one of the walls [m/s].
    """
    index, upper = rheology.index, rheology.upper_index
    shape = ((3 - slot) * index + 1) / ((4 - slot) * index) * (1 + 0.5 * slot)
    rate, sheared = 8 * shape * velocity / width, SHEARED * 2 * np.abs(speed) / width
    yielding = ((4 - slot) / (3 - slot)) ** index * rheology.yield_stress

    def stress(at: Array) -> Array:
        """Of a wall with a shear rate; the yield stress turns its sign smoothly where the other wall moves."""
        size = np.hypot(at, SMOOTH * sheared)
        turned = np.divide(at, size, out=np.zeros_like(size), where=size > 0)
        return np.asarray(turned * yielding + np.sign(at) * rheology.consistency * np.abs(at) ** index)

    laminar = 0.5 * (stress(rate + sheared) + stress(rate - sheared)) if np.any(sheared) else stress(rate)
    against = np.where(laminar != 0, np.abs(laminar), np.inf)
    reynolds = 8 * np.asarray(density) * velocity**2 / against
    limits = 3470 - 1370 * upper, 4270 - 1370 * upper
    number = np.clip(reynolds, SLOWEST, FASTEST)
    # Friction factors over the laminar one, 16 / number.
    transitional = (number / limits[0]) ** 2
    turbulent = (np.log10(upper) + 3.93) / 50 * number ** (1 - (1.75 - np.log10(upper)) / 7) / 16
    rise = (1 + (transitional**-8 + turbulent**-8) ** (-12 / 8)) ** (1 / 12)
    most = yielding + rheology.consistency * (np.abs(rate) + sheared) ** index
    share = np.where((rate != 0) | (sheared != 0), rheology.yield_stress / np.where(most > 0, most, np.inf), 0.0)
    return _Wall(laminar * rise, rise, np.abs(rate), reynolds, limits, share)


def _eccentric(ratio: Array, eccentricity: ArrayLike, rheology: Rheology, wall: _Wall) -> Array:
    """Gradient over that of a concentric annulus; laminar and turbulent factors meet in the transitional range."""
    e, n = np.asarray(eccentricity, float), np.clip(rheology.upper_index, *FITTED)
    first, second, third = e / n * ratio**0.8454, e**2 * np.sqrt(n) * ratio**0.1852, e**3 * np.sqrt(n) * ratio**0.2527
    laminar = 1 - 0.072 * first - 1.5 * second + 0.96 * third
    turbulent = 1 - 0.048 * first - 2 / 3 * second + 0.285 * third
    low, high = wall.limits
    return np.asarray(laminar + (turbulent - laminar) * np.clip((wall.reynolds - low) / (high - low), 0.0, 1.0))
