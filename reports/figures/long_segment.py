"""Starts from rest with one long vertical segment and with many short ones, and the frequencies of both."""

from reports.figures import Canvas, Figure, Tables, style

LOOKS = {"long": (1, "one long segment"), "cut twice as fine": (0, "segments of 18.75 m")}
PANELS = (
    ("rotate_off_bottom", "surface_torque_N_m", "surface torque, kN·m"),
    ("trip_in", "hookload_N", "hook load, kN"),
)


def start_up(tables: Tables) -> Canvas:
    """Torque of a string that starts to turn, hook load of one that starts to go in, both quickly."""
    histories = tables["histories"]
    quick = histories[histories["ramp_s"] == histories["ramp_s"].min()]
    canvas, axes = style.subplots(5.0, 2, 1, sharex=True)
    for ax, (operation, column, label) in zip(axes, PANELS, strict=True):
        for name, (index, title) in reversed(LOOKS.items()):
            rows = quick[(quick["operation"] == operation) & (quick["vertical"] == name)]
            ax.plot(rows["time_s"], rows[column] / 1e3, **style.line(index), label=title)
        ax.set_ylabel(label)
    axes[-1].set_xlabel("time, s")
    style.legend_above(axes[0])
    return canvas


def frequencies(tables: Tables) -> Canvas:
    """Differences of the lowest frequencies from those of the continuous string."""
    table = tables["frequencies"]
    canvas, axes = style.subplots(3.0, 1, 2, sharey=True)
    for ax, kind in zip(axes, table["kind"].unique(), strict=True):
        rows = table[table["kind"] == kind]
        ax.axhline(0, **style.ZERO)
        for index, column, label in ((1, "long", "one long segment"), (0, "cut", "segments of 37.5 m")):
            ax.plot(
                rows["continuous_Hz"], rows[f"{column}_off_percent"], **style.dots(index), markersize=7, label=label
            )
        ax.set(xlabel=f"{kind} frequency of the continuous string, Hz")
    axes[0].set_ylabel("frequency difference, %")
    style.legend_outside(canvas, axes[0])
    return canvas


FIGURES = [
    Figure(
        "start_up",
        "The paper's string with the bit at 2450 m started in 2 s: torque when it starts to turn (above), hook load "
        "when it starts to go in (below). Steady loads agree within a millionth; the long segment changes the waves.",
        start_up,
    ),
    Figure(
        "frequencies",
        "The four lowest axial and torsional frequencies of the hanging string, as differences from those of a "
        "continuous string with the same pipe and collars. With one long segment for the uppermost 750 m the higher "
        "ones are up to 10 % off.",
        frequencies,
    ),
]
