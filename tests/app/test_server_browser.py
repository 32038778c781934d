"""The live page in a real browser: sliders move the pictures, files come in, and its address outlives the server."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.app.made import NAME, SURVEY, TEXT
from tests.browsers import needs_browser, opened, overflow, pixels, until
from tests.commands import HANG

pytestmark = needs_browser

# Values of a curve as they are painted, none before its picture is there: words may come first.
CURVE = """(name) => Array.from(document.querySelector("#loads .js-plotly-plot")?._fullData
  ?.find((trace) => trace.name === name && trace.x.length > 1)?.x ?? [])"""
STRING = """() => Array.from(document.querySelector("#scene .js-plotly-plot")?._fullData
  ?.find((trace) => trace.name === "string")?.line?.color ?? [])"""
# The pictures in the order in which they are drawn from now on.
WATCH = """() => {
  window.drawn = [];
  for (const id of ["loads", "panels", "scene"]) {
    document.querySelector(`#${id} .js-plotly-plot`).on("plotly_afterplot", () => window.drawn.push(id));
  }
}"""


# The command, whose answers may take as long as they do on a busy machine.
PROGRAM = f"from fctd.app import pool; pool.LONGEST = {HANG}; from fctd.cli import main; main.main()"


class Program:
    """``fctd app`` as a process, which can be killed and started again."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.environment = folder, os.environ | {"XDG_STATE_HOME": str(folder / "state")}
        self.address = self.start("well.toml")

    def start(self, *case: str) -> str:
        command = [sys.executable, "-c", PROGRAM, "app", *case, "--no-browser"]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, text=True, cwd=self.folder, env=self.environment
        )
        assert self.process.stdout is not None
        match = re.fullmatch(r"The page: (\S+)\n", self.process.stdout.readline())
        assert match is not None
        return match[1]

    def end(self, number: int) -> None:
        self.process.send_signal(number)
        self.process.communicate(timeout=HANG)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Program]:
    folder = tmp_path_factory.mktemp("app")
    (folder / "survey.csv").write_bytes(SURVEY)
    (folder / "well.toml").write_text(TEXT)
    found = Program(folder)
    yield found
    found.end(signal.SIGINT)


@pytest.fixture
def page(program: Program) -> Iterator[Any]:
    """The page of the well, drawn; in the end it has said nothing and asked nobody else."""
    with opened(program.address) as (found, _):
        drawn(found)
        yield found


def drawn(page: Any) -> None:
    """The pictures are painted with data, and nothing is wrong."""
    page.locator("#words", has_text="points touch").wait_for()
    until(page, lambda: len(page.evaluate(STRING)) > 0)
    assert page.locator("#fault").is_hidden(), page.locator("#fault").text_content()


def test_a_slider_moves_all_pictures(page: Any) -> None:
    k = "picking up"
    chart, string, words = page.evaluate(CURVE, k), page.evaluate(STRING), page.locator("#words").inner_text()
    before = pixels(page)
    page.evaluate(WATCH)
    slider = page.locator("#sliders [role=slider]").nth(1)
    slider.focus()
    page.keyboard.press("ArrowRight")
    until(page, lambda: page.locator("#words").inner_text() != words)
    until(page, lambda: len(page.evaluate(CURVE, k)) == 70 and page.evaluate(CURVE, k) != chart)
    until(page, lambda: page.evaluate(STRING) != string)
    assert np.array(page.evaluate(CURVE, k))[-1] > np.array(chart)[-1]  # more friction, more load
    assert page.locator("#sliders output").nth(1).inner_text() == "0.26"
    until(page, lambda: "scene" in page.evaluate("window.drawn"))
    # A key moves a slider by two events, whose second answer may paint the loads again before the scene's turn.
    assert list(dict.fromkeys(page.evaluate("window.drawn"))) == ["loads", "panels", "scene"]
    until(page, lambda: (pixels(page) != before).any())
    page.locator("#reset").click()
    until(page, lambda: page.evaluate(CURVE, k) == chart)
    assert page.locator("#sliders output").nth(1).inner_text() == "0.25"


# How far the legend of the chart reaches over its panels [px], below 0 where it stands clear of them.
COVERED = """() => {
  const chart = document.querySelector("#loads .js-plotly-plot"), { t, h } = chart._fullLayout._size;
  const top = (part) => part.getBoundingClientRect().top;
  return top(chart) + t + h - top(chart.querySelector(".infolayer .legend"));
}"""


def test_names_are_text_and_nothing_is_wider_than_the_page(page: Any) -> None:
    assert page.locator("h1").inner_text() == NAME
    assert page.locator("a[href*=example]").count() == 0
    for width in (400, 1280, 1920):
        page.set_viewport_size({"width": width, "height": 800})
        until(page, lambda: overflow(page) <= 0)  # pictures follow the window
        until(page, lambda: -100 < page.evaluate(COVERED) <= 0)
    labels = page.locator("[role=slider]").evaluate_all("of => of.map((one) => one.getAttribute('aria-label'))")
    assert len(labels) == len(set(labels)) > 5
    assert all(labels)


