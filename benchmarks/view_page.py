"""How large a page of ``fctd view`` is, and how fast it opens and draws: ``python -m benchmarks.view_page [MOVES]``.

The well is the paper's, its string cut into 301 segments, at 100 bit depths.  A move is a step of the slider, in a
browser window of 1,280 × 800 without a graphics card.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.live_page import case_in, say
from fctd.view.still import browser_path, open_browser

SIZES = (100, 200)  # segments of collars and pipe, beside the long one
DEPTHS = "1757:2450:7"
# Times of a step [s]: of the scene and of everything until it is drawn, of everything until it is painted, and of the
# scene alone, drawn once more, until it is painted.
STEP = """async (step) => {
  const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const began = performance.now();
  await window.fctd.show(step);
  const drawn = window.fctd.times[window.fctd.times.length - 1];
  await painted();
  const all = performance.now() - began, again = performance.now();
  const scene = document.getElementById("scene");
  const anew = ({ x, y, z, ...trace }) => ({ ...trace, x: x.slice(), y: y.slice(), z: z.slice() });
  await Plotly.react(scene, window.fctd.data.scene.map(anew), scene.layout);
  await painted();
  return [...drawn, all, performance.now() - again].map((time) => 1e-3 * time);
}"""


def main(moves: int = 50) -> None:
    """Measure and print."""
    if browser_path() is None:
        sys.exit("no browser: nothing is drawn")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        case_in(folder, SIZES)
        command = [
            sys.executable,
            "-P",
            "-m",
            "fctd",
            "view",
            "well.toml",
            "--operation",
            "trip_out",
            "--depths",
            DEPTHS,
        ]
        subprocess.run([*command, "--out", "view.html", "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        file = folder / "view.html"
        print(f"{sum(SIZES) + 1} segments, 100 depths: {file.stat().st_size / 1e6:.2f} MB")
        opened: list[float] = []
        found: dict[str, list[float]] = {
            "scene drawn": [],
            "all drawn": [],
            "all painted": [],
            "scene alone painted": [],
        }
        with open_browser() as browser:
            for _ in range(5):
                page: Any = browser.new_page(viewport={"width": 1280, "height": 800})
                began = time.perf_counter()
                page.goto(file.as_uri())
                page.wait_for_function("document.documentElement.dataset.ready === 'yes'")
                opened.append(time.perf_counter() - began)
            for k in range(moves):
                for name, value in zip(found, page.evaluate(STEP, 10 + k % 80), strict=True):
                    found[name].append(value)
    say("  opened", opened)
    for name, values in found.items():
        say(f"  {name}", values)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
