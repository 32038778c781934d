"""The pictures of a view as plotly's traces and layouts: the scene in three dimensions and the panels beside it.

Each trace has its look here, and the data of one string from ``scene_data`` and ``panel_data``; a page changes the data
alone.
"""

from functools import cached_property
from typing import Any, Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.systems import told
from fctd.plots.loads import as_load, usual_load
from fctd.plots.palette import DARK, EDGE, PALETTE, QUIET
from fctd.plots.traces import plain
from fctd.plots.tracks import lengths_of, side_force_unit
from fctd.results.buckling import MODES
from fctd.results.unit_systems import System, shown
from fctd.view.hole import clearance_at, exaggeration_of, rings, wall_lines
from fctd.view.quantities import QUANTITIES, Quantity
from fctd.view.strings import Snapshot, Strings

Trace = dict[str, Any]

# Names of the traces, in the order in which they are drawn.
SCENE: Final = ("wall", "rings", "shoes", "string", "contacts", "picked")
PANELS: Final = ("angle", "side force", "tension", "sinusoidal limit", "helical limit")
AIR: Final = 0.04  # of the span of an axis, beyond the values
BELOW_BAR: Final = 0.92  # of the height, which the axes have below the bar of colours
LEAST_SPAN: Final = 0.12  # of a side of the scene, as a share of the largest


class Look:
    """What a view has in common for all of its strings: units, exaggeration, ranges of axes and colours."""

    def __init__(self, strings: Strings, units: System = "si", exaggeration: float | None = None) -> None:
        self.strings, self.units = strings, units
        clearance = strings.typical_clearance
        self.exaggeration = exaggeration_of(strings.drawn.size, clearance) if exaggeration is None else exaggeration
        self.depth = shown("md_m", units)
        widest = [one.columns["clearance_m"].max(initial=0.0) for one in strings.snapshots]
        self.radius = self.exaggeration * max(widest, default=0.0)

    def ranges(self) -> tuple[Array, Array]:
        """Lower and upper end of the scene (3,) [m], north, east, down; no side is much shorter than the others."""
        centre = self.strings.drawn.lines.centre
        low, high = centre.min(axis=0) - 1.2 * self.radius, centre.max(axis=0) + 1.2 * self.radius
        lacking = np.maximum(LEAST_SPAN * (high - low).max() - (high - low), 0.0) / 2
        return low - lacking, high + lacking

    def limits(self, quantity: Quantity) -> tuple[float, float]:
        """Values of the first and the last colour, in the shown unit."""
        return quantity.limits(self._all(quantity.column) * quantity.shown(self.units).factor, self._lengths)

    def peak(self, quantity: Quantity) -> str:
        """The largest value of a quantity in words, where it lies beyond the scale; else empty."""
        values = self._all(quantity.column) * quantity.shown(self.units).factor
        most = float(np.nanmax(np.abs(values), initial=0.0))
        return f" (peak {most:.3g})" if quantity.scale != "modes" and most > self.limits(quantity)[1] else ""

    def span(self, quantity: Quantity) -> tuple[float, float]:
        """Ends of the axis of a panel, with zero; a peak does not set them."""
        values = np.append(self._all(quantity.column) * quantity.shown(self.units).factor, 0.0)
        most = max(map(abs, self.limits(quantity)))
        low, high = np.clip((values.min(), values.max()), -most, most).tolist()
        air = AIR * (high - low) or 1.0
        return (low - air if low < 0 else 0.0), high + air

    def _all(self, column: str) -> Array:
        """A column of all strings."""
        return np.concatenate([np.empty(0), *(one.columns[column] for one in self.strings.snapshots)])

    @cached_property
    def _lengths(self) -> Array:
        """Lengths of string that belong to the contact points of all strings."""
        return np.concatenate([np.empty(0), *(lengths_of(one.columns["md_m"]) for one in self.strings.snapshots)])


