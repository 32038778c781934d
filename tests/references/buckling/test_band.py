"""Half waves in which snaking stands: the shift is neutral, the least energy stands, Eckhaus' band near the onset."""

import numpy as np
import pytest

from references.buckling.band import band, stands, stiffness
from references.buckling.mitchell import NoShapeError, snaking
from references.buckling.onset import Pipe

PIPE = Pipe(EI=1.2e6, weight=260.0, clearance=0.044)


@pytest.mark.parametrize("ratio", [1.1, 1.4])
def test_shift_of_all_waves_is_neutral(ratio: float) -> None:
    shape = snaking(PIPE, ratio * PIPE.onset)
    assert stiffness(shape, 1.0) == pytest.approx(0, abs=1e-6)
    assert stiffness(shape, 0.5) > 0.01


def test_small_waves_have_the_stiffness_of_a_beam_on_a_foundation() -> None:
    """That is the least of k⁴ − 2βk² + 1 over k = κ + 2πn/P."""
    ratio = 1.001
    shape = snaking(PIPE, ratio * PIPE.onset)
    k = (2 * np.arange(-3, 4) + 0.25) * np.pi * PIPE.wave / shape.length
    assert stiffness(shape, 0.25) == pytest.approx((k**4 - 2 * ratio * k**2 + 1).min(), rel=0.02)


@pytest.mark.slow
def test_band_encloses_the_least_energy() -> None:
    force = 1.25 * PIPE.onset
    shortest, longest = band(PIPE, force)
    best = snaking(PIPE, force).length
    assert shortest < best < longest
    assert stands(PIPE, force, 1.005 * shortest)
    assert not stands(PIPE, force, 0.995 * shortest)
    assert stands(PIPE, force, 0.995 * longest)
    assert not stands(PIPE, force, 1.005 * longest)


def test_band_near_the_onset() -> None:
    """There 1/√3 of the half waves that buckle stand (Eckhaus 1965)."""
    ratio = 1.002
    shortest, longest = band(PIPE, ratio * PIPE.onset)
    spread = np.sqrt(ratio**2 - 1)
    buckling = np.pi * PIPE.wave * (1 / np.sqrt(ratio - spread) - 1 / np.sqrt(ratio + spread))
    assert (longest - shortest) / buckling == pytest.approx(1 / np.sqrt(3), rel=0.04)


def test_no_band_of_a_straight_pipe() -> None:
    with pytest.raises(NoShapeError, match=r"0\.99 times the onset"):
        band(PIPE, 0.99 * PIPE.onset)
