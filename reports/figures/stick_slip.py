"""Thresholds of stick-slip by weight on bit and drive, and one cycle against an ODE."""

from reports.figures import Canvas, Figure, Tables, style

DRIVES = {"stiff": "stiff", "speed_control": "speed control", "impedance": "impedance"}
SHOWN = 12.0  # of the cycle [s]


def threshold(tables: Tables) -> Canvas:
    """Rotation below which a bit sticks and slips: linear stability as lines, the engine as marks."""
    table = tables["thresholds"]
    canvas, ax = style.subplots(3.6)
    for index, (drive, name) in enumerate(DRIVES.items()):
        rows = table[table["drive"] == drive].sort_values("weight_on_bit_kN")
        ax.plot(rows["weight_on_bit_kN"], rows["linear_rpm"], **style.line(index), label=f"{name}, linear stability")
        ax.plot(rows["weight_on_bit_kN"], rows["engine_rpm"], **style.dots(index, filled=False), markersize=8,
                label=f"{name}, engine")  # fmt: skip
    ax.set(xlabel="weight on bit, kN", ylabel="threshold, rev/min", ylim=(0, None))
    style.legend_above(ax, columns=3)
    return canvas


def cycle(tables: Tables) -> Canvas:
    """The spin of the bit in slow rotation, each from a break-away of its own."""
    table = tables["cycles"]
    canvas, ax = style.subplots(2.8)
    for index, (by, rows) in enumerate(table.groupby("by")):
        time, spin = rows["time_s"].to_numpy(float), rows["bit_rpm"].to_numpy(float)
        half = 0.5 * spin.max()
        rises = time[1:][(spin[:-1] < half) & (spin[1:] >= half)]
        since = time - rises[rises < time[-1] - SHOWN][-1]
        shown = (since > -1) & (since < SHOWN - 1)
        name = "engine, two discs" if by == "engine" else "ordinary differential equation"
        look = style.line(index) | {"linewidth": 1.2 + 1.6 * index, "zorder": 3 - index}
        ax.plot(since[shown], spin[shown], **look, label=name)
    ax.set(xlabel="time from a break-away, s", ylabel="bit, rev/min")
    style.legend_above(ax)
    return canvas


FIGURES = [
    Figure(
        "threshold",
        "Rotation below which small swings of the bit grow, over weight on bit, for three drives of the rig. Lines: a "
        "torsional wave that comes back larger than it went; marks: where the swing of the engine's string neither "
        "grows nor decays.",
        threshold,
    ),
    Figure(
        "cycle",
        "Rotation of the bit below a stiff drive that turns at half of the threshold: the bit sticks and slips. Engine "
        "and scipy's solution of the same two discs.",
        cycle,
    ),
]
