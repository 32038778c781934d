"""Short beams against beam theory."""

from matplotlib.figure import Figure as Canvas

from reports.figures import Figure, Tables, style


def errors(tables: Tables) -> Canvas:
    """Distance from beam theory against segment length, a line a beam."""
    table = tables["beams"]
    canvas = style.figure(3.8)
    ax = canvas.subplots()
    for index, beam in enumerate(table["beam"].unique()):
        of_beam = table[table["beam"] == beam].sort_values("segment_m")
        look = {**style.line(index), "marker": style.MARKERS[index], "label": beam}
        ax.plot(of_beam["segment_m"], of_beam["off_percent"].abs(), **look)
    ax.axhline(1.0, color=style.QUIET, linewidth=1, linestyle=(0, (4, 2)))
    ax.set(xscale="log", yscale="log", xlabel="segment length, m", ylabel="off beam theory, %")
    style.plain_log_ticks(ax.xaxis)
    canvas.legend(*ax.get_legend_handles_labels(), loc="outside upper left", ncols=2)
    return canvas


FIGURES = [
    Figure(
        "errors",
        "Short beams against beam theory: the distance falls with the square of the segment length until what beam "
        "theory leaves out shows (shear, a wall that gives way). The dashed line is 1 %.",
        errors,
    )
]
