"""The scaled curved section: contact force, displacement, and differences over the number of segments."""

from reports.figures import Canvas, Figure, Tables, style

TRUTH = "finite elements"
SIDES = {
    "guide_low_N": "low side of the guide",
    "bend_high_N": "high side of the bend",
    "bit_low_N": "low side at the bit",
}


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
    style.legend_outside(canvas, grid[0][0], columns=3)
    return canvas


def displacement(tables: Tables) -> Canvas:
    """Fig. 10: horizontal displacement along the string, and the offset from the axis between the walls."""
    table = tables["string"]
    clearance = 1e3 * float(table["clearance_m"].iloc[0])
    canvas, (whole, offset) = style.subplots(5.6, 2, 1, sharex=True, height_ratios=(2, 3))
    for index, model in enumerate(_models(tables)):
        rows = table[(table["model"] == model) & (table["md_m"] > _shown(tables))]
        whole.plot(rows["md_m"], rows["horizontal_m"], **_look(index), label=model)
        few = index == 1
        marker = {"marker": "s", "markersize": 3.5, "markerfacecolor": "white"} if few else {}
        offset.plot(rows["md_m"], 1e3 * rows["offset_high_m"], **_look(index) | marker)
    for side, name, at, up in ((clearance, "high side", 0.15, "bottom"), (-clearance, "low side", 0.5, "top")):
        offset.axhline(side, **style.ZERO)
        offset.annotate(
            name, (at, side), xycoords=("axes fraction", "data"), ha="center", va=up, color=style.QUIET, fontsize=9
        )
    whole.set_ylabel("horizontal displacement, m")
    offset.set(xlabel="measured depth, m", ylabel="offset from the axis, mm", ylim=(-1.4 * clearance, 1.4 * clearance))
    style.legend_above(whole, columns=3)
    return canvas


def convergence(tables: Tables) -> Canvas:
    """Differences from the finite elements against the number of segments."""
    table = tables["segments"]
    own = table[table["geometry"] == table["geometry"].iloc[0]].sort_values("segments")
    canvas, (left, right) = style.subplots(3.6, 1, 2)
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
        ax.set_xticks(own["segments"], [str(count) for count in own["segments"]])
    style.legend_above(left)
    style.legend_above(right)
    return canvas


def _models(tables: Tables) -> list[str]:
    """The finite elements, the paper's number of segments, and the most segments."""
    return [str(model) for model in tables["force"]["model"].unique()]


def _shown(tables: Tables) -> float:
    """Measured depth from which the engine's string is cut into segments [m]."""
    string = tables["string"]
    return float(string[string["model"] != TRUTH].groupby("model")["md_m"].min().max()) - 1.0


def _look(index: int) -> dict[str, object]:
    """The finite elements are a broad pale line under the others."""
    if index == 0:
        return {"color": style.COLOURS[3], "linewidth": 4.0}
    return style.line((1, 2)[index - 1])


FIGURES = [
    Figure(
        "force",
        "Paper's Fig. 9, with numbers: contact force while the string is lowered, total and on each side, from "
        "finite elements and from rigid segments.",
        force,
    ),
    Figure(
        "displacement",
        "Paper's Fig. 10: horizontal displacement along the string at the end of the run, and below it the "
        "distance from the axis of the hole. Grey lines are the walls; joints of the coarser string are squares.",
        displacement,
    ),
    Figure(
        "convergence",
        "Difference from the finite elements over the number of segments, at equal wall stiffness per metre. Dashed "
        "lines are the targets, 3 % and 1 %.",
        convergence,
    ),
]
