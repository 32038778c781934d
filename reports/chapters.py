"""The chapters of the page and the paper's figures, as ``chapters.toml`` has them, and their answers."""

import math
import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from pydantic import BaseModel, ConfigDict

from reports import words
from validation.harness.store import Record

FILE = Path(__file__).with_name("chapters.toml")


class Strict(BaseModel):
    """A table of a file whose every key is known."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Sentence(Strict):
    """A sentence of an answer; numbers : study and name of the check, for ``{0}`` and so on.

    otherwise : what it says where the interval of one of its ratios holds 1, so that it may be the other way round.
    """

    says: str
    otherwise: str = ""
    numbers: tuple[tuple[str, str], ...]

    def filled(self, records: Mapping[str, Record]) -> str:
        """The sentence with its numbers, or which studies have to be run for it, or which of them found no number."""
        values, missing, without, doubtful = [], [], [], False
        for study, name in self.numbers:
            found = (
                [judged.check for judged in records[study].checks if judged.check.name == name]
                if study in records
                else []
            )
            if found and math.isnan(found[0].value):
                without.append(study)
            elif found:
                values.append(words.found(found[0]))
                low, high = found[0].interval or (math.nan, math.nan)
                doubtful |= low <= 1 <= high
            else:
                missing.append(study)
        if missing:
            return f"Not answered yet: python -m validation {' '.join(dict.fromkeys(missing))}."
        if without:
            return f"Not answered: a run failed, so that {' and '.join(dict.fromkeys(without))} found no number."
        return (self.otherwise if doubtful and self.otherwise else self.says).format(*values)


class Chapter(Strict):
    """A chapter; picture : STUDY/FIGURE."""

    id: str
    title: str
    question: str
    picture: str
    studies: tuple[str, ...]
    sentence: tuple[Sentence, ...]


class PaperFigure(Strict):
    """A figure of the paper; ours : STUDY/FIGURE, or a study that has tables alone.

    prints : of a figure with curves, what the text prints of them.
    """

    figure: int
    shows: str
    ours: str
    prints: str = ""


class Contents(Strict):
    """The content of ``chapters.toml``."""

    chapter: tuple[Chapter, ...]
    paper: tuple[PaperFigure, ...]


@cache
def contents() -> Contents:
    """The chapters and the paper's figures."""
    return Contents.model_validate(tomllib.loads(FILE.read_text(encoding="utf-8")))


def by_chapter(studies: Iterable[str]) -> dict[str, list[str]]:
    """The studies of each chapter by its id, in the order given; those that no chapter names stand in the last."""
    chapters = contents().chapter
    homes = {study: chapter.id for chapter in chapters for study in chapter.studies}
    found: dict[str, list[str]] = {chapter.id: [] for chapter in chapters}
    for study in studies:
        found[homes.get(study, chapters[-1].id)].append(study)
    return found
