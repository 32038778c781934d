"""Rows of a calibration: every column, and messages that name file, row and column."""

from pathlib import Path

import numpy as np
import pytest

import fctd
from fctd.calibration.measured_file import OPERATIONS
from fctd.calibration.rows import Range, read_rows
from fctd.case.errors import InputError
from tests.calibration.wells import well

HEADERS = "id,bit_depth_m,operation,hookload_kN,torque_low_kN_m,torque_high_kN_m,rpm,speed_m_s"


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "rows.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_row_has_all_that_its_columns_say(tmp_path: Path) -> None:
    text = (
        "id,string,Bit depth (ft),operation,speed_ft/min,rpm,flow (L/min),Hook load low (klbf),hookload high (klbf),"
        "torque_kft_lbf,weight,source,stroke_m,locked torque (kN*m)\n"
        "A,wiper,3000,back_ream,30,90,1800,100,110,4,0.5,DDR,12,1.5\n"
    )
    (row,), strings = read_rows(written(tmp_path, text), well(), {"wiper": well()}, measured=True)
    assert (row.id, row.string, row.operation, row.source, row.weight) == ("A", "wiper", "back_ream", "DDR", 0.5)
    assert row.bit_depth == pytest.approx(914.4)
    assert row.rates == pytest.approx((-0.1524, 90 * np.pi / 30, 0.0))
    assert row.hookload == Range(pytest.approx(444822.16152605), pytest.approx(489304.377678655))  # lbf: NIST SP 811
    assert row.torque == Range(pytest.approx(5423.2719), pytest.approx(5423.2719))
    assert (row.flow, row.stroke, row.locked_torque) == (pytest.approx(0.03), 12.0, 1500.0)
    assert set(strings) == {"", "wiper"}


def test_rows_without_a_string_need_no_depth(tmp_path: Path) -> None:
    text = f"{HEADERS}\n,,in_slips,230,,,,\n,,tare,231,1,2,60,\n"
    rows, _ = read_rows(written(tmp_path, text), well(), {}, measured=True)
    assert [row.operation for row in rows] == ["in_slips", "tare"]
    assert [row.id for row in rows] == ["row 2", "row 3"]
    assert rows[1].rates.spin == pytest.approx(2 * np.pi)
    assert [row.direction for row in rows] == [0, 0]
    assert OPERATIONS[-2:] == ("in_slips", "tare")


def test_a_string_may_be_another_case_beside_the_rows(tmp_path: Path) -> None:
    (tmp_path / "wiper.toml").write_text(
        'name = "wiper"\n[wellbore]\nstations = [[0, 0, 0], [800, 0, 0]]\n'
        "[[wellbore.intervals]]\nto_md = 800\ndiameter = 0.3\nfriction = 0.2\n"
        '[[string.components]]\nname = "pipe"\nouter_diameter = 0.127\ninner_diameter = 0.1\n',
        encoding="utf-8",
    )
    text = "string,bit_depth_m,operation,hookload_kN\nwiper.toml,700,trip_in,300\n"
    rows, strings = read_rows(written(tmp_path, text), well(), {}, measured=True)
    assert strings[rows[0].string].name == "wiper"
    with pytest.raises(InputError, match=r"row 2, bit_depth_m = \"900\": expected a depth in the well.*800 m"):
        read_rows(written(tmp_path, text.replace("700", "900")), well(), {}, measured=True)


def test_a_prediction_needs_no_loads(tmp_path: Path) -> None:
    rows, _ = read_rows(written(tmp_path, "bit_depth_m,operation\n900,trip_in\n"), well(), {}, measured=False)
    assert rows[0].hookload is None
    assert rows[0].torque is None
    assert Range(1.0, 3.0).middle == 2.0


DRILLED = {"kind": "drill_rotating", "from_md": 1490, "to_md": 1500, "speed": 0.01, "rpm": 120, "flow": 0.04}


@pytest.mark.parametrize(
    ("operation", "pumps", "flow", "acts"),
    [
        ("rotate_off_bottom", "", "", 0.04),
        ("rotate_off_bottom", "off", "", 0.0),
        ("rotate_off_bottom", "on", "1800", 0.03),
        ("trip_out", "", "", 0.0),
        ("trip_out", "on", "", 0.04),
        ("trip_in", "", "1800", 0.03),
    ],
)
def test_a_row_pumps_what_it_says_else_the_flow_of_the_case(
    tmp_path: Path, operation: str, pumps: str, flow: str, acts: float
) -> None:
    case = fctd.load_case(well(mud={"density": 1200.0, "viscosity": 0.03}), {"operations": [DRILLED]})
    text = f"bit_depth_m,operation,hookload_kN,pumps,flow_L_min\n900,{operation},500,{pumps},{flow}\n"
    (row,), _ = read_rows(written(tmp_path, text), case, {}, measured=True)
    assert row.rates.flow == pytest.approx(acts)
    assert row.does(case)["flow_m3_s"] == pytest.approx(acts)


def test_what_a_report_says_beside_its_readings(tmp_path: Path) -> None:
    text = (
        "report,bit_depth_m,operation,torque_kN_m,torque read,pumps\n"
        "10 Nov,700,rotate_off_bottom,4,on_bottom,on\n,700,rotate_off_bottom,3,,\n"
    )
    one, other = read_rows(written(tmp_path, text), well(), {}, measured=True)[0]
    assert (one.day, one.torque_read, one.pumps) == ("10 Nov", "on_bottom", "on")
    assert (other.day, other.torque_read, other.pumps) == ("", "off_bottom", "")
    for wrong, column in (("bottom", "torque read"), ("maybe", "pumps")):
        with pytest.raises(InputError, match=f"row 2, {column} = .*, or nothing"):
            read_rows(written(tmp_path, text.replace("on_bottom" if wrong == "bottom" else ",on\n",
                                                     wrong if wrong == "bottom" else f",{wrong}\n")), well(), {},
                      measured=True)  # fmt: skip
