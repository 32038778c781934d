"""Where a buckled pipe comes off the wall of its hole, and how hard it presses, against Mitchell's equation."""

from collections.abc import Callable

import pandas as pd
from scipy.optimize import brentq

from references.buckling import mitchell
from references.buckling.onset import Pipe
from validation.harness.study import Check
from validation.parts.buckled_pipe import BUCKLING
from validation.parts.half_waves import ALLOWED, SOURCE

# Shape of a pipe, the path of load on which it comes off, and Mitchell's shape at a compression, of waves of a length.
Closed = Callable[[Pipe, float, float], mitchell.Shape]
PATHS: tuple[tuple[str, str, Closed], ...] = (
    ("snaking", "loading", mitchell.snaking),
    ("helix", "unloading from a helix", mitchell.helix),
)


def limit_of(shape: Closed, near: float, wave: float) -> float:
    """The load times the onset, near another one, at which the wall force of waves of a length [m] first vanishes."""

    def least(ratio: float) -> float:
        return float(shape(BUCKLING, ratio * BUCKLING.onset, wave).wall_force.min())

    return float(brentq(least, 0.9 * near, 1.1 * near, xtol=1e-4))


def coming_off(path: pd.DataFrame, shape: str) -> tuple[float, float]:
    """The load times the onset at which a pipe comes off, and the length of its waves [m] at the load before.

    Its least wall force vanishes there, by the last two loads at which it lies on the wall everywhere.
    """
    touches = (path["shape"] == shape) & (path["off_wall_percent"] == 0)
    (before, after), force = (
        path[touches.cummin()].tail(2)[column] for column in ("times_onset", "least_wall_force_over_weight")
    )
    return float(after + (after - before) * force.iloc[1] / (force.iloc[0] - force.iloc[1])), float(
        path.loc[force.index[1], "wave_m"]
    )


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The loads at which it comes off, along the paths of load, and the mean wall force of snaking.

    A string that is loaded or unloaded keeps its number of waves, and which number that is depends on rounding: the
    equation is therefore solved for waves as long as they are.
    """
    paths, found = tables["paths"], []
    for shape, path, closed in PATHS:
        load, wave = coming_off(paths[paths["path"] == path], shape)
        off = 100 * abs(load / limit_of(closed, load, wave) - 1)
        found.append(
            Check(f"load at which {shape} comes off the wall", off, 3.0, "at_most", "%",
                  "Mitchell's equation for waves of that length, within 3 %")
        )  # fmt: skip
    worst = float(tables["snaking"]["wall_force_off_percent"].abs().max())
    return [*found, Check("wall force of snaking, largest difference", worst, ALLOWED, "at_most", "%", SOURCE)]
