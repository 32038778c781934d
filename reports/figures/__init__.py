"""The figures of the studies, each drawn from its study's tables alone."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass

import matplotlib.figure
import pandas as pd

Canvas = matplotlib.figure.Figure
Tables = dict[str, pd.DataFrame]


@dataclass(frozen=True)
class Figure:
    """A figure of a study: its file name, its caption, and the function that draws it."""

    name: str
    caption: str
    draw: Callable[[Tables], Canvas]


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


def figure(*studies: str, name: str, caption: str) -> Callable[[Draw], Draw]:
    """A function that draws a figure from the tables of its study, and of others that have the same tables."""

    def register(draw: Draw) -> Draw:
        for study in studies:
            _FIGURES.setdefault(study, []).append(Figure(name, caption, draw))
        return draw

    return register


def by_study() -> dict[str, list[Figure]]:
    """Study -> its figures in the order of the page; studies that only have tables are not among them."""
    for module in MODULES:
        importlib.import_module(f"reports.figures.{module}")
    return _FIGURES
