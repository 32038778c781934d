"""The description of a chart: curves, axes, marks, groups and names, from its table."""

import numpy as np
import pandas as pd
import pytest

from fctd.answers.steady import Chart as CaseChart
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.plots.describe import MOST_GROUPS, SAME, describe
from fctd.plots.description import Description
from fctd.plots.loads import ChartLook
from fctd.plots.palette import CASES, DASHES, LOOKS, SOLID
from tests.plots.made import BLOCK, FOOT, LBF, chart, locked_chart, well

CASE = well(rig={"block_weight": BLOCK})
THREE = ["trip_out", "rotate_off_bottom", "trip_in"]


def test_every_series_is_described_in_the_units_of_its_axes() -> None:
    table = chart(["trip_out", "trip_in"], [0.2, 0.3])
    for units, force, torque, depth, labels in (
        ("si", 1e3, 1e3, 1.0, ("hook load (string), kN", "surface torque, kN·m", "bit depth, m")),
        (
            "field", 1e3 * LBF, 1e3 * FOOT * LBF, FOOT,
            ("hook load (string), klbf", "surface torque, kft·lbf", "bit depth, ft"),
        ),
    ):  # fmt: skip
        found = describe(table, units)
        ((_, panels, _),) = found.groups
        assert (*(panel.label for panel in panels), found.depth.label) == labels
        for (_, rows), curve in zip(
            table.groupby(["operation", "friction"], sort=False), panels[0].curves, strict=True
        ):
            np.testing.assert_allclose(curve.value, rows["hookload_N"] / force, rtol=1e-9)
            np.testing.assert_allclose(curve.depth, rows["bit_depth_m"] / depth, rtol=1e-9)
        assert panels[1].curves[0].value == pytest.approx(0.0, abs=1e-9 / torque)
        assert found.depth.upper < found.depth.top == pytest.approx(1000 / depth)
        assert found.depth.lower > found.depth.bottom == pytest.approx(2000 / depth)


def test_the_load_is_what_the_rig_reads_where_the_case_says_what_the_block_weighs() -> None:
    table = chart(["trip_in"], [0.2])
    for case, look, column in (
        (CASE, ChartLook(), "weight_indicator_N"), (CASE, ChartLook("string"), "hookload_N"),
        (well(), ChartLook(), "hookload_N"), (None, ChartLook(), "hookload_N"),
        (well(), ChartLook("indicator"), "weight_indicator_N"),
    ):  # fmt: skip
        panel = describe(table, "si", case, look).groups[0].panels[0]
        assert panel.column == column
        np.testing.assert_allclose(panel.curves[0].value, table[column] / 1e3)


def test_equal_curves_are_drawn_once() -> None:
    """A rotating string's hook load does not feel the factors, a sliding one's torque is nil for all of them."""
    table = chart(THREE, [0.1, 0.2, 0.3])
    loads, torques = describe(table).groups[0].panels
    up, down = ([f"{name}, μ {factor}" for factor in (0.1, 0.2, 0.3)] for name in ("picking up", "slacking off"))
    assert [curve.name.full for curve in loads.curves] == [*up, "rotating off bottom", *down]
    turning = [f"rotating off bottom, μ {factor}" for factor in (0.1, 0.2, 0.3)]
    assert [curve.name.full for curve in torques.curves] == ["picking up", *turning, "slacking off"]
    assert [curve.dash for curve in loads.curves] == [*DASHES[:3], SOLID, *DASHES[:3]]
    assert {curve.name.factors for curve in loads.curves} == {"μ 0.1", "μ 0.2", "μ 0.3", "rotating"}
    span = 1e3 * (loads.limits.high - loads.limits.low)
    for shift, count in ((0.9, 1), (1.1, 2)):  # of what half a line hides
        table.loc[(table["operation"] == THREE[1]) & (table["friction"] == 0.2), "hookload_N"] = (
            250.0 * table["bit_depth_m"] + shift * SAME * span
        )
        found = [curve for curve in describe(table).groups[0].panels[0].curves if curve.operation == THREE[1]]
        assert len(found) == count
    assert [curve.name.full for curve in found] == ["rotating off bottom, μ 0.1 and 0.3", "rotating off bottom, μ 0.2"]
    # What is a doubtful answer for one factor alone is a curve of its own.
    table = chart(["rotate_off_bottom"], [0.1, 0.2])
    table.loc[table["friction"] == 0.2, "status"] = "under_resolved"
    assert len(describe(table).groups[0].panels[0].curves) == 2


