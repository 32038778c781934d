"""Maps of the difference between stiff and soft string."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from pandas import DataFrame

from reports import words
from reports.figures import Canvas, Figure, Tables, style

LIMIT = 30.0  # [deg/100 ft], the paper's
LARGEST = 40.0  # percent: the darkest cell
WHITE_FROM = 20.0  # percent: cells so dark that their numbers are white


def contact_force(tables: Tables) -> Canvas:
    """Difference of contact force: a map for each operation and string, numbers in the cells."""
    table, light = tables["map"], tables["light"]
    strings = {string: table[table["string"] == string] for string in table["string"].unique()}
    strings |= {f"{string}, little weight": light[light["string"] == string] for string in light["string"].unique()}
    operations = list(table["operation"].unique())
    canvas, grid = style.subplots(
        0.6 + 2.2 * len(strings), len(strings), len(operations), sharex=True, sharey=True, squeeze=False
    )
    for row, (string, rows) in zip(grid, strings.items(), strict=True):
        for ax, operation in zip(row, operations, strict=True):
            _map(ax, rows[rows["operation"] == operation])
            ax.set_title(words.name(operation), fontsize=8.5)
        row[0].set_ylabel(f"{string}\nclearance, mm")
    for ax in grid[-1]:
        ax.set_xlabel("severity, °/100 ft")
    return canvas


def _map(ax: Axes, rows: DataFrame) -> None:
    values = rows.pivot_table(index="clearance_mm", columns="severity_deg_per_100ft", values="contact_force_percent")
    cells = values.to_numpy()
    ax.imshow(np.abs(cells), cmap="Greys", norm=Normalize(0, LARGEST), aspect="auto", origin="lower")
    for (i, k), value in np.ndenumerate(cells):
        ink = "white" if abs(value) > WHITE_FROM else "black"
        text = f"{value:z.0f}".replace("-", words.MINUS)
        ax.text(k, i, text, ha="center", va="center", color=ink, fontsize=8.5)
    ax.set_xticks(range(len(values.columns)), [f"{severity:g}" for severity in values.columns])
    ax.set_yticks(range(len(values.index)), [f"{clearance:g}" for clearance in values.index])
    ax.grid(visible=False)
    at = int(np.argmin(np.abs(values.columns.to_numpy(float) - LIMIT))) - 0.5
    ax.axvline(at, **style.line(1))


FIGURES = [
    Figure(
        "contact_force",
        "Total contact force of the stiff string over the soft string's, in percent, for a 60° build over severity "
        "and clearance; below, strings with little weight below the bend. Darker cells have larger differences; "
        "right of the dashed line the paper advises against the soft string.",
        contact_force,
    )
]
