"""Only the contact query is swapped, in the same loop, string and step: cost and torque of each method."""

from collections.abc import Callable, Iterable, Mapping
from itertools import product
from typing import Any, get_args

import numpy as np
import pandas as pd

from fctd import Case, simulate
from fctd.mechanics.topdrive import Motion
from fctd.simulation.run import Run
from references import contact
from references.contact import ContactMethod
from references.contact.for_loop import advance_with_for_loop
from references.timing.stopwatch import machine_table, race, units_for
from references.timing.workloads import NoWall, asking, copy_of, moving, without_wall
from validation.cases import load, rotation, trip
from validation.harness.study import Check, Context, Outcome, Rows, Study, left_out, table_of_rows
from validation.parts.methods import FULL_ONLY, TOO_SLOW
from validation.parts.windows import last_seconds

SEGMENTS = (60, 170)
BIT = 2450.0
ROUND = 0.02  # aimed-at length of a call in the race [s]
LABELS = {"for_loop": "FOR-loop"}
BASELINE = "no contact, compiled"
# The window of Fig. 13: a trip over the last metres above each depth, at the speed of the whole trip.
SPEED, RAMP = 0.5, 2.0
FACETS = 48  # the default of every mesh


def queries(methods: Iterable[str]) -> dict[str, tuple[str, dict[str, Any]]]:
    """Name in the tables -> method and options, one for each query of a method."""
    found: dict[str, tuple[str, dict[str, Any]]] = {}
    for name in methods:
        label, keys = LABELS.get(name, name), contact.method_class(name).Options.model_fields
        ways = get_args(keys["query"].annotation) if "query" in keys else ()
        found |= {f"{label}, {way}": (name, {"query": way}) for way in ways} or {label: (name, {})}
    return found


def turning(segments: int, geometry: str = "cylinders") -> tuple[Run, Motion]:
    """The curved chain in so many segments, settled and turning long enough for waves to have passed it."""
    case = load(
        "curved_chain",
        operations=rotation(BIT, 60.0, ramp=4.0),
        wellbore__geometry=geometry,
        string__components__0__segments=segments,
    )
    return moving(case, 4.0)


def costs(segments: int, asked: Mapping[str, ContactMethod], rounds: int) -> pd.DataFrame:
    """Times of all loops with one number of segments, per segment and step, from the same state."""
    start, motion = turning(segments)
    actions: dict[str, Callable[[], object]] = {}
    counts: dict[str, int] = {}

    def enter(name: str, advance: Callable[[int], object]) -> None:
        steps = units_for(advance, ROUND)
        counts[name] = steps * segments
        actions[name] = lambda: advance(steps)

    def loop_of(run: Run) -> Callable[[int], object]:
        return lambda steps: run.advance(motion, steps * run.step)

    enter(BASELINE, loop_of(without_wall(start)))
    enter("cylinders, compiled", loop_of(copy_of(start)))
    enter("arcs, compiled", loop_of(turning(segments, "arcs")[0]))
    own = copy_of(start)
    enter(
        "FOR-loop, compiled",
        lambda steps: advance_with_for_loop(
            own.S, own.top, segments, own.hole.pieces, own.laws, motion, own.pipe, own.step, steps
        ),
    )
    enter("no contact, asked from Python", loop_of(asking(start, NoWall())))
    for name, wall in asked.items():
        enter(f"{name}, from Python", loop_of(asking(start, wall)))
    table = race(actions, counts, rounds, BASELINE).rename(columns={"name": "loop", "ns": "ns_per_segment_step"})
    return table.assign(segments=segments, step_s=start.step)


@table_of_rows
def facets(quick: bool) -> Rows:
    """The curved chain rotating against meshes of more and more facets: torque over the number of facets."""
    case = load("curved_chain", operations=rotation(BIT, 8.0 if quick else 30.0, ramp=3.0), record__interval=0.25)
    window = 3.0 if quick else 15.0
    own = last_seconds(simulate(case), window)
    yield {"wall": "cylinders", "facets": np.nan, "wedge_percent": 0.0} | _loads(own, own)
    for count in (24,) if quick else (12, 24, 48, 96):
        method = contact.build("coal", case, facets=count)
        end = last_seconds(simulate(case, contact=method), window)
        yield {"wall": "mesh", "facets": count, "wedge_percent": wedge(count)} | _loads(end, own)


def counted() -> pd.DataFrame:
    """The curved chain rotating in more segments (§6.3), with a mesh and with cylinders.

    columns : wall, segments, sum_r_mu_fn_kN_m and its change from the fewest segments in percent.
    """
    rows = []
    for wall, segments in product(("cylinders", "mesh"), SEGMENTS):
        case = load(
            "curved_chain",
            operations=rotation(BIT, 12.0, ramp=3.0),
            record__interval=0.1,
            string__components__0__segments=segments,
        )
        method = contact.build("coal", case) if wall == "mesh" else None
        end = last_seconds(simulate(case, contact=method), 6.0)
        rows.append({"wall": wall, "segments": segments, "sum_r_mu_fn_kN_m": end["sum_r_mu_fn_N_m"] / 1e3})
    table = pd.DataFrame(rows)
    fewest = table.groupby("wall")["sum_r_mu_fn_kN_m"].transform("first")
    return table.assign(change_percent=100 * (table["sum_r_mu_fn_kN_m"] / fewest - 1))


