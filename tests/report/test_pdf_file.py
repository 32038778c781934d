"""The PDF of a report: its numbers are those of the tables, heads stand on each page, no page is half empty."""

import io
from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest
from matplotlib.figure import Figure

from fctd.report.parts import Part, Picture, Report, Section, Text
from fctd.results.shown_tables import Cell, Table, number
from fctd.results.unit_systems import System
from tests.report.conftest import ADDRESS, FORMULA


def read(content: bytes) -> Any:
    return pytest.importorskip("pypdf").PdfReader(io.BytesIO(content))


def pages(content: bytes) -> list[Any]:
    return list(read(content).pages)


def lowest(page: Any) -> float:
    """Height of the lowest text or picture above the foot of a page, as a share of the page."""
    found: list[float] = []

    def text(said: str, _: Any, place: Any, *font: Any) -> None:
        if said.strip() and place[5] > 40:
            found.append(place[5])

    def drawn(operator: bytes, given: Any, place: Any, _: Any) -> None:
        if operator == b"Do":
            found.append(place[5])

    page.extract_text(visitor_text=text, visitor_operand_before=drawn)
    return min(found) / float(page.mediabox.height)


def report(*parts: Part, title: str = "test", units: System = "si") -> Report:
    return Report(title, "", "", "2026-01-01", None, units, (Section("One", parts),))


@pytest.mark.slow
@pytest.mark.parametrize("units", ["si", "field"])
def test_every_number_is_that_of_its_table(
    units: System, made: Callable[[System], Report], files: Callable[[System, str], bytes]
) -> None:
    """As often as in the tables, whole, and in words of their own."""
    found = Counter("\n".join(page.extract_text() for page in pages(files(units, ".pdf"))).split())
    cells = [cell for table in made(units).tables for row in table.rows for cell in row]
    expected = Counter(cell.text for cell in cells if cell.number is not None)
    assert expected.total() > 500
    assert expected - found == Counter()


@pytest.mark.slow
def test_names_stand_as_they_are(files: Callable[[System, str], bytes]) -> None:
    """But for characters that the font lacks."""
    content = files("si", ".pdf")
    text = "\n".join(page.extract_text() for page in pages(content))
    for name in ('A & B <b>"well"</b> \\u6c34 \\x1b[31m', FORMULA, ADDRESS, "<i>pipe</i>", "C <& D>", "page 1 of"):
        assert name in text
    about = read(content)
    assert about.metadata.author == "E F"
    assert [entry.title for entry in about.outline][:3] == ["Well", "Hole", "String"]


@pytest.mark.slow
def test_no_page_is_half_empty(files: Callable[[System, str], bytes]) -> None:
    *full, _ = pages(files("si", ".pdf"))
    assert max(map(lowest, full)) < 0.35


def test_a_long_table_has_its_heads_on_each_page_and_each_of_its_rows() -> None:
    from fctd.report.pdf_file import to_pdf

    rows = tuple((Cell(f"row{k}", None), number(k, 3), Cell("word " * 20)) for k in range(450))
    found = [page.extract_text().split() for page in pages(to_pdf(report(Table("", ("name", "value", "text"), rows))))]
    assert len(found) > 8
    assert all({"name", "value", "text"} <= set(words) for words in found)
    assert [word for words in found for word in words if word.startswith("row")] == [f"row{k}" for k in range(450)]


def test_a_picture_that_does_not_fit_leaves_its_page_to_what_follows() -> None:
    from fctd.report.pdf_file import to_pdf

    rows = tuple((number(k, 1), number(2 * k, 1)) for k in range(30))
    before, after = Table("", ("a", "b"), rows), Table("", ("c", "d"), rows)
    tall = Picture("caption of the picture", Figure(figsize=(7, 8)))
    first, second, *_ = (page.extract_text() for page in pages(to_pdf(report(before, tall, after, Text("end")))))
    assert {"c", "d"} < set(first.split())
    assert "caption of the picture" not in first
    assert "caption of the picture" in second


@pytest.mark.parametrize("long", ["x" * 6000, "word " * 2000])
def test_texts_of_any_length_are_no_error(long: str) -> None:
    """In a title, a cell and a paragraph: the title is cut, the others break over lines and pages."""
    from fctd.report.pdf_file import to_pdf

    made = report(Table(long, ("a", "b"), ((Cell(long), number(1.0, 1)),)), Text(long), title=long)
    text = "".join(page.extract_text() for page in pages(to_pdf(made)))
    assert text.count(long[0]) >= 3 * len(long) // (1 if " " not in long else 5)


def test_the_same_report_gives_the_same_bytes_and_field_units_letter_paper() -> None:
    from fctd.report.pdf_file import to_pdf

    first = report(Text("text"), units="field")
    assert to_pdf(first) == to_pdf(first)
    assert [float(side) for side in pages(to_pdf(first))[0].mediabox[2:]] == [612, 792]
