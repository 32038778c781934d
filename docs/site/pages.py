"""Guides and notebooks as pages: links to documents outside docs lead to their pages, names of functions to their
descriptions."""

import re
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

from docs.site.notebooks import as_markdown

# Documents beside docs, and the pages that include them.
PAGES = {
    "README.md": "project/answers.md",
    "benchmarks/README.md": "project/measured.md",
    "CHANGELOG.md": "project/changes.md",
    "CONTRIBUTING.md": "project/contributing.md",
}
OUTSIDE = re.compile(rf"\]\(\.\./({'|'.join(map(re.escape, PAGES))})(#[\w-]+)?\)")
# The place of a notebook in its page, from the folder of the page.
NOTEBOOK = re.compile(r"^```\{notebook\} (\S+)\n```$", re.MULTILINE)
CALLED = re.compile(r"(?<!`)`(fctd(?:\.\w+)+)`(?!`)")


def as_page(text: str) -> str:
    """A guide with links and names as the site has them."""
    text = OUTSIDE.sub(lambda found: f"]({PAGES[found[1]]})", text)
    return CALLED.sub(r"{py:obj}`\1`", text)


def with_notebooks(text: str, folder: Path) -> str:
    """A page in a folder with the cells of its notebooks."""
    return NOTEBOOK.sub(lambda found: as_markdown(folder / found[1]), text)


def _read(app: Sphinx, name: str, source: list[str]) -> None:
    page = Path(app.env.doc2path(name))
    if page.suffix == ".md":
        source[0] = as_page(with_notebooks(source[0], page.parent))


def setup(app: Sphinx) -> ExtensionMetadata:
    """Listen to what is read."""
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