def wedge(count: int) -> float:
    """Excess [%] of the contact force of two facets on a string in their corner over that of a round wall."""
    return float(100 * (1 / np.cos(np.pi / count) - 1))


def _loads(end: pd.Series, own: pd.Series) -> dict[str, float]:
    return {
        "surface_torque_kN_m": end["surface_torque_N_m"] / 1e3,
        "sum_r_mu_fn_kN_m": end["sum_r_mu_fn_N_m"] / 1e3,
        "sliding_fraction": end["sum_r_ft_N_m"] / end["sum_r_mu_fn_N_m"],
        "contact_force_kN": end["total_contact_force_N"] / 1e3,
        "torque_difference_percent": 100 * (end["surface_torque_N_m"] / own["surface_torque_N_m"] - 1),
        "sum_difference_percent": 100 * (end["sum_r_mu_fn_N_m"] / own["sum_r_mu_fn_N_m"] - 1),
    }


def figure_13(context: Context, method: str) -> dict[str, pd.DataFrame]:
    """Σ rμF_n of the paper's well tripped into down to 2250 m: the engine all the way, the mesh in windows."""
    own = simulate(trip_of(1750.0, 2250.0))
    duration = 2.5 if context.quick else 10.0
    rows, seconds, steps = [], 0.0, 0
    depths = (2250.0,) if context.quick else np.arange(1850.0, 2250.1, 100.0)
    for depth in context.progress(depths, "windows"):
        case = trip_of(float(depth) - SPEED * (duration - RAMP / 2), float(depth))
        swapped = simulate(case, contact=contact.build(method, case))
        seconds, steps = seconds + swapped.run["wall_s"], steps + swapped.run["steps"]
        # The Hann window over the second half of the trip has its middle at three quarters.
        row: dict[str, Any] = {"bit_depth_m": depth - SPEED * duration / 4}
        for name, result in ((method, swapped), ("FCTD", simulate(case))):
            end = last_seconds(result, duration / 2)
            row |= {f"{name}_kN_m": end["sum_r_mu_fn_N_m"] / 1e3, f"{name}_hookload_kN": end["hookload_N"] / 1e3}
        row["difference_percent"] = 100 * (row[f"{method}_kN_m"] / row["FCTD_kN_m"] - 1)
        rows.append(row)
    whole = {"run": f"{method}, 1750 to 2250 m", "steps": own.run["steps"]}
    times = [
        {"run": "FCTD, 1750 to 2250 m", "steps": own.run["steps"], "wall_s": own.run["wall_s"], "kind": "measured"},
        {"run": f"{method}, the windows", "steps": steps, "wall_s": seconds, "kind": "measured"},
        whole | {"wall_s": seconds / steps * own.run["steps"], "kind": "extrapolated from the windows"},
    ]
    trip_in = own.history[["bit_depth_m", "sum_r_mu_fn_N_m"]]
    return {"figure_13": pd.DataFrame(rows), "trip": trip_in, "times": pd.DataFrame(times)}


@table_of_rows
def torques(walls: Iterable[ContactMethod], duration: float) -> Rows:
    """The curved chain rotating against every method's wall; differences to the engine's own cylinders."""
    case = load("curved_chain", operations=rotation(BIT, duration, ramp=3.0), record__interval=0.25)
    own = last_seconds(simulate(case), 3.0)
    for wall in walls:
        end = last_seconds(simulate(case, contact=wall), 3.0)
        yield {"method": wall.name} | _loads(end, own)


def trip_of(start: float, end: float) -> Case:
    """The paper's well tripped into, law ``paper``."""
    schedule = trip(start, end, SPEED, ramp=RAMP)
    return load("paper_well", operations=schedule, contact__friction_law="paper", record__interval=0.25)


