"""What the tests of the page share: records of studies, and the text of pages."""

import re
from dataclasses import replace

from validation.harness.store import Judged, Provenance, Record
from validation.harness.study import Check

from . import synthetic

ORIGIN = Provenance("0123abcd", {"fctd": "0.1.0", "numpy": "2.4.6"}, "Some CPU", 2)
BLANK = Record(
    study="overlap",
    question="Does the overlap close the gap?",
    status="finished",
    message="",
    checks=(),
    notes=(),
    display={},
    tables=(),
    quick=False,
    date="2025-01-02T03:04:05+00:00",
    wall_s=1.5,
    provenance=ORIGIN,
)


def judged(value, recorded=None, name="largest jump"):
    return Judged(Check(name, value, 1e-6, "at_most", "kN·m", "continuity <C⁰>"), recorded)


def finished(name, **changes):
    tables = synthetic.STUDIES[name]()
    return replace(BLANK, study=name, tables=tuple(tables), **changes), tables


def pages_of(out):
    """The first page, the claims, the measured wells, the contact methods, and the pages of the studies."""
    first = [out / f"{name}.html" for name in ("index", "claims", "wells", "which_contact")]
    return [*first, *sorted((out / "studies").glob("*.html"))]


def study_page(tmp_path, name="overlap"):
    return tmp_path / "out" / "studies" / f"{name}.html"


def words_of(html):
    """The text of the page: without tags, white space collapsed."""
    return re.sub(r"\s+", " ", re.sub(r"<style>.*?</style>|<[^>]+>", " ", html, flags=re.DOTALL))


def missing(text, *phrases):
    """The phrases that do not stand in a text."""
    return [phrase for phrase in phrases if phrase not in text]
