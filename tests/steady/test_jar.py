"""Forces at a jar: straight hole, both ways, names of components, refusals."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model.section import section_of
from fctd.steady.jar import jar_forces
from tests.cases import make_case, pipe

MUD = {"density": 1200.0}
PARTS = [pipe(60, 6, outer=0.165, name="collars"), pipe(10, 1, outer=0.165, name="jar"),
         pipe(None, None, segment_length=20.0)]  # fmt: skip
BENT = [[0, 0, 0], [200, 0, 0], [600, 60, 0], [1000, 60, 0]]


def well(stations: Any = None, **more: Any) -> Case:
    return make_case(stations, PARTS, mud=MUD, **more)


def test_in_a_straight_hole_the_pipe_above_the_jar_hangs_from_the_hook() -> None:
    """Up and down: the hook load is the force at the jar and the weight of what is above its middle."""
    case = well(rig={"hoist_capacity": 1e6, "block_weight": 5e4})
    weights = [section_of(part, 1200.0).weight for part in case.string.components]
    above = weights[1] * 5 + weights[2] * 830
    rows = jar_forces(case, "jar", 880.0, 900.0, up=[2e5], down=[3e4], hookload=[above + 3e5])
    assert rows["direction"].tolist() == ["up", "down", "up"]
    assert rows["jar_md_m"].tolist() == [835.0] * 3
    assert rows["force_at_jar_N"].to_numpy() == pytest.approx([2e5, -3e4, 3e5], abs=50.0)
    assert rows["hookload_N"].to_numpy() == pytest.approx(above + rows["force_at_jar_N"].to_numpy(), rel=2e-4)
    assert np.allclose(rows["weight_indicator_N"] - rows["hookload_N"], 5e4)
    assert np.allclose(rows["hoist_share"], rows["weight_indicator_N"] / 1e6)
    # 5 m of the jar and 40 m of collars hang between its middle and the stuck point.
    below = weights[1] * 5 + weights[0] * 40
    between = rows["force_at_jar_N"] - rows["force_at_stuck_N"]
    assert between.to_numpy() == pytest.approx(below, rel=1e-3)


@pytest.mark.slow
def test_a_push_beyond_the_helix_is_met_within_what_is_known_of_it() -> None:
    """Some loads on the way have no steady string."""
    (row,) = jar_forces(well(), "jar", 880.0, 900.0, down=[1e5]).itertuples()
    assert row.buckling == "helical"
    assert row.force_at_jar_N == pytest.approx(-1e5, rel=2e-3)


def test_the_force_comes_back_from_its_hook_load() -> None:
    """Round a bend with friction: the hook load for a force brings that force, and another one the other way."""
    case = well(BENT)
    asked = jar_forces(case, 850.0, 900.0, 950.0, up=["150 kN"], down=["60 kN"])
    back = jar_forces(case, 850.0, 900.0, 950.0, hookload=asked["hookload_N"].tolist())
    for load, way, force in zip(asked["hookload_N"], ("up", "down"), (150e3, -60e3), strict=True):
        row = back[np.isclose(back["hookload_N"], load, atol=2.0) & (back["direction"] == way)].iloc[0]
        assert row["force_at_jar_N"] == pytest.approx(force, abs=10.0)
    assert (asked["force_at_jar_N"] > asked["force_at_stuck_N"]).all()


def test_a_hook_load_between_those_of_the_free_string_comes_both_ways() -> None:
    rows = jar_forces(well(BENT), 850.0, 900.0, 950.0, hookload=[4.2e5])
    assert rows["direction"].tolist() == ["up", "down"]
    up, down = rows["force_at_jar_N"]
    assert up < down


def test_a_push_that_does_not_arrive_has_a_reason() -> None:
    (row,) = jar_forces(well(BENT), 850.0, 900.0, 950.0, down=["20 MN"]).itertuples()
    assert "no steady string has that load" in row.reason
    assert np.isnan(row.hookload_N)
    assert row.force_at_jar_N == -20e6


@pytest.mark.parametrize(("asked", "told"), [
    ({"jar": 850.0}, "up is missing: expected forces at the jar, or a hook load"),
    ({"jar": 950.0, "up": [1e5]}, 'jar = "950 m": expected a depth along the string, above the place'),
    ({"jar": "jars", "up": [1e5]}, 'jar = "jars": expected a depth, or the component jar'),
    ({"jar": "850 parsnips", "up": [1e5]}, 'jar = "850 parsnips": expected a depth, or one of the components'),
    ({"jar": 850.0, "up": [-1e5]}, "up = -100000.0: expected a force of at least 0"),
    ({"jar": 850.0, "up": [float("nan")]}, "up = nan: expected a force"),
    ({"jar": 850.0, "up": ["1 m"]}, 'up = "1 m": expected a force'),
    ({"jar": 850.0, "up": [1e5], "stuck_at": 970.0}, 'stuck_at = "970 m": expected a depth below'),
])  # fmt: skip
def test_what_cannot_be_asked_is_refused(asked: dict[str, Any], told: str) -> None:
    given = {"stuck_at": 900.0, "bit_depth": 950.0} | asked
    with pytest.raises(InputError) as refused:
        jar_forces(well(), **given)
    assert told in str(refused.value)


def test_components_of_one_name_are_refused() -> None:
    parts = [part | {"name": "pipe"} for part in PARTS]
    with pytest.raises(InputError, match="as 3 components have that name"):
        jar_forces(make_case(components=parts, mud=MUD), "pipe", up=[1e5])


@pytest.mark.parametrize("pull", [3e5, "300 kN", ["300 kN"]])
def test_one_load_needs_no_list(pull: Any) -> None:
    (row,) = jar_forces(well(), "jar", 880.0, 900.0, up=pull).itertuples()
    assert row.force_at_jar_N == pytest.approx(3e5)
