"""Checks of rows with several balances: by the median of draws, on tables with known verdicts."""

import numpy as np
import pandas as pd

from validation.parts.resolved_rows import locked_checks


def drawn(lock_up: list[float], loads_beyond: float = np.nan) -> pd.DataFrame:
    """Draws of a row that slides, with its lock-up friction [% off], and of one beyond its lock-up length."""
    inside = pd.DataFrame({"share_of_lock_up_percent": 75.0, "off_percent": 1.0, "locked_up_off_percent": lock_up})
    beyond = inside.assign(share_of_lock_up_percent=110.0, off_percent=np.nan, push_kN=loads_beyond)
    locked = pd.concat([inside.assign(push_kN=900.0), beyond])
    return locked.assign(locked_up_at=1 + locked["locked_up_off_percent"])


def verdicts(locked: pd.DataFrame) -> list[str]:
    """Of push, lock-up friction, draws found, loads beyond."""
    return [check.verdict for check in locked_checks(locked)]


def test_the_path_of_a_minority_of_draws_decides_nothing() -> None:
    assert verdicts(drawn([-1.0, -7.0, -1.4, 0.5, -6.0])) == ["met"] * 4
    assert verdicts(drawn([-1.0, -7.0, -1.4, -6.5, -6.0])) == ["met", "missed", "met", "met"]


def test_draws_without_an_answer_are_counted() -> None:
    assert verdicts(drawn([-1.0] * 3 + [np.nan])) == ["met"] * 4
    assert verdicts(drawn([-1.0] * 2 + [np.nan])) == ["met", "met", "missed", "met"]
    assert verdicts(drawn([np.nan] * 3)) == ["met", "missed", "missed", "met"]


def test_a_row_beyond_its_lock_up_length_has_no_loads() -> None:
    assert verdicts(drawn([-1.0], loads_beyond=950.0)) == ["met", "met", "met", "missed"]
