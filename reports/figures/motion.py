"""Strings in time: drives, mud, friction that sticks, whirl, drilling."""

import numpy as np
from matplotlib.axes import Axes

from reports.figures import Canvas, Tables, figure, style


@figure(
    "spin_up",
    name="torque",
    caption=(
        "Surface torque of 1000 m of pipe in a level hole that starts to turn at 2 rev/min: it builds up as friction "
        "is overcome further and further down, until all of the string turns."
    ),
)
@style.panels(2.9)
def torque(tables: Tables, ax: Axes) -> None:
    """Surface torque over time, by the engine and in closed form."""
    table = tables["torque"]
    ax.plot(table["time_s"], table["torque_kN_m"], **style.line(0) | {"linewidth": 1.1}, label="engine")
    ax.plot(table["time_s"], table["closed_form_kN_m"], **style.line(1), label="closed form without inertia")
    ax.set(xlabel="time, s", ylabel="surface torque, kN·m", ylim=(0, None))
    ax.legend(loc="lower right")


@figure(
    "top_drive",
    name="reflection",
    caption=(
        "A torque wave that runs up the pipe and comes back from an impedance drive: real and imaginary part of the "
        "share that is reflected, over frequency. A drive whose controller hides its inertia reflects as one without; "
        "with all of it, high frequencies come back."
    ),
)
@style.panels(3.6, 1, 2, sharey=True)
def reflection(tables: Tables, *axes: Axes) -> None:
    """Real and imaginary part of the reflected share over frequency, closed form and measured."""
    table = tables["reflection"]
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
    style.legend_outside(axes[0], columns=3)


@figure(
    "mud_effects",
    name="decay",
    caption=(
        "The paper's string starts to turn within 2 s with the bit at 2450 m. Coulomb's friction, whose torque does "
        "not grow with speed, does not damp the twisting; the mud does."
    ),
    checks=("decay rate*",),
)
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


DRIVES = {"stiff": "stiff", "speed_control": "speed control", "impedance": "impedance"}
CYCLE_SHOWN = 12.0  # of the cycle [s]


@figure(
    "stick_slip",
    name="threshold",
    caption=(
        "Rotation below which small swings of the bit grow, over weight on bit, for three drives of the rig. Lines: a "
        "torsional wave that comes back larger than it went; marks: where the swing of the engine's string neither "
        "grows nor decays."
    ),
)
@style.panels(3.6)
def threshold(tables: Tables, ax: Axes) -> None:
    """Rotation below which a bit sticks and slips: linear stability as lines, the engine as marks."""
    table = tables["thresholds"]
    for index, (drive, name) in enumerate(DRIVES.items()):
        rows = table[table["drive"] == drive].sort_values("weight_on_bit_kN")
        ax.plot(rows["weight_on_bit_kN"], rows["linear_rpm"], **style.line(index), label=f"{name}, linear stability")
        ax.plot(rows["weight_on_bit_kN"], rows["engine_rpm"], **style.dots(index, filled=False), markersize=8,
                label=f"{name}, engine")  # fmt: skip
    ax.set(xlabel="weight on bit, kN", ylabel="threshold, rev/min", ylim=(0, None))
    style.legend_above(ax, columns=3)


@figure(
    "stick_slip",
    name="cycle",
    caption=(
        "Rotation of the bit below a stiff drive that turns at half of the threshold: the bit sticks and slips. Engine "
        "and scipy's solution of the same two discs."
    ),
)
@style.panels(2.8)
def cycle(tables: Tables, ax: Axes) -> None:
    """The spin of the bit in slow rotation, each from a break-away of its own."""
    table = tables["cycles"]
    for index, (by, rows) in enumerate(table.groupby("by")):
        time, spin = rows["time_s"].to_numpy(float), rows["bit_rpm"].to_numpy(float)
        half = 0.5 * spin.max()
        rises = time[1:][(spin[:-1] < half) & (spin[1:] >= half)]
        since = time - rises[rises < time[-1] - CYCLE_SHOWN][-1]
        shown = (since > -1) & (since < CYCLE_SHOWN - 1)
        name = "engine, two discs" if by == "engine" else "ordinary differential equation"
        look = style.line(index) | {"linewidth": 1.2 + 1.6 * index, "zorder": 3 - index}
        ax.plot(since[shown], spin[shown], **look, label=name)
    ax.set(xlabel="time from a break-away, s", ylabel="bit, rev/min")
    style.legend_above(ax)


@figure(
    "sticking",
    name="belt_and_cake",
    caption=(
        "Left: period and amplitude of a body that sticks and slips on a belt, off the exact ones, over the step. "
        "Right: the pull that frees collars from 60 m of mud cake. With equal factors it is the closed form; with a "
        "higher static one the upper end breaks away first, and less is needed than for all of it at once."
    ),
)
@style.panels(3.4, 1, 2)
def belt_and_cake(tables: Tables, left: Axes, right: Axes) -> None:
    """Error of period and amplitude over the step (left); overpull over the ratio of the factors (right)."""
    belt, pulls = tables["belt"], tables["overpull"]
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


PATH_SHOWN = 0.6  # of the path [s]


@figure(
    "whirl",
    name="collar",
    caption=(
        "Left: forward whirl of an unbalanced collar that its bit centres. Ω² over the radius falls linearly with Ω² "
        "to zero at the critical speed. Right: the lower end of a collar that is kicked from the axis of the hole, "
        "strikes the wall and rolls round it backwards."
    ),
)
@style.panels(3.7, 1, 2)
def collar(tables: Tables, left: Axes, right: Axes) -> None:
    """The critical speed as the zero of Ω²/radius (left); the path of a body that rolls backwards (right)."""
    speeds, paths = tables["critical_speed"], tables["paths"]
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
        rows = rows[rows["time_s"] <= PATH_SHOWN]
        label = "engine" if name == "FCTD" else str(name)
        look = style.line(index) | {"linewidth": 1.2 + 1.6 * index}
        right.plot(1e3 * rows["x_m"], 1e3 * rows["y_m"], **look, label=label, zorder=3 - index)
    right.set(xlabel="place, mm", ylabel="place, mm", aspect="equal")
    style.legend_above(right)


WANTED = 150.0  # real-time factor of drilling 3 km


@figure(
    "drilling",
    name="law_and_cost",
    caption=(
        "Left: specific energy over drilling strength of runs that drill, on the line of the law of Detournay & "
        "Defournay. Right: simulated time over processor time with the bit on bottom, segments of 10 m."
    ),
)
@style.panels(3.3, 1, 2)
def law_and_cost(tables: Tables, left: Axes, right: Axes) -> None:
    """Specific energy over drilling strength (left); real-time factor over depth (right)."""
    drilled, speed = tables["drilling"].sort_values("drilling_strength_MPa"), tables["speed"]
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
