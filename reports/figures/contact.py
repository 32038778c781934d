"""The hole and its wall: cylinders and their seams, stiffness of the rock, friction laws, and the energy ledger."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from reports.figures import Tables, figure, style


@figure(
    "overlap",
    name="drag",
    caption=(
        "A point pressed against the outer wall and dragged through a bend. Without overlap the seam between two "
        "cylinders leaves a gap on the outside of the bend in which no cylinder owns the point; the overlap closes "
        "the gap and blends one cylinder into the next."
    ),
    checks=("largest change of *",),
)
@style.panels(4.6, 2, 1, sharex=True)
def drag(tables: Tables, force: Axes, direction: Axes) -> None:
    """Contact force and direction over the distance dragged, with overlap and without."""
    table = tables["drag"]
    # The run without overlap is a thin line over the other; dashes would not show in its jumps.
    for index, overlap in enumerate(sorted(table["overlap"].unique(), reverse=True)):
        ordered = table[table["overlap"] == overlap].sort_values("s_m")
        look: dict[str, Any] = {
            "color": style.COLOURS[index],
            "linewidth": (3.2, 1.0)[index],
            "alpha": (0.55, 1.0)[index],
        }
        label = f"with an overlap of {overlap:g} m" if overlap else "without overlap"
        force.plot(ordered["s_m"], ordered["contact_force_N"] / 1e3, **look, label=label)
        touching = ordered["contact_force_N"] > 0
        direction.plot(ordered["s_m"], ordered["direction_deg"].where(touching), **look)
    force.set(ylabel="contact force, kN", ylim=(0, None))
    direction.set(xlabel="distance dragged, m", ylabel="direction of the force, °")
    style.legend_above(force)


@figure(
    "washed_out_hole",
    name="hole",
    caption=(
        "An S-shaped well with a washout, a ledge, rough hole, a key seat and an oval section: its smallest and "
        "largest radius, and the circle of equal area that drilling programs assume (top). Force with which the "
        "turning string is pressed onto the wall, in windows of 10 m (bottom)."
    ),
)
@style.panels(4.8, 2, 1, sharex=True)
def hole(tables: Tables, size: Axes, force: Axes) -> None:
    """Radii of the hole over depth, and side force by each method."""
    wall, found = tables["wall"], tables["windows"]
    size.fill_between(wall["md_m"], 1e3 * wall["least_m"], 1e3 * wall["largest_m"], color=style.SHADE, label="wall")
    size.plot(wall["md_m"], 1e3 * wall["equal_area_m"], **style.line(0), label="circle of equal area")
    size.set(ylabel="radius, mm")
    size.legend(loc="upper right")
    for index, method in enumerate(found.columns[1:]):
        force.step(found["from_md_m"], found[method] / 1e3, where="post", **style.line(index), label=method)
    force.set(xlabel="measured depth, m", ylabel="side force in 10 m, kN", ylim=(0, None))
    style.legend_above(force)


@figure(
    "cylinder_error",
    name="errors",
    caption=(
        "Error of the wall's position (left) and direction (right), against the exact arc, for points "
        "near the wall of a bend built from cylinders of one length. The wide grey line is the distance "
        "between chord and arc, which falls with the square of the length."
    ),
    checks=("*",),
)
@style.panels(3.6, 1, 2, sharex=True)
def errors(tables: Tables, penetration: Axes, angle: Axes) -> None:
    """Error of penetration, with its bound, and of direction against the length of a cylinder."""
    table = tables["errors"].sort_values("cylinder_length_m")
    length = table["cylinder_length_m"]
    penetration.plot(length, table["bound_mm"], color=style.QUIET, linewidth=3.5, alpha=0.6, label="bound ℓ²/8R")
    penetration.plot(length, table["max_penetration_error_mm"], **style.marked(0), label="largest")
    penetration.plot(length, table["rms_penetration_error_mm"], **style.marked(1), label="root mean square")
    penetration.set_ylabel("error of penetration, mm")
    penetration.legend(loc="upper left")
    angle.plot(length, table["max_angle_error_deg"], **style.marked(0))
    angle.set_ylabel("largest error of direction, °")
    for ax in (penetration, angle):
        ax.set(xscale="log", yscale="log", xlabel="cylinder length, m")
        style.plain_log_ticks(ax.xaxis, ax.yaxis)


FROM_M = 1900.0  # above this depth the start of the trip still rings
SHADES = ("#8fc1e0", style.COLOURS[1], "black")
EXPECTED: dict[str, Any] = {"color": style.COLOURS[0], "linestyle": style.DASHES[1], "linewidth": 1.7}


@figure(
    "cylinder_ringing",
    name="swing",
    caption=(
        "Well b tripping in at 0.5 m/s. Above: the hook load about its mean over 15 s, with the cylinders of the "
        "case, with collars of another length, and in arcs; dashed: the swing that the tilt of the cylinders causes "
        "in the undamped chain, without friction or a time step. Below: the first axial frequency of the string "
        "falls to the frequency at which all collars pass half a cylinder, 0.5 Hz."
    ),
)
@style.panels(5.6, 2, 1, sharex=True, height_ratios=(3, 2))
def swing(tables: Tables, load: Axes, tones: Axes) -> None:
    """Hook load about its mean with the expected swing (above); the frequencies of string and seams (below)."""
    histories, expected, runs = tables["swing"], tables["expected"], tables["runs"]
    histories = histories[histories["bit_depth_m"] > FROM_M]
    expected = expected[expected["bit_depth_m"] > FROM_M]
    # Hundreds of periods leave no room for dashes: the three lie one inside the other, the smallest on top.
    for order, (changed, rows) in enumerate(sorted(histories.groupby("changed"), key=_size, reverse=True)):
        load.plot(rows["bit_depth_m"], rows["swing_kN"], color=SHADES[order], linewidth=0.8, label=str(changed))
    for sign, label in ((1, "expected for the case's own"), (-1, None)):
        load.plot(expected["bit_depth_m"], sign * expected["swing_kN"], **EXPECTED, label=label)
    load.set_ylabel("hook load about its mean, kN")
    style.legend_above(load, columns=2)

    tones.plot(expected["bit_depth_m"], expected["first_frequency_Hz"], **style.line(0), label="first of the string")
    tones.axhline(0.5, color=style.QUIET, linewidth=1, linestyle=(0, (6, 2)), label="second of the seams")
    own = runs[runs["changed"] == "the case's own"]
    tones.plot(own["at_m"], own["frequency_Hz"], **style.dots(1), markersize=7, label="largest swing")
    tones.set(xlabel="bit depth, m", ylabel="frequency, Hz", xlim=(FROM_M, 2450))
    tones.legend(loc="upper right")


def _size(group: tuple[Any, pd.DataFrame]) -> float:
    return float(group[1]["swing_kN"].abs().max())


@figure(
    "rock_stiffness",
    name="stiffness",
    caption=(
        "The paper's well with walls of every stiffness. Left: largest change of hook load, torque and contact force "
        "over four operations and all depths, against 10¹⁰ N/m; dashed: 1 %. Right: penetration of the wall, and the "
        "longest stable step of the stepper. Shaded: the string leaves the hole somewhere, no solution."
    ),
    checks=("largest change of * 1e6 to 1e10 N/m", "softest wall*", "deepest penetration*"),
)
@style.panels(3.8, 1, 2, sharex=True)
def stiffness(tables: Tables, left: Axes, right: Axes) -> None:
    """Changes of loads (left), penetration and step (right), each over stiffness."""
    table = tables["summary"]
    answered = table[(table["without_answer"] == 0) & (table["loads_change_percent"] > 0)]
    for index, (column, label) in enumerate(
        (("loads_change_percent", "hook load and torque"), ("contact_force_change_percent", "contact force"))
    ):
        left.plot(
            answered["stiffness_N_per_m"],
            answered[column],
            **style.marked(index),
            label=label,
        )
    left.axhline(1.0, **style.BOUND)
    left.set(ylabel="largest change, %")
    right.plot(
        table["stiffness_N_per_m"], table["penetration_of_clearance"], **style.marked(0),
        label="penetration / clearance",
    )  # fmt: skip
    right.plot(
        table["stiffness_N_per_m"], table["step_ms"] / table["step_ms"].max(), **style.marked(1),
        label="step / longest step",
    )  # fmt: skip
    right.set(ylabel="ratio, –")
    none = table.loc[table["without_answer"] > 0, "stiffness_N_per_m"]
    for ax in (left, right):
        ax.set(xscale="log", yscale="log", xlabel="wall stiffness per point, N/m")
        if len(none):
            ax.axvspan(none.min(), none.max(), color=style.SHADE, linewidth=0, zorder=0)
        style.legend_above(ax, columns=1)


@figure(
    "energy_ledger",
    name="closure",
    caption=(
        "Residual of the energy ledger, as a share of the work done, against the time step. "
        "The grey lines fall with the first and the second power of the step."
    ),
    checks=("residual over work at*", "order of the largest residual*"),
)
@style.panels(4.0)
def closure(tables: Tables, ax: Axes) -> None:
    """Residual of the ledger against the step, with lines of first and second order."""
    table = tables["closure"]
    for index, (case, rows) in enumerate(table.groupby("case", sort=False)):
        ordered = rows.sort_values("step_s")
        residual = ordered["relative_residual"].abs()
        ax.plot(
            ordered["step_s"] * 1e3,
            residual,
            **style.marked(index),
            label=str(case),
        )
    ax.set(xscale="log", yscale="log", xlabel="time step, ms", ylabel="|residual| / work")
    style.plain_log_ticks(ax.xaxis)
    style.slopes(ax, table["step_s"].to_numpy(float) * 1e3, np.abs(table["relative_residual"].to_numpy(float)))
    style.legend_above(ax, columns=2)


PANELS = (("drag", "kN", "axial drag, kN"), ("torque", "kN_m", "torque, kN·m"))


@figure(
    "friction_laws",
    name="straight",
    caption=(
        "A pipe pulled out of 1000 m of straight hole at 60° while it turns at 60 rev/min, over the ratio of its "
        "axial to its tangential speed at the wall. Coulomb's law divides one force between drag and torque; the "
        "paper's law gives both in full."
    ),
    checks=("drag and torque in straight hole*", "friction of law paper*"),
)
@style.panels(3.6, 1, 2, sharex=True)
def straight(tables: Tables, *axes: Axes) -> None:
    """Solver as lines, closed forms as marks."""
    table = tables["straight"]
    for ax, (name, unit, label) in zip(axes, PANELS, strict=True):
        for law, index in style.LAWS.items():
            rows = table[table["law"] == law]
            if rows.empty:
                continue
            x = rows["axial_over_tangential"]
            ax.plot(x, rows[f"{name}_{unit}"], **style.line(index), label=f"law {law}")
            few = slice(None, None, max(len(rows) // 8, 1))
            ax.plot(
                x.iloc[few], rows[f"{name}_closed_form_{unit}"].iloc[few], **style.dots(index, filled=False),
                label=f"{law}, closed form",
            )  # fmt: skip
        ax.set(xscale="log", xlabel="axial over tangential speed, –", ylabel=label, ylim=(0, None))
    style.legend_outside(axes[0])
