"""How the plausible rows of every class of string end."""

import pandas as pd

from reports.figures import Canvas, Figure, Tables, style


def statuses(tables: Tables) -> Canvas:
    """Share of the rows of each class with each status other than converged."""
    rows = tables["rows"]
    share = 100 * pd.crosstab(rows["class"], rows["status"], normalize="index").reindex(rows["class"].unique())
    canvas, ax = style.subplots(4.2)
    begun = pd.Series(0.0, share.index)
    for index, status in enumerate(sorted(set(share.columns) - {"converged"})):
        ax.barh(
            range(len(share)), share[status], left=begun, color=style.COLOURS[index], label=status.replace("_", " ")
        )
        begun = begun + share[status]
    style.rows_downwards(ax, list(share.index))
    ax.set_xlabel("share of the rows that did not converge, %")
    style.legend_above(ax, columns=3)
    return canvas


FIGURES = [
    Figure(
        "statuses",
        "Plausible rows that end in another status than converged, by class of string. Nearly all of them drill: the "
        "string above the bit buckles, and the friction of its rotation rolls it round the hole, or its segments are "
        "too long to bend as it does.",
        statuses,
    )
]
