"""Checks that catch an engine that gives numbers without having kept the string: each a value and a bound.

A friendly status is no evidence.  What every valid run has kept: a finite state, its points in the hole, its length,
its energy, and a hook load that no longer drifts.
"""

import numpy as np
import pandas as pd

from fctd import state
from fctd.energy import penetration
from fctd.record import LOSSES
from fctd.run import Run, contact_points

# Largest depth in the wall over the clearance there; the stiffest wall of a case is pressed in by less than 2 %.
DEEPEST = 0.2
# Length of the chain against its segments stretched by its own tension, relative: a third of what hanging stretches
# a kilometre of pipe by.
LENGTH = 1e-4
# Energy that came from nowhere or went there, over the energy that was turned over.
ENERGY = 0.05
# Hook load of the last third of a window against the third before, relative.
DRIFT = 0.01


def examine(run: Run, history: pd.DataFrame, profile: pd.DataFrame, energy: pd.DataFrame, broken: str) -> pd.DataFrame:
    """A row per check: check, value, bound, passed.  broken : how the run ended early, or nothing."""
    values = {
        "finite state": (_not_finite(run, history) + bool(broken), 0.0),
        "end points inside the hole": (_deepest(run), DEEPEST),
        "chain length": (_length_error(run, profile), LENGTH),
        "energy": (energy_error(energy), ENERGY),
        "settled hook load": (_drift(history), DRIFT),
    }
    rows = [
        {"check": name, "value": value, "bound": bound, "passed": bool(np.isfinite(value) and value <= bound)}
        for name, (value, bound) in values.items()
    ]
    return pd.DataFrame(rows)


def energy_error(energy: pd.DataFrame) -> float:
    """Largest residual of a ledger over the energy turned over: losses, or work beyond lifting."""
    if energy.empty:
        return np.nan
    lost = energy[list(LOSSES)].sum(axis=1).abs().max()
    beyond = (energy["top_drive_work_J"] - energy["gravity_J"]).abs().max()
    moving = energy["kinetic_J"].abs().max() + energy["strain_J"].abs().max()
    work = max(lost, beyond, moving)
    return float(energy["residual_J"].abs().max() / work) if work > 0 else 0.0


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


def _drift(history: pd.DataFrame) -> float:
    late, last = np.array_split(history["hookload_N"].to_numpy(), 3)[1:]
    if not len(last):
        return np.nan
    return float(abs(last.mean() - late.mean()) / np.abs(history["hookload_N"]).mean())
