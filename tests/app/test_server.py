"""The page served by waitress: attacks are refused, and its address lasts."""

from __future__ import annotations

import base64
import http.client
import json
import os
import socket
import threading
import tomllib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest

from fctd.app.downloads import FILES
from fctd.app.home import Home
from fctd.app.sessions import MOST_SESSIONS, Session
from fctd.case.errors import InputError
from fctd.model.first_runs import to_paste
from tests.app.made import NAME, SURVEY, TEXT, InProcess, source
from tests.commands import HANG

if TYPE_CHECKING:
    from fctd.app.server import AppServer


class Answer(NamedTuple):
    status: int
    headers: dict[str, str]
    body: bytes


@contextmanager
def served(folder: Path) -> Iterator[AppServer]:
    from waitress import wasyncore

    from fctd.app.server import AppServer

    server, ended = AppServer(Home.open(folder), port=None, pool=InProcess()), threading.Event()  # type: ignore[arg-type]

    def run() -> None:
        while not ended.is_set():
            wasyncore.loop(timeout=0.05, map=server._server._map, count=1)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield server
    finally:
        ended.set()
        thread.join()
        server.close()


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[AppServer]:
    with served(tmp_path_factory.mktemp("state") / "app") as found:
        yield found


def ask(server: AppServer, path: str, body: bytes | None = None, **headers: str) -> Answer:
    """An answer; path : with the prefix."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=HANG)
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    try:
        connection.request("GET" if body is None else "POST", path, body, given)
        answer = connection.getresponse()
        return Answer(answer.status, dict(answer.getheaders()), answer.read())
    finally:
        connection.close()


def call(server: AppServer, key: str, output: str, inputs: list[Any], state: list[Any]) -> Any:
    """What a callback of the page of a session answers; inputs, state : (id, property, value)."""
    prefix = server.home.prefix
    dependencies = json.loads(ask(server, f"{prefix}_dash-dependencies").body)
    (one,) = [
        each
        for each in dependencies
        if output in each["output"] and inputs[0][0] in [given["id"] for given in each["inputs"]]
    ]
    outputs = []
    for text in one["output"].strip(".").split("..."):
        name, _, prop = text.rpartition(".")
        outputs.append({"id": name, "property": prop})
    state = [*state, ("where", "pathname", f"{prefix}s/{key}/")]

    def listed(given: list[Any], wanted: list[Any]) -> list[Any]:
        values = {f"{name}.{prop}": value for name, prop, value in given}
        return [{**each, "value": values.get(f"{each['id']}.{each['property']}")} for each in wanted]

    body = {
        "output": one["output"], "outputs": outputs if len(outputs) > 1 else outputs[0],
        "inputs": listed(inputs + state, one["inputs"]), "state": listed(inputs + state, one["state"]),
        "changedPropIds": [f"{inputs[0][0]}.{inputs[0][1]}"],
    }  # fmt: skip
    answer = ask(
        server, f"{prefix}_dash-update-component", json.dumps(body).encode(), Content_Type="application/json",
        Origin=f"http://127.0.0.1:{server.port}",
    )  # fmt: skip
    assert answer.status == 200, answer.body[:500]
    return json.loads(answer.body)["response"]


def upload(server: AppServer, key: str, **files: bytes) -> str:
    """What is said of files that are dropped on the page, empty where they are taken."""
    contents = ["data:;base64," + base64.b64encode(content).decode() for content in files.values()]
    names = [name.replace("_dot_", ".").replace("_slash_", "/") for name in files]
    found = call(
        server, key, "upload-fault.children", [("upload", "contents", contents)], [("upload", "filename", names)]
    )
    return str(found["upload-fault"]["children"])


def test_the_page_its_scripts_and_its_data_are_behind_the_token(server: AppServer) -> None:
    prefix, key = server.home.prefix, server.sessions.new().key
    page = ask(server, f"{prefix}s/{key}/")
    assert page.status == 200
    sources = [part.split('"')[0] for part in page.body.decode().split('src="')[1:]]
    assert len(sources) > 5
    assert all(source.startswith(prefix) for source in sources)
    assert b"http://" not in page.body
    assert b"https://" not in page.body
    for path in (*sources, f"{prefix}_dash-layout", f"{prefix}_dash-dependencies"):
        answer = ask(server, path)
        assert answer.status == 200
        assert answer.headers["Cache-Control"] == "no-store"
        assert "'unsafe-eval'" not in answer.headers["Content-Security-Policy"]
        assert ask(server, path.replace(prefix, "/")).status == 404
        assert ask(server, path.replace(prefix, f"/{'x' * 32}/")).status == 404
        assert ask(server, path, Origin="http://example.org").status == 403
        assert ask(server, path, Host="example.org").status == 403
    body = b"{}"
    path = f"{prefix}_dash-update-component"
    assert ask(server, path, body, Origin="http://example.org", Content_Type="application/json").status == 403
    assert ask(server, "/_dash-update-component", body, Content_Type="application/json").status == 404


@pytest.mark.parametrize(
    "path",
    [
        "s/../../token", "s/%2e%2e/token", "s/KEY/files/../settings.json", "s/KEY/files/%2e%2e%2fsettings.json",
        "s/KEY/settings.json", "s/KEY/files/settings.json", "s/KEY/files/", "s/KEY/closed", "token", "static/x",
        "assets/../home.py", "assets/%2e%2e/home.py", "assets/..%2fhome.py", "s/x/", "s/" + "a" * 12 + "/",
        "_dash-component-suites/dash/../fctd/app/home.py", "_dash-component-suites/fctd/app/home.py", "admin",
    ],
)  # fmt: skip
def test_no_path_leads_elsewhere(path: str, server: AppServer) -> None:
    key = server.sessions.new().key
    answer = ask(server, server.home.prefix + path.replace("KEY", key))
    assert answer.status == 404
    assert server.home.token.encode() not in answer.body
    assert b"class Home" not in answer.body


def test_too_large_a_request_is_refused(server: AppServer) -> None:
    from fctd.app.server import MOST_RECEIVED

    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=HANG)
    connection.putrequest("POST", f"{server.home.prefix}_dash-update-component")
    connection.putheader("Content-Length", str(MOST_RECEIVED + 1))
    connection.endheaders()  # refused before it is sent
    assert connection.getresponse().status == 413
    connection.close()


def test_files_are_taken_or_refused_in_words(server: AppServer) -> None:
    session = server.sessions.new()
    assert upload(server, session.key, well_dot_toml=TEXT.encode(), survey_dot_csv=SURVEY) == ""
    assert session.source == source()
    kept = session.source
    hostile = {
        "other": (TEXT.replace('"survey.csv"', '"/etc/passwd"').encode(), "uploaded with the case"),
        "binary": (b"\x00\x01\x02", "UTF-8"),
        "words": (b"name = 3", "expected"),
    }
    hostile["binary"] = (b"\xff\xfe\x00", "UTF-8")
    for content, words in hostile.values():
        said = upload(server, session.key, well_dot_toml=content, survey_dot_csv=SURVEY)
        assert words in said
        assert "root:" not in said
    for content, words in (
        (bytes(1000), "expected a survey"), (b"<!DOCTYPE a><a/>", "DOCTYPE"), (b"PK\x03\x04" + bytes(99), "xlsx"),
        (b"md_m,inc_deg,azi_deg\n0,<b>0</b>,0\n", "<b>0</b>"),
    ):  # fmt: skip
        assert words in upload(server, session.key, survey_dot_csv=content)
    assert session.source is kept
    assert upload(server, session.key, _dot__dot__slash_x_dot_csv=SURVEY) == ""
    assert session.source is not None
    assert session.source.survey_name == "x.csv"


def opened(server: AppServer, key: str) -> Any:
    where = [("where", "pathname", f"{server.home.prefix}s/{key}/")]
    return call(server, key, "opened.data", where, [])


def wish(of: Session | None, **given: Any) -> dict[str, Any]:
    """What a page asks whose session it has opened."""
    usual = {
        "of": "" if of is None else of.well,
        "values": {"mud": 1300}, "operations": ["trip_out"], "operation": "trip_out", "depth": 800, "coarse": False,
        "colour": "tension", "hole": False, "n": 7,
    }  # fmt: skip
    return usual | given


def test_a_killed_server_goes_on_at_its_address(tmp_path: Path) -> None:
    from fctd.app.page import GRAPHS

    with served(tmp_path / "app") as server:
        address = server.begin(source())
        key = address.rstrip("/").rpartition("/")[2]
        before = opened(server, key)
        assert before["name"]["children"] == NAME
        found = call(server, key, "answered.data", [("wish", "data", wish(server.sessions.get(key)))], [])
        answered = found["answered"]["data"]
        assert answered["n"] == 7
        assert all(way[0] in ("data", "layout") for name in GRAPHS for way, _ in answered[name])
        assert "picking up, bit at 800 m" in found["at"]["children"]
    with served(tmp_path / "app") as server:
        assert server.address(key) == address
        after = opened(server, key)
        assert after["opened"]["data"]["values"] == {"mud": 1300}
        assert after["depth"]["value"] == 800
        assert ask(server, server.home.prefix).headers["Location"].endswith(f"/s/{key}/")
        server.home.new_token()
        server.home.leave()
    with served(tmp_path / "app") as server:
        assert ask(server, address.partition(str(server.port))[2]).status == 404
        assert opened(server, key)["name"]["children"] == NAME


def test_what_the_page_never_asks_is_answered_in_words(server: AppServer) -> None:
    session = server.sessions.new()
    session.put(source())
    for wrong in (
        {},
        *(
            wish(session, **given)
            for given in (
                {"values": {"mud": 1e9}},
                {"operation": "<b>"},
                {"colour": 3},
                {"operations": 5},
            )
        ),
    ):
        found = call(server, session.key, "answered.data", [("wish", "data", wrong)], [])
        assert found["fault"]["children"], wrong
        assert found["answered"]["data"].keys() == {"n"}
    assert set(session.settings) == {"survey", "well"}
    found = call(server, "x" * 12, "answered.data", [("wish", "data", wish(None))], [])
    assert "open the page anew" in found["fault"]["children"]


def test_a_page_follows_another_one_at_its_address(server: AppServer) -> None:
    """It would show the answers of one well under the name of another."""
    session = server.sessions.new()
    session.put(source())
    before, page = wish(session), opened(server, session.key)
    seen = [("tick", "n_intervals", 1)], [("opened", "data", page["opened"]["data"])]
    assert "changed" not in call(server, session.key, "run-kept.data", *seen)
    session.put(source(TEXT.replace(NAME, "another")))  # by the other page
    found = call(server, session.key, "answered.data", [("wish", "data", before)], [])
    assert found["changed"]["data"]
    assert found["answered"]["data"].keys() == {"n"}
    assert "words" not in found
    assert set(session.settings) == {"survey", "well"}
    assert call(server, session.key, "run-kept.data", *seen)["changed"]["data"]
    page = opened(server, session.key)
    assert (page["name"]["children"], page["words"]["children"]) == ("another", "")


def test_a_case_that_is_taken_again_begins_anew(server: AppServer, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same files come while a move of the page before is being solved, which must not move the new one."""
    session, ask_pool = server.sessions.new(), server.pool.ask
    session.put(source())

    def solved_late(do: str, *given: Any, **named: Any) -> Any:
        found = ask_pool(do, *given, **named)
        if do == "solve":
            session.put(source())
        return found

    monkeypatch.setattr(server.pool, "ask", solved_late)
    moved = wish(session)
    call(server, session.key, "answered.data", [("wish", "data", moved)], [])
    assert opened(server, session.key)["opened"]["data"]["values"] == {}
    found = call(server, session.key, "answered.data", [("wish", "data", moved)], [])  # one that came later still
    assert found["changed"]["data"]
    assert opened(server, session.key)["opened"]["data"]["values"] == {}


