"""What happens on the page: files come in, sliders move, a run goes on."""

import time
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from pathlib import PurePath
from typing import Any, Final

from dash import ALL, ClientsideFunction, Dash, Input, Output, State, no_update
from dash.exceptions import PreventUpdate

from fctd.app import page
from fctd.app.charts import EMPTY, FONT
from fctd.app.pool import Pool
from fctd.app.runs import Runs, target_of
from fctd.app.sessions import Session, Sessions
from fctd.app.sliders import Slider
from fctd.app.uploads import content_of, source_of, text_of
from fctd.case.errors import InputError
from fctd.case.text import counted, printable
from fctd.plots.palette import PALETTE
from fctd.results.unit_systems import System, shown

# Settings that a page shows, with which ``Well.solved`` computes.
SHOWN_SETTINGS: Final = ("values", "operations", "operation", "depth", "colour")
PICTURE_TEXTS: Final = ("at", "words", "rows-note")  # beside the pictures
LATER: Final = ("panels", "scene")  # figures that wait until the chart is painted


class PageBackend:
    """What the callbacks work with; units : of the page."""

    def __init__(self, sessions: Sessions, pool: Pool, runs: Runs, prefix: str, units: System) -> None:
        self.sessions, self.pool, self.runs, self.prefix, self.units = sessions, pool, runs, prefix, units

    def session(self, pathname: object) -> Session:
        """The session of an address.  Raises InputError where there is none."""
        parts = str(pathname).removeprefix(self.prefix).split("/")
        found = self.sessions.get(parts[1]) if parts[0] == "s" and len(parts) > 1 else None
        if found is None:
            raise InputError("the address of a session: open the page anew")
        return found

    def ask(self, session: Session, do: str, **given: Any) -> Any:
        """An answer about the case of a session.  Raises InputError, also where it has none."""
        if session.source is None:
            raise InputError("a case: drop a survey or a case")
        return self.pool.ask(do, session.source, self.units, **given)

    def asked(self, session: Session) -> dict[str, Any]:
        """What the page of a session shows, by its settings."""
        opened = self.ask(session, "open")
        kinds = opened["operations"]
        usual = {
            "values": {}, "operations": kinds, "operation": kinds[0] if kinds else "trip_out",
            "depth": opened["depth"]["high"], "colour": "side_force",
        }  # fmt: skip
        found = {name: session.settings.get(name, usual[name]) for name in SHOWN_SETTINGS}
        return found


def connect(app: Dash, backend: PageBackend) -> None:
    """Register all callbacks."""
    for register in (_opening, _moving, _measuring, _running):
        register(app, backend)


def _refusing(outputs: int, at: int) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Make a callback show an InputError in the output at an index, and leave its other outputs as they are.

    outputs : their number.
    """

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def call(*given: Any) -> Any:
            try:
                return function(*given)
            except InputError as error:
                found: list[Any] = [no_update] * outputs
                found[at] = str(error)
                return tuple(found)

        return call

    return decorate


def _clearing(at: int) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Make a callback that takes files empty the output at an index, which holds them.

    Otherwise the same files, dropped again, would be no change.
    """

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def call(contents: object, *given: Any) -> Any:
            if not contents:
                raise PreventUpdate
            found = list(function(contents, *given))
            found[at] = None
            return tuple(found)

        return call

    return decorate


