"""The figures: study -> module with ``FIGURES``, each drawn from the study's tables alone."""

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


MODULES: dict[str, str] = {
    "paper_well": "reports.figures.paper_well",
    "well_profile": "reports.figures.well_profile",
    "curved_chain": "reports.figures.curved_chain",
    "scaled_section": "reports.figures.scaled_section",
    "energy_ledger": "reports.figures.energy_ledger",
    "overlap": "reports.figures.overlap",
    "cylinder_error": "reports.figures.cylinder_error",
    "cylinder_ringing": "reports.figures.cylinder_ringing",
    "contact_operations": "reports.figures.contact_operations",
    "rock_stiffness": "reports.figures.rock_stiffness",
    "long_segment": "reports.figures.long_segment",
    "trips": "reports.figures.trips",
    "steady_state": "reports.figures.steady_state",
    "broomstick": "reports.figures.broomstick",
    "soft_limit": "reports.figures.soft_limit",
    "soft_stiff_map": "reports.figures.soft_stiff_map",
    "friction_laws": "reports.figures.friction_laws",
    "sticking": "reports.figures.sticking",
    "tortuosity": "reports.figures.tortuosity",
    "mud_effects": "reports.figures.mud_effects",
    "top_drive": "reports.figures.top_drive",
    "stick_slip": "reports.figures.stick_slip",
    "whirl": "reports.figures.whirl",
    "drilling": "reports.figures.drilling",
    "spin_up": "reports.figures.spin_up",
    "beam_in_hole": "reports.figures.beam_in_hole",
    "post_buckling": "reports.figures.post_buckling",
    "real_chart": "reports.figures.real_chart",
    "segment_count": "reports.figures.segment_count",
    "refine": "reports.figures.refine",
    "contact_accuracy": "reports.figures.contact_accuracy",
    "contact_swap": "reports.figures.contact_swap",
    "mesh_torque": "reports.figures.mesh_torque",
    "engines_agree": "reports.figures.engines_agree",
    "speed": "reports.figures.speed",
    "robust_rows": "reports.figures.robust_rows",
    "refine_real": "reports.figures.refine",
    "real_survey": "reports.figures.real_survey",
    "volve_f4": "reports.figures.volve_f4",
    "ladder": "reports.figures.ladder",
}


def of_study(study: str) -> list[Figure]:
    """The study's figures in the order of the page; none for a study that only has tables."""
    if study not in MODULES:
        return []
    figures: list[Figure] = importlib.import_module(MODULES[study]).FIGURES
    return figures
