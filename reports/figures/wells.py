"""Whole wells: the paper's and surveyed ones."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from fctd.plots.palette import LOOKS
from reports import words
from reports.figures import Canvas, Tables, figure, style

PRINTED_DEPTHS_M = (1700.0, 1750.0, 2450.0, 4300.0)  # §6.2


@figure(
    "well_profile",
    name="profile",
    caption=(
        "Paper's Fig. 11: the deviated well of the validation, as we read §6.2 (well b: both builds at 16° per 100 m). "
        "Left: its vertical plane at equal scales. Right: inclination along the hole. Marks are ends of builds; "
        "dashed: the depths that the paper prints."
    ),
    checks=("*of paper-well*",),
)
@style.panels(4.4, 1, 2, width_ratios=(3, 2))
def profile(tables: Tables, plane: Axes, angle: Axes) -> None:
    """Fig. 11: true vertical depth against departure, and inclination against measured depth."""
    table = tables["wells"]
    for index, variant in enumerate(table["variant"].unique()):
        rows = table[table["variant"] == variant]
        plane.plot(rows["departure_m"], rows["tvd_m"], **style.line(index), label=str(variant))
        angle.plot(rows["inclination_deg"], rows["md_m"], **style.line(index))
        bends = style.build_intervals(rows["md_m"].to_numpy(float), rows["inclination_deg"].to_numpy(float))
        ends = rows[rows["md_m"].isin([depth for bend in bends for depth in bend])]
        plane.plot(ends["departure_m"], ends["tvd_m"], **style.dots(index, filled=False))
        angle.plot(ends["inclination_deg"], ends["md_m"], **style.dots(index, filled=False))
    for depth in PRINTED_DEPTHS_M:
        angle.axhline(depth, **style.BOUND, zorder=0)
    plane.set_aspect("equal", adjustable="datalim")
    plane.set(xlabel="departure along azimuth 45°, m")
    style.depth_downwards(plane, "true vertical depth, m")
    angle.set(xlabel="inclination, °", xticks=[0, 30, 60, 90])
    style.depth_downwards(angle)
    style.legend_above(plane)


WELL, WELL_B = "paper-well", "paper-well-b"
BIT_DEPTHS_M = (1750.0, 2450.0)
PRINTED = 0.1  # §7: the paper's predictions were within 10 % of the measured torque


@figure(
    "paper_well",
    name="torque",
    caption=(
        "Paper's Fig. 12, for both readings of its model curve: (a) "
        "friction law “paper” while tripping in, the sum of rμFₙ over all contacts; (b) law “coulomb”, "
        "the torque at the surface while rotating off bottom at each depth. Thin lines: well b, with "
        "both builds at 16° per 100 m; where (a) of well b thickens, from 2150 m on, it swings: all collars pass seams "
        "between cylinders at a natural frequency of the string, an artefact of the cylinders. Band: 10 % on either "
        "side, within which the paper says that its measured points lie; they are not public."
    ),
    checks=("Σ r F_t*", "runs that did not complete"),
)
@style.panels(3.9)
def torque(tables: Tables, ax: Axes) -> None:
    """The paper's Fig. 12 in both readings of its model curve."""
    _series(ax, tables["trip_in"], "sum_r_mu_fn_N_m", 0, "(a)", "law paper, tripping in: Σ rμFₙ")
    _series(ax, tables["rotating"], "surface_torque_N_m", 1, "(b)", "law coulomb, rotating: surface torque")
    for index, (table, column) in enumerate((("trip_in", "sum_r_mu_fn_N_m"), ("rotating", "surface_torque_N_m"))):
        rows = tables[table][tables[table]["variant"] == WELL].sort_values("bit_depth_m")
        torque = rows[column] / 1e3
        ax.fill_between(
            rows["bit_depth_m"], (1 - PRINTED) * torque, (1 + PRINTED) * torque, color=style.COLOURS[index],
            alpha=0.12, linewidth=0,
        )  # fmt: skip
    _against_bit_depth(ax, "torque, kN·m")
    ax.set_ylim(bottom=0)


@figure(
    "paper_well",
    name="hook_load",
    caption=(
        "Hook load over the same depths, going in and rotating off bottom. Thin lines: well b. It swings where all "
        "collars pass seams between cylinders at a natural frequency of the string, an artefact of the cylinders."
    ),
    checks=("energy error*",),
)
@style.panels(3.6)
def paper_hook_load(tables: Tables, ax: Axes) -> None:
    """Hook load over the same depths."""
    _series(ax, tables["trip_in"], "hookload_N", 0, "(a)", "law paper, tripping in")
    _series(ax, tables["rotating"], "hookload_N", 1, "(b)", "law coulomb, rotating off bottom")
    _against_bit_depth(ax, "hook load, kN")


