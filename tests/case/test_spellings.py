"""Numbers and units as people write them, and those with more than one meaning."""

from decimal import Decimal

import pytest

from fctd.case import spellings, units
from fctd.case.errors import InputError

# Exact by definition (NIST SP 811, appendix B.8): pound [kg], foot and inch [m], standard gravity [m/s^2].
POUND, FOOT, INCH, G = 0.45359237, 0.3048, 0.0254, 9.80665
GALLON = 231 * INCH**3
LBF = POUND * G

WRITTEN: list[tuple[units.Dimension, float, list[str]]] = [
    (units.DENSITY, 1200.0, ["1200 kg/m3", "1200 kg/m³", "1.2 g/cm3", "1.2 g/cc", "1.2 sg", "1.2SG", "1.2 s.g."]),
    (units.DENSITY, 10 * POUND / GALLON, ["10 lbm/gal", "10 lb/gal", "10 ppg", "10 PPG"]),
    (units.DENSITY, 75 * POUND / FOOT**3, ["75 lb/ft3", "75 lb/ft^3", "75 pcf"]),
    (units.TORQUE, 5000.0, ["5 kNm", "5 kN*m", "5 kN·m", "5 kN-m", "5 kN.m", "5 kN m", "5000 Nm", "500 daNm"]),
    (
        units.TORQUE,
        400 * FOOT * LBF,
        ["400 ft-lb", "400 ft·lbf", "400 ft-lbf", "400 ft*lbf", "400 lb-ft", "0.4 kft-lb", "400 ftlb", "0.4 kftlbs"],
    ),
    (units.LINEAR_MASS, 19.5 * POUND / FOOT, ["19.5 ppf", "19.5 lb/ft", "19.5 lbf/ft", "19.5 lbm/ft", "19.5 LB/FT"]),
    (units.LINEAR_MASS, 30.0, ["30 kg/m", "294.1995 N/m", "30 kgf/m"]),
    (units.FORCE, 80e3 * LBF, ["80 klb", "80 klbf", "80 kips", "80 kip", "80000 lb", "80000 lbs", "80000 lbf"]),
    (units.FORCE, 5000 * G, ["5 t", "5 T", "5 tonnes", "5 tonne-force", "5 tf", "5 te", "5 metric tons", "5000 kg"]),
    (units.FORCE, 80e3, ["80 kN", "80 KN", "8 kdaN", "8000 daN", "0.08 MN"]),
    (units.LENGTH, 8.5 * INCH, ["8 1/2 in", "8-1/2 in", "8½ in", '8.5"', "8 1/2″", "8.5 IN", "8.5 inches", "8.5''"]),
    (units.LENGTH, 9.625 * INCH, ["9-5/8 in", "9 5/8 in", '9 5/8"', "9–5/8 in", "9⅝ in"]),
    (units.LENGTH, 0.5 * INCH, ["1/2 in", "½ in"]),
    (units.LENGTH, 40 * FOOT, ["40 ft", "40'", "40 feet", "40 FT"]),
    (units.LENGTH, 3000.0, ["3000 m", "3000 M", "3000 metres", "3 km"]),
    (units.ANGLE, 0.026179938779914945, ["1.5 deg", "1.5°", "1.5 degrees"]),  # 1.5 π/180
    (units.SPEED, 0.5, ["30 m/min", "0.5 m/s", "1800 m/h", "1800 m/hr"]),
    (units.SPEED, 60 * FOOT / 3600, ["60 ft/hr", "60 ft/h", "1 ft/min", "1 fpm"]),
    (units.ROTATION, 60.0, ["60 rpm", "60 RPM", "60 c/min", "60 rev/min", "1 rev/s"]),
    (units.STRESS, 206.8e9, ["206.8 GPa", "206800 MPa", "206800 N/mm2"]),
]


@pytest.mark.parametrize(
    ("text", "dimension", "value"), [(text, kind, value) for kind, value, texts in WRITTEN for text in texts]
)
def test_spellings_of_one_quantity(text: str, dimension: units.Dimension, value: float) -> None:
    assert units.Quantity(dimension=dimension).parse(text) == pytest.approx(value, rel=1e-13)


@pytest.mark.parametrize(
    ("text", "readings"),
    [
        ("1,200 kg", "'1200 kg' or '1.200 kg' (a comma may separate thousands or decimals)"),
        ("1,5 m", "'1.5 m' (with a decimal point)"),
        ("1.200,5 m", "'1200.5 m' (with a decimal point)"),
        ("12 500 ft", "'12500 ft' (without separators between thousands)"),
        ("1,200,000.5 N", "'1200000.5 N' (without separators between thousands)"),
        ("1,2,3 m", "a number with one decimal point and its unit, such as '12.5 m'"),
        ("5 ton", "'5 t' (metric tons), '10 klb' (short tons) or '11.2 klb' (long tons)"),
        ("5 Mlbf", "'5 klb' (thousands of pounds) or '5000 klb' (millions of pounds)"),
        ("30 mph", "'30 m/h' (metres per hour) or '30 mile/h' (miles per hour)"),
    ],
)
def test_what_has_several_meanings_is_refused_with_all_of_them(text: str, readings: str) -> None:
    with pytest.raises(InputError) as caught:
        spellings.split(text)
    assert caught.value.expected == readings


@pytest.mark.parametrize("text", ["85/8 in", "8 1/3 in", "9-5 in", "m", "12", "2 m + 3 m", "1 m" + 80 * " ", "3°/30m"])
def test_other_shapes_are_no_quantity(text: str) -> None:
    assert spellings.split(text) is None


def test_a_fraction_is_exact() -> None:
    assert spellings.split("12 63/64 in") == (Decimal("12.984375"), "in")


@pytest.mark.parametrize(
    ("text", "dimension"),
    [
        ("5 kg/m", units.STIFFNESS),  # no mass stands for a weight here
        ("5 lb/ft", units.FORCE),
        ("5 N", units.TORQUE),
        ("1 m/m", units.ANGLE),
        ("1 Hz", units.ROTATION),
        ("1 m m", units.LENGTH),
        ("3 degC", units.LENGTH),
    ],
)
def test_another_dimension_is_refused_with_the_accepted_units(text: str, dimension: units.Dimension) -> None:
    with pytest.raises(InputError) as caught:
        units.Quantity(dimension=dimension).parse(text)
    assert caught.value.expected.endswith(f"({dimension.accepted})")


def test_the_factor_of_a_unit_is_what_one_of_it_is_read_as() -> None:
    """Tables of results and the text that a calibration writes take the factor, a case file the text."""
    dimensions = [value for value in vars(units).values() if isinstance(value, units.Dimension)]
    for dimension in dimensions:
        for unit in dimension.units:
            one = units.Quantity(dimension=dimension).read(f"1 {unit}")
            assert dimension.factor(unit) == pytest.approx(one, rel=1e-12), unit
            assert dimension.factor(unit, back=True) == pytest.approx(1 / one, rel=1e-12), unit


def test_every_accepted_unit_is_accepted() -> None:
    dimensions = [value for value in vars(units).values() if isinstance(value, units.Dimension)]
    assert len(dimensions) > 12
    for dimension in dimensions:
        for unit in dimension.units:
            assert units.Quantity(dimension=dimension).parse(f"1 {unit}") > 0
