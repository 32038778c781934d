"""The numbers of a case: path, weights and clearances by hand, the string where it ends above the hole."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.summary import segments_in_words, summarise
from tests.cases import make_case, pipe

QUARTER = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]
RADIUS = 450 / (np.pi / 2)


@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_the_path_of_a_quarter_circle(geometry: str) -> None:
    path = summarise(make_case(QUARTER, [pipe(None, None)], wellbore={"geometry": geometry})).path
    near = 0.5 if geometry == "cylinders" else 1e-6
    assert path.vertical_depth == pytest.approx(300 + RADIUS, abs=near)
    assert path.departure == pytest.approx(RADIUS + 150, abs=near)
    assert (path.stations, path.depth) == (4, 900.0)
    assert np.degrees(path.inclination) == pytest.approx(90)
    assert path.inclination_at == 750.0
    assert path.dogleg == pytest.approx(1 / RADIUS)
    assert (path.dogleg_from, path.dogleg_to) == (300.0, 750.0)


def test_weights_and_clearances() -> None:
    parts = [pipe(100.0, 4, linear_mass=100.0, outer=0.17), pipe(None, None, linear_mass=30.0, density=3925.0)]
    summary = summarise(make_case(QUARTER, parts, mud={"density": 785.0}))
    assert [part.from_md for part in summary.parts] == [0.0, 800.0]
    assert [part.to_md for part in summary.parts] == [800.0, 900.0]
    assert summary.air == pytest.approx(GRAVITY * (800 * 30 + 100 * 100))
    assert summary.buoyed == pytest.approx(GRAVITY * (800 * 30 * 0.8 + 100 * 100 * 0.9))
    assert summary.buoyancy_factor == pytest.approx((24 * 0.8 + 10 * 0.9) / 34)
    assert summary.parts[1].clearances == (pytest.approx(0.5 * (0.2159 - 0.17)),)


@pytest.mark.parametrize(("top", "length", "bit"), [(0.0, 500.0, 500.0), (200.0, 500.0, 700.0), (200.0, 5000.0, 900.0)])
def test_a_string_that_ends_above_the_hole(top: float, length: float, bit: float) -> None:
    summary = summarise(make_case(QUARTER, [pipe(30.0, 1), pipe(length - 30.0, 10), pipe(9000.0, 1)][:2], top_md=top))
    assert summary.bit_depth == bit
    assert summary.parts[0].from_md == top
    assert summary.string().bit_depth == bit


def test_a_string_that_does_not_fit() -> None:
    summary = summarise(make_case(QUARTER, [pipe(None, None, contact_diameter=0.22)]))
    assert summary.parts[0].clearances[0] < 0
    with pytest.raises(InputError, match="contact_diameter"):
        summary.string()


def test_the_segments_in_words() -> None:
    even = make_case(QUARTER, [pipe(900.0, 36)])
    assert segments_in_words(even, summarise(even).string()) == "36 segments of 25 m with the bit at 900.0 m"
    chosen = make_case(QUARTER, [pipe(None, None)])
    text = segments_in_words(chosen, summarise(chosen).string(), 1 / 0.3048, "ft")
    assert text.endswith("with the bit at 2952.8 ft, by default short in bends and near the bit")
