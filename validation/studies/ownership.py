"""Which cylinder owns a point: the paper's FOR-loop against the remembered one (§4.2)."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import build_wellbore
from fctd.mechanics.contact import LENGTH, START_MD
from references.contact.for_loop import for_loop_owners
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Study

WELLS: dict[str, list[list[float]]] = {
    "build to 60°": [[0, 0, 0], [300, 0, 0], [750, 60, 0], [1500, 60, 0]],
    "build to 90°": [[0, 0, 0], [300, 0, 0], [750, 90, 0], [1500, 90, 0]],
    "build to 120°": [[0, 0, 0], [300, 0, 0], [750, 120, 0], [1500, 120, 0]],
    "build to 120° from surface": [[0, 0, 0], [450, 120, 0], [1000, 120, 0]],
    "horizontal, turned by 80°": [[0, 0, 0], [450, 90, 0], [850, 90, 80], [1500, 90, 80]],
    "horizontal, turned by 150°": [[0, 0, 0], [450, 90, 0], [1050, 90, 75], [1650, 90, 150], [2500, 90, 150]],
}


def run(context: Context) -> Outcome:
    """Seeded points inside the hole; the owner by each rule."""
    count = 2000 if context.quick else 20_000
    rows: list[dict[str, Any]] = []
    for name, stations in context.progress(WELLS.items(), "wells"):
        size = [{"to_md": stations[-1][0], "diameter": 0.3112, "friction": 0.2}]
        hole = build_wellbore(
            load("curved_chain", wellbore__stations=stations, wellbore__intervals=size, operations=None)
        )
        rng = np.random.default_rng(4)
        md = rng.uniform(1.0, hole.total_depth - 1.0, count)
        angle, offset = rng.uniform(0, 2 * np.pi, count), 0.15 * np.sqrt(rng.uniform(0, 1, count))
        points = hole.off_axis(md, angle, offset)
        found = for_loop_owners(hole.pieces, points)
        wrong = found != hole.owners(points)
        # Without the engine's search: depths of the cylinder against the depth at which the point was placed.
        start, length = hole.pieces[found, START_MD], hole.pieces[found, LENGTH]
        elsewhere = np.abs(md - (start + 0.5 * length)) > length
        spread = np.degrees(np.arccos(np.clip(hole.directions @ hole.directions.T, -1, 1))).max()
        rows.append(
            {
                "well": name,
                "max_tangent_difference_deg": float(spread),
                "points": count,
                "wrong_owner_percent": 100 * float(wrong.mean()),
                "elsewhere_percent": 100 * float(elsewhere.mean()),
            }
        )
    owners = pd.DataFrame(rows)
    modest = owners[owners["max_tangent_difference_deg"] <= 90.01]
    return Outcome(
        tables={"owners": owners},
        checks=[
            Check("wrong owners where tangents differ by up to 90°", float(modest["wrong_owner_percent"].max()),
                  0.0, "at_most", "%", "a point passes the slabs of such cylinders in order"),
            Check("wrong owners in the worst well", float(owners["wrong_owner_percent"].max()),
                  0.0, "at_most", "%", "§4.2: the search finds the cylinder of the point"),
        ],
        notes=[
            "The paper takes the first cylinder from the top between whose end planes the point lies. Those planes "
            "are infinite: where the well turns back by more than 90° they cut its lower part again, and the "
            "FOR-loop assigns points there to a cylinder hundreds of metres away. The search from the remembered "
            "cylinder does not reach the distant one.",
            "A cylinder counts as elsewhere if the distance along the hole from its middle to the depth at which the "
            "point was placed exceeds its length: a second route to the same share, without the remembered cylinder.",
        ],
        display={"owners": "Points that the FOR-loop assigns to a wrong cylinder"},
    )  # fmt: skip


STUDY = Study("ownership", "Does the paper's FOR-loop find the right cylinder?", run, reproduce=True)
