"""All operations on a real survey."""

from reports.figures import Canvas, Figure, Tables, style


def chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, arcs geometry."""
    table = tables["chart"]
    return style.chart(table[table["geometry"] == "arcs"])


FIGURES = [
    Figure(
        "chart",
        "A real survey of 8,161 m with an assumed string and friction factor 0.2: hook load (left) and surface "
        "torque (right) of all operations. Open markers, if any, are rows that are not converged; the strip says why.",
        chart,
    )
]
