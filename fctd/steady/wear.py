"""Casing wear: the grooves that a string which turns wears into the casing above it, while it drills on.

At every bit depth of a schedule the steady string says with which force it lies on the casing, metre by metre.  Tool
joints that take all of it cover a share of the string, and each of their metres bears so much more: a place of the
casing, which all of them pass, has the mean force and slides by the turns times their circumference.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.arrays import Array, nearest
from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import Message, frame_of, quantity, within
from fctd.case.operations import KINDS
from fctd.case.units import FASTEST, LENGTH, SPEED, TIME, LikelyUnit, argument, bare, unit_hint
from fctd.case.wall import IntervalSpec
from fctd.model.capacity import THINNEST, burst_of
from fctd.model.casing_wear import WEAR_UNIT, groove_area, groove_depth
from fctd.model.depths import depths_of
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.results.attrs import attrs_of
from fctd.results.profile import JOINT, edges_of
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd

# Wear factors of a steel tool joint in casing, or of a hardbanding that spares casing, in mud [1e-10/psi]: an order of
# magnitude.  Rough tungsten carbide wears a hundred times as much.
USUAL_FACTORS: Final = (2.0, 10.0)
LEAST_FACTOR, MOST_FACTOR = 0.01, 1e4  # [1e-10/psi]
STEP: Final = 10.0  # [m] of casing in a row of the table
TURNING: Final = tuple(kind for kind, of in KINDS.items() if of.turns)
MOST_ROWS: Final = 100_000
LONGEST: Final = 3.6e8  # [s]: no rig drills a well for eleven years
_IN_SI: Final = (LikelyUnit(0.0, 1e-5, "", 1e10),)
Progress = Callable[[int, int], None]
Row = dict[str, Any]


@dataclass
class Worn:
    """Sums over a schedule for places of the casing (k,), each between two ends (k + 1,) [m].

    force : side force per length times turns [N/m]; sliding : the same times the diameter of what touches [N].
    """

    ends: Array

    def __post_init__(self) -> None:
        self.force, self.sliding = np.zeros((2, len(self.ends) - 1))

    def add(self, point: Equilibrium, turns: float) -> None:
        """Add what a steady string does in so many turns."""
        profile, string = point.profile, point._shape.laid.string
        edges = edges_of(profile["md_m"].to_numpy(float))
        normal = profile["contact_force_N"].to_numpy(float)
        across = 2 * np.append(0.0, string.contact_radius())
        for of, sums in ((normal, self.force), (normal * across, self.sliding)):
            below = np.append(0.0, np.cumsum(of))
            sums += turns * np.diff(np.interp(self.ends, edges, below)) / np.diff(self.ends)

    @property
    def area(self) -> Array:
        """Area that is worn off the casing for a wear factor of 1/Pa (k,) [m² Pa]."""
        return np.asarray(np.pi * self.sliding)

    @property
    def diameter(self) -> Array:
        """Mean diameter of what wears the casing (k,) [m], NaN where nothing touches it."""
        mean: Array = np.divide(self.sliding, self.force, out=np.full(len(self.force), np.nan), where=self.force > 0)
        return mean


def casing_wear(
    case: Case,
    bit_depths: float | str | Sequence[float | str] = "td",
    *,
    duration: float | str | None = None,
    penetration: float | str | None = None,
    rpm: float | str | None = None,
    wear_factor: float | Sequence[float] = USUAL_FACTORS,
    operation: str = "drill_rotating",
    step: float | str = STEP,
    friction: FrictionChoice | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """The wear of a case's casing by a string that turns, a row for every ``step`` [m] of casing, SI.

    bit_depths [m] : of the schedule, as of ``torque_drag``.  It takes a duration [s] in all, as much for every metre,
    or the bit moves with a rate of penetration [m/s].  rpm : see ``equilibrium``.  wear_factor [1e-10/psi] :
    one, or the lowest and the highest.  operation : a kind that turns.  Texts have units.  friction : None for the
    case's own.

    Columns: casing, md_m (middle of the row), side_force_N (mean force on 30 ft of string in all turns), low_area_m2
    and high_area_m2 (of the groove, by the wear factors), low_groove_m and high_groove_m (its depth), low_worn and
    high_worn (as a share of the wall), burst_Pa (of new casing), low_burst_Pa and high_burst_Pa (beside the deeper
    and the shallower groove).
    ``attrs`` have ``turns``, ``time_s``, ``wear_factors`` and ``doubted``, why by bit depth of strings whose loads are
    doubtful.  Raises InputError for unusable input, for a case without
    casing whose wall is known, and where a string of the schedule has no steady state.

        >>> case = fctd.load_case("examples/my_well.toml", {"wellbore.intervals[0].casing": "9 5/8 in 47 N-80"})
        >>> worn = fctd.casing_wear(case, "1500:3000:250", penetration="20 m/h", rpm=120)
        >>> bool(worn["high_groove_m"].max() > worn["low_groove_m"].max() > 0)
        True
    """
    with naming_file(case):
        low, high = _factors(wear_factor)
        if operation not in TURNING:
            raise InputError(" or ".join(TURNING), key="operation", value=operation)
        casings = casings_of(case)
        depths = depths_of(bit_depths, case, "bit_depths")
        rates = rates_of_all(case, [operation], rpm=rpm)[operation]
        time = _times(depths, duration, penetration)
        every = argument(step, LENGTH, "step")
        if not case.wellbore.intervals[-1].to_md / MOST_ROWS < every < np.inf:
            raise InputError("a length of casing for a row of the table", key="step", value=step)
        solver = Solver(with_friction(case, friction))
        worn = [Worn(_ends(top, min(of.to_md, depths[-1]), every)) for top, of in casings if top < depths[-1]]
        doubted = {}
        for done, (depth, lasts) in enumerate(zip(depths, time, strict=True)):
            point = _string(solver, operation, rates, depth)
            if not point.status.acceptable:
                doubted[depth] = Message(f"{point.status}: {within(point.message)}")
            for one in worn:
                one.add(point, lasts * rates.spin / (2 * np.pi))
            if progress is not None:
                progress(done + 1, len(depths))
    turns = float(sum(time)) * rates.spin / (2 * np.pi)
    rows = [row for (_, of), one in zip(casings, worn, strict=False) for row in _rows(case, of, one, turns, low, high)]
    table = frame_of(rows)
    table.attrs = attrs_of(case, [operation], {"rpm": rpm}) | {
        "turns": turns, "time_s": float(sum(time)), "wear_factors": [low, high], "doubted": doubted,
    }  # fmt: skip
    return table


def casings_of(case: Case) -> list[tuple[float, IntervalSpec]]:
    """The intervals of a case whose wall is known, with their upper ends [m]; raises InputError where there is none."""
    tops = [0.0, *(interval.to_md for interval in case.wellbore.intervals)]
    found = [(top, of) for top, of in zip(tops, case.wellbore.intervals, strict=False) if of.outer_diameter is not None]
    if not found:
        raise InputError(
            "casing whose wall wears, such as '9 5/8 in 47 N-80', or outer_diameter and yield_strength",
            key="wellbore.intervals[0].casing",
        )
    return found


def _factors(given: float | Sequence[float]) -> tuple[float, float]:
    """The lowest and the highest wear factor [1e-10/psi]."""
    several = [given] if np.ndim(given) == 0 else list(given)  # type: ignore[arg-type]  # a sequence then
    factors = [bare(value, "wear_factor", "a wear factor in 1e-10/psi") for value in several]
    for factor in factors:
        if not LEAST_FACTOR <= factor <= MOST_FACTOR:
            wanted = f"a wear factor in 1e-10/psi, {LEAST_FACTOR:g} to {MOST_FACTOR:g}{unit_hint(factor, _IN_SI)}"
            raise InputError(wanted, key="wear_factor", value=factor)
    if not 1 <= len(factors) <= 2 or factors[0] > factors[-1]:
        raise InputError("one wear factor, or the lowest and the highest", key="wear_factor", value=several)
    return factors[0], factors[-1]


def _times(depths: Sequence[float], duration: float | str | None, penetration: float | str | None) -> Array:
    """How long the bit is near each of its depths (n,) [s]."""
    if (duration is None) == (penetration is None):
        raise InputError("duration or penetration", key="duration" if duration is None else "penetration")
    if duration is not None:
        total = argument(duration, TIME, "duration")
        if not 0 < total <= LONGEST:
            raise InputError(f"a time above 0 and at most {LONGEST / 3600:g} h", key="duration", value=duration)
    if penetration is not None:
        rate = argument(penetration, SPEED, "penetration")
        if not 0 < rate <= FASTEST:
            raise InputError(
                f"a speed above 0 and at most {quantity(FASTEST, 'm/s')}", key="penetration", value=penetration
            )
        if len(depths) < 2:
            raise InputError("depths that are drilled, FROM:TO:STEP, with a rate of penetration", key="bit_depths")
        total = (depths[-1] - depths[0]) / rate
    if len(depths) < 2:
        return np.array([total])
    drilled = np.diff(edges_of(np.array(depths)))
    return np.asarray(total * drilled / drilled.sum())


def _ends(top: float, bottom: float, step: float) -> Array:
    """Ends of rows of casing (k + 1,) [m], of about a step each."""
    return np.linspace(top, bottom, max(int(nearest((bottom - top) / step)), 1) + 1)


def _string(solver: Solver, operation: str, rates: SteadyRates, depth: float) -> Equilibrium:
    point = solver.solve(operation, rates, depth)
    if not point.answered:
        steady = f"depths at which a steady string is found: it is {point.status}, {within(point.message)}"
        raise InputError(steady, key="bit_depths", value=quantity(depth, "m"))
    return point


def _rows(case: Case, of: IntervalSpec, worn: Worn, turns: float, low: float, high: float) -> list[Row]:
    assert of.outer_diameter is not None  # as of all casings
    assert of.yield_strength is not None
    name = of.name or of.casing or f"interval {case.wellbore.intervals.index(of)}"
    rows = []
    for k, md in enumerate(0.5 * (worn.ends[1:] + worn.ends[:-1])):
        row: Row = {"casing": name, "md_m": md, "side_force_N": worn.force[k] / turns * JOINT}
        grooves = {}
        for side, factor in (("low", low), ("high", high)):
            area = factor * WEAR_UNIT * worn.area[k]
            joint, bore = 0.5 * worn.diameter[k], 0.5 * of.diameter
            grooves[side] = groove_depth(area, joint, bore, of.wall)
            row |= {f"{side}_area_m2": min(area, groove_area(of.wall, joint, bore)) if area else 0.0}
        row |= {f"{side}_groove_m": depth for side, depth in grooves.items()}
        row |= {f"{side}_worn": depth / of.wall for side, depth in grooves.items()}
        # As API has it of new casing, an eighth of the wall that is left is taken to be missing.
        for column, depth in (("burst", 0.0), ("low_burst", grooves["high"]), ("high_burst", grooves["low"])):
            row[f"{column}_Pa"] = burst_of(of.yield_strength, of.outer_diameter, THINNEST * (of.wall - depth))
        rows.append(row)
    return rows
