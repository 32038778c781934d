"""How many segments a string needs, and what each rung of the ladder is off."""

import numpy as np
from matplotlib.axes import Axes

from reports.figures import Canvas, Tables, figure, style

QUANTITIES = {
    "torque": "torque",
    "hookload": "hook load",
    "contact": "side force",
    "bend_moment": "moment in a bend",
    "moment": "moment, RMS",
}
LIMITS = (1.0, 0.1)


@figure(
    "segment_count",
    name="errors",
    caption=(
        "Error of the steady string against its number of segments. Torque, side force (its sum from the top down) and "
        "moment turning off bottom, hook load picking up; grey lines are 1 % and 0.1 %, dashed ones first and second "
        "order. Where a line is broken the string has no solution."
    ),
    checks=("order of *", "torque of the paper's*"),
)
def errors(tables: Tables) -> Canvas:
    """A panel for each well: every quantity's error, and lines of first and second order."""
    table = tables["counts"]
    wells = list(table["well"].unique())
    rows = (len(wells) + 2) // 3
    canvas, grid = style.subplots(0.7 + 2.4 * rows, rows, 3, sharex=True, sharey=True, squeeze=False)
    axes = grid.ravel()
    for well, ax in zip(wells, axes, strict=False):
        of_well = table[(table["well"] == well) & (table["segments"] != table["reference"])]
        for index, (quantity, label) in enumerate(QUANTITIES.items()):
            error = of_well[f"{quantity}_percent"]
            ax.plot(of_well["segments"], error, **style.marked(index), label=label,
                    markersize=3)  # fmt: skip
        for limit in LIMITS:
            ax.axhline(limit, color=style.QUIET, linewidth=0.8)
        for order, dash in style.ORDERS.items():
            label = ("first order", "second order")[order - 1]
            ax.plot([20, 640], [60, 60 * 32.0**-order], **style.ZERO | {"linestyle": dash}, label=label)
        ax.set(xscale="log", yscale="log", title=well, ylim=(5e-4, 120))
        style.plain_log_ticks(ax.xaxis)
        ax.set_xticks([5, 20, 60, 160, 640])
    for ax in axes[len(wells) :]:
        ax.remove()
    for ax in axes[: len(wells)][-3:]:
        ax.set_xlabel("number of segments, –")
        ax.tick_params(labelbottom=True)
    for ax in axes[::3]:
        ax.set_ylabel("error, %")
    style.legend_outside(axes[0], columns=4)
    return canvas


@figure(
    "segment_count",
    name="cost",
    caption=(
        "Processor time against the number of segments: a steady string (left), a simulated second of the stepper, "
        "settling included (right). Linear and quadratic growth in grey; an exponential would bend upwards."
    ),
    checks=("cost of *",),
)
@style.panels(3.9, 1, 2)
def cost(tables: Tables, *axes: Axes) -> None:
    """Processor time of a steady string, and of a simulated second."""
    counts, stepped = tables["counts"], tables["stepped"]
    wells = list(counts["well"].unique())
    for index, well in enumerate(wells):
        of_well = counts[counts["well"] == well]
        look = style.marked(index) | {"markersize": 3.5}
        axes[0].plot(of_well["segments"], of_well["cost_ms"], **look, label=well)
        run = stepped[stepped["well"] == well].dropna()
        axes[1].plot(run["segments"], run["ms_per_simulated_s"], **look)
    # Ends of the grey lines, below all others.
    for ax, orders, at in ((axes[0], (1,), (40.0, 640.0)), (axes[1], (1, 2), (120.0, 960.0))):
        drawn = [np.asarray(line.get_xydata()).T for line in ax.get_lines()]
        start = 0.4 * min(np.interp(at[0], *points) for points in drawn if points.size)
        for order in orders:
            label = ("linear", "quadratic")[order - 1]
            values = [start * (x / at[0]) ** order for x in at]
            ax.plot(at, values, **style.ZERO | {"linestyle": style.ORDERS[order]}, label=label)
        ax.set(xscale="log", yscale="log", xlabel="number of segments, –")
        style.plain_log_ticks(ax.xaxis)
        ax.set_xticks([5, 20, 60, 160, 640] if ax is axes[0] else [15, 60, 240, 960])
    axes[0].set(ylabel="a steady string, ms", title="Steady solver")
    axes[1].set(ylabel="a simulated second, ms", title="Stepper")
    handles, labels = axes[0].get_legend_handles_labels()
    handles.append(axes[1].get_lines()[-1])
    axes[0].figure.legend(handles, [*labels, "quadratic"], loc="outside upper left", ncols=4)


