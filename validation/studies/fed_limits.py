"""Strings that lock up, on both sides of their limit: fed from rest on two meshes, and by the stepper.

The strings are those of ``fed_strings``, and trips in of short strings with more friction.
"""

from collections.abc import Iterator
from itertools import count, islice
from typing import Any

import numpy as np
import pandas as pd

from fctd import Equilibrium
from fctd.results.status import RunStatus
from fctd.steady.feed import End
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.fed_strings import (
    ARRIVES,
    LEAST,
    MORE_FRICTION,
    NOT,
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
from validation.parts.slid_strings import LONGEST, Slid, slide

LIMITS, STEPPED = 30, 30  # strings at their limit, half of them trips; trips by the stepper
BELOW, ABOVE = 0.95, 1.05  # of the friction at lock-up, on the same mesh
OTHER, OTHER_BELOW, OTHER_ABOVE = 0.7, 0.92, 1.08  # share of the segments, and of the friction on that mesh
SPEEDS = 0.2, 0.4  # of the stepper [m/s]
SHAPE = ["string", "by", "md_m", "contact_angle_deg", "contact_force_N"]  # columns of shapes
QUICK = 1744  # index of the one trip of the quick run, which takes ten seconds


@table_of_rows
def limits(context: Context, locked: list[Locked]) -> Rows:
    """Locked strings at shares of their friction at lock-up, on two meshes, and the two limits of each."""
    for string, point in context.progress(locked, "locked strings at their limit"):
        _, case, kind, depth, friction = string
        feeding, finer = Feeding(case, point), meshed(case, OTHER)
        low, high = feeding.limit(point.locked_up_at)
        unloads, at = feeding.unloading_limit(high), _middle(low, high)
        other = solve(finer, kind, depth).point
        on_other = None if other is None else Feeding(finer, other)
        rows = [solve(scaled(as_found(case, point), share * at), kind, depth) for share in (BELOW, ABOVE)]
        yield {
            "well": string.well, "operation": kind, "bit_depth_m": depth, "friction": friction,
            "locked_up_friction": friction * point.locked_up_at, "fed_arrives_at": friction * low,
            "fed_locks_up_at": friction * high, "unloads_at": friction * unloads,
            "apart_percent": 100 * abs(point.locked_up_at / at - 1),
            "below": _fed(feeding, BELOW * at), "above": _fed(feeding, ABOVE * at),
            "other_below": _fed(on_other, OTHER_BELOW * at), "other_above": _fed(on_other, OTHER_ABOVE * at),
            "row_below": rows[0].arrival, "row_above": rows[1].arrival, "reason": point.message,
            "reason_below": _reason(rows[0]), "reason_above": _reason(rows[1]),
        }  # fmt: skip


def _fed(feeding: Feeding | None, share: float) -> str:
    """How feeding ends at a share of the friction."""
    if feeding is None:
        return RAISED
    end = feeding.at(share)
    return ARRIVES if end == End.ARRIVED else NOT if end == End.LOCKED else str(end)


def _middle(low: float, high: float) -> float:
    """The limit between two shares; the upper one where no lower one is known."""
    return (low * high) ** 0.5 if np.isfinite(low) else high


def _reason(row: Row) -> str:
    return row.raised if row.point is None else row.point.message


def stepped(context: Context, locked: list[Locked]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Locked trips in, by the stepper at two speeds on both sides of their limit, and by feed.

    Those with the fewest segments.  The second table has both shapes of each row in which they differ.
    """
    rows: list[dict[str, Any]] = []
    shapes = [pd.DataFrame(columns=SHAPE)]
    for string, point in context.progress(sorted(locked, key=lambda of: len(of[1].profile))[:STEPPED], "stepper"):
        kind, depth, cut = string.operation, string.bit_depth, as_found(string.case, point)
        feeding = Feeding(string.case, point)
        limit = _middle(*feeding.limit(point.locked_up_at))
        for share in (BELOW, ABOVE):
            at = share * limit
            slow, fast = (slide(scaled(cut, at), kind, depth, speed, settles=True) for speed in SPEEDS)
            rows.append({
                "well": string.well, "bit_depth_m": depth, "segments": len(point.profile) - 1,
                "limit_friction": string.friction * limit,
                "share_of_limit_percent": 100 * share, "status": slow.status, "fed_m": slow.fed,
                "bit_follows_percent": 100 * slow.share, "push_weights": slow.push,
                "apart_percent": 100 * abs(fast.push - slow.push) / max(abs(slow.push), 1.0),
                "stepper": _stepped(slow), "fast": _stepped(fast),
                "feed": _fed(feeding, at),
            })  # fmt: skip
            if rows[-1]["stepper"] != rows[-1]["feed"]:
                name = f"{string.well}, {depth:.0f} m, {100 * share:.0f} % of its limit"
                for by, profile in (("stepper", slow.profile), ("feed", feeding.profile())):
                    shapes.append(_shape(profile, name, f"{by}: {rows[-1][by]}"))
    return pd.DataFrame(rows), pd.concat(shapes, ignore_index=True)


def both_sides(string: Drawn, point: Equilibrium, limits: pd.Series) -> pd.DataFrame:
    """The shapes in which feed ends below and above the limit of a string."""
    feeding, at = Feeding(string.case, point), limits["fed_locks_up_at"] / string.friction
    shapes = []
    for share in (BELOW, ABOVE):
        by = f"{100 * share:.0f} %: {_fed(feeding, share * at)}"
        shapes.append(_shape(feeding.profile(), f"{string.well}, {string.bit_depth:.0f} m", by))
    return pd.concat(shapes, ignore_index=True)


def _shape(profile: pd.DataFrame, string: str, by: str) -> pd.DataFrame:
    return profile.assign(string=string, by=by)[SHAPE]


def _stepped(of: Slid) -> str:
    """Whether a string arrives by the stepper: one whose push grows until a joint bends beyond the model does not."""
    return ARRIVES if of.slides and of.status != RunStatus.UNSTABLE else NOT


def run(context: Context) -> Outcome:
    """Locked strings at shares of their limit, fed in the steady solver, and trips among them by the stepper.

    The quick run feeds one trip.
    """
    if context.quick:
        one = drawn(context, QUICK, MORE_FRICTION)
        locked = list(locked_of([(one, solve(one.case, one.operation, one.bit_depth))]))
    else:
        tripped = list(islice(locked_of(trips(context)), STEPPED))
        locked = [*islice(locked_of(_any(context)), LIMITS - LIMITS // 2), *tripped[: LIMITS // 2]]
    tables = {"limits": limits(context, locked)}
    display = {"limits": "Locked strings at shares of their limit"}
    if context.quick:
        tables["shapes"] = both_sides(*locked[0], tables["limits"].iloc[0])
    else:
        tables["stepped"], tables["shapes"] = stepped(context, tripped)
        display |= {"stepped": "Locked trips in, by the stepper and by feed"}
    return Outcome(tables=tables, checks=_checks(tables), notes=_notes(), display=display)


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
        f"The stepper feeds a string by at most {LONGEST:g} m at {SPEEDS[0]:g} and {SPEEDS[1]:g} m/s.",
    ]


def _checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The numbers with bounds."""
    of = tables["limits"]
    own = (of["below"] == ARRIVES) & (of["above"] != ARRIVES)
    other = (of["other_below"] == ARRIVES) & (of["other_above"] != ARRIVES)
    checks = [
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
    if "stepped" in tables:
        of = tables["stepped"]
        alike = (of["stepper"] == ARRIVES) == (of["feed"] == ARRIVES)
        checks += [
            Check("trips in that arrive by the stepper as by feed, on both sides of their limit",
                  100 * float(alike.groupby([of["well"], of["bit_depth_m"]]).all().mean()), 90.0, "at_least", "%",
                  "27 of 30"),
            Check("stepper at two speeds, push, largest difference", float(of["apart_percent"].max()), 1.0, "at_most",
                  "%", "of the push, or of the weight where that is more"),
        ]  # fmt: skip
    return checks


STUDY = Study(
    "fed_limits",
    "Do strings that lock up arrive just below their limit, by feed and by the stepper?",
    run,
    needs=("data",),
    timed=True,
)
