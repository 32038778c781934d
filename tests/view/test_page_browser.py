"""The page of a view in a real browser: the string has its colours where it lies, and moves with the slider."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from fctd.view import still
from fctd.view.page import save_view
from fctd.view.quantities import QUANTITIES
from fctd.view.scene import Look, panel_data, scene_data
from fctd.view.still import open_browser, save_still
from tests.browsers import LONGEST, at_rest, needs_browser, opened, overflow, pixels, until
from tests.commands import HANG
from tests.view.made import strings

pytestmark = needs_browser

READY = "document.documentElement.dataset.ready === 'yes'"
# Middles of the string's segments in the window [px], and the colours of both ends, by plotly's own camera.
PROJECTED = """() => {
  const scene = document.getElementById("scene")._fullLayout.scene._scene, { glplot, dataScale } = scene;
  const box = scene.container.getBoundingClientRect(), { model, view, projection } = glplot.cameraParams;
  const times = (m, v) => [0, 1, 2, 3].map((i) => [0, 1, 2, 3].reduce((sum, j) => sum + m[4 * j + i] * v[j], 0));
  const one = fctd.data.scene.find((trace) => trace.name === "string");
  const place = (k) => ["x", "y", "z"].map((axis, i) => 0.5 * (one[axis][k] + one[axis][k + 1]) * dataScale[i]);
  return Array.from({ length: one.x.length - 1 }, (_, k) => {
    const p = times(projection, times(view, times(model, [...place(k), 1])));
    return [box.left + box.width * (0.5 + p[0] / p[3] / 2), box.top + box.height * (0.5 - p[1] / p[3] / 2),
            one.line.color[k], one.line.color[k + 1]];
  });
}"""


@pytest.fixture(scope="module")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two operations at seven depths."""
    return save_view(strings(), tmp_path_factory.mktemp("view") / "view.html", "tension")[0]


@pytest.fixture(scope="module")
def view(page_file: Path) -> Iterator[Any]:
    """The page in a window of 1280 × 800, which all tests use one after the other."""
    with opened(page_file) as (page, _):
        ready(page)
        yield page


@pytest.fixture
def page(view: Any) -> Any:
    """The page as it was opened."""
    view.set_viewport_size({"width": 1280, "height": 800})
    view.click("[data-view=well]")
    view.select_option("#group", label="picking up")
    view.select_option("#colour", "tension")
    times = Look(strings()).exaggeration
    view.evaluate("(times) => { fctd.shown.picked = NaN; fctd.shown.times = times; return fctd.show(6); }", times)
    at_rest(view)
    return view


def ready(page: Any) -> None:
    """The page is drawn, and nothing failed."""
    page.wait_for_function(READY)
    assert page.locator("#fault").is_hidden(), page.locator("#fault").text_content()


def colour_of(value: float, made: Look) -> NDArray[np.float64]:
    """Colour of a tension [kN], of the scale of the string."""
    quantity = QUANTITIES["tension"]
    low, high = made.limits(quantity)
    stops = quantity.colours(low)
    rgb = np.array([[int(colour[k : k + 2], 16) for k in (1, 3, 5)] for _, colour in stops], float)
    share = np.clip((value - low) / (high - low), 0, 1)
    return np.array([np.interp(share, [at for at, _ in stops], rgb[:, k]) for k in range(3)])


def seen_segments(page: Any) -> NDArray[np.bool_]:
    """Which segments have their colour where they are projected, within two pixels."""
    painted, look, found = pixels(page), Look(strings()), []
    for x, y, above, below in page.evaluate(PROJECTED):
        wanted = colour_of(0.5 * (above + below), look)
        column, row = round(x), round(y)
        near = painted[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3].reshape(-1, 3)
        found.append(bool(len(near)) and float(np.abs(near - wanted).max(axis=1).min()) < 16)
    return np.array(found)


def test_the_string_is_where_it_lies_in_its_colours_and_moves_with_the_slider(page: Any) -> None:
    deep = pixels(page)
    assert seen_segments(page).mean() > 0.9
    last = page.evaluate(PROJECTED)
    assert "bit at 880.0 m" in page.locator("#where").inner_text()
    page.locator("#step").focus()
    for _ in range(6):  # keys move the slider
        page.keyboard.press("ArrowLeft")
    page.wait_for_function("document.getElementById('where').textContent.includes('400.0 m')")
    until(page, lambda: seen_segments(page).mean() > 0.9)
    assert len(page.evaluate(PROJECTED)) < len(last)
    # Where the deep string ended is nothing of its colour now.
    x, y, above, below = last[-3]
    window = (slice(round(y) - 2, round(y) + 3), slice(round(x) - 2, round(x) + 3))
    wanted = colour_of(0.5 * (above + below), Look(strings()))
    assert np.abs(deep[window] - wanted).max(axis=2).min() < 16
    assert np.abs(pixels(page)[window] - wanted).max(axis=2).min() > 16


