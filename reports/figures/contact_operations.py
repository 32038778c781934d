"""Operations of one contact test: the paper's, the engine's, its search, a mesh."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style


def operations(tables: Tables) -> Canvas:
    """A row for each part, arithmetic and comparisons on a logarithmic axis."""
    table = tables["operations"]
    canvas, ax = style.subplots(1.0 + 0.3 * len(table))
    for index, column in enumerate(("arithmetic", "compare")):
        some = table[column] > 0
        height = np.flatnonzero(some) + 0.14 * (2 * index - 1)
        label = "sums, products, roots" if column == "arithmetic" else "comparisons"
        ax.plot(table.loc[some, column], height, **style.dots(index, filled=not index), markersize=6, label=label)
    ax.set(xscale="log", xlabel="operations per point, –")
    style.rows_downwards(ax, list(table["what"]))
    style.legend_outside(canvas, ax)
    return canvas


FIGURES = [
    Figure(
        "operations",
        "Operations of one contact point on the paper's well, counted by running the engine's own helpers. The paper "
        "counts thirteen for one cylinder; its search tests a few hundred cylinders, while the engine remembers the "
        "last one.",
        operations,
    )
]
