"""What a simulated second costs, with and without contact, in every engine; the paper's ratios; the targets."""

from collections.abc import Callable, Collection
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

import fctd.mechanics.state
from fctd.arena.result import Quartiles
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.topdrive import Motion
from fctd.simulation.run import Run
from references import contact, engines
from references.engines import Stepper, gate
from references.engines.free_bodies import FreeBodies
from references.timing.stopwatch import machine_table, race, units_for
from references.timing.workloads import NoWall, asking, copy_of, moving
from validation.harness.study import ENDS, Check, Context, Kind, Outcome, Study, left_out, quartiles_of, ratio_check
from validation.parts import gated, speed_kernel
from validation.parts.contact_presets import FULL_ONLY, TOO_SLOW
from validation.parts.speed_kernel import BEST, CONTACT, LEAD, chain, less, real_time, step_on, table_of

SEGMENTS = (60, 170)  # of the paper's FCTD model and of its Adams model
# After this time a wave of torque has run down 1500 m of steel [s].
PASSED = 0.5
OWN, EQUAL = "own step", "equal step"
# The last is the string in contact after its hole is removed: the cost of a step without the contact.
FREE, TOUCHING, TAKEN = "no contact", "contact", "wall taken away"
# Without a hole, hung from the same top.
OPEN = {"contact__enabled": False, "wellbore__stations": [[0, 0, 0], [2600, 0, 0]]}
FCTD, CHAIN = "FCTD", "MuJoCo ball chain"
# Independent engines, keys of references.engines.
OTHERS = {"Bullet": "bullet", "MuJoCo": "mujoco", "PyElastica": "elastica", CHAIN: "mujoco_chain"}
# Contact methods that take the place of the engine's in its loop; its own are in the study contact_swap.
IN_LOOP = " in our loop"
OURS = ("cylinders", "arcs", "for_loop")
LABELS = {"fcl": "FCL", "bullet": "Bullet's contact", "mujoco": "MuJoCo's contact"}
CHEAPER = {"fcl": {"query": "collide"}, "coal": {"query": "collide"}}  # the cheaper of their two queries
SWAP_TARGET = 200.0
LEFT_AS_OURS = "the same with FCTD's own growth from 60 to 170 segments in place of 170/60"
LEAST_OTHER = 5.0  # least cost of every other engine over FCTD
COLUMNS = [
    "state", "segments", "step", "engine", "step_ms", *(f"ms_per_simulated_s{end}" for end in ENDS),
    "real_time_factor", *(f"ratio_to_fctd{end}" for end in ENDS), "check", "gate",
]  # fmt: skip


def swapped(quick: bool) -> dict[str, str]:
    """Name in the tables -> contact method, of all registered methods that are fast enough to be timed."""
    left_out = {*OURS, TOO_SLOW, *(FULL_ONLY if quick else ())}
    return {LABELS.get(method, method) + IN_LOOP: method for method in contact.METHODS if method not in left_out}


def available(quick: bool) -> tuple[list[str], list[str]]:
    """Names that can be timed, and those whose package is missing."""
    found = {FCTD: engines.installed_version("fctd")}
    found |= {name: contact.installed_version(method) for name, method in swapped(quick).items()}
    found |= {name: engines.installed_version(key) for name, key in OTHERS.items()}
    return [name for name in found if found[name]], [name for name in found if not found[name]]


def begin(name: str, start: Run, state: str, step: float | None) -> tuple[Run, Stepper]:
    """A competitor's stepper at the state of a run, and the run that it works on."""
    if name.endswith(IN_LOOP):
        method = swapped(quick=False)[name]
        # Without a wall: our loop of two compiled calls with an empty query.
        run = asking(
            start, contact.build(method, start.case, **CHEAPER.get(method, {})) if state == TOUCHING else NoWall()
        )
    else:
        run = copy_of(start)
    if state == TAKEN:
        run.laws = run.laws._replace(geometry=fctd.mechanics.state.OPEN)
    stepper = engines.build(OTHERS.get(name, "fctd"), **({} if step is None else {"step": step})).begin(run)
    if isinstance(stepper, FreeBodies):
        stepper.watch = False  # reading the state for our checks is no cost of the engine
    return run, stepper


