"""What a report is made of."""

import matplotlib.pyplot as plt

from fctd.report.parts import Picture, Report, Section, Text
from fctd.results.shown_tables import Table


def test_tables_stand_in_the_order_of_the_sections() -> None:
    first, second = (Table(title, (), ()) for title in ("first", "second"))
    sections = (Section("one", (Text("a paragraph"), first)), Section("two", (second,)))
    assert Report("title", "", "", "2026-11-29", None, "si", sections).tables == [first, second]


def test_a_picture_is_drawn_in_its_size() -> None:
    figure = plt.figure(figsize=(3.0, 2.0))
    picture = Picture("caption", figure)
    assert picture.size == (3.0, 2.0)
    assert picture.drawn("svg").startswith(b"<?xml")
    plt.close(figure)
