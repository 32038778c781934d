"""The table of result columns: names with units, and a load's value from a steady string."""

from types import SimpleNamespace

import pytest

from fctd import equilibrium
from fctd.results.columns import BUCKLED, COLUMNS, ENDINGS, IN_CHART, LOADS, PROFILE, SHAPES, SHARES, Column
from tests.cases import make_case, rotation


def test_every_name_ends_in_a_unit_and_stands_once() -> None:
    assert {name for name in COLUMNS if not name.endswith(ENDINGS)} == {share.name for share in SHARES}
    assert len(COLUMNS) == 1 + len(LOADS) + len(BUCKLED) + len(SHAPES) + len(SHARES) + len(PROFILE)


@pytest.mark.parametrize(("name", "stem"), [("hookload_N", "hookload"), ("sum_r_ft_N_m", "sum_r_ft"), ("rows", "rows")])
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
