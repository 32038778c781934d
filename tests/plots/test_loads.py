"""Groups of curves, and limits of axes that neither noise nor pushes set."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.plots import loads
from fctd.plots.loads import BESIDE, LEVER, Limits, as_load, cases_of, groups_of, spent_at, usual_load
from fctd.results.series import series_of
from tests.plots.made import chart, locked_chart, well

CASE = well(rig={"block_weight": 3e4, "sheave_efficiency": 0.98})


def limits_of_load(table: pd.DataFrame, case: Case | None, *rest: Any) -> Limits:
    return loads.limits_of_load(series_of(table), cases_of(case), *rest)


def limits_of_torque(table: pd.DataFrame, *rest: Any) -> Limits:
    return loads.limits_of_torque(series_of(table), *rest)


@pytest.mark.parametrize(
    ("kinds", "factors", "sizes", "first"),
    [
        (1, 10, [10], ""),
        (3, 3, [9], ""),
        (6, 2, [6, 6], "friction factor 0.1"),
        (1, 12, [6, 6], "slacking off, μ 0.1 to 0.6"),
        (2, 6, [6, 6], "slacking off"),
    ],
)
def test_groups_have_at_most_ten_curves(kinds: int, factors: int, sizes: list[int], first: str) -> None:
    table = chart(list(KINDS)[:kinds], [round(0.1 * k, 1) for k in range(1, factors + 1)])
    groups = groups_of(series_of(table))
    assert [len(group) for _, group in groups] == sizes
    assert groups[0][0] == first
    assert sum(len(one.columns["status"]) for _, group in groups for one in group) == len(table)


def test_rounding_noise_is_drawn_as_zero() -> None:
    """A sliding string has no torque; what the solver leaves of it must not fill the axis."""
    table = chart(["trip_in"], [0.2])
    table["surface_torque_N_m"] = 2.0 * np.sin(table["bit_depth_m"])
    limits = limits_of_torque(table, "si", None)
    least = LEVER * table["hookload_N"].max() / 1e3
    noise = -table["surface_torque_N_m"].min() / 1e3
    assert noise < 0.01 * least
    # From 0 less the noise to the least torque that is drawn, with a twentieth of that at both ends.
    assert limits.high - limits.low == pytest.approx(1.1 * (least + noise))
    assert limits.low == pytest.approx(-noise - 0.05 * (least + noise))
    table["surface_torque_N_m"] += 4000.0  # of a motor: the axis still begins at 0
    limits = limits_of_torque(table, "si", None)
    assert limits.low < 0 < 4 < limits.high


def test_pushes_do_not_set_the_limits() -> None:
    """Slack-off is spent at 30 kN block weight; 120 kN at 1,000 m to −15 kN at 1,450 m are the other hook loads."""
    table = locked_chart()
    limits = limits_of_load(table, CASE, "string", "si", None)
    assert limits.cut
    assert limits.low == pytest.approx(-30 - BESIDE * 150)
    assert limits.high > 120
    assert limits_of_torque(table, "si", None).high < 1.0


def test_the_axis_of_torque_goes_below_0_where_a_locked_string_does() -> None:
    """A helix turns a string backwards; without such a torque the axis begins at 0."""
    table = locked_chart()
    limits = limits_of_torque(table, "si", None)
    assert limits.low == pytest.approx(-0.05 / 1.1 * (limits.high - limits.low))
    table.loc[table["bit_depth_m"] == 1500, "surface_torque_N_m"] = -100.0
    limits = limits_of_torque(table, "si", None)
    assert limits.low == pytest.approx(-BESIDE / (1.05 + BESIDE) * (limits.high - limits.low))


@pytest.mark.parametrize("loads", [True, False])
def test_a_chart_of_nothing_but_pushes_shows_the_least(loads: bool) -> None:
    table = locked_chart()
    table["status"] = "locked_up"
    table.loc[table["bit_depth_m"] < 1500, "hookload_N"] = np.nan
    if not loads:
        table["hookload_N"] = np.nan
    limits = limits_of_load(table, None, "string", "si", None)
    assert limits.low < (table["hookload_N"].max() / 1e3 if loads else 0) < 0.1 < limits.high


def test_an_axis_without_loads_has_a_span() -> None:
    table = chart(["trip_in"], [0.2])
    table[["hookload_N", "surface_torque_N_m", "total_contact_force_N"]] = np.nan
    for limits in (limits_of_load(table, None, "string", "si", None), limits_of_torque(table, "si", None)):
        assert limits.high - limits.low == pytest.approx(1.1)


def test_the_weight_indicator_follows_the_sensors() -> None:
    """A block of 30 kN, hoisted over sheaves of 98 %: the dead line holds 98 % of 130 kN."""
    assert as_load(CASE, "trip_out", np.array([1e5]), "indicator") == pytest.approx([1.3e5 * 0.98])
    assert as_load(CASE, "trip_out", np.array([1e5]), "string") == [1e5]
    assert np.isnan(as_load(None, "trip_out", np.array([1e5]), "indicator")).all()
    assert [spent_at({"": CASE}, load) for load in ("string", "indicator")] == [-3e4, 0.0]


def test_a_picture_of_several_cases_shows_one_load() -> None:
    """The indicator's reading where all of them say what the block weighs."""
    assert [usual_load(cases) for cases in ([], [CASE], [CASE, well()])] == ["string", "indicator", "string"]


def test_measured_rows_are_within_the_limits() -> None:
    table = chart(["trip_in"], [0.2])
    measured = pd.DataFrame({f"hookload{end}_N": [1e6 * k] for k, end in enumerate(("_low", "", "_high"), start=1)})
    limits = limits_of_load(table, None, "string", "si", measured)
    assert limits.high > 3000