def test_the_legend_says_what_colours_and_dashes_stand_for() -> None:
    keys = describe(chart(["trip_out", "trip_in"], [0.1, 0.2])).keys
    assert [(key.name, key.marker, key.dash) for key in keys] == [
        ("picking up", LOOKS["trip_out"][1], SOLID), ("slacking off", LOOKS["trip_in"][1], SOLID),
        ("μ 0.1", "", DASHES[0]), ("μ 0.2", "", DASHES[1]),
    ]  # fmt: skip
    assert [key.name for key in describe(chart(["trip_in"], [0.1, 0.2])).keys] == ["μ 0.1", "μ 0.2"]
    assert [key.name for key in describe(chart(["trip_in"], [0.1])).keys] == ["slacking off"]


def test_up_to_ten_curves_share_a_panel_and_groups_their_axes() -> None:
    factors = [round(0.1 * k, 1) for k in range(1, 11)]
    (lone,) = describe(chart(["trip_in"], factors)).groups
    assert (lone.name, len({curve.dash for curve in lone.panels[0].curves})) == ("", 10)
    groups = describe(chart(list(KINDS), [0.2, 0.3])).groups
    assert [group.name for group in groups] == ["friction factor 0.2", "friction factor 0.3"]
    assert len({group.panels[0].limits for group in groups}) == 1
    with pytest.raises(InputError, match=f"at most {MOST_GROUPS} groups"):
        describe(chart(list(KINDS), [round(0.1 + 0.01 * k, 2) for k in range(41)]))  # 5 for each kind


def test_shoes_and_named_intervals_are_marked_at_their_ends() -> None:
    table = chart(["trip_in"], [0.2])
    above, below = CASE.wellbore.intervals
    named = tuple(of.model_copy(update={"name": name}) for of, name in ((above, "9 5/8 casing"), (below, "hole")))
    case = CASE.model_copy(update={"wellbore": CASE.wellbore.model_copy(update={"intervals": named})})
    assert describe(table, "si", case).marks == (
        (1500.0, ("9 5/8 casing", "shoe 1500 m"), True), (2000.0, ("hole",), False),
    )  # fmt: skip
    # Above the shoe the chart shows the casing alone, below it the hole alone.
    shallow, deep = (
        describe(table[at], "si", case) for at in (table["bit_depth_m"] < 1300, table["bit_depth_m"] > 1600)
    )
    assert shallow.marks == ((1250.0, ("9 5/8 casing",), False),)
    assert deep.marks == ((2000.0, ("hole",), False),)
    assert [mark.lines for mark in describe(table, "field", CASE).marks] == [("shoe 4921 ft",)]


def test_strings_with_nothing_to_state_have_no_lane() -> None:
    found = describe(chart(["trip_out", "trip_in"], [0.2, 0.3], {"under_resolved": "trip_in"})).groups[0]
    (lane,) = found.lanes  # alike for both factors
    assert (lane.number, lane.operation, set(lane.status)) == (1, "trip_in", {"under_resolved", "converged"})
    assert [curve.lane for curve in found.panels[0].curves] == [0, 0, 1, 1]
    assert describe(chart(THREE, [0.2, 0.3])).groups[0].lanes == ()


def test_measured_points_are_those_of_the_operations_and_columns_that_have_any() -> None:
    loads = {
        "hookload_N": [3e5, np.nan, 2e5],
        "hookload_low_N": [2e5, 3e5, np.nan],
        "hookload_high_N": [5e5, 4e5, np.nan],
    }
    torques = {f"surface_torque{end}_N_m": [np.nan] * 3 for end in ("", "_low", "_high")}
    places = {"operation": ["trip_in", "trip_in", "back_ream"], "bit_depth_m": [1500.0, 2200.0, 900.0]}
    found = describe(
        chart(["trip_out", "trip_in"], [0.2]), look=ChartLook(measured=pd.DataFrame(places | loads | torques))
    )
    left, right = found.groups[0].panels
    (points,) = left.points
    assert (points.name, right.points) == ("measured, slacking off", ())
    assert (points.middle.tolist(), points.depth.tolist()) == ([300.0, 350.0], [1500.0, 2200.0])
    assert [bars.tolist() for bars in points.bars] == [[100.0, 50.0], [200.0, 50.0]]
    assert left.limits.high > 500
    assert (found.depth.top, found.depth.bottom) == (900.0, 2200.0)


