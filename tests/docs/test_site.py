"""The parts of the docs site: a small one is built, and every document has its place."""

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

import fctd

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
# What a browser asks for by itself.
RESOURCE = re.compile(r"<(?:script|link|img|iframe|source|object|embed)\b[^>]*\b(?:src|href|data)=[\"'](?:https?:)?//")
IN_STYLE = re.compile(r"(?:url\(\s*[\"']?|@import\s+[\"'])(?:https?:)?//")

INDEX = """# A site

```{toctree}
room
public
view
```

The law `fctd.mechanics.laws.paper.impulse`, its force $F_n$ and

$$
\\frac{a}{b} = 1
$$

```csv
a,b
```
"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A site of four pages with the settings of the real one."""
    folder = tmp_path_factory.mktemp("site")
    source, out = folder / "source", folder / "out"
    source.mkdir()
    (source / "index.md").write_text(INDEX)
    (source / "room.rst").write_text("Room\n====\n\n.. room:: fctd.mechanics.laws\n")
    (source / "public.rst").write_text("Public\n======\n\n.. public:: fctd.view\n")
    (source / "view.rst").write_text("View\n====\n\n.. room:: fctd.view\n")
    command = [sys.executable, "-m", "sphinx", "-W", "-q", "-c", str(DOCS), "-b", "html", str(source), str(out)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return out


@pytest.mark.slow
def test_equations_are_mathml_and_names_lead_to_their_functions(site: Path) -> None:
    text = (site / "index.html").read_text(encoding="utf-8")
    assert text.count("<math ") == 2
    assert "<mfrac>" in text
    assert 'href="room.html#fctd.mechanics.laws.paper.impulse"' in text
    described = (site / "room.html").read_text(encoding="utf-8")
    assert 'id="fctd.mechanics.laws.paper.impulse"' in described
    assert "Axial drag and a couple about the axis" in described
    assert '_modules/fctd/mechanics/laws/paper.html#impulse"' in described
    assert 'id="fctd.view.save_view"' in (site / "public.html").read_text(encoding="utf-8")


def test_every_link_leads_somewhere(site: Path) -> None:
    assert dead(site) == []
    sources = {path.relative_to(site / "_modules").parts[0] for path in (site / "_modules").rglob("*.html")}
    assert sources == {"fctd", "index.html"}


class Links(HTMLParser):
    """The links of a page and the parts that they can lead to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.parts: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.parts.add(given.get("id") or "")
        if tag == "a" and given.get("href"):
            self.links.append(given["href"] or "")


def dead(site: Path) -> list[str]:
    """Links within a site that lead to no page or to no part of one, as PAGE -> LINK."""
    pages = {page.resolve(): Links(page.read_text(encoding="utf-8")) for page in site.rglob("*.html")}
    found = []
    for page, content in pages.items():
        for link in content.links:
            address = urlsplit(link)
            target = (page.parent / unquote(address.path)).resolve() if address.path else page
            missing = not target.exists() or (
                address.fragment and target in pages and unquote(address.fragment) not in pages[target].parts
            )
            if not address.scheme and missing:
                found.append(f"{page.name} -> {link}")
    return found


def test_a_link_that_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text(
        '<a href="#here">1</a><a href="other.html">2</a><a href="page.html#there">3</a>'
    )
    assert dead(tmp_path) == ["page.html -> #here", "page.html -> other.html", "page.html -> page.html#there"]
    (tmp_path / "page.html").write_text('<p id="here"></p><a href="#here">1</a><a href="https://example.org/x#y">2</a>')
    assert dead(tmp_path) == []


def test_it_can_be_searched_and_asks_for_nothing_from_elsewhere(site: Path) -> None:
    assert "save_view" in (site / "searchindex.js").read_text(encoding="utf-8")
    assert outside(site) == []


def outside(site: Path) -> list[str]:
    """Files of a site that ask for something at an address."""
    found = [page for page in site.rglob("*.html") if RESOURCE.search(page.read_text(encoding="utf-8"))]
    found += [style for style in site.rglob("*.css") if IN_STYLE.search(style.read_text(encoding="utf-8"))]
    return [path.name for path in found]


@pytest.mark.parametrize(
    "content",
    ['<link rel="stylesheet" href="https://cdn.example/x.css">', "<script defer src='//cdn.example/x.js'></script>"],
)
def test_a_page_that_asks_elsewhere_is_found(content: str, tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text(content)
    assert outside(tmp_path) == ["page.html"]
    (tmp_path / "page.html").write_text('<a href="https://example.org">a link</a>')
    assert outside(tmp_path) == []
    (tmp_path / "style.css").write_text("a { background: url(https://cdn.example/a.png) }")
    assert outside(tmp_path) == ["style.css"]


def test_every_document_has_its_place() -> None:
    """In the contents; a page of a room for each room that the site describes."""
    listed = set(re.findall(r"^   ([\w/]+)$", (DOCS / "index.rst").read_text(encoding="utf-8"), re.MULTILINE))
    pages = {
        path.relative_to(DOCS).with_suffix("").as_posix() for path in (*DOCS.glob("*.md"), *DOCS.glob("project/*"))
    }
    assert pages | {"api/index"} == listed


def test_a_docstring_means_what_it_says() -> None:
    from docs.site.docstrings import escaped

    assert (
        escaped("``a*b`` and `key` are |PT|² − r_ds*2, x_ too")
        == "``a*b`` and ``key`` are \\|PT\\|² − r_ds\\*2, x\\_ too"
    )


def test_links_of_guides_lead_to_pages() -> None:
    from docs.site.pages import as_page

    assert as_page("[it](../README.md#what-the-answers-say)") == "[it](project/answers.md)"
    assert as_page("`fctd.equilibrium` and `fctd chart`") == "{py:obj}`fctd.equilibrium` and `fctd chart`"


def test_rooms_have_all_of_their_modules() -> None:
    from docs.site.rooms import modules

    found = modules("fctd.mechanics")
    assert {"fctd.mechanics.contact", "fctd.mechanics.laws.coulomb"} < set(found)
    assert len(found) == len(list((Path(fctd.__file__).parent / "mechanics").rglob("*.py"))) - 1
