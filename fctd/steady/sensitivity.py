"""Derivatives of a steady string's loads by friction, mass and mud, from the tangent of its balance.

At a balance R(x, p) = 0 a small change of a parameter p shifts the pose by one Newton step, K Δx = ∂R/∂p Δp, which
costs a tenth of a solve.
"""

import copy
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.model.operations import SteadyRates
from fctd.steady.continuation import Pace
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.problem import Problem
from fctd.steady.steady_string import Equilibrium

# One step of Newton's method, whatever its size: no pseudo-mass, no limit, no imbalance that ends it.
_ONE_STEP = Pace(1, 1e9, 1.0, 1.0, 1e9, 1.0, 1e9, 1e-200, 1e-200)
# Largest difference of the hook load after a Newton step from the answer's, over the weight of the string.
_SAME = 1e-5


class Changed(NamedTuple):
    """A string after a small change of one parameter: the solver of the changed case and hole, and the string."""

    solver: Solver
    laid: LaidString


def solve_with_changes(
    solver: Solver, operation: str, rates: SteadyRates, laid: LaidString, changes: Sequence[Changed]
) -> tuple[Equilibrium, Array]:
    """The steady string, and what each change adds to its hook load [N] and surface torque [N m], (k, 2).

    NaN where the string, or a changed one, has no balance.  A resolved or wound string, whose pose is not that of its
    layout, is solved anew for every change.  Raises InputError as ``Solver.solve`` does.
    """
    problem = solver.problem(operation, rates, laid)
    point = solver.solve_problem(problem)
    if not changes or not point.answered:
        return point, np.full((len(changes), 2), np.nan)
    elsewhere = problem.given.share.any() or point.shape != "none"
    if elsewhere or not abs(_loads_after_step(problem)[0] - point.hookload) <= _SAME * problem.weight:
        answers = [c.solver.solve_string(operation, rates, c.laid) for c in changes]
        found = [[p.hookload, p.surface_torque] if p.answered else [np.nan, np.nan] for p in answers]
        return point, np.array(found) - [point.hookload, point.surface_torque]
    pose = problem.copy_pose()
    at_rest = _loads_after_step(problem)
    rows = []
    # The buffer of the solver is filled once for each string: those of another mass come last.
    order = sorted(range(len(changes)), key=lambda k: changes[k].laid is not laid)
    for k in order:
        changed = _changed(problem, changes[k])
        changed.put_pose(pose)
        rows.append(_loads_after_step(changed) - at_rest)
    return point, np.array(rows)[np.argsort(order)]


def _changed(problem: Problem, change: Changed) -> Problem:
    """The problem with the changed hole or string."""
    if change.laid is problem.laid:
        other = copy.copy(problem)
        other.hole = change.solver.hole
        return other
    other = Problem(
        change.solver.case, change.solver.hole, problem.work, change.laid, problem.operation, problem.rates,
        problem.allowance,
    )  # fmt: skip
    other.kinks, other.at_axis = problem.kinks, problem.at_axis
    return other


def _loads_after_step(problem: Problem) -> Array:
    """Hook load [N] and torque [N m] after one step of Newton's method."""
    problem.iterate(_ONE_STEP)
    found = problem.reactions()
    return np.array([found.hookload, found.torque])
