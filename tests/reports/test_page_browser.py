"""The report in a real browser: first screen, widths, sorting, and the way from a claim to its evidence."""

import re
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import pytest

from reports import chapters, figures, page
from reports.__main__ import OUT
from reports.figures.leading import LEADING
from reports.sections import FRAME, LETTERS
from tests.browsers import needs_browser, opened, overflow
from tests.reports.pages import BLANK, judged
from validation.claims.ledger import CLAIMS, read_ledger
from validation.harness import store
from validation.harness.registry import STUDIES

from . import synthetic

pytestmark = needs_browser

DRAWN = ("contact_accuracy", "paper_well", "volve_f4", "overlap")
TALLEST = 9_600  # of the first page at 1,280 px, twelve screens
SOURCES = (".py", ".toml", ".html", ".css", ".js")
CLICKS = 3  # from the first page to what decides a claim
PAPER = 698  # width of a page of paper between its margins [px]
LOW = 100  # height of a window of which only the width matters: less is painted [px]

CLAIM = """
[[claim]]
id = "claim-{0}"
section = "6.{1}"
says = "A claim of the paper, number {0}, in a sentence as long as most of them are in the ledger."
verdict = "holds"
because = "target"
[claim.number]
study = "overlap"
check = "{2}"
at_most = {3}
"""


def made(folder: Path) -> tuple[Path, Path]:
    """A report with made-up numbers for the checks that answers name, and its ledger of 35 claims."""
    names: dict[str, dict[str, None]] = {study: {} for study in STUDIES}
    for chapter in chapters.contents().chapter:
        for sentence in chapter.sentence:
            for study, name in sentence.numbers:
                names[study][name] = None
    ledger = folder / "claims.toml"
    first = next(iter(names["overlap"]))
    ledger.write_text("".join(CLAIM.format(k, k % 4, first, 0.1 if k % 3 else 1.0) for k in range(35)))
    for study, checks in names.items():
        if study in figures.by_study() and study not in DRAWN:
            continue  # as if it had not been run
        tables = synthetic.STUDIES[study]() if study in DRAWN else {}
        record = replace(BLANK, study=study, question=f"Does {study} answer a question of this length, and how?")
        found = tuple(judged(0.123, name=name) for name in checks)
        display = {name: f"Table {name}" for name in list(tables)[:2]}
        store.write(replace(record, tables=tuple(tables), checks=found, display=display), tables, folder / "results")
    assert page.render(folder / "results", STUDIES, folder / "out", None, ledger) == []
    return folder / "out", ledger


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The report of the stored results and its claims, as CI has it; where there is none with all pictures of the first
    screen since the report's code was changed, a made-up one."""
    written = OUT / "results.json"
    sources = [
        path for path in Path(page.__file__).parent.rglob("*") if path.suffix in SOURCES and OUT not in path.parents
    ]
    drawn = [OUT / "figures" / f"{each.study}-{each.figure.name}.svg" for each in LEADING]
    latest = max(path.stat().st_mtime for path in sources)
    if written.exists() and written.stat().st_mtime > latest and all(path.exists() for path in drawn):
        return OUT, CLAIMS
    return made(tmp_path_factory.mktemp("report"))


@pytest.fixture(scope="module")
def site(report: tuple[Path, Path]) -> Path:
    """The folder of the report."""
    return report[0]


def test_verdict_and_pictures_lie_in_the_first_screen(site: Path) -> None:
    with opened(site / "index.html") as (shown, _):
        for part in ("h1", "#verdict", ".leading figure:nth-child(1) img", ".leading figure:nth-child(2) img",
                     ".leading figure:nth-child(3) img", ".machine"):  # fmt: skip
            box = shown.locator(part).first.bounding_box()
            assert box is not None, part
            assert box["x"] >= 0, part
            assert box["x"] + box["width"] <= 1280, part
            assert box["y"] + box["height"] <= 800, part
            assert min(box["width"], box["height"]) > 10, part
        assert shown.evaluate("document.documentElement.scrollHeight") <= TALLEST
        # The chapters stay in sight.
        shown.evaluate("scrollTo(0, 3000)")
        nav = shown.locator("nav.top").bounding_box()
        assert nav is not None
        assert nav["y"] == 0


