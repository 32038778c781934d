"""The figures: study -> module with ``FIGURES``, each drawn from the study's tables alone."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass

import matplotlib.figure
import pandas as pd

Tables = dict[str, pd.DataFrame]


@dataclass(frozen=True)
class Figure:
    """A figure of a study: its file name, its caption, and the function that draws it."""

    name: str
    caption: str
    draw: Callable[[Tables], matplotlib.figure.Figure]


MODULES: dict[str, str] = {
    "paper_well": "reports.figures.paper_well",
    "curved_chain": "reports.figures.curved_chain",
    "scaled_section": "reports.figures.scaled_section",
    "energy_ledger": "reports.figures.energy_ledger",
    "overlap": "reports.figures.overlap",
    "cylinder_error": "reports.figures.cylinder_error",
    "steady_state": "reports.figures.steady_state",
    "soft_limit": "reports.figures.soft_limit",
    "beam_in_hole": "reports.figures.beam_in_hole",
    "real_chart": "reports.figures.real_chart",
    "segment_count": "reports.figures.segment_count",
    "refine": "reports.figures.refine",
    "contact_accuracy": "reports.figures.contact_accuracy",
    "contact_swap": "reports.figures.contact_swap",
    "engines_agree": "reports.figures.engines_agree",
    "refine_real": "reports.figures.refine",
    "real_survey": "reports.figures.real_survey",
}


def of_study(study: str) -> list[Figure]:
    """The study's figures in the order of the page; none for a study that only has tables."""
    if study not in MODULES:
        return []
    figures: list[Figure] = importlib.import_module(MODULES[study]).FIGURES
    return figures
