"""How fast the live page follows its sliders: ``python -m benchmarks.live_page [MOVES]``.

The well is the paper's, with 70 depths of three operations, cut into 61, 161 and 461 segments.  A move is a friction
factor that has not been asked before.  Beside the time that the server takes stands the processor time that its
processes spend, which other work on the machine lengthens less; ``load`` is that of the machine.
"""

import base64
import http.client
import json
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from fctd.store.limits import cores
from fctd.view.still import browser_path, open_browser

CASES: Final = Path(__file__).parents[1] / "validation" / "cases"
SEGMENTS: Final = {61: (20, 40), 161: (53, 107), 461: (153, 307)}  # collars, pipe; beside the long one
SESSIONS: Final = 10
OPERATIONS: Final = ["trip_out", "rotate_off_bottom", "trip_in"]
PICTURES: Final = {"loads": "chart", "panels": "panels", "scene": "scene"}
# When a key went down, and when each picture was painted after it.
WATCH: Final = """(ids) => {
  window.painted = {}; window.down = 0;
  document.addEventListener("keydown", () => { window.down = performance.now(); window.painted = {}; }, true);
  for (const id of ids) {
    document.querySelector(`#${id} .js-plotly-plot`).on("plotly_afterplot", () =>
      requestAnimationFrame(() => setTimeout(() => { window.painted[id] ??= performance.now() - window.down; })));
  }
}"""


class PageServer:
    """``fctd app`` of a case, as a process."""

    def __init__(self, address: str, process: int) -> None:
        self.address, self.process = address, process
        _, _, host, *parts = address.split("/")
        self.port, self.path = host.partition(":")[2], f"/{'/'.join(parts)}"
        self.prefix = f"/{self.path.split('/')[1]}/"
        self._callbacks = json.loads(self.ask("GET", f"{self.prefix}_dash-dependencies"))
        self._wells: dict[str, str] = {}

    def ask(self, method: str, path: str, body: bytes | None = None) -> bytes:
        """The body of an answer, or where it leads."""
        connection = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=120)
        connection.request(method, path, body, {"Content-Type": "application/json"})
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        assert answer.status < 400, content[:500]
        return content if answer.status != 302 else (answer.getheader("Location") or "").encode()

    def move(self, friction: float, *, coarse: bool, session: str = "") -> float:
        """Seconds until the answer to a move of a slider."""
        path = session or self.path
        wish = {
            "of": self.well_at(path), "values": {"friction_None": friction}, "operations": OPERATIONS,
            "operation": "trip_out", "depth": 2450, "colour": "side_force", "coarse": coarse, "hole": False, "n": 1,
        }  # fmt: skip
        began = time.perf_counter()
        found = self.call("answered.data", {"wish.data": wish}, path)
        took = time.perf_counter() - began
        assert "loads" in found["answered"]["data"], found["fault"]
        return took

    def well_at(self, path: str) -> str:
        """The name of the well of a page, which it is told when it is opened."""
        if path not in self._wells:
            found = self.call("opened.data", {"changed.data": None, "reset.n_clicks": None}, path)
            self._wells[path] = found["opened"]["data"]["of"]
        return self._wells[path]

    def begin(self, case: bytes, survey: bytes) -> str:
        """The path of a new session with a case."""
        path = self.ask("GET", f"{self.prefix}new").decode()
        contents = ["data:;base64," + base64.b64encode(content).decode() for content in (case, survey)]
        given = {"upload.contents": contents, "upload.filename": ["well.toml", "paper_well.csv"]}
        assert not self.call("upload-fault.children", given, path)["upload-fault"]["children"]
        return path

    def call(self, output: str, given: dict[str, Any], path: str) -> dict[str, Any]:
        """What a callback of the page of a session answers; given : values by part and property."""
        given = given | {"where.pathname": path}
        one = next(
            each
            for each in self._callbacks
            if output in each["output"] and all(f"{of['id']}.{of['property']}" in given for of in each["inputs"])
        )
        outputs = [text.rpartition(".")[::2] for text in one["output"].strip(".").split("...")]

        def filled(wanted: list[dict[str, Any]]) -> list[dict[str, Any]]:
            return [{**each, "value": given[f"{each['id']}.{each['property']}"]} for each in wanted]

        body = {
            "output": one["output"], "outputs": [{"id": name, "property": prop} for name, prop in outputs],
            "inputs": filled(one["inputs"]), "state": filled(one["state"]),
            "changedPropIds": [f"{one['inputs'][0]['id']}.{one['inputs'][0]['property']}"],
        }  # fmt: skip
        answer = self.ask("POST", f"{self.prefix}_dash-update-component", json.dumps(body).encode())
        found: dict[str, Any] = json.loads(answer)["response"]
        return found

    def spent(self) -> float:
        """Processor seconds of the server and the processes below it, so far."""
        ticks, tree = 0, {self.process}
        for entry in sorted(Path("/proc").glob("[0-9]*/stat"), key=lambda path: int(path.parent.name)):
            try:
                rest = entry.read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(entry.parent.name) in tree or int(rest[1]) in tree:
                tree.add(int(entry.parent.name))
                ticks += int(rest[11]) + int(rest[12])
        return ticks / os.sysconf("SC_CLK_TCK")


