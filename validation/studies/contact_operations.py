"""How many operations the contact test takes (abstract, §4.2): the paper's, the engine's, a mesh in a tree of boxes."""

from collections import Counter
from typing import Any

import numpy as np
import pandas as pd

from fctd.arrays import Array
from fctd.mechanics import state, stored_walls
from fctd.simulation.preparation import contact_points, prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import settle, start_from_rest
from references.contact import build, installed_version, own
from references.contact.box_tree import BoxTree, penetration
from references.contact.for_loop import for_loop_owner, for_loop_owners, one_cylinder
from references.contact.tube_mesh import TubeOptions, build_tube
from references.timing.operation_count import Counted, Number, arithmetic, counted, interpreted, operations_of
from references.timing.stopwatch import Action, in_rounds
from validation.cases import load, trip
from validation.harness.study import Check, Context, Outcome, Study, in_columns

# "At most two dot products and three arithmetic operations": a dot product is three products and two sums.
CLAIMED = 2 * 5 + 3
BIT = 2450.0
SPEED = 0.5  # [m/s] of the trip that ends there
PASSES = 4.0  # [s] in which every point of a bend passes one of its cylinders of 2 m
PARTS = ("add", "subtract", "multiply", "divide", "root", "compare")
FACETS = 24  # of the coarser mesh: rings miss a bend as cylinders do, facets the hole by a millimetre more
ONE, SEARCH = "paper: one cylinder, |PT|²", "paper's FOR-loop over cylinders from the top"
ASKING = "asking a library for nothing"  # the call from Python is no cost of the contact query
TREE, LIBRARY = f"mesh of {FACETS} facets: tree of boxes", f"mesh of {FACETS} facets: coal"


def paper_location(ab: Any, square: Any, at: Any) -> Any:
    """Eqs 5 and 10 for one cylinder: |PT|², None above or below it; square is |AB|², known beforehand."""
    q = ab[0] * at[0] + ab[1] * at[1] + ab[2] * at[2]
    if q < 0 or q > square:
        return None
    return at[0] * at[0] + at[1] * at[1] + at[2] * at[2] - q * q * (1 / float(square))


def paper_arm(a: Any, t: Any) -> Any:
    """AT."""
    return [t[i] - a[i] for i in range(3)]


def paper_penetration(away: Any, clearance: Any) -> Any:
    """Eq. 11, settled sign; clearance r_bh − r_ds."""
    return np.sqrt(away) - clearance


def paper_direction(a: Any, ab: Any, square: Any, q: Any, t: Any, distance: Any) -> Any:
    """Eqs 13 and 14: T − S over its length."""
    part = q * (1 / float(square))
    s = [a[i] + part * ab[i] for i in range(3)]
    k = 1 / distance
    return [k * (t[i] - s[i]) for i in range(3)]


def numbers(*values: float) -> list[Number]:
    """Numbers that count the operations on them."""
    return [Number(float(value)) for value in values]


def tripping() -> tuple[Run, Any]:
    """The paper's well in 61 segments after some seconds of tripping in, still in motion."""
    run, phases = prepare(load("paper_well", operations=trip(BIT - 10, BIT, SPEED, ramp=2.0)))
    settle(run)
    start_from_rest(run)
    run.advance(phases[0].motion, 2.0)
    motion = phases[1].motion
    run.advance(motion, 2.0)
    return run, motion


def paper_rows() -> list[dict[str, Any]]:
    """The paper's equations for one point in one cylinder."""
    a, ab, t = numbers(0.0, 0.0, 0.0), numbers(0.0, 0.0, 2.0), numbers(0.06, 0.02, 1.3)
    square, distance = Number(4.0), Number(0.063)
    parts = {
        "paper: one cylinder, |PT|² (Eqs 5, 10), AT given": operations_of(paper_location, ab, square, t),
        "paper: AT": operations_of(paper_arm, a, t),
        "paper: penetration (Eq. 11)": operations_of(paper_penetration, Number(0.004), Number(0.05)),
        "paper: unit direction (Eqs 13, 14)": operations_of(paper_direction, a, ab, square, Number(2.6), t, distance),
    }
    return [row(name, tally) for name, tally in parts.items()]


