"""Rungs of the onset of buckling in vertical hole: where the first unstable mode appears, and what a row says there."""

from collections.abc import Callable

import numpy as np
from scipy.special import ai_zeros

from fctd import Case, equilibrium
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from references.beams.beam_column import bending, grid, lowest_loads, stretching
from validation.parts.buckled_pipe import CREEP
from validation.studies.ladder.rung import NoAnswerError, Rung, Tables, case_of, pipe_of
from validation.studies.ladder.wells import HOLE, part, straight, well

LENGTH, KIND = 247.0, "drill_sliding"  # [m]: 14 (EI/w)^⅓
LOW, HIGH = 0.8, 1.1  # of the exact force, between which the onset is sought
CLOSELY, ROUGHLY = 1e-6, 1e-3  # of it, to which the onset is found by modes and by status


def free_end(cut: float) -> Tables:
    """Pipe that hangs in the middle of a wide vertical hole, with weight on its free lower end."""
    return well(straight(LENGTH, 0.0), [part(None, cut)], hole=0.311, rig={"block_weight": 1e6})


def pinned_end(cut: float) -> Tables:
    """The same with a bit as wide as the hole."""
    bit = part(0.5, 0.5, name="bit", contact_diameter=HOLE)
    return well(straight(LENGTH, 0.0), [bit, part(None, cut)], rig={"block_weight": 1e6})


def free_onset(case: Case) -> float:
    """1.0188 (EI w²)^⅓: the first zero of Ai', as the slope of a heavy column is an Airy function."""
    return float(-ai_zeros(1)[1][0] * pipe_of(case).vertical)


def pinned_onset(case: Case) -> float:
    """Of a heavy column, clamped above and pinned below, by 140 Hermite elements."""
    pipe = pipe_of(case, len(case.string.components) - 1)
    x = grid(np.array([0.0, LENGTH]), 140)
    stiffness = bending(x, pipe.EI) + stretching(x, pipe.weight * x)
    return float(lowest_loads(stiffness, stretching(x, np.ones_like(x)), [0, 2 * len(x) - 2, 2 * len(x) - 1])[0])


def by_modes(exact: Callable[[Case], float]) -> Callable[[Case], float]:
    """The force at which the straight string's balance has its first unstable mode [N]."""

    def found(case: Case) -> float:
        solver, bit = Solver(case), case.depths[1]
        problem = solver.problem(KIND, steady_rates(case, KIND, None, None), solver.lay_out(bit))

        def is_straight(force: float) -> bool:
            problem.weight_on_bit = force
            problem.lay_guess()
            code, _ = problem.relax(CREEP._replace(force=problem.allowed, moment=problem.allowed))
            if code != CONVERGED:
                raise NoAnswerError(f"no balance at {force:.4g} N")
            return problem.unstable_modes() == 0

        return bisected(is_straight, exact(case), CLOSELY)

    return found


def by_status(tables: Callable[[float], Tables], exact: Callable[[Case], float]) -> Callable[[Case], float]:
    """The force up to which a row is straight and converged [N]; beyond it a row says that it is buckled."""

    def found(case: Case) -> float:
        cut = case.string.components[-1].segment_length
        assert cut is not None

        def is_straight(force: float) -> bool:
            loaded = case_of(tables(cut), {"bit.weight_on_bit": force})
            point = equilibrium(loaded, KIND, loaded.depths[1])
            if point.status != SteadyStatus.CONVERGED:
                return False
            # Just beyond the onset a bent pipe hardly touches the wall, but it lies there.
            aside = np.hypot(point.profile["offset_high_m"], point.profile["offset_right_m"])
            return bool(aside.max() < 0.1 * pipe_of(loaded, len(loaded.string.components) - 1).clearance)

        return bisected(is_straight, exact(case), ROUGHLY)

    return found


def bisected(is_straight: Callable[[float], bool], near: float, within: float) -> float:
    """The force [N] from which on a string is not straight; NoAnswerError where it is or is not at all forces."""
    low, high = LOW * near, HIGH * near
    if not is_straight(low):
        raise NoAnswerError(f"not straight at {LOW:g} times the onset")
    if is_straight(high):
        raise NoAnswerError(f"still straight, and converged, at {HIGH:g} times the onset")
    while high - low > within * near:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_straight(middle) else (low, middle)
    return 0.5 * (low + high)


RUNGS = [
    Rung(
        "onset of a free lower end, unstable modes", "1.0188 (EI w²)^⅓, the first zero of Ai'", free_end, free_onset,
        {"steady": by_modes(free_onset)}, "N", (1.7, 1.0), refined=(6.0, 3.0, 1.5), order=(1.5, 2.5),
    ),
    Rung(
        "onset of a pinned lower end, unstable modes", "heavy column by Hermite elements (Lubinski 1950: 1.94 (EI "
        "w²)^⅓ for a shorter one)", pinned_end, pinned_onset, {"steady": by_modes(pinned_onset)}, "N", (1.7, 1.0),
        refined=(6.0, 3.0, 1.5), order=(1.5, 2.5),
    ),
    Rung(
        "onset of a free lower end, status", "no row beyond 1.0188 (EI w²)^⅓ is straight and converged", free_end,
        free_onset, {"steady": by_status(free_end, free_onset)}, "N", (1.7, 1.0),
    ),
    Rung(
        "onset of a pinned lower end, status", "no row beyond the onset is straight and converged", pinned_end,
        pinned_onset, {"steady": by_status(pinned_end, pinned_onset)}, "N", (1.7, 1.0),
    ),
]  # fmt: skip
