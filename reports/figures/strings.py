"""Steady strings against beams, finite elements and soft strings."""

import itertools
from typing import Any

import matplotlib.lines
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from pandas import DataFrame

from reports import words
from reports.figures import Canvas, Tables, figure, style


@figure(
    "beam_in_hole",
    name="errors",
    caption=(
        "Short beams against beam theory: the difference falls with the square of the segment length until effects "
        "that beam theory neglects remain (shear, the elastic wall). The dashed line is 1 %."
    ),
    checks=("*, difference",),
)
@style.panels(3.8)
def errors(tables: Tables, ax: Axes) -> None:
    """Difference from beam theory against segment length, a line for each beam."""
    table = tables["beams"]
    for index, beam in enumerate(table["beam"].unique()):
        of_beam = table[table["beam"] == beam].sort_values("segment_m")
        ax.plot(of_beam["segment_m"], of_beam["off_percent"].abs(), **style.marked(index), label=beam)
    ax.axhline(1.0, **style.BOUND)
    ax.set(xscale="log", yscale="log", xlabel="segment length, m", ylabel="difference from beam theory, %")
    style.plain_log_ticks(ax.xaxis)
    style.legend_outside(ax)


@figure(
    "curved_chain",
    name="differences",
    caption=(
        "Stiff string against soft string: the difference in hook load and in surface torque for each "
        "operation, wellbore geometry and friction law. A dot on the line at zero agrees with the soft "
        "string. Where the soft string has no torque there is no dot."
    ),
)
def differences(tables: Tables) -> Canvas:
    """A dot for each run: its difference from the soft string in hook load and in torque."""
    numbers = tables["numbers"]
    laws = list(numbers["law"].unique())
    geometries = list(numbers["geometry"].unique())
    operations = list(numbers["operation"].unique())
    rows = list(itertools.product(operations, geometries))

    canvas, axes = style.subplots(1.5 + 0.36 * len(rows), 1, 2, sharey=True)
    for ax, column, label in zip(
        axes,
        ("hookload_difference_percent", "torque_difference_percent"),
        ("difference in hook load, %", "difference in torque, %"),
        strict=True,
    ):
        for height, (operation, geometry) in enumerate(rows):
            for index, law in enumerate(laws):
                chosen = numbers[
                    (numbers["operation"] == operation) & (numbers["geometry"] == geometry) & (numbers["law"] == law)
                ]
                # Laws differ by marker and slightly by height, since they often agree.
                shift = 0.16 * (index - (len(laws) - 1) / 2)
                ax.plot(
                    chosen[column],
                    np.full(len(chosen), height + shift),
                    **style.dots(style.LAWS[law]),
                    markersize=6,
                )
        ax.axvline(0, **style.ZERO)
        for edge in range(len(geometries), len(rows), len(geometries)):
            ax.axhline(edge - 0.5, color=style.QUIET, linewidth=0.5)
        ax.set_xlabel(label)
        ax.margins(x=0.12)
    style.rows_downwards(axes[0], [f"{words.name(operation)}, {geometry}" for operation, geometry in rows])
    handles = [
        matplotlib.lines.Line2D([], [], **style.dots(style.LAWS[law]), markersize=6, label=f"law {law}") for law in laws
    ]
    canvas.legend(handles=handles, loc="outside upper left", ncols=len(laws))
    return canvas


@figure(
    "curved_chain",
    name="contact",
    caption=(
        "Contact force (left) and the side of the hole that the chain touches (right) along the chain. 0° is "
        "the high side, 90° is to the right looking downhole; end points without contact have no angle."
    ),
)
def contact(tables: Tables) -> Canvas:
    """Contact force and angle along the chain: rows are operations."""
    profiles = tables["profiles"]
    operations = list(profiles["operation"].unique())
    canvas, grid = style.subplots(
        0.9 + 1.9 * len(operations), len(operations), 2, sharex=True, sharey="col", squeeze=False
    )
    for (force, angle), operation in zip(grid, operations, strict=True):
        at = profiles[profiles["operation"] == operation]
        for law in sorted(at["law"].unique(), key=style.LAWS.__getitem__):
            index, profile = style.LAWS[law], at[at["law"] == law]
            force.plot(profile["md_m"], profile["contact_force_N"] / 1e3, **style.line(index), label=f"law {law}")
            touching = profile[profile["contact_force_N"] > 0]
            turned = style.unrolled(touching["contact_angle_deg"])
            angle.plot(touching["md_m"], turned, **style.dots(index, filled=index == 0), markersize=3)
        force.set(title=words.name(operation), ylabel="contact force, kN")
        angle.set_yticks(style.SIDES, [label.replace("\n", " ") for label in style.SIDE_LABELS])
        angle.set(ylabel="contact angle", ylim=(-90, 270))
    touched = profiles[profiles["contact_force_N"] > 0]
    grid[0][0].set_ylim(0, 1.05 * touched["contact_force_N"].max() / 1e3)
    for ax in grid[-1]:
        # Nothing touches above the first contact.
        ax.set(xlabel="measured depth, m", xlim=(touched["md_m"].min() - 50, profiles["md_m"].max() + 20))
    style.legend_outside(grid[0][0], columns=3)
    return canvas