def _opening(app: Dash, backend: PageBackend) -> None:
    """A page is opened, or its session gets another case."""
    graphs = [Output(name, "figure") for name in page.GRAPHS]

    @app.callback(
        Output("fault", "children"), Output("opened", "data"), Output("sliders", "children"),
        Output("operations", "value"), Output("operation", "value"), Output("colour", "value"),
        Output("depth", "min"), Output("depth", "max"), Output("depth", "value"), Output("depth-unit", "children"),
        Output("name", "children"), Output("facts", "children"), Output("warnings", "children"),
        Output("files", "children"), Output("measured", "value"), *(Output(name, "children") for name in PICTURE_TEXTS),
        *graphs,
        Input("where", "pathname"), Input("changed", "data"), Input("reset", "n_clicks"),
    )  # fmt: skip
    @_refusing(21, 0)
    def opened(pathname: str, changed: object, resets: object) -> tuple[Any, ...]:
        from dash import ctx

        session = backend.session(pathname)
        if ctx.triggered_id == "reset":
            session.keep(values={})
        of = session.well
        found, asked = backend.ask(session, "open"), backend.asked(session)
        values, depth = asked["values"], found["depth"]
        sliders = [page.slider(one, _at(one, values)) for one in found["sliders"]]
        own = {one["name"]: one["value"] for one in found["sliders"]}
        at = min(max(asked["depth"], depth["low"]), depth["high"])
        return (
            "", {"own": own, "values": values, "n": time.time(), "of": of}, sliders, asked["operations"],
            asked["operation"], asked["colour"], depth["low"], depth["high"], at, depth["unit"],
            printable(found["name"]), found["facts"], page.warned(found["warnings"]), page.links(str(pathname)),
            session.measured, *[""] * len(PICTURE_TEXTS), *(found[name] for name in page.GRAPHS),
        )  # fmt: skip

    @app.callback(
        Output("upload-fault", "children"), Output("changed", "data"), Output("upload", "contents"),
        Input("upload", "contents"), State("upload", "filename"), State("where", "pathname"),
        prevent_initial_call=True,
    )  # fmt: skip
    @_clearing(2)
    @_refusing(3, 0)
    def upload(contents: Sequence[str] | None, names: Sequence[str] | None, pathname: str) -> tuple[Any, ...]:
        session = backend.session(pathname)
        files = {name: content_of(text) for name, text in zip(names or (), contents or (), strict=True)}
        source, note = source_of(files, session.source, backend.pool, backend.units)
        session.put(source)
        return note, time.time(), None


def _at(one: Mapping[str, Any], values: Mapping[str, Any]) -> float:
    """Where a slider stands; what a file of settings says of it may be of another case."""
    slider = Slider(**one)
    try:
        return slider.check(values.get(slider.name, slider.value))
    except InputError:
        return slider.value


def _moving(app: Dash, backend: PageBackend) -> None:
    """Sliders, lists and buttons that change what is drawn."""
    app.clientside_callback(
        ClientsideFunction("fctd", "moved"), Output("wish", "data"),
        Input({"slider": ALL}, "drag_value"), Input({"slider": ALL}, "value"), Input("depth", "drag_value"),
        Input("depth", "value"), Input("operations", "value"), Input("operation", "value"), Input("colour", "value"),
        Input("opened", "data"), State({"slider": ALL}, "id"),
    )  # fmt: skip
    app.clientside_callback(
        ClientsideFunction("fctd", "drawn"), Output("loads", "figure", allow_duplicate=True),
        Input("answered", "data"), State("loads", "figure"), prevent_initial_call=True,
    )  # fmt: skip
    app.clientside_callback(
        ClientsideFunction("fctd", "drawnInTurn"), *(Output(name, "figure", allow_duplicate=True) for name in LATER),
        Input("turn", "data"), *(State(name, "figure") for name in LATER), prevent_initial_call=True,
    )  # fmt: skip
    for name in ("fault", "upload-fault"):
        app.clientside_callback(ClientsideFunction("fctd", "empty"), Output(name, "hidden"), Input(name, "children"))

    @app.callback(
        Output("fault", "children", allow_duplicate=True), Output("answered", "data"),
        *(Output(name, "children", allow_duplicate=True) for name in PICTURE_TEXTS),
        Output("changed", "data", allow_duplicate=True),
        Input("wish", "data"), State("where", "pathname"), prevent_initial_call=True,
    )  # fmt: skip
    def solve(wish: Mapping[str, Any] | None, pathname: str) -> tuple[Any, ...]:
        wish = wish or {}
        same = [no_update] * (len(PICTURE_TEXTS) + 1)
        try:
            session = backend.session(pathname)
            asked = {name: wish[name] for name in SHOWN_SETTINGS}
            if wish["of"] != session.well:  # another page may have put another one in its place
                return "", {"n": wish["n"]}, *same[1:], time.time()
            given = {"coarse": bool(wish["coarse"]), "hole": bool(wish["hole"])}
            found = backend.ask(session, "solve", measured=session.measured, **asked, **given)
            if not wish["coarse"] and any(session.settings.get(name) != asked[name] for name in SHOWN_SETTINGS):
                session.keep(wish["of"], **asked)
        except KeyError as error:
            return f"expected {error} in what the page asks", {"n": 0}, *same
        except InputError as error:
            return str(error), {"n": wish.get("n", 0)}, *same
        answered = {"n": wish.get("n", 0)} | {name: found[name] for name in page.GRAPHS}
        return "", answered, found["where"], found["words"], found["note"], no_update


