"""Headers of series: names, units, and what is refused."""

import pytest

from fctd.case.errors import InputError
from fctd.monitoring.quantities import QUANTITIES, check_columns, count_quantities, find_columns, parse_columns

REAL = [
    "date", "Hole Depth (MD) m", "Bit Depth (MD) m", "Block Position m", "Mud Flow In L/min", "Average Hookload kkgf",
    "Average Surface Torque kN.m", "Average Rotary Speed rpm", "Weight on Bit kkgf", "Rate of Penetration m/h",
]  # fmt: skip


def test_the_headers_of_a_real_file() -> None:
    found = find_columns(REAL)
    assert {key: column.place for key, column in found.items()} == {
        "time": 0, "hole_depth": 1, "bit_depth": 2, "block_position": 3, "flow": 4, "hook_load": 5, "torque": 6,
        "rpm": 7, "weight_on_bit": 8,
    }  # fmt: skip
    assert found["hook_load"].factor(QUANTITIES["hook_load"]) == pytest.approx(9806.65)  # 1,000 kgf, exact


@pytest.mark.parametrize(
    ("header", "key", "unit"),
    [
        ("HKLA (klbf)", "hook_load", "klbf"),
        ("hook_load_kN", "hook_load", "kN"),
        ("Torque [ft-lbf]", "torque", "ft-lbf"),
        ("drive_torque_N_m", "torque", "N*m"),
        ("DMEA.M", "hole_depth", "M"),
        ("RPM", "rpm", None),
        ("BPOS", "block_position", None),
    ],
)
def test_names_and_units(header: str, key: str, unit: str | None) -> None:
    (found,) = find_columns([header]).items()
    assert (found[0], found[1].unit) == (key, unit)


@pytest.mark.parametrize("header", ["Total Gas", "torque_m", "depth", "hook", ""])
def test_other_headers_are_passed_over(header: str) -> None:
    assert count_quantities([header], {}) == 0


def test_a_header_that_is_told_goes_before_the_names() -> None:
    said = parse_columns(["torque=TQX [kft.lbf]", "hook_load=W"])
    found = find_columns(["torque_N_m", "TQX", "W"], ["", "", "kN"], said)
    assert (found["torque"].place, found["torque"].unit) == (1, "kft.lbf")
    assert found["hook_load"].unit == "kN"


@pytest.mark.parametrize("text", ["torque", "torque=", "twist=TQ"])
def test_a_wrong_option_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--columns"):
        parse_columns([text])


@pytest.mark.parametrize(
    ("headers", "expected"),
    [
        (["time_s", "bit_depth_m", "rpm"], "hook_load, torque, block_position"),
        (["time_s", "bit_depth_m", "hook_load", "torque_N_m", "rpm", "bpos_m"], "hook_load.*with its unit"),
        (["bit_depth_m", "operation"], "hook_load, torque"),
    ],
)
def test_what_lacks_is_named(headers: list[str], expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        check_columns(find_columns(headers), headers, text_time=False)


def test_two_columns_of_a_quantity_are_refused() -> None:
    with pytest.raises(InputError, match="one column of torque"):
        find_columns(["torque_N_m", "TQA"])
