"""The docs site in a real browser, from the disk: it asks for nothing from elsewhere, finds words, fits its window."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.browsers import needs_browser, opened, overflow

from .test_site import dead, outside

pytestmark = needs_browser
SITE = Path(__file__).parents[2] / "docs" / "out"


@pytest.fixture(scope="module")
def page() -> Iterator[Any]:
    """A window on the first page; in the end no page has complained or asked for anything."""
    if not (SITE / "index.html").exists():
        pytest.skip("no docs site: make docs")
    with opened(SITE / "index.html") as (shown, _):
        yield shown


def test_every_page_opens_and_fits(page: Any) -> None:
    """The sources, which are code and may be wide, scroll within themselves."""
    pages = [path for path in sorted(SITE.rglob("*.html")) if "_modules" not in path.parts]
    assert len(pages) > 35
    assert outside(SITE) == []
    assert dead(SITE) == []
    wide = {}
    for path in pages:
        page.goto(path.resolve().as_uri())
        assert page.title()
        for width in (400, 1280):
            page.set_viewport_size({"width": width, "height": 800})
            wide[path.name, width] = overflow(page)
    assert {at: by for at, by in wide.items() if by > 0} == {}


def test_the_search_finds_a_page(page: Any) -> None:
    page.goto((SITE / "index.html").resolve().as_uri())
    page.set_viewport_size({"width": 1280, "height": 800})
    page.fill("input[name=q]", "sagitta")
    page.press("input[name=q]", "Enter")
    page.wait_for_selector("#search-results a[href*='theory']")


def test_equations_are_drawn(page: Any) -> None:
    page.goto((SITE / "theory.html").resolve().as_uri())
    heights = page.evaluate(
        "Array.from(document.querySelectorAll('math mfrac'), (one) => one.getBoundingClientRect().height)"
    )
    assert len(heights) > 20
    assert min(heights) > 15
    link = page.locator("a[href*='fctd.mechanics.contact.cylinder_owner']").first
    link.click()
    page.wait_for_function("location.hash === '#fctd.mechanics.contact.cylinder_owner'")
