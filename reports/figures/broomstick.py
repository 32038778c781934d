"""The broomstick, as ``fctd chart --plot`` draws it."""

from reports.figures import Canvas, Figure, Tables, style


def chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, a line for each operation and friction factor."""
    return style.chart(tables["chart"])


FIGURES = [
    Figure(
        "chart",
        "The broomstick of the paper's well: hook load (left) and surface torque (right) over bit depth for three "
        "friction factors, by the steady solver.",
        chart,
    )
]