def test_the_page_computes_what_the_figure_does(page: Any) -> None:
    made = strings()
    look, one = Look(made), made.of("trip_in")[3]
    page.select_option("#group", label="slacking off")
    page.evaluate("() => fctd.show(3)")
    data = page.evaluate("""() => Object.fromEntries([...fctd.data.scene, ...fctd.data.panels].map((trace) =>
      [trace.name, ["x", "y", "z"].filter((axis) => trace[axis]).map((axis) => Array.from(trace[axis]))]))""")
    words = page.locator("#words").inner_text()
    for name, places in scene_data(look, one).items():
        found = np.array(data[name], float).T.reshape(-1, 3)
        np.testing.assert_allclose(found, places, atol=0.01, err_msg=name)
    for name, (value, depth) in panel_data(look, one).items():
        np.testing.assert_allclose(np.array(data[name], float), [value, depth], rtol=1e-5, atol=1e-4, err_msg=name)
    assert f"{one.touching.sum()} of {len(one.offset)} points touch" in words


def differs(page: Any, before: NDArray[np.int16]) -> bool:
    """Whether the pictures below the tools are others than before."""
    return bool((pixels(page)[150:] != before[150:]).any())


def test_colours_cameras_and_play_change_the_picture(page: Any) -> None:
    before = pixels(page)
    page.select_option("#colour", "clearance")
    until(page, partial(differs, page, before))
    for name in ("bit", "along", "well"):
        page.click(f"[data-view={name}]")
        until(page, partial(differs, page, before))
        before = at_rest(page)
    page.fill("#times", "40")
    page.press("#times", "Enter")
    page.wait_for_function("document.getElementById('exaggerated').textContent === '40'")
    page.click("#play")
    page.wait_for_function("fctd.shown.step !== 6")
    page.click("#play")
    assert page.locator("#play").inner_text() == "▶ play"


def test_a_click_on_a_panel_picks_the_depth_in_the_scene(page: Any) -> None:
    x, y, md = page.evaluate("""() => {
      const gd = document.getElementById("panels"), box = gd.getBoundingClientRect();
      const { xaxis3: x, yaxis: y } = gd._fullLayout, one = gd.data.find((trace) => trace.name === "tension");
      const k = one.x.length >> 1;
      return [box.left + x._offset + x.d2p(one.x[k]), box.top + y._offset + y.d2p(one.y[k]), one.y[k]];
    }""")
    page.evaluate("document.getElementById('panels').on('plotly_hover', () => { window.hovered = true; })")
    page.mouse.move(x + 8, y)
    page.mouse.move(x, y)
    page.wait_for_function("window.hovered")
    page.mouse.click(x, y)
    page.wait_for_function("fctd.data.scene.find((trace) => trace.name === 'picked').x.length === 1")
    assert page.evaluate("fctd.shown.picked") == pytest.approx(md)


@pytest.mark.parametrize("width", [400, 1280, 1920])
def test_nothing_is_wider_than_the_page_and_names_are_text(page: Any, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 800})
    until(page, lambda: overflow(page) <= 0)
    at_rest(page)
    assert page.locator("h1").inner_text() == "<a href='https://example.org'>well</a> & $x$"
    assert page.locator("a[href*=example]").count() == 0
    names = page.locator("#panels :is(.xtitle, .x2title, .x3title)").evaluate_all(
        "(all) => all.map((one) => one.getBoundingClientRect().toJSON())"
    )
    assert all(one["right"] <= other["left"] for one, other in pairwise(sorted(names, key=lambda box: box["left"])))
    assert len(names) == 3


def without_webgl(path: Path) -> str:
    """What the page says in a browser that has none, after it has failed to be ready."""
    with open_browser("--disable-gpu", "--disable-3d-apis") as found:
        page = found.new_page()
        page.set_default_timeout(LONGEST)
        page.goto(path.resolve().as_uri())
        page.wait_for_function("!document.getElementById('fault').hidden")
        with pytest.raises(AssertionError, match="no WebGL"):
            ready(page)
        return str(page.locator("#fault").inner_text())


def test_a_page_without_webgl_says_so_and_is_not_taken_for_drawn(
    page_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(still, "LONGEST", HANG)
    with ThreadPoolExecutor(1) as thread:  # playwright allows one browser process a thread
        assert "no WebGL" in thread.submit(without_webgl, page_file).result()


def test_a_still_picture_is_that_of_the_page(page_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(still, "LONGEST", HANG)
    (picture,) = save_still(page_file, tmp_path / "view.png", (900, 600))
    from PIL import Image

    drawn = np.asarray(Image.open(picture).convert("RGB"), np.int16)
    assert drawn.shape == (600, 900, 3)
    # The string's colour at the top, where the tension is largest.
    wanted = colour_of(1e9, Look(strings()))
    assert (np.abs(drawn - wanted).max(axis=2) < 16).sum() > 20
