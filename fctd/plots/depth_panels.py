"""Curves against depth in panels side by side, as a picture or as a page; what they show is another module's affair."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fctd.arrays import Array
from fctd.plots.palette import DASHES, PALETTE
from fctd.plots.style import LINE_STYLES, POINTS, RC, Sheet

if TYPE_CHECKING:
    import plotly.graph_objects as go

# Sizes [in]: of a panel, and of what stands beside and below it.
WIDTH, HEIGHT, LEFT, BETWEEN, RIGHT, BELOW = 3.7, 4.6, 0.8, 0.3, 0.2, 0.55
COLOURS = list(PALETTE.values())


class Curve(NamedTuple):
    """Values (n,) against depth (n,), in the units of the axes; its name, and the places of its colour and dash."""

    value: Array
    depth: Array
    name: str
    colour: int
    dash: int = 0


class Panel(NamedTuple):
    """A panel: the label of its values with their unit, and its curves."""

    label: str
    curves: list[Curve]


class Panels(NamedTuple):
    """Panels with one axis of depths: a title, lines of facts below it, the label of the depth, the panels."""

    title: str
    lines: list[str]
    depth: str
    panels: list[Panel]


def panels_figure(of: Panels) -> Figure:
    """The picture, with the legend of all curves below the panels."""
    named = _named(of.panels)
    handles = [Line2D([], [], label=name, **_look(curve)) for name, curve in named.items()]
    width = LEFT + len(of.panels) * (WIDTH + BETWEEN) - BETWEEN + RIGHT
    with mpl.rc_context(RC):
        sheet = Sheet(width, HEIGHT + BELOW, of.title, of.lines, handles)
        first = None
        for k, panel in enumerate(of.panels):
            ax = sheet.axes(
                LEFT + k * (WIDTH + BETWEEN), 0.0, WIDTH, HEIGHT, **({} if first is None else {"sharey": first})
            )
            for curve in panel.curves:
                ax.plot(curve.value, curve.depth, **_look(curve), marker="o" if len(curve.depth) == 1 else None)
            ax.set_xlabel(panel.label)
            if first is None:
                first = ax
                ax.set_ylabel(of.depth)
                ax.invert_yaxis()
            else:
                ax.tick_params(axis="y", labelleft=False)
    return sheet.figure


def panels_page(of: Panels) -> "go.Figure":
    """The same as a page, on which the pointer shows values."""
    import plotly.graph_objects as go
    from plotly.subplots import make_subplots

    from fctd.plots.page import with_heading
    from fctd.plots.traces import stroke

    figure = make_subplots(cols=len(of.panels), shared_yaxes=True, horizontal_spacing=0.04)
    seen: set[str] = set()
    for k, panel in enumerate(of.panels, start=1):
        for curve in panel.curves:
            look = stroke(COLOURS[curve.colour % len(COLOURS)], DASHES[curve.dash % len(DASHES)], 2.0)
            trace = go.Scatter(
                x=curve.value if len(curve.depth) else [None], y=curve.depth if len(curve.depth) else [None],
                name=curve.name, legendgroup=curve.name, line=look,
                mode="markers" if len(curve.depth) == 1 else "lines", showlegend=curve.name not in seen,
                hovertemplate=f"%{{y:.1f}}: %{{x:.4g}}<extra>{curve.name}</extra>",
            )  # fmt: skip
            seen.add(curve.name)
            figure.add_trace(trace, row=1, col=k)
        figure.update_xaxes(title_text=panel.label, row=1, col=k)
    figure.update_yaxes(autorange="reversed", row=1, col=1)
    figure.update_yaxes(title_text=of.depth, row=1, col=1)
    return with_heading(figure, of.title, of.lines, int(HEIGHT * POINTS * 1.6))


def _named(panels: Sequence[Panel]) -> dict[str, Curve]:
    """The first curve of each name."""
    named: dict[str, Curve] = {}
    for panel in panels:
        for curve in panel.curves:
            named.setdefault(curve.name, curve)
    return named


def _look(curve: Curve) -> dict[str, Any]:
    return {"color": COLOURS[curve.colour % len(COLOURS)], "linestyle": LINE_STYLES[curve.dash % len(LINE_STYLES)]}
