"""Waves of the hole's axis: their size and wavelength, their seed, and the segments that can follow them."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.wall import TortuositySpec
from fctd.model import survey
from fctd.model.default_layout import DefaultLayout
from fctd.model.tortuosity import resolving, shortfall, winding
from fctd.model.wellbore import Wellbore
from tests.cases import hole_of, make_case, pipe

STATIONS = [[0, 0, 0], [300, 0, 0], [750, 60, 40], [1500, 60, 40]]
WAVES = {"amplitude": 0.02, "wavelength": 10.0}


def hole(**more: Any) -> Wellbore:
    return hole_of(STATIONS, geometry="arcs", **more)


def deviation(seed: int) -> np.ndarray:
    """Way of the winding axis from the straight one (n, 3) [m], without what is longer than three waves."""
    md = np.arange(0.0, 1500.0, 0.25)
    way = hole(tortuosity=WAVES | {"seed": seed}).at(md)[0] - hole().at(md)[0]
    window = np.ones(120) / 120
    return np.stack([way[:, k] - np.convolve(way[:, k], window, mode="same") for k in range(3)], axis=1)[200:-200]


def test_each_direction_across_the_hole_has_the_root_mean_square_of_a_sine() -> None:
    way = np.stack([deviation(seed) for seed in range(4)])
    total = np.sqrt((way**2).sum(axis=2).mean())
    assert total == pytest.approx(WAVES["amplitude"], rel=0.01)  # √2 times that of one direction, amplitude/√2


def test_rounding_adds_no_station() -> None:
    """A hole of two wavelengths has 33 stations in metres and in feet: others would be another hole."""
    stations = np.array([[0.0, 0.0, 0.0], [716.0, 0.0, 0.0]])
    for wavelength in (358.0 * (1 - 1e-15), 358.0):
        assert len(winding(stations, TortuositySpec(amplitude=0.02, wavelength=wavelength, seed=1))) == 33


def test_the_waves_have_the_wavelength() -> None:
    """Zero crossings of a slope of a vertical hole, as many as the moments of its spectrum give (Rice 1944)."""
    stations = np.array([[0.0, 0.0, 0.0], [2000.0, 0.0, 0.0]])
    north = survey.tangents(winding(stations, TortuositySpec(**WAVES)))[:, 0]
    crossings = np.count_nonzero(np.diff(np.sign(north)))
    rates = 2 * np.pi / (WAVES["wavelength"] * np.linspace(0.8, 1.2, 9))
    expected = 2000 / np.pi * np.sqrt((rates**4).sum() / (rates**2).sum())
    assert crossings == pytest.approx(expected, rel=0.03)


def test_equal_seeds_give_equal_holes() -> None:
    first, again, other = (hole(tortuosity=WAVES | {"seed": seed}).pieces for seed in (3, 3, 4))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_hole_keeps_its_depth_and_nearly_its_way() -> None:
    plain, winding_one = hole(), hole(tortuosity=WAVES)
    assert winding_one.total_depth == plain.total_depth
    md = np.linspace(0, 1500, 400)
    assert np.linalg.norm(winding_one.at(md)[0] - plain.at(md)[0], axis=1).max() < 0.15
    # The axis winds within the measured depth: its way along the hole is shorter by half of the mean square slope.
    slope = 2 * np.pi * WAVES["amplitude"] / WAVES["wavelength"]
    lost = plain.at(np.array([1500.0]))[0] - winding_one.at(np.array([1500.0]))[0]
    assert np.linalg.norm(lost) < 1500 * slope**2 + 3 * WAVES["amplitude"]


def test_segments_of_an_eighth_of_a_wave_follow_it() -> None:
    spec = TortuositySpec(**WAVES)
    assert shortfall(spec, 1.25) == shortfall(None, 30.0) == ""
    assert "segments of at most 1.25 m" in shortfall(spec, 1.3)
    assert resolving(spec) == 1.25
    assert "segments of 1.26 m are too long" in shortfall(spec, 1.2501)  # not: 1.25 m are too long, use 1.25 m
    case = make_case(STATIONS, [pipe(None, None)], wellbore={"tortuosity": WAVES})
    assert DefaultLayout(case, 1400.0).limit.max() <= 1.25


@pytest.mark.parametrize(("keys", "message"), [
    ({"tortuosity": WAVES | {"amplitude": 0.2}}, r"amplitude.*at most 1/100 of wavelength, 0\.1 m"),
    ({"tortuosity": WAVES, "survey_method": "average_angle"}, r"survey_method.*minimum_curvature beside tortuosity"),
])  # fmt: skip
def test_bad_waves_are_refused(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        hole_of(STATIONS, **keys)


def test_waves_that_need_too_many_stations_are_refused() -> None:
    with pytest.raises(InputError, match=r"wellbore\.tortuosity\.wavelength.*at most 200000 stations"):
        hole_of(STATIONS, tortuosity={"amplitude": 1e-5, "wavelength": 0.01})
