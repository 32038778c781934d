"""The sheet and the files of pictures."""

from pathlib import Path

import pytest
from matplotlib.lines import Line2D
from matplotlib.text import Text

from fctd import plots
from fctd.plots.style import Sheet
from fctd.results.notes import MEANINGS
from tests.plots.made import chart, legend_of, texts_that_overlap


@pytest.mark.slow
def test_files_are_as_their_suffix_says_and_the_same_each_time(tmp_path: Path) -> None:
    figure = plots.chart_figure(chart(["trip_in"], [0.2]))
    for suffix, start in ((".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")):
        first, second = tmp_path / f"a{suffix}", tmp_path / "new" / f"b{suffix}"
        for path in (first, second):
            assert plots.save(figure, path) == [path]
        assert first.read_bytes().startswith(start)
        assert first.read_bytes() == second.read_bytes()


def test_long_lines_of_the_heading_are_wrapped() -> None:
    sheet = Sheet(6.0, 2.0, "title", ["fact " * 60, "a note"], [])
    sheet.axes(1, 0.3, 4, 1)
    assert len(sheet.figure.texts) > 4
    assert texts_that_overlap(sheet.figure) == []


# The longest of the notes: they have the most lines.
NOTES = sorted((": ".join(meaning) for meaning in MEANINGS.values()), key=len)[-3:]


@pytest.mark.parametrize("line", ["WELL-NAME_IN_CAPITALS " * 12, "M" * 400, *NOTES])
def test_lines_stay_inside_whatever_their_letters(line: str) -> None:
    sheet = Sheet(5.0, 2.0, "title", ["", line], [])
    assert texts_that_overlap(sheet.figure) == []
    _, *lines = (text.get_text() for text in sheet.figure.texts)
    assert " ".join(lines).split() == line.split() or "".join(lines) == line


def test_entries_of_the_legend_read_from_left_to_right() -> None:
    names = [f"entry {k}" for k in range(5)]
    sheet = Sheet(6.0, 1.0, "title", [""], [Line2D([], [], label=name) for name in names])
    sheet.figure.draw_without_rendering()
    (legend,) = sheet.figure.legends
    places = {text.get_text(): text.get_window_extent() for text in legend.get_texts()}
    assert sorted(places, key=lambda name: (-round(places[name].y0), places[name].x0)) == names
    assert set(legend_of(sheet.figure)) == set(names)


@pytest.mark.slow
@pytest.mark.parametrize("title", ["a well with a long name and $x^2$ " * 4, "W" * 80, "word " * 210, "x" * 1001])
def test_a_long_title_stays_in_the_picture(title: str) -> None:
    sheet = Sheet(6.0, 2.0, title, ["a fact", "a note"], [])
    sheet.figure.draw_without_rendering()
    (shown,) = [text for text in sheet.figure.findobj(Text) if text.get_text()[:5] == title[:5]]
    assert shown.get_window_extent().x1 <= sheet.figure.bbox.x1
    assert 1 < len(shown.get_text().splitlines()) <= 3
    assert ("…" in shown.get_text()) == (len(title) > 1000)
    assert texts_that_overlap(sheet.figure) == []


@pytest.mark.parametrize("title", ["", " ", "$", "$x"])
def test_a_title_of_any_text_is_drawn(title: str) -> None:
    Sheet(6.0, 2.0, title, ["a fact"], []).figure.draw_without_rendering()
