"""Traces of a view: the string lies on the drawn wall exactly where it touches."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.case.message import Message, quantity
from fctd.view.quantities import QUANTITIES
from fctd.view.scene import (
    PANELS,
    SCENE,
    Look,
    caption_of,
    hover_texts,
    panel_data,
    panel_layout,
    panel_traces,
    scene_data,
    scene_layout,
    scene_traces,
    unrolled,
)
from tests.view.made import strings


@pytest.mark.parametrize("times", [None, 1.0, 300.0])
def test_touching_points_lie_on_the_drawn_wall_and_others_within(times: float | None) -> None:
    made = strings()
    look, one = Look(made, exaggeration=times), made.snapshots[-1]
    places = scene_data(look, one)
    axis, _ = made.drawn.hole.at(one.columns["md_m"])
    drawn = np.linalg.norm(places["string"] - axis, axis=1) / look.exaggeration
    wall = one.columns["clearance_m"]
    np.testing.assert_allclose(drawn[one.touching], wall[one.touching], rtol=0.05)
    assert (drawn[~one.touching] <= wall[~one.touching]).all()
    np.testing.assert_array_equal(places["contacts"], places["string"][one.touching])
    assert one.touching.sum() > 3


def test_the_scene_holds_all_it_shows_to_scale() -> None:
    made = strings()
    look = Look(made)
    low, high = look.ranges()
    for one in made.snapshots:
        for name, places in scene_data(look, one).items():
            found = places[np.isfinite(places).all(axis=1)]
            assert ((low <= found) & (found <= high)).all(), name
    layout = scene_layout(look)
    ratio = np.array([layout["aspectratio"][axis] for axis in "xyz"])
    np.testing.assert_allclose(ratio / ratio.max(), (high - low) / (high - low).max())
    assert layout["zaxis"]["range"] == [high[2], low[2]]  # depth downwards
    (shoe,) = layout["annotations"]
    assert shoe["text"] == "shoe 300 m"
    bar = next(trace for trace in scene_traces(look, QUANTITIES["stress"]) if trace["name"] == "string")["line"][
        "colorbar"
    ]
    assert layout["domain"]["y"][1] < bar["y"] - 0.05  # no axis is labelled on the bar of colours


@pytest.mark.parametrize("units", ["si", "field"])
def test_panels_show_the_table_in_the_units(units: str) -> None:
    made = strings()
    look, one = Look(made, units), made.snapshots[-1]  # type: ignore[arg-type]
    data = panel_data(look, one)
    assert tuple(data) == PANELS == tuple(trace["name"] for trace in panel_traces(look, QUANTITIES["stress"]))
    tension, md = data["tension"]
    scale = (1e-3, 1.0) if units == "si" else (1 / 4448.2216152605, 1 / 0.3048)
    np.testing.assert_allclose(tension, one.columns["effective_tension_N"] * scale[0])
    np.testing.assert_allclose(md, one.columns["md_m"] * scale[1])
    assert len(data["angle"][0]) == one.touching.sum()
    low, high = panel_layout(look)["xaxis3"]["range"]
    assert low <= tension.min() <= tension.max() <= high


def test_high_and_low_side_lie_within_the_unrolled_hole() -> None:
    assert list(unrolled(np.array([0.0, 180.0, 270.0, 271.0, 359.0]))) == [0, 180, 270, -89, -1]


@pytest.mark.parametrize("name", QUANTITIES)
def test_every_quantity_has_colours_and_a_text_under_the_pointer(name: str) -> None:
    made, quantity = strings(), QUANTITIES[name]
    look = Look(made)
    traces = scene_traces(look, quantity)
    assert tuple(trace["name"] for trace in traces) == SCENE
    line = traces[SCENE.index("string")]["line"]
    assert line["cmin"] < line["cmax"]
    places = [at for at, _ in line["colorscale"]]
    assert places == sorted(places)
    assert (places[0], places[-1]) == (0, 1)
    assert quantity.label in hover_texts(look, made.snapshots[0])[3]


def test_the_caption_counts_contacts() -> None:
    made = strings()
    one = made.snapshots[-1]
    assert f"{one.touching.sum()} of {len(one.offset)} points touch" in caption_of(Look(made), one)
    rig = made.case.rig.model_copy(update={"block_weight": 5e4})
    heavy = replace(made, case=made.case.model_copy(update={"rig": rig}))
    assert f"kN ({(one.hookload + 5e4) / 1e3:.1f} kN on the indicator)" in caption_of(Look(heavy), one)
    assert "indicator" not in caption_of(Look(made), one)
    lost = replace(one, status=Message(f"under resolved: segments of {quantity(30.48, 'm')} cannot bend that way"))
    assert "segments of 100 ft" in caption_of(Look(made, "field"), lost)
