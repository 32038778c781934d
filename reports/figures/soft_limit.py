"""The stiff string on its way to the soft limit."""

from reports.figures import Canvas, Figure, Tables, style

ALLOWED = 0.2  # percent


def ladder(tables: Tables) -> Canvas:
    """Largest difference at each rung, a line for each operation."""
    table = tables["ladder"]
    canvas, axes = style.subplots(3.4, 1, 2, sharey=True)
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
    style.legend_outside(canvas, axes[0], columns=4)
    return canvas


FIGURES = [
    Figure(
        "ladder",
        "Largest difference between the stiff string and the closed forms of the soft string, over five wells and "
        "two laws, as clearance and then bending stiffness are removed.",
        ladder,
    )
]
