"""Error against cost of every contact method over its settings, and what an error of contact does to a load."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from fctd import Case
from fctd.arena.result import Comparison
from references import contact, engines
from references.contact.sdf import CELLS, Sdf
from references.contact.tube_mesh import MeshMethod
from references.engines import Window
from references.methods.asked import every_setting
from references.methods.compare import Comparing, Preset
from references.methods.in_hole import SLID
from references.timing.stopwatch import machine_table
from validation.cases import load, rotation, trip
from validation.harness import study
from validation.harness.study import Check, Context, Outcome, Study, log_slope, quartiles_of, ratio_check
from validation.parts import contact_costs, engine_fronts, gated
from validation.parts.brought import brought
from validation.parts.contact_presets import (
    FRONTS,
    PRINTED,
    TOO_SLOW,
    bounds,
    by_size,
    compared,
    in_loop,
    left_out,
    loads,
    settings,
)
from validation.parts.wall_points import near_wall, the_case

OWN = contact_costs.OWN
ENGINES = {"FCTD": "fctd", "Bullet": "bullet", "MuJoCo": "mujoco", "PyElastica": "elastica"}
BIT = 2450.0
OWN_METHODS = ("arcs", "cylinders", "for_loop")
QUICK_LOADS = (OWN, "sdf", "libigl")  # methods whose loads a quick run computes


def cases(seconds: float) -> dict[str, Case]:
    """The curved chain in exact arcs, turning and pulled out, by the load that is read."""
    turning = load("curved_chain", operations=rotation(BIT, seconds, ramp=1.0), wellbore__geometry="arcs")
    pulled = load(
        "curved_chain",
        operations=trip(BIT + 0.5 * seconds, BIT - 0.5 * seconds, 0.5, ramp=1.0),
        string__components__0__segment_length=25.0,
        string__components__0__length=None,
        string__components__0__segments=None,
        wellbore__geometry="arcs",
    )
    return {"torque": turning, "hookload": pulled}


def fronts(comparing: Comparing, runs: Mapping[str, Comparison]) -> pd.DataFrame:
    """A row for each setting: errors, costs in calls of each size, loads, and whether no other one beats it."""
    sizes, found = comparing.preset.sizes, comparing.comparison
    cost = by_size(found, sizes)
    table = settings(found)[FRONTS].merge(cost.drop(columns="method"), on="setting")
    single, many = (cost.set_index("setting")[f"ns_{size}"] for size in (sizes[0], sizes[-1]))
    one = comparing.preset.near.part(slice(0, 1))
    table["single_us"] = 1e-3 * table[f"ns_{sizes[0]}"]
    table["wrapper_us"] = [1e6 * contact_costs.wrapper_time(comparing.built[key], one) for key in table["setting"]]
    table["crossover"] = [contact_costs.crossover(single, many, key) for key in table["setting"]]
    for name, run in runs.items():
        off = loads(run).set_index("setting")
        table[f"{name}_off_percent"] = table["setting"].map(off[f"{name}_difference_percent"])
        table[f"{name}_failed"] = table["setting"].map(off["failed"])
    # Every wall has a mesh; cylinders, arcs and their axis are those of a swept circle.
    table["any_wall"] = [isinstance(comparing.built[key], MeshMethod | Sdf) for key in table["setting"]]
    for column, rows in (("pareto", table), ("pareto_any_wall", table[table["any_wall"]])):
        best = contact_costs.pareto(rows["ns_1000"], rows["rms_error_mm"])
        table[column] = best.reindex(table.index, fill_value=False)
    return table


def run(context: Context) -> Outcome:
    """Errors, costs and loads of all settings on one hole; errors of engines on one window."""
    quick, case = context.quick, the_case()
    near, named = near_wall(case, 60 if quick else 500)
    rows = every_setting(contact.METHODS, defaults=quick)
    preset = Preset(
        case, near, regions=named, sizes=(1, 1000) if quick else (1, 1000, 100_000, 10_000_000),
        memory=lambda _: not quick,
    )  # fmt: skip
    comparing = compared(preset, rows, context)
    in_loops = [
        (row.name, row.options) for row in rows if row.name in QUICK_LOADS or not (quick or row.name == TOO_SLOW)
    ]
    runs = {name: in_loop(of, in_loops, context) for name, of in cases(2.0).items()}
    refused, missing = left_out(comparing.comparison)
    chosen = [(key, name) for key, name in ENGINES.items() if engines.installed_version(name) is not None]
    chosen = chosen[:1] if quick else chosen
    window = Window(20.0, 0.5 if quick else engine_fronts.PERIODS)
    table = fronts(comparing, runs)
    tables = {
        "fronts": table,
        "settings": table[[*PRINTED, "torque_off_percent", "hookload_off_percent"]],
        "refused": refused,
        "packages": brought(contact.REGISTRY, contact.METHODS),
        "engines": engine_fronts.engine_errors(context.progress(chosen, "engines"), window),
        "machine": machine_table(),
    }
    tables, gates = gated.held(tables, {key: (name, {}) for key, name in chosen})
    return Outcome(
        tables=tables,
        checks=[*bounds(comparing.comparison), *checks(tables, quick), *gated.checks(gates)],
        notes=notes(missing),
        display={
            "settings": "Every setting: cost of a call with one point and of a point of 1000, errors, change of loads",
            "engines": "Engines on one window of one string: off the truth, off themselves, and after a shifted start",
            "gate": gated.CAPTION,
            "packages": "What the package of a method costs its user",
            "refused": "Settings that a library refuses",
            "machine": "What the times depend on",
        },
        comparisons={"comparison": comparing.comparison, **runs},
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
    sampled = fronts.loc[[f"sdf, cell={cell}" for cell in CELLS]]
    meshes = fronts[fronts.index.str.contains("facets")]
    made += [
        Check("sampled distance: order of its error over four cells", log_slope(CELLS, sampled["rms_error_mm"]), 2.0,
              "at_least", "", "3 of quadratic splines in a round hole; a target of 2"),
        Check("settings of other methods that cost less than the engine's own arcs at some size of a call",
              float(np.isfinite(fronts.loc[~fronts["method"].isin(OWN_METHODS), "crossover"]).sum()), 0,
              "at_most", "settings", "claim of the paper, for every method", timed=True),
        ratio_check("cheapest mesh over the engine's own arcs, a point in a batch of 1000",
                    quartiles_of(meshes.sort_values("arcs_1000").iloc[0], "arcs_1000"), 10.0, "at_least",
                    "claim of the paper: contact without a mesh is cheaper"),
        Check("torque with 48 facets, largest difference from arcs",
              float(fronts[fronts.index.str.contains("facets=48")]["torque_off_percent"].abs().max(skipna=False)), 1.0,
              "at_most", "%", "1/cos(π/48) − 1 is 0.2 %"),
    ]  # fmt: skip
    return made


def notes(missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *study.left_out(missing),
        "Points lie within 15 mm of touching in a hole that is vertical, builds to 60° and turns, in random order: in "
        "the order of depth the first lie in the straight part, which flatters trees by up to three times. Each method "
        f"was asked before at points {SLID:g} m further up. An error is the largest difference of penetration "
        "from the exact arc.",
        "ns_1000 is the processor time of a point in a call with 1000 of them, the median of rounds in turns, between "
        "its quartiles; where measured_COUNT is false such a call takes too long, and the largest call before stands "
        "for it. Wrapper is what a call with one point spends around its query. Crossover is "
        "the number of points in a call from which a method costs less than the engine's own arcs.",
        "Loads: the curved chain in the engine's own loop, turning and pulled out, from one start over whole "
        f"periods of its slowest vibration, against its own arcs; {TOO_SLOW} was not run there. A mesh lies inside "
        "the hole, so that the string bends less.",
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
