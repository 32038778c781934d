"""A well under the sliders: what the page draws is what the commands compute."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import fctd
from fctd.app.sessions import Source
from fctd.app.well import DEPTHS, EVERY, FAN, LIMIT_DEPTHS, LIMITS, STRING, Well
from fctd.case.errors import InputError
from fctd.case.operations import KINDS as OPERATIONS
from fctd.model.depths import usual_depths
from fctd.model.summary import summarise
from fctd.view.scene import SCENE
from tests.app.made import ROWS, TEXT, source, unpacked

KINDS = ["trip_out", "rotate_off_bottom"]
UP = OPERATIONS["trip_out"].label


def drawn(found: dict[str, Any], name: str, axis: str = "x") -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Loads and depths of the traces of a name in the chart, one after the other; empty where there is none."""
    traces = [t for t in found["loads"][0][1] if t["name"] == name and t.get("xaxis") == axis]
    both = [[unpacked(t[side]) for t in traces] for side in "xy"]
    loads, depths = (np.concatenate([np.empty(0, "<f4"), *of]) for of in both)
    return loads, depths


@pytest.fixture(scope="module")
def well(tmp_path_factory: pytest.TempPathFactory) -> Well:
    return Well(source(), tmp_path_factory.mktemp("well"), "si")


def solved(well: Well, **given: Any) -> dict[str, Any]:
    usual: dict[str, Any] = {
        "values": {}, "operations": KINDS, "operation": "trip_out", "depth": 880.0, "colour": "tension",
    }  # fmt: skip
    return well.solved(**(usual | given))


def test_the_chart_is_that_of_the_command(well: Well) -> None:
    moved = {"friction_open": 0.4, "mud": 1300.0}
    found = solved(well, values=moved)
    case = well.case.model_copy(update={"mud": well.case.mud.model_copy(update={"density": 1300.0})})
    chart = fctd.torque_drag(case, KINDS, well.depths, friction={"cased": 0.2, "open": 0.4})
    for kind in KINDS:
        rows = chart[chart["operation"] == kind]
        for column, axis in (("hookload_N", "x"), ("surface_torque_N_m", "x2")):
            loads, depths = drawn(found, OPERATIONS[kind].label, axis)
            np.testing.assert_allclose(loads, rows[column] * 1e-3, rtol=1e-6)
            np.testing.assert_allclose(depths, rows["bit_depth_m"], rtol=1e-6)
    assert not len(drawn(found, OPERATIONS["trip_in"].label)[0])
    assert found["where"] == "picking up, bit at 880 m"
    point = fctd.equilibrium(well.moved(moved), operation="trip_out", bit_depth=880.0)
    assert f"hook load {point.hookload / 1e3:.1f} kN" in found["words"]
    assert found["note"] == ""
    json.dumps(found, allow_nan=False)


