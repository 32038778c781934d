"""A report as a PDF: tables that break over pages with their heads, pictures that leave no page half empty."""

from __future__ import annotations

import io
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, Final
from xml.sax.saxutils import escape

from reportlab.lib import colors
from reportlab.lib.pagesizes import A4, letter
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.utils import ImageReader
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import BaseDocTemplate, CondPageBreak, Flowable, Frame, PageTemplate, Paragraph
from reportlab.platypus import Table as Drawn

from fctd.report.parts import Picture, Report, Text
from fctd.results.shown_tables import Cell, Table

FONT, BOLD = "FCTD-Sans", "FCTD-Sans-Bold"
SIZE, SMALL = 8.0, 6.5  # of type [pt]
INCH: Final = 72.0
MARGIN, HEAD, FOOT = 0.5 * INCH, 0.75 * INCH, 0.5 * INCH
PAD: Final = 3.0  # beside the text of a cell [pt]
DPI: Final = 200  # of pictures
BODY = ParagraphStyle("body", fontName=FONT, fontSize=SIZE, leading=1.3 * SIZE, spaceBefore=4, splitLongWords=1)
NOTE = ParagraphStyle("note", BODY, fontSize=7.5, leading=9.5, textColor=colors.HexColor("#444444"), spaceBefore=2)
COVER = ParagraphStyle("cover", BODY, fontName=BOLD, fontSize=18, leading=22, spaceAfter=4)
SECTION = ParagraphStyle("section", BODY, fontName=BOLD, fontSize=13, leading=16, spaceBefore=12)
TITLE = ParagraphStyle("title", BODY, fontName=BOLD, fontSize=9, leading=12, spaceBefore=8, spaceAfter=2)
# Height that a table needs at the bottom of a page, so that no head stands there with few rows [pt]; least share of its
# size that a picture shrinks to for the rest of a page.
FEW_ROWS, SHRUNK = 1.6 * INCH, 0.75
LONGEST: Final = 150  # characters of the title; the table below it has all of them


def to_pdf(report: Report) -> bytes:
    """The file, on A4, or letter in field units, with bookmarks; the same report gives the same bytes."""
    _register()
    width, height = letter if report.units == "field" else A4
    content = io.BytesIO()
    document = _Document(
        content, pagesize=(width, height), title=report.title, author=report.by, subject=report.subject, invariant=1
    )
    room = width - 2 * MARGIN, height - HEAD - FOOT
    frame = Frame(MARGIN, FOOT, *room, leftPadding=0, rightPadding=0, topPadding=4, bottomPadding=4)

    def on_page(canvas: Canvas, _: Any) -> None:
        _frame_page(canvas, report, width, height)

    document.addPageTemplates(PageTemplate(frames=[frame], onPage=on_page))
    document.build(list(_story(report, room[0], room[1] - 8)), canvasmaker=_Numbered)
    return content.getvalue()


@cache
def _register() -> frozenset[int]:
    """Register the fonts, those of the pictures; returns the characters that they have."""
    from matplotlib import get_data_path

    folder = Path(get_data_path(), "fonts", "ttf")
    for name, file in ((FONT, "DejaVuSans.ttf"), (BOLD, "DejaVuSans-Bold.ttf")):
        pdfmetrics.registerFont(TTFont(name, folder / file))
    return frozenset(pdfmetrics.getFont(FONT).face.charToGlyph)


def _shown(text: str) -> str:
    """The text with an escape for each character that the font lacks."""
    has = _register()
    return "".join(c if ord(c) in has else c.encode("unicode_escape").decode() for c in text)


def _paragraph(text: str, style: ParagraphStyle) -> Paragraph:
    return Paragraph(escape(_shown(text)), style)


def _story(report: Report, width: float, height: float) -> Iterator[Flowable]:
    """The flowables; a ``CondPageBreak`` begins each group of them that stays together."""
    yield _paragraph(report.title if len(report.title) <= LONGEST else f"{report.title[: LONGEST - 1]}…", COVER)
    said = [report.subject, report.company, f"by {report.by}" if report.by else "", report.date]
    yield _paragraph(", ".join(filter(None, said)), BODY)
    for section in report.sections:
        first: list[Flowable] = [_Heading(section.title)]
        for part in section.parts:
            if isinstance(part, Picture):
                yield from [CondPageBreak(FEW_ROWS), *first] if first else []
                yield _Figure(part, width, height)
            elif isinstance(part, Text):
                needs = FEW_ROWS if first else 0.5 * INCH
                yield from [CondPageBreak(needs), *first, _paragraph(part.text, BODY)]
            else:
                drawn = _drawn(part, width, height)
                needs = min(drawn.wrap(width, height)[1] + 0.5 * INCH, FEW_ROWS)
                yield CondPageBreak(needs + 0.5 * INCH * bool(first))
                yield from [*first, *([_paragraph(part.title, TITLE)] if part.title else []), drawn]
                yield from (_paragraph(note, NOTE) for note in part.notes)
            first = []


