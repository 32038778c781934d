"""Tables of a report: cells, facts, and columns of results."""

import math

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case import message
from fctd.case.message import Message
from fctd.case.systems import LENGTH
from fctd.results.shown_tables import NONE, Cell, Table, facts, frame_table, number, quantity, short, text


@given(st.floats(-1e9, 1e9), st.integers(0, 6))
def test_a_number_is_the_one_of_its_text(value: float, digits: int) -> None:
    cell = number(value, digits)
    assert cell.number == value
    assert float(cell.text) == pytest.approx(value, abs=0.5001 * 10**-digits)
    assert not cell.text.startswith("-0") or float(cell.text) != 0


@pytest.mark.parametrize(("value", "shown"), [(0.25, "0.25"), (1.0, "1"), (12345.6, "12346"), (math.nan, NONE)])
def test_a_short_number_has_the_digits_that_count(value: float, shown: str) -> None:
    assert short(value).text == shown


def test_what_is_not_finite_is_a_dash() -> None:
    assert number(math.inf, 1) == number(math.nan, 1) == Cell(NONE)


def test_texts_keep_one_line_and_facts_their_numbers() -> None:
    assert text("a\n\x1b") == Cell("a\\n\\x1b")
    table = facts("t", [("depth", quantity(LENGTH, 3000, "si"), "m"), ("fluids", text("by depth"), "")])
    assert [row[1] for row in table.rows] == [Cell("3000.0", 3000.0), Cell("by depth")]
    assert table.numeric == (False, False, False)


def test_columns_have_units_digits_and_words() -> None:
    """A user's name is not a word of the program; a column without a value is left out."""
    frame = pd.DataFrame({
        "operation": ["trip_out", "trip_in"], "hookload_N": [1500.0, math.nan], "md_m": [30.48, 60.96],
        "part": ["a_b", "none"], "limit": ["make_up", "none"], "status": ["none", "none"],
        "torque_N_m": [math.nan, math.nan],
    })  # fmt: skip
    frame["reason"] = pd.Series([Message(f"at {message.quantity(30.48, 'm')}"), "none"], dtype=object)
    table = frame_table("t", frame, list(frame), "field", {"md_m": "at", "part": "component"})
    assert tuple(map(str, table.heads)) == ("operation", "hook load (klbf)", "at (ft)", "component", "limit", "reason")
    rows = [[cell.text for cell in row] for row in table.rows]
    assert rows == [
        ["picking up", "0.3", "100.0", "a_b", "make up", "at 100 ft"],
        ["slacking off", NONE, "200.0", NONE, NONE, NONE],
    ]  # fmt: skip
    assert table.numeric == (False, True, True, False, False, False)
    assert table.rows[0][1].number == pytest.approx(1500 / 4448.2216152605)


def test_a_table_without_rows_has_no_numbers() -> None:
    assert Table("", ("a", "b"), ()).numeric == (False, False)