def run(context: Context) -> Outcome:
    """Times with 60 and 170 segments (quick: 60), the facets, the windows of Fig. 13."""
    missing = [name for name in contact.METHODS if contact.installed_version(name) is None]
    there = [name for name in contact.METHODS if name not in missing]
    raced = [name for name in there if not (context.quick and name in FULL_ONLY)]
    rounds, hole = 5 if context.quick else 25, load("curved_chain", operations=None)
    asked = {query: contact.build(name, hole, **options) for query, (name, options) in queries(raced).items()}
    first = {wall.name: wall for wall in reversed(asked.values())}  # of the queries of a method
    counts = SEGMENTS[:1] if context.quick else SEGMENTS
    cost = pd.concat([costs(n, asked, rounds) for n in context.progress(counts, "segments")], ignore_index=True)
    tables = {
        "cost": cost,
        "torques": torques(context.progress([first[name] for name in raced if name != TOO_SLOW], "methods"), 8.0),
        "machine": machine_table(),
    }
    display = {
        "cost": "Time of one segment and one step of the same loop, measured in turns; ratios are to no contact",
        "torques": "Rotating torque of the curved chain with every method at its default options",
    }
    checks = [
        Check("cost of a step with cylinders over one without contact", _ratio(cost, "cylinders, compiled"), 2.0,
              "at_most", "", "target: contact costs no more than the rest of the step", timed=True),
        Check("Σ rμF_n rotating, every method against the engine's own cylinders, largest difference",
              float(tables["torques"]["sum_difference_percent"].abs().max()), 2.0, "at_most", "%",
              f"facets: {wedge(FACETS):.1f} %; a mean over a few seconds keeps some of the swing"),
    ]  # fmt: skip
    if "coal" in there:
        tables["facets"] = facets(context.quick)
        display["facets"] = "Rotating torque of the curved chain against meshes (coal) and cylinders"
        checks.append(facet_check(tables["facets"]))
        if not context.quick:
            tables["segments"] = counted()
            display["segments"] = "The same with 60 and 170 segments: does a mesh (coal) need more segments?"
    if "fcl" in there:
        tables |= figure_13(context, "fcl")
        display["figure_13"] = "Fig. 13: Σ rμF_n while tripping in, FCL and FCTD over the same windows"
        display["times"] = "The trip of Fig. 13: FCTD measured, FCL in windows and extrapolated"
        checks += fcl_checks(cost, tables["figure_13"])
    return Outcome(tables=tables, checks=checks, notes=notes(missing), display=display)


def facet_check(table: pd.DataFrame) -> Check:
    """Whether the excess of a mesh is that of two facets on a string in their corner."""
    meshes = table.dropna(subset="facets")
    excess = float((meshes["sum_difference_percent"].abs() / meshes["wedge_percent"]).max())
    return Check("Σ rμF_n rotating, meshes against cylinders, over 1/cos(π/n) − 1", excess, 1.5, "at_most", "",
                 "excess of the force of two facets on a string in their corner")  # fmt: skip


def fcl_checks(cost: pd.DataFrame, windows: pd.DataFrame) -> list[Check]:
    """FCL, which descends from the contact code of the paper's comparison, against cylinders: cost and Fig. 13."""
    cheapest = min(_ratio(cost, loop) for loop in cost["loop"].unique() if loop.startswith("fcl"))
    difference = windows.loc[windows["bit_depth_m"] > 1900, "difference_percent"].abs()
    return [
        Check("FCL contact over cylinders, a step of 60 segments", cheapest / _ratio(cost, "cylinders, compiled"), 10.0,
              "at_least", "", "claim of the paper: FCTD contact is cheaper than geometry-based contact", timed=True),
        Check("FCL contact over cylinders, both called from Python", cheapest / _ratio(cost, "cylinders, from Python"),
              10.0, "at_least", "", "the same claim where both are called from Python", timed=True),
        Check("Σ rμF_n tripping in, FCL against FCTD below 1900 m, largest difference", float(difference.max()),
              2.0, "at_most", "%", f"facets: {wedge(FACETS):.1f} %; means over a few seconds keep some of the swing"),
    ]  # fmt: skip


def _ratio(cost: pd.DataFrame, loop: str) -> float:
    """Ratio of a loop of 60 segments to no contact."""
    return float(cost.loc[(cost["segments"] == 60) & (cost["loop"] == loop), "ratio"].iloc[0])


def notes(missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *left_out(missing),
        "All loops take the same step from the same state of the curved chain, about half of whose points touch. The "
        "rows from Python contain two compiled calls and one query per step; the row with an empty query is the cost "
        "of those calls alone.",
        f"Meshes have {FACETS} facets and rings every 2 m at most unless said otherwise. The torque differs between "
        "mesh and cylinders because facets meet in corners: a point of the string settles there and two facets "
        "support it, whose forces add up to 1/cos(π/n) times the force of a round wall; on the flat of a facet there "
        "is no such excess. Contact forces differ by as much as the torques, and both differences vanish with more "
        "facets.",
        "In such a corner the one contact of a point jumps from facet to facet, so that the string does not come to "
        "rest: it keeps moving at some cm/s until friction stops it. Cylinders and arcs have no corners.",
        f"Torques of {TOO_SLOW} were not run: a query takes milliseconds per point. The effect of facets is shown "
        "with coal, and Fig. 13 with FCL, which descends from the contact code of the paper's comparison; the meshes "
        "are the same.",
        "The whole trip of Fig. 13 was not run with FCL: only windows of it were, and its time is extrapolated from "
        "their time per step.",
    ]


STUDY = Study(
    "contact_swap",
    "What does the contact method cost in the loop, and does the torque depend on it?",
    run,
    reproduce=True,
    timed=True,
)
