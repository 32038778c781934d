"""A run in time: loads, rotation and depth over time, and the string against time as a coloured map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Literal

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from fctd.arrays import Array
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.plots.palette import DARK, LOOKS, PALETTE, QUIET, SHADE
from fctd.plots.style import RC, Sheet
from fctd.plots.tracks import side_force, side_force_unit
from fctd.results.tables import SimulationResult
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    import pandas as pd

MapOf = Literal["contact_force_N", "effective_tension_N"]

# Sizes [in]: of the panels, and of what stands beside and below them.
WIDTH, LEFT, RIGHT, BELOW, BETWEEN = 7.0, 1.05, 1.05, 0.5, 0.14
LOAD, MAP = 1.25, 2.6
DEPTHS, TIMES = 300, 800  # cells of the map, at most
LOADS: Final = (("hookload", "N", "hook load"), ("surface_torque", "N_m", "surface torque"))
# Axes span no less, so that a trace that is flat but for rounding looks flat: a share of the largest hook load, and
# weight [N], torque [N m], rotation [rev/min] and depth [m].
STEADY_SHARE, WEIGHT, TORQUE, SPIN, DEPTH = 0.02, 1e4, 1e3, 10.0, 1.0
ON_BIT: Final = ("weight_on_bit", "N", "weight on bit")
BLOCK: Final[dict[str, Any]] = {"color": QUIET, "linewidth": 1.0, "linestyle": (0, (4, 2))}
# A colour above which hardly a cell lies: a single peak would leave the rest of the map pale.
BRIGHTEST: Final = 99.5  # percentile


def run_figure(result: SimulationResult, units: System = "si", map_of: MapOf = "contact_force_N") -> Figure:
    """Hook load, torque, rotation of top and bit, and the depth of bit and block over time; the string over time.

    A run that drills has the weight on bit too.  Bands span the least and the largest value of a step between two
    records.  The map has the side force per length, or the effective tension, of the string at each record.  Raises
    ValueError for a result without records.
    """
    history = result.history
    if not len(history):
        raise ValueError("a result with records")
    time = history["time_s"].to_numpy(float)
    with mpl.rc_context(RC):
        handles: list[Artist] = [
            Patch(facecolor=SHADE, label="least and largest of all steps"),
            Line2D([], [], color=DARK, label="top"),
            Line2D([], [], color=PALETTE["vermilion"], linewidth=1.0, label="bit"),
        ]
        if "block_position_m" in history:
            handles.append(Line2D([], [], **BLOCK, label="block"))
        handles += [
            Line2D([], [], color=LOOKS[kind][0], linewidth=4, label=KINDS[kind].label)
            for kind in dict.fromkeys(history["operation"])
        ]
        tracks = [*LOADS] if "weight_on_bit_N" not in history else [LOADS[0], ON_BIT, *LOADS[1:]]
        curves = len(tracks) + 2
        height = curves * (LOAD + BETWEEN) + MAP + BELOW
        sheet = Sheet(
            LEFT + WIDTH + RIGHT, height, f"{result.case.name}: {result.status}", _lines(result, units), handles
        )
        panels: list[Axes] = []
        for k in range(curves + 1):
            tall = MAP if k == curves else LOAD
            shared = {"sharex": panels[0]} if panels else {}
            panels.append(sheet.axes(LEFT, 0.05 + k * (LOAD + BETWEEN), WIDTH, tall, **shared))
            panels[k].tick_params(labelbottom=k == curves)
        for ax, (stem, unit, name) in zip(panels, tracks, strict=False):
            _load(ax, time, history, stem, unit, units)
            ax.set_ylabel(f"{name}\n{shown(f'{stem}_{unit}', units).label}")
        _rotation(panels[-3], time, history)
        _depth(panels[-2], time, history, units)
        _map(sheet, panels[-1], result.segments, units, map_of)
        panels[-1].set_xlabel("time, s")
        start = float(result.operations["start_s"].iloc[0]) if len(result.operations) else 0.0
        panels[0].set_xlim(start, time[-1])
        for row in result.operations.to_dict("records"):
            colour, _ = LOOKS[row["operation"]]
            panels[0].axvspan(row["start_s"], row["end_s"], 0.97, 1.0, color=colour, linewidth=0)
        return sheet.figure


def _lines(result: SimulationResult, units: System) -> list[str]:
    """Lines of the heading: segments and step, then the notes."""
    run = result.run
    first = f"{counted(run['segments'], 'segment')}, step {1e3 * run['step_s']:.3g} ms"
    if np.isfinite(run["energy_error"]):
        first += f", energy error {run['energy_error']:.1e}"
    return [first, *(f"note {note.code}: {note.told(units)}" for note in result.notes)]


def _load(ax: Axes, time: Array, history: pd.DataFrame, stem: str, unit: str, units: System) -> None:
    """A load over time, with the band of its steps where the history has it."""
    factor = shown(f"{stem}_{unit}", units).factor
    mean = history[f"{stem}_{unit}"].to_numpy(float)
    if f"{stem}_min_{unit}" in history:
        low, high = (history[f"{stem}_{end}_{unit}"].to_numpy(float) for end in ("min", "max"))
        ax.fill_between(time, low * factor, high * factor, color=SHADE, linewidth=0)
    ax.plot(time, mean * factor, color=DARK, linewidth=1.1)
    least = {"hookload": STEADY_SHARE * float(np.abs(mean).max()), "surface_torque": TORQUE, "weight_on_bit": WEIGHT}
    _span_at_least(ax, least[stem] * factor)


def _span_at_least(ax: Axes, least: float) -> None:
    """Widen an axis that spans less around its middle."""
    low, high = ax.get_ylim()
    if high - low < least:
        middle = 0.5 * (low + high)
        ax.set_ylim(middle - 0.5 * least, middle + 0.5 * least)


def _rotation(ax: Axes, time: Array, history: pd.DataFrame) -> None:
    ax.plot(time, history["bit_rpm"], color=PALETTE["vermilion"], linewidth=1.0)
    ax.plot(time, history["top_rpm"], color=DARK, linewidth=1.1)
    ax.set_ylabel("rotation\nrev/min")
    _span_at_least(ax, SPIN)


def _depth(ax: Axes, time: Array, history: pd.DataFrame, units: System) -> None:
    """Depth of the bit, and where the history has it the position of the block on an axis of its own."""
    metre = shown("bit_depth_m", units)
    ax.plot(time, history["bit_depth_m"] * metre.factor, color=PALETTE["vermilion"], linewidth=1.1)
    ax.set_ylabel(f"bit depth\n{metre.label}")
    _span_at_least(ax, DEPTH * metre.factor)
    ax.invert_yaxis()
    if "block_position_m" in history.columns:
        block = ax.twinx()
        block.plot(time, history["block_position_m"] * metre.factor, **BLOCK)
        block.set_ylabel(f"block\n{metre.label}")
        block.grid(False)
        _span_at_least(block, DEPTH * metre.factor)


def _map(sheet: Sheet, ax: Axes, segments: pd.DataFrame, units: System, map_of: MapOf) -> None:
    """The string against time: each column of cells is a record."""
    records = [rows for _, rows in segments.groupby("time_s", sort=True)]
    records = records[:: max(-(-len(records) // TIMES), 1)]
    deepest = float(segments["md_m"].max())
    top = float(segments["md_m"].min())
    md = np.linspace(top, deepest, DEPTHS + 1)
    middle = 0.5 * (md[1:] + md[:-1])
    unit = side_force_unit(units, "length") if map_of == "contact_force_N" else shown(map_of, units)
    cells = np.full((DEPTHS, len(records)), np.nan)
    for k, rows in enumerate(records):
        at = rows["md_m"].to_numpy(float)
        value = side_force(rows, "length") if map_of == "contact_force_N" else rows[map_of].to_numpy(float)
        cells[:, k] = np.interp(middle, at, value * unit.factor, right=np.nan)
    ends = np.array([float(rows["time_s"].iloc[0]) for rows in records])
    edges = np.append(max(2 * ends[0] - ends[min(1, len(ends) - 1)], 0.0), ends)
    name = "side force per length" if map_of == "contact_force_N" else "effective tension"
    brightest = float(np.nanpercentile(cells, BRIGHTEST)) if map_of == "contact_force_N" else None
    colours = {"cmap": "magma_r", "vmin": 0.0, "vmax": brightest} if brightest else {"cmap": "viridis"}
    metre = shown("md_m", units)
    mesh = ax.pcolormesh(edges, md * metre.factor, cells, shading="flat", rasterized=True, **colours)
    ax.set_ylim(deepest * metre.factor, top * metre.factor)
    ax.set_ylabel(f"measured depth, {metre.label}")
    ax.grid(False)
    box = ax.get_position()
    place = sheet.figure.add_axes((box.x1 + 0.12 / sheet.width, box.y0, 0.14 / sheet.width, box.height))
    sheet.figure.colorbar(mesh, cax=place).set_label(f"{name}, {unit.label}")
