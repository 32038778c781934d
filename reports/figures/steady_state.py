"""A chart of the paper's well by the steady solver, with the stepper's loads."""

from fctd.plots.palette import LOOKS
from reports.figures import Canvas, Figure, Tables, style

COLUMNS = ("hookload_stepped_kN", "torque_stepped_kN_m")


def chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, lines from the solver, plus signs from the stepper."""
    canvas = style.chart(tables["chart"])
    for operation, rows in tables["compared"].groupby("operation"):
        colour, _ = LOOKS[str(operation)]
        for ax, column in zip(canvas.axes[:2], COLUMNS, strict=True):
            ax.plot(rows[column], rows["bit_depth_m"], "+", color=colour, markersize=12, markeredgewidth=1.5)
    return canvas


FIGURES = [
    Figure(
        "chart",
        "The paper's well by the steady solver: hook load (left) and surface torque (right), every 10 m; drilling with "
        "50 kN on the bit and 3 kN·m. Plus signs are the stepper's loads at the same depths.",
        chart,
    )
]
