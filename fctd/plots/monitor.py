"""Monitored friction over depth: measured stretches between curves of constant factors, apparent factors, alarms."""

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fctd.case.load import Case
from fctd.case.systems import told
from fctd.monitoring.alarm import KINDS, Alarm, kind_of
from fctd.monitoring.chart import FACTORS
from fctd.monitoring.monitor import Monitored
from fctd.monitoring.stretches import Mode
from fctd.plots.palette import DARK, LOOKS, PALETTE, QUIET
from fctd.plots.style import RC, Sheet
from fctd.results.unit_systems import System, shown

# Sizes [in].
WIDTHS, HEIGHT, LEFT, BETWEEN, BELOW = (3.1, 2.6, 3.1), 5.2, 0.75, 0.25, 0.56
BESIDE: Final = 0.1  # of the factor, between curves
MOST_DEPTHS: Final = 80  # of a curve
LOOKS_OF: Final = {"rotation": LOOKS["rotate_off_bottom"], "pick_up": LOOKS["trip_out"], "slack_off": LOOKS["trip_in"]}
NAMES: Final = {"rotation": "rotating off bottom", "pick_up": "pick-up", "slack_off": "slack-off"}
MODE_OF: Final[dict[str, Mode]] = {"rotation": "rotating", "pick_up": "pick_up", "slack_off": "slack_off"}
CURVES: Final[tuple[Any, ...]] = ((0, (1, 1.3)), "-", (0, (5, 2)))
# Of the baselines, which are told apart without colour too.
BASELINES: Final[dict[str, Any]] = {"rotation": "-", "pick_up": (0, (7, 2, 1.5, 2)), "slack_off": (0, (3, 1.5))}
SHOE: Final[dict[str, Any]] = {"color": QUIET, "linewidth": 0.9, "linestyle": (0, (1, 2)), "zorder": 1.1}


def monitor_figure(found: Monitored, case: Case, units: System = "si") -> Figure:
    """Weight indicator, torque and apparent friction factor over bit depth, with the alarms.

    Bars are quartiles of the rows of a stretch in the first two panels, brought to mud at rest, and 95 % bands in the
    third, where a line is
    the baseline of each kind.  Curves are those of the steady string at the median of the factors and 0.1 beside it.
    """
    stretches = found.stretches
    known = _at_rest(found, stretches[stretches["friction"].notna()])
    kinds = known["mode"].map(kind_of) if len(known) else pd.Series(dtype=str)
    middle = round(float(np.clip(known["friction"].median(), BESIDE, FACTORS[-1] - BESIDE)), 2) if len(known) else 0.3
    factors = [round(middle + k * BESIDE, 2) for k in (-1, 0, 1)]
    depth = shown("bit_depth_m", units)
    with mpl.rc_context(RC):
        lines = [f"friction factor of {found.chart.fit} hole; {len(known)} of {len(stretches)} stretches have one"]
        if any(map(found.chart.relieves, known["flow_m3_s"])):
            lines.append("readings with the pumps on are drawn as with mud at rest, which the curves have")
        lines += [f"alarm: {told(alarm.sentence, units)}" for alarm in found.alarms]
        handles = _handles(kinds, factors, found.alarms)
        width = LEFT + sum(WIDTHS) + BETWEEN * 2 + 0.3
        sheet = Sheet(width, HEIGHT + BELOW, f"{case.name}: monitored friction", lines, handles)
        left = LEFT
        panels: list[Axes] = []
        for k, size in enumerate(WIDTHS):
            ax = sheet.axes(left, 0.06, size, HEIGHT, **({"sharey": panels[0]} if panels else {}))
            ax.tick_params(labelleft=k == 0)
            panels.append(ax)
            left += size + BETWEEN
        columns = ("weight_indicator_N", "drive_torque_N_m")
        for ax, column in zip(panels[:2], columns, strict=True):
            for kind in KINDS:
                if (column == columns[0]) == (kind != "rotation"):
                    rows = known[kinds == kind]
                    _readings(ax, rows, kind, column, units)
                    _curves(ax, found, rows, kind, column, factors, units)
            ax.set_xlabel(
                f"{'weight indicator' if column == columns[0] else 'drive torque'}, {shown(column, units).label}"
            )
        for kind in KINDS:
            _factors(panels[2], known[kinds == kind], kind, depth.factor)
        panels[2].set_xlabel("apparent friction factor")
        panels[0].set_ylabel(f"bit depth, {depth.label}")
        _depths(panels, known, found.alarms, case, depth.factor)
        return sheet.figure


