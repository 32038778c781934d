"""A string in ever more segments over a range of counts: observed orders, extrapolated loads, counts that suffice.

Counts grow by √2, uniform and graded; the default layout is one string beside them.  The error of a string is its
distance from the farther end of the interval of the extrapolated load.  Where the loads show no order, that interval is
the last load with its error at first order by doublings (``errors_of``).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.state import MAX_SEGMENTS
from fctd.model import layouts
from fctd.results.convergence import LOADS
from fctd.steady.levels import MOST_BESIDE, Level, Task, cut, errors_of, solve_level
from fctd.steady.observed_order import Converging, observe

STAGE, DEFAULT = "counts", "default"
GROWTH = 2**0.5
# A range over less has too few counts for an order.
LEAST_RANGE = 8
_EXPECTED = f"FROM:TO, numbers of segments from 2 to {MAX_SEGMENTS}, the second {LEAST_RANGE} times the first at least"


def ends_of(segments: str | Sequence[int]) -> tuple[int, int]:
    """The ends of a range of counts, "10:1000" or a pair; raises InputError for another, and for a short one."""
    given = segments.split(":") if isinstance(segments, str) else segments
    try:
        least, most = map(int, given)
    except (TypeError, ValueError):
        least = most = 0
    if not (least >= 2 and LEAST_RANGE * least <= most <= MAX_SEGMENTS):
        raise InputError(f"{_EXPECTED}, such as 10:1000", key="segments", value=segments)
    return least, most


def solve_counts(case: Case, task: Task, least: int, most: int) -> dict[str, list[Level]]:
    """Levels of uniform and graded strings of ``least`` to ``most`` segments, and the default layout, by layout."""
    whole = layouts.divided_length(case, task.bit_depth)
    found: dict[str, list[Level]] = {}
    for layout in layouts.LAYOUTS:
        levels: list[Level] = []
        # A graded string of segments from the same length up has fewer of them.
        for k in range(int(2 * np.log2(layouts.LONGEST * most / least)) + 1):
            fineness = GROWTH**k
            of = cut(case, task, layout, whole / (least * fineness), round(fineness))
            count = layouts.segments_in_hole(of, task.bit_depth)
            if count > (min(most, MOST_BESIDE) if levels and levels[-1].resolved else most):
                break
            if count >= least and not (levels and count <= levels[-1].segments):
                levels.append(solve_level(STAGE, layout, of, task)._replace(fineness=fineness))
        found[layout] = levels
    of = layouts.with_components(case, layouts.by_default(case))
    return found | {DEFAULT: [solve_level(STAGE, DEFAULT, of, task)]}


def judged(
    task: Task, strings: Mapping[str, list[Level]], tolerance: float
) -> tuple[list[dict[str, Any]], dict[str, Array]]:
    """A row per layout and operation, and the error of each level by layout, (levels, operations, 2).

    Columns of a row: layout, operation, and for each load its observed order with the ends of its interval, NaN
    where there is none; the extrapolated load, likewise; segments, the least number from which on the error stays
    within the tolerance, NaN where that is more than was tried.
    """
    errors = {layout: np.full((len(levels), len(task.rates), 2), np.nan) for layout, levels in strings.items()}
    rows: list[dict[str, Any]] = []
    for i, kind in enumerate(task.rates):
        of_kind: dict[str, dict[str, Any]] = {
            layout: {"layout": layout, "operation": kind} for layout in layouts.LAYOUTS
        }
        for k, (load, (*_, unit, _)) in enumerate(LOADS.items()):
            found = {layout: _converging(strings[layout], i, k) for layout in layouts.LAYOUTS}
            # The default layout is judged by the extrapolated load that is known best.
            found[DEFAULT] = min(
                found.values(), key=lambda each: np.nan_to_num(each.limit_high - each.limit_low, nan=np.inf)
            )
            for layout, levels in strings.items():
                errors[layout][:, i, k] = _errors(levels, i, k, found[layout])
            for layout, row in of_kind.items():
                of = found[layout]
                row |= {f"{load}_{name}": getattr(of, name) for name in ("order", "order_low", "order_high")}
                row |= {f"{load}_{name}_{unit}": getattr(of, name) for name in ("limit", "limit_low", "limit_high")}
                row[f"{load}_segments"] = _enough(strings[layout], errors[layout][:, i, k], tolerance)
        rows += of_kind.values()
    return rows, errors


def _converging(levels: list[Level], i: int, k: int) -> Converging:
    """Order and extrapolated value of a load of an operation; without an order the last value and its error."""
    loads = np.array([level.loads[i, k] for level in levels])
    found = observe(np.array([level.segments for level in levels], dtype=float), loads)
    answered = np.flatnonzero(np.isfinite(loads))
    if np.isfinite(found.order) or len(answered) < 3:
        return found
    last = levels[answered[-1] :: -2][::-1]  # doublings, as in the search: a smaller step makes more of a scatter
    reach = errors_of(last)[1][i, k] * last[-1].scales[i, k]
    value = loads[answered[-1]]
    return found._replace(limit=value, limit_low=value - reach, limit_high=value + reach)


def _errors(levels: list[Level], i: int, k: int, found: Converging) -> Array:
    """Distance of a load of each level from the farther end of an interval, relative (levels,)."""
    loads, scales = (np.array([getattr(level, name)[i, k] for level in levels]) for name in ("loads", "scales"))
    farther = np.maximum(np.abs(loads - found.limit_low), np.abs(loads - found.limit_high))
    return np.asarray(farther / scales)


def _enough(levels: list[Level], errors: Array, tolerance: float) -> float:
    """The least number of segments from which on errors stay within a tolerance; NaN without one."""
    answered = np.flatnonzero(np.isfinite(errors))
    beyond = answered[errors[answered] > tolerance]
    within = answered[answered > (beyond[-1] if len(beyond) else -1)]
    return float(levels[within[0]].segments) if len(within) else float("nan")
