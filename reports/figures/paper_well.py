"""The paper's well: torque and hook load while the string goes in, and where the string touches the wall."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from reports import words
from reports.figures import Canvas, Figure, Tables, style

WELL, WELL_B = "paper-well", "paper-well-b"
BIT_DEPTHS_M = (1750.0, 2450.0)


def torque(tables: Tables) -> Canvas:
    """The paper's Fig. 12 in both readings of its model curve."""
    canvas, ax = style.subplots(3.9)
    _series(ax, tables["trip_in"], "sum_r_mu_fn_N_m", 0, "(a)", "law paper, tripping in: Σ rμFₙ")
    _series(ax, tables["rotating"], "surface_torque_N_m", 1, "(b)", "law coulomb, rotating: surface torque")
    _against_bit_depth(ax, "torque, kN·m")
    ax.set_ylim(bottom=0)
    return canvas


def hook_load(tables: Tables) -> Canvas:
    """Hook load over the same depths."""
    canvas, ax = style.subplots(3.6)
    _series(ax, tables["trip_in"], "hookload_N", 0, "(a)", "law paper, tripping in")
    _series(ax, tables["rotating"], "hookload_N", 1, "(b)", "law coulomb, rotating off bottom")
    _against_bit_depth(ax, "hook load, kN")
    return canvas


def contact(tables: Tables) -> Canvas:
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


FIGURES = [
    Figure(
        "torque",
        "Paper's Fig. 12, for both readings of its model curve: (a) "
        "friction law “paper” while tripping in, the sum of rμFₙ over all contacts; (b) law “coulomb”, "
        "the torque at the surface while rotating off bottom at each depth. Thin lines: well b, with "
        "both builds at 16° per 100 m. The measured points of the paper are not public.",
        torque,
    ),
    Figure(
        "hook_load",
        "Hook load over the same depths, going in and rotating off bottom. Thin lines: well b. It swings where all "
        "collars pass seams between cylinders at a natural frequency of the string, an artefact of the cylinders.",
        hook_load,
    ),
    Figure(
        "contact",
        "Where the string touches, and how hard, at three bit depths. Each stem is a segment's end that "
        "touches the wall: upwards on the high side, downwards on the low side. Shaded: the hole bends. "
        "The dotted line is the bit.",
        contact,
    ),
]
