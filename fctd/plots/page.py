"""Pages of steady strings that show values under the pointer: one file of HTML that needs no network.

Needs plotly, which the package installs as its extra ``html``.
"""

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.text import printable
from fctd.plots.facts import heading_of_chart, heading_of_profile
from fctd.plots.limit_lines import LimitLine, limit_lines
from fctd.plots.loads import (
    LOAD_COLUMNS,
    NAMES,
    PLAIN,
    TORQUE,
    ChartLook,
    Limits,
    groups_of,
    limits_of_load,
    limits_of_torque,
    marked,
    measured_columns,
    names_of,
    spent_at,
)
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, MEASURED, QUIET, SHADE
from fctd.plots.tracks import TRACKS, SideForce, label_of, limits_near, limits_of_track, values_of
from fctd.results.columns import COLUMNS, DEPTH
from fctd.results.series import Series, frictions_of, series_of
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown
from fctd.steady.steady_string import Equilibrium
from fctd.store.whole_file import whole_file

# Plotly's names of the markers and dashes of pictures.
SYMBOLS: Final = {
    "^": "triangle-up", "o": "circle", "v": "triangle-down", "D": "diamond", "s": "square", "P": "cross",
    "p": "pentagon",
}  # fmt: skip
DASHES: Final = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
MARKS: Final = 12  # markers on a curve of a profile, which tell operations apart in grey
SHOE: Final = {"color": QUIET, "dash": "dot", "width": 1}
CLEAR: Final = "rgba(0,0,0,0)"
PANEL: Final = 560  # height of a row of panels [px]
LINE: Final = 18  # height of a line of the heading [px]
ABOVE: Final = 40  # height above the panels of a page, whose heading is text [px]
# A page stays on its machine: plotly's own button would upload the chart.
CONFIG: Final = {"displaylogo": False, "modeBarButtonsToRemove": ["sendChartToCloud"]}
FOLDER: Final = Path(__file__).parent
VIEWPORT: Final = '<meta name="viewport" content="width=device-width, initial-scale=1">'


def save_page(figure: go.Figure, path: Path) -> list[Path]:
    """Write a page; returns the file.  Raises InputError where it cannot be written.

    The heading of the figure becomes text that wraps, and its panels stand in rows that the window has room for.
    """
    drawn, style = go.Figure(figure), (FOLDER / "page.css").read_text(encoding="utf-8")
    heading = drawn.layout.meta or {}
    if heading:
        # The room above the panels, but for the titles of their groups.
        saved = drawn.layout.margin.t - ABOVE
        drawn.update_layout(title=None, meta=None, margin_t=ABOVE, height=drawn.layout.height - saved)
    lines = "".join(f"<p>{plain(line)}</p>" for line in heading.get("lines", ()))
    title = plain(heading.get("title", ""))
    with whole_file(path) as scratch:
        # A name of its own for the drawing would differ from run to run.
        text = drawn.to_html(
            include_plotlyjs=True, div_id="fctd", config=CONFIG, default_height=None,
            post_script=(FOLDER / "page.js").read_text(encoding="utf-8"),
        )  # fmt: skip
        text = text.replace("</head>", f"{VIEWPORT}<title>{title}</title><style>{style}</style></head>", 1)
        text = text.replace("<body>", f"<body><header><h1>{title}</h1>{lines}</header>", 1)
        scratch.write_text(text, encoding="utf-8")
    return [path]


