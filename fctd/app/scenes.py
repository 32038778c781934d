"""The string in its hole on the page: the scene and the panels of ``fctd view`` for one string, as changes."""

from html import unescape
from typing import Any, Final

import numpy as np

from fctd.app.charts import FONT, Change, packed
from fctd.results.profile import place_in_words
from fctd.results.unit_systems import System
from fctd.view.quantities import Quantity
from fctd.view.scene import (
    PANELS,
    SCENE,
    Look,
    caption_of,
    drawn_of,
    panel_layout,
    panel_traces,
    scene_layout,
    scene_traces,
)
from fctd.view.strings import Strings

HOLE: Final = ("wall", "rings", "shoes")  # traces that friction and loads do not move
AWAY: Final = 1.3  # of the camera
AXES: Final = ("xaxis2", "xaxis3")


def skeletons(strings: Strings, quantity: Quantity, units: System) -> tuple[dict[str, Any], dict[str, Any], float]:
    """The scene, the panels, and the exaggeration of the scene, without data; strings : the deepest one alone."""
    look = Look(strings, units)
    none = {"l": 0, "r": 0, "t": 0, "b": 0}
    inside = scene_layout(look)
    # The picture is narrower than that of a view.
    inside["camera"]["eye"] = {axis: AWAY * at for axis, at in inside["camera"]["eye"].items()}
    scene = {"scene": inside, "margin": none, "uirevision": "fixed", "showlegend": False}
    font = {"family": FONT, "size": 11}
    return (
        {"data": scene_traces(look, quantity), "layout": scene | {"font": font}},
        {"data": panel_traces(look, quantity), "layout": panel_layout(look) | {"font": font}},
        look.exaggeration,
    )


def changes_of(
    strings: Strings, quantity: Quantity, units: System, exaggeration: float, *, hole: bool
) -> tuple[list[Change], list[Change], str]:
    """New data of scene and panels, and what is to be said of the string; hole : whether it is drawn anew."""
    (one,) = strings.snapshots
    look = Look(strings, units, exaggeration)
    drawn = drawn_of(look, one, quantity, hole=hole)
    scene: list[Change] = []
    for name in (*(HOLE if hole else ()), "string", "contacts"):
        k = SCENE.index(name)
        scene += [(["data", k, axis], packed(part)) for axis, part in zip("xyz", drawn.places[name].T, strict=True)]
    k = SCENE.index("string")
    traces = {trace["name"]: trace for trace in scene_traces(look, quantity)}
    scene += [
        (["data", k, "line"], traces["string"]["line"] | {"color": packed(drawn.values)}),
        (["data", k, "text"], drawn.texts),
        (["data", SCENE.index("contacts"), "text"], drawn.texts_touching),
    ]
    panels: list[Change] = []
    for name, (value, depth) in drawn.panels.items():
        k = PANELS.index(name)
        panels += [(["data", k, "x"], packed(value)), (["data", k, "y"], packed(depth))]
    marker = next(trace for trace in panel_traces(look, quantity) if trace["name"] == "angle")["marker"]
    panels.append((["data", PANELS.index("angle"), "marker"], marker | {"color": packed(drawn.values_touching)}))
    layout = panel_layout(look)
    panels += [(["layout", axis, name], layout[axis][name]) for axis in AXES for name in ("range", "title")]
    return scene, panels, _words(look, strings)


def _words(look: Look, strings: Strings) -> str:
    """Hook load, torque, contacts and status, as plain text."""
    (one,) = strings.snapshots
    text = unescape(caption_of(look, one))
    force = one.columns["side_force"]
    if one.touching.any():
        k = int(np.nanargmax(force))
        place = place_in_words(one.columns["md_m"][k], one.bit_depth, look.depth.factor, look.depth.label)
        text += f"; largest side force at {place}"
    return text
