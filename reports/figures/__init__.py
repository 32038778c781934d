"""The figures of the studies, each drawn from its study's tables alone."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from fnmatch import fnmatchcase

import matplotlib.figure
import pandas as pd

Canvas = matplotlib.figure.Figure
Tables = dict[str, pd.DataFrame]


@dataclass(frozen=True)
class Figure:
    """A figure of a study: its file name, its caption, and the function that draws it.

    checks : patterns of the names of the checks whose numbers it shows.
    """

    name: str
    caption: str
    draw: Callable[[Tables], Canvas]
    checks: tuple[str, ...] = ()

    def shows(self, check: str) -> bool:
        """Whether it shows the number of a check."""
        return any(fnmatchcase(check, pattern) for pattern in self.checks)


# The modules whose figures register themselves; a study's figures stand on its page in the order of its module.
MODULES = (
    "contact",
    "fronts",
    "methods",
    "precision",
    "strings",
    "buckling",
    "segments",
    "motion",
    "hydraulics",
    "wells",
    "volve_f4",
    "judged",
)
_FIGURES: dict[str, list[Figure]] = {}
Draw = Callable[[Tables], Canvas]


def figure(*studies: str, name: str, caption: str, checks: tuple[str, ...] = ()) -> Callable[[Draw], Draw]:
    """A function that draws a figure from the tables of its study, and of others that have the same tables.

    checks : see ``Figure``; the page prints them beside it.
    """

    def register(draw: Draw) -> Draw:
        for study in studies:
            _FIGURES.setdefault(study, []).append(Figure(name, caption, draw, checks))
        return draw

    return register


def by_study() -> dict[str, list[Figure]]:
    """Study -> its figures in the order of the page; studies that only have tables are not among them."""
    for module in MODULES:
        importlib.import_module(f"reports.figures.{module}")
    return _FIGURES
