"""Chapters and the paper's figures: what they name is there, answers are filled with stored numbers."""

import math
from collections import Counter
from dataclasses import replace

import pytest

from reports import chapters, figures
from reports.chapters import Sentence
from reports.figures.leading import LEADING
from tests.reports.pages import BLANK, judged
from validation.harness.registry import STUDIES
from validation.harness.store import Judged
from validation.harness.study import Check

from . import synthetic


def test_chapters_name_studies_once_and_pictures_that_there_are():
    found = chapters.contents()
    named = Counter(study for chapter in found.chapter for study in chapter.studies)
    assert set(named.values()) == {1}
    assert set(named) <= set(STUDIES)
    addresses = [chapter.picture for chapter in found.chapter] + [each.ours for each in found.paper]
    for address in addresses:
        study, _, name = address.partition("/")
        assert study in STUDIES
        assert not name or name in {figure.name for figure in figures.by_study()[study]}
    assert [each.figure for each in found.paper] == list(range(1, 14))
    assert all(len(chapter.sentence) == 2 for chapter in found.chapter)
    assert {study for chapter in found.chapter for each in chapter.sentence for study, _ in each.numbers} <= set(
        STUDIES
    )


def test_a_study_that_no_chapter_names_stands_in_the_last():
    found = chapters.by_chapter(["overlap", "new_one"])
    assert found["contact"] == ["overlap"]
    assert found["wells"] == ["new_one"]


def test_an_answer_has_its_numbers_or_says_what_to_run():
    sentence = Sentence(says="It is {0}, not {1}.", numbers=(("overlap", "a"), ("jumps", "b")))
    records = {"overlap": replace(BLANK, checks=(judged(0.25, name="a"),))}
    assert sentence.filled(records) == "Not answered yet: python -m validation jumps."
    records["jumps"] = replace(BLANK, study="jumps", checks=(judged(2.0, name="b"),))
    assert sentence.filled(records) == "It is 0.25\u00a0kN·m, not 2\u00a0kN·m."
    records["jumps"] = replace(BLANK, study="jumps", checks=(judged(math.nan, name="b"),))
    assert sentence.filled(records) == "Not answered: a run failed, so that jumps found no number."


def test_no_sentence_says_what_the_interval_of_its_ratio_leaves_open():
    sentence = Sentence(says="It takes {0} times as long.", otherwise="It may be {0}.", numbers=(("overlap", "a"),))
    for interval, said in (
        ((1.04, 1.3), "It takes 1.1 (1.04 to 1.3) times as long."),
        ((0.95, 1.3), "It may be 1.1 (0.95 to 1.3)."),
    ):
        check = Check("a", 1.1, 2.0, "at_most", "", "test", timed=True, interval=interval)
        assert sentence.filled({"overlap": replace(BLANK, checks=(Judged(check, None),))}) == said


@pytest.mark.parametrize("each", LEADING, ids=[each.study for each in LEADING])
def test_pictures_of_the_first_screen_draw(each):
    canvas = each.figure.draw(synthetic.STUDIES[each.study]())
    ax = canvas.axes[0]
    assert ax.get_lines()
    assert all(", " in label for label in (ax.get_xlabel(), ax.get_ylabel()))
    assert each.more in {figure.name for figure in figures.by_study()[each.study]}
