"""One study as the pages show it: its stored result, its figures drawn, its tables printed."""

import base64
import io
import math
import re
import sys
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.figure import Figure as Canvas
from matplotlib.text import Text

from fctd.case.text import printable_lines
from reports import figures, words
from reports.chapters import contents
from reports.figures import style
from validation.harness import store
from validation.harness.full_checks import Full, left_out
from validation.harness.store import Judged, Record

LONG = 14  # rows of a table that is folded
THUMBNAIL = 46  # dots per inch of a small copy
LETTERS = 10  # height of the smallest letters that a reader of a phone can read [px]
FRAME = 18  # of a figure on a page, both sides: padding and border [px]


@dataclass(frozen=True)
class Picture:
    """A drawn figure: embedded in a page (``source``), and as files beside it for download.

    small : a small copy, where the first page has one.  least : width at which all letters can be read [px].
    shows : whether it shows the number of a check, by its name.
    """

    name: str
    caption: str
    source: str
    small: str
    svg: str
    png: str
    least: int
    shows: Callable[[str], bool] = bool


@dataclass(frozen=True)
class Printed:
    """A table as text; a column has a label, a unit, and is set to the right where it holds numbers.

    struck : cells by row and column that are struck through; the row says why.
    """

    caption: str
    columns: list[tuple[str, str, bool]]
    rows: list[tuple[str, ...]]
    struck: frozenset[tuple[int, int]] = frozenset()

    @property
    def long(self) -> bool:
        """Whether the page folds it."""
        return len(self.rows) > LONG


@dataclass
class Section:
    """What the pages say of one study; without a record, the study has not been run.

    changed : the input that has changed since the result was stored; empty where it is up to date.
    asked : the question of a study that may not have been run; empty where it is not known.  left_out : the checks of a
    full run that the stored one does not make.
    """

    study: str
    record: Record | None = None
    pictures: list[Picture] = field(default_factory=list)
    tables: list[Printed] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    changed: str = ""
    asked: str = ""
    left_out: list[str] = field(default_factory=list)

    @property
    def question(self) -> str:
        """The study's question; its name where the question is not known."""
        return (self.record.question if self.record else "") or self.asked or self.study

    @property
    def summary(self) -> str:
        """The outcome, in a few words."""
        return self.record.summary(self.left_out) if self.record else "not run"

    @property
    def command(self) -> str:
        """What makes the stored result again."""
        quick = " --quick" if self.record and self.record.quick else ""
        return f"python -m validation {self.study}{quick}"

    def shown(self, picture: "Picture") -> tuple[list[Judged], list[str]]:
        """The checks whose numbers a figure shows, and those of them that are left out; both empty: it names none."""
        made = self.record.checks if self.record else ()
        of = [judged for judged in made if picture.shows(judged.check.name)]
        return of, [name for name in self.left_out if picture.shows(name)]

    @property
    def findings(self) -> list[Judged]:
        """The checks that found something about the paper."""
        return [judged for judged in self.record.checks if judged.is_finding] if self.record else []

    @property
    def absent(self) -> bool:
        """Whether there is nothing to show but how to run it."""
        return not self.problems and (self.record is None or self.record.status == "skipped")

    def draw(self, figure: figures.Figure, tables: figures.Tables, out: Path) -> Picture | None:
        """A figure of the study.  One that cannot be drawn is a problem, and does not prevent the rest of the page."""
        try:
            return draw(self.study, figure, tables, out)
        except Exception as error:
            print(printable_lines(traceback.format_exc()), end="", file=sys.stderr)
            self.problems.append(f"figure {figure.name!r} could not be drawn: {type(error).__name__}: {error}")
            return None


def anchor(name: str) -> str:
    """The address of a check within the page of its study."""
    return "check-" + re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def section_of(folder: Path, out: Path, full: Full) -> tuple[Section, figures.Tables]:
    """Read one study's result and draw its figures; the tables are those of the result.  full : checks of full runs."""
    section = Section(folder.name)
    if not (folder / "verdict.json").exists():
        return section, {}
    try:
        section.record = found = store.read(folder)
        tables = store.read_tables(folder, found)
    except (OSError, ValueError, TypeError, LookupError) as error:
        section.problems.append(f"the result cannot be read: {type(error).__name__}: {error}")
        return section, {}
    section.left_out = left_out(found, full)
    if found.status != "finished":
        return section, {}
    section.tables = [printed(tables[name], caption) for name, caption in found.display.items()]
    # A study whose package is missing finishes with a note only.
    drawn = figures.by_study().get(section.study, []) if tables or found.checks else []
    section.pictures = [picture for figure in drawn if (picture := section.draw(figure, tables, out))]
    return section, tables


def draw(study: str, figure: figures.Figure, tables: figures.Tables, out: Path) -> Picture:
    """Draw a figure into ``out/figures`` as SVG and PNG."""
    svg, png = (f"figures/{study}-{figure.name}.{kind}" for kind in ("svg", "png"))
    with mpl.rc_context(style.RC):
        canvas = figure.draw(tables)
        canvas.savefig(out / svg, metadata={"Date": None})
        canvas.set_layout_engine("none")  # keeps the layout for the other files; the layout takes half of the time
        canvas.savefig(out / png)
        small = _small(canvas) if study in {each.ours.partition("/")[0] for each in contents().paper} else ""
    # As a data address, the identifiers of a drawing stay separate and the page is one file.
    source = "data:image/svg+xml;base64," + base64.b64encode((out / svg).read_bytes()).decode()
    return Picture(figure.name, figure.caption, source, small, svg, png, readable_width(canvas), figure.shows)


def readable_width(canvas: Canvas) -> int:
    """The width of a figure on a page at which its smallest letters can be read [px], its frame included."""
    texts = (each for each in canvas.findobj(Text) if isinstance(each, Text) and each.get_text())
    smallest_in = min((float(text.get_fontsize()) for text in texts), default=10.0) / 72
    return math.ceil(LETTERS * canvas.get_figwidth() / smallest_in) + FRAME


def _small(canvas: Canvas) -> str:
    """A small copy as a data address."""
    drawn = io.BytesIO()
    canvas.savefig(drawn, format="png", dpi=THUMBNAIL)
    return "data:image/png;base64," + base64.b64encode(drawn.getvalue()).decode()


def printed(table: pd.DataFrame, caption: str) -> Printed:
    """A table's columns as text; the speeds of an engine that failed its gate are struck through."""
    every = words.columns(table)
    # A column that says nothing in any row makes a table wider than the page.
    every = {name: cells for name, cells in every.items() if not cells or set(cells) - {"", words.NOTHING}}
    names, cells = list(every), list(every.values())
    columns = [(*words.heading(name), pd.api.types.is_numeric_dtype(table[name])) for name in names]
    failed = np.flatnonzero(words.failed_gate(table)).tolist() if "gate" in names else []
    speeds = [index for index, name in enumerate(names) if columns[index][2] and words.is_speed(name)]
    struck = {(row, index) for row in failed for index in speeds}
    return Printed(caption, columns, list(zip(*cells, strict=True)), frozenset(struck))
