"""Drilling in time: the line of the law of the bit, and the cost by depth."""

from reports.figures import Canvas, Figure, Tables, style

WANTED = 150.0  # real-time factor of drilling 3 km


def law_and_cost(tables: Tables) -> Canvas:
    """Specific energy over drilling strength (left); real-time factor over depth (right)."""
    drilled, speed = tables["drilling"].sort_values("drilling_strength_MPa"), tables["speed"]
    canvas, (left, right) = style.subplots(3.3, 1, 2)
    strength = drilled["drilling_strength_MPa"]
    left.plot(strength, drilled["by_the_law_MPa"], **style.line(1), label="E = (1 − μγζ)ε + μγS")
    for index, (name, rows) in enumerate(drilled.groupby(drilled["driller"] == "autodriller")):
        left.plot(rows["drilling_strength_MPa"], rows["specific_energy_MPa"], **style.dots(2 * index, filled=False),
                  markersize=8, label="autodriller" if name else "given speed of the block")  # fmt: skip
    left.set(xlabel="drilling strength S, MPa", ylabel="specific energy E, MPa", xlim=(0, None), ylim=(0, None))
    left.legend(loc="lower right")
    right.plot(speed["depth_m"], speed["real_time_factor"], **style.marked(0), label="measured")
    right.axhline(WANTED, **style.BOUND, label="wanted for the whole well")
    right.set(xlabel="depth, m", ylabel="real-time factor, –", ylim=(0, None))
    right.legend(loc="upper right")
    return canvas


FIGURES = [
    Figure(
        "law_and_cost",
        "Left: specific energy over drilling strength of runs that drill, on the line of the law of Detournay & "
        "Defournay. Right: simulated time over processor time with the bit on bottom, segments of 10 m.",
        law_and_cost,
    )
]
