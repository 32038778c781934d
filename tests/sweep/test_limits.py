"""Limits of a sweep file: quantities of the column, and those that are refused."""

from pathlib import Path

import pytest
from pydantic import ValidationError

from fctd.case.errors import InputError
from fctd.sweep.limits import LimitSpec
from fctd.sweep.spec import read_sweep
from validation.parts.small_sweep import PARAMETERS, WORK, sweep_file


@pytest.mark.parametrize(
    ("column", "above", "bound", "event"),
    [
        ("hookload_N", "120 kN", 120e3, "hookload_N above 120 kN"),
        ("hookload_N", 1.2e5, 120e3, "hookload_N above 120000"),
        ("drive_torque_N_m", "10 kft*lbf", 13558.179483314, "drive_torque_N_m above 10 kft*lbf"),
        ("max_von_mises_Pa", "400 MPa", 400e6, "max_von_mises_Pa above 400 MPa"),
        ("buckled_to_md_m", "1000 ft", 304.8, "buckled_to_md_m above 1000 ft"),
        ("hookload_period_s", "2 min", 120, "hookload_period_s above 2 min"),
        ("stick_slip_severity", 1, 1, "stick_slip_severity above 1"),
    ],
)
def test_a_limit_is_a_quantity_of_its_column(column: str, above: str | float, bound: float, event: str) -> None:
    limit = LimitSpec(column=column, above=above)
    assert limit.bound == pytest.approx(bound, rel=1e-12)
    assert (limit.side, limit.event) == ("above", event)


def test_a_limit_may_be_below() -> None:
    limit = LimitSpec(column="hookload_N", below="-2 kN")
    assert (limit.side, limit.bound, limit.event) == ("below", -2000, "hookload_N below -2 kN")


@pytest.mark.parametrize(
    ("column", "above", "words"),
    [
        ("hookload_N", '"120 kN*m"', ["limits[0].above", "120 kN*m", "a force such as '50 kN'"]),
        ("drive_torque_N_m", '"3 kN"', ["limits[0].above", "3 kN", "a torque such as"]),
        ("hookload_N", '"much"', ["limits[0].above", "much", "a force"]),
        ("hookload_N", "true", ["limits[0].above", "true", "a number"]),
        ("stick_slip_severity", '"1 kN"', ["limits[0].above", "1 kN", "a bare number"]),
        ("hookload_N", "nan", ["limits[0].above", "nan", "a force"]),
    ],
)
def test_a_limit_that_the_column_cannot_have_is_refused(
    column: str, above: str, words: list[str], tmp_path: Path
) -> None:
    limits = f'[[uncertainty.limits]]\ncolumn = "{column}"\nabove = {above}\n'
    path = sweep_file(tmp_path, body=PARAMETERS + WORK + limits)
    with pytest.raises(InputError) as caught:
        read_sweep(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: uncertainty.")
    assert "\n" not in text
    for word in words:
        assert word in text


def test_a_limit_has_one_side() -> None:
    with pytest.raises(ValidationError, match="above or below, one of them"):
        LimitSpec(column="hookload_N", above=1, below=2)
