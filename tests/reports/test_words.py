"""Units leave column names, and numbers keep the digits that matter."""

import math

import pandas as pd
import pytest

from reports import words
from validation.harness.study import Check


@pytest.mark.parametrize(
    ("column", "heading"),
    [
        ("bit_depth_m", ("bit depth", "m")),
        ("torque_kN_m", ("torque", "kN·m")),
        ("surface_torque_N_m", ("surface torque", "N·m")),
        ("sum_r_mu_fn_N_m", ("Σ rμFₙ", "N·m")),
        ("hookload_difference_percent", ("hook load difference", "%")),
        ("max_angle_error_deg", ("max angle error", "°")),
        ("max_penetration_error_mm", ("max penetration error", "mm")),
        ("md_m", ("measured depth", "m")),
        ("soft_hookload_paper_kN", ("soft hook load paper", "kN")),
        ("fcl_sum_r_mu_fn_kN_m", ("FCL Σ rμFₙ", "kN·m")),
        ("viscosity_Pa_s", ("viscosity", "Pa·s")),
        ("stiffness_N_per_m_per_m", ("stiffness", "N/m per m")),
        ("severity_deg_per_100ft", ("severity", "°/100 ft")),
        ("helix_over_snaking_J_per_m", ("helix over snaking", "J/m")),
        ("off_percent_of_weight", ("off", "% of the weight")),
        ("memory_MB", ("memory", "MB")),
        ("took_per_m_s", ("time per metre", "s")),
        ("ms_per_simulated_s", ("time per simulated second", "ms")),
        ("wall_s", ("wall time", "s")),
        ("steps", ("steps", "")),
        ("operation", ("operation", "")),
    ],
)
def test_heading(column, heading):
    assert words.heading(column) == heading


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (61, "61"),
        (1_166_000.0, "1 166 000"),
        (426.512, "427"),
        (0.99972, "0.99972"),
        (0.9999999999, "1"),
        (1.0042, "1.0042"),
        (0.5, "0.5"),
        (-2.3456, "−2.35"),
        (-0.0, "0"),
        (3.14159e-7, "3.14 × 10⁻⁷"),
        (-1e-6, "−1 × 10⁻⁶"),
        (2.5e12, "2.5 × 10¹²"),
        (math.nan, "–"),
        (-math.inf, "−∞"),
    ],
)
def test_number(value, text):
    plain = words.number(value).replace(words.NARROW_SPACE, " ").replace(words.SPACE, " ")
    assert plain == text


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ([426.512, 472.0, math.nan], ["427", "472", "–"]),
        ([2.39, 2.3], ["2.39", "2.30"]),
        ([0.0024, 0.0012], ["0.0024", "0.0012"]),
        ([100.0, 0.01], ["100", "0.01"]),
        ([1, 1000], ["1", "1\u202f000"]),
        ([True, False], ["yes", "no"]),
        (["trip_in", "arcs", None], ["slacking off", "arcs", "–"]),
        (["under_resolved", "for_loop, 2 m", "mujoco"], ["under resolved", "FOR-loop, 2 m", "MuJoCo"]),
        (["cases/a_b.toml", "not finite: x_y"], ["cases/a_b.toml", "not finite: x_y"]),
    ],
)
def test_column(values, texts):
    assert words.column(pd.Series(values)) == texts


@pytest.mark.parametrize(
    ("plain", "printed"),
    [
        ("Σ rμF_n below 5 N*m (study `sticking`)", "Σ rμFₙ below 5 N·m (study sticking)"),
        ("1e6 to 1e10 N/m, 2.5e+07", "10⁶ to 10¹⁰ N/m, 2.5 × 10⁷"),
        ("case1e6 and 8e are no powers", "case1e6 and 8e are no powers"),
    ],
)
def test_sentences_are_set_as_in_print(plain, printed):
    assert words.typeset(plain).replace(words.SPACE, " ") == printed


def test_a_load_that_is_rounding_alone_is_zero():
    assert words.column(pd.Series([2.4, 2.23e-13], name="torque_paper_kN_m")) == ["2.4", "0.0"]
    assert words.column(pd.Series([2.4, 2.23e-13], name="off_percent"))[1] == "2.23\u00a0×\u00a010⁻¹³"


def test_quartiles_stand_in_brackets_behind_their_number():
    table = pd.DataFrame({"ns": [12.5, math.nan], "ns_low": [11.0, math.nan], "ns_high": [14.0, math.nan], "m_low": 1})
    assert words.columns(table) == {"ns": ["12.5 (11 to 14)", words.NOTHING], "m_low": ["1", "1"]}


def test_angles_of_checks_have_their_sign():
    check = Check("x", 0.4, 0.2, "at_least", "deg", "test")
    assert (words.found(check), words.bound(check)) == (f"0.4{words.SPACE}°", "at least 0.2 °")


def test_quantity_of_nothing_has_no_unit():
    assert words.quantity(math.nan, "m") == "no number"
    assert words.quantity(2.0, "") == "2"


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ([0.9863, 0.9995, 0.99993], ["0.98630", "0.99950", "0.99993"]),  # correlations
        ([746.07, 746.34, 746.71], ["746.07", "746.34", "746.71"]),
        ([0.00148518, 0.00148519], ["0.00149", "0.00149"]),  # noise
        ([61.0, 500.0], ["61", "500"]),
    ],
)
def test_a_column_shows_by_how_much_its_numbers_differ(values, texts):
    assert words.column(pd.Series(values)) == texts


@pytest.mark.parametrize(
    ("check", "text"),
    [
        (Check("x", 1.312, 2.0, "at_most", "", "test", True, (1.302, 1.341)), "1.31 (1.3 to 1.34)"),
        (Check("x", 0.9997, 0.95, "at_least", "", "test"), "0.9997"),
        (Check("x", 3.0004, 3.0, "at_most", "%", "test"), f"3.0004{words.SPACE}%"),
        (Check("x", math.nan, 3.0, "at_most", "%", "test"), "no number"),
    ],
)
def test_a_number_is_told_from_its_bound(check, text):
    assert words.found(check) == text
