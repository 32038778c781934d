"""Probable mistakes in the hole: its depths, sizes and friction."""

from collections.abc import Sequence
from typing import Final

from fctd.case.doubts.usual import Doubts, Well, as_given
from fctd.case.friction import Factor, FrictionSet, Pair, pairs_of
from fctd.case.hole import WellboreSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity, span
from fctd.case.pipes.filling import casing_named
from fctd.case.units import LikelyUnit

SMOOTH: Final = 1e-3  # of the factor around the hole: below, balances of a trip are none or false
ROUGH: Final = 0.6  # steel on rock without lubrication; casing has 0.15 to 0.3, open hole 0.2 to 0.5
NARROWEST, WIDEST = 0.05, 1.5  # [m]: coiled tubing in slim hole, conductor pipe
UNDERREAMED: Final = 1.5  # an under-reamer opens the hole below a shoe to some 1.3 times its diameter
BELOW_TD: Final = 30.0  # [m]: the last station is some way above the bit
FOOT: Final = 0.3048
OTHER_BORE: Final = 0.01  # share of a bore: a drift is 1.5 to 3 % narrower


def shoe_below_td(hole: WellboreSpec, td: float) -> Doubts:
    """A casing shoe or a change of hole size below the last station [m], or an end of the hole in feet."""
    last = len(hole.intervals) - 1
    feet = abs(hole.intervals[-1].to_md * FOOT / td - 1) < 0.02
    for i, interval in enumerate(hole.intervals):
        below = interval.to_md - td
        in_hole = below < 0 if i < last else below <= BELOW_TD or not (feet or interval.kind == "cased")
        if not in_hole:
            yield InputWarning(
                "shoe_below_td", f"wellbore.intervals[{i}].to_md",
                f"the interval ends at {quantity(interval.to_md, 'm')}, the survey at {quantity(td, 'm')}",
                f"write '{interval.to_md:g} ft' if these are feet" if feet else "check depth and unit of both",
            )  # fmt: skip


def hole_size(case: Well) -> Doubts:
    """A hole so wide or narrow that its diameter is probably in another unit."""
    inches = (LikelyUnit(WIDEST, 5, " in"),)
    for i, interval in enumerate(case.wellbore.intervals):
        if not NARROWEST <= interval.diameter <= WIDEST:
            key = f"wellbore.intervals[{i}].diameter"
            text = f"a hole of {as_given(case, key, interval.diameter, 'm', inches)}"
            yield InputWarning("hole_size", key, text, "write the diameter with its unit")


def wider_below(hole: WellboreSpec) -> Doubts:
    """A hole that is far wider below a shoe than above it."""
    for i, (above, here) in enumerate(zip(hole.intervals[:-1], hole.intervals[1:], strict=True), start=1):
        if here.diameter > UNDERREAMED * above.diameter:
            yield InputWarning(
                "wider_below", f"wellbore.intervals[{i}].diameter",
                f"the hole widens downwards, from {span(1e3 * above.diameter, 1e3 * here.diameter, 'mm')}",
                "list the intervals from the surface down",
            )  # fmt: skip


def casing_bore(hole: WellboreSpec) -> Doubts:
    """Casing with a diameter inside that is not its bore, such as its drift: its wall is then another one."""
    for i, interval in enumerate(hole.intervals):
        if interval.casing is None:
            continue
        bore = casing_named(interval.casing).inner
        if abs(interval.diameter / bore - 1) > OTHER_BORE:
            yield InputWarning(
                "casing_bore", f"wellbore.intervals[{i}].diameter",
                f"{quantity(1e3 * interval.diameter, 'mm', '.4g')}, where the bore of {interval.casing} is "
                f"{quantity(1e3 * bore, 'mm', '.4g')}: "
                f"its wall is taken as {quantity(1e3 * interval.wall, 'mm', '.3g')}",
                "leave the diameter out, or check the casing",
            )  # fmt: skip


def rough_wall(hole: WellboreSpec, frictions: Sequence[FrictionSet]) -> Doubts:
    """A friction factor beyond that of dry rock: the largest of those asked for, or without them of the case."""
    factors = {f"wellbore.intervals[{i}].friction": interval.friction for i, interval in enumerate(hole.intervals)}
    factors |= {
        f"wellbore.intervals[{i}].rotational_friction": interval.friction_around
        for i, interval in enumerate(hole.intervals)
        if interval.rotational_friction is not None
    }
    if frictions:
        factors = {"friction": max(factor for one in frictions for factor in one.factors)}
    key = max(factors, key=lambda key: factors[key])
    if factors[key] > ROUGH:
        yield InputWarning(
            "friction", key,
            f"a friction factor of {factors[key]:g}, where casing has 0.15 to 0.3 and open hole 0.2 to 0.5",
            "check it; 30 % is written 0.3",
        )  # fmt: skip


def smooth_along(hole: WellboreSpec, frictions: Sequence[FrictionSet]) -> Doubts:
    """A factor along the hole near 0 beside one around it, in those asked for, or without them in the case."""
    found: list[tuple[str, Factor | None]] = [
        (f"wellbore.intervals[{i}].friction", pair) for i, pair in enumerate(pairs_of(hole.intervals))
    ]
    if frictions:
        found = [("friction", pair) for one in frictions for pair in (one.every, *one.by_kind.values())]
    for key, pair in found:
        if isinstance(pair, Pair) and pair.along < SMOOTH * pair.around:
            yield InputWarning(
                "friction_pair", key,
                f"a factor of {pair.along:g} along the hole beside {pair.around:g} around it: strings that slide "
                "along it may find no balance, or a false torque",
                f"give a factor along the hole of at least {SMOOTH * pair.around:g}, or the same one around it",
            )  # fmt: skip
            return
