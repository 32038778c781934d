"""The table of result columns: names with units, and a load's value from a steady string."""

from types import SimpleNamespace

import pytest

from fctd import equilibrium
from fctd.case.systems import SYSTEMS
from fctd.results.columns import (
    BUCKLED,
    COLUMNS,
    CYCLES,
    DEPTH,
    ENDINGS,
    IN_CHART,
    LOADS,
    PROFILE,
    SHAPES,
    SHARES,
    Column,
)
from fctd.results.unit_systems import digits_of
from tests.cases import make_case, rotation


def test_every_name_ends_in_a_unit_and_stands_once() -> None:
    assert {name for name in COLUMNS if not name.endswith(ENDINGS)} == {of.name for of in (*SHARES, CYCLES)}
    assert len(COLUMNS) == 2 + len(LOADS) + len(BUCKLED) + len(SHAPES) + len(SHARES) + len(PROFILE)


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("hookload_N", "hookload"), ("sum_r_ft_N_m", "sum_r_ft"), ("von_mises_Pa", "von_mises"), ("md_m", "md"),
        ("inclination_deg", "inclination"), ("rows", "rows"),
    ],
)  # fmt: skip
def test_the_stem_is_the_name_without_its_unit(name: str, stem: str) -> None:
    assert Column(name, "").stem == stem


def test_a_load_is_read_from_the_string_or_computed_from_it() -> None:
    point = SimpleNamespace(hookload=4.0)
    assert Column("hookload_N", "").value(point) == 4.0
    assert Column("twice_N", "", of=lambda found: 2 * found.hookload).value(point) == 8.0


def test_every_load_and_column_of_a_profile_is_there() -> None:
    point = equilibrium(make_case(operations=[rotation(1000, 1)]), "rotate_off_bottom", 1000.0)
    loads = {column.name: column.value(point) for column in LOADS}
    assert loads["hookload_N"] == point.hookload
    assert {column.name for column in PROFILE} <= set(point.profile.columns)
    assert {column.name for column in IN_CHART} <= set(loads)


def test_loads_are_shown_to_a_hundred_newtons_and_one_newton_metre() -> None:
    """In kN and kN·m; lengths of the buckled part to the metre, the bit depth to a tenth of it."""
    for load in LOADS:
        assert {digits_of(load.name, units) for units in SYSTEMS} == {3 if load.name.endswith("_N_m") else 1}
    assert [digits_of(column.name, "field") for column in (DEPTH, *BUCKLED)] == [1, 0, 0]


def test_widths_of_the_hole_are_lengths_across_it() -> None:
    assert {name for name, column in COLUMNS.items() if column.across} == {
        "offset_high_m", "offset_right_m", "clearance_m",
    }  # fmt: skip


def test_a_chart_leaves_out_the_torques_of_wall_friction() -> None:
    """They are parts of the drive torque, for the loads of one string."""
    assert [load.name for load in LOADS if load not in IN_CHART] == ["sum_r_ft_N_m", "sum_r_mu_fn_N_m"]
    assert all(load in LOADS for load in IN_CHART)
