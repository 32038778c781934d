"""Friction with two factors, along the hole and around it: two laws on one ellipse, which differ in direction.

A contact that slides with (v_a, v_r) has friction (F_a, F_r) with (F_a/μ_a N)² + (F_r/μ_r N)² = 1 by either law:

- ``associated``, that of FCTD: of all forces in the ellipse the one that takes most energy (maximum dissipation),
  (F_a, F_r) = N (μ_a² v_a, μ_r² v_r)/√(μ_a² v_a² + μ_r² v_r²).  It follows from a potential, as plastic flow does
  (Moreau 1970; Goyal, Ruina & Papadopoulos 1991 for friction), so that the sliding of a point is unique.
- ``by_components``, that of other tools: each component of Coulomb's force takes its own factor,
  (F_a, F_r) = N (μ_a v_a, μ_r v_r)/√(v_a² + v_r²).

With (F_a, F_r) = N (μ_a cos φ, μ_r sin φ) and tan ψ = v_r/v_a, the one has tan φ = (μ_r/μ_a) tan ψ and the other φ = ψ.
"""

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np


class Components(NamedTuple):
    """Friction per wall force along the hole and around it, in the directions of the sliding."""

    along: float
    around: float


Direction = Callable[[float, float, float, float], Components]
"""(factor along, factor around, v_a, v_r) → friction per wall force."""


def associated(factor: float, around: float, v_a: float, v_r: float) -> Components:
    """By maximum dissipation; none at rest, or where the sliding has no friction."""
    if factor == around:
        return by_components(factor, around, v_a, v_r)
    size = float(np.hypot(factor * v_a, around * v_r))
    if size == 0:
        return Components(0.0, 0.0)
    return Components(factor * (factor * v_a / size), around * (around * v_r / size))


def by_components(factor: float, around: float, v_a: float, v_r: float) -> Components:
    """Coulomb's components, each with its own factor; none at rest."""
    size = float(np.hypot(v_a, v_r))
    return Components(factor * (v_a / size), around * (v_r / size)) if size else Components(0.0, 0.0)


LAWS: Final[dict[str, Direction]] = {"associated": associated, "by_components": by_components}


def largest_turn(ratio: float) -> float:
    """Largest difference of both laws in φ [rad] for a ratio μ_r/μ_a: asin |μ_r − μ_a|/(μ_r + μ_a).

    It is that at tan ψ = √(μ_a/μ_r), where one of them has √(μ_a/μ_r) times the other's friction along the hole.
    """
    return float(np.arcsin(abs(ratio - 1) / (ratio + 1)))