@figure(
    "segment_count",
    name="cylinders",
    caption=(
        "Errors from the length of the cylinders for a string of 320 segments, against the same string in exact "
        "arcs: side force over the distance between the longest cylinder and the sharpest bend, in clearances "
        "(left), and moment over the length of a cylinder (right)."
    ),
    checks=("torque of cylinders*",),
)
@style.panels(3.9, 1, 2)
def cylinders(tables: Tables, *axes: Axes) -> None:
    """Errors of side force over the miss of the longest cylinder, and of moment over its length."""
    table = tables["cylinders"]
    for index, well in enumerate(table["well"].unique()):
        of_well = table[table["well"] == well]
        look = style.marked(index) | {"markersize": 3.5}
        share = of_well["miss_mm"] / of_well["clearance_mm"]
        axes[0].plot(share, of_well["contact_percent"], **look, label=well)
        axes[1].plot(of_well["cylinder_length_m"], of_well["moment_percent"], **look)
    axes[0].axvline(1.0, **style.BOUND)
    axes[0].set(xlabel="miss of the longest cylinder, clearances", ylabel="error of side force, %", title="Side force")
    axes[1].set(xlabel="length of a cylinder, m", ylabel="error of the moment (RMS), %", title="Bending moment")
    for ax in axes:
        ax.set(xscale="log", yscale="log")
    style.plain_log_ticks(axes[1].xaxis)
    axes[1].set_xticks([0.25, 1, 5, 20, 50])
    style.legend_outside(axes[0], columns=3)


LAYOUTS = ("uniform", "graded")


@figure(
    "refine",
    "refine_real",
    name="layouts",
    caption=(
        "Error of uniform and graded strings of equal counts: torque turning off bottom (above), hook load picking up "
        "(below). johancsik3 is the third example of Johancsik, Friesen and Dawson (1984)."
    ),
    checks=("*error of graded over uniform*",),
)
def layouts(tables: Tables) -> Canvas:
    """A column for each well: torque above, hook load below."""
    table = tables["layouts"]
    wells = list(table["well"].unique())
    canvas, axes = style.subplots(5.0, 2, len(wells), sharex="col", squeeze=False)
    for column, well in enumerate(wells):
        for row, (quantity, label) in enumerate((("torque", "torque"), ("hookload", "hook load"))):
            ax = axes[row, column]
            for index, layout in enumerate(LAYOUTS):
                of_kind = table[(table["well"] == well) & (table["layout"] == layout)]
                look = style.marked(index) | {"markersize": 4}
                ax.plot(of_kind["segments"], of_kind[f"{quantity}_percent"], **look, label=layout)
            ax.set(xscale="log", yscale="log")
            style.plain_log_ticks(ax.xaxis)
            low, high = ax.get_ylim()
            if high < 100 * low:
                style.plain_log_ticks(ax.yaxis)
            if column == 0:
                ax.set_ylabel(f"error of {label}, %")
        axes[0, column].set_title(well)
        axes[1, column].set_xlabel("number of segments, –")
    style.legend_outside(axes[0, 0])
    return canvas


@figure(
    "refine",
    "refine_real",
    name="landed",
    caption=(
        "Errors of fctd refine for three operations at once: the error it estimated, and the largest difference "
        "from a run with segments and cylinders a quarter as long."
    ),
    checks=("difference from a run*", "refinements that*"),
)
@style.panels(3.6)
def landed(tables: Tables, ax: Axes) -> None:
    """Estimated error, and the difference from a run four times as fine, over the tolerance."""
    table = tables["landed"]
    labels = []
    groups = table.groupby(["well", "tolerance_percent", "asked", "layout"], sort=False)
    for at, ((well, tolerance, asked, layout), rows) in enumerate(groups):
        off = rows[["hookload_off_percent", "torque_off_percent"]].max(axis=1).max()
        for index, (value, label) in enumerate(((rows["estimate_percent"].iloc[0], "estimated"), (off, "found"))):
            ax.plot(value / tolerance, at, **style.dots(index), markersize=7, label=label if at == 0 else None)
        instead = "" if asked == layout else f", {asked} asked"
        labels.append(f"{well}, {tolerance:g} %{instead}: {rows['segments'].iloc[0]} {layout}")
    ax.axvline(1.0, **style.BOUND, label="tolerance")
    style.rows_downwards(ax, labels)
    ax.set(xlabel="error, tolerances", xlim=(0, 1.1))
    style.legend_outside(ax, columns=3)


