"""Snaking of a pipe with ends: hinged ones let the whole band stand, clamped ones little of it."""

import numpy as np
import pytest

from references.buckling import ends
from references.buckling.band import band
from references.buckling.mitchell import UNIT, NoShapeError, snaking

RATIO, HALF_WAVES = 1.25, 24


@pytest.mark.parametrize("clamped", [True, False])
def test_slope_and_bands_are_those_of_the_energy(clamped: bool) -> None:
    angle, h, size = np.sin(np.arange(1.0, 9.0)), 0.2, 1e-6
    moved = size * np.eye(len(angle))
    slope = [
        (ends._energy(angle + by, h, RATIO, clamped) - ends._energy(angle - by, h, RATIO, clamped)) / (2 * size * h)
        for by in moved
    ]
    assert ends._slope(angle, h, RATIO, clamped) == pytest.approx(slope, rel=1e-5)
    change = [
        (ends._slope(angle + by, h, RATIO, clamped) - ends._slope(angle - by, h, RATIO, clamped)) / (2 * size)
        for by in moved
    ]
    bands = ends._bands(angle, h, RATIO, clamped)
    whole = sum(np.diag(bands[2 - k, max(k, 0) : len(angle) + min(k, 0)], k) for k in range(-2, 3))
    assert whole == pytest.approx(np.array(change), abs=1e-5 / h**4)


def test_hinged_ends_keep_the_half_waves_of_the_band() -> None:
    """Half waves that divide the pipe are the endless pipe's; those beyond the band become ones within it."""
    best, inside = snaking(UNIT, RATIO * UNIT.onset).length, (21, 24, 28)
    length = HALF_WAVES * best
    for count in inside:
        assert ends.taken(RATIO, length / count, length, clamped=False) == pytest.approx(length / count, rel=2e-3)
    shortest, longest = band(UNIT, RATIO * UNIT.onset)
    for laid in (0.95 * shortest, 1.05 * longest):
        assert shortest < ends.taken(RATIO, laid, length, clamped=False) < longest


@pytest.mark.parametrize("share", [0.88, 1.16])
def test_clamped_ends_let_waves_in_and_out(share: float) -> None:
    best = snaking(UNIT, RATIO * UNIT.onset).length
    assert ends.taken(RATIO, share * best, HALF_WAVES * best, clamped=True) == pytest.approx(best, rel=0.04)


def test_half_waves_that_do_not_buckle() -> None:
    with pytest.raises(NoShapeError):
        ends.taken(RATIO, 2 * np.pi, 24 * np.pi, clamped=True)
