"""Measured rows of a CSV file: units from headers, ranges, and messages that name row and column."""

from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.measured import read_measured
from fctd.calibration.rows import read_rows
from fctd.case.errors import InputError
from fctd.results.columns import measured_column
from tests.cases import make_case, pipe

CASE = make_case([[0.0, 0, 0], [2000, 0, 0]], [pipe(None, 40)], rig={"block_weight": 1e5, "sheave_efficiency": 0.9})
LBF, FOOT = 4.4482216152605, 0.3048  # exact (NIST SP 811, appendix B.8)


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "rows.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "headers",
    [
        "depth_ft,operation,string_load_klbf,string_load_low_klbf,string_load_high_klbf,torque_kft_lbf,remark",
        "Bit depth (ft),Operation,String load (klbf),String load low [klbf],STRING LOAD HIGH (klbf),Torque (kft*lbf),x",
        "MD [ft],kind,string load (klbf),string_load_low_klbf,string load high (klbf),surface_torque_kft_lbf,y",
    ],
)
def test_headers_name_their_units_as_those_of_surveys_do(headers: str, tmp_path: Path) -> None:
    table = read_measured(written(tmp_path, f"{headers}\n1000,trip_in,50,45,56,,late\n\n2000,trip_out,,,,3,\n"), CASE)
    assert table["operation"].tolist() == ["trip_in", "trip_out"]
    np.testing.assert_allclose(table["bit_depth_m"], [1000 * FOOT, 2000 * FOOT])
    for column, value in (("hookload_N", 50), ("hookload_low_N", 45), ("hookload_high_N", 56)):
        np.testing.assert_allclose(table[column], [value * 1e3 * LBF, np.nan])
    np.testing.assert_allclose(table["surface_torque_N_m"], [np.nan, 3e3 * FOOT * LBF])
    assert table[measured_column("surface_torque_N_m", "low")].isna().all()


def test_the_indicator_and_the_string_are_converted_into_each_other(tmp_path: Path) -> None:
    """A block of 100 kN; the dead line has 1/0.9 of the load while it is lowered, 0.9 of it while it is hoisted."""
    text = "depth_m,operation,weight_indicator_kN,weight_indicator_low_kN,weight_indicator_high_kN\n"
    table = read_measured(written(tmp_path, text + "10,trip_in,500,450,540\n20,trip_out,450,,\n"), CASE)
    np.testing.assert_allclose(table["hookload_N"], [500e3 * 0.9 - 1e5, 450e3 / 0.9 - 1e5])
    np.testing.assert_allclose(table["hookload_low_N"], [450e3 * 0.9 - 1e5, np.nan])
    table = read_measured(written(tmp_path, "depth_m,operation,string_load_kN\n10,rotate_off_bottom,300\n"), CASE)
    np.testing.assert_allclose(table["weight_indicator_N"], [400e3])


def test_a_measured_hook_load_has_the_block_in_it_as_in_a_calibration(tmp_path: Path) -> None:
    rows = written(tmp_path, "depth_m,operation,hookload_kN\n10,rotate_off_bottom,400\n,in_slips,100\n,tare,\n")
    table = read_measured(rows, CASE)
    fitted, _ = read_rows(rows, CASE, {}, measured=False)
    np.testing.assert_allclose(table["hookload_N"], [300e3])  # the rows without a string are left out
    assert fitted[0].hookload is not None
    assert table["weight_indicator_N"].tolist() == [fitted[0].hookload.middle]


def test_a_depth_below_the_hole_is_refused(tmp_path: Path) -> None:
    """By more than the joints between the last station and the bit."""
    rows = "depth_m,operation,hookload_kN\n{},trip_in,500\n"
    assert len(read_measured(written(tmp_path, rows.format(2025)), CASE)) == 1
    with pytest.raises(
        InputError, match=r'row 2, depth_m = "9000": expected a depth in the hole, which ends at 2000 m'
    ):
        read_measured(written(tmp_path, rows.format(9000)), CASE)


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ("1000,trip_in,340\n1000,trip_out,104\n1000,rotate_off_bottom,205\n",
         "a slack-off weight of 340 kN above the rotating weight of 205 kN at 1000 m: swapped or misread?"),
        ("900,trip_in,300\n900,trip_out,100\n1000,trip_in,340\n1000,trip_out,104\n",
         "a slack-off weight of 300 kN above the pick-up weight of 100 kN at 900 m: swapped or misread? "
         "(and at 1 more depth)"),
        ("900,trip_in,100\n900,trip_out,340\n1000,trip_in,104\n1000,trip_out,103\n", None),  # within the noise
        ("900,trip_in,340\n1000,trip_out,104\n", None),  # of two depths
    ],
)  # fmt: skip
def test_swapped_pick_up_and_slack_off_are_told(rows: str, expected: str | None, tmp_path: Path) -> None:
    found: list[str] = []
    read_measured(written(tmp_path, "depth_m,operation,hookload_kN\n" + rows), CASE, None, found.append)
    assert found == ([] if expected is None else [expected])
    read_measured(written(tmp_path, "depth_m,operation,hookload_kN\n" + rows), CASE, "field", found.append)
    assert expected is None or "klbf at" in found[-1]
