"""Probable mistakes of a caliper: its unit, what its arms measure, its depths, and rows that stand out."""

from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.doubts.usual import Doubts
from fctd.case.hole import WellboreSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity, span
from fctd.case.text import counted

KEY: Final = "wellbore.caliper"
FOOT: Final = 0.3048
# Of the median diameter over that of the interval: a bit drills hardly less than its size, and a washout of twice the
# diameter is rare over half of a hole.
LEAST, MOST = 0.95, 2.0
UNDER_GAUGE: Final = 0.97  # of the interval's diameter: clay may swell or a bit may wear by so much
SPIKE: Final = 0.3  # of both neighbours
BELOW_TD: Final = 10.0  # [m]


def measured_size(hole: WellboreSpec, td: float) -> Doubts:
    """A caliper whose sizes or depths do not fit the hole; td [m] : of the survey."""
    found = hole.calipers
    if found is None:
        return
    size = 2 * found.radii.mean(axis=1)  # NaN where an arm is missing
    ends = np.array([interval.to_md for interval in hole.intervals])
    own = np.minimum(np.searchsorted(ends, found.md), len(ends) - 1)
    nominal = np.array([interval.diameter for interval in hole.intervals])[own]
    is_open = np.array([interval.kind != "cased" for interval in hole.intervals])[own] & (found.md <= ends[-1])
    known = is_open & ~np.isnan(size)
    yield from _depths(found.md, td)
    if not known.any():
        yield InputWarning(
            "caliper_depth", KEY, f"no row lies in open hole: it has {span(found.md[0], found.md[-1], 'm')}",
            "check the unit of its depths, and which intervals are cased",
        )  # fmt: skip
        return
    share = float(np.median(size[known] / nominal[known]))
    if not LEAST <= share <= MOST:
        remedy = "check the unit, and whether values are diameters or radii"
        yield InputWarning(
            "caliper_size", KEY, f"its median diameter is {share:.2g} times that of the interval", remedy
        )  # fmt: skip
        return
    narrow = known & (size < UNDER_GAUGE * nominal)
    if narrow.any():
        at = int(np.nanargmin(np.where(narrow, size / nominal, np.nan)))
        yield InputWarning(
            "caliper_gauge", KEY,
            f"{counted(int(narrow.sum()), 'row')} of a mean diameter below the interval's, the narrowest "
            f"{quantity(1e3 * size[at], 'mm', '.4g')} at {quantity(found.md[at], 'm')}",
            "check them: the string passes there in the computation too",
        )  # fmt: skip
    inner = size[1:-1]
    spikes = np.minimum(np.abs(inner / size[:-2] - 1), np.abs(inner / size[2:] - 1)) > SPIKE
    if (spikes & known[1:-1]).any():
        at = int(np.argmax(spikes & known[1:-1])) + 1
        yield InputWarning(
            "caliper_spike", KEY,
            f"{counted(int((spikes & known[1:-1]).sum()), 'row')} that differ from both neighbours by a third, the "
            f"first at {quantity(found.md[at], 'm')}",
            "leave them empty if they are faults of the log",
        )  # fmt: skip


def _depths(md: Array, td: float) -> Doubts:
    """Depths that are probably in feet, or those of another run."""
    first, last = float(md[0]), float(md[-1])
    if first < 0:
        yield InputWarning(
            "caliper_depth", KEY, f"its first row is at {quantity(first, 'm')}, above the surface", "check its depths"
        )
    if last > td + BELOW_TD:
        feet = abs(last * FOOT / td - 1) < 0.05
        yield InputWarning(
            "caliper_depth", KEY, f"its last row is at {quantity(last, 'm')}, the survey ends at {quantity(td, 'm')}",
            "check the unit of its depths, which are probably feet" if feet else "check its depths",
        )  # fmt: skip
