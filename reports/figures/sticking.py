"""Friction that sticks: error of a body on a belt, and the pull out of mud cake."""

from reports.figures import Canvas, Figure, Tables, style


def belt_and_cake(tables: Tables) -> Canvas:
    """Error of period and amplitude over the step (left); overpull over the ratio of the factors (right)."""
    belt, pulls = tables["belt"], tables["overpull"]
    canvas, (left, right) = style.subplots(3.4, 1, 2)
    for index, (law, rows) in enumerate(belt.groupby("law")):
        for column, filled in (("period", True), ("amplitude", False)):
            look = style.dots(index, filled=filled) | {"linestyle": style.DASHES[0 if filled else 1]}
            left.plot(rows["step_ms"], rows[f"{column}_off_percent"], **look, label=f"{law}, {column}")
    left.set(xscale="log", yscale="log", xlabel="step, ms", ylabel="off the exact one, %")
    style.plain_log_ticks(left.xaxis)
    style.legend_above(left, columns=2)
    ratio = pulls["static_over_kinetic"]
    right.plot(ratio, pulls["all_at_once_kN"], **style.line(1), label="all of it at once, μₛΔp b L")
    right.plot(ratio, pulls["overpull_kN"], **style.marked(0), label="engine")
    right.set(xlabel="static over kinetic factor, –", ylabel="overpull, kN", ylim=(0, None))
    style.legend_above(right, columns=1)
    return canvas


FIGURES = [
    Figure(
        "belt_and_cake",
        "Left: period and amplitude of a body that sticks and slips on a belt, off the exact ones, over the step. "
        "Right: the pull that frees collars from 60 m of mud cake. With equal factors it is the closed form; with a "
        "higher static one the upper end breaks away first, and less is needed than for all of it at once.",
        belt_and_cake,
    )
]
