"""Files of measured rows: what a header and a cell mean to `calibrate` and `chart --measured`, and what they refuse."""

from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.measured import read_measured
from fctd.calibration.measured_file import MOST_ROWS
from fctd.calibration.rows import Row, read_rows
from fctd.case.errors import InputError
from tests.calibration.wells import well


def read(tmp_path: Path, text: str, of_a_chart: bool | None = None) -> list[Row]:
    """Rows that need no load where nothing is said of what they are for."""
    path = tmp_path / "rows.csv"
    path.write_text(text)
    if of_a_chart:
        read_measured(path, well())
    return read_rows(path, well(), {}, measured=of_a_chart is False)[0]


@pytest.mark.parametrize("header", ["speed_m_s", "Speed (m/s)", "speed [m/s]", "speed_m/s"])
def test_a_quotient_of_units(header: str, tmp_path: Path) -> None:
    assert [row.rates.speed for row in read(tmp_path, f"operation,md_m,{header}\ntrip_in,900,0.3\n")] == [0.3]


def test_products_ranges_bare_units_texts_and_empty_cells(tmp_path: Path) -> None:
    text = "id,operation,torque_low_kN_m,torque_high (kN*m),rpm,flow_L_min,remark\nA,tare,1,2,,\n"
    (row,) = read(tmp_path, text)
    assert (row.id, row.torque, row.rates.spin) == ("A", (1e3, 2e3), 0.0)
    assert np.isnan(row.flow)


def test_a_column_of_another_quantity_is_left_alone(tmp_path: Path) -> None:
    text = "operation,Torque limit (kN.m),torque_kN_m,depth_tvd_m,md_m,torque_max_kN_m\ntare,1,2,3,4,5,,\n"
    (row,) = read(tmp_path, text)
    assert (row.torque, row.bit_depth) == ((2e3, 2e3), 4)


