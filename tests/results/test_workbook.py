"""Workbooks for people: headers with units, formats of numbers, metadata without JSON, texts that stay texts."""

import re
import zipfile
from pathlib import Path

import pandas as pd
import pytest

from fctd.results.shown_tables import Head, Heading, heading_of
from fctd.results.table_files import write_table

xlsxwriter = pytest.importorskip("xlsxwriter")
calamine = pytest.importorskip("python_calamine")


@pytest.mark.parametrize(
    ("column", "heading"),
    [
        ("hookload_N", Heading(Head("hook load", "kN"), 1e-3, 1)),
        ("hookload_klbf", Heading(Head("hook load", "klbf"), 1.0, 1)),
        ("surface_torque_N_m", Heading(Head("surface torque", "kN·m"), 1e-3, 3)),
        ("surface_torque_kft_lbf", Heading(Head("surface torque", "kft·lbf"), 1.0, 3)),
        ("hookload_left_N", Heading(Head("hook load left", "kN"), 1e-3, 1)),
        ("bit_depth_m", Heading(Head("bit depth", "m"), 1.0, 1)),
        ("clearance_m", Heading(Head("clearance", "mm"), 1e3, 1)),
        ("inclination_deg", Heading(Head("inclination", "°"), 1.0, 1)),
        ("speed_m_s", Heading(Head("speed", "m/s"), 1.0, 3)),
        ("jet_speed_ft_s", Heading(Head("jet speed", "ft/s"), 1.0, 1)),
        ("standpipe_psi", Heading(Head("standpipe", "psi"), 1.0, 0)),
        ("start_s", Heading(Head("start", "s"), 1.0, 1)),
        ("friction", Heading(Head("friction", ""), 1.0, None)),
    ],
)
def test_a_header_has_its_unit_and_numbers_their_digits(column: str, heading: Heading) -> None:
    assert heading_of(column) == heading


def test_a_workbook_has_a_sheet_of_the_table_and_one_of_its_origin(tmp_path: Path) -> None:
    """A missing number is an empty cell, a whole number has the unit of its head, a text and a path stay texts."""
    path = tmp_path / "chart.XLSX"
    table = pd.DataFrame(
        {
            "hookload_N": [1500.0, float("nan")],
            "air_N": [2000, 3000],
            "rows": [3, 4],
            "reason": ["=1+1", "https://localhost"],
        }
    )
    case = {"file": str(tmp_path / "my.toml"), "parts": [{"name": "=pipe"}], "stations": [[0, 0]] * 99, "none": None}
    assert write_table(table, path, {"rpm": [60, 90], "case": case, "on": True, "md": 1.5, "notes": []}) == [path]
    book = calamine.CalamineWorkbook.from_path(path)
    assert book.get_sheet_by_name("table").to_python() == [
        ["hook load (kN)", "air (kN)", "rows", "reason"], [1.5, 2, 3, "=1+1"], ["", 3, 4, "https://localhost"],
    ]  # fmt: skip
    assert dict(book.get_sheet_by_name("about").to_python()[1:]) == {
        "rpm": "60, 90", "case.file": "my.toml", "case.parts[0].name": "=pipe", "case.stations": "99 rows",
        "on": "True", "md": 1.5,
    }  # fmt: skip
    with zipfile.ZipFile(path) as parts:
        sheet, styles = (parts.read(f"xl/{name}.xml").decode() for name in ("worksheets/sheet1", "styles"))
    assert "<f>" not in sheet
    assert re.findall('formatCode="([^"]*)"', styles) == ["0.0"]
