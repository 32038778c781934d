"""A string that the block feeds from rest: hook load, and what arrives at the bit, against the feed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.model.operations import bit_loads
from fctd.plots.facts import heading_of_profile
from fctd.plots.palette import DARK, LOOKS, PALETTE, QUIET
from fctd.plots.style import RC, Sheet
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown
from fctd.steady.feed import FOLLOWING, REACHED
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd

# Sizes [in]: of the panels, and of what stands beside and below them.
WIDTH, LEFT, RIGHT, BELOW, BETWEEN = 6.6, 0.85, 0.2, 0.44, 0.16
LOAD, ARRIVING = 2.7, 1.7
NEAR = 0.15  # share of the range of hook loads within which the limit of slack-off is drawn
SNAP: Final[dict[str, Any]] = {
    "marker": "D", "linestyle": "none", "markersize": 7, "markerfacecolor": "none", "markeredgewidth": 1.3,
    "color": PALETTE["vermilion"],
}  # fmt: skip
ARRIVED: Final[dict[str, Any]] = {
    "marker": "o", "linestyle": "none", "markersize": 10, "markerfacecolor": "none", "markeredgewidth": 1.3,
    "color": DARK,
}  # fmt: skip
STUCK: Final[dict[str, Any]] = ARRIVED | {"marker": "X", "markerfacecolor": DARK, "markersize": 8.5}
ROW: Final[dict[str, Any]] = ARRIVED | {"marker": "_", "markersize": 13, "markeredgewidth": 2.2}
ON_BOTTOM: Final[dict[str, Any]] = {"color": QUIET, "linewidth": 0.9, "linestyle": (0, (1, 2)), "zorder": 1.1}
WANTED: Final[dict[str, Any]] = {"color": QUIET, "linewidth": 1.0, "linestyle": (0, (5, 2)), "zorder": 1.1}
SPENT: Final[dict[str, Any]] = {"color": QUIET, "linewidth": 1.0, "linestyle": (0, (7, 2, 1.5, 2)), "zorder": 1.1}


def feeding_figure(point: Equilibrium, units: System = "si", *, warnings: Sequence[str] = ()) -> Figure:
    """Hook load, and weight on bit or the way of the bit, of a fed string against the feed of its block.

    A marker is a balance of ``point.feeding``; those to which the string snapped, and the last one, have marks of their
    own.  Beside the last stands the hook load of the row, with which the string slides on at its rates, if it has one.
    warnings : lines below the title.  Raises ValueError for a string that was not fed.
    """
    path = point.feeding
    if path.empty:
        raise ValueError(f"a string that was fed from rest; the method {point.method!r} found this one")
    weight = _weight_on_bit(point)
    with mpl.rc_context(RC):
        title, lines = heading_of_profile([point], units, warnings)
        lines.insert(1, f"{_words(point.status)}{': ' if point.message else ''}{told(point.message, units)}")
        sheet = Sheet(LEFT + WIDTH + RIGHT, LOAD + BETWEEN + ARRIVING + BELOW, title, lines, _handles(point, path))
        loads = sheet.axes(LEFT, 0.0, WIDTH, LOAD)
        arrives = sheet.axes(LEFT, LOAD + BETWEEN, WIDTH, ARRIVING, sharex=loads)
        metre, newton = shown("feed_m", units), shown("hookload_N", units)
        _curve(loads, point, path, "hookload_N", units)
        if _is_near_spent(point, path):
            loads.axhline(-point.case.rig.push * newton.factor, **SPENT)
        if point.answered:
            loads.plot(path["feed_m"].iloc[-1:] * metre.factor, [point.hookload * newton.factor], **ROW)
        loads.set_ylabel(f"hook load, {newton.label}")
        loads.tick_params(labelbottom=False)
        if weight:
            _curve(arrives, point, path, "weight_on_bit_N", units)
            arrives.axhline(weight * newton.factor, **WANTED)
            arrives.set_ylabel(f"weight on bit, {newton.label}")
            if (touches := _touches_bottom(path)) > 0:
                for ax in (loads, arrives):
                    ax.axvline(touches * metre.factor, **ON_BOTTOM)
        else:
            _curve(arrives, point, path, "bit_moved_m", units)
            behind = float(path["bit_moved_m"].iloc[-1] - path["feed_m"].iloc[-1])  # the block, at the end
            arrives.axline((0.0, behind * metre.factor), slope=1.0, **WANTED)
            arrives.set_ylabel(f"way of the bit, {metre.label}")
            arrives.set_ylim(bottom=-0.04 * _span(path["bit_moved_m"]) * metre.factor)
        arrives.set_xlabel(f"feed of the block, {metre.label}")
        loads.set_xlim(-0.02 * _span(path["feed_m"]) * metre.factor, (1.04 * _span(path["feed_m"])) * metre.factor)
        return sheet.figure


def _curve(ax: Axes, point: Equilibrium, path: pd.DataFrame, column: str, units: System) -> None:
    """A quantity of the path, with the marks of its snaps and of its end."""
    colour, marker = LOOKS[point.operation]
    feed = path["feed_m"].to_numpy(float) * shown("feed_m", units).factor
    value = path[column].to_numpy(float) * shown(column, units).factor
    ax.plot(feed, value, color=colour, marker=marker, markersize=3.5, linewidth=1.2)
    snapped = path["snapped"].to_numpy(bool)
    if snapped.any():
        ax.plot(feed[snapped], value[snapped], **SNAP)
    ax.plot(feed[-1:], value[-1:], **(ARRIVED if _has_arrived(point, path) else STUCK))


def _handles(point: Equilibrium, path: pd.DataFrame) -> list[Artist]:
    colour, marker = LOOKS[point.operation]
    name, snaps = KINDS[point.operation].label, int(path["snapped"].sum())
    handles: list[Artist] = [
        Line2D([], [], color=colour, marker=marker, markersize=4.5, label=f"{name}, at rest after each feed")
    ]
    if snaps:
        handles.append(Line2D([], [], **SNAP, label=f"after a snap ({snaps})"))
    weight = _weight_on_bit(point)
    if _has_arrived(point, path):
        handles.append(Line2D([], [], **ARRIVED, label="weight on bit reached" if weight else "the bit follows"))
    else:
        locked = point.status == SteadyStatus.LOCKED_UP
        handles.append(Line2D([], [], **STUCK, label="locked up" if locked else "no balance beyond"))
    if point.answered:
        handles.append(Line2D([], [], **ROW, label="sliding on: the row's hook load"))
    if weight:
        handles.append(Line2D([], [], **WANTED, label="weight on bit of the case"))
        if _touches_bottom(path) > 0:
            handles.append(Line2D([], [], **ON_BOTTOM, label="bit on bottom"))
    else:
        handles.append(Line2D([], [], **WANTED, label="as far as the block"))
    if _is_near_spent(point, path):
        handles.append(Line2D([], [], **SPENT, label="−block weight: slack-off is spent"))
    return handles


def _weight_on_bit(point: Equilibrium) -> float:
    """Weight on bit of the operation [N]."""
    return max(bit_loads(point.case, point.operation).weight, 0.0)


def _touches_bottom(path: pd.DataFrame) -> float:
    """Feed [m] with which the bit stands on bottom, before it has any weight."""
    pressed = path["weight_on_bit_N"].to_numpy(float) > 0
    last = int(np.argmax(pressed)) - 1 if pressed.any() else len(path) - 1
    return float(path["feed_m"].iloc[last])


def _has_arrived(point: Equilibrium, path: pd.DataFrame) -> bool:
    """Whether the weight on bit is reached, or off bottom the bit follows the block."""
    if weight := _weight_on_bit(point):
        return bool(path["weight_on_bit_N"].iloc[-1] >= (1 - REACHED) * weight)
    if len(path) == 1:
        return True  # it began sliding
    fed, moved = (float(path[name].diff().iloc[-1]) for name in ("feed_m", "bit_moved_m"))
    return moved > FOLLOWING * fed


def _is_near_spent(point: Equilibrium, path: pd.DataFrame) -> bool:
    """Whether the hook load comes near the one at which slack-off is spent."""
    load = path["hookload_N"].to_numpy(float)
    load = np.append(load, point.hookload) if point.answered else load
    return bool(load.min() + point.case.rig.push < NEAR * float(np.ptp(load)))


def _span(values: pd.Series[float]) -> float:
    """From 0 to the end, not 0 itself."""
    last = float(values.iloc[-1])
    return last if last > 0 else 1.0


def _words(status: str) -> str:
    return status.replace("_", " ")
