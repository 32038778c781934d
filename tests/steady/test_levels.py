"""Levels of a refinement: what remains of the errors, and what errors are relative to."""

import math

import numpy as np
import pytest

import fctd
from fctd.model.layouts import uniform, with_components
from fctd.steady.levels import SAFETY, Level, errors_of, relative_difference
from tests.cases import make_case, pipe


def levels(values: list[float]) -> list[Level]:
    """Levels with one load, NaN where a string was not solved."""
    return [
        Level(
            "string",
            "uniform",
            make_case(),
            2**k,
            1.0,
            np.array([[value, 0.0]]),
            np.ones((1, 2)),
            [],
            [],
            fineness=2.0**k,
        )
        for k, value in enumerate(values)
    ]


def test_the_estimate_of_a_regular_sequence_is_what_is_missing() -> None:
    """First order: v_k = 1 + 2^-k is 2^-k off; the factor of safety is on top."""
    for last in (1, 3, 6):
        _, error = errors_of(levels([1 + 2.0**-k for k in range(last + 1)]))
        assert error[0, 0] == pytest.approx(SAFETY * 2.0**-last)


def test_one_small_change_is_not_taken_for_convergence() -> None:
    change, error = errors_of(levels([1.0, 1.4, 1.3, 1.3001]))
    assert change[0, 0] == pytest.approx(1e-4)
    assert error[0, 0] == pytest.approx(SAFETY * 0.1)  # of the first change, halved twice


def test_a_level_without_an_answer_is_bridged() -> None:
    """A change over two doublings is three times what is missing after it."""
    _, error = errors_of(levels([1.3, math.nan, 1.0]))
    assert error[0, 0] == pytest.approx(SAFETY * 0.1)
    _, error = errors_of(levels([1.3, 1.2, math.nan]))
    assert np.isnan(error[0, 0])


def test_the_error_of_a_load_near_zero_is_relative_to_its_parts() -> None:
    """Friction carries nearly all of a string in a slant hole: its hook load is near zero."""
    hole = {"geometry": "arcs", "intervals": [{"to_md": 900, "diameter": 0.2159, "friction": math.tan(0.5235)}]}
    case = make_case([[0, 60, 0], [900, 60, 0]], [pipe(None, None, segment_length=10.0)], wellbore=hole)
    coarse, fine = (
        fctd.equilibrium(with_components(case, uniform(case, 900.0, length)), "trip_in", 900.0) for length in (90.0, 45)
    )
    weight = 9.80665 * math.pi / 4 * (0.127**2 - 0.07**2) * 7850 * 900
    assert abs(fine.hookload) < 0.02 * weight
    expected = abs(coarse.hookload - fine.hookload) / (0.1 * weight)
    assert relative_difference(coarse, fine, spin=0.0)[0] == pytest.approx(expected)


def test_torque_of_a_sliding_string_is_relative_to_the_torque_of_rotation() -> None:
    """In a hole that turns, chords cause a little torque in pure sliding, which needs no finer segments."""
    case = make_case(
        [[0, 30, 0], [900, 60, 90]], [pipe(None, None, segment_length=20.0)], wellbore={"geometry": "arcs"}
    )
    coarse, fine = (
        fctd.equilibrium(with_components(case, uniform(case, 900.0, length)), "trip_in", 900.0) for length in (20.0, 10)
    )
    gone = abs(coarse.surface_torque - fine.surface_torque)
    assert gone > 0.1 * abs(fine.surface_torque)
    assert relative_difference(coarse, fine, spin=0.0)[1] == pytest.approx(gone / fine.sum_r_mu_fn)
    assert relative_difference(coarse, fine, spin=1.0)[1] == pytest.approx(gone / (0.1 * fine.sum_r_mu_fn))
    by_kind = [fctd.refine(case, 0.01, kind, 900.0).segments for kind in ("trip_in", "rotate_off_bottom")]
    assert by_kind[0] <= by_kind[1]
