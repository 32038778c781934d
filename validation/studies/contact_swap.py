"""Only the contact query is swapped, in the same loop, string and step: cost and torque of each method."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, get_args

import numpy as np
import pandas as pd

from fctd import Case, simulate
from fctd.arena.result import Comparison, Quartiles
from fctd.mechanics.topdrive import Motion
from fctd.simulation.run import Run
from references import contact
from references.contact import ContactMethod
from references.contact.for_loop import advance_with_for_loop
from references.timing.stopwatch import machine_table, race, units_for
from references.timing.workloads import NoWall, asking, copy_of, moving, without_wall
from validation.cases import load, rotation, trip
from validation.harness.study import Check, Context, Outcome, Study, left_out, quartiles_of, ratio_check
from validation.parts.contact_presets import FULL_ONLY, TOO_SLOW, in_loop, loads, windows

SEGMENTS = (60, 170)
BIT = 2450.0
ROUND = 0.02  # aimed-at length of a call in the race [s]
LABELS = {"for_loop": "FOR-loop"}
BASELINE = "no contact, compiled"
# Fig. 13: bit depths, and speed of the trip [m/s] and its ramp [s].
DEPTHS = (1850.0, 1950.0, 2050.0, 2150.0, 2250.0)
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


def rotating(segments: int = 60) -> Case:
    """The curved chain, turning."""
    return load("curved_chain", operations=rotation(BIT, 1.0, ramp=3.0), string__components__0__segments=segments)


def facets(context: Context) -> Comparison:
    """The curved chain rotating against meshes of more and more facets."""
    counts = (24,) if context.quick else (12, 24, 48, 96)
    return in_loop(rotating(), [("coal", {"facets": count}) for count in counts], context)


def wedges(found: Comparison) -> pd.DataFrame:
    """Loads over the number of facets, with the excess of two facets in percent."""
    counts = [row.options.get("facets", np.nan) for row in found.rows]
    table = loads(found).assign(facets=counts)
    return table.assign(wedge_percent=[0.0 if np.isnan(count) else wedge(count) for count in counts])


def counted(context: Context) -> pd.DataFrame:
    """The curved chain rotating in more segments (§6.3), with a mesh and with cylinders.

    columns : setting, segments, sum_r_mu_fn_kN_m and its change from the fewest segments in percent.
    """
    found = [
        loads(in_loop(rotating(count), ["cylinders", "coal"], context)).assign(segments=count) for count in SEGMENTS
    ]
    table = pd.concat(found).query("method != 'fctd'")[["setting", "segments", "sum_r_mu_fn_kN_m"]]
    fewest = table.groupby("setting")["sum_r_mu_fn_kN_m"].transform("first")
    return table.assign(change_percent=100 * (table["sum_r_mu_fn_kN_m"] / fewest - 1)).sort_values("setting")


def wedge(count: int) -> float:
    """Excess [%] of the contact force of two facets on a string in their corner over that of a round wall."""
    return float(100 * (1 / np.cos(np.pi / count) - 1))


def figure_13(context: Context, method: str) -> tuple[dict[str, pd.DataFrame], dict[str, Comparison]]:
    """Σ rμF_n of the paper's well tripped into down to 2250 m: the engine all the way, the mesh in windows."""
    own = simulate(trip_of(1750.0, 2250.0))
    found = {
        f"trip_in_{depth:.0f}_m": in_loop(trip_of(1750.0, depth), ["cylinders", method], context)
        for depth in context.progress(DEPTHS, "windows")
    }
    runs = [row.loads for of in found.values() for row in of.rows if row.name == method and row.loads is not None]
    step = float(np.mean([run.step_us.median for run in runs])) * 1e-6
    whole = "1750 to 2250 m"
    times = [
        {"run": f"FCTD, {whole}", "steps": own.run["steps"], "wall_s": own.run["wall_s"], "kind": "measured"},
        {"run": f"{method}, {whole}", "steps": own.run["steps"], "wall_s": step * own.run["steps"],
         "kind": "extrapolated from the steps of its windows"},
    ]  # fmt: skip
    trip_in = own.history[["bit_depth_m", "sum_r_mu_fn_N_m"]]
    return {"figure_13": windows(found, method), "trip": trip_in, "times": pd.DataFrame(times)}, found


def trip_of(start: float, end: float) -> Case:
    """The paper's well tripped into, law ``paper``."""
    schedule = trip(start, end, SPEED, ramp=RAMP)
    return load("paper_well", operations=schedule, contact__friction_law="paper", record__interval=0.25)


