"""The view as a figure of plotly, for notebooks and programs: its slider needs no page around it."""

from itertools import chain

import numpy as np
import plotly.graph_objects as go

from fctd.plots.traces import plain
from fctd.results.unit_systems import System
from fctd.view.quantities import quantity_of
from fctd.view.scene import (
    SCENE,
    Look,
    caption_of,
    drawn_of,
    panel_layout,
    panel_traces,
    scene_layout,
    scene_traces,
)
from fctd.view.strings import Snapshot, Strings, label_of_group

WIDTH, HEIGHT = 1240, 720  # [px]
APART = 0.58  # share of the width that the scene has


def view_figure(
    strings: Strings, colour: str = "side_force", units: System = "si", *, exaggeration: float | None = None
) -> go.Figure:
    """The scene and the panels of the last string, with a slider over all strings and a button that plays them.

    colour : name of one of ``QUANTITIES``.  exaggeration : of offsets and clearance, a round number by default.
    Raises InputError for an unknown quantity.
    """
    look, quantity = Look(strings, units, exaggeration), quantity_of(colour)
    looks = scene_traces(look, quantity) + panel_traces(look, quantity)

    def filled(one: Snapshot) -> list[dict[str, object]]:
        drawn, found = drawn_of(look, one, quantity), []
        for trace in looks:
            name = trace["name"]
            if name in SCENE:
                x, y, z = np.asarray(drawn.places[name], np.float32).T
                new = {**trace, "x": x, "y": y, "z": z}
            else:
                x, y = (np.asarray(part, np.float32) for part in drawn.panels[name])
                new = {**trace, "x": x, "y": y}
            if name == "string":
                new |= {"text": drawn.texts, "line": {**trace["line"], "color": np.asarray(drawn.values, np.float32)}}
            elif name == "contacts":
                new["text"] = drawn.texts_touching
            elif name == "angle":
                new["marker"] = {**trace["marker"], "color": np.asarray(drawn.values_touching, np.float32)}
            found.append(new)
        return found

    shown = strings.snapshots
    frames = [
        go.Frame(data=filled(one), name=str(k), layout={"title": title_of(look, one)}) for k, one in enumerate(shown)
    ]
    layout = panel_layout(look)
    for k in range(3):
        axis = layout[f"xaxis{k + 1 if k else ''}"]
        axis["domain"] = [APART + (1 - APART) * end for end in axis["domain"]]
    layout["scene"] = scene_layout(look)
    layout["scene"]["domain"]["x"] = [0.02, APART - 0.06]
    for shape in layout["shapes"]:
        shape["x0"] = APART
    steps = [
        {
            "label": f"{label_of_group(one.group)} {position_of(look, one)}", "method": "animate",
            "args": [[str(k)], {"mode": "immediate", "frame": {"duration": 0, "redraw": True}}],
        }
        for k, one in enumerate(shown)
    ]  # fmt: skip
    play = {"label": "play", "method": "animate", "args": [None, {"frame": {"duration": 200, "redraw": True}}]}
    layout |= {
        "title": title_of(look, shown[-1]), "width": WIDTH, "height": HEIGHT, "template": "plotly_white",
        "margin": {"l": 10, "r": 20, "t": 80, "b": 110},
        "sliders": [{"active": len(shown) - 1, "steps": steps, "pad": {"t": 50}}],
        "updatemenus": [{"type": "buttons", "buttons": [play], "x": 0, "y": 0, "pad": {"t": 60}, "xanchor": "right"}],
    }  # fmt: skip
    return go.Figure(data=filled(shown[-1]), layout=layout, frames=frames)


def position_of(look: Look, one: Snapshot) -> str:
    """Where the slider stands: the bit depth, or time and bit depth."""
    depth = f"{one.bit_depth * look.depth.factor:.1f} {look.depth.label}"
    return depth if look.strings.along == "bit depth" else f"{one.at:.1f} s, bit at {depth}"


def title_of(look: Look, one: Snapshot) -> dict[str, str]:
    """The title above one string, as plotly takes it."""
    name, group = plain(look.strings.case.name), label_of_group(one.operation)
    head = f"<b>{name}</b>: {group}, {position_of(look, one)}"
    return {"text": "<br>".join(chain([head], [caption_of(look, one)]))}
