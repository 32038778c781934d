"""Requests with a foreign name, from a foreign page or without the token are refused; answers carry their policy."""

from typing import Any

import pytest

from fctd.app.guard import Guard, policy

PREFIX = f"/{'t' * 32}/"


def answer(path: str = PREFIX, host: str | None = "127.0.0.1:8522", **headers: str) -> tuple[str, dict[str, str], bool]:
    """Status, headers, and whether the application behind the guard was asked."""
    asked, found = list[str](), dict[str, Any]()

    def behind(environ: Any, start: Any) -> list[bytes]:
        asked.append(environ["PATH_INFO"])
        start("200 OK", [("cache-control", "max-age=31536000"), ("Content-Type", "text/html")])
        return [b"page"]

    def start(status: str, headers: list[tuple[str, str]], error: object = None) -> None:
        assert len({name.lower() for name, _ in headers}) == len(headers)
        found.update(status=status, headers=dict(headers))

    environ = {"PATH_INFO": path, **({} if host is None else {"HTTP_HOST": host})}
    body = b"".join(Guard(behind, PREFIX, 8522, ["'sha256-abc'"])(environ | headers, start))  # type: ignore[arg-type]
    assert (body == b"page") == bool(asked)
    return found["status"], found["headers"], bool(asked)


def test_the_page_itself_is_shown_with_its_headers() -> None:
    for host in ("127.0.0.1:8522", "localhost:8522", "LOCALHOST:8522"):
        status, headers, asked = answer(host=host, HTTP_ORIGIN="http://127.0.0.1:8522")
        assert (status, asked) == ("200 OK", True)
    assert headers["Cache-Control"] == "no-store"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert headers["X-Content-Type-Options"] == "nosniff"
    rules = dict(rule.split(" ", 1) for rule in headers["Content-Security-Policy"].split("; "))
    assert rules["script-src"] == "'self' 'sha256-abc'"
    assert rules["style-src"] == "'self' 'unsafe-inline'"
    assert rules["frame-ancestors"] == rules["default-src"] == "'none'"
    assert "unsafe-eval" not in policy(["'sha256-abc'"])


@pytest.mark.parametrize(
    "host", [None, "", "example.org", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8522.example.org", "[::1]:8522", "0:8522"]
)
def test_a_foreign_host_is_refused(host: str | None) -> None:
    status, headers, asked = answer(host=host)
    assert (status, asked) == ("403 Forbidden", False)
    assert headers["Cache-Control"] == "no-store"


@pytest.mark.parametrize(
    "origin", ["http://example.org", "null", "https://127.0.0.1:8522", "http://127.0.0.1:85", "http://localhost:85220"]
)
def test_a_foreign_origin_is_refused(origin: str) -> None:
    assert answer(HTTP_ORIGIN=origin)[::2] == ("403 Forbidden", False)


@pytest.mark.parametrize(
    "path",
    [
        "/", "", "/assets/app.js", "/_dash-layout", "/_dash-update-component", f"/{'t' * 31}/", f"/{'u' * 32}/",
        PREFIX[:-1], f"/x{PREFIX}", PREFIX.upper(), "//" + PREFIX[1:], "/é/",
    ],
)  # fmt: skip
def test_without_the_token_there_is_nothing(path: str) -> None:
    assert answer(path.encode().decode("latin-1"))[::2] == ("404 Not Found", False)