class _Heading(Paragraph):
    """The heading of a section, which is a bookmark too."""

    def __init__(self, title: str) -> None:
        super().__init__(escape(_shown(title)), SECTION)
        self.title = title

    def draw(self) -> None:
        self.canv.bookmarkPage(self.title)
        self.canv.addOutlineEntry(self.title, self.title, 0)
        super().draw()


class _Figure(Flowable):
    """A picture with its caption, as large as the page allows; it shrinks a little where that saves a page."""

    def __init__(self, picture: Picture, width: float, height: float) -> None:
        super().__init__()
        self.caption = _paragraph(picture.caption, NOTE)
        wide, high = (INCH * size for size in picture.size)
        self.below = self.caption.wrap(width, height)[1] + 8
        scale = min(width / wide, (height - self.below) / high, 1.0)
        self.full = wide * scale, high * scale
        self.image = ImageReader(io.BytesIO(picture.drawn(".png", dpi=DPI)))

    def fits(self, room: float) -> bool:
        """Whether it has room [pt], as it is or a little smaller."""
        return bool(SHRUNK * self.full[1] + self.below <= room)

    def wrap(self, width: float, room: float) -> tuple[float, float]:
        scale = min((room - self.below) / self.full[1], 1.0)
        self.size = tuple(side * (scale if scale >= SHRUNK else 1.0) for side in self.full)
        return self.size[0], self.size[1] + self.below

    def draw(self) -> None:
        self.canv.drawImage(self.image, 0, self.below, *self.size)
        self.caption.drawOn(self.canv, 0, 4)


class _Document(BaseDocTemplate):
    """A document in which what follows a picture that does not fit fills the page before it."""

    def handle_flowable(self, flowables: list[Flowable]) -> None:
        """Draw the first of the flowables, or a group for which the page has room in its place."""
        if isinstance(flowables[0], _Figure):
            self._fill_page(flowables, self.frame._y - self.frame._y1p)
        super().handle_flowable(flowables)

    def _fill_page(self, flowables: list[Flowable], room: float) -> None:
        """Put the next group before a picture that has no room on the page [pt], where the group has."""
        if flowables[0].fits(room):
            return
        starts = [k for k, one in enumerate(flowables) if isinstance(one, CondPageBreak | _Figure)]
        group = next((k for k in starts if isinstance(flowables[k], CondPageBreak)), None)
        if group is not None and flowables[group].height <= room:
            end = next((k for k in starts if k > group), len(flowables))
            moved = flowables[group:end]
            del flowables[group:end]
            flowables[:0] = moved


class _Numbered(Canvas):
    """A canvas that writes the number of the page, and of all pages, on each."""

    def __init__(self, *given: Any, **options: Any) -> None:
        super().__init__(*given, **options)
        self._kept: list[dict[str, Any]] = []

    def showPage(self) -> None:  # noqa: N802 (reportlab's name)
        self._kept.append(dict(self.__dict__))
        self._startPage()

    def save(self) -> None:
        kept = self._kept
        for k, page in enumerate(kept, start=1):
            self.__dict__.update(page)
            self.setFont(FONT, SMALL)
            self.drawRightString(self._pagesize[0] - MARGIN, 0.6 * FOOT, f"page {k} of {len(kept)}")
            super().showPage()
        super().save()


def _frame_page(canvas: Canvas, report: Report, width: float, height: float) -> None:
    """What stands above and below the text of each page: title, logo or company, a line."""
    top = height - 0.42 * INCH
    canvas.setFont(BOLD, SIZE)
    canvas.drawString(MARGIN, top, _cut(report.title, BOLD, 0.6 * width))
    if report.logo is not None:
        logo = ImageReader(io.BytesIO(report.logo))
        wide, high = logo.getSize()
        scale = min(2 * INCH / wide, 0.42 * INCH / high)
        place = width - MARGIN - wide * scale, height - 0.6 * INCH
        canvas.drawImage(logo, *place, wide * scale, high * scale, mask="auto")
    elif report.company:
        canvas.setFont(FONT, SIZE)
        canvas.drawRightString(width - MARGIN, top, _cut(report.company, FONT, 0.3 * width))
    canvas.setStrokeColor(colors.HexColor("#888888"))
    canvas.line(MARGIN, height - 0.66 * INCH, width - MARGIN, height - 0.66 * INCH)
    canvas.setFont(FONT, SMALL)
    canvas.drawString(MARGIN, 0.6 * FOOT, _cut(f"FCTD, torque and drag, {report.date}", FONT, 0.6 * width))


