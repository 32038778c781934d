"""Ringing of a string that slides past the seams between cylinders: the estimate and a simulation."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, simulate
from fctd.model.wellbore import build_wellbore
from fctd.simulation.preparation import prepare
from fctd.simulation.ringing import SPAN, STRIDE, Ringing, cylinder_tilt, expected_ringing
from references import contact
from validation.cases import load, rotation, trip
from validation.studies.energy_ledger import RUNS, SHARPEST
from validation.studies.long_segment import chain_frequencies


def well_b(start: float = 1750.0, end: float = 2450.0, speed: float = 0.5, **changes: Any) -> Case:
    # A ramp of twenty periods causes no ringing by itself.
    return load("paper_well_b", operations=trip(start, end, speed, 40.0), **changes)


def ringing(case: Case) -> Ringing:
    return expected_ringing(*prepare(case))


COLLARS, PIPE = "string__components__0__segments", "string__components__1__segments"


@pytest.mark.parametrize("overlap", [0.0, 0.2])
def test_the_tilt_is_a_sawtooth(overlap: float) -> None:
    """Harmonics of a chord of 2 m in a bend of curvature κ: κℓ/πn, changed by the blending in an overlap.

    There the direction turns evenly, by twice the kink, and jumps back by one.
    """
    hole = build_wellbore(well_b(wellbore__overlap=overlap))
    edges = np.linspace(1900.0, 2000.0, 4001)[:, None]  # fifty cylinders
    tilt = cylinder_tilt(hole).means(edges)[:, 0]
    bend, length = np.radians(16) / 100, 2.0
    for n in (1, 2, 3):
        # A tilt is a small turn in one plane; its direction follows the hole.
        wave = 2 * np.mean(tilt * np.exp(2j * np.pi * n * edges[:-1] / length), axis=0)
        share = np.linalg.norm(np.abs(wave))
        blended = abs(2 * np.sinc(n * overlap / length) - np.exp(-1j * np.pi * n * overlap / length))
        assert share == pytest.approx(bend * length / (np.pi * n) * blended, rel=0.03)


@pytest.mark.slow
def test_ringing_is_expected_where_a_harmonic_meets_the_string() -> None:
    swing, frequency, depth = ringing(well_b()).largest()
    assert swing > 8e3
    assert frequency == pytest.approx(2 * 0.5 / 2.0, rel=0.03)  # second harmonic of 0.5 m/s over 2 m
    assert 2160 < depth < 2300
    # At a tenth more speed the resonance comes at a tenth more frequency, where less of the string is in the bend:
    # more is expected of the fifth harmonic, which meets the second mode.
    assert ringing(well_b(speed=0.55)).largest()[0] < 0.4 * swing
    assert ringing(well_b(**{COLLARS: 19})).largest()[0] < 0.2 * swing  # no whole number of cylinders
    assert ringing(well_b(mud__axial_damping=5.0)).largest()[0] < 0.3 * swing
    assert ringing(well_b(wellbore__geometry="arcs")).largest() == (0.0, 0.0, 0.0)
    # Pulled out, the string passes the same seams.
    assert 0.5 * swing < ringing(well_b(2450.0, 1750.0)).largest()[0] < 2 * swing


def test_frequencies_are_those_of_the_chain_at_that_depth() -> None:
    expected = ringing(well_b(2000.0, 2100.0))
    for at in (0, -1):
        chain, _ = chain_frequencies(load("paper_well_b", operations=rotation(expected.bit_depth[at], 10.0, 1.0)))
        assert expected.frequency[at] == pytest.approx(chain[: expected.frequency.shape[1]], rel=1e-6)


def test_ringing_is_expected_of_cylinders_in_motion_alone() -> None:
    run, phases = prepare(well_b(2000.0, 2100.0))
    _, cruise = phases
    assert len(expected_ringing(run, phases).bit_depth) == round(cruise.motion.duration * 0.5 / STRIDE)
    # Rows are no further apart than a slow string slides in the span over which forces are constant.
    slow = expected_ringing(*prepare(well_b(2000.0, 2010.0, speed=0.01))).bit_depth
    assert np.diff(slow).max() <= 0.01 * SPAN + 1e-9
    assert not len(ringing(load("paper_well_b", operations=rotation(2000.0, 60.0, 1.0))).bit_depth)
    case = well_b(2000.0, 2100.0)
    assert not len(expected_ringing(*prepare(case, contact.build("for_loop", case))).bit_depth)


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_a_run_that_rings_says_so(geometry: str) -> None:
    """The end of a window of well b swings as estimated, and the result has a note; with arcs neither happens.

    Hardly any friction: where friction sets in with the motion, the string rings for that.
    """
    case = well_b(
        2120.0, 2230.0, wellbore__geometry=geometry, wellbore__intervals__0__friction=0.01, record__interval=0.25
    )
    expected = ringing(well_b(2120.0, 2230.0)).amplitude.max()
    result = simulate(case)
    load_N, depth = result.history["hookload_N"], result.history["bit_depth_m"]
    swing = (load_N - load_N.rolling(60, center=True).mean())[depth > 2190].abs().max()
    if geometry == "arcs":
        assert result.message == ""
        assert swing < 0.1 * expected
    else:
        assert "seams between the hole's cylinders at its natural frequency, 0.49 Hz: near 2215 m" in result.message
        assert 0.4 * expected < swing < 1.5 * expected


def test_the_ledger_closes_over_the_seams_of_a_very_sharp_bend() -> None:
    """Sixty degrees in 50 m, pulled through: 0.3 % of the work where the wall does not push along the hole."""
    file, changes = RUNS[SHARPEST]
    assert simulate(load(file, **changes)).run["energy_error"] < 1e-3
