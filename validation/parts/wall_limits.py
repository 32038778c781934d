"""Where a buckled pipe comes off the wall of its hole, and how hard it presses, against Mitchell's equation."""

from functools import cache

import pandas as pd

from references.buckling import mitchell
from validation.harness.study import Check
from validation.parts.half_waves import ALLOWED, SOURCE


@cache
def limits() -> dict[str, float]:
    """Times the onset: up to which snaking, and from which on a helix, lies on the wall everywhere."""
    return {"snaking": mitchell.wall_contact_limit(), "helix": mitchell.helix_contact_limit()}


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The loads between which it comes off, along the paths of load, and the mean wall force of snaking."""
    paths, found = tables["paths"], []
    for shape, path in (("snaking", "loading"), ("helix", "unloading from a helix")):
        exact = limits()[shape]
        part = paths[paths["path"] == path]
        touches = (part["shape"] == shape) & (part["off_wall_percent"] == 0)
        count = int(touches.cummin().sum())  # of the loads up to which the pipe lies on the wall everywhere
        between = float(part["times_onset"].iloc[count - 1 : count + 1].mean())
        found.append(
            Check(f"{shape} comes off the wall, times the onset", between, (0.97 * exact, 1.03 * exact), "within", "",
                  "Mitchell's equation, within 3 %")
        )  # fmt: skip
    worst = float(tables["snaking"]["wall_force_off_percent"].abs().max())
    return [*found, Check("wall force of snaking, largest difference", worst, ALLOWED, "at_most", "%", SOURCE)]
