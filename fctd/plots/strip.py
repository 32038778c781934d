"""The strip beside a chart: lanes that say over depth how strings are buckled, and their status."""

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from fctd.plots.description import Lane
from fctd.plots.palette import BUCKLED, DARK
from fctd.plots.style import LOST
from fctd.results.status import SteadyStatus

LANE = 0.21  # width of a lane [in]
# Hatches by status; a row that no push moves is black, one without an answer empty with a cross.
HATCHES: dict[str, str] = {
    "converged": "", "locked_up": "/////", "rolling": "ooo", "under_resolved": ".....", "unstable": "xxxxx",
}  # fmt: skip
STUCK = "#000000"
NAMES = {
    "locked_up": "slack-off is spent (locked up)",
    "rolling": "rolls round the hole",
    "under_resolved": "under-resolved: segments too long",
    "unstable": "unstable",
}
# Of rows without loads; the others are those that the solver did not find.
LOST_NAMES = {"not_possible": "string and hole do not fit at this depth", "unstable": "no steady shape"}


def draw_strip(ax: Axes, lanes: Sequence[Lane]) -> None:
    """Draw lanes down the axes, by their numbers."""
    for lane in lanes:
        at = lane.depth
        edges = np.concatenate((at[:1], 0.5 * (at[1:] + at[:-1]), at[-1:]))
        row = 0
        for (mode, status, loaded), run in groupby(zip(lane.modes, lane.status, lane.loaded, strict=True)):
            first, row = row, row + len(list(run))
            top, height = edges[first], edges[row] - edges[first]
            ax.bar(lane.number, height, 0.78, top, **_look(str(mode), str(status), loaded), edgecolor=DARK,
                   linewidth=0.6)  # fmt: skip
            if not loaded and status != SteadyStatus.LOCKED_UP:
                crosses: dict[str, Any] = LOST | {"markersize": 5, "markeredgewidth": 1.4}
                ax.plot(np.full(row - first, lane.number), at[first:row], **crosses)
    ax.set_xlim(0.5, len(lanes) + 0.5)
    ax.set_xticks(range(1, len(lanes) + 1))
    ax.tick_params(axis="x", length=0, labelsize=8)
    ax.tick_params(axis="y", left=False, labelleft=False)
    ax.grid(False)
    for spine in ax.spines.values():
        spine.set_visible(False)
    ax.set_xlabel("state", labelpad=3)


def state_handles(lanes: Sequence[Lane]) -> list[Artist]:
    """Entries of the legend for the states that occur."""
    modes = {str(mode) for lane in lanes for mode in lane.modes}
    loaded = {str(status) for lane in lanes for status in lane.status[lane.loaded]}
    lost = {str(status) for lane in lanes for status in lane.status[~lane.loaded]}
    handles: list[Artist] = [
        Patch(facecolor=grey, edgecolor=DARK, linewidth=0.6, label=f"{mode} buckling")
        for mode, grey in BUCKLED.items()
        if mode in modes
    ]
    handles += [
        Patch(**_look("none", status, loaded=True), edgecolor=DARK, linewidth=0.6, label=name)
        for status, name in NAMES.items()
        if status in loaded
    ]
    if SteadyStatus.LOCKED_UP in lost:
        handles.append(Patch(facecolor=STUCK, label="no push suffices (locked up)"))
    reasons = {LOST_NAMES.get(status, "no equilibrium found") for status in lost - {str(SteadyStatus.LOCKED_UP)}}
    if reasons:
        handles.append(Line2D([], [], **LOST, label=f"no loads: {', '.join(sorted(reasons))}"))
    return handles


def _look(mode: str, status: str, loaded: bool) -> dict[str, Any]:
    if not loaded:
        return {"facecolor": STUCK if status == SteadyStatus.LOCKED_UP else "white"}
    return {"facecolor": BUCKLED.get(mode, "white"), "hatch": HATCHES[status]}
