"""The server of the page: Dash behind waitress, on this machine's own address alone."""

import base64
import re
import socket
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

import waitress
from dash import Dash
from dash.exceptions import DependencyException, InvalidResourceError, PreventUpdate
from flask import Flask, Response, redirect, request
from werkzeug.exceptions import HTTPException

from fctd.app import page
from fctd.app.callbacks import PageBackend, connect
from fctd.app.guard import Guard
from fctd.app.home import HOST, Home
from fctd.app.pool import Pool
from fctd.app.runs import Runs
from fctd.app.sessions import Sessions, Source
from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.model.new_case import from_template
from fctd.model.templates import TEMPLATES
from fctd.results.unit_systems import System

if TYPE_CHECKING:
    from werkzeug.wrappers import Response as Answer

MOST_RECEIVED: Final = 5 * 2**20  # bytes of a request
THREADS: Final = 16
# Connections at a time, and [s] that one may take over its headers: who opens many and sends nothing stops nobody.
MOST_CONNECTIONS, SILENT = 500, 10
OF_DASH: Final = re.compile(r"_dash-|assets/|_favicon\.ico$|_reload-hash$")
OF_SESSION: Final = re.compile(r"s/([^/]*)/(.*)")
KINDS_OF_FILES: Final = {"html": "text/html", "csv": "text/csv", "toml": "text/plain", "png": "image/png"}


def listening(port: int | None, last: int) -> socket.socket:
    """A socket at a port of this machine alone; without one at that of the last time, or at any free one.

    Raises InputError where a given port is not free.
    """
    for wanted in [last, 0] if port is None else [port]:
        found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            found.bind((HOST, wanted))
        except OSError as error:
            found.close()
            trouble = error.strerror
        else:
            return found
    raise InputError(f"a free port ({trouble})", key="--port", value=port)


class AppServer:
    """The page, served from a home until ``close``; units : in which it shows values; pool : what reads and solves."""

    def __init__(self, home: Home, units: System = "si", port: int | None = None, pool: Pool | None = None) -> None:
        self.home, self.units = home, units
        self._socket = listening(port, home.port)
        self.port = home.port = int(self._socket.getsockname()[1])
        self.sessions = Sessions(home.folder / "sessions")
        self.pool = Pool(home.folder) if pool is None else pool
        self.runs = Runs(self.sessions.folders())
        backend = PageBackend(self.sessions, self.pool, self.runs, home.prefix, units)
        app = dash_app(backend)
        flask: Any = app.server
        guard = Guard(flask.wsgi_app, home.prefix, self.port, app.csp_hashes())
        self._server = waitress.create_server(
            guard, sockets=[self._socket], threads=THREADS, max_request_body_size=MOST_RECEIVED, ident=None,
            clear_untrusted_proxy_headers=True, connection_limit=MOST_CONNECTIONS, channel_timeout=SILENT,
            cleanup_interval=SILENT // 2,
        )  # fmt: skip

    def address(self, key: str = "") -> str:
        """The address of a session, or of the one that was used last."""
        return f"http://{HOST}:{self.port}{self.home.prefix}" + (f"s/{key}/" if key else "")

    def begin(self, source: Source | None) -> str:
        """The address of a new session with a case, or without one of the page."""
        if source is None:
            return self.address()
        session = self.sessions.new(self.runs.running())
        session.put(source)
        return self.address(session.key)

    def show(self, address: str) -> bool:
        """Open an address in the user's browser; whether there is one."""
        return webbrowser.open(self.home.redirect_file(address).as_uri())

    def run(self) -> None:
        """Answer requests until an interruption."""
        self._server.run()

    def close(self) -> None:
        """End runs and processes, and give the port back."""
        self._server.close()
        self.runs.close()
        self.pool.close()
        (self.home.folder / "open.html").unlink(missing_ok=True)
        self.home.leave()


@contextmanager
def serving(home: Home, units: System = "si", port: int | None = None) -> Iterator[AppServer]:
    """A server, closed in the end."""
    try:
        server = AppServer(home, units, port)
    except BaseException:
        home.leave()
        raise
    try:
        yield server
    finally:
        server.close()


def dash_app(backend: PageBackend) -> Dash:
    """The page with its callbacks below its prefix; other addresses lead to a session, or nowhere."""
    # Without a folder of its own, flask has no address that the prefix does not begin.
    flask: Any = Flask("fctd.app", static_folder=None)
    flask.before_request(lambda: _steered(backend))
    flask.register_error_handler(Exception, _failed)
    app = Dash(
        "fctd.app.page", server=flask, url_base_pathname=backend.prefix, title=page.TITLE, update_title="",
        assets_folder="assets", add_log_handler=False, enable_mcp=False, suppress_callback_exceptions=True,
        compress=False, serve_locally=True,
    )  # fmt: skip
    app.layout = page.layout()
    connect(app, backend)
    return app


def _failed(error: Exception) -> "Answer":
    """The answer to a request that the page never makes, or to one that meets a defect, which is told in a line."""
    if isinstance(error, HTTPException):
        return error.get_response()
    if isinstance(error, PreventUpdate):
        return Response("", 204)
    if isinstance(error, InvalidResourceError | DependencyException):
        return Response("Not Found", 404, mimetype="text/plain")
    print(printable(f"fctd app: {request.path.rpartition('/')[2]}: {type(error).__name__}: {error}"), file=sys.stderr)
    return Response("Bad Request", 400, mimetype="text/plain")


def _steered(backend: PageBackend) -> "Answer | None":
    """The answer to a request that is not for Dash."""
    rest = request.path.removeprefix(backend.prefix)
    if OF_DASH.match(rest):
        return None
    if rest in ("", "new") and request.method in ("GET", "HEAD"):
        session = backend.sessions.newest() if not rest else None
        if session is None:
            session = backend.sessions.new(backend.runs.running())
            session.put(_first(backend.units))
        return redirect(f"{backend.prefix}s/{session.key}/")
    match = OF_SESSION.fullmatch(rest)
    session = backend.sessions.get(match[1]) if match else None
    if match is None or session is None:
        return Response("Not Found", 404, mimetype="text/plain")
    if not match[2]:
        return None
    if match[2] == "closed" and request.method == "POST":
        backend.runs.closed(session)
        return Response("", 204)
    head, _, name = match[2].partition("/")
    if head != "files" or request.method != "GET":
        return Response("Not Found", 404, mimetype="text/plain")
    try:
        found = backend.ask(session, "file", name=name, measured=session.measured, **backend.asked(session))
    except InputError as error:
        return Response(str(error), 404, mimetype="text/plain")
    kind = KINDS_OF_FILES.get(name.rpartition(".")[2], "application/octet-stream")
    answer = Response(base64.b64decode(found["content"]), mimetype=kind)
    answer.headers.set("Content-Disposition", "attachment", filename=found["name"])
    return answer


def _first(units: System) -> Source:
    """A well to begin with."""
    return Source(from_template(TEMPLATES["build-hold"], "a first well", units).text())
