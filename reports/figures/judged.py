"""Judged readings of public wells: bands of stiff string, soft string and one factor about what was recorded."""

from typing import Final

from reports.figures import Canvas, Tables, figure, style

# The studies of measured wells, and what the page of wells calls them.
WELLS: Final = {
    "volve_f4": "Volve 15/9-F-4",
    "forge_16a": "Utah FORGE 16A(78)-32",
    "s_well_onshore": "An onshore S-well",
}
# Of the models, none of them black.
COLOURS: Final = [colour for k, colour in enumerate(style.COLOURS) if k != 2]


@figure(
    *WELLS,
    name="judged",
    caption=(
        "Every judged reading: predicted 95 % band (thin) and 50 % band (thick) less the middle of the recorded range, "
        "which is the black bar about zero. Models in their order: stiff string, soft string, one factor."
    ),
)
def judged(tables: Tables) -> Canvas:
    """Bands less what was recorded; a panel for each well and kind of load."""
    table = tables["judged"]
    panels = [*table.groupby(["well", "unit"], sort=False)]
    models = list(dict.fromkeys(table["model"]))
    sizes = [len(part) / len(models) for _, part in panels]
    canvas, axes = style.subplots(1.2 + 0.32 * sum(sizes) + 0.5 * len(panels), len(panels), 1, squeeze=False,
                                  height_ratios=sizes)  # fmt: skip
    for ax, ((well, unit), part) in zip(axes[:, 0], panels, strict=True):
        labels = list(dict.fromkeys(zip(part["row"], part["quantity"], strict=True)))
        for _, one in part.iterrows():
            at, k = labels.index((one["row"], one["quantity"])), models.index(one["model"])
            middle, y = 0.5 * (one["measured_low"] + one["measured_high"]), at + 0.22 * (k - (len(models) - 1) / 2)
            for share, width in ((95, 1.0), (50, 3.0)):
                ends = [one[f"low_{share}"] - middle, one[f"high_{share}"] - middle]
                label = one["model"] if share == 50 and at == 0 else None
                ax.plot(ends, [y, y], color=COLOURS[k], linewidth=width, label=label)
            if k == 0:
                half = 0.5 * (one["measured_high"] - one["measured_low"])
                ax.plot([-half, half], [at, at], color="black", marker="|", markersize=13, markeredgewidth=1.2)
        style.rows_downwards(ax, [f"{row}, {quantity}" for row, quantity in labels])
        ax.set(xlabel=f"{well}: prediction less reading, {str(unit).replace(' ', '·')}")
    style.legend_outside(axes[0, 0], columns=len(models))
    return canvas
