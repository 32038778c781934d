"""Checks on the run of any engine, each a value and a bound.

An engine can report success for a string that has come apart or left the hole.  A valid run has a finite state, points
inside the hole, the right length, a closed energy balance and a hook load that does not drift.
"""

import numpy as np
import pandas as pd
from scipy.linalg import eigh_tridiagonal

from fctd.mechanics import state
from fctd.mechanics.energy import penetration
from fctd.results import ledger
from fctd.simulation.preparation import contact_points
from fctd.simulation.run import Run

# Largest depth in the wall over the clearance there; less than 2 % with the stiffest wall of a case.
DEEPEST = 0.2
# A bit or a stabiliser that fills its hole has no clearance: depths count against this share of the hole's radius.
CLOSE = 0.05
# Relative error of the length of the chain, compared with its segments stretched by their tension: a third of the
# strain of a kilometre of hanging pipe.
LENGTH = 1e-4
# Residual of the energy balance over the energy converted in the run.
ENERGY = 0.05
# Difference between the hook load at the end of a window and before, over hook load or contact force.
DRIFT = 0.01


def examine(
    run: Run, start: float, history: pd.DataFrame, profile: pd.DataFrame, energy: pd.DataFrame, broken: str
) -> pd.DataFrame:
    """A row per check: check, value, bound, passed.

    start [s] : start of the window; broken : the error that ended the run early, or empty.
    """
    values = {
        "finite state": (_not_finite(run, history) + bool(broken), 0.0),
        "end points inside the hole": (_deepest(run), DEEPEST),
        "chain length": (_length_error(run, profile), LENGTH),
        "energy": (ledger.error(energy, motion=True), ENERGY),
        "settled hook load": (drift(start, history, axial_period(run)), DRIFT),
    }
    rows = [
        {"check": name, "value": value, "bound": bound, "passed": bool(np.isfinite(value) and value <= bound)}
        for name, (value, bound) in values.items()
    ]
    return pd.DataFrame(rows)


def _not_finite(run: Run, history: pd.DataFrame) -> float:
    """Number of values in the last state and in the history that are not finite."""
    rows = [state.row(run.S, k, run.segments) for k in (state.X, state.Y, state.Z, state.VX, state.VY, state.VZ)]
    loads = history[["hookload_N", "surface_torque_N_m", "total_contact_force_N"]].to_numpy()
    return float((~np.isfinite(np.stack(rows))).sum() + (~np.isfinite(loads)).sum())


def _deepest(run: Run) -> float:
    if run.laws.geometry == state.OPEN:
        return 0.0
    n = run.segments
    hole = state.row(run.S, state.HOLE, n)
    clearance = np.maximum(hole - state.row(run.S, state.RADIUS, n), CLOSE * hole)
    return float((penetration(run.S, n) / clearance).max())


def _length_error(run: Run, profile: pd.DataFrame) -> float:
    """Relative error of the length through the end points, compared with segments stretched by their joint tension.

    NaN for a state that is not finite, of which there is no profile.
    """
    n = run.segments
    ends = np.vstack([run.S[[state.X, state.Y, state.Z]], contact_points(run.S, n)])
    measured = np.linalg.norm(np.diff(ends, axis=0), axis=1).sum()
    if not np.isfinite(measured):
        return float("nan")
    length = state.row(run.S, state.ARM_TOP, n) + state.row(run.S, state.ARM_BOTTOM, n)
    last = profile.iloc[-(n + 1) :]
    joints = last["effective_tension_N"].to_numpy()[:n]
    expected = length.sum() + (joints / state.row(run.S, state.K_AXIAL, n)).sum()
    return float(abs(measured / expected - 1))


def axial_period(run: Run) -> float:
    """Longest period [s] of axial vibration of the string, fixed at the top, free at the bit, without friction.

    A sliding string keeps vibrating: Coulomb friction does not depend on speed and does not damp the vibration.
    """
    mass, spring = state.row(run.S, state.MASS, run.segments), state.row(run.S, state.K_AXIAL, run.segments)
    diagonal = (spring + np.append(spring[1:], 0.0)) / mass
    beside = -spring[1:] / np.sqrt(mass[1:] * mass[:-1])
    lowest = eigh_tridiagonal(diagonal, beside, eigvals_only=True, select="i", select_range=(0, 0))[0]
    return float(2 * np.pi / np.sqrt(lowest))


def drift(start: float, history: pd.DataFrame, period: float) -> float:
    """Relative difference between the mean hook load of the last period and of all whole periods before it in a window.

    In a window shorter than two periods its halves are compared, and vibration counts as drift.
    """
    times = np.append(start, history["time_s"])
    if len(times) < 3 or history["hookload_N"].isna().any():
        return np.nan
    summed = np.append(0.0, np.cumsum(history["hookload_N"].to_numpy() * np.diff(times)))
    end, length = times[-1], times[-1] - start
    # Rows are means over record intervals: between their ends the sum is interpolated.
    periods = int(length / period * (1 + 1e-9))
    last = period if periods >= 2 else 0.5 * length
    first = end - periods * period if periods >= 2 else start
    before, middle, after = np.interp([first, end - last, end], times, summed)
    early, late = (middle - before) / (end - last - first), (after - middle) / last
    scale = max(abs(summed[-1]) / length, float(history["total_contact_force_N"].mean()))
    return float(abs(late - early) / scale) if scale > 0 else np.nan