HEADERS = "id,bit_depth_m,operation,hookload_kN,torque_low_kN_m,torque_high_kN_m,rpm,speed_m_s\n"
GOOD = HEADERS + "first,1000,trip_in,500,,,,\n"
# Files that neither command reads.
WRONG = [
    ("", ["a row of headers"]),
    ("a,b\n1,2\n", ["a row of headers such as "]),
    (HEADERS, ["a row of headers and a row"]),
    (
        "bit_depth_m,hookload_kN\n1,1\n",
        ["column operation or pick_up_kN or slack_off_kN is missing", '"bit_depth_m", "hookload_kN"'],
    ),
    ("depth,operation,hookload_kN\n1,trip_in,1\n", ['row 1 = "depth"', 'a header with its unit, such as "depth (m)"']),
    ("depth_kg,operation,hookload_kN\n1,trip_in,1\n", ['row 1 = "depth_kg"', "a unit of m, cm"]),
    ("depth_m,operation,hookload_kNx\n1,trip_in,1\n", ['row 1 = "hookload_kNx"', "a unit of N"]),
    ("depth_m,operation,Hook load [foo]\n1,trip_in,1\n", ['row 1 = "Hook load [foo]"', "a unit of N"]),
    ("depth_m,md_ft,operation,hookload_kN\n1,3,trip_in,1\n", ['["depth_m", "md_ft"]', "one column"]),
    (GOOD + ",1000,trip_inn,1,,,,", ['row 3, operation = "trip_inn"', "the kind trip_in"]),
    (GOOD + ",1000,trip_in,heavy,,,,", ['row 3, hookload_kN = "heavy"', "a number"]),
    (GOOD + ",1000,trip_in,nan,,,,", ['row 3, hookload_kN = "nan"', "a finite number"]),
    (GOOD + ",1000,trip_in,1e300,,,,", ['row 3, hookload_kN = "1e300"', "at most 1e+09 N"]),
    (GOOD + ",1000,rotate_off_bottom,,1e9,,60,", ["row 3, torque_low_kN_m", "at most 1e+08 N*m"]),
    (GOOD + ",1000,rotate_off_bottom,,5,4,60,", ["row 3, ", "torque", "that rise"]),
    (GOOD + ",1000,rotate_off_bottom,,5,,60,", ["row 3, ", "torque", "both ends"]),
    (GOOD + ",-1,trip_in,5,,,,", ["row 3, bit_depth_m", "at least 0"]),
    (GOOD + ",,trip_in,1,,,,", ["row 3, bit_depth_m", "expected a "]),
    (GOOD + ",9000,trip_in,1,,,,", ['row 3, bit_depth_m = "9000"', "1500 m"]),
    ("depth_m,operation,hookload_kN\n1,trip_in,0,35\n", ['row 2 = "1, trip_in, 0, 35"', "at most 3 cells, as many"]),
]
# Of a calibration alone.
WRONG_ROWS = [
    ("depth_m,operation\n1,trip_in\n", ["column hookload_kN or torque_kN_m"]),
    ("depth_m,operation,hookload_kN,speed\n1,trip_in,1,1\n", ['row 1 = "speed"', "a header with its unit"]),
    ("depth_m,operation,hookload_kN,speed_kN\n1,trip_in,1,1\n", ['row 1 = "speed_kN"', "a unit of m/s"]),
    ("depth_m,operation,hookload_kN,weight\n900,trip_in,1,0\n", ["row 2, weight", "above 0"]),
    ("depth_m,operation,hookload_kN,weight\n900,trip_in,1,1e300\n", ["row 2, weight", "at most 1e+06"]),
    ("depth_m,operation,hookload_kN,string\n900,trip_in,1,x\n", ["row 2, string", "case file that exists"]),
    (GOOD + ",1000,trip_in,-5,,,,", ["row 3, hookload_kN", "at least 0"]),
    (GOOD + ",1000,trip_in,,,,,", ["row 3", "a hook load or a torque"]),
    (GOOD + ",,in_slips,1,1,2,,", ["row 3", "no torque for in_slips"]),
    (GOOD + ",1000,drill_sliding,1,,,60,", ['row 3, rpm = "60"', "rev/min of 0 for drill_sliding"]),
    (GOOD + ",1000,rotate_off_bottom,1,,,60,0.3", ["row 3, speed_m_s", "a speed of 0"]),
    (GOOD + "first,1000,trip_in,1,,,,", ["row 3, id", "no row above"]),
]
# Of a chart alone.
WRONG_POINTS = [
    ("operation,hookload_kN\ntrip_in,1\n", ["column bit_depth_m is missing"]),
    ("depth_m,operation,remark\n1,trip_in,x\n", ["column string_load_kN or hookload_kN or surface_torque_kN_m"]),
    ("depth_m,operation,hookload_kN\n,in_slips,5\n,tare,\n", ["a row with a string in the hole"]),
]


@pytest.mark.parametrize(
    ("of_a_chart", "text", "expected"),
    [(False, *wrong) for wrong in WRONG + WRONG_ROWS] + [(True, *wrong) for wrong in WRONG + WRONG_POINTS],
)
def test_an_error_names_file_row_and_column(of_a_chart: bool, text: str, expected: list[str], tmp_path: Path) -> None:
    with pytest.raises(InputError) as raised:
        read(tmp_path, text, of_a_chart=of_a_chart)
    assert [part for part in ["rows.csv", *expected] if part not in str(raised.value)] == []


def test_files_that_are_no_texts_of_rows(tmp_path: Path) -> None:
    """A string is solved for each row: 200,000 readings over time would take hours."""
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    (tmp_path / "long.csv").write_text("operation\n" + "tare\n" * (MOST_ROWS + 1))
    wrong = {"none": "can be read", "binary": "measured rows: text in columns", "long": f"at most {MOST_ROWS} rows"}
    for name, expected in wrong.items():
        with pytest.raises(InputError, match=expected):
            read_rows(tmp_path / f"{name}.csv", well(), {}, measured=False)
