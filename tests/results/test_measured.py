"""Measured rows of a CSV file: units from headers, ranges, and messages that name row and column."""

from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.rows import read_rows
from fctd.case.errors import InputError
from fctd.results.measured import measured_column, read_measured
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
    assert table["surface_torque_low_N_m"].isna().all()


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


def test_columns_of_ranges() -> None:
    assert measured_column("hookload_N", "low") == "hookload_low_N"
    assert measured_column("surface_torque_N_m", "high") == "surface_torque_high_N_m"


GOOD = "depth_m,operation,hookload_kN,hookload_low_kN,hookload_high_kN\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["a row of headers"]),
        (GOOD, ["a row of headers and a row"]),
        ("operation,hookload_kN\ntrip_in,1\n", ["row 1", "a column of bit depth"]),
        ("depth_m,hookload_kN\n1,1\n", ["row 1", "a column of operation"]),
        ("depth_m,operation,remark\n1,trip_in,x\n", ["row 1", "a column of load or torque"]),
        ("depth,operation,hookload_kN\n1,trip_in,1\n", ['row 1 = "depth"', "ends in its unit, such as bit_depth_m"]),
        ("depth_kg,operation,hookload_kN\n1,trip_in,1\n", ['row 1 = "depth_kg"', "ends in its unit"]),
        ("depth_m,md_ft,operation,hookload_kN\n1,3,trip_in,1\n", ['"md_ft"', "one column of bit_depth_m", "depth_m"]),
        (GOOD + "1,trip_inn,5,,\n", ['row 2, operation = "trip_inn"', "the kind trip_in"]),
        (GOOD + "1,trip_in,5,,\n2,trip_in,heavy,,\n", ['row 3, hookload_kN = "heavy"', "a number"]),
        (GOOD + "1,trip_in,nan,,\n", ["row 2, hookload_kN", "a force"]),
        (GOOD + "-1,trip_in,5,,\n", ["row 2, depth_m", "at least 0"]),
        (GOOD + ",trip_in,5,,\n", ["row 2, depth_m", "a number"]),
        (GOOD + ",in_slips,5,,\n,tare,,,\n", ["a row with a string in the hole"]),
        (GOOD + "1,trip_in,5,4,\n", ["row 2, hookload", "both ends"]),
        (GOOD + "1,trip_in,5,6,7\n", ["row 2, hookload", "that rise"]),
        (GOOD + "1,trip_in,,7,6\n", ["row 2, hookload", "that rise"]),
    ],
)
def test_errors_name_file_row_and_column(text: str, expected: list[str], tmp_path: Path) -> None:
    with pytest.raises(InputError) as raised:
        read_measured(written(tmp_path, text), CASE)
    for part in ("rows.csv", *expected):
        assert part in str(raised.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="can be read"):
        read_measured(tmp_path / "none.csv", CASE)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="CSV file of text"):
        read_measured(tmp_path / "binary.csv", CASE)


def test_a_depth_below_the_hole_is_refused(tmp_path: Path) -> None:
    """By more than the joints between the last station and the bit."""
    rows = "depth_m,operation,hookload_kN\n{},trip_in,500\n"
    assert len(read_measured(written(tmp_path, rows.format(2025)), CASE)) == 1
    with pytest.raises(
        InputError, match=r'row 2, depth_m = "9000": expected a depth in the hole, which ends at 2000 m'
    ):
        read_measured(written(tmp_path, rows.format(9000)), CASE)