LOOKS = {"long": (1, "one long segment"), "cut twice as fine": (0, "segments of 18.75 m")}
PANELS = (
    ("rotate_off_bottom", "surface_torque_N_m", "surface torque, kN·m"),
    ("trip_in", "hookload_N", "hook load, kN"),
)


@figure(
    "long_segment",
    name="start_up",
    caption=(
        "The paper's string with the bit at 2450 m started in 2 s: torque when it starts to turn (above), hook load "
        "when it starts to go in (below). Steady loads agree; the long segment changes the waves."
    ),
    checks=("torque of a start in 2 s*", "mean torque and hook load of starts*"),
)
@style.panels(5.0, 2, 1, sharex=True)
def start_up(tables: Tables, *axes: Axes) -> None:
    """Torque of a string that starts to turn, hook load of one that starts to go in, both quickly."""
    histories = tables["histories"]
    quick = histories[histories["ramp_s"] == histories["ramp_s"].min()]
    for ax, (operation, column, label) in zip(axes, PANELS, strict=True):
        for name, (index, title) in reversed(LOOKS.items()):
            rows = quick[(quick["operation"] == operation) & (quick["vertical"] == name)]
            ax.plot(rows["time_s"], rows[column] / 1e3, **style.line(index), label=title)
        ax.set_ylabel(label)
    axes[-1].set_xlabel("time, s")
    style.legend_above(axes[0])


@figure(
    "long_segment",
    name="frequencies",
    caption=(
        "The four lowest axial and torsional frequencies of the hanging string, as differences from those of a "
        "continuous string with the same pipe and collars. One long segment for the uppermost 750 m changes the "
        "second and the third most."
    ),
    checks=("* frequencies, *",),
)
@style.panels(3.0, 1, 2, sharey=True)
def frequencies(tables: Tables, *axes: Axes) -> None:
    """Differences of the lowest frequencies from those of the continuous string."""
    table = tables["frequencies"]
    for ax, kind in zip(axes, table["kind"].unique(), strict=True):
        rows = table[table["kind"] == kind]
        ax.axhline(0, **style.ZERO)
        for index, column, label in ((1, "long", "one long segment"), (0, "cut", "segments of 37.5 m")):
            ax.plot(
                rows["continuous_Hz"], rows[f"{column}_off_percent"], **style.dots(index), markersize=7, label=label
            )
        ax.set(xlabel=f"{kind} frequency of the continuous string, Hz")
    axes[0].set_ylabel("frequency difference, %")
    style.legend_outside(axes[0])


LEAST, MOST = 1e-5, 10.0  # of error over bound that is drawn; beyond them a marker stands at the edge


@figure(
    "ladder",
    name="rungs",
    caption=(
        "Error of every rung over its bound, the larger of two segmentations, worst first. Markers at the right edge "
        "are ten times the bound and more, or have no number."
    ),
)
def rungs(tables: Tables) -> Canvas:
    """A row for each rung, a marker for each solver: the worst of its segmentations."""
    table = tables["rungs"]
    # A rung without a number is as bad as any.
    share = table["error_over_bound"].fillna(np.inf)
    worst = table.assign(share=share).groupby(["rung", "by"], sort=False)["share"].max().reset_index()
    order = worst.groupby("rung")["share"].max().sort_values(ascending=False, kind="stable")
    rows = list(order.index)
    canvas, ax = style.subplots(0.9 + 0.19 * len(rows))
    for index, by in enumerate(("steady", "stepper")):
        part = worst[worst["by"] == by]
        heights = [rows.index(rung) for rung in part["rung"]]
        ax.plot(part["share"].clip(LEAST, MOST), heights, **style.dots(index), label=by)
    ax.axvline(1.0, **style.BOUND, label="bound")
    ax.set(xscale="log", xlim=(0.7 * LEAST, 1.4 * MOST), xlabel="|error| / bound, 1")
    style.rows_downwards(ax, rows)
    ax.tick_params(axis="y", labelsize=7.5)
    style.legend_outside(ax, columns=3)
    return canvas
