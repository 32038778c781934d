"""Headers of series: names, units, and what is refused."""

import re
import shlex

import pytest

from fctd.case.errors import InputError
from fctd.case.tables.fields import Column
from fctd.case.tables.headers import Choice, Choices, find_columns, parse_choices, with_units
from fctd.case.tables.text import find_layout
from fctd.monitoring.quantities import SERIES

REAL = [
    "date", "Hole Depth (MD) m", "Bit Depth (MD) m", "Block Position m", "Mud Flow In L/min", "Average Hookload kkgf",
    "Average Surface Torque kN.m", "Average Rotary Speed rpm", "Weight on Bit kkgf", "Rate of Penetration m/h",
]  # fmt: skip
OVER_TIME = ["time_s", "bit_depth_m", "hook_load_kN", "torque_N_m", "rpm", "bpos_m"]


def columns(headers: list[str], units: list[str] | None = None, choices: Choices | None = None) -> dict[str, Column]:
    found = find_columns((0, headers), SERIES, choices or {})
    return with_units(found, [(0, units or [])], (), SERIES, choices or {})


def test_the_headers_of_a_real_file() -> None:
    found = columns(REAL)
    assert {key: column.place for key, column in found.items()} == {
        "date": 0, "hole_depth": 1, "bit_depth": 2, "block_position": 3, "flow": 4, "hook_load": 5, "torque": 6,
        "rpm": 7, "weight_on_bit": 8,
    }  # fmt: skip
    assert found["hook_load"].factor == pytest.approx(9806.65)  # 1,000 kgf, exact


@pytest.mark.parametrize(
    ("header", "expected"),
    [
        ("HKLA (klbf)", [("hook_load", "klbf")]),
        ("hook_load_kN", [("hook_load", "kN")]),
        ("Torque [ft-lbf]", [("torque", "ft-lbf")]),
        ("drive_torque_N_m", [("torque", "N*m")]),
        ("DMEA.M", [("hole_depth", "M")]),
        ("RPM", [("rpm", None)]),
        ("BPOS", [("block_position", None)]),
        *((other, []) for other in ("Total Gas", "Torque Limit kN.m", "depth", "hook", "")),
    ],
)
def test_names_and_units(header: str, expected: list[tuple[str, str | None]]) -> None:
    found = [column for field in SERIES.fields if (column := field.read(header)) is not None]
    assert [(column.field.key, column.unit) for column in found] == expected


def test_a_header_that_is_told_goes_before_the_names() -> None:
    choices = parse_choices(["torque=TQX [kft.lbf]", "hook_load=W"], SERIES) | {"rpm": Choice("R", "rev/s")}
    headers = ["time_s", "bit_depth_m", "bpos_m", "torque_N_m", "TQX", "W", "R"]
    found = columns(headers, ["", "", "", "", "", "kN", ""], choices)
    assert (found["torque"].place, found["torque"].unit) == (4, "kft.lbf")
    assert found["hook_load"].unit == "kN"
    assert found["rpm"].factor == 60


@pytest.mark.parametrize("text", ["torque", "torque=", "twist=TQ", "torque.unit=m", "operation.unit=m"])
def test_a_wrong_option_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--columns"):
        parse_choices([text], SERIES)


@pytest.mark.parametrize(
    ("headers", "units", "key", "expected"),
    [
        (["time_s", "bit_depth_m", "rpm"], [], "column hook_load_kN", "its header by --columns 'hook_load=HEADER'"),
        ([*OVER_TIME[:2], "hook_load", *OVER_TIME[3:]], [], "headers", "a header with its unit.*by --columns"),
        ([*OVER_TIME[:3], "torque_m", *OVER_TIME[4:]], [], "headers", "a unit of N"),
        (OVER_TIME[1:], [], "column time_s or date_s", "or a column operation in place of time"),
        (["bit_depth_m", "operation"], [], "column hook_load_kN", "it among the headers"),
        ([*OVER_TIME, "TQA"], [], "headers, columns of torque", "one column.*choice by --columns 'torque=torque_N_m'"),
        (OVER_TIME, ["s", "ft", "", "", "", ""], "headers, bit_depth_m", "m, as the header says"),
    ],
)
def test_what_lacks_or_is_there_twice_is_named(headers: list[str], units: list[str], key: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected) as refused:
        columns(headers, units)
    assert refused.value.key == key


def test_an_export_without_units_is_answered_once() -> None:
    """The message has the line of options to paste, of all columns, with which the file is then read."""
    export = "RIGTIME,BDEP,BPOS,HKLA,TQA,RPMA,SPPA\n0,9000,40.1,181.3,9.02,60,2500\n"
    with pytest.raises(InputError, match="headers with their units") as refused:
        find_layout(export, SERIES, {})
    (line,) = re.findall("by (--columns .*) [(]on a metric rig m, kN, kN.m ", str(refused.value))
    found = find_layout(export, SERIES, parse_choices(shlex.split(line)[1::2], SERIES)).columns
    units = {key: column.unit for key, column in found.items() if key != "rpm"}
    assert units == {"time": "s", "bit_depth": "ft", "block_position": "ft", "hook_load": "klbf", "torque": "kft.lbf"}
