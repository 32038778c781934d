"""Pages of charts and profiles in a real browser: at every width their panels are readable and inside the window."""

from pathlib import Path

import pytest

from fctd import plots
from fctd.case.operations import KINDS
from fctd.plots.tracks import TRACKS
from tests.browsers import needs_browser, opened, overflow
from tests.plots.made import chart, points, well

pytestmark = needs_browser

CASE = well(rig={"block_weight": 3e4}).model_copy(update={"name": "<a href='https://example.org'>well</a> & $x$"})
# Left and right edge in the window and height of each panel [px], by plotly's own axes.
AXES = """() => {
  const gd = document.getElementById("fctd"), { left } = gd.getBoundingClientRect(), made = gd._fullLayout;
  return Object.keys(made).filter((key) => /^xaxis\\d*$/.test(key)).map((key) => {
    const x = made[key], y = made[key.replace("x", "y")];
    return [left + x._offset, left + x._offset + x._length, y._length];
  });
}"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Two groups of curves, and eight tracks."""
    folder = tmp_path_factory.mktemp("pages")
    drawn = {
        "chart": plots.chart_page(chart(list(KINDS), [0.2, 0.3]), "si", CASE),
        "profile": plots.profile_page(points()),
    }
    return {name: plots.save_page(figure, folder / f"{name}.html")[0] for name, figure in drawn.items()}


@pytest.mark.parametrize("name", ["chart", "profile"])
def test_panels_are_readable_at_every_width(files: dict[str, Path], name: str) -> None:
    count = {"chart": 4, "profile": len(TRACKS)}[name]
    with opened(files[name]) as (shown, _):
        heights = {}
        for width in (1280, 400, 1920):
            shown.set_viewport_size({"width": width, "height": 800})
            shown.wait_for_function("document.getElementById('fctd')._fullLayout.width === innerWidth")
            assert overflow(shown) <= 0, width
            panels = shown.evaluate(AXES)
            assert len(panels) == count
            for left, right, high in panels:
                assert left >= 0
                assert right <= width
                assert right - left >= 80
                assert high >= 250
            heights[width] = shown.evaluate("document.getElementById('fctd').clientHeight")
        # Stacked in the narrow window, and back again in the wide one.
        assert heights[400] > 1.5 * heights[1280] == 1.5 * heights[1920]
        assert shown.evaluate("document.querySelector('.infolayer .legend').getBoundingClientRect().right") <= 1920


def test_the_heading_is_text(files: dict[str, Path]) -> None:
    with opened(files["chart"], 400) as (shown, _):
        assert shown.locator("h1").inner_text().startswith("<a href='https://example.org'>well</a> & $x$")
        assert shown.title().startswith("<a href=")
        assert shown.locator("a[href*=example]").count() == 0
        # Nothing of it is drawn a second time.
        assert shown.locator(".gtitle").count() == 0
