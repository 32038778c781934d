"""The friction factor that a winding hole seems to have."""

from fctd.plots.palette import LOOKS
from reports.figures import Canvas, Figure, Tables, style

NAMES = {"trip_out": "hook load, picking up", "trip_in": "hook load, slacking off",
         "rotate_off_bottom": "torque, rotating"}  # fmt: skip
PANELS = (("amplitude_mm", "wavelength_m", 10.0, "amplitude, mm", "waves of 10 m"),
          ("wavelength_m", "amplitude_mm", 20.0, "wavelength, m", "amplitude 20 mm"))  # fmt: skip


def apparent(tables: Tables) -> Canvas:
    """Apparent factors over amplitude (left) and wavelength (right): mean, least and largest of the seeds."""
    table = tables["apparent_friction"]
    canvas, axes = style.subplots(3.6, 1, 2)
    for ax, (over, fixed, value, label, title) in zip(axes, PANELS, strict=True):
        chosen = table[table[fixed] == value].groupby(over)
        for index, (kind, name) in enumerate(NAMES.items()):
            factors = chosen[f"{kind}_friction"]
            mean = factors.mean()
            colour, marker = LOOKS[kind]
            ax.errorbar(mean.index, mean, [mean - factors.min(), factors.max() - mean], color=colour, marker=marker,
                        linestyle=style.DASHES[index], capsize=3, label=name)  # fmt: skip
        ax.set(xlabel=label, ylabel="apparent friction factor, –", title=title)
        ax.margins(x=0.1)
    style.legend_outside(canvas, axes[0], columns=3)
    return canvas


FIGURES = [
    Figure(
        "apparent",
        "The friction factor with which a hole without waves has the hook load or torque of the winding one, whose "
        "own is 0.2. Mean, least and largest of the seeds.",
        apparent,
    )
]