def scene_traces(look: Look, quantity: Quantity) -> list[Trace]:
    """The traces of the scene without data, in the order of ``SCENE``."""
    low, high = look.limits(quantity)
    unit = quantity.shown(look.units).label
    title = f"{quantity.label}{f', {unit}' if unit else ''}{look.peak(quantity)}"
    bar: dict[str, Any] = {
        "title": {"text": title, "side": "top", "font": {"size": 11}},
        "thickness": 10, "len": 0.5, "orientation": "h", "x": 0.02, "xanchor": "left", "y": 0.99, "yanchor": "top",
    }  # fmt: skip
    if quantity.scale == "modes":
        bar |= {"tickvals": list(range(len(MODES))), "ticktext": list(MODES)}
    string = {
        "line": {
            "width": 7, "color": [], "cmin": low, "cmax": high, "colorscale": [list(c) for c in quantity.colours(low)],
            "showscale": True, "colorbar": bar,
        },
        "hovertemplate": "%{text}<extra></extra>", "text": [],
    }  # fmt: skip
    quiet = {"hoverinfo": "skip"}
    looks: dict[str, Trace] = {
        "wall": {"line": {"width": 1, "color": "#8d97a1"}, **quiet},
        "rings": {"line": {"width": 1, "color": "#b4bcc4"}, **quiet},
        "shoes": {"line": {"width": 6, "color": DARK}, **quiet},
        "string": string,
        "contacts": {
            "mode": "markers", "marker": {"size": 2.5, "color": "#000000", "symbol": "circle-open"}, "text": [],
            "hovertemplate": "%{text}<extra></extra>",
        },
        "picked": {
            "mode": "markers", "marker": {"size": 9, "color": PALETTE["sky"], "line": {"color": "black", "width": 2}},
            **quiet,
        },
    }  # fmt: skip
    empty: Trace = {"type": "scatter3d", "mode": "lines", "x": [], "y": [], "z": [], "showlegend": False}
    return [{**empty, "name": name, **looks[name]} for name in SCENE]


def scene_data(look: Look, one: Snapshot, *, hole: bool = True) -> dict[str, Array]:
    """Places (m, 3) [m] of the traces of the scene for one string; hole : whether those of the hole are wanted."""
    drawn, times = look.strings.drawn, look.exaggeration
    md, clearance = one.columns["md_m"], one.columns["clearance_m"]

    def radius(at: Array) -> Array:
        return times * clearance_at(at, md, clearance)

    axis = drawn.hole.at(md)[0] if len(md) else np.empty((0, 3))
    string = axis + times * one.offset
    around = {
        "wall": wall_lines(drawn.lines, radius(drawn.lines.md)),
        "rings": rings(drawn.rings, radius(drawn.rings.md)),
        "shoes": rings(drawn.shoes, radius(drawn.shoes.md)),
    } if hole else {}  # fmt: skip
    return {
        **around,
        "string": string,
        "contacts": string[one.touching],
        "picked": np.empty((0, 3)),
    }


def scene_layout(look: Look) -> dict[str, Any]:
    """The layout of the scene: axes to scale, depth downwards, names of the shoes."""
    low, high = look.ranges()
    span, factor = high - low, look.depth.factor
    names = ("north", "east", "depth")

    def axis(k: int) -> dict[str, Any]:
        ends = [low[k], high[k]] if k < 2 else [high[k], low[k]]
        ticks = _ticks(low[k], high[k], factor)
        return {
            "title": {"text": f"{names[k]}, {look.depth.label}", "font": {"size": 11}}, "range": ends,
            "tickvals": ticks, "ticktext": [f"{tick * factor:z.0f}" for tick in ticks], "tickfont": {"size": 10},
            "backgroundcolor": "#ffffff", "gridcolor": "#e8e8e8", "showspikes": False, "zeroline": False,
        }  # fmt: skip

    shoes = look.strings.drawn.shoes
    label = look.depth.label
    notes = [
        {
            "x": float(x), "y": float(y), "z": float(z), "text": f"shoe {md * factor:.0f} {label}",
            "font": {"size": 11}, "showarrow": True, "arrowwidth": 1, "arrowhead": 0, "ax": 45, "ay": 0,
            "arrowcolor": QUIET,
        }
        for md, (x, y, z) in zip(shoes.md, shoes.centre, strict=True)
    ]  # fmt: skip
    ratio = span / span.max()
    return {
        "xaxis": axis(0), "yaxis": axis(1), "zaxis": axis(2), "aspectmode": "manual",
        "aspectratio": dict(zip("xyz", ratio.tolist(), strict=True)), "annotations": notes,
        "camera": whole_well(look), "dragmode": "orbit", "uirevision": "fixed", "domain": {"y": [0.0, BELOW_BAR]},
    }  # fmt: skip


