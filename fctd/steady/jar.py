"""Forces at a jar of a string that is stuck below it: what a hook load brings there, and what hook load they take."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.case.errors import InputError, nearest
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import frame_of, quantity
from fctd.case.units import FORCE, argument
from fctd.model.depths import depth_of
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.margins import first_limit
from fctd.steady.stuck import StuckString, stuck_string, tension_at

if TYPE_CHECKING:
    import pandas as pd

UP, DOWN = "up", "down"
# The operation that brings a load to the jar, by the direction in which it jars.
KINDS: Final = {UP: "trip_out", DOWN: "trip_in"}
MOST: Final = 1e9  # [N]: no rig pulls harder
Row = dict[str, Any]


def jar_depth(case: Case, jar: float | str, bit_depth: float) -> float:
    """The depth of a jar [m] with the bit at ``bit_depth`` [m]: a depth, or the middle of the component of that name.

    Raises InputError for a name that no component, or more than one, has.
    """
    named = [component.name for component in case.string.components]
    if not isinstance(jar, str) or not any(character.isalpha() for character in jar) or jar in ("td", "shoe"):
        return depth_of(jar, case, "jar")
    if jar not in named:
        try:
            return depth_of(jar, case, "jar")
        except InputError:
            raise InputError(f"a depth, or {nearest(jar, named, 'component')}", key="jar", value=jar) from None
    if named.count(jar) > 1:
        raise InputError(f"a depth, as {named.count(jar)} components have that name", key="jar", value=jar)
    below = 0.0
    for component in case.string.components:
        length = bit_depth - case.string.top_md - below if component.length is None else component.length
        if component.name == jar:
            return bit_depth - below - 0.5 * length
        below += length
    raise AssertionError("a component of that name has been found")


def jar_forces(
    case: Case,
    jar: float | str,
    stuck_at: float | str | None = None,
    bit_depth: float | str = "td",
    *,
    up: float | str | Sequence[float | str] = (),
    down: float | str | Sequence[float | str] = (),
    hookload: float | str | Sequence[float | str] = (),
    friction: FrictionChoice | None = None,
) -> pd.DataFrame:
    """Hook loads and forces at a jar of a string that is stuck below it, a row for each load that is asked for, SI.

    jar : its depth [m] or the name of its component.  bit_depth [m] : by default the end of the hole; stuck_at [m] : by
    default the bit.
    up : pulls at the jar [N], for which the string is pulled; down : pushes at the jar [N], for which it is set down;
    hookload : of the string [N], to which it is pulled or set down, or both between those of the free string.  Texts
    have units.

    Columns: direction (up or down), jar_md_m, stuck_md_m, bit_depth_m, hookload_N, weight_indicator_N,
    force_at_jar_N and force_at_stuck_N (effective tension, below 0 a push), over_free_N (hook load above that of the
    free string that moves the same way), limit and share_used (of the limit that it uses most), hoist_share (of the
    hoist's capacity), buckling (its mode), reason.  NaN where no steady string has the load.  The pressure that opens a
    jar while pumps run is left out.  Raises InputError for unusable input.

        >>> case = fctd.load_case("examples/my_well.toml")
        >>> rows = fctd.jar_forces(case, "2750 m", up=["400 kN"])
        >>> bool(rows["force_at_jar_N"].iloc[0] - rows["force_at_stuck_N"].iloc[0] > 0)
        True
    """
    with naming_file(case):
        bit = depth_of(bit_depth, case, "bit_depth")
        stuck = bit if stuck_at is None else depth_of(stuck_at, case, "stuck_at")
        case = with_friction(case, friction)
        place = jar_depth(case, jar, bit)
        if not case.string.top_md < place <= stuck:
            expected = f"a depth along the string, above the place where it is stuck, {quantity(stuck, 'm')}"
            raise InputError(expected, key="jar", value=quantity(place, "m"))
        where = {"jar_md_m": place, "stuck_md_m": stuck, "bit_depth_m": bit}
        solver, rows = Solver(case), list[Row]()
        strings = {way: stuck_string(solver, kind, steady_rates(case, kind), bit, stuck) for way, kind in KINDS.items()}
        for key, loads in (("up", up), ("down", down), ("hookload", hookload)):
            for load in [loads] if isinstance(loads, int | float | str) else loads:
                value = argument(load, FORCE, key)
                if not (-MOST if key == "hookload" else 0) <= value <= MOST:
                    raise InputError("a force of at least 0", key=key, value=load)
                for way in _ways(strings, value) if key == "hookload" else (key,):
                    rows.append({"direction": way, **where, **_row(strings[way], key, value, stuck - place)})
        if not rows:
            raise InputError("forces at the jar, or a hook load", key="up")
    return frame_of(rows)


def _ways(strings: dict[str, StuckString], hookload: float) -> list[str]:
    """The directions in which a string comes to a hook load [N]: both between those of the free string."""
    lifted, lowered = (strings[way].free.hookload for way in (UP, DOWN))
    return [way for way, comes in ((UP, hookload > lowered), (DOWN, hookload < lifted)) if comes]


def _row(string: StuckString, key: str, value: float, above: float) -> Row:
    """The numbers of a hook load, or of a pull or push at a distance above the stuck point [m]; all [N]."""
    if key == "hookload":
        found = string.at_hookload(value)
    else:
        found = string.at_tension(above, value if key == "up" else -value)
    if found is None:
        asked = "hookload_N" if key == "hookload" else "force_at_jar_N"
        numbers = ("hookload_N", "weight_indicator_N", "force_at_jar_N", "force_at_stuck_N", "over_free_N")
        given = dict.fromkeys(numbers, np.nan) | {asked: -value if key == "down" else value}
        reason = "no steady string has that load: it locks up, or the solver finds none"
        return given | {
            "limit": "none",
            "share_used": np.nan,
            "hoist_share": np.nan,
            "buckling": "none",
            "reason": reason,
        }
    force, point = found
    used, lifts = first_limit(point), string.solver.case.rig.hoist_capacity
    return {
        "hookload_N": point.hookload, "weight_indicator_N": point.weight_indicator,
        "force_at_jar_N": tension_at(point, above), "force_at_stuck_N": force,
        "over_free_N": point.hookload - string.free.hookload, "limit": used.code, "share_used": used.share,
        "hoist_share": np.nan if lifts is None else point.weight_indicator / lifts, "buckling": point.buckling.mode,
        "reason": "none",
    }  # fmt: skip
