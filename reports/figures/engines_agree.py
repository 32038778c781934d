"""The same string in other engines: loads against FCTD's, contact forces along it."""

from reports import words
from reports.figures import Canvas, Figure, Tables, style


def loads(tables: Tables) -> Canvas:
    """A dot per engine and operation: hook load and torque against FCTD; open dots failed a check."""
    numbers = tables["chain"]
    numbers = numbers[numbers["engine"] != "FCTD"]
    names = list(numbers["engine"].unique())
    windows = list(numbers.groupby(["hole", "operation"], sort=False))
    canvas, axes = style.subplots(1.8 + 0.42 * len(names), 1, 2, sharey=True)
    columns = (("hookload_off_percent", "hook load − FCTD's, %"), ("torque_off_percent", "torque − FCTD's, %"))
    for ax, (column, label) in zip(axes, columns, strict=True):
        for index, ((hole, kind), rows) in enumerate(windows):
            turning = ", hole that turns" if hole == "turning" else ""
            for _, row in rows.iterrows():
                height = names.index(row["engine"]) + 0.16 * (index - (len(windows) - 1) / 2)
                ax.plot(
                    row[column], height, **style.dots(index, filled=row["status"] == "valid"), markersize=6,
                    label=words.name(str(kind)) + turning,
                )  # fmt: skip
        ax.axvline(0, **style.ZERO)
        ax.set_xlabel(label)
        ax.margins(x=0.12)
    style.rows_downwards(axes[0], names)
    handles, labels = axes[0].get_legend_handles_labels()
    first = {label: handle for handle, label in zip(handles, labels, strict=True)}
    canvas.legend(first.values(), first.keys(), loc="outside upper left", ncols=2)
    return canvas


def contact(tables: Tables) -> Canvas:
    """Contact force along the turning chain, one line for each engine at its best configuration."""
    profiles = tables["profiles"]
    turning = profiles[(profiles["operation"] == "rotate_off_bottom") & (profiles["hole"] == "planar")]
    names = [name for name in turning["engine"].unique() if "default" not in name]
    canvas, ax = style.subplots(3.4)
    for index, name in enumerate(names):
        at = turning[turning["engine"] == name]
        ax.plot(at["md_m"], at["contact_force_N"] / 1e3, **style.line(index), label=name)
    touched = turning.loc[turning["contact_force_N"] > 0, "md_m"]
    ax.set(xlabel="measured depth, m", ylabel="contact force, kN", xlim=(touched.min() - 50, touched.max() + 20))
    style.legend_above(ax, columns=4)
    return canvas


def friction(tables: Tables) -> Canvas:
    """Angle of friction to the sliding over the azimuth of a straight hole, and that of two fixed directions."""
    table = tables["friction"]
    canvas, ax = style.subplots(3.2)
    for index, (name, at) in enumerate(table.groupby("engine", sort=False)):
        ax.plot(at["azimuth_deg"], at["lean_deg"], **style.dots(index), markersize=6, label=name)
    given = table.dropna(subset="two_directions_lean_deg")
    ax.plot(
        given["azimuth_deg"], given["two_directions_lean_deg"], color=style.QUIET, linestyle="none", marker="o",
        markersize=12, markerfacecolor="none", label="against M·v, north and east",
    )  # fmt: skip
    ax.set(xlabel="azimuth of the hole, °", ylabel="angle of friction to sliding, °")
    style.legend_above(ax, columns=3)
    return canvas


FIGURES = [
    Figure(
        "loads",
        "The curved chain in other engines, from the same state over the same window: differences of hook load and "
        "torque from FCTD's. An open dot is a run that failed a check; where FCTD has no torque there is no dot.",
        loads,
    ),
    Figure(
        "contact",
        "Contact force along the turning chain in each engine at its best configuration, means over the last quarter "
        "of a second.",
        contact,
    ),
    Figure(
        "friction",
        "A pipe turning in a straight, horizontal hole: angle of friction to the sliding, positive up the hole, over "
        "the azimuth of the hole. By Coulomb's law it is zero. Rings: friction opposite to M·v, with M the effective "
        "masses along two fixed directions.",
        friction,
    ),
]
