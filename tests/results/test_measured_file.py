"""Columns by their headers: units in brackets, as products and as quotients."""

from pathlib import Path

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.units import ROTATION, SPEED, TORQUE
from fctd.results.measured_file import Field, Text, read_lines, require

FIELDS = (
    Field("speed", "m_s", SPEED, "speed", "m_s", at_least=0.0),
    Field("torque", "N_m", TORQUE, "torque", "kN_m", ranged=True),
    Field("rpm", "", ROTATION, "rpm", "rpm", bare="rpm"),
)


def read(tmp_path: Path, text: str, encoding: str = "utf-8") -> list[dict[str, object]]:
    path = tmp_path / "rows.csv"
    path.write_text(text, encoding=encoding)
    return [line.cells for line in read_lines(path, FIELDS, [Text("name", "name|id")], "such as speed_m_s")]


@pytest.mark.parametrize("header", ["speed_m_s", "Speed (m/s)", "speed [m/s]", "speed_m/s"])
def test_a_quotient_of_units(header: str, tmp_path: Path) -> None:
    assert read(tmp_path, f"{header}\n0.3\n") == [{"speed_m_s": 0.3}]


def test_products_ranges_bare_units_texts_and_empty_cells(tmp_path: Path) -> None:
    (row,) = read(tmp_path, "id,torque_low_kN_m,torque_high (kN*m),rpm,remark\nA,1,2,\n")
    assert row["name"] == "A"
    assert (row["torque_low_N_m"], row["torque_high_N_m"]) == (1e3, 2e3)
    assert np.isnan(float(str(row["rpm"])))
    assert "remark" not in row


@pytest.mark.parametrize("separator", ["\t", ";", " , "])
def test_rows_of_a_spreadsheet(separator: str, tmp_path: Path) -> None:
    name = "a" if separator == " , " else "a, b"
    text = f"\nname{separator}speed_m_s\n{name}{separator}0.3\n"
    assert read(tmp_path, text) == [{"name": name, "speed_m_s": 0.3}]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "cp1252"])
def test_rows_in_the_encodings_of_an_office(encoding: str, tmp_path: Path) -> None:
    text = "name,speed_m_s\nprüf,0.5\n"
    assert read(tmp_path, text, encoding) == [{"name": "prüf", "speed_m_s": 0.5}]


def test_a_decimal_comma_is_read_and_never_drops_digits(tmp_path: Path) -> None:
    for separator in ("\t", ";"):
        assert read(tmp_path, f"speed_m_s{separator}name\n0,35{separator}a\n") == [{"name": "a", "speed_m_s": 0.35}]
        with pytest.raises(InputError, match="a number"):  # 1.234 or 1234
            read(tmp_path, f"speed_m_s{separator}name\n1,234{separator}a\n")
    with pytest.raises(InputError, match=r'^row 2 = "a, 0, 35": expected 2 cells, as many as headers'):
        read(tmp_path, "name,speed_m_s\na,0,35\n")
    assert read(tmp_path, "name,speed_m_s\na,0.35,,\n") == [{"name": "a", "speed_m_s": 0.35}]


def test_a_file_of_readings_over_time_is_no_file_of_rows(tmp_path: Path) -> None:
    """A string is solved for each row: 200,000 of them would take hours."""
    text = "name,speed_m_s\n" + "a,1\n" * 10_000
    assert len(read(tmp_path, text)) == 10_000
    with pytest.raises(InputError, match="10001: expected at most 10000 rows"):
        read(tmp_path, text + "a,1\n")


def test_no_known_header(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="such as speed_m_s"):
        read(tmp_path, "a,b\n1,2\n")


def test_a_column_that_is_required(tmp_path: Path) -> None:
    path = tmp_path / "rows.csv"
    path.write_text("speed_m_s\n1\n", encoding="utf-8")
    lines = read_lines(path, FIELDS, [], "such as speed_m_s")
    require(lines, "speed", ["speed_m_s"], "such as speed_m_s")
    with pytest.raises(InputError, match="a column of torque among the headers, such as speed_m_s"):
        require(lines, "torque", ["torque_N_m"], "such as speed_m_s")
    error = lines[0].error("speed_m_s", "more")
    assert (error.key, error.value) == ("row 2, speed_m_s", "1")
