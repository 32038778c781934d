"""A chart as plotly takes it: traces and layout as plain tables, for pages and the live page."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from html import escape
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from fctd.case.operations import KINDS
from fctd.case.text import printable
from fctd.plots.description import Curve, Description, Key, Panel
from fctd.plots.limit_lines import LimitLine
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, MEASURED, QUIET, SHADE, SOLID, Dash

Trace = dict[str, Any]

# Plotly's names of the markers of pictures.
SYMBOLS: Final = {
    "^": "triangle-up", "o": "circle", "v": "triangle-down", "D": "diamond", "s": "square", "P": "cross",
    "p": "pentagon",
}  # fmt: skip
SHOE: Final = {"color": QUIET, "dash": "dot", "width": 1}
CLEAR: Final = "rgba(0,0,0,0)"
WIDTH, LIMIT_WIDTH = 2.0, 1.5  # of lines [px]
DOMAINS: Final = ((0.0, 0.57), (0.61, 1.0))  # of loads and torques
BETWEEN: Final = 0.3  # share of the height that groups leave between them, all together
TITLE: Final = 46  # height of an axis of loads with its title, which stand above a panel [px]
HIGHEST: Final = 0.06  # share of the depths within which the name of a shoe stands below its line
LINE, LONGEST = 60, 300  # characters of a line and of a text under the pointer


def traces_of(described: Description) -> list[Trace]:
    """The traces of a chart, first those of the legend, which has each name once."""
    found, names = [_key(key) for key in described.keys], set[str]()
    panels = [panel for group in described.groups for panel in group.panels]
    for k, panel in enumerate(panels, start=1):
        axes = {"xaxis": f"x{k if k > 1 else ''}", "yaxis": f"y{k if k > 1 else ''}"}
        for trace in _panel(panel):
            name = trace["name"]
            new = "showlegend" not in trace and name not in names
            names.add(name)
            found.append({"type": "scatter", "legendgroup": name, "showlegend": new, **axes, **trace})
    return found


def _key(key: Key) -> Trace:
    """A look of curves in the legend, which hides them and shows them again."""
    symbol = {"mode": "lines+markers", "marker": {"symbol": SYMBOLS[key.marker], "size": 8}} if key.marker else {}
    return {
        "type": "scatter", "x": [None], "y": [None], "mode": "lines", "name": plain(key.name), "hoverinfo": "skip",
        "legendgroup": plain(key.name), "line": stroke(key.colour, key.dash, WIDTH), **symbol,
    }  # fmt: skip


def layout_of(described: Description) -> dict[str, Any]:
    """Axes, names of groups, shoes and spans of a chart."""
    rows, depth = len(described.groups), described.depth
    apart = min(0.12, BETWEEN / rows)
    height = (1.0 - apart * (rows - 1)) / rows
    layout: dict[str, Any] = {"shapes": [], "annotations": [], "hovermode": "closest"}
    for row, group in enumerate(described.groups):
        bottom = 1.0 - height - row * (height + apart)
        if group.name:
            layout["annotations"].append({
                "text": plain(group.name), "xref": "paper", "yref": "paper", "x": 0, "y": bottom + height,
                "xanchor": "left", "yanchor": "bottom", "yshift": TITLE, "showarrow": False,
            })  # fmt: skip
        for col, panel in enumerate(group.panels):
            number = 2 * row + col + 1
            k = str(number) if number > 1 else ""
            layout[f"xaxis{k}"] = {
                "title": {"text": panel.label}, "range": [panel.limits.low, panel.limits.high],
                "domain": list(DOMAINS[col]), "anchor": f"y{k}", "side": "top", "nticks": 5, "tickangle": 0,
                "zeroline": False,
            }  # fmt: skip
            layout[f"yaxis{k}"] = {
                "range": [depth.lower, depth.upper], "domain": [bottom, min(bottom + height, 1.0)], "anchor": f"x{k}",
                "exponentformat": "none", "zeroline": False,
                **({"matches": "y"} if number > 1 else {}),
                **({"showticklabels": False} if col else {"title": {"text": depth.label}}),
            }  # fmt: skip
            _mark(layout, described, panel, k, named=col == 1)
    return layout


def _mark(layout: dict[str, Any], described: Description, panel: Panel, k: str, *, named: bool) -> None:
    """Add shoes, names of intervals and the span of loads at which slack-off is spent."""
    across, depth = {"xref": f"x{k} domain", "yref": f"y{k}"}, described.depth
    # One above it would stand over the axis.
    highest = depth.upper + HIGHEST * (depth.lower - depth.upper)
    for mark in described.marks:
        if mark.shoe:
            ends = {"x0": 0, "x1": 1, "y0": mark.depth, "y1": mark.depth}
            layout["shapes"].append({"type": "line", **across, **ends, "line": SHOE})
        if named:
            layout["annotations"].append({
                "text": ", ".join(map(plain, mark.lines)), **across, "x": 1, "y": mark.depth, "xanchor": "right",
                "yanchor": "bottom" if mark.depth > highest else "top", "showarrow": False,
                "font": {"size": 11, "color": QUIET},
            })  # fmt: skip
    if panel.spent is not None:
        layout["shapes"].append({
            "type": "rect", "xref": f"x{k}", "yref": f"y{k} domain", "x0": panel.limits.low, "x1": panel.spent, "y0": 0,
            "y1": 1, "fillcolor": SHADE, "line": {"width": 0}, "layer": "below",
        })  # fmt: skip
        layout["annotations"].append({
            "text": "slack-off is spent", "xref": f"x{k}", "yref": f"y{k} domain", "x": panel.limits.low, "y": 0,
            "xanchor": "left", "yanchor": "bottom", "xshift": 10, "showarrow": False,
        })  # fmt: skip


def _panel(panel: Panel) -> Iterator[Trace]:
    """The traces of a panel."""
    for curve in panel.curves:
        yield from _curve(curve, panel.unit)
    for points in panel.points:
        left, right = points.bars
        look = {
            "symbol": SYMBOLS[LOOKS[points.operation][1]], "size": 10, "color": MEASURED,
            "line": {"color": "black", "width": 1.5},
        }  # fmt: skip
        yield {
            "x": points.middle, "y": points.depth, "mode": "markers", "name": points.name, "marker": look,
            "error_x": {"type": "data", "symmetric": False, "array": right, "arrayminus": left, "color": "black"},
            "hovertemplate": _shown(panel.unit, "", points.name),
        }  # fmt: skip
    for line in panel.lines:
        yield _limit(line, panel.unit)


def _curve(curve: Curve, unit: str) -> Iterator[Trace]:
    """The line of a curve, the marks of its buckled rows, of loads beyond the axis, and of rows without loads."""
    colour, marker = curve.look
    # The legend names operation or case, and the dashes of the factors once for all.
    name, symbol = plain(curve.key), SYMBOLS[marker]
    full, texts = plain(curve.name.full), [_wrapped(text) for text in curve.texts]
    yield from buckled(curve.line, curve.depth, curve.modes)
    # The pointer finds every row, with a marker or without; sizes of 0 would make markers of the legend small too.
    seen = curve.marks | curve.care
    yield {
        "x": curve.line, "y": curve.depth, "mode": "lines+markers", "name": name, "text": texts, "showlegend": False,
        "line": stroke(colour, curve.dash, WIDTH * curve.width),
        "marker": {
            "symbol": [f"{symbol}-open" if care else symbol for care in curve.care], "size": 8,
            "color": [colour if at else CLEAR for at in seen],
        },
        "hovertemplate": _shown(unit, "%{text}", full),
    }  # fmt: skip
    low, high = curve.beyond
    known, limits = f"%{{customdata:.4g}} {unit}", curve.limits
    for at, side, end, face, what, load in (
        (low, "left", limits.low, "white", "beyond the axis", known),
        (high, "right", limits.high, "white", "beyond the axis", known),
        (curve.stuck, "left", limits.low, colour, "no push suffices", ""),
    ):
        if at.any():
            look = {"symbol": f"triangle-{side}", "size": 9, "color": face, "line": {"color": colour, "width": 1.5}}
            yield {
                "x": np.full(at.sum(), end), "y": curve.depth[at], "mode": "markers", "cliponaxis": False, "name": what,
                "marker": look, "customdata": curve.value[at], "text": _of(texts, at),
                "hovertemplate": f"%{{y:.1f}}: {load}%{{text}}<extra>{full}</extra>",
            }  # fmt: skip
    at, place = curve.lost
    if at.any():
        yield {
            "x": place[at], "y": curve.depth[at], "mode": "markers", "name": "no loads", "text": _of(texts, at),
            "marker": {"symbol": "x-thin", "size": 9, "line": {"color": colour, "width": 2}},
            "hovertemplate": f"%{{y:.1f}}: %{{text}}<extra>{full}</extra>",
        }  # fmt: skip
    apart = np.isfinite(curve.low)
    if apart.any():
        gap = np.full(apart.sum(), np.nan)
        yield {
            "x": np.column_stack((curve.low[apart], curve.high[apart], gap)).ravel(),
            "y": np.repeat(curve.depth[apart], 3), "mode": "lines", "name": "hook loads of both shapes",
            "line": {"color": colour, "width": 4}, "opacity": 0.4, "hoverinfo": "skip",
        }  # fmt: skip


def buckled(value: NDArray[np.float64], depth: NDArray[np.float64], modes: NDArray[np.str_]) -> Iterator[Trace]:
    """Grey discs below the buckled rows of a line, by mode."""
    for mode, grey in BUCKLED.items():
        at = modes == mode
        if at.any():
            yield {
                "x": value[at], "y": depth[at], "mode": "markers", "hoverinfo": "skip", "name": f"{mode} buckling",
                "marker": {"size": 13, "color": grey, "line": {"color": EDGE, "width": 1}},
            }  # fmt: skip


def _limit(line: LimitLine, unit: str) -> Trace:
    """A limit of an operation; the legend has each limit once."""
    return {
        "x": line.value, "y": line.depth, "mode": "lines", "name": line.name,
        "line": stroke(LOOKS[line.operation][0], line.dash, LIMIT_WIDTH),
        "hovertemplate": _shown(unit, "", f"{line.name}, {KINDS[line.operation].label}"),
    }  # fmt: skip


def stroke(colour: str, dash: Dash, width: float) -> dict[str, Any]:
    """A line; width [px]."""
    pixels = "solid" if dash == SOLID else ",".join(f"{part * width:g}px" for part in dash)
    return {"color": colour, "dash": pixels, "width": width}


def plain(text: str) -> str:
    """A text from outside as a page shows it: neither tags nor formulas."""
    return escape(printable(text)).replace("$", "&#36;")


def _shown(unit: str, text: str, name: str) -> str:
    """What the pointer shows of a row."""
    return f"%{{y:.1f}}: %{{x:.4g}} {unit}{text}<extra>{name}</extra>"


@lru_cache(maxsize=1024)
def _wrapped(text: str) -> str:
    """What the pointer says of a row, in lines that begin below its numbers."""
    cut = text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
    return "".join(f"<br>{plain(cut[k : k + LINE])}" for k in range(0, len(cut), LINE))


def _of(texts: Sequence[str], at: NDArray[np.bool_]) -> list[str]:
    return [texts[k] for k in np.flatnonzero(at).tolist()]
