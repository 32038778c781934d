"""Where a buckled pipe comes off the wall of its hole, and how hard it presses, against Mitchell's equation."""

import pandas as pd

from references.buckling import mitchell
from validation.harness.study import Check
from validation.parts.half_waves import ALLOWED, SOURCE


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The loads between which it comes off, along the paths of load, and the mean wall force of snaking."""
    paths, waves = tables["paths"], tables["snaking"]
    found = []
    for shape, path, exact in (
        ("snaking", "loading", mitchell.wall_contact_limit()),
        ("helix", "unloading from a helix", mitchell.helix_contact_limit()),
    ):
        part = paths[(paths["path"] == path) & (paths["shape"] == shape)]
        is_off = part["off_wall_percent"] > 0
        first = part.loc[is_off, "times_onset"].iloc[0]
        last = part.loc[~is_off, "times_onset"].iloc[-1]
        found.append(
            Check(f"{shape} comes off the wall, times the onset", float(0.5 * (first + last)),
                  (0.97 * exact, 1.03 * exact), "within", "", "Mitchell's equation, within 3 %")
        )  # fmt: skip
    worst = float(waves["wall_force_off_percent"].abs().max())
    return [*found, Check("wall force of snaking, largest difference", worst, ALLOWED, "at_most", "%", SOURCE)]
