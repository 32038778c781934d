"""The page of a report: its cells are those of the tables, and no text of the case is markup."""

from collections.abc import Callable
from html.parser import HTMLParser

import pytest

from fctd.report.parts import Report
from fctd.results.unit_systems import System
from tests.report.conftest import UNITS


class Cells(HTMLParser):
    """The cells of all tables, a list for each row; tags, and addresses of pictures and links."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.tags: set[str] = set()
        self.addresses: list[str] = []
        self.inside = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
        self.inside = tag in ("td", "th")

    def handle_endtag(self, tag: str) -> None:
        self.inside = False

    def handle_data(self, data: str) -> None:
        if self.inside:
            self.rows[-1][-1] += data


@pytest.mark.parametrize("units", UNITS)
def test_every_cell_is_that_of_its_table(
    units: System, made: Callable[[System], Report], files: Callable[[System, str], bytes]
) -> None:
    expected = []
    for table in made(units).tables:
        expected += [[*map(str, table.heads)]] if table.heads else []
        expected += [[cell.text for cell in row] for row in table.rows]
    assert len(expected) > 100
    assert Cells(files(units, ".html").decode()).rows == expected


def test_it_needs_no_network_and_texts_are_no_markup(files: Callable[[System, str], bytes]) -> None:
    page = Cells(files("si", ".html").decode())
    assert all(address.startswith(("data:image/", "#s")) for address in page.addresses)
    assert sum(address.startswith("data:image/svg+xml") for address in page.addresses) == 3
    assert page.tags & {"script", "b", "i"} == set()
    assert ["<i>pipe</i>"] in [row[:1] for row in page.rows]
    assert "\x1b" not in files("si", ".html").decode()
