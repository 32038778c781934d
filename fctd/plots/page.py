"""Pages of steady strings that show values under the pointer: one file of HTML that needs no network.

Needs plotly, which the package installs as its extra ``html``.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from fctd.case.operations import KINDS
from fctd.plots.describe import describe
from fctd.plots.facts import heading_of_chart, heading_of_profile
from fctd.plots.loads import PLAIN, ChartLook, Compared
from fctd.plots.palette import EDGE, LOOKS, QUIET
from fctd.plots.traces import SHOE, SYMBOLS, TITLE, buckled, layout_of, plain, traces_of
from fctd.plots.tracks import TRACKS, SideForce, depth_ends, label_of, limits_near, limits_of_track, peaks_of, values_of
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import System, shown
from fctd.steady.steady_string import Equilibrium
from fctd.store.whole_file import whole_file

MARKS: Final = 12  # markers on a curve of a profile, which tell operations apart in grey
PANEL: Final = 560  # height of a row of panels [px]
LINE: Final = 18  # height of a line of the heading [px]
ABOVE: Final = 40  # height above the panels of a page, whose heading is text, and above what stands over them [px]
GROUP: Final = 24  # height of the name of a group [px]
# A page stays on its machine: plotly's own button would upload the chart.
CONFIG: Final = {"displaylogo": False, "modeBarButtonsToRemove": ["sendChartToCloud"]}
FOLDER: Final = Path(__file__).parent
VIEWPORT: Final = '<meta name="viewport" content="width=device-width, initial-scale=1">'


def save_page(figure: go.Figure, path: Path, refresh: float | None = None) -> list[Path]:
    """Write a page; returns the file.  Raises InputError where it cannot be written.

    refresh : time after which the page loads itself anew [s], of one that is replaced meanwhile.

    The heading of the figure becomes text that wraps, and its panels stand in rows that the window has room for.
    """
    drawn, style = go.Figure(figure), (FOLDER / "page.css").read_text(encoding="utf-8")
    heading = drawn.layout.meta or {}
    if heading:
        above = ABOVE + heading["over"]
        saved = drawn.layout.margin.t - above
        drawn.update_layout(title=None, meta=None, margin_t=above, height=drawn.layout.height - saved)
    lines = "".join(f"<p>{plain(line)}</p>" for line in heading.get("lines", ()))
    title = plain(heading.get("title", ""))
    with whole_file(path) as scratch:
        # A name of its own for the drawing would differ from run to run.
        text = drawn.to_html(
            include_plotlyjs=True, div_id="fctd", config=CONFIG, default_height=None,
            post_script=(FOLDER / "page.js").read_text(encoding="utf-8"),
        )  # fmt: skip
        head = VIEWPORT if refresh is None else f'{VIEWPORT}<meta http-equiv="refresh" content="{refresh:g}">'
        text = text.replace("</head>", f"{head}<title>{title}</title><style>{style}</style></head>", 1)
        text = text.replace("<body>", f"<body><header><h1>{title}</h1>{lines}</header>", 1)
        scratch.write_text(text, encoding="utf-8")
    return [path]


def chart_page(chart: pd.DataFrame, units: System = "si", case: Compared = None, look: ChartLook = PLAIN) -> go.Figure:
    """The chart of ``chart_figure`` as a page, with the same arguments; the pointer shows each row with its reason."""
    described = describe(chart, units, case, look)
    figure = go.Figure(traces_of(described), layout_of(described))
    title, lines = heading_of_chart(chart, units, case, look)
    over = TITLE + (GROUP if len(described.groups) > 1 else 0)
    return with_heading(figure, title, lines, PANEL * len(described.groups), over)


def profile_page(
    points: Sequence[Equilibrium],
    units: System = "si",
    *,
    force: SideForce = "length",
    warnings: Sequence[str] = (),
    sets: int = 1,
) -> go.Figure:
    """The profiles of ``profile_figure`` as a page, with the same arguments."""
    answers = [point for point in points if point.answered]
    figure = make_subplots(rows=1, cols=len(TRACKS), shared_yaxes=True, horizontal_spacing=0.012)
    near = limits_near(answers, units) if answers else {}
    for col, column in enumerate(TRACKS, start=1):
        place = {"row": 1, "col": col}
        name, unit = label_of(column, units, force)
        for point in answers:
            colour, marker = LOOKS[point.operation]
            md, value = values_of(point, column, units, force)
            label = KINDS[point.operation].label
            if COLUMNS[column].across and point is answers[0]:
                clearance = point.profile["clearance_m"].to_numpy(float) * shown(column, units).factor
                for side in (-clearance, clearance):
                    figure.add_trace(_line(side, md, "clearance", EDGE, "solid"), **place)
            if column == "effective_tension_N":
                for trace in buckled(value, md, point.profile["buckling"].to_numpy(str)):
                    figure.add_trace(go.Scatter(trace), **place)
            figure.add_trace(
                go.Scatter(
                    x=value, y=md, name=label, mode="lines+markers" if len(answers) > 1 else "lines",
                    line={"color": colour, "width": 1.6},
                    marker={"symbol": SYMBOLS[marker], "size": 7, "maxdisplayed": MARKS},
                    customdata=point.profile["buckling"],
                    hovertemplate=f"%{{y:.1f}}: %{{x:.4g}} {unit}, buckling %{{customdata}}<extra>{label}</extra>",
                ),
                **place,
            )  # fmt: skip
        if column == "effective_tension_N":
            for mode, (md, limit) in near.items():
                dash = "dash" if mode == "sinusoidal" else "dot"
                figure.add_trace(_line(limit, md, f"{mode} limit", QUIET, dash), **place)
        figure.update_xaxes(title_text=f"{name},<br>{unit}", title_font_size=11, nticks=4, tickangle=0, **place)
        if answers:
            ends = limits_of_track(answers, column, units, force, near)
            figure.update_xaxes(range=ends, **place)
            peaks = peaks_of(answers, column, units, force, ends)
            most = max((peak for *_, peak in peaks), default=0.0)
            for point, depth, peak in peaks:
                figure.add_trace(_peak(point, depth, peak, ends[1], unit, named=peak == most), **place)
        for shoe in points[0].case.shoes:
            if shoe < points[0].bit_depth:
                figure.add_hline(shoe * shown("md_m", units).factor, line=SHOE, **place)
        figure.update_yaxes(range=depth_ends(points, units), exponentformat="none", **place)
    figure.update_yaxes(title_text=f"{COLUMNS['md_m'].label}, {shown('md_m', units).label}", row=1, col=1)
    named: set[str] = set()
    for trace in figure.data:  # the legend has each name once
        trace.update(legendgroup=trace.name, showlegend=trace.name not in named)
        named.add(trace.name)
    title, lines = heading_of_profile(points, units, warnings, sets)
    return with_heading(figure, title, lines, PANEL + 100)


def _line(value: NDArray[np.float64], depth: NDArray[np.float64], name: str, colour: str, dash: str) -> go.Scatter:
    look = {"color": colour, "dash": dash, "width": 1.2}
    return go.Scatter(x=value, y=depth, name=name, mode="lines", line=look, hoverinfo="skip")


def _peak(point: Equilibrium, depth: float, value: float, edge: float, unit: str, *, named: bool) -> go.Scatter:
    """A value that the axis cuts; named : whether it stands beside its mark."""
    return go.Scatter(
        x=[edge], y=[depth], name="beyond the axis", mode="markers+text" if named else "markers",
        text=[f"{value:.3g}"], cliponaxis=False, textposition="middle left",
        marker={"symbol": "triangle-right", "size": 9, "color": LOOKS[point.operation][0]},
        hovertemplate=f"%{{y:.1f}}: %{{text}} {unit}<extra>{KINDS[point.operation].label}</extra>",
    )  # fmt: skip


def with_heading(figure: go.Figure, title: str, lines: Sequence[str], height: int, over: int = 0) -> go.Figure:
    """The figure with its title, the lines below it, and the legend below the panels; over : height of what stands over
    the panels [px].
    """
    top = 58 + LINE * (len(lines) + 1) + over
    small = "".join(f"<br><span style='font-size:12px;font-weight:normal'>{_wrapped(line)}</span>" for line in lines)
    extra = sum(_wrapped(line).count("<br>") for line in lines) * LINE
    title_text = f"<b>{plain(title)}</b>{small}"
    figure.update_layout(
        title={"text": title_text, "x": 0.01, "xanchor": "left", "y": 1, "yanchor": "top", "pad": {"t": 20}},
        # A page writes the same as text.
        meta={"title": title, "lines": list(lines), "over": over},
        height=height + top + extra + 80, margin={"t": top + extra, "l": 70, "r": 45, "b": 110},
        template="plotly_white", modebar={"orientation": "v"},  # beside the panels, not over the title
        legend={"orientation": "h", "y": 0, "yref": "container", "yanchor": "bottom"}, hovermode="closest",
    )  # fmt: skip
    return figure


def _wrapped(text: str, width: int = 150) -> str:
    """A plain text in lines of about ``width`` characters."""
    lines, room = [""], width
    for word in text.split(" "):
        if len(word) + 1 > room and lines[-1]:
            lines, room = [*lines, ""], width
        lines[-1] += f" {word}" if lines[-1] else word
        room -= len(word) + 1
    return "<br>".join(map(plain, lines))
