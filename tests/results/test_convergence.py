"""A range of counts in words: orders with their intervals, counts that suffice, the default layout."""

import math

import pandas as pd

from fctd.results.convergence import counts_in_words, order_in_words, orders_table


def orders(torque_segments: float = 40.0) -> pd.DataFrame:
    """A row of each layout; the uniform torque shows no order."""
    rows = []
    for layout, order in (("uniform", math.nan), ("graded", 1.5)):
        row: dict[str, object] = {"layout": layout, "operation": "trip_out"}
        for load, unit, value in (("hookload", "N", 8e5), ("torque", "N_m", 2000.0)):
            row |= {f"{load}_order": order, f"{load}_order_low": 1.1, f"{load}_order_high": 2.0}
            row |= {f"{load}_limit_{unit}": value, f"{load}_limit_low_{unit}": 0.9 * value}
            row |= {f"{load}_limit_high_{unit}": 1.02 * value, f"{load}_segments": 20.0}
        rows.append(row | {"torque_segments": torque_segments})
    return pd.DataFrame(rows)


def steps(error: float) -> pd.DataFrame:
    row = {"layout": "default", "segments": 99, "hookload_error": 1e-4, "torque_error": error}
    return pd.DataFrame([row])


def test_an_order_has_its_interval() -> None:
    uniform, graded = orders().to_dict("records")
    assert order_in_words(uniform, "torque") == "none"
    assert order_in_words(graded, "torque") == "1.50 (1.10–2.00)"


def test_the_table_has_the_farther_end_of_an_interval_and_the_count() -> None:
    table = orders_table(orders(math.nan), 0.01, "si")
    assert [[cell.text for cell in row] for row in table.rows] == [
        ["uniform", "hook load, kN", "none", "800.00 ± 80.00", "20"],
        ["", "torque, kN·m", "none", "2.0000 ± 0.2000", "more"],
        ["graded", "hook load, kN", "1.50 (1.10–2.00)", "800.00 ± 80.00", "20"],
        ["", "torque, kN·m", "1.50 (1.10–2.00)", "2.0000 ± 0.2000", "more"],
    ]
    assert "klbf" in orders_table(orders(), 0.01, "field").rows[0][1].text


def test_the_words_name_the_count_that_all_loads_need() -> None:
    assert counts_in_words(steps(0.002), orders(), 0.01) == [
        "1 % takes 40 uniform segments or more.",
        "1 % takes 40 graded segments or more.",
        "The default layout has 99 segments, and an error of 0.2 %.",
    ]
    lines = counts_in_words(steps(math.nan), orders(math.nan), 0.01)
    assert lines[0] == "1 % takes more uniform segments than were tried."
