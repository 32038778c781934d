"""One reader of what people write: a header, a unit and a number mean the same to every command that reads them."""

from pathlib import Path

import pytest

from fctd.calibration.measured import read_measured
from fctd.calibration.rows import read_rows
from fctd.case.errors import InputError
from fctd.case.surveys.form import SURVEY
from fctd.case.tables.headers import TableForm
from fctd.case.tables.rows import Numbers
from fctd.case.tables.text import read_text
from fctd.monitoring.quantities import SERIES
from fctd.monitoring.series import read_series
from tests.calibration.wells import well

LBF = 4.4482216152605  # exact (NIST SP 811, appendix B.8)


def hook_loads(path: Path) -> list[float]:
    """What calibrate, monitor and chart --measured read of the only row of a file [N]."""
    (row,), _ = read_rows(path, well(), {}, measured=True)
    assert row.hookload is not None
    tables = read_series(path), read_measured(path, well())
    return [row.hookload.middle, *(table["weight_indicator_N"].iloc[0] for table in tables)]


@pytest.mark.parametrize("header", ["HKLD [klbf]", "Average Hookload klbf", "hook_load_klbf", "Indicator (klbf)"])
def test_a_hook_load_is_one_for_calibrate_monitor_and_chart(header: str, tmp_path: Path) -> None:
    path = tmp_path / "rows.csv"
    path.write_text(f"bit_depth_m,operation,{header},torque_N_m\n1000,trip_in,100,0\n")
    assert hook_loads(path) == pytest.approx([100e3 * LBF] * 3, rel=1e-14)


@pytest.mark.parametrize("separator", [",", ";", "\t", "|", "  "])
@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
def test_all_read_what_an_office_writes(separator: str, encoding: str, tmp_path: Path) -> None:
    """Titles, comments, a row of units, decimal commas; between commas a decimal comma stands in quotes."""
    path, load = tmp_path / "rows.csv", '"100,5"' if separator == "," else "100,5"
    table = ["# Brønn", "Depth Operation HKLA Torque", "m . kN N*m", f"1000 trip_in {load} 0"]
    text = "Brønn A-1: øvre del\n" + "\n".join(table).replace(" ", separator).replace(f"#{separator}", "# ") + "\n\n"
    path.write_text(text.replace("Depth", "BDEP"), encoding=encoding)
    assert hook_loads(path) == [100.5e3] * 3


@pytest.mark.parametrize(
    ("form", "text", "key", "expected"),
    [
        (SURVEY, "md_m;inc;azi\n0;0;0\n1,234;3;4", "row 3, md_m", "a number whose comma has one meaning: this is 1.2"),
        (SERIES, "bit_depth_m;operation;hkld_kN;tqa_Nm\n9;a;1,234;0", "row 2, hkld_kN", "a number whose comma has one"),
        (SERIES, "bit_depth_m;operation;hkld_kN;tqa_Nm\n9,5;a;1.234;0", "row 2, hkld_kN", "a number with a decimal co"),
        (SERIES, "bit_depth_m;operation;hkld_kN;tqa_Nm\nx;a;y;0\nz;b;0;0", "row 2, bit_depth_m", "a number (3 such c"),
        (SURVEY, "md_m;inc;azi\n0;0;inf\n", "row 2, azi", "a finite number"),
    ],
)
def test_numbers_are_read_in_one_way_or_refused(form: TableForm, text: str, key: str, expected: str) -> None:
    rows = read_text(text, form, {})
    with pytest.raises(InputError) as refused:
        Numbers().read(rows, [name for name, column in rows.columns.items() if column.field.quantity is not None])
    assert refused.value.key == key
    assert refused.value.expected.startswith(expected)


def test_a_point_beside_decimal_commas_is_one_of_decimals_where_it_can_be_no_other() -> None:
    rows = read_text("md_m;inc;azi\n0;0;0\n10,5;1.25;2", SURVEY, {})
    assert Numbers().read(rows, ["md", "inc"]).tolist() == [[0, 0], [10.5, 1.25]]


def test_headers_that_come_again_below_themselves_are_no_row_of_units() -> None:
    heads, row = "bit_depth_m,operation,rpm_rpm,hkld_kN,tqa_kNm\n", "9,trip_in,60,100,1\n"
    rows = read_text(heads + heads + row, SERIES, {})
    assert rows.numbers == [3]
    assert rows.cells["rpm"] == ["60"]
