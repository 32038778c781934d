"""The swing of the hook load from seams between cylinders, and the frequencies that coincide there."""

from typing import Any

import pandas as pd

from reports.figures import Canvas, Figure, Tables, style

FROM_M = 1900.0  # above this depth the start of the trip still rings
SHADES = ("#8fc1e0", style.COLOURS[1], "black")
EXPECTED: dict[str, Any] = {"color": style.COLOURS[0], "linestyle": style.DASHES[1], "linewidth": 1.7}


def swing(tables: Tables) -> Canvas:
    """Hook load about its mean with the expected swing (above); the frequencies of string and seams (below)."""
    histories, expected, runs = tables["swing"], tables["expected"], tables["runs"]
    canvas, (load, tones) = style.subplots(5.6, 2, 1, sharex=True, height_ratios=(3, 2))
    histories = histories[histories["bit_depth_m"] > FROM_M]
    expected = expected[expected["bit_depth_m"] > FROM_M]
    # Hundreds of periods leave no room for dashes: the three lie one inside the other, the smallest on top.
    for order, (changed, rows) in enumerate(sorted(histories.groupby("changed"), key=_size, reverse=True)):
        load.plot(rows["bit_depth_m"], rows["swing_kN"], color=SHADES[order], linewidth=0.8, label=str(changed))
    for sign, label in ((1, "expected for the case's own"), (-1, None)):
        load.plot(expected["bit_depth_m"], sign * expected["swing_kN"], **EXPECTED, label=label)
    load.set_ylabel("hook load about its mean, kN")
    style.legend_above(load, columns=2)

    tones.plot(expected["bit_depth_m"], expected["first_frequency_Hz"], **style.line(0), label="first of the string")
    tones.axhline(0.5, color=style.QUIET, linewidth=1, linestyle=(0, (6, 2)), label="second of the seams")
    own = runs[runs["changed"] == "the case's own"]
    tones.plot(own["at_m"], own["frequency_Hz"], **style.dots(1), markersize=7, label="largest swing")
    tones.set(xlabel="bit depth, m", ylabel="frequency, Hz", xlim=(FROM_M, 2450))
    tones.legend(loc="upper right")
    return canvas


def _size(group: tuple[Any, pd.DataFrame]) -> float:
    return float(group[1]["swing_kN"].abs().max())


FIGURES = [
    Figure(
        "swing",
        "Well b tripping in at 0.5 m/s. Above: the hook load about its mean over 15 s, with the cylinders of the "
        "case, with collars of another length, and in arcs; dashed: the swing that the tilt of the cylinders causes "
        "in the undamped chain, without friction or a time step. Below: the first axial frequency of the string "
        "falls to the frequency at which all collars pass half a cylinder, 0.5 Hz.",
        swing,
    )
]
