"""A point dragged through a bend: cylinders with overlap (Fig. 8) and without; many points through random bends."""

import numpy as np
import pandas as pd

from fctd import build_wellbore, find_contacts
from fctd.mechanics import state, stored_walls
from fctd.model.frames import hole_frame
from references.contact.for_loop import for_loop_owners
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts import drags

LENGTH = 2.0  # of the cylinders [m]
OVERLAP = 0.2  # [m]
OFFSET = 0.11  # of the point from the axis, outwards [m]
RADIUS = 0.051  # of the string [m]
SEED = 14  # of the random bends


def run(context: Context) -> Outcome:
    """Force and direction on a point moved along the exact bend at constant penetration of its wall."""
    exact = build_wellbore(load("curved_chain", wellbore__geometry="arcs"))
    md = np.arange(1920.0, 1930.0, 0.01 if context.quick else 0.002)
    axis, tangent = exact.at(md)
    points = axis - OFFSET * hole_frame(tangent)[0]
    truth = find_contacts(exact, points, RADIUS)
    rows = []
    for overlap in (OVERLAP, 0.0):
        hole = build_wellbore(
            load(
                "curved_chain",
                wellbore__chord_tolerance=None,
                wellbore__cylinder_length=LENGTH,
                wellbore__overlap=overlap,
            )
        )
        hits = find_contacts(hole, points, RADIUS)
        force = 1e7 * np.maximum(hits.penetration, 0.0)
        # Without overlap the paper's search finds no owner on the outside of a seam, and so no wall.
        force[for_loop_owners(hole.pieces, points) < 0] = 0.0
        tilt = np.arcsin(np.clip(np.sum(hits.normal * tangent, axis=1), -1, 1))
        rows.append(
            pd.DataFrame(
                {
                    "s_m": md - md[0],
                    "overlap": overlap,
                    "contact_force_N": force,
                    "direction_deg": np.degrees(tilt),
                }
            )
        )
    drag = pd.concat(rows)
    full = 1e7 * float(truth.penetration.mean())

    def jump(overlap: float, column: str) -> float:
        values = drag[drag["overlap"] == overlap][column].to_numpy()
        return float(np.abs(np.diff(values)).max())

    millimetres = 1e3 * (md[1] - md[0])
    count = 10_000 if context.quick else 100_000
    batches = drags.campaign(count, SEED)
    campaign = pd.DataFrame(context.progress(batches, "bends"))
    bare = drags.bend(np.random.default_rng(SEED), "cylinders", overlap=0.0)
    lost = drags.leaks(bare, drags.drag(bare, 1000, np.random.default_rng(SEED), paper_search))
    return Outcome(
        tables={"drag": drag, "campaign": campaign},
        checks=[
            Check("largest change of force in a step with overlap", 100 * jump(OVERLAP, "contact_force_N") / full,
                  1.0 * millimetres / 2, "at_most", "%", f"no jump in {millimetres:.0f} mm"),
            Check("largest change of direction in a step with overlap", jump(OVERLAP, "direction_deg"),
                  0.01 * millimetres / 2, "at_most", "deg", f"no jump in {millimetres:.0f} mm"),
            Check("largest change of force without overlap", 100 * jump(0.0, "contact_force_N") / full,
                  50.0, "at_least", "%", "the gap of Fig. 8"),
            Check("largest change of direction without overlap", jump(0.0, "direction_deg"),
                  0.2, "at_least", "deg", "the kink of 2 m cylinders in this bend: 0.4 deg"),
            Check("points that leave the hole in random bends", float(campaign["leaks"].sum()),
                  0.0, "at_most", "", f"none of {count} drags, half of them in cylinders and half in arcs"),
            Check("points that a wrong piece owns in random bends", float(campaign["wrong_owners"].sum()),
                  0.0, "at_most", "", "the piece reaches as far as the point was dragged"),
            Check("points that leave a hole without overlap, by the paper's search", float(lost.sum()),
                  1.0, "at_least", "", "the gap of Fig. 8, in one of these bends"),
        ],
        notes=[
            "Direction is the tilt of the wall's normal along the hole; it is zero for the exact wall.",
            "Random bends turn in space by up to 30° in 30 m, with a casing shoe, cylinders of 0.3 to 3 m and overlaps "
            "of 0.02 m to nearly a cylinder. Each point is moved along the exact axis, up to 0.3 m a step, while a "
            "turning side force presses it against the wall by up to 20 mm. It leaves the hole if the wall is ever "
            "found elsewhere than it is by more than the chords and overlaps of the cylinders explain (in arcs: by "
            "more than rounding), or if it ends that much beyond the wall and the penetration that the force asks for.",
        ],
    )  # fmt: skip


def paper_search(S, owner, n, packed, C, geometry):  # type: ignore[no-untyped-def]
    """``stored_walls.update_walls`` where the paper's FOR-loop finds an owner, and no wall where it finds none."""
    stored_walls.update_walls(S, owner, n, packed, C, geometry)
    points = np.stack([state.row(S, of, n) for of in (state.X, state.Y, state.Z)], axis=1)
    state.row(S, state.HOLE, n)[for_loop_owners(C, points) < 0] = np.inf


STUDY = Study(
    "overlap", "Does the overlap of cylinders remove gaps and jumps of the contact force?", run, reproduce=True
)
