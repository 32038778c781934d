"""What stands before the page: who may ask, under which address, and what a browser may do with the answer.

A page elsewhere can send requests to this machine (a foreign ``Origin``), or give its own name the address of this
machine (a foreign ``Host``): both are refused, and without the token there is nothing to see.
"""

from collections.abc import Callable, Iterable, Sequence
from hmac import compare_digest
from typing import Any, Final
from wsgiref.types import StartResponse, WSGIApplication, WSGIEnvironment

from fctd.app.home import HOST

NAMES: Final = (HOST, "localhost")
# Headers of the answers, in place of those that the page's own framework writes.
FIXED: Final = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "X-Frame-Options": "DENY",
}


def policy(hashes: Sequence[str]) -> str:
    """The content security policy; hashes : of the scripts that stand in the page."""
    parts = {
        "default-src": "'none'",
        "script-src": " ".join(["'self'", *hashes]),
        "style-src": "'self' 'unsafe-inline'",
        "img-src": "'self' data: blob:",
        "font-src": "'self' data:",
        "connect-src": "'self'",
        "base-uri": "'none'",
        "form-action": "'none'",
        "frame-ancestors": "'none'",
    }
    return "; ".join(f"{name} {value}" for name, value in parts.items())


class Guard:
    """A WSGI application in front of another one.

    prefix : "/TOKEN/", of every address; port : that the server listens to; hashes : see ``policy``.
    """

    def __init__(self, app: WSGIApplication, prefix: str, port: int, hashes: Sequence[str]) -> None:
        self._app, self._prefix = app, prefix.encode()
        self._hosts = {f"{name}:{port}" for name in NAMES} | ({*NAMES} if port == 80 else set())
        self._origins = {f"http://{host}" for host in self._hosts}
        self._headers = [*FIXED.items(), ("Content-Security-Policy", policy(hashes))]

    def __call__(self, environ: WSGIEnvironment, start_response: StartResponse) -> Iterable[bytes]:
        """Answer a request."""
        refused = self._refused(environ)
        if refused:
            text = refused.encode()
            headers = [("Content-Type", "text/plain; charset=utf-8"), ("Content-Length", str(len(text)))]
            start_response(refused, [*headers, *self._headers])
            return [text]

        def start(status: str, headers: list[tuple[str, str]], error: Any = None) -> Callable[[bytes], object]:
            ours = {name.lower() for name, _ in self._headers}
            kept = [(name, value) for name, value in headers if name.lower() not in ours]
            return start_response(status, [*kept, *self._headers], error)

        return self._app(environ, start)

    def _refused(self, environ: WSGIEnvironment) -> str:
        """The status of a refusal, empty where there is none."""
        if environ.get("HTTP_HOST", "").lower() not in self._hosts:
            return "403 Forbidden"
        origin = environ.get("HTTP_ORIGIN")
        if origin is not None and origin.lower() not in self._origins:
            return "403 Forbidden"
        path = environ.get("PATH_INFO", "").encode("latin-1", "replace")
        if not compare_digest(path[: len(self._prefix)], self._prefix):
            return "404 Not Found"
        return ""
