"""Drag and torque of the two laws over the ratio of speeds."""

from reports.figures import Canvas, Figure, Tables, style

PANELS = (("drag", "kN", "axial drag, kN"), ("torque", "kN_m", "torque, kN·m"))


def straight(tables: Tables) -> Canvas:
    """Solver as lines, closed forms as marks."""
    table = tables["straight"]
    canvas, axes = style.subplots(3.6, 1, 2, sharex=True)
    for ax, (name, unit, label) in zip(axes, PANELS, strict=True):
        for law, index in style.LAWS.items():
            rows = table[table["law"] == law]
            if rows.empty:
                continue
            x = rows["axial_over_tangential"]
            ax.plot(x, rows[f"{name}_{unit}"], **style.line(index), label=f"law {law}")
            few = slice(None, None, max(len(rows) // 8, 1))
            ax.plot(
                x.iloc[few], rows[f"{name}_closed_form_{unit}"].iloc[few], **style.dots(index, filled=False),
                label=f"{law}, closed form",
            )  # fmt: skip
        ax.set(xscale="log", xlabel="axial over tangential speed, –", ylabel=label, ylim=(0, None))
    style.legend_outside(canvas, axes[0])
    return canvas


FIGURES = [
    Figure(
        "straight",
        "A pipe pulled out of 1000 m of straight hole at 60° while it turns at 60 rev/min, over the ratio of its "
        "axial to its tangential speed at the wall. Coulomb's law divides one force between drag and torque; the "
        "paper's law gives both in full.",
        straight,
    )
]