def chart_page(
    chart: pd.DataFrame, units: System = "si", case: Case | None = None, look: ChartLook = PLAIN
) -> go.Figure:
    """The chart of ``chart_figure`` as a page, with the same arguments; the pointer shows each row with its reason."""
    groups, load, measured = groups_of(series_of(chart, units)), look.load, look.measured
    columns = LOAD_COLUMNS[load], TORQUE
    drawn = [limit_lines(look.margins, case, load, column) for column in columns]
    values = [[line.value for line in lines] for lines in drawn]
    limits = (
        limits_of_load(chart, case, load, units, measured, values[0]),
        limits_of_torque(chart, units, measured, values[1]),
    )
    titles = [words for name, _ in groups for words in (name, "")]
    figure = make_subplots(
        rows=len(groups), cols=2, shared_yaxes=True, column_widths=[0.58, 0.42], horizontal_spacing=0.04,
        vertical_spacing=min(0.12, 0.3 / len(groups)), subplot_titles=titles if len(groups) > 1 else None,
    )  # fmt: skip
    named: set[str] = set()
    every = series_of(chart, units)
    names = {(one.operation, one.friction): name for one, name in zip(every, names_of(every), strict=True)}
    for row, (_, group) in enumerate(groups, start=1):
        for col, (column, limit) in enumerate(zip(columns, limits, strict=True), start=1):
            place = {"row": row, "col": col}
            frictions = frictions_of(group)
            for k, one in enumerate(group):
                dash = DASHES[frictions.index(one.friction) % len(DASHES)]
                # Beside the edge of the axis, those of each curve beside those of the others.
                edge = limit.low + (0.015 + 0.025 * k) * (limit.high - limit.low)
                for trace in _curve(one, names[one.operation, one.friction], column, dash, units, limit, edge, named):
                    figure.add_trace(trace, **place)
            if measured is not None:
                # A trace without points would take the name in the legend, and plotly does not show it.
                has_points = set(measured["operation"])
                for kind in dict.fromkeys(one.operation for one in group if one.operation in has_points):
                    figure.add_trace(_measured(look, kind, column, units, named), **place)
            for line in drawn[col - 1]:
                if line.operation in {one.operation for one in group}:
                    figure.add_trace(_limit(line, column, units, named), **place)
            label = f"{NAMES[column]}, {shown(column, units).label}"
            figure.update_xaxes(title_text=label, range=[limit.low, limit.high], **place)
            for shoe in [] if case is None else case.shoes:
                if chart["bit_depth_m"].min() <= shoe <= chart["bit_depth_m"].max():
                    at = shoe * shown(DEPTH.name, units).factor
                    words = {"annotation_text": f"shoe {at:.0f} {shown(DEPTH.name, units).label}"} if col == 2 else {}
                    figure.add_hline(at, line=SHOE, **words, **place)
        if limits[0].cut:
            spent = spent_at(case, load) * shown(columns[0], units).factor
            figure.add_vrect(
                limits[0].low, spent, fillcolor=SHADE, line_width=0, layer="below", row=row, col=1,
                annotation_text="slack-off is spent", annotation_position="top left",
            )  # fmt: skip
        figure.update_yaxes(
            title_text=f"{DEPTH.label}, {shown(DEPTH.name, units).label}", exponentformat="none", row=row, col=1
        )
        figure.update_yaxes(autorange="reversed", row=row)
    title, lines = heading_of_chart(chart, units, case, look.rates, look.warnings)
    return with_heading(figure, title, lines, PANEL * len(groups))


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
    named: set[str] = set()
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
                    legend = _new("clearance", named)
                    figure.add_trace(_line(side, md, "clearance", EDGE, "solid", legend=legend), **place)
            if column == "effective_tension_N":
                for trace in _buckled(value, md, point.profile["buckling"], named):
                    figure.add_trace(trace, **place)
            figure.add_trace(
                go.Scatter(
                    x=value, y=md, name=label, legendgroup=label, showlegend=col == 1,
                    mode="lines+markers" if len(answers) > 1 else "lines", line={"color": colour, "width": 1.6},
                    marker={"symbol": SYMBOLS[marker], "size": 7, "maxdisplayed": MARKS},
                    customdata=point.profile["buckling"],
                    hovertemplate=f"%{{y:.1f}}: %{{x:.4g}} {unit}, buckling %{{customdata}}<extra>{label}</extra>",
                ),
                **place,
            )  # fmt: skip
        if column == "effective_tension_N":
            for mode, (md, limit) in near.items():
                dash = "dash" if mode == "sinusoidal" else "dot"
                figure.add_trace(_line(limit, md, f"{mode} limit", QUIET, dash, legend=True), **place)
        figure.update_xaxes(title_text=f"{name},<br>{unit}", title_font_size=11, nticks=4, tickangle=0, **place)
        if answers:
            figure.update_xaxes(range=limits_of_track(answers, column, units, force, near), **place)
        for shoe in points[0].case.shoes:
            if shoe < points[0].bit_depth:
                figure.add_hline(shoe * shown("md_m", units).factor, line=SHOE, **place)
        figure.update_yaxes(autorange="reversed", exponentformat="none", **place)
    figure.update_yaxes(title_text=f"{COLUMNS['md_m'].label}, {shown('md_m', units).label}", row=1, col=1)
    title, lines = heading_of_profile(points, units, warnings, sets)
    return with_heading(figure, title, lines, PANEL + 100)


