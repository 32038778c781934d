"""Decay of the twisting of a rotating string in mud."""

from reports.figures import Canvas, Figure, Tables, style


def decay(tables: Tables) -> Canvas:
    """Surface torque after a quick start, without mud's damping and with two viscosities."""
    histories = tables["histories"]
    viscosities = sorted(histories["viscosity_Pa_s"].unique())
    height = 1.0 + 1.4 * len(viscosities)
    canvas, axes = style.subplots(height, len(viscosities), sharex=True, sharey=True, squeeze=False)
    for index, (ax, viscosity) in enumerate(zip(axes[:, 0], viscosities, strict=True)):
        rows = histories[histories["viscosity_Pa_s"] == viscosity]
        look = {**style.line(index), "linestyle": "-", "linewidth": 1}
        ax.plot(rows["time_s"], rows["surface_torque_N_m"] / 1e3, **look)
        ax.set_title(f"mud of {1e3 * viscosity:.0f} mPa s" if viscosity else "no damping")
    axes[len(axes) // 2, 0].set_ylabel("surface torque, kN·m")
    axes[-1, 0].set_xlabel("time, s")
    return canvas


FIGURES = [
    Figure(
        "decay",
        "The paper's string starts to turn within 2 s with the bit at 2450 m. Coulomb's friction, whose torque does "
        "not grow with speed, does not damp the twisting; the mud does.",
        decay,
    )
]