def whole_well(look: Look) -> dict[str, Any]:
    """A camera that looks at the whole well from the side on which it departs least."""
    centre = look.strings.drawn.lines.centre
    north, east = centre[-1, :2] - centre[0, :2]
    away = np.hypot(north, east)
    across = np.array([-east, north]) / away if away > 1.0 else np.array([1.0, 0.0])
    eye = 1.55 * across
    return {
        "eye": {"x": float(eye[0]), "y": float(eye[1]), "z": 0.35}, "up": {"x": 0, "y": 0, "z": 1},
        "center": {"x": 0, "y": 0, "z": -0.05},
    }  # fmt: skip


def panel_traces(look: Look, quantity: Quantity) -> list[Trace]:
    """The traces of the panels without data, in the order of ``PANELS``."""
    low, high = look.limits(quantity)
    depth, force, tension = look.depth.label, side_force_unit(look.units, "length"), shown("hookload_N", look.units)
    looks: dict[str, Trace] = {
        "angle": {
            "mode": "markers", "hovertemplate": f"%{{y:.1f}} {depth}: %{{x:.0f}}°<extra>touches</extra>",
            "marker": {
                "size": 6, "color": [], "cmin": low, "cmax": high, "line": {"width": 0.5, "color": "black"},
                "colorscale": [list(colour) for colour in quantity.colours(low)],
            },
        },
        "side force": {
            "line": {"color": PALETTE["vermilion"], "width": 1.5, "shape": "vhv"}, "fill": "tozerox",
            "hovertemplate": f"%{{y:.1f}} {depth}: %{{x:.4g}} {force.label}<extra></extra>",
        },
        "tension": {
            "line": {"color": PALETTE["blue"], "width": 1.8},
            "hovertemplate": f"%{{y:.1f}} {depth}: %{{x:.4g}} {tension.label}<extra></extra>",
        },
        "sinusoidal limit": {"line": {"color": QUIET, "width": 1.2, "dash": "dash"}, "hoverinfo": "skip"},
        "helical limit": {"line": {"color": QUIET, "width": 1.2, "dash": "dot"}, "hoverinfo": "skip"},
    }  # fmt: skip
    axes = {"angle": "", "side force": "2"}
    return [
        {
            "type": "scatter", "mode": "lines", "x": [], "y": [], "name": name, "showlegend": name.endswith("limit"),
            "xaxis": f"x{axes.get(name, '3')}", "yaxis": "y", **looks[name],
        }
        for name in PANELS
    ]  # fmt: skip


def panel_data(look: Look, one: Snapshot) -> dict[str, tuple[Array, Array]]:
    """Values and depths of the traces of the panels for one string, in shown units."""
    values, at = one.columns, one.touching
    md, tension = values["md_m"] * look.depth.factor, shown("hookload_N", look.units).factor
    force = side_force_unit(look.units, "length").factor
    return {
        "angle": (unrolled(values["contact_angle_deg"][at]), md[at]),
        "side force": (values["side_force"] * force, md),
        "tension": (values["effective_tension_N"] * tension, md),
        "sinusoidal limit": (_finite(-values["sinusoidal_limit_N"] * tension), md),
        "helical limit": (_finite(-values["helical_limit_N"] * tension), md),
    }


def panel_layout(look: Look) -> dict[str, Any]:
    """The layout of the panels: one axis of depth, three of values."""
    low, high = (float(end) * look.depth.factor for end in look.strings.drawn.lines.md[[0, -1]])
    force, tension = QUANTITIES["side_force"].shown(look.units), shown("hookload_N", look.units)
    titles = (
        "where it touches, °<br>0 high, 90 right, 180 low side",
        f"side force per length,<br>{force.label}{look.peak(QUANTITIES['side_force'])}",
        f"tension and its limits,<br>{tension.label}",
    )
    spans = (
        (-95.0, 275.0),
        look.span(QUANTITIES["side_force"]),
        look.span(QUANTITIES["tension"]),
    )
    layout: dict[str, Any] = {
        "yaxis": {
            "title": {"text": f"measured depth, {look.depth.label}", "font": {"size": 11}}, "range": [high, low],
            "exponentformat": "none", "tickfont": {"size": 10},
        },
        "shapes": [
            {
                "type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": md * look.depth.factor,
                "y1": md * look.depth.factor, "line": {"color": EDGE, "width": 1, "dash": "dot"},
            }
            for md in look.strings.drawn.shoes.md.tolist()
        ],
        "legend": {"orientation": "h", "x": 1, "xanchor": "right", "y": 1.0, "yanchor": "bottom", "font": {"size": 10}},
        "uirevision": "fixed", "hovermode": "closest", "margin": {"l": 58, "r": 10, "t": 30, "b": 48},
    }  # fmt: skip
    width = 1 / 3
    for k, (title, ends) in enumerate(zip(titles, spans, strict=True)):
        layout[f"xaxis{k + 1 if k else ''}"] = {
            "title": {"text": title, "font": {"size": 11}}, "range": list(ends), "anchor": "y", "nticks": 5,
            "domain": [k * width + (0.03 if k else 0.0), (k + 1) * width], "tickfont": {"size": 10}, "tickangle": 0,
        }  # fmt: skip
    layout["xaxis"] |= {"tickvals": [-90, 0, 90, 180], "zeroline": False}
    return layout


