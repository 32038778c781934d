"""A chain of segments through one bend: differences of stiff and soft string, and where the chain touches."""

import itertools

import matplotlib.lines
import numpy as np

from reports import words
from reports.figures import Canvas, Figure, Tables, style


def differences(tables: Tables) -> Canvas:
    """A dot for each run: its difference from the soft string in hook load and in torque."""
    numbers = tables["numbers"]
    laws = list(numbers["law"].unique())
    geometries = list(numbers["geometry"].unique())
    operations = list(numbers["operation"].unique())
    rows = list(itertools.product(operations, geometries))

    canvas, axes = style.subplots(1.5 + 0.36 * len(rows), 1, 2, sharey=True)
    for ax, column, label in zip(
        axes,
        ("hookload_difference_percent", "torque_difference_percent"),
        ("difference in hook load, %", "difference in torque, %"),
        strict=True,
    ):
        for height, (operation, geometry) in enumerate(rows):
            for index, law in enumerate(laws):
                chosen = numbers[
                    (numbers["operation"] == operation) & (numbers["geometry"] == geometry) & (numbers["law"] == law)
                ]
                # Laws differ by marker and slightly by height, since they often agree.
                shift = 0.16 * (index - (len(laws) - 1) / 2)
                ax.plot(
                    chosen[column],
                    np.full(len(chosen), height + shift),
                    **style.dots(style.LAWS[law]),
                    markersize=6,
                )
        ax.axvline(0, **style.ZERO)
        for edge in range(len(geometries), len(rows), len(geometries)):
            ax.axhline(edge - 0.5, color=style.QUIET, linewidth=0.5)
        ax.set_xlabel(label)
        ax.margins(x=0.12)
    style.rows_downwards(axes[0], [f"{words.name(operation)}, {geometry}" for operation, geometry in rows])
    handles = [
        matplotlib.lines.Line2D([], [], **style.dots(style.LAWS[law]), markersize=6, label=f"law {law}") for law in laws
    ]
    canvas.legend(handles=handles, loc="outside upper left", ncols=len(laws))
    return canvas


def contact(tables: Tables) -> Canvas:
    """Contact force and angle along the chain: rows are operations."""
    profiles = tables["profiles"]
    operations = list(profiles["operation"].unique())
    canvas, grid = style.subplots(
        0.9 + 1.9 * len(operations), len(operations), 2, sharex=True, sharey="col", squeeze=False
    )
    for (force, angle), operation in zip(grid, operations, strict=True):
        at = profiles[profiles["operation"] == operation]
        for law in sorted(at["law"].unique(), key=style.LAWS.__getitem__):
            index, profile = style.LAWS[law], at[at["law"] == law]
            force.plot(profile["md_m"], profile["contact_force_N"] / 1e3, **style.line(index), label=f"law {law}")
            touching = profile[profile["contact_force_N"] > 0]
            turned = style.unrolled(touching["contact_angle_deg"])
            angle.plot(touching["md_m"], turned, **style.dots(index, filled=index == 0), markersize=3)
        force.set(title=words.name(operation), ylabel="contact force, kN")
        angle.set_yticks(style.SIDES, [label.replace("\n", " ") for label in style.SIDE_LABELS])
        angle.set(ylabel="contact angle", ylim=(-90, 270))
    touched = profiles[profiles["contact_force_N"] > 0]
    grid[0][0].set_ylim(0, 1.05 * touched["contact_force_N"].max() / 1e3)
    for ax in grid[-1]:
        # Nothing touches above the first contact.
        ax.set(xlabel="measured depth, m", xlim=(touched["md_m"].min() - 50, profiles["md_m"].max() + 20))
    style.legend_outside(canvas, grid[0][0], columns=3)
    return canvas


FIGURES = [
    Figure(
        "differences",
        "Stiff string against soft string: the difference in hook load and in surface torque for each "
        "operation, wellbore geometry and friction law. A dot on the line at zero agrees with the soft "
        "string. Where the soft string has no torque there is no dot.",
        differences,
    ),
    Figure(
        "contact",
        "Contact force (left) and the side of the hole that the chain touches (right) along the chain. 0° is "
        "the high side, 90° is to the right looking downhole; end points without contact have no angle.",
        contact,
    ),
]