def _curve(
    one: Series, name: str, column: str, dash: str, units: System, limits: Limits, edge: float, named: set[str]
) -> Iterator[go.Scatter]:
    """The line of a series, the marks of its buckled rows, of loads beyond the axis, and of rows without loads.

    edge : where rows without loads stand that lie in no gap of the line.
    """
    rows, (colour, marker) = one.rows, LOOKS[one.operation]
    factor, unit = shown(column, units)
    depth = rows["bit_depth_m"].to_numpy(float) * shown(DEPTH.name, units).factor
    value = rows[column].to_numpy(float) * factor
    status = rows["status"].to_numpy(str)
    texts = [
        f"{status}; buckling {mode}" + ("" if reason == "none" else f"<br>{_wrapped(reason)}")
        for status, mode, reason in zip(status, rows["buckling"], rows["reason"], strict=True)
    ]
    symbols = [SYMBOLS[marker] + ("" if s == SteadyStatus.CONVERGED else "-open") for s in status]
    yield from _buckled(value, depth, rows["buckling"], named)
    # The pointer finds every row, with a marker or without; sizes of 0 would make markers of the legend small too.
    colours = np.where(marked(value) | (status != SteadyStatus.CONVERGED), colour, CLEAR)
    yield go.Scatter(
        x=value, y=depth, name=name, legendgroup=name, showlegend=_new(name, named), mode="lines+markers",
        line={"color": colour, "dash": dash, "width": 2}, text=texts,
        marker={"symbol": symbols, "size": 8, "color": colours},
        hovertemplate=f"%{{y:.1f}}: %{{x:.4g}} {unit}<br>%{{text}}<extra>{name}</extra>",
    )  # fmt: skip
    for side, at in (("left", value < limits.low), ("right", value > limits.high)):
        if at.any():
            label, end = "beyond the axis", limits.low if side == "left" else limits.high
            look = {"symbol": f"triangle-{side}", "size": 9, "color": "white", "line": {"color": colour, "width": 1.5}}
            yield go.Scatter(
                x=np.full(at.sum(), end), y=depth[at], name=label, legendgroup=label, showlegend=_new(label, named),
                mode="markers", cliponaxis=False, marker=look, customdata=value[at],
                text=[texts[k] for k in np.flatnonzero(at)],
                hovertemplate=f"%{{y:.1f}}: %{{customdata:.4g}} {unit}<br>%{{text}}<extra>{name}</extra>",
            )  # fmt: skip
    lost = np.isnan(value)
    if lost.any():
        found = np.flatnonzero(~lost)
        stuck = status == SteadyStatus.LOCKED_UP
        # In a gap of the line on the line, else on the edge: any other place would look like a load.
        between = np.full(len(depth), edge)
        if len(found):
            between = np.interp(depth, depth[found], value[found], left=edge, right=edge)
        label = "no loads"
        yield go.Scatter(
            x=np.where(stuck, edge, between)[lost], y=depth[lost], name=label, legendgroup=label,
            showlegend=_new(label, named), mode="markers", text=[texts[k] for k in np.flatnonzero(lost)],
            marker={"symbol": "x-thin", "size": 9, "line": {"color": colour, "width": 2}},
            hovertemplate=f"%{{y:.1f}}: %{{text}}<extra>{name}</extra>",
        )  # fmt: skip


