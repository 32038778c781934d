"""Torque of a string that starts to turn in a level hole."""

from reports.figures import Canvas, Figure, Tables, style


def torque(tables: Tables) -> Canvas:
    """Surface torque over time, by the engine and in closed form."""
    table = tables["torque"]
    canvas, ax = style.subplots(2.9)
    ax.plot(table["time_s"], table["torque_kN_m"], **style.line(0) | {"linewidth": 1.1}, label="engine")
    ax.plot(table["time_s"], table["closed_form_kN_m"], **style.line(1), label="closed form without inertia")
    ax.set(xlabel="time, s", ylabel="surface torque, kN·m", ylim=(0, None))
    ax.legend(loc="lower right")
    return canvas


FIGURES = [
    Figure(
        "torque",
        "Surface torque of 1000 m of pipe in a level hole that starts to turn at 2 rev/min: it builds up as friction "
        "is overcome further and further down, until all of the string turns.",
        torque,
    )
]