@figure(
    "paper_well",
    name="contact",
    caption=(
        "Where the string touches, and how hard, at three bit depths. Each stem is a segment's end that "
        "touches the wall: upwards on the high side, downwards on the low side. Shaded: the hole bends. "
        "The dotted line is the bit."
    ),
)
def paper_contact(tables: Tables) -> Canvas:
    """Contact force at each end point of the string: rows are bit depths, columns operations."""
    profiles = tables["profiles"]
    profiles = profiles[profiles["variant"] == WELL]
    operations = list(profiles["operation"].unique())
    depths = _first_middle_last(profiles["bit_depth_m"])
    touching = profiles[profiles["contact_force_N"] > 0]
    deepest = profiles[profiles["bit_depth_m"] == depths[-1]]

    canvas, grid = style.subplots(
        1.0 + 1.7 * len(depths), len(depths), len(operations), sharex=True, sharey=True, squeeze=False
    )
    for row, depth in zip(grid, depths, strict=True):
        for ax, operation in zip(row, operations, strict=True):
            at = profiles[(profiles["bit_depth_m"] == depth) & (profiles["operation"] == operation)]
            style.shade_builds(ax, deepest["md_m"].to_numpy(float), deepest["inclination_deg"].to_numpy(float))
            _stems(ax, at)
            ax.axvline(depth, **style.line(2), linewidth=1)
            ax.set_title(f"{words.name(operation)}, bit at {depth:.0f} m")
    for ax in grid[-1]:
        # Nothing touches above the first contact, and the bends need the room.
        ax.set(xlabel="measured depth, m", xlim=(touching["md_m"].min() - 50, depths[-1] + 50))
    canvas.supylabel("contact force, kN (up: high side, down: low side)", fontsize=9.5)
    return canvas


def _series(ax: Axes, table: pd.DataFrame, column: str, index: int, reading: str, what: str) -> None:
    """One reading for the well, and as a thinner line for its variant b."""
    for variant, label, look in (
        (WELL, f"{reading} {what}", {}),
        (WELL_B, f"{reading} well b", {"linewidth": 0.9, "alpha": 0.85}),
    ):
        rows = table[table["variant"] == variant].sort_values("bit_depth_m")
        if len(rows):
            ax.plot(rows["bit_depth_m"], rows[column] / 1e3, label=label, **style.line(index) | look)


def _against_bit_depth(ax: Axes, label: str) -> None:
    ax.set(xlabel="bit depth, m", ylabel=label, xlim=BIT_DEPTHS_M, xticks=np.arange(1750, 2451, 100))
    ax.legend(loc="best")


def _stems(ax: Axes, profile: pd.DataFrame) -> None:
    """A stem for each end point that touches, up where it touches the high side."""
    touching = profile[profile["contact_force_N"] > 0]
    high = np.cos(np.radians(touching["contact_angle_deg"])) > 0
    for index, sign, side in ((1, 1, touching[high]), (0, -1, touching[~high])):
        force = sign * side["contact_force_N"] / 1e3
        ax.vlines(side["md_m"], 0, force, color=style.COLOURS[index], linewidth=0.8)
        ax.plot(side["md_m"], force, **style.dots(index), markersize=2.5)
    ax.axhline(0, color=style.QUIET, linewidth=0.8)
    ax.yaxis.set_major_formatter(lambda force, _: f"{abs(force):g}")


