"""Docstrings as reStructuredText: they use its ``literals`` and lists alone, and all other signs mean themselves."""

import inspect
import re
from typing import Any

from pydantic import BaseModel
from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

# A literal in two or one backticks, or a sign that reStructuredText reads.
PART = re.compile(r"``(.+?)``|`([^`]+)`|([*|\\])|(?<=\w)(_)(?!\w)")


def escaped(line: str) -> str:
    """A line of a docstring in which only literals are marked up."""
    return PART.sub(lambda found: f"``{found[1] or found[2]}``" if found[1] or found[2] else f"\\{found[0]}", line)


def _docstring(app: Sphinx, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Indented lines after a blank one are code, and stay as they are."""
    code = False
    for at, line in enumerate(lines):
        indented = line.startswith("    ")
        code = indented and (code or not lines[at - 1])
        if code and not lines[at - 1].startswith((" ", "|")):
            lines[at - 1] = lines[at - 1] + "\n::\n"
        lines[at] = line if code else escaped(line)
    lines[:] = "\n".join(lines).split("\n")


def _signature(app: Sphinx, what: str, name: str, thing: Any, options: Any, given: str, returned: str) -> Any:
    """None for models of a case file: their keys have a page of their own."""
    if inspect.isclass(thing) and issubclass(thing, BaseModel):
        return "", None
    return None


def setup(app: Sphinx) -> ExtensionMetadata:
    """Listen to autodoc."""
    app.connect("autodoc-process-docstring", _docstring)
    app.connect("autodoc-process-signature", _signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