def test_a_survey_that_is_chosen_becomes_a_case_and_a_case_is_run(page: Any) -> None:
    page.locator("#upload input").set_input_files(
        [{"name": "my <b>well.csv", "mimeType": "text/csv", "buffer": SURVEY.replace(b"900", b"950")}]
    )
    page.locator("h1", has_text="my <b>well").wait_for()
    page.locator("#facts", has_text="950 m deep").wait_for()
    drawn(page)
    page.locator("#upload input").set_input_files(
        [{"name": "x.csv", "mimeType": "text/csv", "buffer": b"\x00\x01 <img src=x onerror=alert(1)>"}]
    )
    page.locator("#upload-fault", has_text="expected a survey").wait_for()
    assert page.locator("img").count() == 0
    page.locator("#upload input").set_input_files(
        [
            {"name": "well.toml", "mimeType": "text/plain", "buffer": TEXT.encode()},
            {"name": "survey.csv", "mimeType": "text/csv", "buffer": SURVEY},
        ]
    )
    page.locator("h1", has_text=NAME).wait_for()
    assert page.locator("#upload-fault").is_hidden()
    page.locator("#run").click()
    page.locator("#run-words", has_text="points touch").wait_for()
    until(page, lambda: len(page.evaluate(STRING.replace("#scene", "#run-scene"))) > 30)
    page.locator("#run-told", has_text="completed").wait_for()


def test_the_same_files_are_taken_again(page: Any) -> None:
    """After a refusal a file is renamed, and its content is the same; after moves of sliders a case begins anew."""
    case = {"name": "well.toml", "mimeType": "text/plain", "buffer": TEXT.encode()}
    survey = {"name": "survey.csv", "mimeType": "text/csv", "buffer": SURVEY}
    page.locator("#upload input").set_input_files([case, survey | {"name": "Survey.csv"}])
    page.locator("#upload-fault", has_text='the file that came is "Survey.csv"').wait_for()
    mud, slider = page.locator("#sliders output").nth(2), page.locator("#sliders [role=slider]").nth(2)

    def moved() -> bool:
        """Whether the slider has moved; a key is lost where the page draws it anew, as it may after a case came."""
        slider.focus()
        page.keyboard.press("End")
        return bool(mud.inner_text() != "1200")

    until(page, moved)
    page.locator("#upload input").set_input_files([case, survey])
    until(page, lambda: page.locator("#upload-fault").is_hidden() and mud.inner_text() == "1200")
    until(page, moved)
    page.locator("#upload input").set_input_files([case, survey])
    until(page, lambda: mud.inner_text() == "1200")


def test_two_pages_of_an_address_show_one_well_and_a_new_page_another(page: Any, program: Program) -> None:
    with opened(program.address) as (other, _):
        drawn(other)
        other.locator("#upload input").set_input_files(
            [{"name": "deeper.csv", "mimeType": "text/csv", "buffer": SURVEY.replace(b"900", b"950")}]
        )
        page.locator("h1", has_text="deeper").wait_for()
        drawn(page)
        with other.expect_popup() as popup:
            other.locator("a.another").click()
        new = popup.value
        new.locator("h1", has_text="a first well").wait_for()
        assert new.url != other.url
        new.close()
    page.locator("#upload input").set_input_files(
        [
            {"name": "well.toml", "mimeType": "text/plain", "buffer": TEXT.encode()},
            {"name": "survey.csv", "mimeType": "text/csv", "buffer": SURVEY},
        ]
    )
    page.locator("h1", has_text=NAME).wait_for()


def test_files_that_are_too_large_are_refused_on_the_page(page: Any) -> None:
    """A request has at most 5 MiB, and the file comes in base64."""
    page.locator("#upload input").set_input_files(
        [{"name": "large.csv", "mimeType": "text/csv", "buffer": b"0" * (4 * 2**20)}]
    )
    page.locator("#upload-fault", has_text="large.csv: expected files of at most 3.5 MiB").wait_for()
    assert page.locator("h1").inner_text() == NAME


def test_pictures_of_before_are_marked_while_new_ones_are_computed(page: Any) -> None:
    """The server's answer is held back; in the end the mark is gone."""
    held: list[Any] = []

    def hold(route: Any) -> None:
        first = not held and '"id":"wish"' in (route.request.post_data or "")
        held.append(route) if first else route.continue_()

    page.route(lambda address: "_dash-update-component" in address, hold)
    page.locator("#sliders [role=slider]").nth(1).focus()
    page.keyboard.press("ArrowRight")
    page.locator("#page[aria-busy=true]").wait_for()
    held[0].continue_()
    until(page, lambda: page.locator("#page").get_attribute("aria-busy") == "false")
    page.locator("#reset").click()


def test_pictures_stay_marked_where_the_server_refuses(page: Any) -> None:
    """The sliders stand where no picture is of."""

    def spoil(route: Any) -> None:
        asked = route.request.post_data or ""
        route.continue_(post_data=asked.replace('"operation":"trip_out"', '"operation":"none"'))

    page.route(lambda address: "_dash-update-component" in address, spoil)
    page.locator("#sliders [role=slider]").nth(1).focus()
    page.keyboard.press("ArrowRight")
    page.locator("#fault", has_text="a kind of operation").wait_for()
    page.locator("#page[data-before]").wait_for()
    page.unroute_all()
    page.locator("#reset").click()
    until(page, lambda: page.locator("#page[data-before]").count() == 0 and page.locator("#fault").is_hidden())


def test_the_address_of_a_killed_server_shows_the_same_page(program: Program) -> None:
    settings = program.folder / "state/fctd/app/sessions" / program.address.rstrip("/").rpartition("/")[2]
    with opened(program.address) as (page, _):
        drawn(page)
        page.locator("#sliders [role=slider]").nth(2).focus()
        page.keyboard.press("ArrowLeft")
        mud = page.locator("#sliders output").nth(2)
        until(page, lambda: f'"mud": {mud.inner_text()}' in (settings / "settings.json").read_text())
        moved = mud.inner_text()
    program.end(signal.SIGKILL)
    assert program.start().startswith(program.address.rpartition("/s/")[0])
    with opened(program.address) as (page, _):
        drawn(page)
        assert page.locator("#sliders output").nth(2).inner_text() == moved
