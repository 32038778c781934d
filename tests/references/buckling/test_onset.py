"""Limits of buckling: their equations hold, and they agree with each other where they meet."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from references.buckling.onset import FREE_END, Pipe, half_wave, snaking_limit

PIPE = Pipe(EI=1.2e6, weight=260.0, clearance=0.044)


def load(force: float, inclination: float, build: float) -> float:
    """The pipe's load on the wall [N/m]."""
    return float(PIPE.weight * np.sin(inclination) + force * build)


@given(st.floats(0.01, np.pi / 2), st.floats(0, 0.01))
def test_the_force_solves_its_equation(inclination: float, build: float) -> None:
    force = snaking_limit(PIPE, inclination, build)
    assert force == pytest.approx(2 * np.sqrt(PIPE.EI * load(force, inclination, build) / PIPE.clearance))


def test_build_in_the_published_form() -> None:
    EI, weight, r = PIPE
    inclination, build = np.radians(50), np.radians(10) / 30
    root = np.sqrt(1 + r * weight * np.sin(inclination) / (EI * build**2))
    assert snaking_limit(PIPE, inclination, build) == pytest.approx(2 * EI * build / r * (1 + root))


def test_onset_is_the_first_force_of_a_wave() -> None:
    """EI k⁴ − F k² + w/r = 0 has a double root at the onset, at the wave of ``half_wave``."""
    EI, weight, r = PIPE
    k = np.pi / half_wave(PIPE)
    assert PIPE.onset == pytest.approx(EI * k**2 + weight / r / k**2)
    for other in (0.99 * k, 1.01 * k):
        assert EI * other**2 + weight / r / other**2 > PIPE.onset


def test_free_end_of_a_beam_on_a_foundation() -> None:
    """A half-infinite beam with a free end, by the determinant of its two decaying waves."""

    def determinant(ratio: float) -> float:
        # u'''' + 2β u'' + u = 0 over the wave length; M = u'' = 0 and V = u''' + 2β u' = 0 at the end.
        roots = np.roots([1, 0, 2 * ratio, 0, 1])
        a, b = roots[roots.real < 0]
        return float(abs(a**2 * (b**3 + 2 * ratio * b) - b**2 * (a**3 + 2 * ratio * a)))

    assert determinant(FREE_END) < 1e-6
    assert min(determinant(0.9 * FREE_END), determinant(1.1 * FREE_END)) > 1e-2
