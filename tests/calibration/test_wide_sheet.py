"""Sheets of a rig, a row for each depth: what becomes of their weights and torques, whoever reads them."""

from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.measured import read_measured
from fctd.calibration.rows import Row, read_rows
from fctd.case.errors import InputError
from fctd.results.unit_systems import System
from tests.calibration.wells import well

FOOT, KLBF = 0.3048, 4448.2216152605  # exact (NIST SP 811, appendix B.8)


def rows_of(tmp_path: Path, text: str, units: System | None = None, *, measured: bool = True) -> list[Row]:
    path = tmp_path / "sheet.csv"
    path.write_text(text)
    return read_rows(path, well(), {}, measured=measured, units=units)[0]


SHEET = "{}\n1000,125,123,124,2\n2000,158,-,155,\n3000,,,,\n"


@pytest.mark.parametrize(
    "headers",
    [
        "Depth (ft),PU (klbs),SO (klbs),ROT (klbs),TQ (kft-lbs)",
        "MD_ft,PickUp_Klbs,Slackoff_Klbs,Rotating_Klbs,Rot_Torque_kft_lbf",
        "Bit Depth [ft],P.U. Wt. (klb),S/O Wt. (klb),Free rot weight (klbf),ROB Torque (kft.lbf)",
        "Measured Depth,Pick-up,Slack-off,Rotating,Torque\n(ft),(klbf),(klbf),(klbf),(kft.lbf)",
        "DEPTH,PU,SO,ROT,TQ",
    ],
)
def test_a_sheet_is_a_row_for_each_reading(headers: str, tmp_path: Path) -> None:
    """The torque is that of the rotating string; a row of no reading, as of a depth still ahead, is none."""
    found = rows_of(tmp_path, SHEET.format(headers), "field")
    read = [(row.operation, row.bit_depth / FOOT, row.hookload and row.hookload.low / KLBF) for row in found]
    expected = [(1000, 125), (1000, 123), (1000, 124), (2000, 158), (2000, 155)]
    np.testing.assert_allclose([row[1:] for row in read], expected)
    assert [row[0] for row in read] == ["trip_out", "trip_in", "rotate_off_bottom", "trip_out", "rotate_off_bottom"]
    (torque,) = (row.torque for row in found if row.torque is not None)
    assert (torque.low / FOOT / KLBF, found[2].torque) == (pytest.approx(2.0), torque)
    drawn = read_measured(tmp_path / "sheet.csv", well(), "field")
    assert drawn["operation"].tolist() == [row.operation for row in found]
    np.testing.assert_allclose(drawn["weight_indicator_N"], [row.hookload.low for row in found if row.hookload])


def test_units_that_no_header_names(tmp_path: Path) -> None:
    """They are those of the command, which says so, or the sheet is refused; one that is named must be one of them."""
    told: list[str] = []
    path = tmp_path / "sheet.csv"
    path.write_text("MD,PU,SO,ROT\n900,500,450,470\n")
    (up, *_), _ = read_rows(path, well(), {}, measured=True, units="si", tell=told.append)
    assert up.hookload == (5e5, 5e5)
    assert told == [
        'headers without units are read as: "MD" in m, "PU" in kN, "SO" in kN, "ROT" in kN; write the units into them '
        "if they are others"
    ]
    with pytest.raises(InputError, match=r'row 1 = .*"ROT".: expected headers with their units, such as "MD .m."'):
        read_rows(path, well(), {}, measured=True)
    assert len(rows_of(tmp_path, "MD (ft),PU,SO\n900,500,450\n", "field")) == 2
    with pytest.raises(InputError, match="headers with their units"):
        rows_of(tmp_path, "MD (ft),PU,SO\n900,500,450\n", "si")


def test_what_stands_beside_the_weights(tmp_path: Path) -> None:
    """Rotation is that of the rotating string, speed that of the others; a torque without a weight is a reading."""
    text = "name,day,Depth (m),PU (kN),SO (kN),TQ (kN.m),RPM,Speed (m/min),Remark\nA,1 May,900,500,,3,80,12,late\n"
    up, turning = rows_of(tmp_path, text)
    assert (up.id, up.day, up.rates) == ("A, pick-up", "1 May", (pytest.approx(-0.2), 0.0, 0.0))
    assert (turning.id, turning.operation, turning.hookload) == ("A, rotating", "rotate_off_bottom", None)
    assert turning.rates.spin == pytest.approx(80 * np.pi / 30)


def test_what_is_to_be_predicted_needs_no_reading(tmp_path: Path) -> None:
    found = rows_of(tmp_path, "Depth (m),PU (kN),SO (kN)\n900,,\n", measured=False)
    assert [(row.operation, row.hookload) for row in found] == [("trip_out", None), ("trip_in", None)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Depth (m),PU (kN),operation\n900,1,PU\n", 'row 1 = "operation": expected no such column beside PU (kN)'),
        ("Depth (m),PU (kN),Hook load (kN)\n900,1,2\n", 'row 1 = "Hook load (kN)": expected no such column'),
        ("Depth (m),PU (kN)\n900,\n", "expected a row with a reading"),
        ("PU (kN),SO (kN)\n1,2\n", "column bit_depth_m is missing"),
        ("Depth (m),PU (kN),SO (kN)\n900,1,low\n", 'row 2, SO (kN) = "low": expected a number'),
    ],
)
def test_refused(text: str, expected: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        rows_of(tmp_path, text)
    assert expected in str(refused.value)


def test_a_sheet_in_a_workbook(tmp_path: Path) -> None:
    pd = pytest.importorskip("pandas")
    pytest.importorskip("python_calamine")
    table = pd.DataFrame({"Depth (m)": [900.0], "PU (kN)": [500.0], "SO (kN)": [450.0]})
    with pd.ExcelWriter(tmp_path / "sheet.xlsx", engine="xlsxwriter") as book:
        table.to_excel(book, sheet_name="T&D", index=False, startrow=2)
        pd.DataFrame({"note": ["none"]}).to_excel(book, sheet_name="notes", index=False)
    found, _ = read_rows(tmp_path / "sheet.xlsx", well(), {}, measured=True)
    assert [row.operation for row in found] == ["trip_out", "trip_in"]
