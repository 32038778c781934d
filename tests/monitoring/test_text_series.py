"""Texts in columns, whole and growing."""

from pathlib import Path

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.monitoring.text_series import Tail, read_text

HEADERS = ["time", "bit_depth_m", "hook_load_kN", "torque_kN_m", "rpm", "block_position_m"]
CELLS = ["2007-10-23 08:07:08", "100", "500", "2.5", "60", "3"]


def test_titles_units_and_dates() -> None:
    text = "Well A\n\nTime;Bit Depth;HKLA;TQA;RPM;BPOS\n;m;kN;kN.m;rpm;m\n2007-10-23 08:07:08;9,5;500;2,5;60;3\n\n"
    (row,) = read_text(text, {}).itertuples()
    assert (row.Index, row.time_s, row.bit_depth_m) == (5, 1193126828.0, 9.5)  # 2007-10-23T08:07:08Z


@pytest.mark.parametrize(("date", "time"), [("2007-10-23", "08:07:08"), ("late", "2007-10-23 08:07:08")])
def test_date_and_time_of_day_in_two_columns(date: str, time: str) -> None:
    text = f"date,time,bit_depth_m,hook_load_kN,torque_kN_m,rpm,block_position_m\n{date},{time},100,500,2,60,3\n"
    assert read_text(text, {})["time_s"].iloc[0] == 1193126828.0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "the file is empty"),
        ("a,b\n1,2\n", "a row of headers"),
        (",".join(HEADERS).replace("_kN,", ",") + "\n" + ",".join(CELLS), "with its unit"),
        (",".join(HEADERS) + "\n" + ",".join(["23.10.2007 08:07", *CELLS[1:]]), "ISO 8601"),
        (",".join(HEADERS) + "\n" + ",".join([*CELLS, "7", "8"]), "row 2.*expected at most 6 cells"),
    ],
)
def test_what_is_refused(text: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        read_text(text, {})


def test_no_rows_are_an_empty_table() -> None:
    assert len(read_text("time_s," + ",".join(HEADERS[1:]) + "\n", {})) == 0


def test_a_growing_file_gives_whole_lines_alone(tmp_path: Path) -> None:
    path = tmp_path / "series.csv"
    lines = [",".join(HEADERS), ",".join(CELLS), ",".join(CELLS).replace(":08,", ":12,")]
    tail, seen = Tail(path, {}), []
    path.write_text("")
    for part in (lines[0] + "\n", lines[1][:9], lines[1][9:] + "\n" + lines[2][:30], lines[2][30:], "\n", ""):
        with path.open("a") as file:
            file.write(part)
        rows = tail.rows()
        seen.append(0 if rows is None else len(rows))
        if rows is not None:
            last = rows
    assert seen == [0, 0, 1, 0, 1, 0]
    whole = read_text(path.read_text(), {})
    pd.testing.assert_frame_equal(last, whole.iloc[1:], check_index_type=False)


def test_a_file_that_becomes_shorter_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "series.csv"
    path.write_text(",".join(HEADERS) + "\n" + ",".join(CELLS) + "\n")
    tail = Tail(path, {})
    assert tail.rows() is not None
    path.write_text("")
    with pytest.raises(InputError, match="shorter"):
        tail.rows()