def test_a_run_begins_where_the_sliders_stand(server: AppServer, monkeypatch: pytest.MonkeyPatch) -> None:
    """Their last move may not have been solved yet, and is not among the settings."""
    session, begun = server.sessions.new(), list[str]()
    session.put(source())
    monkeypatch.setattr(server.runs, "start", lambda session, text, name, survey: begun.append(text))
    page = opened(server, session.key)["opened"]["data"]
    places = [1300 if name == "mud" else at for name, at in page["own"].items()]
    # Dash gives the values of parts that belong together in one list.
    call(server, session.key, "run-told.children", [("run", "n_clicks", 1)], [
        ("opened", "data", page), ('{"slider":["ALL"]}', "value", places),
    ])  # fmt: skip
    assert [tomllib.loads(text)["mud"]["density"] for text in begun] == [1300.0]


def test_new_pages_drop_none_with_a_run(server: AppServer, monkeypatch: pytest.MonkeyPatch) -> None:
    key = server.sessions.new().key
    os.utime(server.home.folder / "sessions" / key, (0, 0))
    monkeypatch.setattr(server.runs, "running", lambda: {key})
    for _ in range(MOST_SESSIONS + 1):
        assert ask(server, f"{server.home.prefix}new").status == 302
    assert ask(server, f"{server.home.prefix}s/{key}/").status == 200


