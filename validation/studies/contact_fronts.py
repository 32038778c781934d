"""Error against cost of every contact method over its settings, and what an error of contact does to a load."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, simulate
from references import contact, engines
from references.contact import ContactMethod
from references.engines import Window
from references.timing.footprint import footprint
from references.timing.stopwatch import machine_table
from validation.cases import load, rotation, trip
from validation.harness.study import Check, Context, Outcome, Rows, Study, left_out, log_slope, table_of_rows
from validation.parts import contact_costs, engine_fronts, gated
from validation.parts.brought import brought
from validation.parts.contact_settings import CELLS, built, label, settings
from validation.parts.methods import TOO_SLOW
from validation.parts.wall_points import RADIUS, SLID, errors_of, points_in, the_case
from validation.parts.windows import last_seconds

OWN = contact_costs.OWN
ENGINES = {"FCTD": "fctd", "Bullet": "bullet", "MuJoCo": "mujoco", "PyElastica": "elastica"}
BIT = 2450.0
OWN_METHODS = ("arcs", "cylinders", "for_loop")
QUICK_LOADS = (OWN, "sdf", "libigl")  # methods whose loads a quick run computes


@table_of_rows
def errors(methods: Mapping[str, ContactMethod], sample: pd.DataFrame, case: Case) -> Rows:
    """Errors of every setting: the largest of all regions, and the root mean square of their points."""
    for key, method in methods.items():
        regions = pd.DataFrame(list(errors_of(method, sample, case)))
        yield {
            "setting": key,
            "missed_percent": float(np.average(regions["missed_percent"], weights=regions["points"])),
            "max_error_mm": float(regions["max_penetration_error_mm"].max()),
            "rms_error_mm": float(
                np.sqrt(np.average(regions["rms_penetration_error_mm"] ** 2, weights=regions["points"]))
            ),
            "max_angle_deg": float(regions["max_angle_error_deg"].max()),
        }


@table_of_rows
def loads(asked: Iterable[tuple[str, dict[str, Any]]], seconds: float) -> Rows:
    """Torque of a turning string and hook load of one pulled out, with each setting in the engine's own loop.

    The curved chain in exact arcs; differences are those to the engine's own arcs over the same windows.
    """
    shared = {"wellbore__geometry": "arcs", "record__interval": 0.25}
    turning = load("curved_chain", operations=rotation(BIT, 2 * seconds, ramp=0.5 * seconds), **shared)
    length = {"string__components__0__length": None, "string__components__0__segments": None}
    pulled = load(
        "curved_chain",
        operations=trip(BIT + 0.5 * seconds, BIT - 0.5 * seconds, 0.5, ramp=0.5 * seconds),
        string__components__0__segment_length=25.0,
        **length,
        **shared,
    )
    cases = {"torque": (turning, "surface_torque_N_m"), "hookload": (pulled, "hookload_N")}
    own = {load_name: last_seconds(simulate(case), seconds)[column] for load_name, (case, column) in cases.items()}
    for name, options in asked:
        row: dict[str, Any] = {"setting": label(name, options), "failed": ""}
        for load_name, (case, column) in cases.items():
            result = simulate(case, contact=contact.build(name, case, **options))
            if result.status == "completed":
                off = 100 * (last_seconds(result, seconds)[column] / own[load_name] - 1)
            else:
                off, row["failed"] = np.nan, f"{result.status}: {result.message}"
            row[f"{load_name}_off_percent"] = off
        yield row


@table_of_rows
def builds(asked: Iterable[tuple[str, dict[str, Any]]], case: Case) -> Rows:
    """Memory and time of building each setting, in a process of its own."""
    for name, options in asked:
        memory, seconds = footprint(name, case, **options)
        yield {"setting": label(name, options), "memory_MB": memory, "build_s": seconds}


def run(context: Context) -> Outcome:
    """Errors, costs and loads of all settings on one hole; errors of engines on one window."""
    quick = context.quick
    case = the_case()
    methods, refused, missing = built(case, contact.METHODS, quick)
    there = [name for name in contact.METHODS if name not in missing]
    asked = [(name, each) for name in there for each in settings(name, quick) if label(name, each) in methods]
    sample = points_in(case, 60 if quick else 500).sample(frac=1.0, random_state=1)
    found = errors(methods, sample, case)
    points = contact_costs.Points(np.ascontiguousarray(sample[["x", "y", "z"]]), np.full(len(sample), RADIUS))
    cost = contact_costs.batches(methods, points, most=1_000 if quick else 10_000_000, rounds=3 if quick else 7)
    fronts = found.merge(cost, on="setting")
    fronts.insert(1, "method", fronts["setting"].str.partition(",")[0])
    fronts["pieces"] = [methods[key].pieces for key in fronts["setting"]]
    if not quick:
        fronts = fronts.merge(builds(context.progress(asked, "memory"), case), on="setting", how="left")
    in_loop = [each for each in asked if (each[0] in QUICK_LOADS if quick else each[0] != TOO_SLOW)]
    fronts = fronts.merge(loads(context.progress(in_loop, "loads"), 1.0 if quick else 4.0), on="setting", how="left")
    # Every wall has a mesh; cylinders, arcs and their axis are those of a swept circle.
    any_wall = fronts["method"].isin([name for name, options in asked if {"facets", "cell"} & options.keys()])
    fronts["any_wall"] = any_wall
    for column, rows in (("pareto", fronts), ("pareto_any_wall", fronts[any_wall])):
        fronts[column] = contact_costs.pareto(rows["ns_1000"], rows["rms_error_mm"]).reindex(
            fronts.index, fill_value=False
        )
    chosen = [(key, name) for key, name in ENGINES.items() if engines.installed_version(name) is not None]
    chosen = chosen[:1] if quick else chosen
    window = Window(20.0, 0.5 if quick else engine_fronts.PERIODS)
    tables = {
        "fronts": fronts,
        "refused": refused,
        "packages": brought(contact.REGISTRY, contact.METHODS),
        "engines": engine_fronts.engine_errors(context.progress(chosen, "engines"), window),
        "machine": machine_table(),
    }
    tables, gates = gated.held(tables, {key: (name, {}) for key, name in chosen})
    return Outcome(
        tables=tables,
        checks=[*checks(tables, quick), *gated.checks(gates)],
        notes=notes(missing),
        display={
            "fronts": "Every setting: errors at the same points, cost of a call and of a point in batches, loads",
            "engines": "Engines on one window of one string: off the truth, off themselves, and after a shifted start",
            "gate": gated.CAPTION,
            "packages": "What the package of a method costs its user",
            "refused": "Settings that a library refuses",
            "machine": "What the times depend on",
        },
    )


def checks(tables: Mapping[str, pd.DataFrame], quick: bool) -> list[Check]:
    """Orders, what the front consists of, and what engines do when nothing but the step or a micrometre changes."""
    fronts = tables["fronts"].set_index("setting")
    engine = tables["engines"].set_index("engine")
    made = [
        Check("errors of the engine's own arcs", float(fronts["max_error_mm"][OWN]), 1e-6, "at_most", "mm",
              "they are the hole"),
        Check("FCTD: torque after a start shifted by a micrometre, difference",
              abs(float(engine["torque_spread_percent"]["FCTD"])), 0.01, "at_most", "%",
              "a target: what is settled does not depend on it"),
        Check("FCTD: torque against a sixteenth of its step, difference",
              abs(float(engine["torque_off_itself_percent"]["FCTD"])), 0.1, "at_most", "%", "a target"),
    ]  # fmt: skip
    if quick:
        return made
    sampled = fronts.loc[[label("sdf", {"cell": cell}) for cell in CELLS]]
    own = float(fronts["ns_1000"][OWN])
    meshes = fronts[fronts["pieces"].gt(0) & fronts.index.str.contains("facets")]
    made += [
        Check("sampled distance: order of its error over four cells", log_slope(CELLS, sampled["rms_error_mm"]), 2.0,
              "at_least", "", "3 of quadratic splines in a round hole; a target of 2"),
        Check("settings of other methods that cost less than the engine's own arcs at some size of a call",
              float(np.isfinite(fronts.loc[~fronts["method"].isin(OWN_METHODS), "crossover"]).sum()), 0,
              "at_most", "", "claim of the paper, for every method", timed=True),
        Check("cheapest mesh over the engine's own arcs, a point in a batch of 1000",
              float(meshes["ns_1000"].min() / own), 10.0, "at_least", "",
              "claim of the paper: contact without a mesh is cheaper", timed=True),
        Check("torque with 48 facets, largest difference from arcs",
              float(fronts[fronts.index.str.contains("48 facets")]["torque_off_percent"].abs().max()), 1.0,
              "at_most", "%", "1/cos(π/48) − 1 is 0.2 %; a mean over seconds keeps some of the swing"),
    ]  # fmt: skip
    return made


def notes(missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *left_out(missing),
        "Points lie within 15 mm of touching in a hole that is vertical, builds to 60° and turns, in random order: in "
        "the order of depth the first lie in the straight part, which flatters trees by up to three times. Each method "
        f"was asked before at points {SLID:g} m further up. An error is the largest difference of penetration "
        "from the exact arc.",
        "ns_1000 is the time of a point in a call with 1000 of them; where measured_COUNT is false a larger batch was "
        "not run, since a point takes more than 10 µs (batches of 100 000) or 100 ns (of 10 million), and the time of "
        "the batch before stands for it. Wrapper is what a call with one point spends around its query. Crossover is "
        "the number of points in a call from which a method costs less than the engine's own arcs.",
        "Loads: the curved chain in the engine's own loop, turning and pulled out, over the same windows as with its "
        f"own arcs; {TOO_SLOW} was not run there. A mesh lies inside the hole, so that the string bends less.",
        "Engines: the chain turns for two periods of its twist from FCTD's state. 'off truth' is against the steady "
        "solver, 'off itself' against the same engine at a sixteenth of its step, and 'spread' the difference after "
        "every second segment began a micrometre aside.",
        gated.NOTE,
    ]


STUDY = Study(
    "contact_fronts",
    "What does accuracy of contact cost, by method and setting, and what is it worth in torque?",
    run,
    timed=True,
)
