"""Graded and uniform strings, and the errors of ``fctd refine``."""

from reports.figures import Canvas, Figure, Tables, style

LAYOUTS = ("uniform", "graded")


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
    style.legend_outside(canvas, axes[0, 0])
    return canvas


def landed(tables: Tables) -> Canvas:
    """Estimated error, and the difference from a run four times as fine, over the tolerance."""
    table = tables["landed"]
    canvas, ax = style.subplots(3.6)
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
    style.legend_outside(canvas, ax, columns=3)
    return canvas


FIGURES = [
    Figure(
        "layouts",
        "Error of uniform and graded strings of equal counts: torque turning off bottom (above), hook load picking up "
        "(below). johancsik3 is the third example of Johancsik, Friesen and Dawson (1984).",
        layouts,
    ),
    Figure(
        "landed",
        "Errors of fctd refine for three operations at once: the error it estimated, and the largest difference "
        "from a run with segments and cylinders a quarter as long.",
        landed,
    ),
]