def test_operations_are_added_to_those_of_a_case(server: AppServer, monkeypatch: pytest.MonkeyPatch) -> None:
    session, begun = server.sessions.new(), list[str]()
    session.put(source())
    monkeypatch.setattr(server.runs, "start", lambda session, text, name, survey: begun.append(text))
    page = opened(server, session.key)["opened"]["data"]

    def run(more: str) -> Any:
        return call(server, session.key, "run-told.children", [("run", "n_clicks", 1)], [
            ("opened", "data", page), ('{"slider":["ALL"]}', "value", [*page["own"].values()]),
            ("more-operations", "value", more),
        ])  # fmt: skip

    run("\n".join(to_paste("900 m")))
    run("")
    more, own = (tomllib.loads(text).get("operations", []) for text in begun)
    assert more == [*own, {"kind": "rotate_off_bottom", "at_md": "900 m", "duration": "60 s", "rpm": 60}]
    for wrong in ('[wellbore]\nsurvey = "/etc/passwd"', "[[operations]", 'name = "x"', "a." * 40_000 + "a = 1"):
        assert "operations" in str(run(wrong)["run-told"])
    assert len(begun) == 2


def test_requests_that_no_page_makes_are_told_in_a_line(server: AppServer, capfd: pytest.CaptureFixture[str]) -> None:
    path = f"{server.home.prefix}_dash-update-component"
    for body in (b"", b"{", b"[]", b"{}", b'{"output": "x.y", "changedPropIds": []}', b"\xff" * 99):
        assert 400 <= ask(server, path, body, Content_Type="application/json").status < 500
    said = capfd.readouterr().err
    assert "Traceback" not in said
    assert server.home.token not in said


