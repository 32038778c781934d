"""Reading a steady state off the end of a simulation."""

import numpy as np
import pandas as pd

from fctd import SimulationResult


def last_seconds(result: SimulationResult, seconds: float) -> pd.Series:
    """Means of the history over its last ``seconds``, weighted by a Hann window.

    Friction does not damp the twisting of a string that turns all along, so its torque swings about the mean
    for minutes.  A plain mean keeps a share of the swing; the window leaves none.  Raises RuntimeError for a
    run that did not complete.
    """
    if result.status != "completed":
        raise RuntimeError(f"{result.case.name}: {result.status}, {result.message}")
    history = result.history.select_dtypes("number")
    late = history[history["time_s"] > history["time_s"].max() - seconds + 1e-6]
    weights = np.hanning(len(late) + 2)[1:-1]
    return pd.Series(late.mul(weights, axis=0).sum() / weights.sum())
