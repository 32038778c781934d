"""The picture of a comparison of contact methods: cost against error, and where along the string methods part."""

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fctd.arena.result import Comparison, Row
from fctd.plots.labels import width_of
from fctd.plots.palette import CASES, QUIET
from fctd.plots.style import LINE_STYLES, POINTS, RC, Sheet
from fctd.results.unit_systems import shown

PANEL, RIGHT = 4.0, 3.15  # height of the panels, width of the second [in]
LEFT, SIDE, BETWEEN = 0.75, 3.2, 1.0  # before the first panel, its width, between its names and the second [in]
SMALL = 7.5  # size of the names [pt]
EXACT: Final = 1e-9  # [m]: what is off by less is exact but for rounding, and stands this far below all others
BELOW: Final = 30.0
LINEAR: Final = 10.0  # [N]: differences of forces below it have a linear scale
STEP = 0.06  # between two names, of the height of the panel
MARKERS: Final = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "p", "h", "*")


def methods_figure(comparison: Comparison) -> Figure:
    """Largest error of a method's wall over the time of a point, with quartiles, and contact forces along the string.

    Methods that break the contract, and runs that are invalid, are grey.
    """
    timed = [row for row in comparison.rows if row.cost is not None and row.errors is not None]
    run = [row for row in comparison.rows if row.loads is not None and (row.loads.force_off_N or 0) > 0]
    looks = {row.label: k for k, row in enumerate(comparison.rows)}
    window = comparison.window
    lines = [f"errors by {comparison.reference}"]
    if window is not None:
        lines.append(
            f"{window.operation}, bit at {window.to_md_m:.0f} m, {window.duration_s:.3g} s: {window.whole} "
            f"{window.vibration} periods"
        )
    with mpl.rc_context(RC):
        handles = [
            Line2D(
                [], [], color=_colour(row, looks[row.label]), linestyle=_dash(row, looks[row.label]), label=row.label
            )
            for row in run
        ]
        names = max((width_of(_name(row), SMALL) for row in timed), default=0.0) / POINTS
        begin = LEFT + SIDE + names + BETWEEN
        sheet = Sheet(begin + RIGHT + 0.2, PANEL + 0.7, f"{comparison.case}: contact methods", lines, handles)
        left = sheet.axes(LEFT, 0.3, SIDE, PANEL - 0.1)
        _cost_against_error(left, timed, looks)
        right = sheet.axes(begin, 0.3, RIGHT, PANEL - 0.1)
        _along(right, comparison, run, looks)
    return sheet.figure


def _colour(row: Row, k: int) -> str:
    return QUIET if row.struck else CASES[k % len(CASES)]


def _dash(row: Row, k: int) -> Any:
    return LINE_STYLES[(k if row.struck else k // len(CASES)) % len(LINE_STYLES)]


def _exact(row: Row) -> bool:
    """Whether a method has no error but that of rounding."""
    return row.errors is not None and (row.errors.largest_penetration_m or 0.0) <= EXACT


def _name(row: Row) -> str:
    """Name of a method, and what is to be said of it."""
    said = {"exact": _exact(row) and not row.broken, "breaks the contract": bool(row.broken)}
    return ", ".join([row.label, *(words for words, so in said.items() if so)])


def _cost_against_error(axes: Axes, rows: Sequence[Row], looks: dict[str, int]) -> None:
    """A point for each method, with the quartiles of its time, and its name beside the panel."""
    axes.set(
        xscale="log", yscale="log", xlabel="processor time of a point, ns (bars: quartiles)",
        ylabel="largest error of penetration, mm", title="Cost against error",
    )  # fmt: skip
    off = [row.errors.largest_penetration_m or 0.0 for row in rows if row.errors is not None]
    floor = 1e3 * min((each for each in off if each > EXACT), default=BELOW * 1e-3) / BELOW
    places: list[tuple[float, float, Row]] = []
    for row in rows:
        if row.cost is None or row.errors is None:
            continue
        time = row.cost.point_ns
        error = max(1e3 * (row.errors.largest_penetration_m or 0.0), floor)
        spread = [[time.median - time.low], [time.high - time.median]]
        k = looks[row.label]
        axes.errorbar(
            time.median, error, xerr=spread, color=_colour(row, k), marker=MARKERS[k % len(MARKERS)], markersize=5,
            capsize=2,
        )  # fmt: skip
        places.append((time.median, error, row))
    if not places:
        axes.text(0.5, 0.5, "no costs of a point", transform=axes.transAxes, ha="center", color=QUIET)
        return
    axes.set_ylim(0.6 * floor, max(2 * max(error for _, error, _ in places), 20 * floor))
    to_share = axes.transScale + axes.transLimits
    wanted = sorted(
        ((float(to_share.transform((x, y))[1]), x, y, row) for x, y, row in places), key=lambda each: each[0]
    )
    heights = _apart([height for height, *_ in wanted])
    for height, (_, x, y, row) in zip(heights, wanted, strict=True):
        axes.annotate(
            _name(row), (x, y), xytext=(1.03, height), textcoords="axes fraction", va="center", fontsize=SMALL,
            color=_colour(row, looks[row.label]), annotation_clip=False, parse_math=False,
            arrowprops={
                "arrowstyle": "-", "color": QUIET, "linewidth": 0.4, "shrinkA": 0, "shrinkB": 3, "relpos": (0, 0.5),
            },
        )  # fmt: skip


def _apart(heights: Sequence[float]) -> list[float]:
    """Heights in order, moved so that two are STEP apart, or less where there are many of them.

    Those that are too close spread about their middle.
    """
    step = min(STEP, 1 / max(len(heights) - 1, 1))
    groups: list[list[float]] = []
    for height in heights:
        groups.append([height])
        while len(groups) > 1 and _lowest(groups[-1], step) - _lowest(groups[-2], step) < step * len(groups[-2]):
            last = groups.pop()
            groups[-1] += last
    return [_lowest(group, step) + step * k for group in groups for k in range(len(group))]


def _lowest(group: Sequence[float], step: float) -> float:
    """Where the first name of a group stands, so that all of them are within the panel."""
    span = step * (len(group) - 1)
    return min(max(sum(group) / len(group) - 0.5 * span, 0.0), 1.0 - span)


def _along(axes: Axes, comparison: Comparison, rows: Sequence[Row], looks: dict[str, int]) -> None:
    """Contact forces of each method less those of the engine's own wall, over measured depth."""
    force, metre = shown("contact_force_N", comparison.units), shown("md_m", comparison.units)
    axes.set(
        xlabel=f"contact force less that of the engine's own wall, {force.label}",
        ylabel=f"measured depth, {metre.label}", title="Where methods part",
    )  # fmt: skip
    own = next((row.loads for row in comparison.rows if row.loads is not None), None)
    if own is None or not rows:
        axes.text(0.5, 0.5, "no other loads", transform=axes.transAxes, ha="center", color=QUIET)
        return
    base, md = np.array(own.forces_N, dtype=float), np.array(comparison.md_m) * metre.factor
    for row in rows:
        forces = np.array([] if row.loads is None else row.loads.forces_N, dtype=float)
        if forces.shape == base.shape:
            k = looks[row.label]
            axes.plot((forces - base) * force.factor, md, color=_colour(row, k), linestyle=_dash(row, k), linewidth=1.0)
    axes.set_xscale("symlog", linthresh=LINEAR * force.factor, linscale=0.5)
    axes.invert_yaxis()
