"""Texts in columns, whole and growing."""

from pathlib import Path

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.monitoring.text_series import Tail, find_form, read_text

HEADERS = ["time", "bit_depth_m", "hook_load_kN", "torque_kN_m", "rpm", "block_position_m"]
CELLS = ["2007-10-23 08:07:08", "100", "500", "2.5", "60", "3"]


@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
def test_separators_and_dates(separator: str) -> None:
    table = read_text(separator.join(HEADERS) + "\n" + separator.join(CELLS) + "\n", {})
    assert table["time_s"].iloc[0] == 1193126828.0  # 2007-10-23T08:07:08Z
    assert table["drive_torque_N_m"].iloc[0] == 2500.0


def test_decimal_commas_titles_and_a_row_of_units() -> None:
    text = "Well A\n\nTime;Bit Depth;HKLA;TQA;RPM;BPOS\ns;m;kN;kN.m;rpm;m\n0;100,5;500;2,5;60;3\n\n"
    table = read_text(text, {})
    assert (table["bit_depth_m"].iloc[0], table["drive_torque_N_m"].iloc[0]) == (100.5, 2500.0)
    assert list(table.index) == [5]


def test_date_and_time_of_day_in_two_columns() -> None:
    text = "date,time,bit_depth_m,hook_load_kN,torque_kN_m,rpm,block_position_m\n2007-10-23,08:07:08,100,500,2,60,3\n"
    assert read_text(text, {})["time_s"].iloc[0] == 1193126828.0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "the file is empty"),
        ("a,b\n1,2\n", "a row of headers"),
        (",".join(HEADERS).replace("_kN,", ",") + "\n" + ",".join(CELLS), "with its unit"),
        (",".join(HEADERS) + "\n" + ",".join(["23.10.2007 08:07", *CELLS[1:]]), "headers|ISO 8601"),
        (",".join(HEADERS) + "\n" + ",".join([*CELLS, "7", "8"]), "row 2.*expected 6 cells"),
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


def test_the_first_line_of_data_is_known() -> None:
    assert find_form(",".join(HEADERS) + "\n" + ",".join(CELLS) + "\n", {}).first == 2
