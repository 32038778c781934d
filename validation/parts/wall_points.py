"""The hole of the studies of contact, points near its wall, and usual calls of libraries that give wrong results."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fctd import Case
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import Frame, beside, case_of, frame
from references.contact import traps
from references.contact.frames import TURN
from validation.harness.study import Rows, table_of_rows

HOLE = 0.1556  # hole radius [m]
# Vertical, a build and then a turn of 286 m radius (20°/100 m, as sharp as the paper's); depths in the hole of TURN.
REGIONS = {"straight": (10.0, 190.0), "build": (205.0, 495.0), "turn in space": (505.0, 735.0)}
OVERLAP = "overlap"  # the first 0.2 m of the cylinders of 2 m that stand for build and turn
SEED = 20240525


def the_case(deeper: float = 0.0) -> Case:
    """The hole of exact arcs, its bends ``deeper`` [m]; the meshes and the cylinders are made from it."""
    stations = [TURN[0], *([md + deeper, *angles] for md, *angles in TURN[1:])]
    return case_of("build and turn", stations, [(stations[-1][0], 2 * HOLE)])


def near_wall(case: Case, count: int) -> tuple[Frame, NDArray[np.str_]]:
    """Points near the wall, ``count`` in each region and as many where cylinders overlap, in random order.

    Returns their frame, and the region (n,) of each.
    """
    hole = ExactHole(case.wellbore, case.solver.perturbed)
    rng = np.random.default_rng(SEED)
    parts = [frame(hole, count, md=md, seed=SEED + k) for k, md in enumerate(REGIONS.values())]
    begins = 200.0 + 2.0 * rng.integers(3, 265, count) + rng.uniform(0.0, 0.2, count)
    parts.append(beside(hole, begins, rng))
    order = rng.permutation(len(parts) * count)
    md, places, radii = (np.concatenate([getattr(part, name) for part in parts]) for name in ("md", "places", "radii"))
    regions = np.repeat(np.array([*REGIONS, OVERLAP]), count)
    return Frame(hole, md, places, radii).part(order), regions[order]


@table_of_rows
def tried(trapped: Sequence[traps.Trap]) -> Rows:
    """Usual calls of libraries that give wrong results, a row each; without a number where a package is missing."""
    at = traps.scene()
    for trap in trapped:
        yield {
            "package": trap.distribution,
            "tried": trap.tried,
            "what_is_measured": trap.measure.__doc__.splitlines()[0] if trap.measure.__doc__ else "",
            "found": traps.measure(trap, at) if traps.installed(trap) else np.nan,
            "unit": trap.unit,
            "used_instead": trap.instead,
        }