def test_no_page_is_wider_than_its_window(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > len(STUDIES)
    wide: dict[tuple[str, int | str], int] = {}
    with opened(pages[0]) as (shown, _):
        for path in pages:
            shown.goto(path.resolve().as_uri())
            shown.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
            for width in (400, 1280, 1920):
                shown.set_viewport_size({"width": width, "height": LOW})
                wide[path.name, width] = overflow(shown)
            shown.set_viewport_size({"width": PAPER, "height": LOW})
            shown.emulate_media(media="print")
            wide[path.name, "on paper"] = overflow(shown)
            shown.emulate_media(media="screen")
    assert {at: by for at, by in wide.items() if by > 0} == {}


def test_letters_of_figures_can_be_read_at_every_width(site: Path) -> None:
    """Ten pixels are the height of the smallest, whatever the window; a wide figure scrolls in its frame."""
    small, seen = {}, 0
    with opened(site / "index.html") as (shown, _):
        for path in [site / "index.html", *sorted((site / "studies").glob("*.html"))]:
            shown.goto(path.resolve().as_uri())
            for width in (400, 1280):
                shown.set_viewport_size({"width": width, "height": LOW})
                found = shown.evaluate("""() => [...document.querySelectorAll("figure.main")].map((figure) => [
                  figure.querySelector(".files a").getAttribute("href"), figure.querySelector("img").offsetWidth])""")
                for drawn, shown_width in found:
                    text = (path.parent / drawn).read_text(encoding="utf-8")
                    own = re.search(r'<svg [^>]*width="([\d.]+)pt"', text)
                    letters = [100 * float(size) for size in re.findall(r"scale\(([\d.]+) -\1\)", text) if size != "1"]
                    assert own, drawn
                    height = min(letters) * (shown_width - FRAME) / float(own[1])
                    seen += 1
                    if height < LETTERS - 0.1:
                        small[path.name, width, drawn] = height
    assert seen > 10
    assert small == {}


class Parts(HTMLParser):
    """The links of a page and its parts with names; folded : how many closed folds are around each.

    links : address, folded, and the names of the parts around it.
    """

    EMPTY = ("area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr")

    def __init__(self, text: str) -> None:
        super().__init__()
        self._open: list[tuple[str, str, bool]] = []
        self.links: list[tuple[str, int, tuple[str, ...]]] = []
        self.folded: dict[str, int] = {}
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        name, folds = given.get("id") or "", sum(closed for _, _, closed in self._open)
        if name:
            self.folded[name] = folds
        if tag == "a" and given.get("href"):
            self.links.append((given["href"] or "", folds, tuple(each for _, each, _ in self._open if each)))
        if tag not in self.EMPTY:
            self._open.append((tag, name, tag == "details" and "open" not in given))

    def handle_endtag(self, tag: str) -> None:
        while self._open and self._open.pop()[0] != tag:
            pass


def test_the_evidence_of_every_claim_is_three_clicks_away(report: tuple[Path, Path]) -> None:
    """From the first page over links alone, of which each is a click, as is each fold that hides one."""
    (site, source), seen = report, 0
    page_of = cache(lambda name: Parts((site / name).read_text(encoding="utf-8")))
    ways = {link: 1 + folds for link, folds, around in page_of("index.html").links if "claims" in around}
    claims = read_ledger(source).claim
    assert list(ways) == [f"claims.html#claim-{claim.id}" for claim in claims]
    for claim in claims:
        row, way = f"claim-{claim.id}", ways[f"claims.html#claim-{claim.id}"]
        assert row in page_of("claims.html").folded  # a link to what is folded opens it
        evidence = [(link, folds) for link, folds, around in page_of("claims.html").links if row in around]
        assert evidence or claim.number is None, claim.id
        for link, folds in evidence:
            name, _, anchor = link.partition("#")
            # A number of a table has the study's page alone, which may fold the table.
            hidden = 0 if anchor else 1
            assert not anchor or anchor in page_of(name).folded, link
            assert way + 1 + folds + hidden <= CLICKS, link
            seen += 1
    assert seen >= len(claims)


def test_tables_sort_by_a_heading(site: Path) -> None:
    """Texts by letters, numbers as they are printed by size, and back again."""
    with opened(site / "index.html") as (shown, _):
        head = shown.locator("#claims th").nth(2)
        column = "Array.from(document.querySelectorAll('#claims tbody tr'), (row) => row.cells[2].textContent.trim())"
        head.click()
        rising = shown.evaluate(column)
        head.click()
        falling = shown.evaluate(column)
        assert rising == falling[::-1] or sorted(rising) == sorted(falling)
        assert rising[0] == falling[-1] != rising[-1]
        assert head.get_attribute("aria-sort") == "descending"
        table = next(
            path for path in sorted((site / "studies").glob("*.html"))
            if len(re.findall(r'<th class="number">', path.read_text(encoding="utf-8"))) > 3
        )  # fmt: skip
        shown.goto(table.resolve().as_uri())
        shown.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
        number = shown.locator(".results th.number").first
        number.click()
        cells = shown.evaluate("""() => {
          const head = document.querySelector(".results th.number"), column = head.cellIndex;
          return Array.from(head.closest("table").tBodies[0].rows, (row) => row.cells[column].textContent);
        }""")
        values = [printed(cell) for cell in cells]
        known = [value for value in values if value is not None]
        assert known == sorted(known)
        assert len(known) > 1


def printed(text: str) -> float | None:
    """A number as the page prints it."""
    plain = text.strip().replace("\u202f", "").replace("\u2212", "-").replace("\u00a0", "")
    raised = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    plain = re.sub(r"×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda found: f"e{found[1].translate(raised)}", plain)
    try:
        return float(plain.replace("∞", "inf"))
    except ValueError:
        return None


def test_a_link_into_a_folded_part_opens_it_and_paper_has_all(site: Path) -> None:
    with opened(site / "index.html") as (shown, _):
        assert shown.locator("details[open]").count() == 0
        shown.evaluate("dispatchEvent(new Event('beforeprint'))")
        assert shown.locator("details:not([open])").count() == 0