def run(context: Context) -> Outcome:
    """Times with 60 and 170 segments (quick: 60), the facets, the windows of Fig. 13."""
    missing = [name for name in contact.METHODS if contact.installed_version(name) is None]
    there = [name for name in contact.METHODS if name not in missing]
    raced = [name for name in there if not (context.quick and name in FULL_ONLY)]
    asked = {
        key: contact.build(name, turning(60)[0].case, **options) for key, (name, options) in queries(raced).items()
    }
    counts = SEGMENTS[:1] if context.quick else SEGMENTS
    cost = pd.concat(
        [costs(n, asked, 9 if context.quick else 15) for n in context.progress(counts, "segments")],
        ignore_index=True,
    )
    turned = in_loop(rotating(), [name for name in raced if name != TOO_SLOW], context)
    found = {"torques": turned}
    tables = {"cost": cost, "torques": loads(turned).query("method != 'fctd'"), "machine": machine_table()}
    display = {
        "cost": "One segment and step in each loop, all loops timed in turns, over no contact",
        "machine": "What the times depend on",
        "torques": "Rotating torque of the curved chain with every method at its default options",
    }
    checks = [
        ratio_check("cost of a step with cylinders over one without contact", _ratio(cost, "cylinders, compiled"), 2.0,
                    "at_most", "target: contact costs no more than the rest of the step"),
        Check("Σ rμF_n rotating, every method against the engine's own arcs, largest difference",
              float(tables["torques"]["sum_difference_percent"].abs().max(skipna=False)), 2.0, "at_most", "%",
              f"facets: {wedge(FACETS):.1f} %"),
    ]  # fmt: skip
    if "coal" in there:
        found["facets"] = facets(context)
        tables["facets"] = wedges(found["facets"])
        display["facets"] = "Rotating torque of the curved chain against meshes (coal) and the engine's own arcs"
        checks.append(facet_check(tables["facets"]))
        if not context.quick:
            tables["segments"] = counted(context)
            display["segments"] = "The same with 60 and 170 segments: does a mesh (coal) need more segments?"
    if "fcl" in there:
        more, trips = figure_13(context, "fcl")
        tables |= more
        found |= trips
        display["figure_13"] = "Fig. 13: Σ rμF_n while tripping in, FCL and FCTD's cylinders over the same windows"
        display["times"] = "The trip of Fig. 13: FCTD measured, FCL extrapolated from its windows"
        checks += fcl_checks(cost, tables["figure_13"])
    return Outcome(tables=tables, checks=checks, notes=notes(missing), display=display, comparisons=found)


def facet_check(table: pd.DataFrame) -> Check:
    """Whether the excess of a mesh is that of two facets on a string in their corner; a run that failed misses it."""
    meshes = table.dropna(subset="facets")
    excess = float((meshes["sum_difference_percent"].abs() / meshes["wedge_percent"]).max(skipna=False))
    return Check("Σ rμF_n rotating, meshes against cylinders, over 1/cos(π/n) − 1", excess, 1.5, "at_most", "",
                 "excess of the force of two facets on a string in their corner")  # fmt: skip


def fcl_checks(cost: pd.DataFrame, table: pd.DataFrame) -> list[Check]:
    """FCL, which descends from the contact code of the paper's comparison, against cylinders: cost and Fig. 13."""
    each = [_ratio(cost, loop) for loop in cost["loop"].unique() if loop.startswith("fcl")]
    cheapest = min(each, key=lambda ratio: ratio.median)
    difference = table.loc[table["bit_depth_m"] > 1900, "sum_difference_percent"].abs()
    return [
        ratio_check("FCL contact over cylinders, a step of 60 segments",
                    cheapest.over(_ratio(cost, "cylinders, compiled")), 10.0, "at_least",
                    "claim of the paper: FCTD contact is cheaper than geometry-based contact"),
        ratio_check("FCL contact over cylinders, both called from Python",
                    cheapest.over(_ratio(cost, "cylinders, from Python")), 10.0, "at_least",
                    "the same claim where both are called from Python"),
        Check("Σ rμF_n tripping in, FCL against FCTD below 1900 m, largest difference",
              float(difference.max(skipna=False)), 2.0, "at_most", "%", f"facets: {wedge(FACETS):.1f} %"),
    ]  # fmt: skip


def _ratio(cost: pd.DataFrame, loop: str) -> Quartiles:
    """Ratio of a loop of 60 segments to no contact."""
    return quartiles_of(cost[(cost["segments"] == 60) & (cost["loop"] == loop)].iloc[0], "ratio")


def notes(missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *left_out(missing),
        "All loops take the same step from the same state of the curved chain, about half of whose points touch. The "
        "rows from Python contain two compiled calls and one query per step; the row with an empty query is the cost "
        "of those calls alone.",
        "Loads: FCTD's own stepper leads the string to one start, and each method has it from there, over whole "
        "periods of its slowest vibration. Meshes have "
        f"{FACETS} facets and rings every 2 m at most unless said otherwise. The torque differs between "
        "mesh and round wall because facets meet in corners: a point of the string settles there and two facets "
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
