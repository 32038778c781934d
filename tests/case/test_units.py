"""Quantities: a number with a unit in SI, and every text that is none."""

import contextlib
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.case import units
from fctd.case.errors import InputError


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("12 m", units.LENGTH, 12.0),
        ("40 ft", units.LENGTH, 12.192),
        ("8.5in", units.LENGTH, 0.2159),
        ("-2 mm", units.LENGTH, -0.002),
        ("102 mm", units.LENGTH, 0.102),
        (3, units.LENGTH, 3.0),
        ("1e6 N/m/m", units.STIFFNESS_PER_LENGTH, 1e6),
        ("1200 kg/m^3", units.DENSITY, 1200.0),
        ("1200 kg/m³", units.DENSITY, 1200.0),
        ("10 ppg", units.DENSITY, 1198.26427316897),  # 0.45359237 kg / (231 · 0.0254³ m³)
        ("1.4 sg", units.DENSITY, 1400.0),
        ("5 N*m", units.TORQUE, 5.0),
        ("5 N·m", units.TORQUE, 5.0),
        ("206.8 GPa", units.STRESS, 206.8e9),
        ("3 lbf", units.FORCE, 13.3446648457815),  # 0.45359237 · 9.80665 N
        ("3 klbf", units.FORCE, 13344.6648457815),
        ("1 lb/ft", units.LINEAR_MASS, 1.48816394356955),  # 0.45359237 / 0.3048 kg/m
        ("60 ft/min", units.SPEED, 0.3048),
        ("2 min", units.TIME, 120.0),
        ("3 N*m*s/m", units.ROTATIONAL_DAMPING, 3.0),
    ],
)
def test_quantity(text: object, dimension: units.Dimension, value: float) -> None:
    assert units.Quantity(dimension=dimension).parse(text) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    "value",
    [
        *("12", "m", "", "12 s", "12 parsnips", "nan m", "inf m", "1e400 m", "1e99999999999999999999 m"),
        *(
            "85/8 in",
            "8 1/3 in",
            "2 m + 3 m",
            "10**10**10 m",
            "2 m * 3",
            "3 degC",
            "1 m m",
            "__import__('os')",
            "1 mm" + 90 * " ",
        ),
        *(True, None, math.nan, math.inf, 10**400, [1], {}),
    ],
)
def test_no_quantity(value: object) -> None:
    with pytest.raises(InputError, match="expected a length such as '12 m' or '40 ft'"):
        units.Quantity(dimension=units.LENGTH).parse(value)


@settings(max_examples=100)
@given(text=st.text(max_size=12) | st.from_regex(r"\A[0-9]{1,3} [a-zµ°]{1,5}([*/^]{1,2}[a-z0-9]{1,3})?\Z"))
def test_any_text_is_a_length_or_refused(text: str) -> None:
    with contextlib.suppress(InputError):
        assert math.isfinite(units.Quantity(dimension=units.LENGTH).parse(text))


def test_units_of_the_field_have_no_prefix_but_kilo() -> None:
    """To pint "usft" is a micro-foot, "mt" a thousandth of a ton: a depth of 5000 usft was one of half an inch."""
    assert units.argument("5000 usft", units.LENGTH, "md") == pytest.approx(5000 * 1200 / 3937, rel=1e-12)
    assert units.argument("40 mt", units.FORCE, "up") == pytest.approx(40e3 * 9.80665)
    assert units.argument("5 kft", units.LENGTH, "md") == units.argument("5000 ft", units.LENGTH, "md")
    for text, dimension in (("92 mft", units.LENGTH), ("92 uft", units.LENGTH), ("500 mgpm", units.FLOW)):
        with pytest.raises(InputError, match=dimension.noun):
            units.argument(text, dimension, "key")