def _measured(chosen: ChartLook, kind: str, column: str, units: System, named: set[str]) -> go.Scatter:
    """Measured points of an operation, with their ranges."""
    assert chosen.measured is not None
    rows, factor = chosen.measured[chosen.measured["operation"] == kind], shown(column, units).factor
    value, low, high = (rows[name].to_numpy(float) * factor for name in measured_columns(column))
    middle = np.where(np.isnan(value), 0.5 * (low + high), value)
    label, unit = chosen.measured_label, shown(column, units).label
    look = {"symbol": SYMBOLS[LOOKS[kind][1]], "size": 10, "color": MEASURED, "line": {"color": "black", "width": 1.5}}
    return go.Scatter(
        x=middle, y=rows["bit_depth_m"] * shown(DEPTH.name, units).factor, name=label, legendgroup=label,
        showlegend=_new(label, named), mode="markers",
        marker=look,
        error_x={"array": high - middle, "arrayminus": middle - low, "color": "black"},
        hovertemplate=f"%{{y:.1f}}: %{{x:.4g}} {unit}<extra>measured, {KINDS[kind].label}</extra>",
    )  # fmt: skip


def _limit(line: LimitLine, column: str, units: System, named: set[str]) -> go.Scatter:
    """A limit of an operation; the legend has each limit once."""
    unit = shown(column, units)
    words = f"{line.name}, {KINDS[line.operation].label}"
    return go.Scatter(
        x=line.value * unit.factor, y=line.depth * shown(DEPTH.name, units).factor, mode="lines", name=line.name,
        legendgroup=line.name, showlegend=_new(line.name, named),
        line={"color": LOOKS[line.operation][0], "dash": line.dash[1], "width": 1.5},
        hovertemplate=f"%{{y:.1f}}: %{{x:.4g}} {unit.label}<extra>{words}</extra>",
    )  # fmt: skip


def _buckled(
    value: NDArray[np.float64], depth: NDArray[np.float64], modes: "pd.Series[str]", named: set[str]
) -> Iterator[go.Scatter]:
    """Grey discs below the buckled rows of a line, by mode."""
    for mode, grey in BUCKLED.items():
        at = (modes == mode).to_numpy(bool)
        if at.any():
            label = f"{mode} buckling"
            yield go.Scatter(
                x=value[at], y=depth[at], mode="markers", hoverinfo="skip", name=label, legendgroup=label,
                showlegend=_new(label, named), marker={"size": 13, "color": grey, "line": {"color": EDGE, "width": 1}},
            )  # fmt: skip


def _line(
    value: NDArray[np.float64], depth: NDArray[np.float64], name: str, colour: str, dash: str, *, legend: bool
) -> go.Scatter:
    look = {"color": colour, "dash": dash, "width": 1.2}
    return go.Scatter(x=value, y=depth, name=name, mode="lines", line=look, hoverinfo="skip", showlegend=legend)


def with_heading(figure: go.Figure, title: str, lines: Sequence[str], height: int) -> go.Figure:
    """The figure with its title, the lines below it, and the legend below the panels."""
    top = 58 + LINE * (len(lines) + 1)
    small = "".join(f"<br><span style='font-size:12px;font-weight:normal'>{_wrapped(line)}</span>" for line in lines)
    extra = sum(_wrapped(line).count("<br>") for line in lines) * LINE
    title_text = f"<b>{plain(title)}</b>{small}"
    figure.update_layout(
        title={"text": title_text, "x": 0.01, "xanchor": "left", "y": 1, "yanchor": "top", "pad": {"t": 20}},
        # A page writes the same as text.
        meta={"title": title, "lines": list(lines)},
        height=height + top + extra + 80, margin={"t": top + extra, "l": 70, "r": 45, "b": 110},
        template="plotly_white", modebar={"orientation": "v"},  # beside the panels, not over the title
        legend={"orientation": "h", "y": 0, "yref": "container", "yanchor": "bottom"}, hovermode="closest",
    )  # fmt: skip
    return figure


def _new(name: str, named: set[str]) -> bool:
    """Whether a name is not in the legend yet; it is from now on."""
    new = name not in named
    named.add(name)
    return new


def plain(text: str) -> str:
    """A text from outside as the page shows it: neither tags nor formulas."""
    return escape(printable(text)).replace("$", "&#36;")


def _wrapped(text: str, width: int = 150) -> str:
    """A plain text in lines of about ``width`` characters."""
    lines, room = [""], width
    for word in text.split(" "):
        if len(word) + 1 > room and lines[-1]:
            lines, room = [*lines, ""], width
        lines[-1] += f" {word}" if lines[-1] else word
        room -= len(word) + 1
    return "<br>".join(map(plain, lines))
