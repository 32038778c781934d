"""Buckled pipe, and how the plausible rows of every class of string end."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from reports.figures import Canvas, Tables, figure, style

SHAPES = ("snaking", "helix")
SHOWN = 100.0  # [m]


@figure(
    "post_buckling",
    name="shapes",
    caption="The middle of a buckled 5 in pipe in a level 8½ in hole, unrolled and in space (drawn wider than it is).",
    checks=("amplitude of snaking at 1.4 *", "helix, pitch"),
)
def shapes(tables: Tables) -> Canvas:
    """Angle over the length of hole on the left, the pipe's axis in space on the right, a row for each shape."""
    table = tables["shapes"]
    canvas = style.figure(5.2)
    grid = canvas.add_gridspec(2, 2, width_ratios=(1.0, 1.1))
    for row, name in enumerate(SHAPES):
        part = table[(table["shape"] == name) & (table["md_m"] <= SHOWN)]
        md, aside, up = (part[column].to_numpy() for column in ("md_m", "offset_right_m", "offset_high_m"))
        flat = canvas.add_subplot(grid[row, 0])
        angle = np.degrees(np.unwrap(np.radians(part["angle_deg"])))
        flat.plot(md, angle, **style.line(row))
        flat.set(xlabel="along the hole, m", ylabel="angle from the low side, °")
        flat.set_title(f"{name} at {part['times_onset'].iloc[0]:g} times the onset", loc="left")
        space = canvas.add_subplot(grid[row, 1], projection="3d")
        space.plot(md, 1e3 * aside, 1e3 * up, **style.line(row))
        wall = 1e3 * np.hypot(aside, up).max()
        space.set(
            xlabel="along the hole, m", ylabel="aside, mm", zlabel="up, mm", ylim=(-wall, wall), zlim=(-wall, wall),
            yticks=[-40, 40], zticks=[-40, 0, 40],
        )  # fmt: skip
        space.xaxis.labelpad = 8  # the labels stand beside the numbers, not on them
        space.set_box_aspect((2.2, 1, 1), zoom=0.85)
    return canvas


@figure(
    "post_buckling",
    name="wall_force",
    caption=(
        "Mean wall force of a level pipe. Snaking lasts as the load rises, and a helix as it falls: at one load the "
        "wall force, and with it the friction, differs by up to a factor of two."
    ),
    checks=("helix, wall force", "wall force of snaking*", "equal energy*"),
)
@style.panels(3.6)
def wall_force(tables: Tables, ax: Axes) -> None:
    """Mean wall force along the paths of load, with the closed form of the helix."""
    table = tables["paths"]
    for index, path in enumerate(table["path"].unique()):
        of_path = table[table["path"] == path]
        ax.plot(of_path["times_onset"], of_path["wall_force_over_weight"], **style.marked(index), label=path)
    ratio = np.linspace(table["times_onset"].min(), table["times_onset"].max(), 100)
    # r F²/(4EI) over w is the square of F over the onset.
    ax.plot(ratio, ratio**2, **style.ZERO, label="helix, rF²/4EI")
    ax.set(xlabel="compression over the onset of snaking, –", ylabel="mean wall force over weight, –")
    ax.legend()


@figure(
    "post_buckling",
    name="transmitted",
    caption=(
        "Push that slides a helix through a level hole. The tan law adds the weight, which averages out over a turn."
    ),
    checks=("push through*", "the tan law*"),
)
@style.panels(3.4)
def transmitted(tables: Tables, ax: Axes) -> None:
    """Push at the top against the length of a helix that slides."""
    table = tables["pushed"]
    labels = {"reciprocal_kN": "reciprocal law", "tan_kN": "tan law", "push_kN": "engine"}
    for index, (column, label) in enumerate(labels.items()):
        drawn = style.dots(index) if column == "push_kN" else style.line(index)
        ax.plot(table["length_m"], table[column], **drawn, label=label)
    ax.set(xlabel="length of pipe, m", ylabel="push at the top, kN")
    ax.legend()


@figure(
    "robust_rows",
    name="statuses",
    caption=(
        "Plausible rows that end in another status than converged, by class of string. Nearly all of them drill: the "
        "string above the bit buckles, and the friction of its rotation rolls it round the hole, or its segments are "
        "too long to bend as it does."
    ),
)
@style.panels(4.2)
def statuses(tables: Tables, ax: Axes) -> None:
    """Share of the rows of each class with each status other than converged."""
    rows = tables["rows"]
    share = 100 * pd.crosstab(rows["class"], rows["status"], normalize="index").reindex(rows["class"].unique())
    begun = pd.Series(0.0, share.index)
    for index, status in enumerate(sorted(set(share.columns) - {"converged"})):
        ax.barh(
            range(len(share)), share[status], left=begun, color=style.COLOURS[index], label=status.replace("_", " ")
        )
        begun = begun + share[status]
    style.rows_downwards(ax, list(share.index))
    ax.set_xlabel("share of the rows that did not converge, %")
    style.legend_above(ax, columns=3)


@figure(
    "fed_limits",
    name="shapes",
    caption="A string fed below and above its limit: where it lies round the hole and how hard it presses.",
)
def beside_limits(tables: Tables) -> Canvas:
    """Contact angle and force over measured depth on both sides of the limit."""
    return _shapes(tables)


@figure(
    "stepped_limits",
    name="shapes",
    caption=(
        "Strings beside their limit by feed and by the stepper, one of them and each that arrives by one and not by "
        "the other: where they lie round the hole and how hard they press."
    ),
)
def stepped_beside_limits(tables: Tables) -> Canvas:
    """Contact angle and force over measured depth by feed and by the stepper."""
    return _shapes(tables)


def _shapes(tables: Tables) -> Canvas:
    """Contact angle on the left, contact force on the right, over measured depth; a row for each string."""
    table = tables["shapes"]
    names = list(table["string"].unique())
    canvas, axes = style.subplots(0.4 + 2.2 * len(names), len(names), 2, squeeze=False)
    for (angle, force), name in zip(axes, names, strict=True):
        of_string = table[table["string"] == name]
        for index, by in enumerate(of_string["by"].unique()):
            shape = of_string[of_string["by"] == by]
            around = (shape["contact_angle_deg"] + 90) % 360 - 90
            angle.plot(shape["md_m"], around, ".", color=style.COLOURS[index], markersize=2.5)
            touching = shape[shape["contact_force_N"] > 0]
            force.plot(
                touching["md_m"], touching["contact_force_N"] / 1e3, ".", color=style.COLOURS[index], markersize=2.5,
                label=by,
            )  # fmt: skip
        angle.set(xlabel="measured depth, m", ylabel="contact angle")
        angle.set_yticks(style.SIDES, style.SIDE_LABELS)
        angle.set_title(name, loc="left")
        force.set(yscale="log", xlabel="measured depth, m", ylabel="contact force, kN")
        style.plain_log_ticks(force.yaxis)
        force.legend(markerscale=3)
    return canvas
