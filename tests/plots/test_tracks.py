"""Quantities of a profile: side force per length and per joint."""

import numpy as np
import pandas as pd
import pytest

from fctd.plots.tracks import (
    JOINT,
    TRACKS,
    label_of,
    lengths_of,
    limits_near,
    scale_of,
    side_force,
    side_force_unit,
    stretches,
    values_of,
)
from tests.plots.made import points


def test_side_force_is_spread_half_way_to_the_neighbours() -> None:
    """Contacts at 10, 30 and 40 m below a top at 0 m: lengths of 5, 15, 15 and 5 m."""
    profile = pd.DataFrame({"md_m": [0.0, 10.0, 30.0, 40.0], "contact_force_N": [0.0, 300.0, 600.0, 50.0]})
    np.testing.assert_allclose(side_force(profile, "length"), [0, 20, 40, 10])
    np.testing.assert_allclose(side_force(profile, "joint"), np.array([0, 20, 40, 10]) * 9.144)
    assert pytest.approx(30 * 0.3048) == JOINT


def test_side_force_keeps_the_sum_of_the_contacts() -> None:
    profile = points()[0].profile
    md = profile["md_m"].to_numpy()
    lengths = np.diff(np.concatenate((md[:1], 0.5 * (md[1:] + md[:-1]), md[-1:])))
    assert side_force(profile, "length") @ lengths == pytest.approx(profile["contact_force_N"].sum(), rel=1e-12)


def test_units_of_side_force() -> None:
    """1 lbf/ft is 14.5939 N/m (NIST SP 811)."""
    assert side_force_unit("si", "length") == (1e-3, "kN/m")
    assert side_force_unit("field", "length").factor == pytest.approx(1 / 14.59390, rel=1e-6)
    assert side_force_unit("field", "joint").label == "lbf per 30 ft"
    assert label_of("contact_force_N", "si", "joint") == ("side force per joint", "kN per 9.14 m")


def test_every_track_has_a_value_for_every_row() -> None:
    point = points()[0]
    for column in TRACKS:
        md, value = values_of(point, column, "si", "length")
        assert len(md) == len(value) == len(point.profile)
        assert np.isfinite(value).all()


def test_stretches_are_runs_of_one_mode() -> None:
    modes = ["none", "sinusoidal", "sinusoidal", "helical", "none", "helical"]
    found = stretches(pd.DataFrame({"buckling": modes}))
    assert found == [(1, 2, "sinusoidal"), (3, 3, "helical"), (5, 5, "helical")]


def test_limits_are_those_near_the_loads() -> None:
    point = next(point for point in points() if point.operation == "drill_sliding")
    near = limits_near([point], "si")
    tension = point.profile["effective_tension_N"] / 1e3
    for limit in near.values():
        assert np.nanmin(limit.value) >= tension.min() - 0.6 * np.ptp(tension)
    assert "sinusoidal" in near


def test_a_scale_follows_length_and_not_the_peak_at_the_bit() -> None:
    values, lengths = np.array([3.0, 4.0, -50.0]), np.array([1000.0, 1000.0, 19.0])
    assert scale_of(values, lengths) == 4.0
    lengths[2] = 21.0  # more than a hundredth of the string
    assert scale_of(values, lengths) == 50.0
    assert scale_of(np.array([4.0, 5.0]), np.array([1000.0, 1.0])) == 5.0  # no peak
    assert scale_of(np.array([0.0, 5.0]), np.array([1000.0, 1.0])) == 5.0  # nothing else
    assert lengths_of(np.array([0.0, 10.0, 40.0])).tolist() == [5.0, 20.0, 15.0]