def _measuring(app: Dash, backend: PageBackend) -> None:
    """Measured rows, pasted or from a file."""

    @app.callback(
        Output("measured-told", "children"), Output("opened", "data", allow_duplicate=True),
        Input("show-measured", "n_clicks"), State("measured", "value"), State("where", "pathname"),
        State("opened", "data"), prevent_initial_call=True,
    )  # fmt: skip
    @_refusing(2, 0)
    def show(clicks: object, text: str | None, pathname: str, opened: Mapping[str, Any] | None) -> tuple[Any, ...]:
        session = backend.session(pathname)
        found = backend.ask(session, "measured", text=text or "")
        session.keep(measured=text or "")
        told = "; ".join([counted(found["rows"], "row"), *found["told"]]) if found["rows"] else ""
        return told, {**(opened or {}), "again": time.time()}

    @app.callback(
        Output("measured", "value", allow_duplicate=True), Output("measured-told", "children", allow_duplicate=True),
        Output("measured-file", "contents"), Input("measured-file", "contents"), prevent_initial_call=True,
    )  # fmt: skip
    @_clearing(2)
    @_refusing(3, 1)
    def take(contents: str) -> tuple[Any, ...]:
        return text_of(content_of(contents)), "press show", None


def _running(app: Dash, backend: PageBackend) -> None:
    """A run in time, and what goes on in general."""

    @app.callback(
        Output("note", "children"), Output("share", "value"), Output("run", "disabled"), Output("stop", "disabled"),
        Output("run-kept", "data"), Output("run-told", "children"), Output("tick", "interval"),
        Output("changed", "data", allow_duplicate=True),
        Input("tick", "n_intervals"), State("where", "pathname"), State("run-kept", "data"), State("opened", "data"),
        prevent_initial_call="initial_duplicate",
    )  # fmt: skip
    def tick(count: object, pathname: str, before: object, opened: Mapping[str, Any] | None) -> tuple[Any, ...]:
        note = backend.pool.note
        try:
            session = backend.session(pathname)
        except InputError as error:
            return str(error), *[no_update] * 5, 60 * page.TICK, no_update
        state = backend.runs.state(session)
        going, kept = state["running"], [state["kept"], state["running"]]
        told = no_update if state["kept"] or not state["log"] else state["log"]
        quiet = not (note or going)
        return (
            note, f"{state['share']:.3f}", going, not going, no_update if kept == before else kept, told,
            page.TICK * (5 if quiet else 1),
            time.time() if opened and opened["of"] != session.well else no_update,
        )  # fmt: skip

    @app.callback(
        Output("run-told", "children", allow_duplicate=True), Output("tick", "interval", allow_duplicate=True),
        Input("run", "n_clicks"), State("where", "pathname"), State({"slider": ALL}, "value"), State("opened", "data"),
        State("more-operations", "value"), prevent_initial_call=True,
    )  # fmt: skip
    @_refusing(2, 0)
    def start(
        clicks: object, pathname: str, sliders: Sequence[float], opened: Mapping[str, Any] | None, more: str | None
    ) -> tuple[Any, ...]:
        session = backend.session(pathname)
        # Where the sliders stand: their last move may not be solved yet.
        own = (opened or {"own": {}})["own"]
        values = {name: at for (name, usual), at in zip(own.items(), sliders, strict=True) if at != usual}
        source, name = session.source, ""
        if source is not None and source.survey_name:
            name = "survey" + PurePath(source.survey_name).suffix.lower()
        text = backend.ask(session, "text", values=values, survey=name, more=more or "")["text"]
        backend.runs.start(session, text, name, b"" if source is None else source.survey)
        return "the string comes to rest first; nothing is recorded yet", page.TICK

    @app.callback(
        Output("stop", "disabled", allow_duplicate=True),
        Input("stop", "n_clicks"), State("where", "pathname"), prevent_initial_call=True,
    )  # fmt: skip
    def stop(clicks: object, pathname: str) -> bool:
        backend.runs.stop(backend.session(pathname))
        return True

    @app.callback(
        Output("time", "figure"), Output("run-told", "children", allow_duplicate=True), Output("time-box", "hidden"),
        Output("run-scene", "figure"), Output("run-at", "children"), Output("run-words", "children"),
        Input("run-kept", "data"), Input("colour", "value"), State("where", "pathname"), prevent_initial_call=True,
    )  # fmt: skip
    @_refusing(6, 1)
    def streamed(kept: Sequence[Any] | None, colour: str, pathname: str) -> tuple[Any, ...]:
        session = backend.session(pathname)
        if not kept or not kept[0]:
            return EMPTY, no_update, True, EMPTY, "", ""
        target = str(target_of(session.folder))
        found = backend.pool.ask("records", target=target, shown_units=backend.units, colour=colour)
        told = "; ".join(filter(None, [found["last"], found["status"]])) or no_update
        string = found["string"] or {"figure": EMPTY, "where": "", "words": ""}
        curves, empty = time_figure(found, backend.units), not found["records"]
        return curves, told, empty, string["figure"], string["where"], string["words"]


