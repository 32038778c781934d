"""A well under the sliders: what the page draws is what the commands compute."""

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import fctd
from fctd.app.charts import LOST, place_of
from fctd.app.sessions import Source
from fctd.app.well import DEPTHS, EVERY, LIMIT_DEPTHS, LIMITS, Well
from fctd.case.errors import InputError
from fctd.model.depths import usual_depths
from fctd.model.summary import summarise
from fctd.view.scene import SCENE
from tests.app.made import ROWS, TEXT, source

KINDS = ["trip_out", "rotate_off_bottom"]


def unpacked(value: dict[str, str]) -> NDArray[np.float32]:
    return np.frombuffer(base64.b64decode(value["bdata"]), "<f4")


def of(changes: list[tuple[list[Any], Any]], *way: object) -> Any:
    """The value of a change by its way."""
    (found,) = [value for path, value in changes if path == list(way)]
    return found


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
        for column, factor in (("hookload_N", 1e-3), ("surface_torque_N_m", 1e-3)):
            k = place_of("line", column, kind)
            np.testing.assert_allclose(unpacked(of(found["loads"], "data", k, "x")), rows[column] * factor, rtol=1e-6)
            np.testing.assert_allclose(unpacked(of(found["loads"], "data", k, "y")), rows["bit_depth_m"], rtol=1e-6)
    assert not len(unpacked(of(found["loads"], "data", place_of("line", "hookload_N", "trip_in"), "x")))
    assert found["where"] == "picking up, bit at 880 m"
    point = fctd.equilibrium(well.moved(moved), operation="trip_out", bit_depth=880.0)
    assert f"hook load {point.hookload / 1e3:.1f} kN" in found["words"]
    assert found["note"] == ""
    json.dumps(found, allow_nan=False)


def test_while_a_slider_moves_every_third_depth_is_solved_with_the_deepest(well: Well) -> None:
    found = solved(well, coarse=True, hole=False)
    depth = unpacked(of(found["loads"], "data", place_of("line", "hookload_N", "trip_out"), "y"))
    assert len(depth) == -(-DEPTHS // EVERY)
    assert depth[-1] == well.depths[-1] == 900
    changed = {way[1] for way, _ in found["scene"]}
    assert changed == {SCENE.index("string"), SCENE.index("contacts")}
    assert {SCENE.index(name) for name in ("wall", "rings", "shoes")} < {way[1] for way, _ in solved(well)["scene"]}


def test_all_data_fit_the_figures_that_the_page_opens_with(well: Well) -> None:
    opened, found = well.opened(), solved(well, measured=ROWS)
    assert opened["operations"] == [*KINDS, "trip_in", "drill_rotating"]
    assert opened["name"] == well.case.name
    for name in ("loads", "scene", "panels"):
        for (*way, last), _ in found[name]:
            place = opened[name]
            for key in way:
                place = place[key]
            assert isinstance(place, dict), way
            assert last in place or last in ("array", "arrayminus", "range"), (name, way, last)
    assert len(json.dumps(found)) < 150_000


def test_the_rotation_turns_what_turns(well: Well) -> None:
    slow, fast = (
        solved(well, values={"rpm": rpm}, operations=["back_ream", "trip_in"], operation="back_ream")["words"]
        for rpm in (20, 200)
    )
    assert slow != fast


def test_measured_rows_are_points(well: Well) -> None:
    assert well.check_measured(ROWS) == {"rows": 2}
    assert well.check_measured(" ") == {"rows": 0}
    for text in (ROWS, ROWS.replace(",", "\t")):
        found = solved(well, measured=text)["loads"]
        k = place_of("measured", "hookload_N", "trip_out")
        assert unpacked(of(found, "data", k, "x")).tolist() == [150.0]
        assert unpacked(of(found, "data", k, "y")).tolist() == [500.0]
    commas = ROWS.replace(",", "\t").replace("150", "150,5")
    found = solved(well, measured=commas)["loads"]
    assert unpacked(of(found, "data", place_of("measured", "hookload_N", "trip_out"), "x")).tolist() == [150.5]
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
    crosses = len(unpacked(of(found["loads"], "data", place_of(LOST, "hookload_N"), "y")))
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
    k = place_of("limit", "hookload_N", "trip_out")
    found = {
        (asked, coarse): unpacked(of(solved(well, operations=asked, coarse=coarse)["loads"], "data", k, "x"))
        for asked, coarse in (((*KINDS, LIMITS), False), ((*KINDS, LIMITS), True), (tuple(KINDS), False))
    }
    assert not np.isfinite(found[(*KINDS, LIMITS), True]).any()
    assert not np.isfinite(found[tuple(KINDS), False]).any()
    drawn = found[(*KINDS, LIMITS), False]
    table = fctd.limits_of(well.case, "trip_out", [well.depths[0], well.depths[-1]])
    assert drawn[[0, LIMIT_DEPTHS - 1]] == pytest.approx(table["hookload_N"] / 1e3, rel=1e-5)
