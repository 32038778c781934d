"""Parquet, LAS and WITSML logs give the table of the same text."""

from pathlib import Path

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.monitoring.log_files import read_las, read_parquet, read_witsml_log
from fctd.monitoring.text_series import read_text

NAMES = ["TIME", "DBTM", "HKLA", "TQA", "RPM", "BPOS"]
UNITS = ["s", "m", "kN", "kN.m", "rpm", "m"]
ROWS = [[0.0, 100.0, 500.0, 2.5, 60.0, 3.0], [5.0, 101.0, 501.0, 2.6, 61.0, 3.5]]
LINES = [",".join(map(str, row)) for row in ROWS]


@pytest.fixture(scope="module")
def expected() -> pd.DataFrame:
    headers = ",".join(f"{name} ({unit})" for name, unit in zip(NAMES, UNITS, strict=True))
    return read_text(headers + "\n" + "\n".join(LINES) + "\n", {})


def same(found: pd.DataFrame, expected: pd.DataFrame) -> None:
    assert list(found.index) == [1, 2]
    pd.testing.assert_frame_equal(found.reset_index(drop=True), expected.reset_index(drop=True))


def log(lines: list[str] = LINES, before: str = "") -> str:
    data = "".join(f"<data>{line}</data>" for line in lines)
    lists = f"<mnemonicList>{','.join(NAMES)}</mnemonicList><unitList>{','.join(UNITS)}</unitList>"
    return f'{before}<logs xmlns="http://www.witsml.org/schemas/1series"><log><logData>{lists}{data}</logData></log></logs>'


def test_witsml(expected: pd.DataFrame) -> None:
    same(read_witsml_log(log(), {}), expected)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        (log(before="<!DOCTYPE logs>"), "DOCTYPE"),
        ("<trajectorys/>", "a WITSML log, found the element trajectorys"),
        ("<logs><log/></logs>", "logData"),
        (log(["1,2"]), "data 1.*6 values"),
    ],
)
def test_other_xml_is_refused(text: str, match: str) -> None:
    with pytest.raises(InputError, match=match):
        read_witsml_log(text, {})


def test_las(expected: pd.DataFrame) -> None:
    curves = "".join(f"{name}.{unit} :\n" for name, unit in zip(NAMES, UNITS, strict=True))
    data = "\n".join(line.replace(",", " ") for line in LINES)
    head = "~VERSION\nVERS. 2.0 :\nWRAP. NO :\n~WELL\nSTRT.s 0 :\nSTOP.s 5 :\nSTEP.s 5 :\nNULL. -999.25 :\n~CURVE\n"
    same(read_las(f"{head}{curves}~A\n{data}\n", {}), expected)


def test_parquet(expected: pd.DataFrame, tmp_path: Path) -> None:
    path = tmp_path / "series.parquet"
    pd.DataFrame(ROWS, columns=[f"{n} [{u}]" for n, u in zip(NAMES, UNITS, strict=True)]).to_parquet(path)
    same(read_parquet(path, {}), expected)
    path.write_bytes(b"PAR1 and nothing else")
    with pytest.raises(InputError, match="a Parquet table"):
        read_parquet(path, {})
