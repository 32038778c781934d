"""Charts of made-up loads, strings of every operation, and what the tests of pictures ask of a figure."""

from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation, Text

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import equilibrium
from fctd.steady.steady_string import Equilibrium
from tests.cases import make_case, pipe

BLOCK = 3e4  # weight of the block [N]
LBF, FOOT = 4.4482216152605, 0.3048
DEPTHS = np.arange(1000.0, 2001.0, 50.0)
FAN = {"trip_out": 1.0, "rotate_off_bottom": 0.0, "trip_in": -1.0, "back_ream": 0.3, "drill_rotating": -0.2}
TURNS = {"rotate_off_bottom": 1.0, "back_ream": 1.1, "drill_rotating": 1.3}


def chart(kinds: list[str], frictions: list[float], lost: dict[str, str] | None = None) -> pd.DataFrame:
    """A chart of made-up loads; ``lost`` maps a status to the kind whose upper half has it."""
    rows = [
        {
            "operation": kind,
            "friction": friction,
            "bit_depth_m": depth,
            "hookload_N": 250.0 * depth * (1 + FAN.get(kind, -1.3) * friction),
            "surface_torque_N_m": 20.0 * friction * depth * TURNS.get(kind, 0.0),
            "weight_indicator_N": 250.0 * depth * (1 + FAN.get(kind, -1.3) * friction) + BLOCK,
            "total_contact_force_N": 100.0 * depth,
            "hookload_low_N": np.nan,
            "hookload_high_N": np.nan,
            "buckling": "none",
            "status": "converged",
            "notes": "none",
            "reason": "none",
        }
        for kind in kinds
        for friction in frictions
        for depth in DEPTHS
    ]
    table = pd.DataFrame(rows)
    for status, kind in (lost or {}).items():
        at = (table["operation"] == kind) & (table["bit_depth_m"] < 1500)
        table.loc[at, "status"] = status
        if not SteadyStatus(status).has_loads:
            table.loc[at, ["hookload_N", "surface_torque_N_m", "weight_indicator_N"]] = np.nan
    return table


def locked_chart() -> pd.DataFrame:
    """A string that slides deeper: pushed from 1,500 m on, too hard to show from 1,650 m, stuck from 1,800 m."""
    table = chart(["drill_sliding"], [0.3])
    depth = table["bit_depth_m"]
    table["hookload_N"] = 300.0 * (1400 - depth)
    table["surface_torque_N_m"] = 0.0
    table.loc[depth >= 1650, ["hookload_N", "surface_torque_N_m"]] = [-5e7, 4e6]
    table.loc[depth >= 1800, ["hookload_N", "surface_torque_N_m"]] = np.nan
    table["weight_indicator_N"] = table["hookload_N"] + BLOCK
    table.loc[depth >= 1500, "status"] = "locked_up"
    table.loc[depth >= 1200, "buckling"] = "sinusoidal"
    table.loc[depth >= 1400, "buckling"] = "helical"
    return table


def well(**keys: Any) -> Case:
    """A well with a shoe at 1,500 m, mud, a block and loads at the bit."""
    case = make_case([[0.0, 0, 0], [2000, 40, 0]], [pipe(None, 40, 0.127, 0.1086)], **keys)
    above = case.wellbore.intervals[0].model_copy(update={"to_md": 1500.0})
    wellbore = case.wellbore.model_copy(update={"intervals": (above, *case.wellbore.intervals)})
    return case.model_copy(update={"wellbore": wellbore})


@cache
def points() -> tuple[Equilibrium, ...]:
    """Every kind of operation in one well, the drilling ones buckled or out of balance."""
    stations = [[0.0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
    case = make_case(
        stations,
        [pipe(200, 10, 0.16), pipe(None, None, segment_length=20.0)],
        bit={"weight_on_bit": 150e3, "torque": 3e3},
    )
    return tuple(equilibrium(case, kind, 880.0) for kind in KINDS)


def lines(ax: Axes, **look: Any) -> list[Line2D]:
    """The lines of an axis that look so."""
    return [line for line in ax.lines if all(getattr(line, f"get_{name}")() == value for name, value in look.items())]


def curves(ax: Axes) -> list[Line2D]:
    """The lines of an axis that are curves: with a marker at some of many points."""
    return [line for line in ax.lines if line.get_markevery() is not None]


def legend_of(figure: Figure) -> list[str]:
    """Texts of the legend."""
    return [text.get_text() for box in figure.legends for text in box.get_texts()]


def labels_of(ax: Axes) -> list[str]:
    """Texts that stand in axes."""
    return [text.get_text() for text in ax.texts]


def texts_that_overlap(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of visible texts of which one covers part of the other; all of them lie within the figure."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    shown: list[Text] = [*figure.texts, *figure.findobj(Annotation)]
    for ax in figure.axes:
        shown += [ax.xaxis.label, ax.yaxis.label, ax._left_title, ax.xaxis.get_offset_text()]
        for axis in (ax.xaxis, ax.yaxis):
            low, high = sorted(axis.get_view_interval())
            ticks = [tick for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
            shown += [text for tick in ticks for text in (tick.label1, tick.label2) if text.get_visible()]
    for legend in figure.legends:
        shown += legend.get_texts()
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in shown if text.get_text()]
    inside = figure.bbox
    assert [t for t, b in boxes if not (inside.x0 <= b.x0 < b.x1 <= inside.x1)] == []
    assert [t for t, b in boxes if not (inside.y0 <= b.y0 < b.y1 <= inside.y1)] == []
    return [(one, other) for (one, a), (other, b) in combinations(boxes, 2) if a.padded(-0.5).overlaps(b.padded(-0.5))]