def engine_rows(run: Run, motion: Any, moments: int) -> list[dict[str, Any]]:
    """The engine's own helpers, means over all points and times of a trip; the FOR-loop at its last time."""
    n, pieces = run.segments, Counted(run.hole.pieces)
    follow, refresh = interpreted(stored_walls.follow_cylinders), interpreted(stored_walls.refresh_cylinders)
    place, loop = interpreted(state.contact_point), interpreted(for_loop_owner)
    write = interpreted(own._write)
    followed, looked_up, searched = Counter[str](), Counter[str](), Counter[str]()
    for _ in range(moments):
        # The next step starts its search from the owners of this step.
        run.advance(motion, PASSES / moments)
        S = Counted(state.copy_state(run.S))
        followed += operations_of(follow, S, n)
        looked_up += operations_of(refresh, S, run.owner.copy(), n, pieces)
    for j in range(1, n + 1):
        searched += operations_of(loop, pieces, *place(S, j))
    given = operations_of(place, S, 1)
    wall = (*numbers(0.04, 0.03, 0.0, 0.108, 1e7, 0.125, 1800.0, 0.125),)
    out = [Counted(np.empty(1)), Counted(np.empty((1, 3))), Counted(np.empty(1))]
    written = operations_of(write, 0, wall, Number(0.051), *out)
    normal = Counter(divide=1, multiply=3)
    points = n * moments
    mean = {
        "engine: PT from the cylinder remembered": _less(_share(followed, points), given),
        "engine: search, seldom more than two comparisons": _share(looked_up, points),
        "engine: penetration": _less(written, normal, Counter(compare=1)),
        "engine: unit direction": normal,
        SEARCH: _share(searched, n),
    }
    return [row(name, tally) for name, tally in mean.items()]


def mesh_rows(run: Run, facets: int) -> list[dict[str, Any]]:
    """The same points as spheres against the tube mesh."""
    tube = build_tube(run.case, TubeOptions(facets=facets))
    tree = BoxTree(np.asarray(tube.mesh.triangles))
    arrays, descend = [Counted(array) for array in (tree.low, tree.high, tree.corners)], interpreted(penetration)
    points, radii = spheres(run)
    tally, nodes, triangles = Counter[str](), 0, 0
    for point, radius in zip(points, radii, strict=True):
        (_, boxes, leaves), operations = counted(descend, *arrays, tree.first_leaf, *numbers(*point, radius))
        tally, nodes, triangles = tally + operations, nodes + boxes, triangles + leaves
    n = len(points)
    return [
        row(f"mesh of {facets} facets: tree of boxes", _share(tally, n))
        | {"boxes": nodes / n, "triangles": triangles / n}
    ]


def spheres(run: Run) -> tuple[Array, Array]:
    """Contact points (n, 3) [m] and their radii (n,) [m]."""
    run.refresh()
    return contact_points(run.S, run.segments), np.array(state.row(run.S, state.RADIUS, run.segments))


def times(run: Run, meshes: bool, rounds: int) -> pd.DataFrame:
    """Times at the same points, all compiled: one cylinder, the paper's search, a tree of boxes, and a library."""
    points, radii = spheres(run)
    owners, pieces = run.hole.owners(points), run.hole.pieces
    # So many points that the time of a call from Python does not matter.
    many, all_radii, all_owners = np.tile(points, (100, 1)), np.tile(radii, 100), np.tile(owners, 100)
    actions: dict[str, Action] = {
        ONE: lambda: one_cylinder(pieces, many, all_owners),
        SEARCH: lambda: for_loop_owners(pieces, many),
    }
    counts = dict.fromkeys(actions, len(many))
    if meshes:
        tree = BoxTree(np.asarray(build_tube(run.case, TubeOptions(facets=FACETS)).mesh.triangles))
        actions[TREE], counts[TREE] = (lambda: tree.penetrations(many, all_radii)), len(many)
    if meshes and installed_version("coal") is not None:
        library = build("coal", run.case, query="collide", facets=FACETS)
        beside = points - np.array([0.0, 0.0, 1e5])
        actions |= {LIBRARY: lambda: library.query(points, radii), ASKING: lambda: library.query(beside, radii)}
        counts |= {LIBRARY: len(points), ASKING: len(points)}
    ns = in_rounds(actions, counts, rounds)
    asking = ns.pop(ASKING, np.zeros(rounds))
    if LIBRARY in ns:
        ns[LIBRARY] = ns[LIBRARY] - asking
    both = ns[SEARCH] + ns[ONE]
    return pd.DataFrame(
        {"what": what}
        | in_columns({"ns_per_point": of, "over_one_cylinder": of / ns[ONE], "over_search_and_test": of / both})
        for what, of in ns.items()
    )


