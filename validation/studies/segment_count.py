"""Accuracy and cost against the number of segments and the length of the cylinders (§5.6)."""

import time
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case, simulate
from fctd.arena.result import Quartiles
from fctd.arrays import Array
from fctd.model import survey
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from validation.cases import load, rotation
from validation.cases.segmented_wells import WELLS, Well
from validation.harness.study import (
    ENDS,
    Check,
    Context,
    Outcome,
    Rows,
    Study,
    fitted_exponent,
    log_slope,
    quartiles_of,
    ratio_check,
    table_of_rows,
)
from validation.parts.windows import last_seconds

# About half an octave apart, the paper's 60 among them; the reference is eight times the last.
COUNTS = (5, 7, 10, 15, 20, 30, 40, 60, 80, 120, 160, 240, 320, 480, 640)
QUICK_COUNTS = (20, 40, 60, 80, 160, 320, 640)
FINEST = (5120, 2560, 1280, 640)
FITTED_FROM = 20  # segments from which on orders are fitted
STEPPED_COUNTS = (10, 15, 30, 60, 120, 240, 480, 960)
STEPPED = ("paper-well", "4.5°/30 m")
CYLINDERS = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)  # [m]
IN_CYLINDERS = 320  # segments of the string in which the cylinders are varied
ERRORS = ("torque", "hookload", "contact", "moment", "bend_moment")
LIMITS = (1.0, 0.1)  # percent
STEADY, ITERATION = "a steady string", "an iteration of it"
STEP, SECOND = "a step of the stepper", "a simulated second"


class Answer(NamedTuple):
    """The quantities compared between strings.

    torque [N m], hookload [N] : turning and picking up; friction : Σ r μ F_n [N m]; grid (m,) depths [m];
    contact (m,) : side force from the top down to there [N]; moment (m,) [N m]; touching, stretches : contact
    points, and runs of them on one side.
    """

    torque: float
    hookload: float
    friction: float
    contact: Array
    moment: Array
    bend_moment: float
    touching: int
    stretches: int
    iterations: int
    cost_ms: float


def answer(of: Well, case: Case, repeats: int = 1) -> Answer | None:
    """A string turning off bottom and picking up; None where one of them has no balance."""
    solver = Solver(case)
    points = {}
    for kind in ("rotate_off_bottom", "trip_out"):
        point = solver.solve(kind, steady_rates(case, kind), of.bit)
        if point.status != "converged":
            return None
        points[kind] = point
    times = []
    rates = steady_rates(case, "rotate_off_bottom")
    for _ in range(repeats):
        began = time.process_time()
        solver.solve("rotate_off_bottom", rates, of.bit)
        times.append(1e3 * (time.process_time() - began))
    turning = points["rotate_off_bottom"]
    return _read(of, turning, points["trip_out"].hookload, min(times))


def _read(of: Well, point: Equilibrium, hookload: float, cost_ms: float) -> Answer:
    profile = point.profile
    md, force = profile["md_m"].to_numpy(), profile["contact_force_N"].to_numpy()
    grid = _grid(of, point.case)
    # Half of a point's own force counts at the point, so that the sum equals that of the distributed load.
    contact = np.interp(grid, md, np.cumsum(force) - 0.5 * force)
    moment = np.interp(grid, md, profile["bending_moment_N_m"])
    high = np.cos(np.radians(profile["contact_angle_deg"].to_numpy())) > 0
    side = np.where(force > 0, np.where(high, 1, -1), 0)
    starts = side[np.concatenate([[True], np.diff(side) != 0])]
    return Answer(
        torque=point.surface_torque,
        hookload=hookload,
        friction=point.sum_r_mu_fn,
        contact=contact,
        moment=moment,
        bend_moment=float(np.interp(of.bend, grid, moment)),
        touching=int((force > 0).sum()),
        stretches=int((starts != 0).sum()),
        iterations=point.iterations,
        cost_ms=cost_ms,
    )


def _grid(of: Well, case: Case) -> Array:
    """Depths [m] at which strings are compared."""
    return np.linspace(case.string.top_md, of.bit, 4001)


def moment_error(found: Array, exact: Array) -> float:
    """RMS along the string, in percent."""
    return 100 * float(np.sqrt(((found - exact) ** 2).mean() / (exact**2).mean()))


def errors(found: Answer, exact: Answer) -> dict[str, float]:
    """Errors in percent: of loads, of side force (mean over depth) and moment (RMS) along the string."""
    frictionless = exact.friction < 1e-6 * exact.hookload
    return {
        "torque_percent": float("nan") if frictionless else 100 * abs(found.torque / exact.torque - 1),
        "hookload_percent": 100 * abs(found.hookload / exact.hookload - 1),
        "contact_percent": 100 * float(np.abs(found.contact - exact.contact).mean() / exact.contact[-1]),
        "moment_percent": moment_error(found.moment, exact.moment),
        "bend_moment_percent": 100 * abs(found.bend_moment / exact.bend_moment - 1),
    }


