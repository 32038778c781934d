"""Hook load of trips of real wells against the steady string."""

from fctd.plots.palette import LOOKS
from reports.figures import Canvas, Figure, Tables, style

NAMES = {"trip_in": "tripping in", "trip_out": "tripping out"}
ALLOWED = 0.5  # of the string's weight, percent


def hook_load(tables: Tables) -> Canvas:
    """Means of the stepper and the steady string by well (above), and their difference (below)."""
    strokes = tables["strokes"]
    wells = list(dict.fromkeys(strokes["well"]))
    canvas, axes = style.subplots(5.4, 2, len(wells), squeeze=False, height_ratios=(3, 2))
    for (load, off), well in zip(axes.T, wells, strict=True):
        for kind, rows in strokes[strokes["well"] == well].groupby("operation"):
            colour, marker = LOOKS[str(kind)]
            rows = rows.sort_values("bit_depth_m")
            line = {"color": colour, "linestyle": style.DASHES[0 if kind == "trip_in" else 1], "linewidth": 1.2}
            load.plot(rows["bit_depth_m"], rows["steady_hookload_kN"], **line, label=f"{NAMES[str(kind)]}, steady")
            look = {"linestyle": "none", "marker": marker, "color": colour, "markerfacecolor": "white"}
            load.plot(rows["bit_depth_m"], rows["hookload_kN"], **look, label=f"{NAMES[str(kind)]}, in time")
            off.plot(rows["bit_depth_m"], rows["off_percent_of_weight"], **look)
        load.set(title=well, ylim=(0, None))
        for sign in (1, -1):
            off.axhline(sign * ALLOWED, **style.BOUND)
        off.axhline(0, **style.ZERO)
        off.set(xlabel="bit depth, m", ylim=(-1.3 * ALLOWED, 1.3 * ALLOWED))
    axes[0, 0].set_ylabel("hook load below the table, kN")
    axes[1, 0].set_ylabel("off, % of the weight")
    style.legend_outside(canvas, axes[0, 0], columns=2)
    return canvas


FIGURES = [
    Figure(
        "hook_load",
        "Trips in and out, stand by stand, of real surveys with the same pipe. Above: the mean hook load of a stroke, "
        "less the weight in air of the pipe above the rotary table, and that of the steady string. Below: their "
        "difference; dashed: the bounds.",
        hook_load,
    )
]
