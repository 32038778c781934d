"""Schedules that lead a simulation to a steady state, and means over its end."""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, SimulationResult, simulate
from references.engines.run import hann_means
from validation.cases import trip

PARTS = 10  # of a run, each with a real-time factor of its own
TRIP_SPEED, TRIP_WINDOW = 0.2, 20.0  # [m/s]; [s] of a steady trip over which loads are averaged


def steady_trip(kind: str, depth: float) -> list[dict[str, Any]]:
    """A trip whose bit passes a depth [m] in the middle of its last TRIP_WINDOW.

    It starts 8 m before, which is far enough for every contact to slide.
    """
    down = 1.0 if kind == "trip_in" else -1.0
    return trip(depth - down * 8.0, depth + down * TRIP_SPEED * TRIP_WINDOW / 2, TRIP_SPEED, ramp=10.0)


def completed(result: SimulationResult) -> SimulationResult:
    """The result of a run that completed; raises RuntimeError for any other."""
    if result.status != "completed":
        raise RuntimeError(f"{result.case.name}: {result.status}, {result.message}")
    return result


def in_parts(case: Case, **asked: Any) -> tuple[SimulationResult, list[float]]:
    """A run, and simulated over processor time of each of its parts; asked : further arguments of ``simulate``."""
    records: list[tuple[float, float]] = []
    result = simulate(case, progress=lambda now, *_: records.append((now, time.process_time())), **asked)
    return result, factors(records)


def factors(records: Sequence[tuple[float, float]]) -> list[float]:
    """Simulated over processor time of each of the parts of a run, by records of both [s]."""
    moments = np.array(records)[np.linspace(0, len(records) - 1, PARTS + 1).astype(int)]
    simulated, spent = np.diff(moments, axis=0).T
    return list(simulated / spent)


def last_seconds(result: SimulationResult, seconds: float) -> pd.Series:
    """Means of the history of a completed run over its last ``seconds``, under a Hann window.

    Friction does not damp the twisting of a string that rotates along its whole length, so its torque swings about the
    mean for minutes.
    """
    history = completed(result).history
    return hann_means(history[history["time_s"] > history["time_s"].max() - seconds + 1e-6])
