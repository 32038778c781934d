"""Calipers: tables and files, what their arms stand for, and what is refused."""

import re
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import InputError
from fctd.case.calipers.caliper import Caliper
from tests.calipers import bent_case
from tests.cases import make_case

ROWS = [[520, 0.22, 0.25], [540, 0.23, 0.24], [560, 0.22, 0.22]]
INCH = 0.0254


def caliper(**keys: Any) -> Caliper:
    found = bent_case("sampled", caliper=keys).wellbore.calipers
    assert found is not None
    return found


def written(folder: Path, text: str, name: str = "caliper.csv", **keys: Any) -> Caliper:
    (folder / name).write_text(text)
    return caliper(log=folder / name, **keys)


def refused(**keys: Any) -> str:
    with pytest.raises((InputError, ValueError)) as error:
        caliper(**keys)
    return str(error.value)


@given(
    st.integers(1, 64), st.sampled_from(["diameter", "radius"]), st.floats(0, 6.28),
    st.sampled_from(["north", "high_side"]), st.integers(0, 2**31),
)  # fmt: skip
def test_rows_become_radii_at_angles(arms: int, values: str, first: float, reference: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    md, sizes = 520 + np.cumsum(rng.uniform(0.1, 5, 4)), rng.uniform(0.15, 0.5, (4, arms))
    rows = np.column_stack([md, sizes]).tolist()
    found = caliper(rows=rows, values=values, first_arm=first, reference=reference)
    np.testing.assert_array_equal(found.md, md)
    radii = sizes if values == "radius" else 0.5 * sizes
    if arms > 2 and values == "diameter":  # each on both sides
        radii = np.hstack([radii, radii])
    np.testing.assert_array_equal(found.radii, radii)
    step = {1: 0.0, 2: np.pi / 2}.get(arms, 2 * np.pi / radii.shape[1])
    np.testing.assert_allclose(found.angles[2], first + step * np.arange(radii.shape[1]))
    assert found.reference == reference


def test_a_file_has_its_units_gaps_and_orientation(tmp_path: Path) -> None:
    text = "MD (ft),C1 (in),C2 (in),P1AZ (deg)\n1800,8.5,9,90\n1801,-999.25,9,90\n1802,8.5,,180\n"
    found = written(tmp_path, text)
    np.testing.assert_allclose(found.md, 0.3048 * np.array([1800, 1801, 1802]))
    np.testing.assert_allclose(found.radii, 0.5 * INCH * np.array([[8.5, 9], [np.nan, 9], [8.5, np.nan]]))
    np.testing.assert_allclose(np.degrees(found.angles), [[90, 180], [90, 180], [180, 270]])


def test_a_log_of_a_tool_on_its_way_up_is_turned_round(tmp_path: Path) -> None:
    found = written(tmp_path, "md_m,cali_m\n540,0.25\n530,0.24\n520,0.23\n")
    np.testing.assert_array_equal(found.md, [520, 530, 540])
    np.testing.assert_allclose(2 * found.radii[:, 0], [0.23, 0.24, 0.25])


def test_a_log_in_las_is_read(tmp_path: Path) -> None:
    pytest.importorskip("lasio")
    text = (
        "~Version\nVERS. 2.0:\nWRAP. NO:\n~Well\nSTRT.M 520:\nSTOP.M 521:\nSTEP.M 0.5:\nNULL. -999.25:\n"
        "~Curve\nDEPT.M :\nGR.GAPI :\nHCAL.IN :\n~ASCII\n520 40 8.6\n520.5 41 -999.25\n521 39 8.7\n"
    )
    found = written(tmp_path, text, "log.las")
    np.testing.assert_allclose(found.radii[:, 0], 0.5 * INCH * np.array([8.6, np.nan, 8.7]))


LAS = (
    "~Version\nVERS. 2.0:\nWRAP. NO:\n~Well\nSTRT.M 520:\nSTOP.M 521:\nSTEP.M 0.5:\nNULL. -999.25:\n{}"
    "~Curve\nDEPT.M :\nHCAL.IN :\n{}~ASCII\n{}520 8.6\n521 8.7\n"
)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (LAS.format("".join(f"P{k}.M 1:\n" for k in range(300_000)), "", ""), "at most 1,000 lines of header"),
        (LAS.format("X.M " + "9" * 10_000_000 + ":\n", "", ""), "lines of header of at most 1,000 characters"),
        (LAS.format("", "".join(f"C{k}.IN :\n" for k in range(20_000)), ""), "at most 1,000 lines of header"),
        (LAS.format("", "GR.API :\n" * 500, ""), 'at most 10 lines of one name (there are 500 of "GR")'),
        (LAS.format("", "", "1 " * 500 + "\n"), "as many values in a row as curves (500 values, 2 curves)"),
    ],
    ids=["lines", "value", "curves", "name", "values"],
)
def test_a_log_that_would_take_minutes_is_refused_at_once(
    text: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its size: the package that reads LAS takes the square or cube of it."""
    lasio = pytest.importorskip("lasio")
    monkeypatch.setattr(lasio, "read", Mock(side_effect=AssertionError))
    (tmp_path / "log.las").write_text(text)
    with pytest.raises(InputError, match=re.escape(words)):
        _ = bent_case("sampled", caliper={"log": tmp_path / "log.las"}).wellbore.calipers


def test_what_a_log_says_beside_its_curves_is_left_out(tmp_path: Path) -> None:
    """Parameters and remarks of any number; a log of wireline has thousands of them, many of one name."""
    pytest.importorskip("lasio")
    beside = "~Parameter\n" + "RMF.OHMM 0.2: of mud\n" * 3000 + "~Other\n" + "remark\n" * 3000
    found = written(tmp_path, LAS.format(beside, "", ""), "log.las")
    np.testing.assert_allclose(found.radii[:, 0], 0.5 * INCH * np.array([8.6, 8.7]))


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"rows": [ROWS[0]]}, "two rows or more"),
        ({"rows": [ROWS[0], [540, 0.2]]}, "rows[1] = [540.0, 0.2]: expected a depth and 2 values"),
        ({"rows": [[520], [540]]}, "a depth and 1 to 64 values"),
        ({"rows": [ROWS[1], ROWS[0]]}, 'rows[1] = "520 m": expected a depth greater than that of the row above, 540 m'),
        ({"rows": [ROWS[0], [540, -0.2, 0.2]]}, "a diameter above 0"),
        ({"rows": [ROWS[0], [540, 8.5, 8.5]]}, "check the unit"),
        ({"rows": ROWS, "values": "width"}, "'diameter' or 'radius'"),
        ({"rows": ROWS, "columns": {"md": "MD"}}, "columns only beside log"),
        ({"rows": ROWS, "log": "caliper.csv"}, "log or rows, not both"),
        ({}, "log or rows"),
    ],
)
def test_wrong_rows_are_refused_in_one_sentence(keys: dict[str, Any], words: str) -> None:
    assert words in refused(**keys)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("md_m,arm1\n520,0.2\n530,0.2\n", "a header with its unit"),
        ("md_m,gamma\n520,0.2\n530,0.2\n", "column arm1_in"),
        ("md_m,arm1_in\n520,8.5\n", "two rows or more"),
        ("md_m,arm1_in\n520,8.5\n530,wide\n", "a number"),
        ("md_m,arm1_in\n520,8.5\n530,-8.5\n", "a diameter above 0"),
        ("md_m,arm1_m\n520,8.5\n530,8.5\n", "check the unit"),
        ("md_m,arm1_in,arm3_in\n520,8.5,8\n530,8.5,8\n", "column arm2"),
        ("md_m,arm1_in\n520,8.5\n530,8.5\n510,8.5\n", "a depth greater than that of the row above, 530 m"),
    ],
)
def test_wrong_files_are_refused_with_their_place(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "caliper.csv").write_text(text)
    with pytest.raises(InputError) as error:
        caliper(log=tmp_path / "caliper.csv")
    assert words in str(error.value)
    assert "caliper.csv" in str(error.value)


@pytest.mark.parametrize(("key", "value"), [("caliper", {"rows": ROWS}), ("cell", 0.2)])
def test_other_geometries_have_no_caliper(key: str, value: object) -> None:
    with pytest.raises(ValueError, match=f'"sampled" beside {key}'):
        bent_case("arcs", **{key: value})


def test_a_sampled_hole_needs_arcs() -> None:
    with pytest.raises(ValueError, match="sampled need survey_method minimum_curvature"):
        make_case(wellbore={"geometry": "sampled", "survey_method": "average_angle"})


MD = np.arange(520.0, 990.0, 1.0)


def doubted(sizes: Any, md: Any = MD, **keys: Any) -> dict[str, str]:
    case = bent_case("sampled", caliper={"rows": np.column_stack([md, sizes]).tolist(), **keys})
    found: dict[str, str] = {}
    for warning in case.warnings:
        if warning.key == "wellbore.caliper":
            found[warning.code] = found.get(warning.code, "") + str(warning)
    return found


def test_a_plausible_caliper_is_not_doubted() -> None:
    assert doubted(0.2159 + 0.01 * np.abs(np.sin(MD))) == {}
    assert doubted(np.where((MD > 700) & (MD < 730), 0.35, 0.22)) == {}


@pytest.mark.parametrize(
    ("code", "sizes", "md", "words"),
    [
        ("caliper_size", np.full(len(MD), 0.108), MD, "diameters or radii"),
        ("caliper_size", np.full(len(MD), 0.55), MD, "check the unit"),
        ("caliper_gauge", np.where(MD == 700, 0.20, 0.22), MD, "200 mm at 700 m"),
        ("caliper_spike", np.where(MD == 700, 0.35, 0.22), MD, "1 row that differ"),
        ("caliper_depth", np.full(len(MD), 0.22), MD / 0.3048, "probably feet"),
        ("caliper_depth", np.full(len(MD), 0.22), np.append(-5.0, MD[1:]), "above the surface"),
        ("caliper_depth", np.full(len(MD), 0.22), MD + 1000, "no row lies in open hole"),
    ],
)
def test_a_caliper_that_does_not_fit_is_doubted(code: str, sizes: Any, md: Any, words: str) -> None:
    assert words in doubted(sizes, md)[code]


def test_a_first_arm_in_degrees_without_a_unit_is_doubted() -> None:
    rows = {"rows": np.column_stack([MD, np.full((len(MD), 2), 0.22)]).tolist()}
    (warning,) = (w for w in bent_case("sampled", caliper={**rows, "first_arm": 45}).warnings if w.code == "angle")
    assert "45 looks like '45 deg'" in str(warning)
    assert not any(w.code == "angle" for w in bent_case("sampled", caliper={**rows, "first_arm": "45 deg"}).warnings)


def test_a_las_file_without_rows_is_refused_in_one_sentence(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = tmp_path / "empty.las"
    path.write_text("~Version\n VERS. 2.0:\n WRAP. NO:\n~Well\n~Curve\n DEPT.m :\n CALI.in :\n~A\n", encoding="utf-8")
    with pytest.raises(ValueError, match="rows = 0: expected two rows or more"):
        _ = bent_case("sampled", caliper={"log": path}).wellbore.calipers
    assert not caplog.records
