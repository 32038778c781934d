"""Pages in a real browser: Chromium draws them, and what it complains of or asks for from elsewhere is kept.

Tests that need one are marked ``browser`` and skip by name where there is none.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from numpy.typing import NDArray

from fctd.view import still
from fctd.view.still import browser_path, open_browser
from tests.commands import HANG

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

# Plotly's scene reads its canvas back; Chromium advises another setting of it.
KNOWN = "willReadFrequently"
HERE = ("file:", "data:", "blob:")
LONGEST = int(1e3 * HANG)  # [ms]


def missing() -> str:
    """Why there is no browser, or nothing."""
    try:
        import playwright  # noqa: F401
    except ModuleNotFoundError:
        return "no playwright: pip install -e '.[browser]'"
    return "" if browser_path() else "no Chromium: apt-get install chromium"


needs_browser = [pytest.mark.browser, pytest.mark.skipif(bool(missing()), reason=missing())]


@dataclass
class Seen:
    """What a page has said and asked for."""

    said: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)

    def check(self) -> None:
        """No error or unknown warning, and no request to another address."""
        assert self.said == []
        assert self.asked == []


_SHARED = ExitStack()


@cache
def shared() -> Browser:
    """The browser of all tests, which takes seconds to start; ``close`` ends it."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(still, "LONGEST", HANG)
        return _SHARED.enter_context(open_browser())


def close() -> None:
    """End the shared browser."""
    _SHARED.close()
    shared.cache_clear()


@contextmanager
def opened(path: Path | str, width: int = 1280, height: int = 800) -> Iterator[tuple[Page, Seen]]:
    """A page, of a file or at an address, in a window of a size [px]; what it says and asks for elsewhere is empty in
    the end."""
    address = path if isinstance(path, str) else path.resolve().as_uri()
    own = (*HERE, "/".join(address.split("/")[:4])) if isinstance(path, str) else HERE
    page, seen = shared().new_page(viewport={"width": width, "height": height}), Seen()
    page.set_default_timeout(LONGEST)

    def said(message: Any) -> None:
        if message.type in ("error", "warning") and KNOWN not in message.text:
            seen.said.append(f"{message.type}: {message.text}")

    page.on("console", said)
    page.on("pageerror", lambda error: seen.said.append(f"exception: {error}"))
    page.on("request", lambda request: None if request.url.startswith(own) else seen.asked.append(request.url))
    try:
        page.goto(address)
        yield page, seen
        seen.check()
    finally:
        page.close()


def pixels(page: Page) -> NDArray[np.int16]:
    """The window as it is painted, (height, width, 3)."""
    from PIL import Image

    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"), np.int16)


def until(page: Page, wanted: Callable[[], object]) -> None:
    """Wait; the policy of a page may forbid playwright's own way of waiting, which evaluates text."""
    for _ in range(LONGEST // 50):
        if wanted():
            return
        page.wait_for_timeout(50)
    assert wanted()


def at_rest(page: Page) -> NDArray[np.int16]:
    """The window as it is painted once nothing moves any more."""
    found = [pixels(page)]

    def rests() -> bool:
        page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        found.append(pixels(page))
        return bool((found[-1] == found[-2]).all())

    until(page, rests)
    return found[-1]


def overflow(page: Page) -> int:
    """By how much the page is wider than its window [px]."""
    return int(page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth"))
