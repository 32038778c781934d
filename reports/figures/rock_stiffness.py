"""Loads, penetration and the stepper's step over the stiffness of the rock."""

from reports.figures import Canvas, Figure, Tables, style


def stiffness(tables: Tables) -> Canvas:
    """Changes of loads (left), penetration and step (right), each over stiffness."""
    table = tables["summary"]
    answered = table[(table["without_answer"] == 0) & (table["loads_change_percent"] > 0)]
    canvas, (left, right) = style.subplots(3.8, 1, 2, sharex=True)
    for index, (column, label) in enumerate(
        (("loads_change_percent", "hook load and torque"), ("contact_force_change_percent", "contact force"))
    ):
        left.plot(
            answered["stiffness_N_per_m"],
            answered[column],
            **style.marked(index),
            label=label,
        )
    left.axhline(1.0, **style.BOUND)
    left.set(ylabel="largest change, %")
    right.plot(
        table["stiffness_N_per_m"], table["penetration_of_clearance"], **style.marked(0),
        label="penetration / clearance",
    )  # fmt: skip
    right.plot(
        table["stiffness_N_per_m"], table["step_ms"] / table["step_ms"].max(), **style.marked(1),
        label="step / longest step",
    )  # fmt: skip
    right.set(ylabel="ratio, –")
    none = table.loc[table["without_answer"] > 0, "stiffness_N_per_m"]
    for ax in (left, right):
        ax.set(xscale="log", yscale="log", xlabel="wall stiffness per point, N/m")
        if len(none):
            ax.axvspan(none.min(), none.max(), color=style.SHADE, linewidth=0, zorder=0)
        style.legend_above(ax, columns=1)
    return canvas


FIGURES = [
    Figure(
        "stiffness",
        "The paper's well with walls of every stiffness. Left: largest change of hook load, torque and contact force "
        "over four operations and all depths, against 10¹⁰ N/m; dashed: 1 %. Right: penetration of the wall, and the "
        "longest stable step of the stepper. Shaded: the string leaves the hole somewhere, no solution.",
        stiffness,
    )
]
