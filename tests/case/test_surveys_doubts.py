"""Warnings about surveys: what raises them, and how near a sound survey may come."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from fctd.case.input_warnings import InputWarning
from fctd.case.load import load_case
from fctd.case.surveys import doubts
from fctd.case.surveys.directions import severity
from fctd.case.surveys.rounding import last_digit
from fctd.case.surveys.smoothing import MOST_SMOOTHED
from fctd.case.surveys.stations import Written, check, to_radians
from tests.case.survey_files import STATION, witsml
from tests.case.test_surveys import read, written
from validation.parts.random_paths import path

Rows = Sequence[Sequence[float]] | NDArray[np.float64]


def found(rows: Rows, file: str = "s.csv", units: tuple[str, str, str] = ("m", "deg", "deg")) -> list[InputWarning]:
    """The warnings about a file of these rows, which begin in its second line."""
    values = np.array(rows, dtype=float)
    place: Written = replace(written(values), units=units, file=file, numbers=range(2, len(values) + 2))
    return list(doubts.find(check(place)))


def codes(rows: Rows, file: str = "s.csv", units: tuple[str, str, str] = ("m", "deg", "deg")) -> list[str]:
    return [warning.code for warning in found(rows, file, units)]


def only(rows: Rows, units: tuple[str, str, str] = ("m", "deg", "deg")) -> InputWarning:
    (warning,) = found(rows, units=units)
    return warning


def well(md: NDArray[np.float64]) -> NDArray[np.float64]:
    """A build and hold that turns, without rounding: 7 deg/100 m of build."""
    inclination = np.interp(md, [0, 300, 1000, 5000], [0, 0, 49, 49])
    return np.column_stack([md, inclination, np.interp(md, [0, 300, 1200], [40, 40, 76.3])])


DENSE = np.arange(0.0, 1500.0, 29.0) + np.arange(52) % 3 * 0.13
SOUND = well(DENSE)


def test_a_sound_survey_has_none() -> None:
    assert codes(SOUND) == []
    assert codes(np.round(SOUND, 2)) == []


# --- stations that are missing ---------------------------------------------------------------------


def test_an_added_station_is_told() -> None:
    warning = only([[100, 5, 20], *([110 + 30 * k, 6, 20] for k in range(5))])
    assert warning.code == "tie_in"
    assert str(warning) == (
        "s.csv, row 2: the first station is at 100 m, so a vertical station at measured depth 0 was added: give the "
        "survey a station at 0 if the hole is not vertical there"
    )


def test_a_survey_that_begins_in_a_bend() -> None:
    """Five degrees are the limit; the added course is no gap."""
    rows = [[1000, 31, 20], *([1030 + 30 * k, 31, 20] for k in range(5))]
    warning = only(rows, units=("ft", "deg", "deg"))
    assert warning.text == (
        "the first station is at 1000 ft, so a vertical station at measured depth 0 was added, and the hole bends by "
        "31 deg between them"
    )
    assert warning.remedy == "give the survey the stations from the surface down to this one"
    assert codes(rows) == ["tie_in"]


def test_few_stations() -> None:
    rows = [[0, 0, 0], [100, 0, 0], [200, 3, 0], [300, 6, 0], [400, 6, 0]]
    assert codes(rows) == []
    warning = only(rows[:4])
    assert (warning.code, warning.key) == ("few_stations", "s.csv, rows 2 to 5")
    assert warning.text.startswith("a well of 4 stations")
    assert codes(rows[:4], file="") == []  # a plan
    assert codes([[0, 0, 0], [3000, 0, 0]]) == []  # vertical: complete


def test_a_gap_in_a_curve() -> None:
    rows = [[0, 0, 0], [400, 0, 0], [450, 0, 0], [751, 5.1, 0], [800, 6, 0], [1200, 20, 0]]
    warning = only(rows)
    assert (warning.code, warning.key) == ("gap_in_curve", "s.csv, rows 6 to 7")
    assert "no station for 400 m, in which the hole turns by 14 deg (and 1 more such gaps)" in warning.text
    rows[3], rows[5] = [750, 5.1, 0], [1200, 10, 0]
    assert codes(rows) == []
    assert codes([[0, 0, 0], [1000, 0, 0], [1010, 0, 0], [1020, 0, 0], [1500, 30, 0]], file="") == []


# --- units -----------------------------------------------------------------------------------------


def test_angles_that_look_like_radians() -> None:
    rows = np.column_stack([DENSE, np.radians(SOUND[:, 1:])])
    warning = only(rows)
    assert (warning.code, warning.key) == ("angles_look_like_radians", f"s.csv, rows 2 to {len(rows) + 1}")
    assert warning.text.startswith("inclinations up to 0.8552 and azimuths up to 1.332")
    assert 'columns = {inc = {unit = "rad"}, azi = {unit = "rad"}}' in warning.remedy
    (of_the_case,) = found(rows, file="")
    assert (of_the_case.code, of_the_case.remedy) == (warning.code, "if they are, write them in degrees")
    assert codes(rows, units=("m", "rad", "rad")) == []


@pytest.mark.parametrize(
    ("inclination", "azimuth"), [(3.2, 2.5), (2.5, 6.4), (2.5, 3.0), (0.05, 2.5), (2.0, 2.5), (2.5, 0.05)]
)
def test_angles_that_are_degrees(inclination: float, azimuth: float) -> None:
    """Nearly vertical holes have azimuths all round the compass, or whole ones."""
    rows = [[0, 0, 0], *([100 * k, inclination, azimuth] for k in range(1, 6))]
    assert "angles_look_like_radians" not in codes(rows)
    assert "angles_look_like_radians" in codes([[0, 0, 0], *([100 * k, 2.5, 2.5] for k in range(1, 6))])


def stands(length: float, unit: float = 1.0) -> NDArray[np.float64]:
    """A survey at every stand; the lengths differ by some decimetres, as those of joints do."""
    rng = Random(1)
    md = np.cumsum([0.0, *(length + rng.uniform(-0.6, 0.6) for _ in range(40))])
    return np.column_stack([md, well(md * unit)[:, 1:]])


@pytest.mark.parametrize(
    ("length", "unit", "code"),
    [
        (94.0, "m", ["depths_look_like_feet"]),
        (28.8, "m", []),
        (38.4, "m", []),
        (86.4, "m", []),
        (28.8, "ft", ["depths_look_like_metres"]),
        (94.0, "ft", []),
        (31.4, "ft", []),
    ],
)
def test_stands_tell_the_unit(length: float, unit: str, code: list[str]) -> None:
    assert codes(stands(length), units=(unit, "deg", "deg")) == code


def test_steps_of_a_plan_tell_nothing() -> None:
    plan = well(np.arange(0, 3000, 95.0))
    assert codes(plan) == []
    assert codes(well(np.arange(0, 900, 30.0) * 0.3048) / [0.3048, 1, 1], units=("ft", "deg", "deg")) == []


def test_the_words_about_a_unit() -> None:
    warning = only(stands(94.0))
    assert warning.text == "most stations are 93.9 m apart, which is a stand in feet"
    assert warning.remedy == (
        "if the depths are in feet, write the case anew with fctd init --columns md.unit=ft, or say so in the case: "
        'columns = {md = {unit = "ft"}}, and correct its depths'
    )


def test_witsml_has_no_columns_to_describe(tmp_path: Path) -> None:
    each = "".join(STATION.format(*row) for row in stands(28.8))
    (warning,) = doubts.find(read(tmp_path, witsml("S1", stations=each)))
    assert (warning.code, warning.key) == ("depths_look_like_metres", "survey.dat, trajectoryStations 1 to 41")
    assert warning.remedy == "if the depths are in metres, correct their unit (uom) in the file"


def test_a_well_of_more_than_12_km() -> None:
    md = np.arange(0, 12_001, 120.0)
    assert codes(well(md)) == []
    warning = only(well(md * 1.01))
    assert (warning.code, warning.text) == (
        "depths_look_like_feet",
        "the well is 12.1 km long, which looks like a depth in feet",
    )
    assert codes(well(md * 1.01), units=("ft", "deg", "deg")) == []


# --- rounding --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("values", "step"),
    [([0, 3, 12], 1), ([0.5, 3, 12], 0.5), ([0.25, 3], 0.25), ([0.1, 3.3], 0.1), ([0.01, 2], 0.01), ([1 / 3], 0)],
)
def test_the_last_digit(values: list[float], step: float) -> None:
    assert last_digit(np.array(values, dtype=float)) == step


ROUNDED = np.round(well(np.arange(0, 1500, 9.7)))


def test_a_rounded_survey() -> None:
    """The exact well has 2.3 deg/30 m at most."""
    assert severity(to_radians(well(np.arange(0, 1500, 9.7)))).max() == pytest.approx(2.3, abs=0.05)
    warning = only(ROUNDED)
    assert warning.code == "rounded_survey"
    assert re.fullmatch(r"s\.csv, rows \d+ to \d+", warning.key)
    assert warning.text.startswith(
        "rounding (depths to 1 m, inclinations to 1 deg, azimuths to 1 deg) makes dog-legs of about 1.4 deg/30 m"
    )
    assert re.search(
        r'survey_smoothing = "0\.\d+ deg" brings the greatest of these dog-legs from 3\.\d+ to 2\.3\d* deg/30 m, and '
        r"moves the path by at most \d+(\.\d+)? m",
        warning.remedy,
    ), warning.remedy


def test_numbers_that_are_exact_are_not_rounded() -> None:
    """Whole degrees of a plan, coarse steps that make no dog-leg, and a hole that turns more than rounding does."""
    md = np.arange(0.0, 1500.0, 10.0)
    plan = np.column_stack([md, np.clip(np.arange(150) - 30, 0, 60), np.full(150, 40)])
    assert codes(plan) == []
    assert codes(np.round(well(np.arange(0, 3000, 60.0)))) == []
    assert codes(np.round(well(DENSE), 1)) == []
    rng = np.random.default_rng(1)
    drilled = well(md) + rng.normal(0, 3, (150, 3)) * [0, 1, 1] * (md[:, None] > 300)
    assert "rounded_survey" not in codes(np.round(np.abs(drilled)))


def test_too_many_stations_to_smooth() -> None:
    md = np.arange(MOST_SMOOTHED + 200) * 1.0
    rows = np.column_stack([md, np.round(well(md)[:, 1:])])
    assert [(w.code, w.remedy) for w in found(rows)] == [("rounded_survey", "use a survey with more digits")]


def spin(step: float, spacing: float) -> NDArray[np.float64]:
    """A vertical section whose azimuths are any, then a build."""
    rng = Random(3)
    top = [[spacing * k, step * (k > 0), rng.randrange(360) if k else 0] for k in range(30)]
    below = [[top[-1][0] + 30.0 * k, 2.3 * k, 45.6 + 0.1 * k] for k in range(1, 30)]
    return np.array(top + below)


def test_azimuths_that_turn_at_rounding_noise() -> None:
    warning = next(w for w in found(spin(0.1, 10.0)) if w.code == "azimuth_noise")
    assert re.fullmatch(r"s\.csv, rows \d to 3\d", warning.key)
    assert "whose inclination is at most twice its last digit, which bends a vertical hole by 0." in warning.text
    assert 'survey_smoothing = "0.14 deg" brings the greatest of these dog-legs from 0.' in warning.remedy


@pytest.mark.parametrize(("step", "spacing"), [(0.0, 10.0), (0.01, 10.0), (0.1, 120.0), (0.33, 10.0)])
def test_azimuths_that_bend_nothing(step: float, spacing: float) -> None:
    """Exactly vertical, bends too small to matter, and inclinations above their last digit."""
    assert "azimuth_noise" not in codes(spin(step, spacing))


@pytest.mark.parametrize(("spacing", "digits"), [(10, 2), (30, 2), (30, 1), (90, 2)])
def test_planned_and_drilled_paths_have_none(spacing: float, digits: int) -> None:
    for seed in range(20):
        rows = np.array(path(Random(seed), spacing, 3000))
        slant = ["surface_inclination"] if rows[0, 1] > 10 else []
        assert codes(np.round(rows, digits)) == slant, seed


# --- dog-legs and the first station ----------------------------------------------------------------


def test_a_slip_of_the_pen_is_a_dog_leg() -> None:
    """32 deg for 2 deg in one row; and an azimuth of 450 in a hole that is nearly vertical."""
    rows = SOUND.copy()
    rows[20, 1] += 30.0
    (warning,) = [one for one in found(rows) if one.code == "dog_leg"]
    assert warning.key in ("s.csv, rows 21 to 22", "s.csv, rows 22 to 23")
    assert re.fullmatch(
        r"the hole bends by (29|3\d)\.?\d* deg in 2\d\.?\d* m, a dog-leg of 3\d\.?\d* deg/30 m \(and 1 more "
        r"such course\)",
        warning.text,
    )
    rows = SOUND.copy()
    rows[:, 1] = 10.0
    rows[20, 2] += 360.0 + 120.0
    assert "dog_leg" in codes(rows)


@pytest.mark.parametrize(("rate", "told"), [(14.5, False), (15.5, True)])
def test_the_bound_of_dog_legs(rate: float, told: bool) -> None:
    md = np.arange(0.0, 301.0, 30.0)
    rows = np.column_stack([md, np.clip(rate * (np.arange(11) - 5), 0, 89), np.full(11, 40.0)])
    assert ("dog_leg" in codes(rows)) == told
    assert "dog_leg" not in codes(rows * [0.01, 1, 1])  # of a model in a laboratory


@pytest.mark.parametrize(("slant", "told"), [(10.0, False), (10.1, True), (90.0, True)])
def test_a_hole_that_starts_inclined(slant: float, told: bool) -> None:
    """As where columns are exchanged, or inclinations are measured from the horizontal; a slant rig has 45 deg."""
    rows = np.column_stack([DENSE, np.full(52, slant), np.full(52, 40.0)])
    assert ("surface_inclination" in codes(rows)) == told
    assert "surface_inclination" not in codes(rows[1:])  # "tie_in" tells of the bend


# --- in a case -------------------------------------------------------------------------------------


def test_a_case_has_the_warnings_of_its_survey(case_file: Path) -> None:
    """Kept with the stations; smoothing answers those about rounding."""
    survey = case_file.parent / "s.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n" + "".join(f"{m:g},{i:g},{a:g}\n" for m, i, a in ROUNDED))
    overrides = {
        "wellbore.stations": None,
        "wellbore.survey": str(survey),
        "operations": None,
        "wellbore.intervals": [{"to_md": 3000, "diameter": 0.2, "friction": 0.2}],
    }
    hole = load_case(case_file, overrides).wellbore
    assert [warning.code for warning in hole.survey_warnings] == ["rounded_survey"]
    assert hole.survey_warnings is hole.survey_warnings
    smooth = load_case(case_file, overrides | {"wellbore.survey_smoothing": "0.75 deg"}).wellbore
    assert smooth.survey_warnings == ()
    assert np.array_equal(smooth.trajectory[:, 0], hole.trajectory[:, 0])
    assert not np.array_equal(smooth.trajectory, hole.trajectory)


def test_stations_of_a_case_are_named_by_their_keys(case_file: Path) -> None:
    hole = load_case(case_file, {"wellbore.stations[0][0]": 100}).wellbore
    assert [(warning.code, warning.key) for warning in hole.survey_warnings] == [("tie_in", "wellbore.stations[0]")]
    assert hole.trajectory[0, 0] == 0.0


# --- true vertical depths --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("headers", "row", "told"),
    [
        ("MD (m),Inc,Azi,TVD (m)", "1500,30,0,1600", "depth of 1600 m beside a measured depth of 1500 m"),
        ("TVD,MD (ft),Inc,Azi", "1600,1500,30,0", "depth of 487.7 m beside a measured depth of 457.2 m"),
        ("MD (m),Inc,Azi,TVD (ft),TVD (m)", "1500,30,0,4600,1402", ""),
        ("MD (m),Inc,Azi,TVD (m)", "1500,30,0,1500.4", ""),
        ("MD (m),Inc,Azi,TVD (m)", "1500,30,0,-", ""),
        ("MD (m),Inc,Azi,TVD (m)", "1500,30,0,see log", ""),
    ],
)
def test_a_true_vertical_depth_cannot_be_below_the_measured_one(
    headers: str, row: str, told: str, tmp_path: Path
) -> None:
    zeros = ",".join("0" for _ in row.split(","))
    warnings = doubts.find(read(tmp_path, f"{headers}\n{zeros}\n{row}\n"))
    said = [warning.text for warning in warnings if warning.code == "tvd_below_md"]
    assert (told in said[0]) if told else not said


# --- a hole above the ground -----------------------------------------------------------------------


def test_a_hole_that_rises_above_its_first_station() -> None:
    angles = np.column_stack([DENSE, 180.0 - SOUND[:, 1], SOUND[:, 2]])  # measured from straight up
    (warning,) = [one for one in found(angles) if one.code == "above_surface"]
    assert warning.key == "s.csv, row 53"
    build = np.radians(49.0)
    height = 300 + 700 / build * np.sin(build) + (DENSE[-1] - 1000) * np.cos(build)  # exact but for the turn
    assert f"the hole rises to {height:.4g} m" in warning.text
    crossing = [[30.0 * k, 80.0 + k, 0.0] for k in range(25)]  # ends some 25 m above
    assert "above_surface" not in codes(crossing)
    assert "above_surface" in codes([*crossing, *([30.0 * k, 105.0, 0.0] for k in range(25, 30))])
