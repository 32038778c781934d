"""The page as it is first sent: its parts, without data."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from dash import dcc, html

from fctd.app.charts import EMPTY
from fctd.app.downloads import FILES
from fctd.app.well import EXTRAS
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.model.first_runs import to_paste
from fctd.view.quantities import QUANTITIES

TITLE: Final = "fctd"
GRAPHS: Final = ("loads", "scene", "panels")
CONFIG: Final[Any] = {
    "displaylogo": False, "responsive": True, "modeBarButtonsToRemove": ["sendChartToCloud", "lasso2d", "select2d"],
}  # fmt: skip
TICK: Final = 1000  # between two questions of a page about what goes on [ms]
# A rig's sheet, as the box for measured rows shows it.
SHEET: Final = "Depth (ft)\tPU (klbf)\tSO (klbf)\tROT (klbf)\tTQ (kft.lbf)\n5000\t175\t160\t166\t3.9"


def layout() -> Any:
    """The whole page."""
    kinds = [{"label": of.label, "value": kind} for kind, of in KINDS.items()]
    return html.Div(
        id="page",
        children=[
            dcc.Location(id="where", refresh=False),
            *(dcc.Store(id=name) for name in ("wish", "answered", "turn", "opened", "changed", "run-kept")),
            dcc.Interval(id="tick", interval=TICK),
            html.Header([
                html.Div([html.Span("fctd", className="brand"), html.H1(id="name")], className="title"),
                html.P(id="facts"),
                html.P(id="note", role="status"),
            ]),
            html.P(id="fault", role="alert", hidden=True),
            html.Main([html.Aside(_controls(kinds)), html.Div(_pictures(kinds), className="pictures")]),
            html.Footer("Loads follow a slider at once at every third depth, and at all depths when it rests."),
        ],
    )  # fmt: skip


def _controls(kinds: Sequence[Mapping[str, str]]) -> list[Any]:
    extras = [{"label": label, "value": name} for name, label in EXTRAS.items()]
    return [
        _group("Well", [
            dcc.Upload(
                id="upload", multiple=True, className="drop",
                children=html.Span(["Drop a survey or a case here, or ", html.U("choose files")]),
            ),
            html.P(id="upload-fault", className="fault", role="alert", hidden=True),
            html.Div(id="warnings"),
            html.A("a page for another well", href="../../new", target="_blank", className="another"),
        ]),
        _group("Operations", [
            dcc.Checklist(id="operations", options=[*kinds, *extras], value=[]),
        ]),
        _group("Loads", [
            html.Div(id="sliders"),
            html.Button("back to the case", id="reset", className="quiet"),
        ]),
        html.Details([
            html.Summary("Measured rows"),
            html.P("Paste a rig's sheet with its headers, from a spreadsheet or a CSV file, or rows of bit depth, "
                   "operation, hook load and torque; or choose a file. A weight is what the gauge reads, block "
                   "included."),
            dcc.Textarea(id="measured", spellCheck=False, rows=5, placeholder=SHEET),
            html.Div([
                html.Button("show", id="show-measured"),
                dcc.Upload(id="measured-file", children=html.Button("choose a file"), className="inline"),
            ], className="buttons"),
            html.P(id="measured-told", role="status"),
        ]),
        html.Details([html.Summary("Download"), html.Ul(id="files")]),
    ]  # fmt: skip


def _pictures(kinds: Sequence[Mapping[str, str]]) -> list[Any]:
    colours = [{"label": quantity.label, "value": name} for name, quantity in QUANTITIES.items()]
    string = [
        html.Label(["operation", dcc.Dropdown(id="operation", options=list(kinds), clearable=False, searchable=False)]),
        html.Label(["colour", dcc.Dropdown(
            id="colour", options=colours, value="side_force", clearable=False, searchable=False,
        )]),
        html.Div([
            html.Div(
                [html.Label("bit depth"), html.Span([html.Output(id="depth-shown"), " ", html.Span(id="depth-unit")])],
                className="name",
            ),
            dcc.Slider(
                id="depth", min=0, max=1, value=1, marks=None, updatemode="mouseup", step=1, allow_direct_input=False,
            ),
        ], className="depth slider"),
    ]  # fmt: skip
    run = [
        html.Div([
            html.Button("▶ run the case", id="run"), html.Button("■ stop", id="stop", disabled=True),
            html.Progress(id="share", max="1", value="0"),
        ], className="buttons"),
        html.P(
            "The operations of the case, step by step in time, with the sliders where they stand.", id="run-told",
            role="status",
        ),
        html.Details([
            html.Summary("Add operations"),
            html.P("They follow those of the case, in the words of a case file; what stands here is an example."),
            dcc.Textarea(id="more-operations", spellCheck=False, rows=5, placeholder="\n".join(to_paste("1500 m"))),
        ]),
        html.Div([_graph("time"), html.P([html.Span(id="run-at"), html.Span(id="run-words")]), _graph("run-scene")],
                 id="time-box", hidden=True),
    ]  # fmt: skip
    return [
        _picture("Hook load and torque", [_graph("loads")], [html.P(id="rows-note")], "chart"),
        _picture("The string in its hole", [html.Div(string, className="tools"), _graph("scene")], [
            html.P([html.Span(id="at"), html.Span(id="words")]),
        ], "hole"),
        _picture("Where it touches, side force, tension", [_graph("panels")], [], "touch"),
        _picture("A run in time", run, [], "run"),
    ]  # fmt: skip


def slider(one: Mapping[str, Any], value: float) -> Any:
    """A slider with its name, unit and value; one : a ``sliders.Slider`` as a table."""
    name, unit = one["name"], one["unit"]
    return html.Div(
        [
            html.Div(
                [
                    html.Label(one["label"]),
                    html.Span([html.Output(f"{value:g}", id={"shown": name}), f" {unit}" if unit else ""]),
                ],
                className="name",
            ),
            dcc.Slider(
                id={"slider": name}, min=one["low"], max=one["high"], step=one["step"], value=value,
                # Where the case has it.
                marks={one["value"]: "▴"}, updatemode="mouseup", allow_direct_input=False,
            ),
        ],
        className="slider",
    )  # fmt: skip


def links(address: str) -> list[Any]:
    """Links to the files of a session; address : of the session."""
    return [html.Li(html.A(label, href=f"{address}files/{name}", download="")) for name, label in FILES.items()]


def warned(texts: Sequence[str]) -> Any:
    """What is probably not meant in the case."""
    if not texts:
        return []
    return html.Details(
        [html.Summary(counted(len(texts), "warning")), html.Ul([html.Li(text) for text in texts])], open=True
    )


def _group(title: str, children: Sequence[Any]) -> Any:
    return html.Section([html.H2(title), *children])


def _picture(title: str, children: Sequence[Any], below: Sequence[Any], name: str) -> Any:
    return html.Section([html.H2(title), *children, *below], className=f"picture {name}".strip())


def _graph(name: str) -> Any:
    # A graph takes the height of what is around it.
    return html.Div(dcc.Graph(id=name, figure=EMPTY, config=CONFIG, style={"height": "100%"}), className="graph")
