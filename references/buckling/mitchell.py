"""Snaking and helix of a pipe on the wall of a level hole at constant compression: Mitchell's equation as a
boundary value problem.

The pipe lies at the angle θ(s) from the low side (Mitchell 1988).  Its energy a metre, over that of the straight pipe,

    EI r²/2 (θ''² + θ'⁴) − F r²/2 θ'² + w r (1 − cos θ),

is stationary for EI r (θ'''' − 6 θ'²θ'') + F r θ'' + w sin θ = 0.  With the wave length ℓ = (EI r/w)^¼ as unit of
length and the onset as unit of force, β = F/(2√(EI w/r)), that has no other parameter:

    θ'''' − 6 θ'²θ'' + 2β θ'' + sin θ = 0.

The balance across the wall gives the wall force a metre, over w:

    N = cos θ + 2β θ'² + 3 θ''² + 4 θ'θ''' − θ'⁴.

The wall cannot pull: a shape with N < 0 somewhere is none of a pipe in a hole.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize_scalar
from scipy.special import j1

from fctd.arrays import Array
from references.buckling.onset import Pipe

Solution = tuple[Array, Array]

UNIT = Pipe(1.0, 1.0, 1.0)  # the shapes of all pipes at one F over the onset are those of this one
TOLERANCE = 1e-8  # relative residual of the boundary value problem


class NoShapeError(ValueError):
    """The equation has no such shape at this force and length, or none was found."""


@dataclass(frozen=True)
class Shape:
    """A period's part of a buckled pipe: from the low side to a turning point (snaking) or the high side (helix).

    s (m,) [m] : length along the hole; angle (m,) [rad] and its derivatives (m,) [rad/m, /m², /m³]; force [N].
    """

    pipe: Pipe
    force: float
    s: Array
    angle: Array
    derivatives: tuple[Array, Array, Array]

    @property
    def amplitude(self) -> float:
        """Largest angle from the low side [rad]."""
        return float(self.angle[-1])

    @property
    def length(self) -> float:
        """A half wave of snaking, or a turn of helix [m]: twice the part's."""
        return 2 * float(self.s[-1])

    @property
    def wall_force(self) -> Array:
        """Force of the wall (m,) [N/m]; negative where only a wall that pulls could hold the pipe."""
        first, second, third = self.derivatives
        EI, weight, r = self.pipe
        bending = 3 * second**2 + 4 * first * third - first**4
        return np.asarray(weight * np.cos(self.angle) + self.force * r * first**2 + EI * r * bending)

    @property
    def curvature(self) -> Array:
        """Curvature of the pipe's axis (m,) [1/m]."""
        first, second, _ = self.derivatives
        return np.asarray(self.pipe.clearance * np.hypot(first**2, second))

    def waves(self, along: Array) -> Array:
        """Angle of snaking (m,) [rad] at distances (m,) [m] from a passage of the low side."""
        count, rest = np.divmod(along, self.length)
        rising = np.interp(np.minimum(rest, self.length - rest), self.s, self.angle)
        return np.where(count % 2 == 0, rising, -rising)

    @cached_property
    def mean_wall_force(self) -> float:
        """[N/m]."""
        return self._mean(self.wall_force)

    @cached_property
    def energy(self) -> float:
        """Mean energy a metre over that of the straight pipe [J/m]."""
        first, second, _ = self.derivatives
        EI, weight, r = self.pipe
        lifted = weight * r * (1 - np.cos(self.angle))
        return self._mean(0.5 * r**2 * (EI * (second**2 + first**4) - self.force * first**2) + lifted)

    def _mean(self, values: Array) -> float:
        return float(np.trapezoid(values, self.s) / self.s[-1])


def snaking(pipe: Pipe, force: float, half_wave: float | None = None) -> Shape:
    """Snaking at a compression [N], of half waves of a given length [m] or of those of least mean energy.

    Raises NoShapeError where a pipe of such half waves stays straight.
    """
    ratio = force / pipe.onset
    if half_wave is not None:
        return _scaled(pipe, force, *_snake(ratio, 0.5 * half_wave / pipe.wave))
    near = one_term_quarter(ratio)
    # A straight pipe buckles into waves θ ~ sin kx with k⁴ − 2βk² + 1 < 0.
    spread = np.sqrt(ratio**2 - 1)
    shortest, longest = 0.5 * np.pi / np.sqrt(ratio + spread), 0.5 * np.pi / np.sqrt(ratio - spread)
    quarter = _best(_snake, ratio, (max(0.8 * near, 1.001 * shortest), min(1.25 * near, 0.999 * longest)))
    return _scaled(pipe, force, *_snake(ratio, quarter))


def helix(pipe: Pipe, force: float, turn: float | None = None) -> Shape:
    """Helix in a level hole at a compression [N], of turns of a given length [m] or of those of least mean energy.

    Raises NoShapeError.
    """
    ratio = force / pipe.onset
    near = np.pi / np.sqrt(ratio)
    half = _best(_helix, ratio, (0.9 * near, 1.4 * near)) if turn is None else 0.5 * turn / pipe.wave
    return _scaled(pipe, force, *_helix(ratio, half))


