"""A point dragged through a bend, with cylinders that overlap and cylinders that do not."""

from reports.figures import Canvas, Figure, Tables, style


def drag(tables: Tables) -> Canvas:
    """Contact force and direction over the distance dragged, with overlap and without."""
    table = tables["drag"]
    canvas, (force, direction) = style.subplots(4.6, 2, 1, sharex=True)
    # The run without overlap is a thin line over the other; dashes would not show in its jumps.
    for index, overlap in enumerate(sorted(table["overlap"].unique(), reverse=True)):
        ordered = table[table["overlap"] == overlap].sort_values("s_m")
        look = {"color": style.COLOURS[index], "linewidth": (3.2, 1.0)[index], "alpha": (0.55, 1.0)[index]}
        label = f"with an overlap of {overlap:g} m" if overlap else "without overlap"
        force.plot(ordered["s_m"], ordered["contact_force_N"] / 1e3, **look, label=label)
        touching = ordered["contact_force_N"] > 0
        direction.plot(ordered["s_m"], ordered["direction_deg"].where(touching), **look)
    force.set(ylabel="contact force, kN", ylim=(0, None))
    direction.set(xlabel="distance dragged, m", ylabel="direction of the force, °")
    style.legend_above(force)
    return canvas


FIGURES = [
    Figure(
        "drag",
        "A point pressed against the outer wall and dragged through a bend. Without overlap the seam between two "
        "cylinders leaves a gap on the outside of the bend in which no cylinder owns the point; the overlap closes "
        "the gap and blends one cylinder into the next.",
        drag,
    )
]
