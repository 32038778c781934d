"""Error and cost against the number of segments, error against the length of the cylinders."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style

QUANTITIES = {
    "torque": "torque",
    "hookload": "hook load",
    "contact": "side force",
    "bend_moment": "moment in a bend",
    "moment": "moment, RMS",
}
LIMITS = (1.0, 0.1)


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
    style.legend_outside(canvas, axes[0], columns=4)
    return canvas


def cost(tables: Tables) -> Canvas:
    """Processor time of a steady string, and of a simulated second."""
    canvas, axes = style.subplots(3.9, 1, 2)
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
        start = 0.4 * min(np.interp(at[0], *line.get_data()) for line in ax.get_lines() if len(line.get_xdata()))
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
    canvas.legend(handles, [*labels, "quadratic"], loc="outside upper left", ncols=4)
    return canvas


def cylinders(tables: Tables) -> Canvas:
    """Errors of side force over the miss of the longest cylinder, and of moment over its length."""
    table = tables["cylinders"]
    canvas, axes = style.subplots(3.9, 1, 2)
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
    style.legend_outside(canvas, axes[0], columns=3)
    return canvas


FIGURES = [
    Figure(
        "errors",
        "Error of the steady string against its number of segments. Torque, side force (its sum from the top down) and "
        "moment turning off bottom, hook load picking up; grey lines are 1 % and 0.1 %, dashed ones first and second "
        "order. Where a line is broken the string has no solution.",
        errors,
    ),
    Figure(
        "cost",
        "Processor time against the number of segments: a steady string (left), a simulated second of the stepper, "
        "settling included (right). Linear and quadratic growth in grey; an exponential would bend upwards.",
        cost,
    ),
    Figure(
        "cylinders",
        "Errors from the length of the cylinders for a string of 320 segments, against the same string in exact "
        "arcs: side force over the distance between the longest cylinder and the sharpest bend, in clearances "
        "(left), and moment over the length of a cylinder (right).",
        cylinders,
    ),
]
