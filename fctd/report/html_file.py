"""A report as a page: one file that needs no network and runs no script."""

from __future__ import annotations

import base64
from typing import Final

from fctd.report.parts import Picture, Report
from fctd.results.shown_tables import Table

_TYPES: Final = {".svg": "image/svg+xml", ".png": "image/png"}


def to_html(report: Report) -> bytes:
    """The page; all texts are escaped.  Needs jinja2."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("fctd.report", "."), autoescape=True, undefined=jinja2.StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.tests["table"] = lambda part: isinstance(part, Table)
    environment.tests["picture"] = lambda part: isinstance(part, Picture)
    environment.globals["embedded"] = _embedded
    environment.globals["picture_of"] = lambda part: _embedded(part.drawn(".svg"), ".svg")
    return environment.get_template("html_file.html").render(report=report).encode()


def _embedded(content: bytes, suffix: str) -> str:
    """A picture as an address that holds it."""
    return f"data:{_TYPES[suffix]};base64,{base64.b64encode(content).decode()}"