def test_a_page_says_that_it_is_closed(server: AppServer) -> None:
    key = server.sessions.new().key
    assert ask(server, f"{server.home.prefix}s/{key}/closed", b"").status == 204


def test_files_come_as_attachments(server: AppServer) -> None:
    session = server.sessions.new()
    session.put(source())
    address = f"{server.home.prefix}s/{session.key}/files/"
    for name in ("case.toml", "profile.csv"):
        answer = ask(server, address + name)
        assert answer.status == 200
        assert answer.headers["Content-Disposition"].startswith("attachment;")
        assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert ask(server, address + "case.toml").body == TEXT.encode()
    assert set(FILES) > {"case.toml", "profile.csv"}


def test_the_first_page_has_a_well(server: AppServer) -> None:
    answer = ask(server, f"{server.home.prefix}new")
    assert answer.status == 302
    key = answer.headers["Location"].rstrip("/").rpartition("/")[2]
    assert opened(server, key)["name"]["children"] == "a first well"


def test_connections_that_send_nothing_stop_nobody(server: AppServer) -> None:
    """Of a program of this machine: the headers of 200 requests never end."""
    with ExitStack() as stack:
        for _ in range(200):
            idle = stack.enter_context(socket.create_connection(("127.0.0.1", server.port), timeout=HANG))
            idle.sendall(b"GET / HTTP/1.1\r\nHost: ")
        assert ask(server, f"{server.home.prefix}_dash-dependencies").status == 200


def test_a_port_that_is_taken(tmp_path: Path) -> None:
    from fctd.app.server import listening

    with listening(None, 0) as first:
        first.listen()
        port = first.getsockname()[1]
        with pytest.raises(InputError, match="a free port"):
            listening(port, port)
        with listening(None, port) as other:
            assert other.getsockname()[1] != port