def test_while_a_slider_moves_every_third_depth_is_solved_with_the_deepest(well: Well) -> None:
    found = solved(well, coarse=True, hole=False)
    _, depth = drawn(found, UP)
    assert len(depth) == -(-DEPTHS // EVERY)
    assert depth[-1] == well.depths[-1] == 900
    changed = {way[1] for way, _ in found["scene"]}
    assert changed == {SCENE.index("string"), SCENE.index("contacts")}
    assert {SCENE.index(name) for name in ("wall", "rings", "shoes")} < {way[1] for way, _ in solved(well)["scene"]}


def test_all_data_fit_the_figures_that_the_page_opens_with(well: Well) -> None:
    opened, found = well.opened(), solved(well, measured=ROWS)
    assert opened["operations"] == [*KINDS, "trip_in", "drill_rotating"]
    assert opened["name"] == well.case.name
    for name in ("scene", "panels"):
        for (*way, last), _ in found[name]:
            place = opened[name]
            for key in way:
                place = place[key]
            assert isinstance(place, dict), way
            assert last in place or last in ("array", "arrayminus", "range"), (name, way, last)
    assert {way[0] for way, _ in found["loads"]} == set(opened["loads"])
    assert len(json.dumps(found)) < 150_000


def test_the_rotation_turns_what_turns(well: Well) -> None:
    slow, fast = (
        solved(well, values={"rpm": rpm}, operations=["back_ream", "trip_in"], operation="back_ream")["words"]
        for rpm in (20, 200)
    )
    assert slow != fast


def test_measured_rows_are_points(well: Well) -> None:
    assert well.check_measured(ROWS) == {"rows": 2, "told": []}
    found = well.check_measured("Depth\tPU\tSO\n500\t150\t140\n")
    assert (found["rows"], found["told"][0][:50]) == (2, 'headers without units are read as: "Depth" in m, "')
    assert well.check_measured(" ") == {"rows": 0, "told": []}
    for text in (ROWS, ROWS.replace(",", "\t")):
        loads, depths = drawn(solved(well, measured=text), f"measured, {UP}")
        assert (loads.tolist(), depths.tolist()) == ([150.0], [500.0])
    commas = ROWS.replace(",", "\t").replace("150", "150,5")
    assert drawn(solved(well, measured=commas), f"measured, {UP}")[0].tolist() == [150.5]
    for wrong in ("depth,operation\n1,trip_out\n", "x", ROWS.replace("trip_out", "<b>up</b>"), "\0,\n\0,\0\n"):
        with pytest.raises(InputError, match="measured rows: ") as refused:
            well.check_measured(wrong)
        assert str(well.read.folder) not in str(refused.value)
    with pytest.raises(InputError, match="at most 5000 rows"):
        well.check_measured("bit_depth_m,operation,hookload_kN\n" + "500,trip_out,150\n" * 5001)


@pytest.mark.parametrize(
    "wrong",
    [
        {"operation": "<b>"}, {"colour": "x"}, {"values": {"mud": 1e9}}, {"values": {"mud": None}},
        {"values": {"segment": 5, "friction_open": "0.2"}},
    ],
)  # fmt: skip
def test_what_no_slider_sends_is_refused(well: Well, wrong: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        solved(well, **wrong)


def test_rows_without_a_plain_answer_are_counted(tmp_path: Path) -> None:
    text = TEXT.replace("friction = 0.25", "friction = 0.6").replace("static_friction = 0.3", "static_friction = 0.6")
    level = b"md_m,inc_deg,azi_deg\n0,0,30\n100,0,30\n350,90,60\n900,90,60\n"
    well = Well(source(text, survey=level), tmp_path, "si")
    found = solved(well, operations=["trip_in"], values={"friction_cased": 0.6}, operation="trip_in")
    assert "of 70 " in found["note"]
    assert "; rings: buckled" in found["note"]
    crosses = len(drawn(found, "no loads")[0])
    assert ("crosses: no loads" in found["note"]) == (crosses > 0)


def test_depths_end_where_the_string_does(tmp_path: Path) -> None:
    """The first case of the guide has a string of 2450 m in a hole of 2600 m."""
    path = Path(__file__).parents[2] / "validation" / "cases" / "curved_chain.toml"
    case = fctd.load_case(path)
    assert case.depths[1] == 2600.0
    assert usual_depths(case, 2)[-1] == case.deepest == summarise(case).bit_depth
    assert case.deepest == pytest.approx(2450.0)
    well = Well(Source(path.read_text(encoding="utf-8")), tmp_path, "si")
    assert well.opened()["depth"]["high"] == pytest.approx(case.deepest)


def test_limits_are_drawn_where_they_are_asked_for_and_no_slider_moves(well: Well) -> None:
    """Those of the command, at some depths."""
    found = {
        (asked, coarse): drawn(solved(well, operations=asked, coarse=coarse), "limit: yield")[0]
        for asked, coarse in (((*KINDS, LIMITS), False), ((*KINDS, LIMITS), True), (tuple(KINDS), False))
    }
    assert not len(found[(*KINDS, LIMITS), True])
    assert not len(found[tuple(KINDS), False])
    yields = found[(*KINDS, LIMITS), False][:LIMIT_DEPTHS]
    table = fctd.limits_of(well.case, "trip_out", [well.depths[0], well.depths[-1]])
    expected = table.loc[table["limit"] == "yield", "hookload_N"] / 1e3
    assert yields[[0, -1]] == pytest.approx(expected.to_numpy(), rel=1e-5)


def test_the_load_is_the_indicators_where_the_block_is_known_but_for_one_who_asks(tmp_path: Path) -> None:
    well = Well(source(f"{TEXT}\n[rig]\nblock_weight = '50 kN'\n"), tmp_path, "si")
    read, string = (drawn(solved(well, operations=[*KINDS, *more]), UP)[0] for more in ([], [STRING]))
    np.testing.assert_allclose(read, string + 50.0, rtol=1e-6)


def test_a_fan_has_the_curves_of_less_and_more_friction_where_no_slider_moves(well: Well) -> None:
    found = solved(well, operations=[*KINDS, FAN])
    loads, _ = drawn(found, UP)
    assert len(loads) == 3 * DEPTHS
    for part, by in zip(np.split(loads, 3), (-0.05, 0.0, 0.05), strict=True):
        factors = {"cased": 0.2 + by, "open": 0.25 + by}
        rows = fctd.torque_drag(well.case, "trip_out", well.depths, friction=factors)
        np.testing.assert_allclose(part, rows["hookload_N"] / 1e3, rtol=1e-6)
    assert len(drawn(solved(well, operations=[*KINDS, FAN], coarse=True), UP)[0]) == -(-DEPTHS // EVERY)
    table = well.chart({}, [*KINDS, FAN])
    assert len(table) == 3 * len(KINDS) * DEPTHS
    assert {row["friction_label"] for row in table} == {"−0.05", "as set", "+0.05"}
