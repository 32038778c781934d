"""The schedule's phases by hand, and the depths they reach."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from fctd.case.units import FASTEST, MOST_RPM
from fctd.model.operations import (
    SHORTEST,
    depth_range,
    drive_torque,
    rates_of_all,
    schedule,
    steady_rates,
    string_load,
    weight_indicator,
)
from tests.cases import make_case, rotation, trip

TURN = 2 * np.pi  # 60 rev/min [rad/s]


@pytest.mark.parametrize(
    ("operations", "expected"),
    [
        # The last operation ends in motion; every other one comes to rest.
        ([trip(100, 102, 0.05, 4)], [(0, 4, 0, 0.05, 0, 0, 0), (4, 38, 0.05, 0.05, 0, 0, 0)]),
        (
            [trip(102, 100, 0.05, 4), rotation(100, 10, 60, 3)],
            [
                (0, 4, 0, -0.05, 0, 0, 0),
                (4, 36, -0.05, -0.05, 0, 0, 0),
                (40, 4, -0.05, 0, 0, 0, 0),
                (44, 3, 0, 0, 0, TURN, 1),
                (47, 7, 0, 0, TURN, TURN, 1),
            ],
        ),
        # A short trip has shorter ramps and no cruise, a short rotation is all ramp.
        ([trip(100, 100.1, 0.05, 10)], [(0, 4, 0, 0.05, 0, 0, 0)]),
        (
            [trip(100, 100.1, 0.05, 10), rotation(100.1, 2, 60, 5), {**trip(100.1, 100, 0.1, 1), "rpm": 30}],
            [
                (0, 2, 0, 0.05, 0, 0, 0),
                (2, 2, 0.05, 0, 0, 0, 0),
                (4, 2, 0, 0, 0, TURN, 1),
                (6, 1, 0, -0.1, TURN, 0.5 * TURN, 2),
                (7, 0.5, -0.1, -0.1, 0.5 * TURN, 0.5 * TURN, 2),
            ],
        ),
    ],
    ids=["one", "two", "short", "three"],
)
def test_phases_by_hand(operations: list[dict[str, Any]], expected: list[tuple[float, ...]]) -> None:
    """Start, duration, feed from and to, spin from and to, operation."""
    found = [(*motion[:6], k) for motion, k in schedule(make_case(operations=operations).operations)]
    np.testing.assert_allclose(found, expected, atol=1e-9)


def test_the_shortest_operation_has_a_phase() -> None:
    operations = make_case(operations=[rotation(100, SHORTEST)]).operations
    assert [phase.motion.duration for phase in schedule(operations)] == [SHORTEST]


def test_depths_of_a_schedule() -> None:
    operations = [trip(100, 110), trip(110, 70), rotation(70, 5), trip(70, 90)]
    assert depth_range(make_case(operations=operations)) == (100, 70, 110)


@pytest.mark.parametrize(
    ("kind", "power"),
    [
        ("trip_out", 1),
        ("back_ream", 1),
        ("rotate_off_bottom", 0),
        ("trip_in", -1),
        ("drill_rotating", -1),
        ("drill_sliding", -1),
    ],
)
def test_the_dead_line_reads_more_when_hoisting(kind: str, power: int) -> None:
    rig = make_case(rig={"block_weight": 2e5, "sheave_efficiency": 0.9, "guide_friction": 1e4}).rig
    indicator = weight_indicator(rig, KINDS[kind].direction, 5e5)
    assert indicator == pytest.approx((7e5 + power * 1e4) * 0.9**power)
    assert string_load(rig, KINDS[kind].direction, indicator) == pytest.approx(5e5)


def test_the_torque_reading_has_an_offset_and_a_part_that_grows_with_the_rotation() -> None:
    """1 kN m of the string, 0.3 kN m of offset, and 5 N m for each of 60 rev/min."""
    rig = make_case(rig={"torque_offset": 300.0, "torque_per_rpm": 5.0}).rig
    assert drive_torque(rig, TURN, 1e3) == pytest.approx(1600.0)
    assert drive_torque(rig, 0.0, 1e3) == 1300.0


def test_documented_kinds() -> None:
    assert {name: (kind.direction, kind.default_speed, kind.default_rpm) for name, kind in KINDS.items()} == {
        "trip_in": (1, 0.3, 0.0), "trip_out": (-1, 0.3, 0.0), "rotate_off_bottom": (0, 0.0, 60.0),
        "back_ream": (-1, 0.1, 60.0), "ream_in": (1, 0.1, 60.0), "drill_rotating": (1, 0.003, 120.0),
        "drill_sliding": (1, 0.003, 0.0),
    }  # fmt: skip
    turning = {"rotate_off_bottom", "back_ream", "ream_in", "drill_rotating"}
    assert {name for name, kind in KINDS.items() if kind.turns} == turning
    assert {name for name, kind in KINDS.items() if not kind.may_turn} == {"drill_sliding"}
    assert {name for name, kind in KINDS.items() if kind.on_bottom} == {"drill_rotating", "drill_sliding"}


def test_rates_of_a_kind_are_its_own() -> None:
    """A kind that moves has a speed, a kind that rotates has an rpm, and each kind accepts its defaults."""
    for name, kind in KINDS.items():
        assert (kind.default_speed > 0) == (kind.direction != 0)
        assert (kind.default_rpm > 0) <= kind.may_turn
        found = steady_rates(make_case(), name)
        assert found == (kind.direction * kind.default_speed, pytest.approx(kind.default_rpm * np.pi / 30), 0.0)


def test_given_rates_apply_to_the_kinds_that_have_them() -> None:
    """A rotation to those that rotate by their name: a trip beside them slides."""
    kinds = ["trip_in", "trip_out", "rotate_off_bottom", "back_ream", "ream_in", "drill_sliding"]
    rates = rates_of_all(make_case(), kinds, speed=0.7, rpm=30)
    found = {kind: (rate.speed, rate.spin) for kind, rate in rates.items()}
    half = pytest.approx(0.5 * TURN)
    assert found == {
        "trip_in": (0.7, 0.0), "trip_out": (-0.7, 0.0), "rotate_off_bottom": (0.0, half), "back_ream": (-0.7, half),
        "ream_in": (0.7, half), "drill_sliding": (0.7, 0.0),
    }  # fmt: skip


@pytest.mark.parametrize(
    ("kinds", "given", "expected"),
    [
        (["drill_sliding"], {"rpm": 30}, "rpm = 30: expected rev/min of 0 for drill_sliding"),
        (["trip_in"], {"rpm": 30}, "rpm = 30: expected rev/min of 0 for trip_in: ream_in turns as it moves that way"),
        (["trip_out", "trip_in"], {"rpm": 30}, "for trip_out: back_ream turns as it moves that way"),
        (["rotate_off_bottom"], {"speed": 0.7}, r"speed = 0\.7: expected a speed of 0 for rotate_off_bottom"),
    ],
)
def test_a_rate_that_applies_to_no_kind_is_refused(kinds: list[str], given: dict[str, Any], expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        rates_of_all(make_case(), kinds, **given)


TRIP, TURNED, DRILLED = trip(100, 150, 0.4), rotation(150, 10, 90), {"kind": "drill_rotating", "from_md": 150,
    "to_md": 160, "speed": 0.01, "rpm": 120}  # fmt: skip
ALL = ("trip_in", "trip_out", "rotate_off_bottom", "back_ream", "ream_in", "drill_rotating", "drill_sliding")


@pytest.mark.parametrize(
    ("operations", "given", "flows"),
    [
        ([DRILLED | {"flow": 0.04}], None, (0.0, 0.0, 0.04, 0.04, 0.04, 0.04, 0.04)),
        # The kind's own operation decides, also one without flow; the largest serves the others.
        ([TURNED | {"flow": 0.03}, DRILLED | {"flow": 0.04}], None, (0.0, 0.0, 0.03, 0.04, 0.04, 0.04, 0.04)),
        ([TURNED, DRILLED | {"flow": 0.04}], None, (0.0, 0.0, 0.0, 0.04, 0.04, 0.04, 0.04)),
        ([TRIP | {"flow": 0.02}, DRILLED], None, (0.02, 0.0, 0.02, 0.02, 0.02, 0.0, 0.02)),
        # A flow that is asked for is that of all, as none is.
        ([DRILLED | {"flow": 0.04}], 0.03, (0.03,) * 7),
        ([DRILLED | {"flow": 0.04}], 0.0, (0.0,) * 7),
        ([DRILLED], None, (0.0,) * 7),
    ],
)
def test_the_flow_of_a_case_serves_all_that_drill_rotate_or_ream(
    operations: list[dict[str, Any]], given: float | None, flows: tuple[float, ...]
) -> None:
    case = make_case(operations=operations)
    rates = rates_of_all(case, ALL, flow=given)
    assert tuple(rates[kind].flow for kind in ALL) == flows
    assert all(rates_of_all(case, [kind], flow=given) == {kind: rates[kind]} for kind in ALL)


OWN_RATES = [
    trip(100, 150, 0.4) | {"rpm": 20}, rotation(150, 10, 90), trip(150, 180, 0.7),
    {"kind": "drill_sliding", "from_md": 180, "to_md": 190, "speed": 0.01},
    {"kind": "back_ream", "from_md": 190, "to_md": 180, "speed": 0.25, "rpm": 30},
]  # fmt: skip


@pytest.mark.parametrize(
    ("operations", "kind", "given", "expected"),
    [
        (OWN_RATES, "trip_in", {}, (0.4, TURN / 3)),
        (OWN_RATES, "rotate_off_bottom", {}, (0.0, 1.5 * TURN)),
        (OWN_RATES, "drill_sliding", {}, (0.01, 0.0)),
        (OWN_RATES, "back_ream", {}, (-0.25, TURN / 2)),
        (OWN_RATES, "trip_out", {}, (-0.3, 0.0)),
        (OWN_RATES, "trip_in", {"speed": 0.2}, (0.2, TURN / 3)),
        (OWN_RATES, "back_ream", {"speed": 0.5}, (-0.5, TURN / 2)),
        (OWN_RATES, "trip_in", {"rpm": 60}, (0.4, TURN)),
        (OWN_RATES, "drill_rotating", {"rpm": 60}, (0.003, TURN)),
        (OWN_RATES, "trip_in", {"speed": "12 m/min", "rpm": "1 rev/s"}, (pytest.approx(0.2), TURN)),
        # As the README has them.
        ([], "trip_in", {}, (0.3, 0.0)),
        ([], "drill_rotating", {}, (0.003, 2 * TURN)),
        ([], "drill_sliding", {}, (0.003, 0.0)),
        ([], "rotate_off_bottom", {}, (0.0, TURN)),
    ],
)
def test_rates_are_the_callers_then_the_cases_then_the_defaults(
    operations: list[dict[str, Any]], kind: str, given: dict[str, Any], expected: tuple[float, float]
) -> None:
    """The first operation of the kind has those of the case."""
    speed, spin = expected
    assert steady_rates(make_case(operations=operations), kind, **given) == (speed, pytest.approx(spin), 0.0)


@pytest.mark.parametrize(
    ("kind", "rates", "message"),
    [
        ("trip_up", {}, 'operation = "trip_up": expected the kind trip_(in|out)'),
        ("trip_in", {"speed": "1 kg"}, 'speed = "1 kg": expected a speed such as .*'),
        ("trip_in", {"rpm": "60 kg"}, 'rpm = "60 kg": expected a rotation such as .*'),
    ],
)
def test_what_is_no_kind_or_no_rate(kind: str, rates: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=f"{message}$"):
        steady_rates(make_case(), kind, **rates)


def test_the_fastest_rates() -> None:
    assert steady_rates(make_case(), "trip_in", speed=FASTEST, rpm=MOST_RPM).speed == FASTEST
    with pytest.raises(InputError, match=f"above 0 and at most {FASTEST:g} m/s for trip_in"):
        steady_rates(make_case(), "trip_in", speed=1.001 * FASTEST)
    with pytest.raises(InputError, match=f"at least 0 and at most {MOST_RPM:g} for trip_in"):
        steady_rates(make_case(), "trip_in", rpm=1.001 * MOST_RPM)


def test_rates_near_nothing() -> None:
    case = make_case()
    for kind in ("rotate_off_bottom", "back_ream", "drill_rotating", "trip_in"):
        assert steady_rates(case, kind, rpm=0.5).spin == pytest.approx(0.5 * np.pi / 30)
    assert steady_rates(case, "trip_out", speed=1e-4, rpm=0.0) == (-1e-4, 0.0, 0.0)
    assert steady_rates(case, "rotate_off_bottom", speed=0.0).speed == 0.0
    assert steady_rates(case, "drill_sliding", rpm=0.0).spin == 0.0


@pytest.mark.parametrize(
    ("kind", "rates", "expected"),
    [
        ("rotate_off_bottom", {"rpm": 0.0}, "rev/min above 0 and at most 10000"),
        ("back_ream", {"rpm": 0.0}, "rev/min above 0 and at most 10000"),
        ("trip_in", {"rpm": -0.5}, "rev/min at least 0"),
        ("drill_sliding", {"rpm": 0.5}, "rev/min of 0"),
        ("trip_in", {"speed": 0.0}, "a speed above 0"),
        ("rotate_off_bottom", {"speed": 0.5}, "a speed of 0"),
        ("trip_in", {"speed": np.inf}, "a speed above 0"),
        ("trip_in", {"rpm": np.nan}, "rev/min at least 0"),
    ],
)
def test_rates_that_are_not_of_their_kind(kind: str, rates: dict[str, float], expected: str) -> None:
    with pytest.raises(InputError, match=f"{next(iter(rates))} = .*: expected {expected}.* for {kind}"):
        steady_rates(make_case(), kind, **rates)


def test_the_bit_is_loaded_while_a_string_drills() -> None:
    """The share of its loads rises with the first part of drilling, stays between two such operations, and falls."""
    drill = {"kind": "drill_rotating", "speed": 0.01, "rpm": 100, "ramp_time": 2}
    operations = [
        rotation(100, 10, 60, 3),
        {**drill, "from_md": 100, "to_md": 101},
        {**drill, "to_md": 102},
        trip(102, 100, 0.1, 2),
    ]
    phases = schedule(make_case(operations=operations).operations)
    found = [(motion.bit_from, motion.bit_to, operation) for motion, operation in phases]
    ramps = [(0, 1), (1, 1), (1, 1), (1, 1), (1, 1), (1, 0)]
    assert found[2:8] == [(*shares, k) for shares, k in zip(ramps, [1, 1, 1, 2, 2, 2], strict=True)]
    assert {shares[:2] for shares in found[:2] + found[8:]} == {(0, 0)}
