"""What the strings of a table do, and what its rows differ in."""

import pytest

import fctd
from fctd.case.load import Case
from fctd.model.operations import rates_of_all
from fctd.results.doing import does, facts_of, told_of, unlike
from tests.cases import make_case, rotation, trip

DRILLED = {"kind": "drill_rotating", "from_md": 150, "to_md": 160, "speed": 0.01, "rpm": 120, "flow": "2400 L/min"}
KINDS = ["trip_out", "rotate_off_bottom", "drill_rotating", "drill_sliding"]


def pumped(*operations: dict[str, object]) -> Case:
    return make_case(
        operations=[*operations, DRILLED], mud={"density": 1200.0, "viscosity": 0.03}, rig={"block_weight": 3e4},
        bit={"weight_on_bit": 8e4, "torque": 4e3, "overpull": 1e4},
    )  # fmt: skip


def test_the_line_above_a_table_says_what_each_operation_does() -> None:
    """36 m/h are 118 ft/h, 2400 L/min 634 gpm (NIST SP 811)."""
    case = pumped()
    rates = rates_of_all(case, KINDS)
    line, note = told_of(case, rates, "si")
    assert line == (
        "mud 1200 kg/m³; weight on bit 80 kN; bit torque 4 kN·m; overpull of a stuck bit 10 kN; block 30 kN; "
        "picking up 0.3 m/s; rotating off bottom 60 rev/min and 2400 L/min; drilling, rotating 36 m/h, 120 rev/min and "
        "2400 L/min; drilling, sliding 10.8 m/h and 2400 L/min"
    )
    assert facts_of(case, rates, "field")[-2] == "drilling, rotating 118 ft/h, 120 rev/min and 634 gpm"
    assert note == (
        "note: rows differ in flow, which lifts the string: pumps stand in picking up; 2400 L/min in rotating off "
        "bottom, drilling, rotating and drilling, sliding"
    )


def test_rows_that_differ_in_what_they_need_have_no_note() -> None:
    case = pumped()
    assert unlike(case, rates_of_all(case, KINDS[1:]), "si") == []
    assert unlike(case, rates_of_all(case, KINDS, flow=0.03), "si") == []
    air = make_case(operations=[DRILLED])
    assert unlike(air, rates_of_all(air, KINDS), "si") == []


def test_a_trip_that_turns_and_a_flow_that_is_lent_are_said() -> None:
    case = pumped(trip(100, 150, 0.4) | {"rpm": 20}, rotation(150, 10, 90) | {"flow": "1800 L/min"})
    lines = unlike(case, rates_of_all(case, ["trip_in", "rotate_off_bottom", "drill_sliding"]), "si")
    assert lines[1:] == [
        "note: slacking off turns at 20 rev/min, as in the case's operations",
        "note: the case's operations have 2 flows; the largest, 2400 L/min, is that of drilling, sliding",
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_a_row_of_a_chart_has_the_rates_of_its_string(kind: str) -> None:
    case = pumped()
    (row,) = fctd.torque_drag(case, kind, 900.0).to_dict("records")
    point = fctd.equilibrium(case, kind, 900.0)
    assert row["hookload_N"] == point.hookload
    columns = does(case, kind, point.rates)
    assert {name: row[name] for name in columns} == columns
    assert list(columns.values()) == pytest.approx({
        "trip_out": [0.3, 0.0, 0.0, -1e4], "rotate_off_bottom": [0.0, 60.0, 0.04, 0.0],
        "drill_rotating": [0.01, 120.0, 0.04, 8e4], "drill_sliding": [0.003, 0.0, 0.04, 8e4],
    }[kind])  # fmt: skip
