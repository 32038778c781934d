"""Result columns in field units and in those of screen and pictures: names and factors."""

import pandas as pd
import pytest

from fctd.results.unit_systems import in_field_units, kind_of, shown, shown_unit

# Exact by definition (NIST SP 811, appendix B.8).
LBF, FOOT, INCH = 4.4482216152605, 0.3048, 0.0254


@pytest.mark.parametrize(
    ("column", "renamed", "factor"),
    [
        ("hookload_N", "hookload_klbf", 1000 * LBF),
        ("surface_torque_N_m", "surface_torque_kft_lbf", 1000 * LBF * FOOT),
        ("von_mises_Pa", "von_mises_ksi", 1000 * LBF / INCH**2),
        ("bit_depth_m", "bit_depth_ft", FOOT),
        ("offset_high_m", "offset_high_in", INCH),
        ("offset_right_m", "offset_right_in", INCH),
        ("clearance_m", "clearance_in", INCH),
    ],
)
def test_a_column_in_field_units(column: str, renamed: str, factor: float) -> None:
    table = in_field_units(pd.DataFrame({column: [1.0, -2.5e6, 0.0]}))
    assert list(table.columns) == [renamed]
    assert table[renamed].to_numpy() * factor == pytest.approx([1.0, -2.5e6, 0.0], rel=1e-14)


@pytest.mark.parametrize("column", ["operation", "iterations", "friction", "contact_angle_deg", "time_s", "Name"])
def test_what_has_no_unit_to_exchange_stays(column: str) -> None:
    assert kind_of(column) is None
    table = pd.DataFrame({column: [1, 2]})
    pd.testing.assert_frame_equal(in_field_units(table), table)


def test_round_depths_stay_round() -> None:
    assert in_field_units(pd.DataFrame({"md_m": [609.6, 30.48, 0.3048]}))["md_ft"].tolist() == [2000.0, 100.0, 1.0]


def test_missing_numbers_stay_missing() -> None:
    assert in_field_units(pd.DataFrame({"hookload_N": [float("nan")]}))["hookload_klbf"].isna().all()


@pytest.mark.parametrize(
    ("column", "system", "factor", "label"),
    [
        ("hookload_N", "si", 1e-3, "kN"),
        ("hookload_N", "field", 1 / (1000 * LBF), "klbf"),
        ("surface_torque_N_m", "si", 1e-3, "kN·m"),
        ("surface_torque_N_m", "field", 1 / (1000 * LBF * FOOT), "kft·lbf"),
        ("von_mises_Pa", "si", 1e-6, "MPa"),
        ("md_m", "si", 1.0, "m"),
        ("md_m", "field", 1 / FOOT, "ft"),
        ("clearance_m", "si", 1e3, "mm"),
        ("clearance_m", "field", 1 / INCH, "in"),
        ("contact_angle_deg", "field", 1.0, "°"),
    ],
)
def test_a_column_on_the_screen(column: str, system: str, factor: float, label: str) -> None:
    found = shown(column, system)
    assert found.factor == pytest.approx(factor, rel=1e-14)
    assert found.label == label


def test_a_column_without_a_unit_cannot_be_shown_in_one() -> None:
    with pytest.raises(ValueError, match="column iterations has no unit"):
        shown("iterations", "si")


@pytest.mark.parametrize(
    ("unit", "label", "factor"),
    [
        ("N", "klbf", 1 / (1000 * LBF)),
        ("N*m", "kft·lbf", 1 / (1000 * LBF * FOOT)),
        ("kg/m^3", "ppg", 231 * INCH**3 / 0.45359237),
        ("kg/m", "lb/ft", FOOT / 0.45359237),
        ("", "", 1.0),
    ],
)
def test_values_whose_unit_stands_beside_them(unit: str, label: str, factor: float) -> None:
    assert shown_unit(unit, "field") == (pytest.approx(factor, rel=1e-12), label)


def test_metric_pictures_show_thousands_of_newtons() -> None:
    assert [shown_unit(unit, "si") for unit in ("N", "N*m", "kg/m")] == [(1e-3, "kN"), (1e-3, "kN·m"), (1.0, "kg/m")]
