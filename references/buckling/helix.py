"""Helically buckled pipe in closed form: pitch, wall force, moment, shortening, and the force that slides through it.

A weightless pipe of compression F > 0 [N] lies as a helix θ' = const on the wall, at radius r.  The energy a metre
EI r²θ'⁴/2 − F r²θ'²/2 is least for θ'² = F/(2EI) (Lubinski, Althouse & Logan 1962).  In a level hole the weight
averages out over a turn, so these are means there.
"""

import numpy as np

from references.buckling.onset import Pipe


def turning(pipe: Pipe, force: float) -> float:
    """θ' = √(F/2EI) [rad/m]."""
    return float(np.sqrt(force / (2 * pipe.EI)))


def pitch(pipe: Pipe, force: float) -> float:
    """Length of a turn 2π √(2EI/F) [m]."""
    return 2 * np.pi / turning(pipe, force)


def wall_force(pipe: Pipe, force: float) -> float:
    """r F²/(4EI) [N/m] (Mitchell 1986): F rθ'² of the compression less EI rθ'⁴ of the bending."""
    return pipe.clearance * force**2 / (4 * pipe.EI)


def bending_moment(pipe: Pipe, force: float) -> float:
    """EI rθ'² = F r/2 [N m]."""
    return 0.5 * force * pipe.clearance


def vertical_shortening(pipe: Pipe, force_below: float) -> float:
    """Shortening by the helix of a vertical pipe r²F²/(8EI w) [m] (Lubinski, Althouse & Logan 1962).

    force_below [N] : compression at the lower end; it falls by w a metre.  A helix shortens the pipe by r²θ'²/2 a
    metre; the form takes the pitch everywhere as that of a constant force, up to the neutral point, and holds for
    force_below ≫ (EI w²)^⅓.
    """
    return (pipe.clearance * force_below) ** 2 / (8 * pipe.EI * pipe.weight)


def pushed_force(pipe: Pipe, force_below: float, friction: float, length: float) -> float:
    """Compression [N] a length above the lower end of a level helix that slides downhole; infinite beyond lock-up.

    dF/dx = μ r F²/(4EI), so 1/F₀ − 1/F(x) = μ r x/(4EI).
    """
    rest = 1 / force_below - friction * pipe.clearance * length / (4 * pipe.EI)
    return float(1 / rest) if rest > 0 else np.inf


def lock_up_length(pipe: Pipe, force_below: float, friction: float) -> float:
    """Length of level helix through which no push moves a pipe with F₀ at its lower end: 4EI/(μ r F₀) [m]."""
    return 4 * pipe.EI / (friction * pipe.clearance * force_below)


def pushed_force_tan(pipe: Pipe, force_below: float, friction: float, length: float) -> float:
    """The same with the wall force w + r F²/(4EI) of the planning tools [N], in which the weight does not average out.

    F = √(4EI w/r) tan(μx √(w r/4EI) + arctan(F₀ √(r/4EI w))) (Wu & Juvkam-Wold 1993); infinite beyond lock-up.
    """
    scale = np.sqrt(4 * pipe.EI * pipe.weight / pipe.clearance)
    angle = friction * length * pipe.weight / scale + np.arctan(force_below / scale)
    return float(scale * np.tan(angle)) if angle < 0.5 * np.pi else np.inf