def one_term_ratio(amplitude: float) -> float:
    """F over the onset of a sine θ = A sin kx of least energy: β² = 2 J₁(A)/A (1 + ¾A²)², A [rad]."""
    return float(np.sqrt(2 * j1(amplitude) / amplitude) * (1 + 0.75 * amplitude**2))


def one_term_quarter(ratio: float) -> float:
    """Quarter wave of that sine over ℓ, by k² = β/(1 + ¾A²)."""
    if ratio <= 1:
        raise NoShapeError(f"at {ratio:.4g} times the onset the pipe stays straight")
    amplitude = float(brentq(lambda a: one_term_ratio(a) - ratio, 1e-6, np.pi))
    return float(0.5 * np.pi * np.sqrt((1 + 0.75 * amplitude**2) / ratio))


def wall_contact_limit() -> float:
    """Largest F over the onset at which snaking of least energy presses on the wall everywhere."""

    def least(ratio: float) -> float:
        return float(snaking(UNIT, ratio * UNIT.onset).wall_force.min())

    return float(brentq(least, 1.2, 2.2, xtol=1e-4))


def helix_contact_limit() -> float:
    """Least F over the onset at which the helix of least energy presses on the wall everywhere."""

    def least(ratio: float) -> float:
        return float(helix(UNIT, ratio * UNIT.onset).wall_force.min())

    return float(brentq(least, 1.25, 1.5, xtol=1e-4))


def equal_energy_ratio() -> float:
    """F over the onset above which the helix has less energy than snaking."""

    def excess(ratio: float) -> float:
        return helix(UNIT, ratio * UNIT.onset).energy - snaking(UNIT, ratio * UNIT.onset).energy

    return float(brentq(excess, 1.2, 1.7, xtol=1e-4))


def _snake(ratio: float, quarter: float) -> Solution:
    """A quarter wave from the low side to the turning point: x (m,) and θ with three derivatives (4, m), over ℓ."""
    k = 0.5 * np.pi / quarter
    # The sine of this wave: dE/dA = 0 for k⁴(½ + ¾A²) − βk² + J₁(A)/A = 0, negative at A = 0 where it buckles.
    slack = 0.5 * k**4 - ratio * k**2 + 0.5
    if slack >= 0:
        raise NoShapeError(f"at {ratio:.4g} times the onset a pipe of such half waves stays straight")
    a = float(brentq(lambda a: slack + 0.75 * k**4 * a**2 + j1(a) / a - 0.5, 1e-6, 2 * np.pi))
    x = np.linspace(0, quarter, 41)
    sine, cosine = a * np.sin(k * x), a * np.cos(k * x)
    start = np.stack([sine, k * cosine, -(k**2) * sine, -(k**3) * cosine])

    def ends(low: Array, turning: Array) -> Array:
        return np.array([low[0], low[2], turning[1], turning[3]])

    x, y = _solve(ratio, x, start, ends)
    if y[0, -1] < 0.1 * a:
        raise NoShapeError(f"no snaking of such half waves was found at {ratio:.4g} times the onset")
    return x, y


def _helix(ratio: float, half: float) -> Solution:
    """Half a turn from the low side to the high side, as ``_snake``."""
    x = np.linspace(0, half, 81)
    k = np.pi / half
    start = np.stack([k * x, np.full_like(x, k), 0 * x, 0 * x])

    def ends(low: Array, high: Array) -> Array:
        return np.array([low[0], low[2], high[0] - np.pi, high[2]])

    return _solve(ratio, x, start, ends)


def _solve(ratio: float, x: Array, start: Array, ends: Callable[[Array, Array], Array]) -> Solution:
    """Mitchell's equation between two ends."""

    def slopes(_: Array, y: Array) -> Array:
        angle, first, second, third = y
        return np.stack([first, second, third, 6 * first**2 * second - 2 * ratio * second - np.sin(angle)])

    found = solve_bvp(slopes, ends, x, start, tol=TOLERANCE, max_nodes=20000)
    if not found.success:
        raise NoShapeError(f"at {ratio:.4g} times the onset: {found.message}")
    return found.x, found.y


def _scaled(pipe: Pipe, force: float, x: Array, y: Array) -> Shape:
    """A solution in metres."""
    length = pipe.wave
    return Shape(pipe, force, length * x, y[0], (y[1] / length, y[2] / length**2, y[3] / length**3))


def _best(solve: Callable[[float, float], Solution], ratio: float, bounds: tuple[float, float]) -> float:
    """Length of the part with the least mean energy, between bounds."""

    def energy(part: float) -> float:
        return _scaled(UNIT, ratio * UNIT.onset, *solve(ratio, part)).energy

    return float(minimize_scalar(energy, bounds=bounds, method="bounded", options={"xatol": 1e-5}).x)
