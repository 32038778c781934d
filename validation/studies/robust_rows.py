"""Every plausible row of a chart ends in an answer, or in a status with a reason that the stepper confirms."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium
from fctd.case.operations import KINDS
from fctd.model.operations import steady_rates
from fctd.steady.batch import Row, solve_batch
from fctd.steady.equilibrium import Solver
from fctd.steady.laws import hole_of
from fctd.steady.problem import Workspace
from fctd.steady.steady_string import Equilibrium
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.plausible_rows import LESS, REPEATED, Drawn, drawn
from validation.parts.stepped_rows import DURATION, FED, MOVING, SHIFTED, TURNS, damped, step

SEED = 14
STRINGS, QUICK = 1140, 9  # some 8,000 rows, and some 60
STEPPED, HELD = 50, 5  # rows of either kind in time, and those without a steady shape that may be held
LEGAL = ("converged", "locked_up", "rolling", "unstable", "under_resolved", "not_possible")
GAVE_UP = ("max_iterations", "diverged", "not_finite")
# Hook loads that are compared may differ in the wrong direction by this share of the string's weight.
SLACK = 0.002
# Torque that wall and bit do not take: a share of all of it, and a bent string passes on its torque with the cosine of
# half a bend at every joint [N m].
TORQUE_SHARE, TORQUE = 0.005, 30.0
# Of strings that roll round the hole: what hook loads may differ by, as a share of the string's weight.
ROLLING_LOAD = 0.005
ORDER = ("trip_in", "rotate_off_bottom", "trip_out")


def solved(string: Drawn) -> Iterator[tuple[float, float, Equilibrium]]:
    """Share of the friction, weight of the string [N] and answer of every row, all of them solved in one batch."""
    case = Case.model_validate(string.case)
    rates = {kind: steady_rates(case, kind, **given) for kind, given in string.rates.items()}
    intervals = tuple(of.model_copy(update={"friction": LESS * of.friction}) for of in case.wellbore.intervals)
    less = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": intervals})})
    full = Solver(case)
    solvers = [full, Solver(less, full.hole.with_friction(np.array([of.friction for of in intervals])))]
    laid = full.lay_out(string.bit_depth)
    weight = float(laid.string.weight @ laid.string.length)
    wanted = [(0, kind) for kind in rates] + [(1, kind) for kind in REPEATED if kind in rates]
    batch = [Row(laid, k, kind, rates[kind]) for k, kind in wanted]
    answers = solve_batch(case, hole_of(case, [of.hole for of in solvers]), batch, Workspace(laid.string.segments))
    for (k, kind), answer in zip(wanted, answers, strict=True):
        yield (1.0, LESS)[k], weight, solvers[k].finish(kind, rates[kind], laid, answer)


def rows_of(index: int) -> Iterator[dict[str, Any]]:
    """The rows of the string of an index."""
    string = drawn(SEED, index)
    for share, weight, point in solved(string):
        taken = point.sum_r_ft + (point.case.bit.torque if KINDS[point.operation].on_bottom else 0.0)
        off = abs(point.surface_torque - taken) / (TORQUE_SHARE * (point.sum_r_mu_fn + abs(taken)) + TORQUE)
        yield {
            "string": index, "class": string.kind, "geometry": string.case["wellbore"]["geometry"],
            "operation": point.operation, "friction_share": share, "bit_depth_m": string.bit_depth,
            "weight_kN": weight / 1e3, "status": str(point.status), "buckling": point.buckling.mode,
            "hookload_kN": point.hookload / 1e3, "torque_kN_m": point.surface_torque / 1e3,
            "torque_off_of_allowed": off if point.answered else np.nan, "iterations": point.iterations,
            "reason": point.message,
        }  # fmt: skip


def disordered(rows: pd.DataFrame) -> int:
    """Strings whose hook loads are not in the order of their motions."""
    table = rows[(rows["friction_share"] == 1) & (rows["status"] == "converged")]
    loads = table.pivot_table(index="string", columns="operation", values="hookload_kN")
    slack = SLACK * table.groupby("string")["weight_kN"].first().reindex(loads.index)
    pairs = pairwise([kind for kind in ORDER if kind in loads])
    return int(np.any([loads[low] > loads[high] + slack for low, high in pairs], axis=0).sum())


def falling(rows: pd.DataFrame) -> int:
    """Rows whose friction grew, and with it neither drag nor torque."""
    table = rows[rows["status"] == "converged"].set_index(["string", "operation"])
    more, less = table[table["friction_share"] == 1], table[table["friction_share"] == LESS]
    both = more.join(less[["hookload_kN", "torque_kN_m"]], rsuffix="_less", how="inner")
    slack = SLACK * both["weight_kN"]
    grew = both["hookload_kN"] - both["hookload_kN_less"]
    kind = both.index.get_level_values("operation")
    wrong = ((kind == "trip_out") & (grew < -slack)) | ((kind == "trip_in") & (grew > slack))
    # The little torque that is left in a string that slides has either sign.
    wrong |= (kind == "rotate_off_bottom") & (both["torque_kN_m"] < both["torque_kN_m_less"] - TORQUE / 1e3)
    return int(wrong.sum())


@table_of_rows
def stepped(context: Context, rows: pd.DataFrame) -> Rows:
    """A sample of rows in time, converged ones and ones without a steady shape, in wells of arcs.

    A string that slides over the seams of cylinders rings, which is no motion of the string's own.
    """
    whole = rows[(rows["friction_share"] == 1) & (rows["geometry"] == "arcs")]
    kinds = [whole[whole["status"].isin(of)] for of in (["converged"], ["unstable", "rolling"])]
    sample = pd.concat([of.sample(min(STEPPED, len(of)), random_state=SEED) for of in kinds])
    for row in context.progress(list(sample.itertuples()), "rows in time"):
        string = drawn(SEED, int(str(row.string)))
        kind = str(row.operation)
        case = Case.model_validate(string.case)
        end = step(case, kind, string.bit_depth, string.rates[kind])
        # How fast a string rolls depends on the mud, and that of the rows does not resist lateral motion.
        point = equilibrium(damped(case), kind, string.bit_depth, **string.rates[kind])
        yield {
            "string": row.string, "operation": kind, "bit_depth_m": row.bit_depth_m, "weight_kN": row.weight_kN,
            "status": row.status, "hookload_kN": row.hookload_kN, "stepped_hookload_kN": end.hookload / 1e3,
            "sideways_percent": 100 * end.sideways, "shifted_percent": 100 * end.shifted,
            "stepper": "moves" if end.moves else "stays", "damped_status": str(point.status),
            "damped_hookload_kN": point.hookload / 1e3, "roll_rate_rad_per_s": point.roll_rate,
            "stepped_roll_rate_rad_per_s": end.round_it, "run": end.status, "reason": point.message,
        }  # fmt: skip


def checks_in_time(in_time: pd.DataFrame) -> list[Check]:
    """Whether the stepper agrees with the statuses of the rows that could be run."""
    ran = in_time[in_time["run"] == "completed"]
    moves, steady = ran["stepper"] == "moves", ran["status"] == "converged"
    rolling = ran[ran["roll_rate_rad_per_s"].notna()]
    off = (rolling["stepped_hookload_kN"] - rolling["damped_hookload_kN"]).abs() / rolling["weight_kN"]
    ratio = rolling["roll_rate_rad_per_s"] / rolling["stepped_roll_rate_rad_per_s"]
    return [
        Check("converged rows that the stepper moves", float((steady & moves).sum()), 0, "at_most", "",
              f"of {int(steady.sum())} rows"),
        Check("rows without a steady shape that the stepper holds", float((~steady & ~moves).sum()), HELD, "at_most",
              "", f"of {int((~steady).sum())} rows"),
        Check("rolling rows whose hook load the stepper does not confirm", float((off > ROLLING_LOAD).sum()), 0,
              "at_most", "", f"of {len(rolling)} rows; within {100 * ROLLING_LOAD:g} % of the weight"),
        Check("rate of rolling over that of the stepper, median", float(ratio.median()), (0.9, 1.1), "within", "",
              f"of {len(rolling)} rows"),
    ]  # fmt: skip


def run(context: Context) -> Outcome:
    """Every row of the strings, what they have in common, and a sample in time."""
    indices = range(QUICK if context.quick else STRINGS)
    rows = pd.DataFrame([row for index in context.progress(indices, "strings") for row in rows_of(index)])
    counts = pd.crosstab(rows["operation"], rows["status"]).reset_index()
    classes = pd.crosstab(rows["class"], rows["status"]).reset_index()
    legal, other = rows["status"].isin(LEGAL), rows["status"] != "converged"
    tables = {"rows": rows, "counts": counts, "classes": classes}
    display = {"counts": "Rows by operation and status", "classes": "Rows by class of string and status"}
    in_time = []
    if not context.quick:
        tables["in_time"], display["in_time"] = stepped(context, rows), "A sample of rows in time"
        in_time = checks_in_time(tables["in_time"])
    return Outcome(
        tables=tables,
        checks=[
            Check("rows with a legal status", 100 * float(legal.mean()), 99.5, "at_least", "%", ", ".join(LEGAL)),
            Check("rows that the solver gave up", float(rows["status"].isin(GAVE_UP).sum()), 0, "at_most", "",
                  ", ".join(GAVE_UP)),
            Check("rows other than converged without a reason", float((other & (rows["reason"] == "")).sum()), 0,
                  "at_most", "", "a message"),
            Check("strings with hook loads out of order", float(disordered(rows)), 0, "at_most", "",
                  f"pick-up, rotating, slack-off; within {100 * SLACK:g} % of the weight"),
            Check("rows that friction does not raise", float(falling(rows)), 0, "at_most", "",
                  f"drag and torque at {LESS:g} and at all of the friction"),
            Check("torque that wall and bit do not take, over the tolerance",
                  float(rows["torque_off_of_allowed"].max()), 1.0, "at_most", "",
                  f"{100 * TORQUE_SHARE:g} % of the torque and {TORQUE:g} N*m"),
            *in_time,
        ],
        notes=[
            "Strings of 12 classes, from 2 in coiled tubing to 13⅜ in casing, with bit depths of 100 to 9,000 m, in "
            "random wells; every operation that the class can do, at the rates of a rig, and trips and rotation again "
            f"with {100 * LESS:g} % of the friction.",
            "In the full run a sample is run in time. The string starts from rest with a push aside, and slides "
            f"{FED:g} m or turns for {DURATION:g} s or {TURNS:g} turns, in mud that damps lateral motion. It moves if "
            f"a segment's speed across its axis exceeds {100 * MOVING:g} % of the speed at which it slides along the "
            f"wall, or if it goes round the hole: a point moves by {100 * SHIFTED:g} % of its clearance in the last "
            "quarter of the run, in which it is hardly fed. The rows are solved again in that mud: a string rolls "
            "round a vertical hole as fast as friction drives it and mud lets it.",
        ],
        display=display,
    )  # fmt: skip


STUDY = Study("robust_rows", "Does every plausible row end in an answer or in a status with a true reason?", run)
