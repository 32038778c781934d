"""Whirl of a collar against planar rotors."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style

SHOWN = 0.6  # of the path [s]


def collar(tables: Tables) -> Canvas:
    """The critical speed as the zero of Ω²/radius (left); the path of a body that rolls backwards (right)."""
    speeds, paths = tables["critical_speed"], tables["paths"]
    canvas, (left, right) = style.subplots(3.7, 1, 2)
    square = speeds["rad_per_s"] ** 2
    slope, offset = np.polyfit(square, square / speeds["radius_mm"], 1)
    critical, rotor = (float(speeds[f"{name}_rad_per_s"].iloc[0]) for name in ("critical", "rotor"))
    ends = np.array([square.min(), critical**2])
    left.plot(square, square / speeds["radius_mm"], **style.dots(0), label="engine")
    left.plot(ends, slope * ends + offset, **style.line(0), label="straight line")
    left.plot(rotor**2, 0.0, **style.dots(1, filled=False), markersize=9, label="planar rotor")
    left.set(xlabel="rotation Ω², rad²/s²", ylabel="Ω²/radius, rad²/s²/mm", ylim=(0, None))
    left.margins(x=0.08)
    left.legend(loc="upper right")
    for index, (name, rows) in enumerate(paths.groupby("of")):
        rows = rows[rows["time_s"] <= SHOWN]
        label = "engine" if name == "FCTD" else str(name)
        look = style.line(index) | {"linewidth": 1.2 + 1.6 * index}
        right.plot(1e3 * rows["x_m"], 1e3 * rows["y_m"], **look, label=label, zorder=3 - index)
    right.set(xlabel="place, mm", ylabel="place, mm", aspect="equal")
    style.legend_above(right)
    return canvas


FIGURES = [
    Figure(
        "collar",
        "Left: forward whirl of an unbalanced collar that its bit centres. Ω² over the radius falls linearly with Ω² "
        "to zero at the critical speed. Right: the lower end of a collar that is kicked from the axis of the hole, "
        "strikes the wall and rolls round it backwards.",
        collar,
    )
]
