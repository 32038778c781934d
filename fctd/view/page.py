"""The view as a page: one file of HTML with plotly's code and all strings in it, which needs no network."""

import base64
import json
from collections.abc import Iterable
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from plotly.offline import get_plotlyjs

from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.plots.tracks import side_force_unit
from fctd.results.buckling import MODES
from fctd.results.unit_systems import System, shown
from fctd.store.whole_file import whole_file
from fctd.view.hole import AROUND, AXIS_STEP, SIDES, Stations
from fctd.view.quantities import QUANTITIES, quantity_of
from fctd.view.scene import Look, caption_of, panel_layout, panel_traces, scene_layout, scene_traces
from fctd.view.strings import Snapshot, Strings, label_of_group

MOST_POINTS: Final = 400_000  # contact points of all strings; a page of more would not open
CONFIG: Final = {"displaylogo": False, "responsive": True, "modeBarButtonsToRemove": ["sendChartToCloud"]}
# Columns of the strings that the page holds.
COLUMNS: Final = (
    "md_m", "clearance_m", "contact_force_N", "contact_angle_deg", "sinusoidal_limit_N", "helical_limit_N",
    *(quantity.column for quantity in QUANTITIES.values()),
)  # fmt: skip


def save_view(
    strings: Strings,
    path: Path,
    colour: str = "side_force",
    units: System = "si",
    *,
    exaggeration: float | None = None,
    warnings: Iterable[str] = (),
) -> list[Path]:
    """Write the page; returns the file.

    colour : name of one of ``QUANTITIES`` that colours the string first; the page can change it.  exaggeration : of
    offsets and clearance at first, a round number by default.  warnings : lines below the title.  Raises InputError
    for an unknown quantity, for too many strings, and where the file cannot be written.
    """
    points = sum(len(one.offset) for one in strings.snapshots)
    if points > MOST_POINTS:
        expected = f"at most {MOST_POINTS} contact points in all strings, here {points}: fewer depths or operations"
        raise InputError(expected, key="strings")
    look, page = Look(strings, units, exaggeration), files("fctd.view")
    content = {  # in the order of the page
        "TITLE": escape(printable(strings.case.name)),
        "STYLE": (page / "page.css").read_text("utf-8"),
        "WARNINGS": "".join(f"<p>warning {escape(printable(text))}</p>" for text in warnings),
        "PLOTLY": get_plotlyjs(),
        "DATA": _json(_content(look, quantity_of(colour).name)),
        "CODE": (page / "page.js").read_text("utf-8"),
    }
    text = (page / "page.html").read_text("utf-8")
    before = ""
    for name, value in content.items():
        head, _, text = text.partition(f"@{name}@")
        before += head + value
    with whole_file(path) as scratch:
        scratch.write_text(before + text, encoding="utf-8", errors="backslashreplace")
    return [path]


def _content(look: Look, colour: str) -> dict[str, Any]:
    """What the code of the page reads."""
    strings = look.strings
    drawn, first = strings.drawn, QUANTITIES[colour]
    md = np.append(np.arange(drawn.lines.md[0], drawn.lines.md[-1], AXIS_STEP), drawn.lines.md[-1])
    order = [one for group in strings.groups for one in strings.of(group)]
    return {
        "along": strings.along,
        "depth": look.depth._asdict(),
        "force": side_force_unit(look.units, "length")._asdict(),
        "tension": shown("hookload_N", look.units)._asdict(),
        "exaggeration": look.exaggeration,
        "radius": look.radius,
        "around": AROUND.tolist(),
        "sides": SIDES.tolist(),
        "modes": MODES,
        "axis": {"md": _packed(md), "at": _packed(drawn.hole.at(md)[0])},
        "lines": _stations(drawn.lines),
        "rings": _stations(drawn.rings),
        "shoes": _stations(drawn.shoes),
        "groups": [
            {"label": label_of_group(group), "steps": [_step(look, one) for one in strings.of(group)]}
            for group in strings.groups
        ],
        "counts": [len(one.offset) for one in order],
        "columns": {name: _packed(np.concatenate([one.columns[name] for one in order])) for name in COLUMNS},
        "offset": _packed(np.concatenate([one.offset for one in order])),
        "colour": colour,
        "quantities": [_quantity(look, name) for name in QUANTITIES],
        "scene": {"data": scene_traces(look, first), "layout": _of_scene(look)},
        "panels": {"data": panel_traces(look, first), "layout": panel_layout(look)},
        "config": CONFIG,
    }


def _of_scene(look: Look) -> dict[str, Any]:
    none = {"l": 0, "r": 0, "t": 0, "b": 0}
    return {"scene": scene_layout(look), "margin": none, "uirevision": "fixed", "showlegend": False}


def _step(look: Look, one: Snapshot) -> dict[str, Any]:
    depth = f"bit at {one.bit_depth * look.depth.factor:.1f} {look.depth.label}"
    where = depth if look.strings.along == "bit depth" else f"{one.at:.1f} s, {label_of_group(one.operation)}, {depth}"
    return {"where": where, "words": caption_of(look, one)}


def _quantity(look: Look, name: str) -> dict[str, Any]:
    quantity = QUANTITIES[name]
    factor, unit = quantity.shown(look.units)
    (trace,) = (trace for trace in scene_traces(look, quantity) if trace["name"] == "string")
    return {
        "name": name, "label": quantity.label, "column": quantity.column, "factor": factor, "unit": unit,
        "line": {key: value for key, value in trace["line"].items() if key != "color"},
    }  # fmt: skip


def _stations(of: Stations) -> dict[str, str]:
    return {name: _packed(getattr(of, name)) for name in ("md", "centre", "first", "second")}


def _packed(values: ArrayLike) -> str:
    """Numbers as base64 of little-endian float32."""
    array: NDArray[np.float32] = np.ascontiguousarray(values, "<f4")
    return base64.b64encode(array.tobytes()).decode("ascii")


def _json(content: dict[str, Any]) -> str:
    """JSON that no text in it can end the element of: a browser reads its ``<`` as text."""
    return json.dumps(content, allow_nan=False).replace("<", "\\u003c")
