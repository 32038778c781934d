"""Trips in that lock up, on both sides of their limit, by the stepper and by feed."""

from itertools import islice
from typing import Any

import pandas as pd

from fctd.results.status import RunStatus
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.fed_strings import ARRIVES, NOT, Feeding, Locked, as_found, locked_of, scaled, trips
from validation.parts.limits import ABOVE, BELOW, fed, middle, quick_trip, shape
from validation.parts.slid_strings import LONGEST, Slid, slide

STRINGS = 30
MOST = 2000  # segments, as the stepper takes an hour on one side of the limit of longer chains
SPEEDS, QUICK = (0.2, 0.4), (0.4, 0.8)  # of the stepper [m/s]


def stepped(
    context: Context, locked: list[Locked], shares: tuple[float, ...], speeds: tuple[float, float]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Locked trips in, by the stepper at two speeds at shares of their limit, and by feed.

    The second table has both shapes of the first row, and of each in which they differ.
    """
    rows: list[dict[str, Any]] = []
    shapes: list[pd.DataFrame] = []
    for string, point in context.progress(sorted(locked, key=lambda of: len(of[1].profile)), "trips by the stepper"):
        kind, depth, cut = string.operation, string.bit_depth, as_found(string.case, point)
        feeding = Feeding(string.case, point)
        limit = middle(*feeding.limit(point.locked_up_at))
        for share in shares:
            at = share * limit
            slow, fast = (slide(scaled(cut, at), kind, depth, speed, settles=True) for speed in speeds)
            rows.append({
                "well": string.well, "bit_depth_m": depth, "segments": len(point.profile) - 1,
                "limit_friction": string.friction * limit,
                "share_of_limit_percent": 100 * share, "status": slow.status, "fed_m": slow.fed,
                "bit_follows_percent": 100 * slow.share, "push_weights": slow.push,
                "apart_percent": 100 * abs(fast.push - slow.push) / max(abs(slow.push), 1.0),
                "stepper": _stepped(slow), "fast": _stepped(fast),
                "feed": fed(feeding, at),
            })  # fmt: skip
            if not shapes or rows[-1]["stepper"] != rows[-1]["feed"]:
                name = f"{string.well}, {depth:.0f} m, {100 * share:.0f} % of its limit"
                for by, profile in (("stepper", slow.profile), ("feed", feeding.profile())):
                    shapes.append(shape(profile, name, f"{by}: {rows[-1][by]}"))
    return pd.DataFrame(rows), pd.concat(shapes, ignore_index=True)


def _stepped(of: Slid) -> str:
    """Whether a string arrives by the stepper: one whose push grows until a joint bends beyond the model does not."""
    return ARRIVES if of.slides and of.status != RunStatus.UNSTABLE else NOT


def run(context: Context) -> Outcome:
    """Trips in that lock up, with the fewest segments first; the quick run feeds one of them below its limit."""
    speeds = QUICK if context.quick else SPEEDS
    if context.quick:
        table, shapes = stepped(context, [quick_trip(context)], (BELOW,), speeds)
    else:
        short = (one for one in locked_of(trips(context)) if len(one[1].profile) <= MOST)
        table, shapes = stepped(context, list(islice(short, STRINGS)), (BELOW, ABOVE), speeds)
    return Outcome(
        tables={"stepped": table, "shapes": shapes},
        checks=_checks(table),
        notes=[
            f"The stepper feeds a string by at most {LONGEST:g} m at {speeds[0]:g} and {speeds[1]:g} m/s.  Strings of "
            f"more than {MOST} segments are left out."
        ],
        display={"stepped": "Locked trips in, by the stepper and by feed"},
    )


def _checks(of: pd.DataFrame) -> list[Check]:
    """The numbers with bounds."""
    alike = (of["stepper"] == ARRIVES) == (of["feed"] == ARRIVES)
    return [
        Check("trips in that arrive by the stepper as by feed, on both sides of their limit",
              100 * float(alike.groupby([of["well"], of["bit_depth_m"]]).all().mean()), 90.0, "at_least", "%",
              "27 of 30"),
        Check("stepper at two speeds, push, largest difference", float(of["apart_percent"].max()), 1.0, "at_most",
              "%", "of the push, or of the weight where that is more"),
    ]  # fmt: skip


STUDY = Study(
    "stepped_limits",
    "Do strings that lock up arrive just below their limit in time too, and not just above it?",
    run,
    needs=("data",),
)
