"""Half waves in which snaking stands: stability of Mitchell's shapes against shifts of their waves.

At one compression Mitchell's equation has snaking of a whole range of half waves.  Such a shape stands in a long pipe
where the second variation of its energy,

    φ'''' − (6 θ'² φ')' + 2β φ'' + cos θ φ        (units as in mitchell.py),

is positive for all φ.  Its coefficients repeat every half wave P, so φ is a function of period P times e^(iκs) (Bloch);
κ = π/P is the shift of all waves along the hole, which is neutral.  Where waves are too short or too long the shape
first gives way to shifts that vary slowly along the hole (Eckhaus 1965): some half waves vanish, or more appear.
"""

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from references.buckling.mitchell import UNIT, NoShapeError, Shape, snaking
from references.buckling.onset import Pipe

SAMPLES, HARMONICS = 64, 21  # of a half wave; of φ, so that products with the coefficients are not aliased
NUMBERS = np.append(np.arange(20) / 20, 0.995)  # κ over π/P, up to shifts that vary over 200 half waves
EDGE = 1e-3  # relative accuracy of the ends of the band


def stiffness(shape: Shape, number: float) -> float:
    """Least eigenvalue of the second variation of snaking [1], for waves e^(iκs) of κ = number · π/P."""
    half, ratio = shape.length / shape.pipe.wave, shape.force / shape.pipe.onset
    s = np.arange(SAMPLES) * half / SAMPLES
    part, slope = shape.s / shape.pipe.wave, shape.derivatives[0] * shape.pipe.wave
    second = shape.derivatives[1] * shape.pipe.wave**2
    rising = np.minimum(s, half - s)
    turning = 6 * CubicHermiteSpline(part, slope, second)(rising) ** 2
    lifting = np.cos(CubicHermiteSpline(part, shape.angle, slope)(rising))
    n = np.arange(-HARMONICS, HARMONICS + 1)
    between = n[:, None] - n
    k = (2 * n + number) * np.pi / half
    of_turning, of_lifting = (np.fft.fft(values).real[between % SAMPLES] / SAMPLES for values in (turning, lifting))
    matrix = np.diag(k**4 - 2 * ratio * k**2) + k[:, None] * of_turning * k + of_lifting
    return float(np.linalg.eigvalsh(matrix)[0])


def stands(pipe: Pipe, force: float, half_wave: float) -> bool:
    """Whether snaking of half waves of a length [m] stands at a compression [N], in a pipe that stays on the wall."""
    try:
        shape = snaking(pipe, force, half_wave)
    except NoShapeError:
        return False
    return all(stiffness(shape, float(number)) > 0 for number in NUMBERS)


def band(pipe: Pipe, force: float) -> tuple[float, float]:
    """Shortest and longest half wave [m] in which snaking stands at a compression [N].

    Raises NoShapeError where the pipe stays straight.
    """
    ratio, best = force / pipe.onset, snaking(UNIT, force / pipe.onset * UNIT.onset).length
    # Half waves between these buckle (mitchell.snaking).
    spread = np.sqrt(ratio**2 - 1)
    shortest, longest = np.pi / np.sqrt(ratio + spread), np.pi / np.sqrt(ratio - spread)

    def stand(half_wave: float) -> bool:
        return stands(UNIT, ratio * UNIT.onset, half_wave)

    return pipe.wave * _edge(stand, best, shortest), pipe.wave * _edge(stand, best, longest)


def _edge(stand: Callable[[float], bool], inside: float, outside: float) -> float:
    """Where the shapes cease to stand, by bisection."""
    while abs(outside - inside) > EDGE * inside:
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if stand(middle) else (inside, middle)
    return inside
