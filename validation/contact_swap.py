"""One loop, one string, one step; only the contact query is swapped: what each costs and what it does to the torque."""

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, get_args

import numpy as np
import pandas as pd

from fctd import Case, simulate
from fctd.run import Run, forget_start, prepare, settle
from fctd.state import OPEN
from fctd.topdrive import Motion
from fctd.wall_query import QueriedWall
from fctd.wellbore import Contacts
from references import base
from references.for_loop import advance_with_for_loop
from references.timing import machine, race
from validation.cases import load, rotation, trip
from validation.steady import last_seconds
from validation.study import Check, Context, Outcome, Study

SEGMENTS = (60, 170)
BIT = 2450.0
ROUND = 0.02  # aimed-at length of a call in the race [s]
FULL_ONLY = ("bullet", "mujoco", "trimesh")
TOO_SLOW = "trimesh"  # milliseconds a point: minutes for the seconds that a torque takes
LABELS = {"for_loop": "FOR-loop"}
BASELINE = "no contact, compiled"
# The window of Fig. 13: a trip over the last metres above each depth, at the speed of the whole trip.
SPEED, RAMP = 0.5, 2.0
FACETS = 48  # the default of every mesh


def queries(methods: Iterable[str]) -> dict[str, tuple[str, dict[str, Any]]]:
    """Name in the tables -> method and options, one for each way in which a method can be asked."""
    found: dict[str, tuple[str, dict[str, Any]]] = {}
    for name in methods:
        label, keys = LABELS.get(name, name), base.method_class(name).Options.model_fields
        ways = get_args(keys["query"].annotation) if "query" in keys else ()
        found |= {f"{label}, {way}": (name, {"query": way}) for way in ways} or {label: (name, {})}
    return found


class NoWall:
    """A query that finds nothing: what is left is the price of asking from Python."""

    name = "none"

    def query(self, points: Any, radii: Any) -> Contacts:
        """Never a contact."""
        n = len(points)
        return Contacts(np.full(n, -np.inf), np.empty((n, 3)), np.empty(n))


def turning(segments: int, geometry: str = "cylinders") -> tuple[Run, Motion]:
    """The curved chain in so many segments, settled and turning long enough for waves to have passed it."""
    case = load(
        "curved_chain",
        operations=rotation(BIT, 60.0, ramp=4.0),
        wellbore__geometry=geometry,
        string__components__0__segments=segments,
    )
    run, stretches = prepare(case)
    settle(run)
    forget_start(run)
    run.advance(stretches[0].motion, 4.0)
    return run, stretches[1].motion


def copy_of(run: Run, **changes: Any) -> Run:
    """The same state in a buffer of its own."""
    return replace(run, S=run.S.copy(), top=run.top.copy(), owner=run.owner.copy(), **changes)


def steps_for(advance: Callable[[int], object]) -> int:
    """How many steps take about ``ROUND`` of the processor, others apart; all is compiled and built afterwards."""
    steps = 1
    advance(steps)
    while True:
        began = time.process_time()
        advance(steps)
        spent = time.process_time() - began
        if spent > 0.5 * ROUND or steps > 1e6:
            return max(int(steps * ROUND / spent), 1)
        steps *= 2


def costs(segments: int, asked: Mapping[str, tuple[str, dict[str, Any]]], rounds: int) -> pd.DataFrame:
    """The race of all loops with one number of segments, per segment and step, from the same state."""
    start, motion = turning(segments)
    actions: dict[str, Callable[[], object]] = {}
    counts: dict[str, int] = {}

    def enter(name: str, advance: Callable[[int], object]) -> None:
        steps = steps_for(advance)
        counts[name] = steps * segments
        actions[name] = lambda: advance(steps)

    def loop_of(run: Run) -> Callable[[int], object]:
        return lambda steps: run.advance(motion, steps * run.step)

    enter(BASELINE, loop_of(copy_of(start, laws=start.laws._replace(geometry=OPEN))))
    enter("cylinders, compiled", loop_of(copy_of(start)))
    enter("arcs, compiled", loop_of(turning(segments, "arcs")[0]))
    own = copy_of(start)
    enter(
        "FOR-loop, compiled",
        lambda steps: advance_with_for_loop(
            own.S, own.top, segments, own.hole.pieces, own.laws, motion, own.pipe, own.step, steps
        ),
    )
    walls: dict[str, Any] = {"no contact, asked from Python": NoWall()}
    walls |= {f"{name}, from Python": base.build(each[0], start.case, **each[1]) for name, each in asked.items()}
    for name, wall in walls.items():
        enter(name, loop_of(copy_of(start, queried=QueriedWall(wall, start.hole, segments))))
    table = race(actions, counts, rounds, BASELINE).rename(columns={"name": "loop", "ns": "ns_per_segment_step"})
    return table.assign(segments=segments, step_s=start.step)


