"""Guides as pages: links to documents outside docs lead to their pages, names of functions to their descriptions."""

import re

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

# Documents beside docs, and the pages that include them.
PAGES = {
    "README.md": "project/answers.md",
    "benchmarks/README.md": "project/measured.md",
    "CHANGELOG.md": "project/changes.md",
    "CONTRIBUTING.md": "project/contributing.md",
}
OUTSIDE = re.compile(rf"\]\(\.\./({'|'.join(map(re.escape, PAGES))})(#[\w-]+)?\)")
CALLED = re.compile(r"(?<!`)`(fctd(?:\.\w+)+)`(?!`)")


def as_page(text: str) -> str:
    """A guide with links and names as the site has them."""
    text = OUTSIDE.sub(lambda found: f"]({PAGES[found[1]]})", text)
    return CALLED.sub(r"{py:obj}`\1`", text)


def _read(app: Sphinx, name: str, source: list[str]) -> None:
    if app.env.doc2path(name).suffix == ".md":
        source[0] = as_page(source[0])


def setup(app: Sphinx) -> ExtensionMetadata:
    """Listen to what is read."""
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