def case_in(folder: Path, segments: tuple[int, int]) -> None:
    """Write the paper's well as ``well.toml``; segments : of collars and of pipe."""
    text = (CASES / "paper_well.toml").read_text("utf-8")
    for before, after in zip((20, 40), segments, strict=True):
        text = text.replace(f"segments = {before}\n", f"segments = {after}\n")
    (folder / "well.toml").write_text(text, "utf-8")
    (folder / "paper_well.csv").write_bytes((CASES / "paper_well.csv").read_bytes())


@contextmanager
def served(segments: int) -> Iterator[PageServer]:
    """The page of the paper's well in so many segments."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        case_in(folder, SEGMENTS[segments])
        command = [sys.executable, "-P", "-m", "fctd", "app", "well.toml", "--no-browser"]
        environment = os.environ | {"XDG_STATE_HOME": scratch}
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)
        try:
            assert process.stdout is not None
            yield PageServer(process.stdout.readline().split()[-1], process.pid)
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)


def answers(server: PageServer, moves: int) -> None:
    """Print how long the server takes for moves, and for sliders that rest."""
    for coarse, words in ((True, "every third depth"), (False, "all depths")):
        for k in range(3):
            server.move(0.3 + 0.001 * k, coarse=coarse)
        began, number = server.spent(), moves if coarse else max(moves // 5, 5)
        took = [server.move(0.1 + 0.002 * k, coarse=coarse) for k in range(number)]
        spent = (server.spent() - began) / number
        say(f"  answer, {words}", took, f"processor {1e3 * spent:.0f} ms each")


def at_once(server: PageServer) -> None:
    """Print how long ten sessions wait that move at the same time."""
    case, survey = (CASES / "paper_well.toml").read_bytes(), (CASES / "paper_well.csv").read_bytes()
    paths = [server.begin(case + b"# %d" % k, survey) for k in range(SESSIONS)]
    with ThreadPoolExecutor(SESSIONS) as pool:
        took = [
            each
            for k in range(5)
            for each in pool.map(
                lambda j, k=k: server.move(0.15 + 0.01 * k + 0.001 * j, coarse=True, session=paths[j]), range(SESSIONS)
            )
        ]
    say(f"  {SESSIONS} moves at once", took)


def painted(server: PageServer, moves: int) -> None:
    """Print the time from a key to each painted picture."""
    if browser_path() is None:
        print("  no browser: nothing is painted")
        return
    found: dict[str, list[float]] = {name: [] for name in PICTURES}
    with open_browser() as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(120_000)
        page.goto(server.address)
        page.locator("#words", has_text="points touch").wait_for()
        page.wait_for_timeout(3000)
        page.evaluate(WATCH, list(PICTURES))
        page.locator("#sliders [role=slider]").first.focus()
        for _ in range(moves):
            page.keyboard.press("ArrowRight" if len(found["loads"]) % 40 < 20 else "ArrowLeft")
            times: dict[str, Any] = {}
            while not set(PICTURES) <= set(times):
                page.wait_for_timeout(20)
                times = page.evaluate("() => window.painted")
            for name, values in found.items():
                values.append(1e-3 * times[name])
            page.wait_for_timeout(1500)  # all depths are solved and drawn meanwhile
    for name, values in found.items():
        say(f"  key to painted {PICTURES[name]}", values)


def say(what: str, took: list[float], more: str = "") -> None:
    """Print median and spread of times."""
    middle, last = statistics.median(took), sorted(took)[int(0.9 * (len(took) - 1))]
    load = f"load {os.getloadavg()[0]:.1f} on {cores()} processors"
    print(f"{what}: median {1e3 * middle:.0f} ms, 9 of 10 below {1e3 * last:.0f} ms; {more + ', ' * bool(more)}{load}")


def main(moves: int = 50) -> None:
    """Measure and print."""
    for segments in SEGMENTS:
        print(f"{segments} segments, 70 depths × 3 operations", flush=True)
        with served(segments) as server:
            answers(server, moves)
            if segments == 61:
                at_once(server)
            painted(server, moves if segments == 61 else moves // 5)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
