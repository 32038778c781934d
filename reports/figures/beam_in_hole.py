"""Short beams against beam theory."""

from reports.figures import Canvas, Figure, Tables, style


def errors(tables: Tables) -> Canvas:
    """Difference from beam theory against segment length, a line for each beam."""
    table = tables["beams"]
    canvas, ax = style.subplots(3.8)
    for index, beam in enumerate(table["beam"].unique()):
        of_beam = table[table["beam"] == beam].sort_values("segment_m")
        ax.plot(of_beam["segment_m"], of_beam["off_percent"].abs(), **style.marked(index), label=beam)
    ax.axhline(1.0, **style.BOUND)
    ax.set(xscale="log", yscale="log", xlabel="segment length, m", ylabel="difference from beam theory, %")
    style.plain_log_ticks(ax.xaxis)
    style.legend_outside(canvas, ax)
    return canvas


FIGURES = [
    Figure(
        "errors",
        "Short beams against beam theory: the difference falls with the square of the segment length until effects "
        "that beam theory neglects remain (shear, the elastic wall). The dashed line is 1 %.",
        errors,
    )
]