TRUTH = "finite elements"
SIDES = {
    "guide_low_N": "low side of the guide",
    "bend_high_N": "high side of the bend",
    "bit_low_N": "low side at the bit",
}


@figure(
    "scaled_section",
    name="force",
    caption=(
        "Paper's Fig. 9, with numbers: contact force while the string is lowered, total and on each side, from "
        "finite elements and from rigid segments."
    ),
    checks=("correlation of force*", "force at * segments against finite elements", "contacts at the end*"),
)
def force(tables: Tables) -> Canvas:
    """Fig. 9: contact force against time, total and on each side."""
    table = tables["force"]
    canvas, grid = style.subplots(6.4, 2, 2, sharex=True)
    panels = {"total_N": "total", **SIDES}
    for ax, (column, title) in zip(grid.flat, panels.items(), strict=True):
        for index, model in enumerate(_models(tables)):
            rows = table[table["model"] == model]
            ax.plot(rows["time_s"], rows[column] / 1e3, **_look(index), label=model)
        ax.set(title=title, ylim=(0, None))
    for ax in grid[-1]:
        ax.set_xlabel("time, s")
    for ax in grid[:, 0]:
        ax.set_ylabel("contact force, kN")
    style.legend_outside(grid[0][0], columns=3)
    return canvas


@figure(
    "scaled_section",
    name="displacement",
    caption=(
        "Paper's Fig. 10: horizontal displacement along the string at the end of the run, and below it the "
        "distance from the axis of the hole. Grey lines are the walls; joints of the coarser string are squares."
    ),
    checks=("displacement at * segments*", "contact positions*"),
)
@style.panels(5.6, 2, 1, sharex=True, height_ratios=(2, 3))
def displacement(tables: Tables, whole: Axes, offset: Axes) -> None:
    """Fig. 10: horizontal displacement along the string, and the offset from the axis between the walls."""
    table = tables["string"]
    clearance = 1e3 * float(table["clearance_m"].iloc[0])
    for index, model in enumerate(_models(tables)):
        rows = table[(table["model"] == model) & (table["md_m"] > _shown(tables))]
        whole.plot(rows["md_m"], rows["horizontal_m"], **_look(index), label=model)
        few = index == 1
        marker: dict[str, Any] = {"marker": "s", "markersize": 3.5, "markerfacecolor": "white"} if few else {}
        offset.plot(rows["md_m"], 1e3 * rows["offset_high_m"], **_look(index) | marker)
    for side, name, at, up in ((clearance, "high side", 0.15, "bottom"), (-clearance, "low side", 0.5, "top")):
        offset.axhline(side, **style.ZERO)
        offset.annotate(
            name, (at, side), xycoords=("axes fraction", "data"), ha="center", va=up, color=style.QUIET, fontsize=9
        )
    whole.set_ylabel("horizontal displacement, m")
    offset.set(xlabel="measured depth, m", ylabel="offset from the axis, mm", ylim=(-1.4 * clearance, 1.4 * clearance))
    style.legend_above(whole, columns=3)


@figure(
    "scaled_section",
    name="convergence",
    caption=(
        "Difference from the finite elements over the number of segments, at equal wall stiffness per metre. Dashed "
        "lines are the targets, 3 % and 1 %. Of two marks at one number, the lower has shorter segments in the "
        "last metre."
    ),
    checks=("force at * segments against finite elements", "displacement at * segments*"),
)
@style.panels(3.6, 1, 2)
def convergence(tables: Tables, left: Axes, right: Axes) -> None:
    """Differences from the finite elements against the number of segments."""
    table = tables["segments"]
    own = table[table["geometry"] == table["geometry"].iloc[0]].sort_values("segments")
    left.plot(own["segments"], own["total_rms_percent"], **style.marked(0), label="RMS of total force")
    left.axhline(3.0, **style.BOUND)
    left.set_ylabel("force difference, % of the peak")
    for index, (column, label) in enumerate(
        (
            ("displacement_max_percent", "largest"),
            ("displacement_above_end_percent", "largest above the end"),
            ("displacement_rms_percent", "RMS"),
        )
    ):
        right.plot(own["segments"], own[column], **style.marked(index), label=label)
    right.axhline(1.0, **style.BOUND)
    right.set_ylabel("displacement, % of the clearance")
    for ax in (left, right):
        ax.set(xscale="log", yscale="log", xlabel="number of segments, –")
        style.plain_log_ticks(ax.xaxis, ax.yaxis)
        ax.set_xticks(own["segments"].unique(), [str(count) for count in own["segments"].unique()])
    style.legend_above(left)
    style.legend_above(right)