def row(name: str, tally: Any) -> dict[str, Any]:
    """A row of the table: operations per point."""
    return {"what": name, "arithmetic": float(arithmetic(tally)), **{part: float(tally[part]) for part in PARTS}}


def _share(tally: Counter[str], count: int) -> Any:
    return Counter({name: number / count for name, number in tally.items()})


def _less(tally: Any, *others: Any) -> Any:
    left = Counter(tally)
    for other in others:
        left.subtract(other)
    return left


def run(context: Context) -> Outcome:
    """Count the paper's equations, the engine's helpers on the paper's well, and a mesh of the same hole."""
    string, motion = tripping()
    rows = paper_rows() + engine_rows(string, motion, 10 if context.quick else 40)
    meshes = installed_version("trimesh") is not None
    for facets in () if not meshes else (FACETS,) if context.quick else (FACETS, 2 * FACETS):
        rows += mesh_rows(string, facets)
    table = pd.DataFrame(rows)
    found = table.set_index("what")["arithmetic"]
    one = float(found.filter(like="one cylinder").iloc[0])
    test = ["engine: PT from the cylinder remembered", "engine: penetration"]
    looked_up = float(found["engine: search, seldom more than two comparisons"])
    own = float(found[test].sum()) + looked_up
    loop = float(found.filter(like="FOR-loop").iloc[0])
    checks = [
        Check("operations of the paper's test for one cylinder", one, CLAIMED, "at_most", "",
              "abstract, §4: two dot products, a subtract and two multiplies"),
        Check("operations of the engine's test per point, cylinder remembered, down to penetration", own, CLAIMED,
              "at_most", "", "the same claim, for all operations that a penetration needs"),
        Check("operations of the paper's search per point, FOR-loop in paper-well", loop, CLAIMED, "at_most", "",
              "the same claim, for the search of §4.2"),
    ]  # fmt: skip
    if meshes:
        mesh = float(found.filter(like="mesh").min())
        checks += [
            Check("operations of the mesh over those of the engine's test", mesh / own, 1.0, "at_least", "",
                  "§1: less effort than other geometry-based algorithms"),
            Check("operations of the mesh over those of the paper's search and test",
                  mesh / (loop + float(found.filter(like="paper: ").sum())), 1.0, "at_least", "",
                  "§1: less effort than other geometry-based algorithms"),
        ]  # fmt: skip
    return Outcome(
        tables={"operations": table, "times": times(string, meshes, 5 if context.quick else 25)},
        checks=checks,
        notes=[
            "Sums, differences, products, quotients and roots of one point are counted by running the engine's own "
            "helpers on numbers that count their operations; comparisons are counted separately, changes of sign and "
            "loads from memory are not counted. The position of the point is given.",
            f"The string is the paper's, tripped in to {BIT:.0f} m at {SPEED} m/s in {len(string.hole.pieces)} "
            f"cylinders; rows are means over its points and the {PASSES:.0f} s in which all of them pass a cylinder. "
            f"The look-up table costs {looked_up:.1f} operations per point and step, for points near the ends of "
            "their cylinder and in an overlap.",
            "The paper's thirteen operations are for one cylinder. The search tests one cylinder after the other "
            "down to the point's own, eight operations each: its cost grows with depth and with the number of "
            "cylinders in the bends.",
            "The mesh has rings every 2 m at most. python-fcl and coal report no counts; this tree's boxes are "
            "aligned with the global axes and cheaper to test than their oriented ones. Its answers equal coal's to "
            "rounding.",
            "Counts are not times: the operations of a FOR-loop follow each other without branches, those of a tree "
            "wait for boxes and branches. The table of times is for the same points and for the counted code, "
            "compiled; the cost of calling coal from Python is subtracted from its time.",
        ],
        display={"operations": "Operations per point", "times": "Times of the same, all compiled"},
    )


STUDY = Study(
    "contact_operations",
    "How many operations does a contact test take?",
    run,
    reproduce=True,
    timed=True,
)