def _first_middle_last(depths: "pd.Series[float]") -> list[float]:
    present = sorted(depths.unique())
    return list(dict.fromkeys((present[0], present[len(present) // 2], present[-1])))


@figure(
    "broomstick",
    name="chart",
    caption=(
        "The broomstick of the paper's well: hook load (left) and surface torque (right) over bit depth for three "
        "friction factors, by the steady solver."
    ),
)
def broomstick(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, a line for each operation and friction factor."""
    return style.chart(tables["chart"])


COLUMNS = ("hookload_stepped_kN", "torque_stepped_kN_m")


@figure(
    "steady_state",
    name="chart",
    caption=(
        "The paper's well by the steady solver: hook load (left) and surface torque (right), every 10 m; drilling with "
        "50 kN on the bit and 3 kN·m. Plus signs are the stepper's loads at the same depths."
    ),
)
def chart_and_stepper(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, lines from the solver, plus signs from the stepper."""
    canvas = style.chart(tables["chart"])
    for operation, rows in tables["compared"].groupby("operation"):
        colour, _ = LOOKS[str(operation)]
        for ax, column in zip(canvas.axes[:2], COLUMNS, strict=True):
            ax.plot(rows[column], rows["bit_depth_m"], "+", color=colour, markersize=12, markeredgewidth=1.5)
    return canvas


@figure("real_survey", name="history", caption="Surface torque and hook load over time, the string in a surveyed well.")
@style.panels(4.4, 2, 1, sharex=True)
def history(tables: Tables, torque: Axes, load: Axes) -> None:
    """Torque and hook load over time."""
    table = tables["history"]
    torque.plot(table["time_s"], table["surface_torque_N_m"] / 1e3, **style.line(0))
    torque.set_ylabel("surface torque, kN·m")
    load.plot(table["time_s"], table["hookload_N"] / 1e3, **style.line(0))
    load.set(xlabel="time, s", ylabel="hook load, kN")


@figure(
    "real_survey",
    name="contact",
    caption=(
        "Contact force (left) and the side of the hole that the string touches (right) at the end of the run, "
        "against measured depth. 0° is the high side, 90° is to the right looking downhole."
    ),
)
@style.panels(5.2, 1, 2, sharey=True, width_ratios=[3, 2])
def surveyed_contact(tables: Tables, force: Axes, angle: Axes) -> None:
    """Contact force and side against depth, drawn downwards."""
    table = tables["profiles"].sort_values("md_m")
    touching = table[table["contact_force_N"] > 0]
    force.hlines(touching["md_m"], 0, touching["contact_force_N"] / 1e3, color=style.COLOURS[0], linewidth=0.9)
    force.plot(touching["contact_force_N"] / 1e3, touching["md_m"], **style.dots(0), markersize=2.5)
    force.set(xlabel="contact force, kN", xlim=(0, None))
    angle.plot(style.unrolled(touching["contact_angle_deg"]), touching["md_m"], **style.dots(0), markersize=2.5)
    angle.set_xticks(style.SIDES, style.SIDE_LABELS)
    angle.set(xlabel="contact angle", xlim=(-90, 270))
    style.depth_downwards(force)


@figure(
    "real_chart",
    name="chart",
    caption=(
        "A real survey of 8,161 m with an assumed string and friction factor 0.2: hook load (left) and surface "
        "torque (right) of all operations. Open markers, if any, are rows that are not converged; the strip says why."
    ),
)
def real_chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, arcs geometry."""
    table = tables["chart"]
    return style.chart(table[table["geometry"] == "arcs"])


TRIPS = {"trip_in": "tripping in", "trip_out": "tripping out"}
ALLOWED = 0.5  # of the string's weight, percent


@figure(
    "trips",
    name="hook_load",
    caption=(
        "Trips in and out, stand by stand, of real surveys with the same pipe. Above: the mean hook load of a stroke, "
        "less the weight in air of the pipe above the rotary table, and that of the steady string. Below: their "
        "difference; dashed: the bounds."
    ),
)
def hook_load_of_trips(tables: Tables) -> Canvas:
    """Means of the stepper and the steady string by well (above), and their difference (below)."""
    strokes = tables["strokes"]
    wells = list(dict.fromkeys(strokes["well"]))
    canvas, axes = style.subplots(5.4, 2, len(wells), squeeze=False, height_ratios=(3, 2))
    for (load, off), well in zip(axes.T, wells, strict=True):
        for kind, rows in strokes[strokes["well"] == well].groupby("operation"):
            colour, marker = LOOKS[str(kind)]
            rows = rows.sort_values("bit_depth_m")
            line = {"color": colour, "linestyle": style.DASHES[0 if kind == "trip_in" else 1], "linewidth": 1.2}
            load.plot(rows["bit_depth_m"], rows["steady_hookload_kN"], **line, label=f"{TRIPS[str(kind)]}, steady")
            look = {"linestyle": "none", "marker": marker, "color": colour, "markerfacecolor": "white"}
            load.plot(rows["bit_depth_m"], rows["hookload_kN"], **look, label=f"{TRIPS[str(kind)]}, in time")
            off.plot(rows["bit_depth_m"], rows["off_percent_of_weight"], **look)
        load.set(title=well, ylim=(0, None))
        for sign in (1, -1):
            off.axhline(sign * ALLOWED, **style.BOUND)
        off.axhline(0, **style.ZERO)
        off.set(xlabel="bit depth, m", ylim=(-1.3 * ALLOWED, 1.3 * ALLOWED))
    axes[0, 0].set_ylabel("hook load below the table, kN")
    axes[1, 0].set_ylabel("off, % of the weight")
    style.legend_outside(axes[0, 0], columns=2)
    return canvas


LOADS = {"trip_out": "hook load, picking up", "trip_in": "hook load, slacking off",
         "rotate_off_bottom": "torque, rotating"}  # fmt: skip
PANELS = (("amplitude_mm", "wavelength_m", 10.0, "amplitude, mm", "waves of 10 m"),
          ("wavelength_m", "amplitude_mm", 20.0, "wavelength, m", "amplitude 20 mm"))  # fmt: skip


@figure(
    "tortuosity",
    name="apparent",
    caption=(
        "The friction factor with which a hole without waves has the hook load or torque of the winding one, whose "
        "own is 0.2. Mean, least and largest of the seeds."
    ),
)
@style.panels(3.6, 1, 2)
def apparent(tables: Tables, *axes: Axes) -> None:
    """Apparent factors over amplitude (left) and wavelength (right): mean, least and largest of the seeds."""
    table = tables["apparent_friction"]
    for ax, (over, fixed, value, label, title) in zip(axes, PANELS, strict=True):
        chosen = table[table[fixed] == value].groupby(over)
        for index, (kind, name) in enumerate(LOADS.items()):
            factors = chosen[f"{kind}_friction"]
            mean = factors.mean()
            colour, marker = LOOKS[kind]
            ax.errorbar(mean.index, mean, [mean - factors.min(), factors.max() - mean], color=colour, marker=marker,
                        linestyle=style.DASHES[index], capsize=3, label=name)  # fmt: skip
        ax.set(xlabel=label, ylabel="apparent friction factor, –", title=title)
        ax.margins(x=0.1)
    style.legend_outside(axes[0], columns=3)