@table_of_rows
def count_segments(name: str, counts: Sequence[int], finest: Sequence[int], repeats: int) -> Rows:
    """Errors of each count against the finest that has an answer; ``doubt`` is the change from half of that."""
    of, hole = WELLS[name], {"geometry": "arcs"}
    exact, reference = None, 0
    for reference in finest:
        exact = answer(of, of.case(reference, hole))
        if exact is not None:
            break
    assert exact is not None, f"{name}: no reference"
    half = answer(of, of.case(reference // 2, hole))
    assert half is not None, f"{name}: no reference"
    doubt = {key.replace("_percent", "_doubt_percent"): value for key, value in errors(half, exact).items()}
    for count in counts:
        found = answer(of, of.case(count, hole), repeats)
        row: dict[str, Any] = {"well": name, "segments": count, "reference": reference}
        if found is None:
            yield row | {"status": "no answer"}
            continue
        row |= {"status": "converged", "torque_kN_m": found.torque / 1e3, "hookload_kN": found.hookload / 1e3}
        row |= errors(found, exact) | doubt
        row |= {
            "touching": found.touching, "stretches": found.stretches, "stretches_of_reference": exact.stretches,
            "iterations": found.iterations, "cost_ms": found.cost_ms,
        }  # fmt: skip
        yield row


def order(sizes: "pd.Series[float]", found: "pd.Series[float]", doubt: float) -> float:
    """Slope of log error over log size, of errors well above the reference's uncertainty; NaN for fewer than four."""
    clear = (found > 3 * doubt).to_numpy()
    if clear.sum() < 4:
        return float("nan")
    return log_slope(sizes[clear], found[clear])


@table_of_rows
def observed_orders(table: pd.DataFrame) -> Rows:
    """Observed order of every quantity in every well, from ``FITTED_FROM`` segments on."""
    for name, of_well in table.groupby("well", sort=False):
        fine = of_well[of_well["segments"] >= FITTED_FROM]
        orders = {q: -order(fine["segments"], fine[f"{q}_percent"], fine[f"{q}_doubt_percent"].iloc[0]) for q in ERRORS}
        yield {"well": name, **orders}


@table_of_rows
def enough(table: pd.DataFrame) -> Rows:
    """The smallest count of each well and quantity from which on the error stays within 1 % and 0.1 %; NaN: none."""
    for name, of_well in table.groupby("well", sort=False):
        for quantity in ERRORS:
            found = of_well.set_index("segments")[f"{quantity}_percent"]
            if found.isna().all():
                continue
            row: dict[str, Any] = {"well": name, "quantity": quantity}
            for limit in LIMITS:
                too_far = found.index[~(found <= limit)]
                within = found.index[found.index > too_far.max()] if len(too_far) else found.index
                row[f"within_{limit:g}_percent"] = float(within.min()) if len(within) else float("nan")
            yield row
        wrong = of_well.loc[of_well["stretches"] != of_well["stretches_of_reference"], "segments"]
        right = of_well.loc[of_well["segments"] > wrong.max(), "segments"] if len(wrong) else of_well["segments"]
        first = float(right.min()) if len(right) else float("nan")
        yield {"well": name, "quantity": "number of contacts"} | {f"within_{x:g}_percent": first for x in LIMITS}


@table_of_rows
def vary_cylinders(name: str, lengths: Sequence[float]) -> Rows:
    """Errors of one string in ever longer cylinders against the same string in the exact arcs."""
    of, arcs = WELLS[name], WELLS[name].case(IN_CYLINDERS, {"geometry": "arcs"})
    stations = arcs.wellbore.trajectory
    sharpest = float((survey.dogleg(stations) / np.diff(stations[:, 0])).max())
    widest = max(component.contact_diameter for component in arcs.string.components)
    clearance = 0.5 * (min(interval.diameter for interval in arcs.wellbore.intervals) - widest)
    exact = answer(of, arcs)
    assert exact is not None, f"{name}: no answer in arcs"
    for length in lengths:
        row: dict[str, Any] = {"well": name, "cylinder_length_m": length}
        row |= {"miss_mm": 1e3 * sharpest * length**2 / 8, "clearance_mm": 1e3 * clearance}
        found = answer(of, of.case(IN_CYLINDERS, {"geometry": "cylinders", "cylinder_length": length}))
        yield row | ({"status": "no answer"} if found is None else {"status": "converged"} | errors(found, exact))


def step_through(name: str, counts: Sequence[int]) -> pd.DataFrame:
    """The stepper at each count: torque beside the steady solver's, and its cost; a minute turning off bottom.

    Torque and moment also against the stepper's own at the largest count, independent of the solver.
    """
    of, rows = WELLS[name], []
    moments: dict[int, Array] = {}
    for count in counts:
        case = of.case(count, {"geometry": "arcs"})
        operations = load("curved_chain", operations=rotation(of.bit, 60.0, 15.0)).operations
        began = time.process_time()
        result = simulate(case.model_copy(update={"operations": operations}))
        spent = time.process_time() - began
        row: dict[str, Any] = {"well": name, "segments": count, "status": result.status}
        if result.status == "completed":
            steady = Solver(case).solve("rotate_off_bottom", steady_rates(case, "rotate_off_bottom"), of.bit)
            torque = last_seconds(result, 30.0)["surface_torque_N_m"]
            profile = result.profile
            moments[count] = np.interp(_grid(of, case), profile["md_m"], profile["bending_moment_N_m"])
            row |= {
                "torque_kN_m": torque / 1e3,
                "off_steady_percent": 100 * (torque / steady.surface_torque - 1),
                "step_ms": 1e3 * result.run["step_s"],
                "ms_per_simulated_s": 1e3 * spent / result.run["simulated_s"],
                "us_per_step": 1e6 * spent / result.run["steps"],
            }
        rows.append(row)
    table, largest = pd.DataFrame(rows), max(moments)
    torques = table.set_index("segments")["torque_kN_m"]
    table["torque_off_largest_percent"] = 100 * (table["torque_kN_m"] / torques[largest] - 1).abs()
    off = {n: moment_error(moment, moments[largest]) for n, moment in moments.items()}
    table["moment_off_largest_percent"] = table["segments"].map(off)
    return table


@table_of_rows
def cost_laws(counts: pd.DataFrame, stepped: pd.DataFrame) -> Rows:
    """How cost grows: a steady string and one iteration of it in every well, a step and a second of the stepper."""
    for name, of_well in counts[counts["segments"] >= FITTED_FROM].groupby("well", sort=False):
        size = of_well["segments"]
        yield {"well": name, "cost_of": STEADY, **_growth(size, of_well["cost_ms"])}
        yield {"well": name, "cost_of": ITERATION, **_growth(size, of_well["cost_ms"] / of_well["iterations"])}
    for name, of_well in stepped.dropna().groupby("well", sort=False):
        size = of_well["segments"]
        yield {"well": name, "cost_of": STEP, **_growth(size, of_well["us_per_step"])}
        yield {"well": name, "cost_of": SECOND, **_growth(size, of_well["ms_per_simulated_s"])}


def _growth(counts: "pd.Series[float]", costs: "pd.Series[float]") -> dict[str, float]:
    """Exponent p of cost ~ N^p over all counts, and the factor 2^p by which cost grows when the count doubles.

    A fit with its quartiles, since on a busy machine a single count may take twice as long.
    """
    fitted = dict(zip(ENDS, fitted_exponent(counts, costs).all, strict=True))
    grown = {f"growth_when_doubled{end}": 2**exponent for end, exponent in fitted.items()}
    return {f"exponent{end}": exponent for end, exponent in fitted.items()} | grown


def run(context: Context) -> Outcome:
    """Counts in every well, the stepper in two, cylinders in every well; three wells and fewer counts when quick."""
    names = ["paper-well", "4.5°/30 m", "30°/100 ft"] if context.quick else list(WELLS)
    sizes = QUICK_COUNTS if context.quick else COUNTS
    first = WELLS[names[0]]
    answer(first, first.case(10, {"geometry": "arcs"}))  # compile
    counts = pd.concat(
        [count_segments(name, sizes, FINEST, 1 if context.quick else 5) for name in context.progress(names, "counts")],
        ignore_index=True,
    )
    most = {"4.5°/30 m": 240} if context.quick else dict.fromkeys(STEPPED, STEPPED_COUNTS[-1])
    step_through("4.5°/30 m", STEPPED_COUNTS[:1])  # compile
    stepped = pd.concat(
        [
            step_through(name, [count for count in STEPPED_COUNTS if count <= limit])
            for name, limit in context.progress(list(most.items()), "stepper")
        ],
        ignore_index=True,
    )
    cylinders = pd.concat(
        [vary_cylinders(name, CYLINDERS) for name in context.progress(names, "cylinders")], ignore_index=True
    )
    orders, laws = observed_orders(counts), cost_laws(counts, stepped)
    references = " or ".join(map(str, sorted(counts["reference"].unique())))
    return Outcome(
        tables={
            "counts": counts, "orders": orders, "enough": enough(counts), "cylinders": cylinders, "stepped": stepped,
            "cost": laws,
        },
        checks=_checks(counts, orders, cylinders, stepped, laws),
        notes=[
            "Same well, string, friction and wall per metre at every count; geometry arcs. Errors are against the "
            f"same string in {references} segments; the change from half that number is the uncertainty (doubt) of "
            "the reference, and errors below three times of it are not used for an order.",
            "Torque and side force turning off bottom at 60 rev/min, hook load picking up. Side force is compared as "
            "its sum from the top down, mean difference over depth; moment as RMS along the string, and at one point "
            "where the string lies in a bend.",
            "Loads converge irregularly, at first order or better: the ends of contact move by whole segments. "
            "Moment in a bend converges at second order. Along the whole string its order is between a half and one: "
            "its peaks, a few metres long, are where contact begins and ends, and at the clamp.",
            "The stepper's torque and moment off the largest count are against its own run of the most segments: a "
            "second route to the errors of few segments, independent of the solver.",
            f"Without an answer: {_missing(counts)} (steady solver); {_missing(stepped)} (stepper).",
            "Times are processor times of one machine, for the steady solver the least of five; the checks use only "
            "their growth.",
        ],
        display={
            "orders": "Observed order from 20 segments on",
            "enough": "Smallest count from which on the error stays within 1 % and 0.1 %",
            "cost": "Cost ~ N^exponent, and its growth when the segments double",
            "stepped": "The stepper and the steady solver at equal counts",
        },
    )  # fmt: skip


def _checks(
    counts: pd.DataFrame, orders: pd.DataFrame, cylinders: pd.DataFrame, stepped: pd.DataFrame, laws: pd.DataFrame
) -> list[Check]:
    """Orders, the paper's own count, cost, cylinders."""
    first = "theory: ends of contact move by whole segments, first order at least"
    build = counts[(counts["well"] == "4.5°/30 m") & counts["segments"].between(FITTED_FROM, 160)]
    paper = counts[(counts["well"] == "paper-well") & (counts["segments"] == 60)].iloc[0]
    within = cylinders[cylinders["miss_mm"] < cylinders["clearance_mm"]]

    def largest(what: str, column: str) -> Quartiles:
        of = laws[laws["cost_of"] == what]
        return quartiles_of(of.iloc[int(of[column].argmax())], column)

    return [
        *(
            Check(f"order of {what}, least of the wells", float(orders[column].min()), 1.0, "at_least", "", first)
            for column, what in (("torque", "torque"), ("hookload", "hook load"), ("contact", "side force"))
        ),
        Check("order of the bending moment in a bend, 20 to 160 segments",
              -order(build["segments"], build["bend_moment_percent"], 0.0), 1.8, "at_least", "",
              "theory: second, the chord of a bend misses it by its square; in the well of 4.5°/30 m"),
        Check("torque of the paper's 60 segments, error", float(paper["torque_percent"]), 1.0, "at_most", "%",
              "§6.2: 20 + 40 segments were chosen so that predictions no longer change"),
        Check("torque of the references, largest uncertainty", float(counts["torque_doubt_percent"].max()), 0.02,
              "at_most", "%", "a fifth of the smallest error limit, 0.1 %"),
        ratio_check("cost of a steady string, largest exponent", largest(STEADY, "exponent"), 1.5, "at_most",
                    "theory: linear per iteration, and the number of iterations grows slowly"),
        *(
            ratio_check(f"cost of {what} when the segments double, largest growth",
                        largest(what, "growth_when_doubled"), 1.5 * theory, "at_most",
                        f"theory: {theory}, with a margin of 1.5 for a busy machine; §5.6 speaks of an exponential "
                        "increase, which would square its growth with every doubling")
            for what, theory in ((ITERATION, 2), (STEP, 2), (SECOND, 4))
        ),
        Check("torque of cylinders that miss the hole by less than the clearance, largest error",
              float(within["torque_percent"].max()), 0.1, "at_most", "%", "target: a tenth of a percent"),
        Check("torque of the stepper against the steady solver, largest difference",
              float(stepped["off_steady_percent"].abs().max()), 0.1, "at_most", "%", "target: a tenth of a percent"),
    ]  # fmt: skip


def _missing(table: pd.DataFrame) -> str:
    rows = table[~table["status"].isin(["converged", "completed"])]
    return ", ".join(f"{well} in {n}" for well, n in rows[["well", "segments"]].to_numpy()) or "none"


STUDY = Study(
    "segment_count",
    "How many segments, and how short cylinders, does a given accuracy need, and what do they cost?",
    run,
    reproduce=True,
    timed=True,
)
