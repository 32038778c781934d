"""Which sections a report has."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from fctd.report.answers import Answers
from fctd.report.content import Cover, report_of
from fctd.report.parts import Report
from fctd.results.unit_systems import System

ALWAYS = ["Well", "Hole", "String", "Fluids", "Friction", "Rig and limits", "Assumptions", "Torque and drag"]


@pytest.mark.slow
def test_all_sections_stand_in_their_order(made: Callable[[System], Report]) -> None:
    titles = [section.title for section in made("si").sections]
    assert titles == [*ALWAYS, "Margins", "Profiles", "Hydraulics", "Notes", "Versions", "Profiles in numbers"]


def test_sections_without_answers_are_left_out(answers: Answers) -> None:
    found = replace(answers, margins=None, lines=None, circulations=())
    titles = [section.title for section in report_of(found, Cover(), "si").sections]
    assert titles == [*ALWAYS, "Profiles", "Notes", "Versions", "Profiles in numbers"]


def test_the_title_keeps_one_line(made: Callable[[System], Report]) -> None:
    assert made("si").title == 'A & B <b>"well"</b> 水 \\x1b[31m'


def test_a_torque_and_a_depth_have_the_same_digits_everywhere(made: Callable[[System], Report]) -> None:
    """No pipe is buckled, whose depths are whole."""
    for unit, digits in (("kN·m", {3}), ("m", {1})):
        found = {
            len(row[k].text.partition(".")[2])
            for table in made("si").tables
            for row in table.rows
            for k, head in enumerate(map(str, table.heads))
            if row[k].number is not None and (head.endswith(f"({unit})") or row[1].text == unit)
        }
        assert found == digits
