"""Buckled strings with homogenised waves: their rows against resolved ones, and what both cost.

The strings of ``fed_strings``, drawn at random, each resolved and then with so little work for resolving that its waves
are homogenised.
"""

from collections.abc import Iterator
from itertools import count, islice

import numpy as np
import pandas as pd

from fctd.results.status import SteadyStatus
from fctd.steady.steady_string import HOMOGENISED, Equilibrium
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows, time_check
from validation.parts.fed_strings import Drawn, Row, again, drawn, solved, weight_of

STRINGS, QUICK = 40, (9, 12)  # of the quick run the indices: one string hangs, one is locked up, both take seconds
WORK = 1.0  # iterations times segments, with which nothing is resolved
SAME_LOAD, SAME_SPENT, SAME_LOCKED = 1.0, 3.0, 10.0  # [% of the weight], [% of the friction] of a resolved row


def resolving(string: Drawn, **solver: float) -> Drawn:
    """The string in a case that resolves buckling; solver : other keys of its table."""
    changes = {"buckling": "resolve", **solver}
    case = string.case.model_copy(update={"solver": string.case.solver.model_copy(update=changes)})
    return string._replace(case=case)


def homogenised(string: Drawn) -> Drawn:
    """The string in a case that resolves buckling with so little work that its waves are homogenised."""
    return resolving(string, resolve_work=WORK)


def pairs(context: Context) -> Iterator[tuple[int, Drawn, Equilibrium, float, Equilibrium, float]]:
    """Index and string; it resolved, and with homogenised waves, each with its processor time [s]."""
    for index in QUICK if context.quick else count():
        string = drawn(context, index)
        whole = solved(resolving(string))
        point = None if whole is None else whole.point
        if whole is None or point is None or point.shape == "none" or point.method == HOMOGENISED:
            continue
        if point.status not in (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP):
            continue
        waves: Row | None = solved(homogenised(string))
        assert waves is not None  # string and hole fit, as above
        assert waves.point is not None
        yield index, string, point, whole.seconds, waves.point, waves.seconds


@table_of_rows
def compare(context: Context) -> Rows:
    """A row per string: both answers, how far they are apart, and what each cost."""
    again(homogenised(drawn(context, QUICK[0])))  # compile
    found = islice(pairs(context), STRINGS)
    for index, string, point, seconds, waves, seconds_of_waves in context.progress(found, "resolved and homogenised"):
        loads = [point.hookload, point.hookload_low, point.hookload_high]
        # A path that ends before all of the weight on bit has shares of that.
        of_friction = np.nan if "of the weight on bit" in point.message else 1.0
        beyond = max(np.fmin.reduce(loads) - waves.hookload, waves.hookload - np.fmax.reduce(loads), 0.0)
        yield {
            "index": index, "well": string.well, "operation": string.operation, "bit_depth_m": string.bit_depth,
            "friction": string.friction, "shape": point.shape, "status": str(point.status),
            "homogenised": str(waves.status), "method": waves.method, "hookload_kN": point.hookload / 1e3,
            "homogenised_kN": waves.hookload / 1e3,
            "apart_percent_of_weight": 100 * beyond / weight_of(string.case, string.bit_depth),
            "spent_at": of_friction * point.slack_off_spent_at, "homogenised_spent_at": waves.slack_off_spent_at,
            "locked_up_at": of_friction * point.locked_up_at, "homogenised_locked_up_at": waves.locked_up_at,
            "seconds": seconds, "homogenised_seconds": seconds_of_waves, "reason": point.message,
            "homogenised_reason": waves.message,
        }  # fmt: skip


def run(context: Context) -> Outcome:
    """Both rows of strings that buckle."""
    table = compare(context)
    hang = table["hookload_kN"] > 0
    shares = [f"{name}{of}" for of in ("spent_at", "locked_up_at") for name in ("", "homogenised_")]
    columns = ["well", "bit_depth_m", "friction", "shape", "status", "homogenised", "hookload_kN", "homogenised_kN"]
    worst = table.sort_values("apart_percent_of_weight", ascending=False)[[*columns, *shares]].head(10)
    notes = [
        f"{len(table)} strings that buckle and were resolved, in a horizontal well, random wells and a real survey; "
        f"friction 0.1 to 0.5, 20 to 300 kN on bit or trips in. {int(hang.sum())} hang from the block.",
        "Hook loads are apart by what the homogenised one lies outside those of both shapes of the resolved string.",
        "A pushed string multiplies each difference of its wall force, the more the nearer it is to lock-up.",
    ]
    display = {"worst": "The strings whose hook loads are farthest apart"}
    slowest = again(homogenised(drawn(context, int(table["index"].iloc[table["homogenised_seconds"].argmax()]))))
    checks = _checks(table, hang, slowest)
    return Outcome(tables={"strings": table, "worst": worst}, checks=checks, notes=notes, display=display)


def _checks(table: pd.DataFrame, hang: pd.Series, slowest: list[float]) -> list[Check]:
    """The numbers with bounds; slowest : times of the slowest row [s]."""

    def apart(share: str) -> float:
        return 100 * float((table[f"homogenised_{share}"] - table[share]).abs().max())

    relative = 100 * float((table["homogenised_locked_up_at"] / table["locked_up_at"] - 1).abs().max())
    same = 100 * float((table["status"] == table["homogenised"]).mean())
    own = "a target of this project"
    return [
        Check("strings with the status of a resolved one", same, 97.0, "at_least", "%", own),
        Check("hanging strings, hook load, largest difference", float(table["apart_percent_of_weight"][hang].max()),
              SAME_LOAD, "at_most", "% of the weight", own),
        Check("friction at which slack-off is spent, largest difference", apart("spent_at"), SAME_SPENT, "at_most",
              "% of the friction", own),
        Check("friction at lock-up, largest difference", relative, SAME_LOCKED, "at_most", "%", own),
        time_check("homogenised row, slowest", slowest, 6.0, "s", "processor time, solved three times more"),
    ]  # fmt: skip


STUDY = Study(
    "homogenised_waves",
    "Do strings with homogenised waves have the loads of resolved ones?",
    run,
    needs=("data",),
    timed=True,
)
