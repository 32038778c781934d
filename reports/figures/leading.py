"""The pictures at the top of the page, small enough to stand side by side."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from reports import words
from reports.figures import Canvas, Figure, Tables, style
from reports.figures.methods import FLOOR, exact_line

SIZE_IN = (4.3, 3.3)
LETTERS = 8.5  # of legends, in a picture that a page shows smaller than it is [pt]
WELL = "paper-well"
KINDS = {"trip_out": "picking up", "rotate_off_bottom": "rotating", "trip_in": "slacking off"}


@dataclass(frozen=True)
class Leading:
    """A picture of the first screen: the study whose tables it draws, and the study's own figure that tells more."""

    study: str
    figure: Figure
    more: str


def _subplots() -> tuple[Canvas, Axes]:
    canvas = Canvas(figsize=SIZE_IN, layout="constrained")
    return canvas, canvas.subplots()


def _legend(canvas: Canvas, ax: Axes, **more: Any) -> None:
    found = ax.get_legend_handles_labels()
    canvas.legend(*found, loc="outside upper left", ncols=3, fontsize=LETTERS, columnspacing=0.8, **more)


def cost_and_error(tables: Tables) -> Canvas:
    """Error of penetration against cost, a line for each contact method."""
    cost = tables["cost"]
    canvas, ax = _subplots()
    column = "max_error_mm"
    floor = FLOOR * cost.loc[cost[column] > 1e-5, column].min()
    for index, method in enumerate(cost["method"].unique()):
        chosen = cost[cost["method"] == method]
        # Hollow marks of three sizes: methods of one mesh at one cost lie one inside the other.
        look = style.dots(index, filled=False) | {
            "linestyle": "-",
            "linewidth": 0.8,
            "markersize": (9, 6, 3.5)[index % 3],
        }
        look |= {"markerfacecolor": "none", "markeredgewidth": 1.2}
        ax.plot(chosen["point_ns"], chosen[column].clip(lower=floor), **look, label=words.name(method))
    exact_line(ax, floor)
    ax.set(xscale="log", yscale="log", xlabel="cost per point, ns", ylabel="largest error of penetration, mm")
    _legend(canvas, ax)
    return canvas


def where_it_touches(tables: Tables) -> Canvas:
    """The paper's well from the side, as wide as its clearance drawn hundreds of times, with the string's contacts."""
    profiles = tables["profiles"]
    rows = profiles[(profiles["variant"] == WELL) & (profiles["operation"] == "trip_in")]
    rows = rows[rows["bit_depth_m"] == rows["bit_depth_m"].max()].sort_values("md_m")
    md, inclination = (rows[name].to_numpy(float) for name in ("md_m", "inclination_deg"))
    angle = np.radians(inclination)
    sine, cosine = np.sin(angle), np.cos(angle)
    step = np.diff(md)
    out = np.append(0.0, np.cumsum(0.5 * (sine[1:] + sine[:-1]) * step))
    down = md[0] + np.append(0.0, np.cumsum(0.5 * (cosine[1:] + cosine[:-1]) * step))
    clearance = rows["clearance_m"].to_numpy(float)
    times = 0.02 * (down[-1] - down[0]) / np.median(clearance)

    def beside(offset: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Places off the axis, positive to the high side."""
        return out + times * offset * cosine, down - times * offset * sine

    canvas, ax = _subplots()
    for side in (-1.0, 1.0):
        left, down_side = beside(side * clearance)
        ax.plot(left, down_side, color=style.QUIET, linewidth=0.8)
    high = rows["offset_high_m"].to_numpy(float)
    x, y = beside(high)
    ax.plot(x, y, color=style.COLOURS[0], linewidth=1.1, label="string")
    at = rows["contact_force_N"].to_numpy(float) > 0
    dots = ax.scatter(
        np.asarray(x)[at], np.asarray(y)[at], c=rows["contact_force_N"].to_numpy(float)[at] / 1e3, cmap="YlOrRd",
        edgecolors="black", linewidths=0.5, s=16, zorder=3, label="touches",
    )  # fmt: skip
    canvas.colorbar(dots, ax=ax, label="contact force, kN", shrink=0.8)
    first = down[at].min() if at.any() else down[0]
    ax.set(xlabel="departure, m", ylabel="true vertical depth, m", ylim=(down[-1] + 60, first - 120))
    scale = f"clearance drawn {words.number(round(times, -1))} times as wide"
    _legend(canvas, ax, title=scale, title_fontsize=LETTERS, alignment="left")
    return canvas


def stiff_and_measured(tables: Tables) -> Canvas:
    """Weight indicator over bit depth: the stiff string's curves, and measured points with their ranges."""
    points = tables["points"]
    points = points[points["load"] == "hookload"]
    canvas, ax = _subplots()
    for index, (kind, name) in enumerate(KINDS.items()):
        for k, (_, curve) in enumerate(tables["curves"].groupby("string", sort=False)):
            rows = curve[curve["operation"] == kind]
            label = name if k == 0 else None
            ax.plot(rows["weight_indicator_N"] / 1e3, rows["bit_depth_m"], **style.line(index), label=label)
        rows = points[points["operation"] == kind]
        middle, half = 0.5 * (rows["low"] + rows["high"]), 0.5 * (rows["high"] - rows["low"])
        look = style.dots(index, filled=False) | {"markersize": 3.5}
        ax.errorbar(middle, rows["bit_depth_m"], xerr=half, linewidth=0.8, **look)
    ax.set_xlabel("weight indicator, kN (marks: measured)")
    style.depth_downwards(ax, "bit depth, m")
    _legend(canvas, ax)
    return canvas


def force_of_segments(tables: Tables) -> Canvas:
    """Total contact force of the scaled section against time, of beam finite elements and of rigid segments."""
    table = tables["force"]
    canvas, ax = _subplots()
    for index, model in enumerate(table["model"].unique()):
        rows = table[table["model"] == model]
        ax.plot(rows["time_s"], rows["total_N"] / 1e3, **style.line(index), label=model)
    ax.set(xlabel="time, s", ylabel="contact force, kN", ylim=(0, None))
    _legend(canvas, ax)
    return canvas


# The first three that can be drawn stand on the first screen; what needs public data has a substitute.
SHOWN = 3
LEADING = [
    Leading(
        "contact_accuracy",
        Figure("cost", "Cost against error of the contact methods", cost_and_error),
        "error_and_cost",
    ),
    Leading(
        "paper_well",
        Figure(
            "touches",
            "Where the string that goes into the paper's well touches; its collars leave less clearance",
            where_it_touches,
        ),
        "contact",
    ),
    Leading(
        "volve_f4",
        Figure("measured", "The stiff string against a public well's readings", stiff_and_measured),
        "chart",
    ),
    Leading(
        "scaled_section",
        Figure("force_of_segments", "Contact force of rigid segments and of beam finite elements", force_of_segments),
        "force",
    ),
]
