"""What all pictures share: colours, markers, the sheet with its heading, and the files."""

import io
from collections.abc import Sequence
from pathlib import Path
from textwrap import wrap
from typing import Any

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.typing import RcKeyType

from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.plots import DRAWN
from fctd.plots.labels import SIZE, boxes, width_of
from fctd.plots.palette import DARK, DASHES, QUIET, Dash
from fctd.store.whole_file import whole_file

RC: dict[RcKeyType, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.6,
    "hatch.linewidth": 0.7,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "lines.markersize": 5,
    "savefig.dpi": 150,
    # The same numbers give the same file, byte for byte.
    "svg.hashsalt": "fctd",
}
LOST: dict[str, Any] = {"marker": "x", "linestyle": "none", "markersize": 7, "markeredgewidth": 2, "color": QUIET}
POINTS = 72.0  # in an inch
TITLE, SMALL = 10.5, 7.5  # sizes of type [pt]
TITLE_LINE, TITLE_LINES = 1.2, 3  # height of a line of a title, in its size, and the most lines
LINE = 1.35  # height of a line of small type, in its size
SMALL_WIDTH = 0.56  # of a character of small type on average, in its size
MARGIN = 0.1  # beside everything [in]
LEGEND_LINE, LEGEND_HANDLE = 0.19, 0.52  # height of a legend's entry, width of what stands beside its text [in]

# Files are the same byte for byte: these formats would hold the time.
_UNDATED: dict[str, dict[str, Any]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


def line_style(dash: Dash) -> Any:
    """A dash as matplotlib takes it."""
    return (0, dash) if dash else "-"


LINE_STYLES: list[Any] = [line_style(dash) for dash in DASHES]


def save(figure: Figure, path: Path) -> list[Path]:
    """Write a figure in the format of its suffix; returns the file.

    Raises InputError for a suffix that is not of ``DRAWN``, and where it cannot be written.
    """
    if path.suffix.lower() not in DRAWN:
        raise InputError(f"a file name that ends in {', '.join(DRAWN[:-1])} or {DRAWN[-1]}", value=path)
    with whole_file(path) as scratch:
        scratch.write_bytes(drawn(figure, path.suffix.lower()))
    return [path]


def drawn(figure: Figure, suffix: str, **options: Any) -> bytes:
    """A figure in the format of a suffix; options : of ``savefig``."""
    content = io.BytesIO()
    with mpl.rc_context(RC), boxes():
        figure.savefig(content, format=suffix.removeprefix("."), metadata=_UNDATED.get(suffix), **options)
    return content.getvalue()


def _wrapped_title(title: str, width: float) -> list[str]:
    """Lines of a title that fit a width [pt]; a title that is longer still is cut with an ellipsis."""
    fitting = max(len(title), 1)
    lines = [title]
    while (widest := max(width_of(line, TITLE, "bold") for line in lines)) > width:
        fitting = max(min(int(fitting * width / widest), fitting - 1), 1)
        lines = wrap(title, fitting, break_on_hyphens=False, max_lines=TITLE_LINES, placeholder=" …")
    return lines


class Sheet:
    """A figure laid out in inches from its upper left corner: heading, panels, legend.

    width [in]; panels : height of what stands between heading and legend [in]; the heading is a title with lines below
    it, the first of facts, the others in grey.  A case's name is not parsed as a formula.
    """

    def __init__(
        self, width: float, panels: float, title: str, lines: Sequence[str], handles: Sequence[Artist]
    ) -> None:
        heading = _wrapped_title(printable(title), (width - 2 * MARGIN) * POINTS)
        small = [
            (part, QUIET if k else DARK)
            for k, line in enumerate(lines)
            for part in _wrapped(printable(line), (width - 2 * MARGIN) * POINTS)
        ]
        widest = max((width_of(str(handle.get_label())) for handle in handles), default=0.0) / POINTS
        columns = max(int((width - 2 * MARGIN) / (widest + LEGEND_HANDLE)), 1)
        rows = -(-len(handles) // columns)
        step = SMALL * LINE / POINTS
        below = MARGIN + (1.5 + TITLE_LINE * (len(heading) - 1)) * TITLE / POINTS
        self.top = below + step * len(small) + 0.08
        self.width, self.height = width, self.top + panels + rows * LEGEND_LINE + (0.16 if rows else 0.0)
        self.figure = Figure(figsize=(self.width, self.height))
        self.figure.suptitle(
            "\n".join(heading), x=MARGIN / width, y=1 - MARGIN / self.height, ha="left", va="top", fontsize=TITLE,
            fontweight="bold", linespacing=TITLE_LINE, parse_math=False,
        )  # fmt: skip
        down = below
        for line, colour in small:
            place = (MARGIN / width, 1 - down / self.height)
            self.figure.text(*place, line, fontsize=SMALL, color=colour, va="top", parse_math=False)
            down += step
        if handles:
            self.legend(handles, columns)

    def axes(self, left: float, top: float, width: float, height: float, **shared: Any) -> Axes:
        """Axes at a place [in]; top : below the heading."""
        low = self.height - self.top - top - height
        place = (left / self.width, low / self.height, width / self.width, height / self.height)
        return self.figure.add_axes(place, **shared)

    def legend(self, handles: Sequence[Artist], columns: int) -> Legend:
        """The legend below the panels; entries read from left to right."""
        rows = -(-len(handles) // columns)
        # matplotlib fills columns first.
        ordered = [handles[row * columns + column] for column in range(columns) for row in range(rows)
                   if row * columns + column < len(handles)]  # fmt: skip
        legend = self.figure.legend(
            handles=ordered, ncols=columns, loc="lower left", bbox_to_anchor=(MARGIN / self.width, 0.04 / self.height),
            fontsize=8, borderaxespad=0, handlelength=2.6, columnspacing=1.4, labelspacing=0.45,
        )  # fmt: skip
        for text in legend.get_texts():  # a case's name is no formula
            text.set_parse_math(False)
        return legend


def _wrapped(text: str, width: float) -> list[str]:
    """A text in lines of small type that are no wider than a width [pt]."""
    fitting = int(width / (SMALL * SMALL_WIDTH))
    while True:
        parts = wrap(text, fitting, break_on_hyphens=False)
        widest = max((width_of(part) * SMALL / SIZE for part in parts), default=0.0)
        if widest <= width or fitting == 1:
            return parts
        fitting = max(min(int(fitting * width / widest), fitting - 1), 1)
