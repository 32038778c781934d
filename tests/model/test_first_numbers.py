"""Where a new case has its shoe, and how stiff its wall is: by hand."""

import numpy as np
import pytest

from fctd.case.string import ComponentSpec
from fctd.model.first_numbers import laid, round_up, sensible_shoe, stiff_wall
from fctd.model.new_case import wall_of
from fctd.model.templates import TEMPLATES

STRAIGHT = np.array([[0.0, 0.0, 0.0], [1000.0, 0.0, 0.0]])


def test_the_wall_of_a_hanging_string_by_hand() -> None:
    """Straight hole: the weight of a metre of pipe over a hundredth of its clearance, rounded up to 1, 2 or 5."""
    template = TEMPLATES["casing-run"]
    weight = 47 * 0.4536 / 0.3048 * 9.81 * (1 - template.mud / 7850)
    clearance = 0.5 * 0.0254 * (12.25 - 10.625)
    needed = weight / (0.01 * clearance)
    assert needed == pytest.approx(2.8e6, rel=0.02)
    assert wall_of(template, STRAIGHT, 500.0) == 5e6


@pytest.mark.parametrize(
    ("stations", "shoe"),
    [
        ([(0, 0), (500, 0), (1230, 60), (3000, 60)], 1230.0),  # where the build ends
        ([(0, 0), (500, 0), (800, 60), (3000, 60)], 1200.0),  # not above 40 %
        ([(0, 0), (500, 0), (2800, 60), (3000, 60)], 2100.0),  # not below 70 %
        ([(0, 0), (2000, 0)], 800.0),  # vertical
        ([(0, 0), (8, 3)], 3.2),  # too short for a round depth
    ],
)
def test_the_shoe_of_a_survey(stations: list[tuple[float, float]], shoe: float) -> None:
    array = np.array([(md, np.radians(inc), 0.0) for md, inc in stations])
    assert sensible_shoe(array, 10.0) == pytest.approx(shoe)
    assert (sensible_shoe(array, 50 * 0.3048) / 0.3048) % 50 == pytest.approx(0, abs=1e-6) or stations[-1][0] < 50


def test_a_bit_of_the_diameter_of_the_hole_asks_for_no_stiffer_wall() -> None:
    (collar, pipe) = laid(TEMPLATES["build-hold"], 500.0, 1000.0)[::2]
    bit = ComponentSpec(name="bit", length=0.3, outer_diameter=0.15, inner_diameter=0.05, contact_diameter=0.2159)
    parts = [collar, pipe]
    assert stiff_wall([(bit, 0.3), *parts], 1250.0, 0.2159, STRAIGHT) == stiff_wall(parts, 1250.0, 0.2159, STRAIGHT)
    tight = ComponentSpec(name="tool", length=9.0, outer_diameter=0.2158, inner_diameter=0.05)
    assert np.isfinite(stiff_wall([(tight, 9.0)], 1250.0, 0.2159, STRAIGHT))
    assert np.isfinite(stiff_wall([(tight, 9.0)], 1250.0, np.inf, STRAIGHT))


@pytest.mark.parametrize(("number", "rounded"), [(1.0, 1.0), (1.01, 2.0), (2.0, 2.0), (4e6, 5e6), (5.1e-3, 1e-2)])
def test_numbers_are_rounded_up_to_1_2_or_5(number: float, rounded: float) -> None:
    assert round_up(number) == pytest.approx(rounded)


def test_the_string_of_a_template_reaches_the_surface() -> None:
    lengths = [length for _, length in laid(TEMPLATES["horizontal"], 2400.0, 3600.0)]
    assert lengths == [30.0, 1200.0, 750.0, 1620.0]
