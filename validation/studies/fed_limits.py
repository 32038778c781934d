"""Strings that lock up, on both sides of their limit, as they are fed from rest on two meshes.

The strings are those of ``fed_strings``, and trips in of short strings with more friction.
"""

from collections.abc import Iterator
from itertools import count, islice

import pandas as pd

from fctd.steady.steady_string import Equilibrium
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.fed_strings import (
    ARRIVES,
    LEAST,
    RAISED,
    Drawn,
    Feeding,
    Locked,
    Row,
    as_found,
    drawn,
    locked_of,
    meshed,
    scaled,
    solve,
    solved,
    trips,
)
from validation.parts.limits import ABOVE, BELOW, fed, middle, quick_trip, shape

LIMITS = 30  # strings at their limit, half of them trips
OTHER, OTHER_BELOW, OTHER_ABOVE = 0.7, 0.92, 1.08  # share of the segments, and of the friction on that mesh


@table_of_rows
def limits(context: Context, locked: list[Locked]) -> Rows:
    """Locked strings at shares of their friction at lock-up, on two meshes, and the two limits of each."""
    for string, point in context.progress(locked, "locked strings at their limit"):
        _, case, kind, depth, friction = string
        feeding, finer = Feeding(case, point), meshed(case, OTHER)
        low, high = feeding.limit(point.locked_up_at)
        unloads, at = feeding.unloading_limit(high), middle(low, high)
        other = solve(finer, kind, depth).point
        on_other = None if other is None else Feeding(finer, other)
        rows = [solve(scaled(as_found(case, point), share * at), kind, depth) for share in (BELOW, ABOVE)]
        yield {
            "well": string.well, "operation": kind, "bit_depth_m": depth, "friction": friction,
            "locked_up_friction": friction * point.locked_up_at, "fed_arrives_at": friction * low,
            "fed_locks_up_at": friction * high, "unloads_at": friction * unloads,
            "apart_percent": 100 * abs(point.locked_up_at / at - 1),
            "below": fed(feeding, BELOW * at), "above": fed(feeding, ABOVE * at),
            "other_below": RAISED if on_other is None else fed(on_other, OTHER_BELOW * at),
            "other_above": RAISED if on_other is None else fed(on_other, OTHER_ABOVE * at),
            "row_below": rows[0].arrival, "row_above": rows[1].arrival, "reason": point.message,
            "reason_below": _reason(rows[0]), "reason_above": _reason(rows[1]),
        }  # fmt: skip


def _reason(row: Row) -> str:
    return row.raised if row.point is None else row.point.message


def both_sides(string: Drawn, point: Equilibrium, limits: pd.Series) -> pd.DataFrame:
    """The shapes in which feed ends below and above the limit of a string."""
    feeding, at = Feeding(string.case, point), limits["fed_locks_up_at"] / string.friction
    shapes = []
    for share in (BELOW, ABOVE):
        by = f"{100 * share:.0f} %: {fed(feeding, share * at)}"
        shapes.append(shape(feeding.profile(), f"{string.well}, {string.bit_depth:.0f} m", by))
    return pd.concat(shapes, ignore_index=True)


def run(context: Context) -> Outcome:
    """Locked strings at shares of their limit; the quick run feeds one trip."""
    if context.quick:
        locked = [quick_trip(context)]
    else:
        pressed = islice(locked_of(_any(context)), LIMITS - LIMITS // 2)
        locked = [*pressed, *islice(locked_of(trips(context)), LIMITS // 2)]
    table = limits(context, locked)
    return Outcome(
        tables={"limits": table, "shapes": both_sides(*locked[0], table.iloc[0])},
        checks=_checks(table),
        notes=_notes(),
        display={"limits": "Locked strings at shares of their limit"},
    )


def _any(context: Context) -> Iterator[tuple[Drawn, Row]]:
    """Strings of both operations, without end."""
    for index in count():
        string = drawn(context, index)
        if row := solved(string):
            yield string, row


def _notes() -> list[str]:
    return [
        "The friction at lock-up is the limit of feeding: between fed_arrives_at, where a string that is fed from rest "
        "arrives, and fed_locks_up_at.  One that is locked up there arrives again when its friction has fallen to "
        f"unloads_at.  Limits are looked for from {100 * LEAST:g} % of the row's own locked_up_friction on.  Rows at "
        "these shares arrive where they are converged, or locked up with loads since slack-off is spent.",
        "A string that finds no rest as it is fed, or takes more work than a row may (lost), does not arrive.",
    ]


def _checks(of: pd.DataFrame) -> list[Check]:
    """The numbers with bounds."""
    own = (of["below"] == ARRIVES) & (of["above"] != ARRIVES)
    other = (of["other_below"] == ARRIVES) & (of["other_above"] != ARRIVES)
    return [
        Check(f"locked strings that arrive at {100 * BELOW:g} % of their limit and not at {100 * ABOVE:g} %",
              100 * float(own.mean()), 100 * 28 / 30, "at_least", "%", f"{len(of)} strings, the same mesh"),
        Check(f"locked strings that arrive at {100 * OTHER_BELOW:g} % of their limit and not at "
              f"{100 * OTHER_ABOVE:g} % on another mesh", 100 * float(other.mean()), 100 * 28 / 30, "at_least",
              "%", f"{len(of)} strings, segments of {100 * OTHER:g} %"),
        Check("rows on both sides of the limit that say what feeding does",
              50 * float((of["row_below"] == of["below"]).mean() + (of["row_above"] == of["above"]).mean()), 90.0,
              "at_least", "%", "a target of this project"),
        Check("locked_up_at beside the limit of feeding, largest difference", float(of["apart_percent"].max()), 5.0,
              "at_most", "%", "a target of this project"),
    ]  # fmt: skip


STUDY = Study(
    "fed_limits",
    "Do strings that lock up arrive just below their limit when they are fed, and not just above it?",
    run,
    needs=("data",),
)