def hover_texts(look: Look, one: Snapshot) -> list[str]:
    """What the pointer shows of each contact point (n,)."""
    lines = []
    for k, md in enumerate(one.columns["md_m"] * look.depth.factor):
        parts = [f"{md:.1f} {look.depth.label}"]
        for quantity in QUANTITIES.values():
            factor, unit = quantity.shown(look.units)
            value = one.columns[quantity.column][k]
            text = MODES[int(value)] if quantity.scale == "modes" else f"{value * factor:.4g} {unit}"
            parts.append(f"{quantity.label} {text}")
        lines.append("<br>".join(parts))
    return lines


class Drawn(NamedTuple):
    """The data of one string: points of the traces of scene and panels, and of each contact point what the pointer
    shows and what colours it [shown unit]; of those that touch apart."""

    places: dict[str, Array]
    panels: dict[str, tuple[Array, Array]]
    texts: list[str]
    values: Array
    texts_touching: list[str]
    values_touching: Array


def drawn_of(look: Look, one: Snapshot, quantity: Quantity, *, hole: bool = True) -> Drawn:
    """All data of one string; hole : whether those of the hole are among them."""
    texts, values = hover_texts(look, one), one.columns[quantity.column] * quantity.shown(look.units).factor
    touching = [text for text, at in zip(texts, one.touching, strict=True) if at]
    places, panels = scene_data(look, one, hole=hole), panel_data(look, one)
    return Drawn(places, panels, texts, values, touching, values[one.touching])


def caption_of(look: Look, one: Snapshot) -> str:
    """Hook load and torque of a string, or why it has none; as HTML."""
    load, torque = shown("hookload_N", look.units), shown("surface_torque_N_m", look.units)
    words = []
    if np.isfinite(one.hookload):
        words += [f"hook load {one.hookload * load.factor:z.1f} {load.label}{_on_indicator(look, one)}"]
        words += [f"torque {one.torque * torque.factor:z.2f} {torque.label}"]
    if len(one.offset):
        words += [f"{int(one.touching.sum())} of {len(one.offset)} points touch"]
        stretch = (float(one.columns["md_m"][-1]) - one.bit_depth) * look.depth.factor
        if round(stretch) > 0:
            words += [f"the bit {stretch:.1f} {look.depth.label} deeper by stretch"]
    return plain("; ".join([*words, *([told(one.status, look.units)] if one.status else [])]))


def _on_indicator(look: Look, one: Snapshot) -> str:
    """What the indicator reads of a steady string where the case says what the block weighs; else empty."""
    case, load = look.strings.case, shown("hookload_N", look.units)
    if look.strings.along != "bit depth" or usual_load([case]) == "string":
        return ""
    (read,) = as_load(case, one.operation, np.array([one.hookload]), "indicator")
    return f" ({read * load.factor:z.1f} {load.label} on the indicator)"


def unrolled(angle: Array) -> Array:
    """Angles [°] from −90 to 270: high and low side both lie within the unrolled hole, not at its edges."""
    return np.where(angle > 270.0, angle - 360.0, angle)


def _ticks(low: float, high: float, factor: float) -> list[float]:
    """Places of ticks, round numbers in the shown unit, [m]."""
    span = (high - low) * factor
    power = 10.0 ** np.floor(np.log10(span / 4))
    step = next(step * power for step in (1, 2, 5, 10) if step * power >= span / 5)
    first = np.ceil(low * factor / step)
    return [float(k * step / factor) for k in np.arange(first, np.floor(high * factor / step) + 1)]


def _finite(values: Array) -> Array:
    return np.where(np.isfinite(values), values, np.nan)
