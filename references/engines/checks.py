"""Checks that catch an engine that gives numbers without having kept the string: each a value and a bound.

A friendly status is no evidence.  What every valid run has kept: a finite state, its points in the hole, its length,
its energy, and a hook load that no longer drifts.
"""

import numpy as np
import pandas as pd
from scipy.linalg import eigh_tridiagonal

from fctd.mechanics import state
from fctd.mechanics.energy import penetration
from fctd.results import ledger
from fctd.simulation.run import Run, contact_points

# Largest depth in the wall over the clearance there; the stiffest wall of a case is pressed in by less than 2 %.
DEEPEST = 0.2
# Length of the chain against its segments stretched by its own tension, relative: a third of what hanging stretches
# a kilometre of pipe by.
LENGTH = 1e-4
# Energy that came from nowhere or went there, over the energy that was turned over.
ENERGY = 0.05
# Hook load at the end of a window against that before it, over hook load or contact force.
DRIFT = 0.01


def examine(
    run: Run, start: float, history: pd.DataFrame, profile: pd.DataFrame, energy: pd.DataFrame, broken: str
) -> pd.DataFrame:
    """A row per check: check, value, bound, passed.

    start [s] : of the window; broken : how the run ended early, or nothing.
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
    """How many numbers of the last state and of the history are none."""
    rows = [state.row(run.S, k, run.segments) for k in (state.X, state.Y, state.Z, state.VX, state.VY, state.VZ)]
    loads = history[["hookload_N", "surface_torque_N_m", "total_contact_force_N"]].to_numpy()
    return float((~np.isfinite(np.stack(rows))).sum() + (~np.isfinite(loads)).sum())


def _deepest(run: Run) -> float:
    if run.laws.geometry == state.OPEN:
        return 0.0
    n = run.segments
    clearance = state.row(run.S, state.HOLE, n) - state.row(run.S, state.RADIUS, n)
    return float((penetration(run.S, n) / clearance).max())


def _length_error(run: Run, profile: pd.DataFrame) -> float:
    """Length through the end points against the segments stretched by the tension of the joints, relative."""
    n = run.segments
    ends = np.vstack([run.S[[state.X, state.Y, state.Z]], contact_points(run.S, n)])
    measured = np.linalg.norm(np.diff(ends, axis=0), axis=1).sum()
    length = state.row(run.S, state.ARM_TOP, n) + state.row(run.S, state.ARM_BOTTOM, n)
    last = profile.iloc[-(n + 1) :]
    joints = last["effective_tension_N"].to_numpy()[:n]
    expected = length.sum() + (joints / state.row(run.S, state.K_AXIAL, n)).sum()
    return float(abs(measured / expected - 1))


def axial_period(run: Run) -> float:
    """Longest period [s] with which the string rings along itself, held at the top, free at the bit, no friction.

    A string that slides rings on: Coulomb friction is the same at any speed of sliding and takes nothing from it.
    """
    mass, spring = state.row(run.S, state.MASS, run.segments), state.row(run.S, state.K_AXIAL, run.segments)
    diagonal = (spring + np.append(spring[1:], 0.0)) / mass
    beside = -spring[1:] / np.sqrt(mass[1:] * mass[:-1])
    lowest = eigh_tridiagonal(diagonal, beside, eigvals_only=True, select="i", select_range=(0, 0))[0]
    return float(2 * np.pi / np.sqrt(lowest))


def drift(start: float, history: pd.DataFrame, period: float) -> float:
    """Mean hook load of the last period against that of all whole periods before it in a window, relative.

    In a window without two periods its halves are compared, and ringing counts as drift.
    """
    times = np.append(start, history["time_s"])
    if len(times) < 3 or history["hookload_N"].isna().any():
        return np.nan
    summed = np.append(0.0, np.cumsum(history["hookload_N"].to_numpy() * np.diff(times)))
    end, length = times[-1], times[-1] - start
    # Rows are means: what the sum is between their ends is a matter of the record interval.
    periods = int(length / period * (1 + 1e-9))
    last = period if periods >= 2 else 0.5 * length
    first = end - periods * period if periods >= 2 else start
    before, middle, after = np.interp([first, end - last, end], times, summed)
    early, late = (middle - before) / (end - last - first), (after - middle) / last
    scale = max(abs(summed[-1]) / length, float(history["total_contact_force_N"].mean()))
    return float(abs(late - early) / scale) if scale > 0 else np.nan
