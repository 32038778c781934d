"""The rules of stretches, each with a series that keeps or breaks it."""

import numpy as np
import pandas as pd
import pytest

from fctd.monitoring.stretches import Finder, Rules, Stretch, by_depth, quartiles

DEPTH = 1000.0  # settling 5 s and three round trips of 0.64 s: 6.9 s


class Plain:
    """100 kN of block, a string of 400 kN, 0.5 m of stretch at reversal, 10 kN m of torque."""

    def slips_below(self, depth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.full(len(depth), 140e3), np.full(len(depth), 300e3)

    def reversal(self, depth: float) -> float:
        return 0.5

    def locked_share(self, depth: float, torque: float, rpm: float) -> float:
        return torque / 10e3


def rows(speed: float = 0.0, rpm: float = 60.0, count: int = 20, step: float = 4.0, **other: float) -> pd.DataFrame:
    time = step * np.arange(count)
    values = {"bit_depth_m": DEPTH - 5, "hole_depth_m": DEPTH, "weight_indicator_N": 500e3, "drive_torque_N_m": 100.0}
    table = pd.DataFrame({"time_s": time, **(values | other), "rpm": rpm, "block_position_m": 10 + speed * time})
    return table.set_axis(range(2, count + 2))


def found(table: pd.DataFrame) -> list[Stretch]:
    finder = Finder(Plain())
    return [*finder.feed(table), *finder.finish()]


@pytest.mark.parametrize(
    ("table", "mode"),
    [
        (rows(), "rotating"),
        (rows(0.1), "rotating_up"),
        (rows(-0.1), "rotating_down"),
        (rows(0.1, rpm=0.0), "pick_up"),
        (rows(-0.1, rpm=5.0), "slack_off"),
        (rows(rpm=0.0, weight_indicator_N=120e3), "in_slips"),
        # The wall carries most of an extended-reach string while it slacks off: its bit moves with the block.
        (
            rows(-0.1, rpm=0.0, weight_indicator_N=200e3).assign(bit_depth_m=DEPTH - 15 + 0.4 * np.arange(20)),
            "slack_off",
        ),
        (rows(rpm=60.0, weight_indicator_N=200e3), "rotating"),
        # The block fetches a stand, which hangs from it, and the bit stands still.
        (rows(0.1, rpm=0.0, weight_indicator_N=150e3), "in_slips"),
        (rows(-0.1, rpm=0.0, weight_indicator_N=250e3), "in_slips"),
    ],
)  # fmt: skip
def test_modes(table: pd.DataFrame, mode: str) -> None:
    (one,) = found(table)
    assert one.mode == mode
    # The first row has no speed before it, which the load of the block does not need.
    by_load = table["weight_indicator_N"].iloc[0] < 140e3
    assert (one.first_row, one.last_row) == (2 if by_load else 3, 21)
    assert one.left_out == ""


@pytest.mark.parametrize(
    "table",
    [
        rows(bit_depth_m=DEPTH - 0.9),  # not off bottom
        rows(rpm=0.0),  # neither turns nor moves
        rows(rpm=10.0),  # neither turning nor resting
        rows(0.015),  # neither standing nor moving
        rows(count=6),  # too short
        rows(step=31.0),  # gaps alone
    ],
    ids=["on bottom", "still", "slow turning", "creeping", "short", "gaps"],
)
def test_what_is_no_stretch(table: pd.DataFrame) -> None:
    assert [one for one in found(table) if one.mode != "in_slips"] == []


def test_settling_and_the_last_row_are_left_out() -> None:
    """6.9 s of settling after row 3, at 4 s, and the last row: rows at 12 to 72 s are left."""
    (one,) = found(rows())
    assert one.samples == 16


def test_one_stray_row_does_not_end_a_stretch_and_two_do() -> None:
    table = rows(count=40)
    table.loc[20, "rpm"] = 10.0
    assert len(found(table)) == 1
    table.loc[21, "rpm"] = 10.0
    assert len(found(table)) == 2


def test_a_gap_ends_a_stretch() -> None:
    table = rows(count=40)
    table.loc[20:, "time_s"] += 60
    assert [one.first_row for one in found(table)] == [3, 21]


def test_strokes_that_are_short_or_hold_torque_are_left_out() -> None:
    (short,) = found(rows(0.021, rpm=0.0, count=16))  # 1.2 m
    assert short.left_out == "stroke short of three times the stretch at reversal"
    (locked,) = found(rows(0.1, rpm=0.0, drive_torque_N_m=4e3))
    assert locked.left_out == "torque locked in"


def test_without_hole_depth_weight_on_bit_or_the_deepest_row_tell_the_bottom() -> None:
    table = rows(count=40).drop(columns="hole_depth_m")
    assert found(table) == []  # never deeper: this may be the bottom
    assert len(found(table.assign(weight_on_bit_N=0.0))) == 1
    assert found(table.assign(weight_on_bit_N=50e3)) == []
    table.loc[:4, "bit_depth_m"] = DEPTH
    assert len(found(table)) == 1


def test_pieces_give_what_the_whole_gives() -> None:
    table = pd.concat([rows(), rows(0.1, rpm=0.0), rows(-0.1), rows(weight_indicator_N=120e3)])
    table = table.assign(
        time_s=4.0 * np.arange(len(table)), block_position_m=np.cumsum(table["block_position_m"].diff().fillna(0))
    )
    finder, pieces = Finder(Plain(), Rules()), []
    for k in range(0, len(table), 7):
        pieces += list(finder.feed(table.iloc[k : k + 7]))
    pieces += list(finder.finish())
    whole = found(table)
    assert len(whole) == 4
    assert [(p.mode, p.first_row, p.samples, p.torque, p.hook_load) for p in pieces] == [
        (w.mode, w.first_row, w.samples, w.torque, w.hook_load) for w in whole
    ]


def test_quartiles_and_the_error_of_the_median() -> None:
    """Of 10,000 normal readings: ±0.6745 standard deviations; the error is 1.2533/√n."""
    found = quartiles(np.random.default_rng(0).standard_normal(10_000))
    assert [found.p25, found.median, found.p75] == pytest.approx([-0.6745, 0, 0.6745], abs=0.03)
    assert found.error == pytest.approx(0.012533, rel=0.03)


def test_rows_by_depth_are_readings_and_drilling_is_passed_over() -> None:
    table = pd.DataFrame(
        {"bit_depth_m": [100.0, 130.0], "operation": ["trip_out", "drill_rotating"], "weight_indicator_N": 5e5,
         "drive_torque_N_m": np.nan}
    )  # fmt: skip
    (one,) = by_depth(table)
    assert (one.mode, one.hook_load.median, one.hook_load.error) == ("pick_up", 5e5, 0.0)
