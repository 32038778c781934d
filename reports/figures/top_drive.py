"""The share of a torque wave that the rig's drive reflects."""

from reports.figures import Canvas, Figure, Tables, style


def reflection(tables: Tables) -> Canvas:
    """Real and imaginary part of the reflected share over frequency, closed form and measured."""
    table = tables["reflection"]
    canvas, axes = style.subplots(3.6, 1, 2, sharey=True)
    # A drive whose inertia is hidden from the string reflects as one without inertia.
    for index, drive in enumerate(("no inertia", "full inertia")):
        rows = table[table["drive"] == drive]
        for ax, part in zip(axes, ("real", "imaginary"), strict=True):
            ax.plot(rows["frequency_Hz"], rows[f"exact_{part}"], **style.line(index), label=f"{drive}, (Z − ζ)/(Z + ζ)")
            ax.plot(rows["frequency_Hz"], rows[f"measured_{part}"], **style.dots(index, filled=False),
                    label=f"{drive}, measured")  # fmt: skip
    hidden = table[table["drive"] == "compensated"]
    for ax, part in zip(axes, ("real", "imaginary"), strict=True):
        ax.plot(hidden["frequency_Hz"], hidden[f"measured_{part}"], "+", color=style.COLOURS[2], markersize=7,
                label="compensated, measured")  # fmt: skip
        ax.set(xscale="log", xlabel="frequency, Hz", title=f"{part} part")
        style.plain_log_ticks(ax.xaxis)
    axes[0].set_ylabel("reflected share, –")
    style.legend_outside(canvas, axes[0], columns=3)
    return canvas


FIGURES = [
    Figure(
        "reflection",
        "A torque wave that runs up the pipe and comes back from an impedance drive: real and imaginary part of the "
        "share that is reflected, over frequency. A drive whose controller hides its inertia reflects as one without; "
        "with all of it, high frequencies come back.",
        reflection,
    )
]
