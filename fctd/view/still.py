"""Still pictures of a page by a browser, which draws the scene as a reader sees it.

Needs playwright, which the package installs as its extra ``browser``, and Chromium or Chrome; playwright's own browser
is not downloaded.
"""

import os
import shutil
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final

from fctd.case.errors import InputError
from fctd.store.whole_file import whole_file

if TYPE_CHECKING:
    from playwright.sync_api import Browser

NAMES: Final = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
VARIABLE: Final = "FCTD_BROWSER"  # names a browser that lies elsewhere
SIZE: Final = (1280, 800)  # of a still picture [px]
LONGEST: Final = 60.0  # until a browser has begun, a page is there, or is drawn [s]
# WebGL without a graphics card.
SOFTWARE: Final = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def browser_path() -> Path | None:
    """The browser of this machine, or None."""
    given = os.environ.get(VARIABLE)
    found = [shutil.which(name) for name in ([given] if given else NAMES)]
    return next((Path(path) for path in found if path), None)


@contextmanager
def open_browser(*flags: str, key: str = "") -> Iterator["Browser"]:
    """A headless browser; flags : of its command line, beside those of WebGL in software.

    Raises InputError, which names ``key``, where playwright or the browser is missing.
    """
    try:
        from playwright.sync_api import sync_playwright
    except ModuleNotFoundError as error:
        expected = f"the package {error.name} (pip install playwright, or the extra fctd[browser])"
        raise InputError(expected, key=key) from None
    path = browser_path()
    if path is None:
        expected = f"a browser: install chromium, or name one in the variable {VARIABLE}"
        raise InputError(expected, key=key, value=os.environ.get(VARIABLE, "none found"))
    # Chromium refuses to sandbox pages of root.
    sandbox = ("--no-sandbox",) if os.name == "posix" and os.geteuid() == 0 else ()
    with sync_playwright() as player:
        browser = player.chromium.launch(
            executable_path=path, args=[*SOFTWARE, *sandbox, *flags], timeout=1e3 * LONGEST
        )
        try:
            yield browser
        finally:
            browser.close()


def save_still(page_file: Path, picture: Path, size: tuple[int, int] = SIZE) -> list[Path]:
    """Write a picture (PNG) of a page of ``save_view``; returns the file.

    Raises InputError where there is no browser, where it cannot draw, and where the file cannot be written.
    """
    # A thread of its own: in a notebook an event loop runs already, which playwright does not share.
    with ThreadPoolExecutor(1) as thread:
        drawn = thread.submit(_photograph, page_file, size).result()
    with whole_file(picture) as scratch:
        scratch.write_bytes(drawn)
    return [picture]


def _photograph(page_file: Path, size: tuple[int, int]) -> bytes:
    """A page as PNG."""
    with open_browser(key="--png") as browser:
        from playwright.sync_api import Error

        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        page.set_default_timeout(1e3 * LONGEST)
        try:
            page.goto(page_file.resolve().as_uri())
            page.wait_for_function("document.documentElement.dataset.ready === 'yes'")
            return page.screenshot()
        except Error as error:
            expected = f"a browser that draws the page ({error.message.splitlines()[0]})"
            raise InputError(expected, key="--png", value=str(browser_path())) from None