def _models(tables: Tables) -> list[str]:
    """The finite elements, the paper's number of segments, and the most segments."""
    return [str(model) for model in tables["force"]["model"].unique()]


def _shown(tables: Tables) -> float:
    """Measured depth from which the engine's string is cut into segments [m]."""
    string = tables["string"]
    return float(string[string["model"] != TRUTH].groupby("model")["md_m"].min().max()) - 1.0


def _look(index: int) -> dict[str, Any]:
    """The finite elements are a broad pale line under the others."""
    if index == 0:
        return {"color": style.COLOURS[3], "linewidth": 4.0}
    return style.line((1, 2)[index - 1])


ALLOWED = 0.2  # percent


@figure(
    "soft_limit",
    name="ladder",
    caption=(
        "Largest difference between the stiff string and the closed forms of the soft string, over five wells and "
        "two laws, as clearance and then bending stiffness are removed."
    ),
)
@style.panels(3.4, 1, 2, sharey=True)
def ladder(tables: Tables, *axes: Axes) -> None:
    """Largest difference at each rung, a line for each operation."""
    table = tables["ladder"]
    rungs = list(table["string"].unique())
    for ax, column, label in zip(
        axes,
        ("hookload_off_percent", "torque_off_percent"),
        ("difference in hook load, %", "difference in torque, %"),
        strict=True,
    ):
        for index, operation in enumerate(table["operation"].unique()):
            of_kind = table[table["operation"] == operation].set_index("string")[column]
            heights = [rungs.index(rung) for rung in of_kind.index]
            ax.plot(of_kind, heights, **style.dots(index), markersize=7, label=operation)
        ax.axvline(ALLOWED, **style.BOUND, label="bound of the last rung")
        ax.set(xscale="log", xlabel=label)
        style.plain_log_ticks(ax.xaxis)
    style.rows_downwards(axes[0], rungs)
    style.legend_outside(axes[0], columns=4)


LIMIT = 30.0  # [deg/100 ft], the paper's
LARGEST = 40.0  # percent: the darkest cell
WHITE_FROM = 20.0  # percent: cells so dark that their numbers are white


@figure(
    "soft_stiff_map",
    name="contact_force",
    caption=(
        "Total contact force of the stiff string over the soft string's, in percent, for a 60° build over severity "
        "and clearance; below, strings with little weight below the bend. Darker cells have larger differences; "
        "right of the dashed line the paper advises against the soft string."
    ),
    checks=("contact force a stiffer*", "change of the map*", "hook load and contact force of bends*"),
)
def contact_force(tables: Tables) -> Canvas:
    """Difference of contact force: a map for each operation and string, numbers in the cells."""
    table, light = tables["map"], tables["light"]
    strings = {string: table[table["string"] == string] for string in table["string"].unique()}
    strings |= {f"{string}, little weight": light[light["string"] == string] for string in light["string"].unique()}
    operations = list(table["operation"].unique())
    canvas, grid = style.subplots(
        0.6 + 2.2 * len(strings), len(strings), len(operations), sharex=True, sharey=True, squeeze=False
    )
    for row, (string, rows) in zip(grid, strings.items(), strict=True):
        for ax, operation in zip(row, operations, strict=True):
            _map(ax, rows[rows["operation"] == operation])
            ax.set_title(words.name(operation), fontsize=8.5)
        row[0].set_ylabel(f"{string}\nclearance, mm")
    for ax in grid[-1]:
        ax.set_xlabel("severity, °/100 ft")
    return canvas


def _map(ax: Axes, rows: DataFrame) -> None:
    values = rows.pivot_table(index="clearance_mm", columns="severity_deg_per_100ft", values="contact_force_percent")
    cells = values.to_numpy()
    ax.imshow(np.abs(cells), cmap="Greys", norm=Normalize(0, LARGEST), aspect="auto", origin="lower")
    for (i, k), value in np.ndenumerate(cells):
        ink = "white" if abs(value) > WHITE_FROM else "black"
        text = f"{value:z.0f}".replace("-", words.MINUS)
        ax.text(k, i, text, ha="center", va="center", color=ink, fontsize=8.5)
    ax.set_xticks(range(len(values.columns)), [f"{severity:g}" for severity in values.columns])
    ax.set_yticks(range(len(values.index)), [f"{clearance:g}" for clearance in values.index])
    ax.grid(visible=False)
    at = int(np.argmin(np.abs(values.columns.to_numpy(float) - LIMIT))) - 0.5
    ax.axvline(at, **style.line(1))
