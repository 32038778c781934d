"""Torque-and-drag charts: the steady string of several operations at many bit depths, one row for each."""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.case.units import FRICTION, bare
from fctd.model.operations import rates_of_all
from fctd.model.wellbore import build_wellbore
from fctd.results.buckling import UNKNOWN
from fctd.results.columns import IN_CHART, SHAPES, SHARES
from fctd.results.notes import codes_of
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Equilibrium, Solver

# Called after every row with the number of rows done and their total.
Progress = Callable[[int, int], None]


def torque_drag(
    case: Case,
    operation: str | Sequence[str],
    bit_depths: Sequence[float],
    friction: float | Sequence[float] | None = None,
    speed: float | None = None,
    rpm: float | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """A row per operation, friction and depth.

    operation : kind or kinds; bit_depths [m] : rising; friction : kinetic factor or factors for every interval
    in turn, None for the case's own.  speed [m/s], rpm : see ``equilibrium``; only for kinds that have them.
    Columns: operation, friction (NaN where the case's intervals differ), bit_depth_m, the loads of
    ``columns.IN_CHART`` (hookload_N and so on), buckling (none, sinusoidal, helical, or unknown without loads),
    buckled_from_md_m and buckled_to_md_m (NaN where the string is not buckled), shape (of a resolved string: none,
    snaking or helix), hookload_low_N and hookload_high_N (of both shapes, NaN where they do not differ),
    slack_off_spent_at and locked_up_at (shares of the friction, NaN where not found), status (of ``SteadyStatus``),
    iterations, notes (codes of ``notes.MEANINGS``, or none), reason (of a status other than converged, or none).  A
    row without a balance has NaN in place of loads; so has one that is ``locked_up`` where no push suffices, and one
    that is ``unstable`` because no steady shape was found.  At a depth where string and hole do not fit the status is
    ``not_possible``.  Raises InputError for unusable input, and where string and hole fit at none of the depths.
    """
    with naming_file(case):
        depths = _check_depths(bit_depths)
        kinds = [operation] if isinstance(operation, str) else list(operation)
        if not kinds:
            raise InputError("at least one kind of operation", key="operation", value=[])
        rates = rates_of_all(case, kinds, speed, rpm)
        factors = _factors(friction)
        hole = build_wellbore(case)
        solvers = [
            Solver(case, hole) if factor is None else Solver(with_friction(case, factor), hole.with_friction(factor))
            for factor in factors
        ]
        misfits = _misfits(solvers[0], depths)
        rows = []
        for kind in kinds:
            for solver in solvers:
                for depth in depths:
                    point, misfit = None, misfits.get(depth)
                    if misfit is None:
                        try:
                            point = solver.solve(kind, rates[kind], depth)
                        except InputError as error:  # as of a resolved string with too many segments
                            misfit = str(error)
                    rows.append(_row(solver.case, kind, depth, point, misfit))
                    if progress is not None:
                        progress(len(rows), len(kinds) * len(solvers) * len(depths))
        return pd.DataFrame(rows)


def with_friction(case: Case, factor: float) -> Case:
    """The case with one kinetic friction factor, at least 0, in every interval."""
    intervals = tuple(i.model_copy(update={"friction": factor}) for i in case.wellbore.intervals)
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": intervals})})


def own_friction(case: Case) -> float:
    """The friction factor of the case if all its intervals have the same, else NaN."""
    factors = {interval.friction for interval in case.wellbore.intervals}
    return factors.pop() if len(factors) == 1 else float("nan")


def _misfits(solver: Solver, depths: Sequence[float]) -> dict[float, str]:
    """Depths at which string and hole do not fit, with the reason; raises InputError where they fit at none."""
    found: dict[float, InputError] = {}
    for depth in depths:
        try:
            solver.lay_out(depth)
        except InputError as error:
            found[depth] = error
    if len(found) == len(depths):
        raise found[depths[0]]
    return {depth: str(error) for depth, error in found.items()}


def _row(case: Case, kind: str, depth: float, point: Equilibrium | None, misfit: str | None) -> dict[str, object]:
    """A chart row: of a solved string, or of a depth where string and hole do not fit (point is None)."""
    answer = point if point is not None and point.answered else None
    # The values of an unfinished iteration are not loads.
    loads = {load.name: float("nan") if answer is None else load.value(answer) for load in IN_CHART}
    # A string that no push moves has no loads, but a share at which it locked up.
    found = {column.name: float("nan") if point is None else column.value(point) for column in (*SHAPES, *SHARES)}
    return {
        "operation": kind,
        "friction": own_friction(case),
        "bit_depth_m": depth,
        **loads,
        **(UNKNOWN if point is None else point.buckling).columns(),
        "shape": "none" if point is None else point.shape,
        **found,
        "status": str(SteadyStatus.NOT_POSSIBLE if point is None else point.status),
        "iterations": 0 if point is None else point.iterations,
        "notes": codes_of(() if point is None else point.notes),
        "reason": (misfit if point is None else point.message) or "none",
    }


def _check_depths(bit_depths: Sequence[float]) -> list[float]:
    if np.ndim(bit_depths) != 1:
        raise InputError("a list of numbers of metres", key="bit_depths", value=bit_depths)
    depths = [bare(depth, f"bit_depths[{k}]", "a number of metres") for k, depth in enumerate(bit_depths)]
    if not depths:
        raise InputError("at least one bit depth", key="bit_depths", value=[])
    for before, here in zip([-np.inf, *depths], depths, strict=False):
        if not before < here < np.inf:
            raise InputError("finite bit depths, each below the one before", key="bit_depths", value=f"{here:g} m")
    return depths


def _factors(friction: float | Sequence[float] | None) -> list[float | None]:
    if friction is None:
        return [None]
    try:
        factors = [FRICTION.parse(factor) for factor in np.atleast_1d(friction).tolist()]
    except InputError as error:
        raise error.at("friction") from None
    if not factors:
        raise InputError("at least one friction factor", key="friction", value=[])
    return list(factors)