def verdict(run: Run, stepper: Stepper) -> str:
    """Whether the timed string is still a valid string in its hole."""
    try:
        stepper.refresh()
        run.check()
    except UnstableError as error:
        return f"invalid: {error}"
    return "valid"


class Entry(NamedTuple):
    """One engine in a race: number of segments, contact state and engine."""

    segments: int
    state: str
    engine: str

    @property
    def baseline(self) -> "Entry":
        """FCTD in the same state; in contact where the wall is taken away."""
        return Entry(self.segments, TOUCHING if self.state == TAKEN else self.state, FCTD)


class Racer(NamedTuple):
    """A stepper in motion, the run that it works on, and the motion of its top drive."""

    run: Run
    stepper: Stepper
    motion: Motion


def entries(kind: str, names: list[str], counts: Collection[int]) -> list[Entry]:
    """All steppers of a race with one kind of step."""
    found = [
        Entry(n, state, name)
        for n in counts
        for state in (FREE, TOUCHING)
        for name in names
        if state == FREE or name != CHAIN
    ]
    if kind == OWN:
        return found + [Entry(n, TOUCHING, BEST) for n in counts]
    return found + [Entry(n, TAKEN, name) for n in counts for name in names if name == FCTD or name.endswith(IN_LOOP)]


def race_engines(
    names: list[str], best: dict[int, float], rounds: int, aim: float, context: Context
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Wall time of a simulated second of every engine, at its own step and at the shortest of all steps, and its gate.

    best : FCTD's largest stable step [s] for each number of segments, timed in addition to its own step.  aim : length
    of a call [s].  Before a race every engine is held to the gate at that kind of step, with the shortest string (the
    quick way at its own step alone).  Everything with the same kind of step is one race, so that any two rows of it can
    be compared.
    """
    cases = {(n, state): chain(n, **(OPEN if state == FREE else {})) for n in best for state in (FREE, TOUCHING)}
    starts = {key: moving(case, LEAD) for key, case in cases.items()}
    starts |= {(n, TAKEN): starts[n, TOUCHING] for n in best}
    tables: list[pd.DataFrame] = []
    gate_tables: list[pd.DataFrame] = []
    own: dict[Entry, float] = {}
    for kind in (OWN, EQUAL):
        racers: dict[Entry, Racer] = {}
        for entry in context.progress(entries(kind, names, best), kind):
            n, state, name = entry
            start, motion = starts[n, state]
            step = best[n] if name == BEST else None
            if kind == EQUAL:
                step = min(s for other, s in own.items() if other.segments == n)
            if name == CHAIN:  # it starts at rest, and before the first wave arrives there is little to compute
                run, stepper = begin(name, moving(cases[n, state], 0.0)[0], state, step)
                stepper.advance(motion, PASSED)
            else:
                run, stepper = begin(name, start, state, step)
            own.setdefault(entry, stepper.step)
            racers[entry] = Racer(run, stepper, motion)
        if kind == OWN or not context.quick:
            given = {} if kind == OWN else {"step": min(s for other, s in own.items() if other.segments == min(best))}
            gates = gated.examined(
                {each: (OTHERS.get(each, "fctd"), given) for each in names if not each.endswith(IN_LOOP)}
            )
            gate_tables.append(gate.table(gates).assign(step=kind))
        tables.append(race_of(racers, gates, rounds, aim).assign(step=kind))
    table = pd.concat(tables, ignore_index=True)
    for end in ENDS:
        table[f"ms_per_simulated_s{end}"] = table[f"ns{end}"] / 1e6
    return table.assign(real_time_factor=1e9 / table["ns"])[COLUMNS], pd.concat(gate_tables, ignore_index=True)


def race_of(racers: dict[Entry, Racer], gates: gated.Gates, rounds: int, aim: float) -> pd.DataFrame:
    """One race, a row for each stepper with the validity of its string at the end; closes the steppers.

    gates : of the engines; our loop has FCTD's, whatever its contact.  The string that was timed is held to its own.
    """
    actions: dict[str, Callable[[], object]] = {}
    counts, baseline = {}, {}
    for entry, racer in racers.items():
        steps, key = partial(step_on, racer.stepper, racer.motion), str(entry)
        count = units_for(steps, aim)
        actions[key], counts[key] = partial(steps, count), count * racer.stepper.step
        baseline[key] = str(entry.baseline)
    table = race(actions, counts, rounds, baseline)
    table[list(Entry._fields)] = list(racers)
    table[[f"ratio_to_fctd{end}" for end in ENDS]] = table[[f"ratio{end}" for end in ENDS]]
    table["step_ms"] = [1e3 * racer.stepper.step for racer in racers.values()]
    table["check"] = [
        "falls" if entry.state == TAKEN else verdict(racer.run, racer.stepper) for entry, racer in racers.items()
    ]
    table["gate"] = [
        gate.verdict([*gates.get(entry.engine, gates[FCTD]), *gate.in_motion(*racer, touching=wall)], touching=wall)
        for entry, racer in racers.items()
        for wall in (entry.state == TOUCHING,)
    ]
    for racer in racers.values():
        racer.stepper.close()
    return table


def ratios(times: pd.DataFrame, scaling: pd.DataFrame) -> pd.DataFrame:
    """The paper's ratios and ours, each with the differences that it contains."""
    second = scaling.set_index("segments")
    grown = quartiles_of(second.loc[170], "ms_per_simulated_s").over(quartiles_of(second.loc[60], "ms_per_simulated_s"))
    exact = Quartiles(median=1.0, low=1.0, high=1.0)
    rows: list[tuple[str, str, float | Quartiles, str, str]] = [
        ("paper", "MSC Adams 34 h with 170 segments : FCTD 4 h with 60, contact", 34 / 4,
         "contact, program, solver, step, number of segments", ""),
        ("paper", "the same for each segment, 34/4 × 60/170", 34 / 4 * 60 / 170, "contact, program, solver, step", ""),
        ("paper", "MSC Adams 12 s : FCTD 4 s, no contact, equal numbers", 12 / 4, "program, solver", ""),
        ("paper", "what is left for contact, (34/4 × 60/170) / (12/4)", 34 / 4 * 60 / 170 / 3,
         "contact, if cost grows with the number of segments alone and steps were equal", ""),
        ("paper", LEFT_AS_OURS, exact.over(grown).times(34 / 4 / 3),
         f"contact, if steps were as short as segments ask: a simulated second of 170 costs FCTD {grown.median:.1f} "
         "of 60", ""),
    ]  # fmt: skip
    at = times.set_index(["state", "step", "segments", "engine"]).sort_index()
    held, counts = at["gate"], sorted(times["segments"].unique())

    def of(column: str, *key: Any) -> Quartiles:
        return quartiles_of(at.loc[key], column)

    ratio, wall = partial(of, "ratio_to_fctd"), partial(of, "ms_per_simulated_s")
    for name in [name for name in times["engine"].unique() if name not in (FCTD, BEST, CHAIN)]:
        in_loop = name.endswith(IN_LOOP)
        for n in counts:
            if in_loop:
                both, loop, own = (
                    ratio(TOUCHING, EQUAL, n, name), ratio(TAKEN, EQUAL, n, name), ratio(TAKEN, EQUAL, n, FCTD)
                )  # fmt: skip
                alone = less(both, loop).over(less(exact, own))
                rows += [
                    ("ours", f"{name} : FCTD, {n} segments, a step", ratio(TOUCHING, EQUAL, n, name),
                     "contact, and a call from Python in every step", held[TOUCHING, EQUAL, n, name]),
                    ("ours", f"{name} : FCTD, {n} segments, each less its own loop without contact", alone, "contact",
                     held[TOUCHING, EQUAL, n, name]),
                ]  # fmt: skip
                continue
            rows += [
                ("ours", f"{name} : FCTD, {n} segments, contact, equal step", ratio(TOUCHING, EQUAL, n, name),
                 "contact, program, solver", held[TOUCHING, EQUAL, n, name]),
                ("ours", f"{name} : FCTD, {n} segments, contact, own steps", ratio(TOUCHING, OWN, n, name),
                 "contact, program, solver, step", held[TOUCHING, OWN, n, name]),
                ("ours", f"{name} : FCTD, {n} segments, no contact, own steps", ratio(FREE, OWN, n, name),
                 "program, solver, step", held[FREE, OWN, n, name]),
            ]  # fmt: skip
        if len(counts) > 1:
            few, many = counts
            across = wall(TOUCHING, OWN, many, name).over(wall(TOUCHING, OWN, few, FCTD))
            what = "contact, call from Python" if in_loop else "contact, program, solver, step"
            rows += [
                ("ours", f"{name} with {many} segments : FCTD with {few}, contact, own steps", across,
                 f"{what}, number of segments and their shorter step", held[TOUCHING, OWN, many, name]),
                ("ours", f"the same for each segment, × {few}/{many}", across.times(few / many),
                 f"{what}, shorter step of shorter segments", held[TOUCHING, OWN, many, name]),
            ]  # fmt: skip
    told = []
    for whose, name, value, what, gate_of in rows:
        spread = value if isinstance(value, Quartiles) else Quartiles(median=value, low=np.nan, high=np.nan)
        told.append((whose, name, spread.median, spread.low, spread.high, what, gate_of))
    return pd.DataFrame(told, columns=["whose", "ratio", "value", "value_low", "value_high", "contains", "gate"])


def targets(times: pd.DataFrame, found: dict[str, pd.DataFrame]) -> list[Check]:
    """The targets for one free core with compiled code loaded.

    Times are those of the fastest round, which other processes disturb least; a ratio has the quartiles of its rounds.
    """
    kernel, scaling, steady = (found[name] for name in ("kernel", "scaling", "steady"))
    ns = kernel.set_index("name")["ns_least"]
    short = scaling[scaling["segments"] <= 1000]
    made: list[tuple[str, float, float, Kind, str]] = [
        ("segment-step with contact, 60 to 1000 segments, slowest", short["ns_least"].max(), 25.0, "at_most", "ns"),
        ("contact's addition to a segment-step", ns[CONTACT] - ns["no contact"], 8.0, "at_most", "ns"),
        ("query in the step, cylinders", ns["query in the step, cylinders"], 5.0, "at_most", "ns"),
        ("query in the step, arcs", ns["query in the step, arcs"], 12.0, "at_most", "ns"),
        ("query of free points, cylinders", ns["query of free points, cylinders"], 5.0, "at_most", "ns"),
        ("query of free points, arcs", ns["query of free points, arcs"], 12.0, "at_most", "ns"),
    ]
    for row, bound in zip(steady.to_dict("records"), (1.0, 9.0), strict=True):
        made.append((f"steady depth, {row['segments']:.0f} segments", row["slowest_ms"], bound, "at_most", "ms"))
    source = "target of this project for one free core, compiled code loaded"
    checks = [
        Check(name, float(value), bound, kind, unit, source, timed=True) for name, value, bound, kind, unit in made
    ]
    factor = "real-time factor, 60 segments, largest stable step"
    checks.append(ratio_check(factor, real_time(kernel, BEST), 3000.0, "at_least", source))
    if scaling["segments"].max() == max(speed_kernel.LENGTHS):
        name = "exponent of a step's cost, 60 to 10000 segments"
        checks.append(ratio_check(name, speed_kernel.exponent(scaling), 1.05, "at_most", source))
    return [*swap_checks(times), *checks]


def swap_checks(times: pd.DataFrame) -> list[Check]:
    """Ratios within one race; what an old processor, or code compiled for one, leaves of them is in expected.toml."""
    equal = times[(times["state"] == TOUCHING) & (times["step"] == EQUAL) & (times["segments"] == SEGMENTS[0])]
    ratios = {row["engine"]: quartiles_of(row, "ratio_to_fctd") for row in equal.to_dict("records")}
    made = []
    if swapped := ratios.get("FCL in our loop"):
        made.append(
            ratio_check("FCL in our loop over FCTD, a step of 60 segments", swapped, SWAP_TARGET, "at_least",
                        "target of this project; only the contact query is swapped, equal step")
        )  # fmt: skip
    if others := [ratio for engine, ratio in ratios.items() if engine != FCTD]:
        made.append(
            ratio_check("fastest other engine over FCTD, contact, equal step",
                        min(others, key=lambda ratio: ratio.median), LEAST_OTHER, "at_least",
                        "claim of the paper: the FCTD model is the faster one")
        )  # fmt: skip
    invalid = float(times["check"].str.startswith("invalid").sum())
    return [
        *made,
        Check(
            "timed strings that did not stay in their hole", invalid, 0, "at_most", "", "finite, in the hole, unfolded"
        ),
    ]


def run(context: Context) -> Outcome:
    """The ladder of steps, the races of all engines, FCTD alone; quick: 60 segments and fewer, shorter rounds."""
    quick = context.quick
    names, missing = available(quick)
    counts = SEGMENTS[:1] if quick else SEGMENTS
    steps = pd.concat([speed_kernel.ladder(n, 5.0 if quick else 60.0) for n in counts], ignore_index=True)
    best = {n: float(steps.loc[steps["holds"] & (steps["segments"] == n), "step_ms"].max()) / 1e3 for n in counts}
    times, rules = race_engines(names, best, 9 if quick else 25, 0.002 if quick else 0.01, context)
    found = {
        "kernel": speed_kernel.kernel(best[SEGMENTS[0]], 25 if quick else 201, 0.002),
        "scaling": speed_kernel.scaling((60, 170, 1000) if quick else speed_kernel.LENGTHS, 9 if quick else 51, 0.005),
        "steady": speed_kernel.steady(5 if quick else 41),
    }
    held = targets(times, found)
    made = swap_checks(times) if quick else held  # absolute times on a busy machine are no check; the ratios are
    tables = {
        "times": times,
        "gate": rules,
        "ratios": ratios(times, found["scaling"]),
        "targets": table_of(held, made, found["kernel"]),
        "steps": steps,
        **found,
        "machine": machine_table(),
    }
    return Outcome(
        tables=tables,
        checks=made,
        notes=notes(found["kernel"], missing),
        display={
            "times": "Wall time of a simulated second of the curved chain, turning in contact or hanging free",
            "gate": gated.CAPTION,
            "ratios": "The paper's ratios and ours, and the differences that each contains",
            "targets": "Targets and measured values",
            "steps": "FCTD's largest stable step: loads over the same window against those of the smallest step",
            "kernel": "FCTD alone: ns per segment-step or per point",
            "scaling": "FCTD with more and more segments, all in contact",
            "steady": "Milliseconds per steady depth of paper-well",
            "machine": "What the times depend on",
        },
    )


def notes(kernel: pd.DataFrame, missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *left_out(missing),
        gated.NOTE,
        "All engines start with the same string from the same state in motion, FCTD's after some seconds (MuJoCo's "
        "ball chain, which hangs free, starts from rest); nothing is extrapolated, and times of building and "
        "compiling are excluded. All engines take turns in rounds of some milliseconds. A time and a ratio are the "
        "median of the rounds, low and high their quartiles; a ratio is taken within each round, and between numbers "
        "of segments from the quartiles of both times.",
        "An engine's own step is its default in this suite: FCTD and the swapped loops 0.8 of the bound of the "
        "stiffest mode, Bullet and MuJoCo half of FCTD's, PyElastica 0.3 of its own. The equal step is the shortest "
        "of these. FCTD's largest stable step is found on a ladder.",
        "Contact methods in our loop are called from Python once per step for all points, FCL and coal with the "
        f"cheaper of their two queries ({TOO_SLOW} is left out: milliseconds per point; its cost is in contact_swap); "
        "without contact the same loop runs with an empty query. Rows with the wall taken away are the string in "
        "contact after its hole is removed, timed in the same race. Bullet, MuJoCo and PyElastica are driven from "
        "Python too, step by step; Bullet and MuJoCo get their joint wrenches from FCTD's compiled code. Readings "
        "that only our checks need are off in the races.",
        "The paper's two ratios do not separate the contact method: 34 h to 4 h is a ratio of 3.0 per segment, and "
        "without contact the ratio of the same two programs is 3 too. By those numbers contact gains nothing; the "
        "paper does not print the steps. If 170 segments shortened the steps as much as in FCTD, the ratio left for "
        "contact is below 1.",
        f"Real-time factor of the curved chain with 60 segments at the default step: "
        f"{real_time(kernel, CONTACT).median:.0f} (at the largest stable step {real_time(kernel, BEST).median:.0f}). "
        "Absolute times belong to one machine, and on a busy machine only the fastest round is close to the time of a "
        "free core: targets of absolute times are held to that round.",
    ]


STUDY = Study(
    "speed",
    "What does a simulated second cost, in FCTD and in other engines, and what do the ratios contain?",
    run,
    reproduce=True,
    timed=True,
)