def ratios(cost: pd.DataFrame) -> pd.DataFrame:
    """The paper's ratios beside ours, each with what it contains."""
    at = cost.set_index(["segments", "loop"])
    # Ratios within the rounds of a race are steadier than times; only the baselines are compared across races.
    baseline = at.xs(BASELINE, level="loop")["ns_per_segment_step"]
    segments = at.index.get_level_values("segments")
    per_second = at["ratio"] * baseline.loc[segments].to_numpy() * segments / at["step_s"]  # of simulated time
    rows = [
        {
            "ratio": "paper: Adams 34 h, 170 segments : FCTD 4 h, 60 segments",
            "value": 34 / 4,
            "contains": "contact, program, solver, step and segment count",
        },
        {
            "ratio": "paper: the same for each segment, 34/4 × 60/170",
            "value": 34 / 4 * 60 / 170,
            "contains": "contact, program, solver and step",
        },
        {
            "ratio": "paper: Adams 12 s : FCTD 4 s, no contact, equal counts",
            "value": 12 / 4,
            "contains": "program and solver",
        },
        {
            "ratio": "paper: what is left for contact, (34/4 × 60/170) / (12/4)",
            "value": 34 / 4 * 60 / 170 / 3,
            "contains": "contact, if cost grows with the count alone and steps were equal",
        },
    ]
    outside = [loop for loop in cost["loop"].unique() if loop.endswith(", from Python")]
    for loop in ("FOR-loop, compiled", *outside):
        contains = "contact" if loop.endswith("compiled") else "contact and calls from Python"
        for many in SEGMENTS:
            more = "" if many == 60 else ", segment count, shorter step of shorter segments"
            rows.append(
                {
                    "ratio": f"ours: {loop}, {many} segments : cylinders, compiled, 60",
                    "value": per_second[many, loop] / per_second[60, "cylinders, compiled"],
                    "contains": contains + more,
                }
            )
    rows.append(
        {
            "ratio": "ours: cylinders, compiled : no contact, compiled, 60 segments each",
            "value": per_second[60, "cylinders, compiled"] / per_second[60, BASELINE],
            "contains": "all that contact costs: search, normal, friction",
        }
    )
    asked, free = at["ratio"].xs(60, level="segments"), "no contact, asked from Python"
    for loop in outside:
        rows.append(
            {
                "ratio": f"ours: {loop.removesuffix(', from Python')} : cylinders, 60 segments, each less its own loop "
                "without contact",
                "value": (asked[loop] - asked[free]) / (asked["cylinders, compiled"] - 1),
                "contains": "contact alone, with the price of a call for each point",
            }
        )
    return pd.DataFrame(rows)


def facets(quick: bool) -> pd.DataFrame:
    """The curved chain rotating against meshes of more and more facets: what the torque owes to them."""
    case = load("curved_chain", operations=rotation(BIT, 8.0 if quick else 30.0, ramp=3.0), record__interval=0.25)
    window = 3.0 if quick else 15.0
    own = last_seconds(simulate(case), window)
    rows = [{"wall": "cylinders", "facets": np.nan, "wedge_percent": 0.0} | _loads(own, own)]
    for count in (24,) if quick else (12, 24, 48, 96):
        method = base.build("coal", case, facets=count)
        end = last_seconds(simulate(case, contact=method), window)
        rows.append({"wall": "mesh", "facets": count, "wedge_percent": wedge(count)} | _loads(end, own))
    return pd.DataFrame(rows)


def wedge(count: int) -> float:
    """How much more [%] two facets press together on a string in the corner between them than a round wall."""
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
        swapped = simulate(case, contact=base.build(method, case))
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


def torques(methods: Iterable[str], duration: float) -> pd.DataFrame:
    """The curved chain rotating against every method's wall; differences to the engine's own cylinders."""
    case = load("curved_chain", operations=rotation(BIT, duration, ramp=3.0), record__interval=0.25)
    own = last_seconds(simulate(case), 3.0)
    rows = []
    for name in methods:
        end = last_seconds(simulate(case, contact=base.build(name, case)), 3.0)
        rows.append({"method": name} | _loads(end, own))
    return pd.DataFrame(rows)


def trip_of(start: float, end: float) -> Case:
    """The paper's well tripped into, law ``paper``."""
    schedule = trip(start, end, SPEED, ramp=RAMP)
    return load("paper_well", operations=schedule, contact__friction_law="paper", record__interval=0.25)


