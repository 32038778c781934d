"""The string on the page is that of a view."""

import numpy as np

from fctd.app import scenes
from fctd.view.quantities import QUANTITIES
from fctd.view.scene import PANELS, SCENE, Look, panel_data, scene_data
from fctd.view.strings import Strings, of_chart
from tests.app.made import of, unpacked
from tests.view.made import case, strings


def test_data_are_those_of_a_view() -> None:
    every, quantity = strings(), QUANTITIES["tension"]
    one = Strings(every.case, every.along, every.snapshots[3:4], every.drawn)
    _, _, times = scenes.skeletons(one, quantity, "si")
    scene, panels, words = scenes.changes_of(one, quantity, "si", times, hole=True)
    look = Look(one, "si", times)
    for name, places in scene_data(look, one.snapshots[0]).items():
        if name != "picked":
            found = [unpacked(of(scene, "data", SCENE.index(name), axis)) for axis in "xyz"]
            np.testing.assert_allclose(np.array(found).T, places, atol=1e-3)
    for name, (value, depth) in panel_data(look, one.snapshots[0]).items():
        found = [unpacked(of(panels, "data", PANELS.index(name), axis)) for axis in "xy"]
        np.testing.assert_allclose(found, [value, depth], rtol=1e-5, atol=1e-4)
    assert "points touch; largest side force at" in words
    assert "&" not in words
    line = of(scene, "data", SCENE.index("string"), "line")
    assert len(unpacked(line["color"])) == len(one.snapshots[0].offset)


def test_a_string_that_touches_nowhere_has_no_place_of_the_largest_side_force() -> None:
    one, quantity = of_chart(case(), ["trip_out"], [80.0]), QUANTITIES["tension"]
    _, _, words = scenes.changes_of(one, quantity, "si", 1.0, hole=True)
    assert "0 of" in words
    assert "largest" not in words
