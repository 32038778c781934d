"""Rows that cannot be used are left out and counted; cells that are no numbers are refused."""

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.monitoring.rows import Cleaner
from fctd.monitoring.text_series import read_text

HEAD = "time_s,bit_depth_m,hook_load_kN,torque_kN_m,rpm,block_position_m\n"


def rows(*lines: str) -> pd.DataFrame:
    return read_text(HEAD + "\n".join(lines), {})


def test_units_are_converted_and_nulls_are_nan() -> None:
    table = rows("0,100,500,-999.25,60,3", "5,101,NaN,2,,3")
    assert table["weight_indicator_N"].iloc[0] == 500e3
    assert np.isnan(table[["drive_torque_N_m", "weight_indicator_N", "rpm"]].to_numpy()).sum() == 3
    assert list(table.index) == [2, 3]


def test_rows_are_left_out_and_counted() -> None:
    cleaner = Cleaner()
    good = [f"{10 * k},100,500,2,60,3" for k in range(30)]
    table = rows(*good[:9], good[8], "5,100,500,2,60,3", *good[9:], "400,,500,2,60,3")
    kept = pd.concat([cleaner.take(table.iloc[:10]), cleaner.take(table.iloc[10:])])
    assert len(kept) == 30
    assert cleaner.told() == [
        "1 of 33 rows left out: no bit depth",
        "1 of 33 rows left out: repeated time",
        "1 of 33 rows left out: time before that of an earlier row",
    ]


def test_a_shuffled_series_is_refused() -> None:
    times = np.random.default_rng(0).permutation(100)
    with pytest.raises(InputError, match=r"row \d+, time = .*expected rows in the order of time"):
        Cleaner().take(rows(*(f"{time},100,500,2,60,3" for time in times)))


def test_a_cell_that_is_no_number_is_named() -> None:
    with pytest.raises(InputError, match='row 3, torque_kN_m = "abc": expected a number'):
        rows("0,100,500,2,60,3", "5,100,500,abc,60,3")


def test_an_unknown_operation_is_named() -> None:
    table = read_text("bit_depth_m,operation,hook_load_kN,torque_kN_m\n100,trip_inn,500,2", {})
    with pytest.raises(InputError, match=r"row 2, operation.*trip_in"):
        Cleaner().take(table)