def run(context: Context) -> Outcome:
    """The race with 60 and 170 segments, the ratios, the facets, the windows of Fig. 13."""
    missing = [name for name in base.METHODS if base.installed_version(name) is None]
    there = [name for name in base.METHODS if name not in missing]
    raced = [name for name in there if not (context.quick and name in FULL_ONLY)]
    asked, rounds = queries(raced), 5 if context.quick else 25
    cost = pd.concat([costs(n, asked, rounds) for n in context.progress(SEGMENTS, "segments")], ignore_index=True)
    tables = {
        "cost": cost,
        "ratios": ratios(cost),
        "torques": torques(context.progress([name for name in raced if name != TOO_SLOW], "methods"), 8.0),
        "machine": pd.DataFrame(machine().items(), columns=["what", "value"]),
    }
    display = {
        "cost": "One segment and one step of the same loop, raced in turns; ratios are to no contact",
        "ratios": "The paper's ratios beside ours, and what each contains",
        "torques": "Rotating torque of the curved chain with every method at its default options",
    }
    checks = [
        Check("cost of a step with cylinders over one without contact", _ratio(cost, "cylinders, compiled"), 2.0,
              "at_most", "", "target: contact costs no more than all the rest"),
        Check("Σ rμF_n rotating, every method against the engine's own cylinders, largest difference",
              float(tables["torques"]["sum_difference_percent"].abs().max()), 2.0, "at_most", "%",
              f"facets: {wedge(FACETS):.1f} %; a window of a few seconds adds its swing"),
    ]  # fmt: skip
    if "coal" in there:
        tables["facets"] = facets(context.quick)
        display["facets"] = "Rotating torque of the curved chain against meshes (coal) and cylinders"
        meshes = tables["facets"].dropna(subset="facets")
        excess = float((meshes["sum_difference_percent"].abs() / meshes["wedge_percent"]).max())
        checks.append(
            Check("Σ rμF_n rotating, meshes against cylinders, over 1/cos(π/n) − 1", excess, 1.5, "at_most", "",
                  "two facets hold a string in their corner with that much more force")
        )  # fmt: skip
    if "fcl" in there:
        tables |= figure_13(context, "fcl")
        display["figure_13"] = "Fig. 13: Σ rμF_n while tripping in, FCL and FCTD over the same windows"
        display["times"] = "The trip of Fig. 13: FCTD measured, FCL in windows and extrapolated"
        cheapest = min(_ratio(cost, loop) for loop in cost["loop"].unique() if loop.startswith("fcl"))
        slower = cheapest / _ratio(cost, "cylinders, compiled")
        below = tables["figure_13"]["bit_depth_m"] > 1900
        difference = tables["figure_13"].loc[below, "difference_percent"].abs()
        checks += [
            Check("FCL contact over cylinders, a step of 60 segments", slower, 10.0, "at_least", "",
                  "claim of the paper: FCTD contact is cheaper than geometry-based contact"),
            Check("Σ rμF_n tripping in, FCL against FCTD below 1900 m, largest difference", float(difference.max()),
                  2.0, "at_most", "%", f"facets: {wedge(FACETS):.1f} %; windows of a few seconds add their swing"),
        ]  # fmt: skip
    return Outcome(tables=tables, checks=checks, notes=notes(missing), display=display)


def _ratio(cost: pd.DataFrame, loop: str) -> float:
    """Ratio of a loop of 60 segments to no contact."""
    return float(cost.loc[(cost["segments"] == 60) & (cost["loop"] == loop), "ratio"].iloc[0])


def notes(missing: list[str]) -> list[str]:
    """What a reader of the numbers must know."""
    absent = [f"Not installed, and left out: {', '.join(missing)}."] if missing else []
    return [
        *absent,
        "All loops take the same step from the same state of the curved chain, about half of whose points touch. The "
        "rows from Python contain two compiled calls and one query a step; the row that asks and finds nothing is "
        "what those calls cost by themselves.",
        "The paper's two ratios do not separate the contact method: 34 h to 4 h is 3.0 for each segment, and without "
        "any contact the same two programs stand 3 to 1. On those numbers nothing is left for contact; they do not "
        "tell how the steps differed.",
        f"Meshes have {FACETS} facets and rings every 2 m at most unless said otherwise. The torque differs between "
        "mesh and cylinders because facets meet in corners: a point of the string settles there and is held by two "
        "facets, whose forces add up to 1/cos(π/n) of what a round wall would press; on the flat of a facet there is "
        "no such excess. Contact forces differ by as much as the torques, and with more facets both vanish.",
        "In such a corner the one contact of a point jumps from facet to facet, so that the string never comes to "
        "rest: it keeps moving at some cm/s until friction holds it. Cylinders and arcs have no corners.",
        f"Torques of {TOO_SLOW} were not run: it takes milliseconds a point. What facets do is shown with coal, and "
        "Fig. 13 with FCL, which descends from the contact code of the paper's comparison; the meshes are the same.",
        "The whole trip of Fig. 13 with FCL was not run: windows of it were, and its time is extrapolated from their "
        "time per step.",
    ]


STUDY = Study(
    "contact_swap", "What does the contact method cost in the loop, and does the torque depend on it?", run, True
)