def _at_rest(found: Monitored, known: pd.DataFrame) -> pd.DataFrame:
    """Stretches with their readings as in the mud at rest of the curves."""
    known = known.copy()
    for end in ("", "_p25", "_p75"):
        gauge, torque = f"weight_indicator{end}_N", f"drive_torque{end}_N_m"
        pairs = [
            found.chart.at_rest(
                row["mode"], row["bit_depth_m"], row["flow_m3_s"], row["rpm"], gauge=row[gauge], torque=row[torque]
            )
            for row in known.to_dict("records")
        ]
        known[[gauge, torque]] = np.array(pairs, float).reshape(len(pairs), 2)
    return known


def _readings(ax: Axes, rows: pd.DataFrame, kind: str, column: str, units: System) -> None:
    factor, metre = shown(column, units).factor, shown("bit_depth_m", units).factor
    stem, _, unit = column.partition("_N")
    middle, low, high = (rows[f"{stem}{end}_N{unit}"] * factor for end in ("", "_p25", "_p75"))
    colour, marker = LOOKS_OF[kind]
    ax.errorbar(
        middle, rows["bit_depth_m"] * metre, xerr=(middle - low, high - middle), fmt=marker, color=colour,
        markersize=4, elinewidth=0.8, zorder=3,
    )  # fmt: skip


def _curves(
    ax: Axes, found: Monitored, rows: pd.DataFrame, kind: str, column: str, factors: Sequence[float], units: System
) -> None:
    """The steady string at some factors, at the depths of the stretches."""
    depths = np.unique(rows["bit_depth_m"].to_numpy(float))
    if len(depths) < 2:
        return
    depths = depths[np.unique(np.linspace(0, len(depths) - 1, MOST_DEPTHS).astype(int))]
    rpm, factor = float(rows["rpm"].median()), shown(column, units).factor
    for friction, style in zip(factors, CURVES, strict=True):
        loads = [found.chart.curve(MODE_OF[kind], float(depth), friction, rpm) for depth in depths]
        ax.plot(np.array(loads) * factor, depths * shown("bit_depth_m", units).factor, color=LOOKS_OF[kind][0],
                linestyle=style, linewidth=0.9, zorder=2)  # fmt: skip


def _factors(ax: Axes, rows: pd.DataFrame, kind: str, metre: float) -> None:
    colour, marker = LOOKS_OF[kind]
    at = rows["bit_depth_m"].to_numpy(float) * metre
    middle = rows["friction"].to_numpy(float)
    bars = (middle - rows["friction_low"].to_numpy(float), rows["friction_high"].to_numpy(float) - middle)
    ax.errorbar(middle, at, xerr=bars, fmt=marker, color=colour, markersize=4, elinewidth=0.7, alpha=0.9, zorder=3)
    ax.plot(rows["friction_baseline"], at, color=colour, linestyle=BASELINES[kind], linewidth=1.4, zorder=3.2)


def _depths(panels: Sequence[Axes], known: pd.DataFrame, alarms: Sequence[Alarm], case: Case, metre: float) -> None:
    """Limits of the axis of depths, casing shoes and alarms."""
    if len(known):
        top, bottom = float(known["bit_depth_m"].min()) * metre, float(known["bit_depth_m"].max()) * metre
        air = 0.04 * max(bottom - top, 1.0)
        panels[0].set_ylim(bottom + air, top - air)
        shoes = [shoe * metre for shoe in case.shoes if top <= shoe * metre <= bottom]
        for ax in panels:
            for shoe in shoes:
                ax.axhline(shoe, **SHOE)
        # A few factors that are hardly known would leave the others no room.
        low, high = (float(known["friction"].quantile(q)) for q in (0.02, 0.98))
        panels[2].set_xlim(min(low, 0.0) - 0.15, high + 0.15)
    for alarm in alarms:
        panels[2].axhspan(alarm.start * metre, alarm.found * metre, color=PALETTE["purple"], alpha=0.18, zorder=1)
        panels[2].axhline(alarm.found * metre, color=PALETTE["purple"], linewidth=1.2, zorder=1.2)


def _handles(kinds: "pd.Series[str]", factors: Sequence[float], alarms: Sequence[Alarm]) -> list[Artist]:
    handles: list[Artist] = [
        Line2D(
            [],
            [],
            color=LOOKS_OF[kind][0],
            marker=LOOKS_OF[kind][1],
            linestyle=BASELINES[kind],
            label=f"{NAMES[kind]}, baseline",
        )
        for kind in KINDS
        if (kinds == kind).any()
    ]
    handles += [
        Line2D([], [], color=DARK, linestyle=style, linewidth=0.9, label=f"steady string, μ {factor:g}")
        for factor, style in zip(factors, CURVES, strict=True)
    ]
    if alarms:
        label = "alarm, from its start"
        handles.append(Line2D([], [], color=PALETTE["purple"], linewidth=4, alpha=0.6, label=label))
    return handles
