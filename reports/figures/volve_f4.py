"""A public well: measured loads over depth with calibrated curves, and judged rows with their bands."""

from matplotlib.axes import Axes

from reports.figures import Tables, figure, style

KINDS = {"trip_out": "picking up", "rotate_off_bottom": "rotating", "trip_in": "slacking off"}


@figure(
    "volve_f4",
    name="chart",
    caption=(
        "Well 15/9-F-4 of the Volve field, as the paper's Fig. 12: torque (left) and weight indicator (right) over bit "
        "depth. Lines: the string of the 12 1/4 in section at 130 rev/min, fitted to the series (above), and the wiper "
        "string at 20 rev/min by model B (below). Open markers: medians of the 4-second series, at 60 to 130 rev/min; "
        "filled: daily reports of several strings, which the next figure judges one by one."
    ),
)
@style.panels(4.6, 1, 2, sharey=True)
def chart(tables: Tables, left: Axes, right: Axes) -> None:
    """Torque and weight indicator over bit depth."""
    points = tables["points"]
    for _, curve in tables["curves"].groupby("string", sort=False):
        for index, kind in enumerate(KINDS):
            rows = curve[curve["operation"] == kind]
            right.plot(rows["weight_indicator_N"] / 1e3, rows["bit_depth_m"], **style.line(index))
            if kind == "rotate_off_bottom":
                left.plot(rows["drive_torque_N_m"] / 1e3, rows["bit_depth_m"], **style.line(index))
    for ax, load in ((left, "torque"), (right, "hookload")):
        for index, kind in enumerate(KINDS):
            for source, filled in (("series", False), ("report", True)):
                turns = points["rad_per_s"] > 0
                wanted = (points["load"] == load) & (points["operation"] == kind) & (points["source"] == source)
                wanted &= turns == (kind == "rotate_off_bottom")
                rows = points[wanted]
                # A range is a bar between its ends.
                middle = 0.5 * (rows["low"] + rows["high"])
                label = f"{KINDS[kind]}, {source}" if ax is right else None
                ax.errorbar(
                    middle, rows["bit_depth_m"], xerr=0.5 * (rows["high"] - rows["low"]), label=label,
                    **style.dots(index, filled=filled),
                )  # fmt: skip
    left.set(xlabel="torque, kN·m", xlim=(0, None))
    right.set_xlabel("weight indicator, kN")
    style.depth_downwards(left, "bit depth, m")
    style.legend_outside(right, columns=3)


@figure(
    "volve_f4",
    name="rows",
    caption="Judged rows: predicted 95 % band (thin) and 50 % band (thick), recorded value or range (black).",
)
@style.panels(4.4, 1, 2)
def rows(tables: Tables, *axes: Axes) -> None:
    """Bands of judged rows: torque by models of split A, half spread by those of A and B."""
    table = tables["rows"]
    for ax, (quantity, unit) in zip(axes, (("torque", "kN·m"), ("half spread", "kN")), strict=True):
        part = table[table["quantity"] == quantity]
        part = part.sort_values(["row", "model"], kind="stable").reset_index(drop=True)
        models = list(dict.fromkeys(table["model"]))
        for at, (_, one) in enumerate(part.iterrows()):
            colour = style.COLOURS[models.index(one["model"])]
            label = one["model"] if not part["model"].iloc[:at].eq(one["model"]).any() else None
            ax.plot([one["low_95"], one["high_95"]], [at, at], color=colour, linewidth=1.2)
            ax.plot([one["low_50"], one["high_50"]], [at, at], color=colour, linewidth=4, label=label)
            ends = sorted({one["measured_low"], one["measured_high"]})
            ax.plot(ends, [at] * len(ends), color="black", marker="|", markersize=11, markeredgewidth=1.6)
        first = ~part["row"].duplicated()
        style.rows_downwards(ax, [str(row) if new else "" for row, new in zip(part["row"], first, strict=True)])
        ax.set(xlabel=f"{quantity}, {unit}")
        if quantity == "half spread":
            style.legend_outside(ax, columns=3)