def time_figure(found: Mapping[str, Any], units: System) -> dict[str, Any]:
    """Hook load and torque over time; found : of ``runs_view.records``."""
    looks = {"hookload_N": ("hook load", PALETTE["vermilion"], "y"), "surface_torque_N_m": ("torque", "#000000", "y2")}
    data = [
        {
            "type": "scatter", "mode": "lines", "x": found["time"], "y": found["curves"][name], "name": label,
            "line": {"color": colour, "width": 1.6}, "yaxis": axis,
            "hovertemplate": f"%{{x:.1f}} s: %{{y:.4g}} {shown(name, units).label}<extra>{label}</extra>",
        }
        for name, (label, colour, axis) in looks.items()
    ]  # fmt: skip
    axes = {
        f"yaxis{axis[1:]}": {
            "title": {"text": f"{label}, {shown(name, units).label}", "font": {"size": 12, "color": colour}},
            "gridcolor": "#e8e8e8", "zeroline": False, "automargin": True,
        }
        for name, (label, colour, axis) in looks.items()
    }  # fmt: skip
    axes["yaxis2"] |= {"overlaying": "y", "side": "right", "showgrid": False, "tickmode": "auto"}
    layout = {
        **axes, "xaxis": {"title": {"text": "time, s", "font": {"size": 12}}, "gridcolor": "#e8e8e8"},
        "margin": {"l": 64, "r": 64, "t": 10, "b": 46}, "uirevision": "fixed", "showlegend": False,
        "font": {"family": FONT, "size": 11},
    }  # fmt: skip
    return {"data": data, "layout": layout}
