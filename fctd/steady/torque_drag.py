"""Torque-and-drag charts: the steady string of several operations at many bit depths, a row each."""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.case.units import FRICTION, bare
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.model.wellbore import build_wellbore
from fctd.results.notes import codes_of
from fctd.steady.equilibrium import Equilibrium, Solver

# Called after every row with the number of rows done and of all.
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
    in turn, None for the case's own.  speed [m/s], rpm : as of ``equilibrium``, for the kinds that have them.
    Columns: operation, friction (NaN where the case's intervals differ), bit_depth_m, hookload_N,
    surface_torque_N_m, weight_indicator_N, drive_torque_N_m, total_contact_force_N, status, iterations, notes
    (codes of ``notes.MEANINGS``, or none).  A row without an answer (status) has NaN for its loads.  Raises InputError
    for what cannot be used.
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
        rows = []
        for kind in kinds:
            for solver in solvers:
                for depth in depths:
                    rows.append(_row(solver, kind, rates[kind], depth))
                    if progress is not None:
                        progress(len(rows), len(kinds) * len(solvers) * len(depths))
        return pd.DataFrame(rows)


def with_friction(case: Case, factor: float) -> Case:
    """The case with one kinetic friction factor, at least 0, in every interval."""
    intervals = tuple(i.model_copy(update={"friction": factor}) for i in case.wellbore.intervals)
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": intervals})})


def own_friction(case: Case) -> float:
    """The friction factor of a case whose intervals agree on one, else NaN."""
    factors = {interval.friction for interval in case.wellbore.intervals}
    return factors.pop() if len(factors) == 1 else float("nan")


def _row(solver: Solver, kind: str, rates: SteadyRates, depth: float) -> dict[str, object]:
    point = solver.solve(kind, rates, depth)
    return {
        "operation": kind,
        "friction": own_friction(solver.case),
        "bit_depth_m": depth,
        "hookload_N": _answer(point, point.hookload),
        "surface_torque_N_m": _answer(point, point.surface_torque),
        "weight_indicator_N": _answer(point, point.weight_indicator),
        "drive_torque_N_m": _answer(point, point.drive_torque),
        "total_contact_force_N": _answer(point, point.total_contact_force),
        "status": point.status,
        "iterations": point.iterations,
        "notes": codes_of(point.notes),
    }


def _answer(point: Equilibrium, value: float) -> float:
    """A load of a row; what an unfinished iteration left there is nobody's load."""
    return value if point.answered else float("nan")


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