def _cut(text: str, font: str, room: float) -> str:
    """A text that fits a line, with an ellipsis where it was longer."""
    shown = _shown(text[: int(room)])  # no character is narrower than a point
    if shown == text and pdfmetrics.stringWidth(shown, font, SIZE) <= room:
        return shown
    while shown and pdfmetrics.stringWidth(f"{shown}…", font, SIZE) > room:
        shown = shown[:-1]
    return f"{shown}…"


def _drawn(table: Table, room: float, height: float) -> Drawn:
    """A table as reportlab draws it: heads on each page, texts that wrap, numbers to the right.

    room, height : of a page [pt]; a row that is higher breaks over pages.
    """
    size, widths = _sizes(table, room)
    cell = ParagraphStyle("cell", BODY, fontSize=size, leading=1.2 * size)
    heads = [ParagraphStyle("head", cell, fontName=BOLD, alignment=2 if numeric else 0) for numeric in table.numeric]

    def shown(of: Cell, width: float) -> Any:
        text = _shown(of.text)
        fits = pdfmetrics.stringWidth(text, FONT, size) <= width - 2 * PAD + 0.1
        return text if fits else Paragraph(escape(text), cell)

    rows = [[shown(of, width) for of, width in zip(row, widths, strict=True)] for row in table.rows]
    if table.heads:
        rows.insert(0, [_paragraph(str(head), style) for head, style in zip(table.heads, heads, strict=True)])
    look = [
        ("FONT", (0, 0), (-1, -1), FONT, size, 1.2 * size), ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("LEFTPADDING", (0, 0), (-1, -1), PAD), ("RIGHTPADDING", (0, 0), (-1, -1), PAD),
        ("TOPPADDING", (0, 0), (-1, -1), 1), ("BOTTOMPADDING", (0, 0), (-1, -1), 1.5),
        ("LINEBELOW", (0, 0), (-1, -1), 0.25, colors.HexColor("#dddddd")),
        *(("ALIGN", (k, 0), (k, -1), "RIGHT") for k, numeric in enumerate(table.numeric) if numeric),
    ]  # fmt: skip
    if table.heads:
        look += [("LINEBELOW", (0, 0), (-1, 0), 0.8, colors.black), ("VALIGN", (0, 0), (-1, 0), "BOTTOM")]
    drawn = Drawn(rows, widths, style=look, repeatRows=int(bool(table.heads)), hAlign="LEFT")
    drawn.wrap(room, height)
    drawn.splitInRow = int(max(drawn._rowHeights) > 0.8 * height)
    return drawn


def _sizes(table: Table, room: float) -> tuple[float, list[float]]:
    """Size of type [pt], smaller for wide tables, and widths of the columns, in which no number breaks."""
    for size in (SIZE, 7.0, 6.0, 5.0):
        least, most = zip(*(_column(table, k, size, room) for k in range(len(table.rows[0]))), strict=True)
        if sum(least) <= room:
            break
    if sum(most) <= room:
        return size, list(most)
    spare = max(room - sum(least), 0.0) / max(sum(most) - sum(least), 1e-9)
    shrink = min(room / sum(least), 1.0)
    return size, [shrink * low + spare * (high - low) for low, high in zip(least, most, strict=True)]


def _column(table: Table, k: int, size: float, room: float) -> tuple[float, float]:
    """Least width of a column and that in which nothing wraps but its head [pt]."""
    head = str(table.heads[k]) if table.heads else ""
    words = [pdfmetrics.stringWidth(word, BOLD, size) for word in _shown(head).split()]
    least, most = max(words, default=0.0), max(*words, 0.5 * sum(words), 0.0) if words else 0.0
    for row in table.rows:
        cell = _shown(row[k].text)
        whole = pdfmetrics.stringWidth(cell, FONT, size)
        longest = whole
        if row[k].number is None:
            longest = max((pdfmetrics.stringWidth(word, FONT, size) for word in cell.split()), default=0.0)
        least, most = max(least, min(longest, 0.25 * room)), max(most, whole)
    return least + 2 * PAD + 0.2, most + 2 * PAD + 0.2
