"""The residual of the energy ledger over the time step."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style


def closure(tables: Tables) -> Canvas:
    """Residual of the ledger against the step, with lines of first and second order."""
    table = tables["closure"]
    canvas, ax = style.subplots(4.0)
    for index, (case, rows) in enumerate(table.groupby("case", sort=False)):
        ordered = rows.sort_values("step_s")
        residual = ordered["relative_residual"].abs()
        ax.plot(
            ordered["step_s"] * 1e3,
            residual,
            **style.marked(index),
            label=str(case),
        )
    ax.set(xscale="log", yscale="log", xlabel="time step, ms", ylabel="|residual| / work")
    style.plain_log_ticks(ax.xaxis)
    style.slopes(ax, table["step_s"].to_numpy(float) * 1e3, np.abs(table["relative_residual"].to_numpy(float)))
    style.legend_above(ax, columns=2)
    return canvas


FIGURES = [
    Figure(
        "closure",
        "Residual of the energy ledger, as a share of the work done, against the time step. "
        "The grey lines fall with the first and the second power of the step.",
        closure,
    )
]
