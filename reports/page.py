"""From stored results to one page: read each result, draw its figures, print its tables."""

import base64
import shutil
import sys
import traceback
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
import matplotlib as mpl
import pandas as pd

from fctd.case.text import printable_lines
from reports import figures, words
from reports.claims import LOOKS, judged
from reports.figures import style
from validation.claims.ledger import CLAIMS
from validation.harness import store
from validation.harness.store import Record

TEMPLATES = Path(__file__).parent / "templates"


@dataclass(frozen=True)
class Picture:
    """A drawn figure: embedded in the page (``source``), and as files beside it for download."""

    caption: str
    source: str
    svg: str
    png: str


@dataclass(frozen=True)
class Printed:
    """A table as text; a column has a label, a unit, and is set to the right where it holds numbers."""

    caption: str
    columns: list[tuple[str, str, bool]]
    rows: list[tuple[str, ...]]


@dataclass
class Section:
    """The section of one study; without a record, the study has not been run.

    changed : the input that has changed since the result was stored; empty where it is up to date.
    """

    study: str
    record: Record | None = None
    pictures: list[Picture] = field(default_factory=list)
    tables: list[Printed] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    changed: str = ""

    @property
    def question(self) -> str:
        """The study's question; its name where the question is not known."""
        return self.record.question or self.study if self.record else self.study

    @property
    def summary(self) -> str:
        """The outcome, in a few words."""
        return self.record.summary if self.record else "not run"


def render(
    results: Path,
    studies: Iterable[str],
    out: Path,
    changes: Mapping[str, str] | None = None,
    ledger: Path = CLAIMS,
) -> list[str]:
    """Write ``out/index.html`` and ``out/figures``; return what could not be drawn.

    Studies stand in the order given; results of studies that are not among them come after.  The claims of ``ledger``,
    judged by these results, stand at the top.  changes : study -> what has changed since its result was stored.
    """
    shutil.rmtree(out / "figures", ignore_errors=True)
    (out / "figures").mkdir(parents=True)
    found = sorted(path.parent.name for path in results.glob("[!.]*/verdict.json"))
    sections = [_section(results / study, out) for study in dict.fromkeys([*studies, *found])]
    for section in sections:
        section.changed = (changes or {}).get(section.study, "")
    claims = judged(results, ledger)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    page = environment.get_template("page.html").render(
        sections=sections,
        claims=claims,
        looks=LOOKS,
        changes=changes or {},
        number=words.number,
        quantity=words.quantity,
    )
    (out / "index.html").write_text(page, encoding="utf-8", errors="backslashreplace")
    problems = [f"{section.study}: {problem}" for section in sections for problem in section.problems]
    return ([f"claims: {claims.problem}"] if claims.problem else []) + problems


def _section(folder: Path, out: Path) -> Section:
    """Read one study's result and draw its figures."""
    section = Section(folder.name)
    if not (folder / "verdict.json").exists():
        return section
    try:
        section.record = found = store.read(folder)
        tables = store.read_tables(folder, found)
    except (OSError, ValueError, TypeError, LookupError) as error:
        section.problems.append(f"the result cannot be read: {type(error).__name__}: {error}")
        return section
    if found.status != "finished":
        return section
    section.tables = [_print(tables[name], caption) for name, caption in found.display.items()]
    # A study whose package is missing finishes with a note only.
    for figure in figures.of_study(section.study) if tables or found.checks else []:
        try:
            section.pictures.append(_draw(section.study, figure, tables, out))
        except Exception as error:
            # A figure that cannot be drawn must not prevent the rest of the page.
            print(printable_lines(traceback.format_exc()), end="", file=sys.stderr)
            section.problems.append(f"figure {figure.name!r} could not be drawn: {type(error).__name__}: {error}")
    return section


def _draw(study: str, figure: figures.Figure, tables: figures.Tables, out: Path) -> Picture:
    """Draw a figure into ``out/figures`` as SVG and PNG."""
    svg, png = (f"figures/{study}-{figure.name}.{kind}" for kind in ("svg", "png"))
    with mpl.rc_context(style.RC):
        canvas = figure.draw(tables)
        canvas.savefig(out / svg, metadata={"Date": None})
        canvas.set_layout_engine("none")  # keeps the layout for the second file; the layout takes half of the time
        canvas.savefig(out / png)
    # As a data address, the identifiers of a drawing stay separate and the page is one file.
    source = "data:image/svg+xml;base64," + base64.b64encode((out / svg).read_bytes()).decode()
    return Picture(figure.caption, source, svg, png)


def _print(table: pd.DataFrame, caption: str) -> Printed:
    """A table's columns as text."""
    columns = [(*words.heading(name), pd.api.types.is_numeric_dtype(table[name])) for name in map(str, table.columns)]
    cells = [words.column(table[name]) for name in table.columns]
    return Printed(caption, columns, list(zip(*cells, strict=True)))