def test_pushes_are_hatched_where_a_string_locks_up() -> None:
    left, right = describe(locked_chart(), "si", CASE, ChartLook("string")).groups[0].panels
    assert (left.spent, right.spent) == (-30.0, None)
    assert describe(locked_chart(), "si", CASE).groups[0].panels[0].spent == 0.0
    assert describe(chart(["trip_in"], [0.2]), "si", CASE).groups[0].panels[0].spent is None


def compared(frictions: dict[str, list[float]], kinds: list[str], **wells: Case) -> Description:
    """The description of the charts of cases; frictions : of each."""
    tables = [chart(kinds, of).assign(case=name) for name, of in frictions.items()]
    charts = {
        name: CaseChart(wells.get(name, well()), table, (), (), {})
        for name, table in zip(frictions, tables, strict=True)
    }
    return describe(pd.concat(tables, ignore_index=True), "si", charts, ChartLook("string"))


def test_a_case_has_a_colour_and_an_operation_its_marker() -> None:
    found = compared({"A": [0.2], "B": [0.3]}, ["trip_out", "trip_in"])
    curves = found.groups[0].panels[0].curves
    assert [(curve.key, curve.look) for curve in curves] == [
        ("A", (CASES[0], "^")), ("A", (CASES[0], "v")), ("B", (CASES[1], "^")), ("B", (CASES[1], "v")),
    ]  # fmt: skip
    assert curves[0].width > curves[2].width
    # Each case has its own factors, which are not those of a fan.
    assert {curve.dash for curve in curves} == {SOLID}
    assert [curve.name.full for curve in curves[:2]] == ["A, picking up", "A, slacking off"]
    assert [key.name for key in found.keys] == ["A", "B", "picking up", "slacking off"]


def test_equal_curves_of_two_cases_are_both_drawn() -> None:
    found = compared({"A": [0.2, 0.3], "B": [0.2, 0.3]}, ["rotate_off_bottom"])
    loads, torques = (panel.curves for panel in found.groups[0].panels)
    assert [curve.name.full for curve in loads] == ["A", "B"]
    assert [curve.name.full for curve in torques] == ["A, μ 0.2", "A, μ 0.3", "B, μ 0.2", "B, μ 0.3"]
    assert [key.name for key in found.keys] == ["A", "B", "μ 0.2", "μ 0.3"]


@pytest.mark.parametrize(
    ("cases", "kinds", "frictions", "groups"),
    [
        (6, 3, 1, ["slacking off", "picking up", "rotating off bottom"]),
        (6, 1, 2, ["friction factor 0.1", "friction factor 0.2"]),
        (2, 3, 3, ["slacking off", "picking up", "rotating off bottom"]),
        (6, 2, 2, [f"{kind}, friction factor {f}" for kind in ("slacking off", "picking up") for f in (0.1, 0.2)]),
    ],
)
def test_groups_of_curves_have_all_cases(cases: int, kinds: int, frictions: int, groups: list[str]) -> None:
    """Of made-up loads; a group has at most ten curves and all cases."""
    factors = [round(0.1 * k, 1) for k in range(1, frictions + 1)]
    found = compared({f"case {k}": factors for k in range(cases)}, list(KINDS)[:kinds])
    assert sorted(group.name for group in found.groups) == sorted(groups)
    assert all(len({curve.key for curve in group.panels[1].curves}) == cases for group in found.groups)


def test_a_seventh_case_is_refused() -> None:
    with pytest.raises(InputError, match="at most 6 cases"):
        compared({str(k): [0.2] for k in range(7)}, ["trip_in"])


def test_a_shoe_that_not_all_cases_have_says_whose_it_is() -> None:
    """Both end at 2,000 m; one has its shoe 300 m lower, and a block that pushes more."""
    deep = well(rig={"block_weight": 3e4})
    upper = deep.wellbore.intervals[0].model_copy(update={"to_md": 1800.0})
    hole = deep.wellbore.model_copy(update={"intervals": (upper, *deep.wellbore.intervals[1:])})
    found = compared({"A": [0.2], "B": [0.2]}, ["trip_in"], B=deep.model_copy(update={"wellbore": hole}))
    assert [mark.lines for mark in found.marks] == [("shoe 1500 m", "A"), ("shoe 1800 m", "B")]


def test_a_long_name_keeps_its_beginning_and_its_end() -> None:
    names = [f"well \x1b {'x' * 60} {k}" for k in (1, 2)]
    keys = [key.name for key in compared({name: [0.2] for name in names}, ["trip_in"]).keys]
    assert [key[:8] for key in keys] == ["well \\x1"] * 2
    assert keys[0] != keys[1]
    assert max(map(len, keys)) == 40
