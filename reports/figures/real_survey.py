"""A surveyed well: surface loads over time, and where the string touches."""

from reports.figures import Canvas, Figure, Tables, style


def history(tables: Tables) -> Canvas:
    """Torque and hook load over time."""
    table = tables["history"]
    canvas, (torque, load) = style.subplots(4.4, 2, 1, sharex=True)
    torque.plot(table["time_s"], table["surface_torque_N_m"] / 1e3, **style.line(0))
    torque.set_ylabel("surface torque, kN·m")
    load.plot(table["time_s"], table["hookload_N"] / 1e3, **style.line(0))
    load.set(xlabel="time, s", ylabel="hook load, kN")
    return canvas


def contact(tables: Tables) -> Canvas:
    """Contact force and side against depth, drawn downwards."""
    table = tables["profiles"].sort_values("md_m")
    touching = table[table["contact_force_N"] > 0]
    canvas, (force, angle) = style.subplots(5.2, 1, 2, sharey=True, width_ratios=[3, 2])
    force.hlines(touching["md_m"], 0, touching["contact_force_N"] / 1e3, color=style.COLOURS[0], linewidth=0.9)
    force.plot(touching["contact_force_N"] / 1e3, touching["md_m"], **style.dots(0), markersize=2.5)
    force.set(xlabel="contact force, kN", xlim=(0, None))
    angle.plot(style.unrolled(touching["contact_angle_deg"]), touching["md_m"], **style.dots(0), markersize=2.5)
    angle.set_xticks(style.SIDES, style.SIDE_LABELS)
    angle.set(xlabel="contact angle", xlim=(-90, 270))
    style.depth_downwards(force)
    return canvas


FIGURES = [
    Figure(
        "history",
        "Surface torque and hook load over time, the string in a surveyed well.",
        history,
    ),
    Figure(
        "contact",
        "Contact force (left) and the side of the hole that the string touches (right) at the end of the run, "
        "against measured depth. 0° is the high side, 90° is to the right looking downhole.",
        contact,
    ),
]
