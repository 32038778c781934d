"""What the stepper says: means over whole periods of a moving string, and tones of one that swings freely."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case, SimulationResult, simulate
from fctd.arrays import Array
from fctd.mechanics.moving_string import STILL
from fctd.results.status import RunStatus
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from validation.studies.ladder.rung import GRAVITY, By, NoAnswerError, Quantity, case_of, section, steady

Reading = Callable[[Run], float]


def completed(case: Case) -> SimulationResult:
    """The run of a case; NoAnswerError for one that did not complete."""
    result = simulate(case)
    if result.status != RunStatus.COMPLETED:
        raise NoAnswerError(f"{result.status}: {result.message}")
    return result


class Ending(NamedTuple):
    """The last operation of a run: hook load of the string below the table [N], and torque [N m]."""

    hookload: float
    torque: float


def at_the_end(case: Case) -> Ending:
    """Means over the last whole periods within the later half of the last operation's steady part.

    By then friction acts everywhere.  Pipe above the table is weighed in air and left out.
    """
    result = completed(case)
    last, history, ramp = result.operations.iloc[-1], result.history, case.operations[-1].ramp_time
    time = history["time_s"].to_numpy(float)
    if "block_position_m" in history:
        in_air = section(case, len(case.string.components) - 1).mass * GRAVITY * np.cos(case.wellbore.trajectory[0, 1])
        hook = history["hookload_N"] - in_air * history["block_position_m"]
    else:
        hook = history["hookload_N"]
    end = float(last["end_s"]) - (ramp if last["end_s"] - last["start_s"] > 2 * ramp else 0.0)
    longest = 0.5 * (end - float(last["start_s"]) - ramp)

    def mean(values: Array, period: float) -> float:
        start = end - max(int(longest / period), 1) * period
        impulse = np.append(0.0, np.cumsum(values * np.diff(time, prepend=0.0)))
        first, final = np.interp([start, end], np.append(0.0, time), impulse)
        return float((final - first) / (end - start))

    return Ending(
        mean(hook.to_numpy(float), float(last["hookload_period_s"])),
        mean(history["surface_torque_N_m"].to_numpy(float), float(last["surface_torque_period_s"])),
    )


def at_rest(case: Case, depth: float | None = None) -> pd.DataFrame:
    """The profile of a string that has come to rest with its bit at a depth [m], by default the end of its hole."""
    still = {"kind": "rotate_off_bottom", "duration": 0.2, "rpm": 1e-3, "ramp_time": 0.1}
    bit = case.depths[1] if depth is None else depth
    keys = {"operations": [{**still, "at_md": bit}], "record.interval": 0.2, "rig.feed": None}
    profile: pd.DataFrame = completed(case_of(case.model_dump(exclude_defaults=True), keys)).profile
    return profile


def by_both(read: Callable[[Case, pd.DataFrame], float], kind: str, depth: float | None = None) -> dict[By, Quantity]:
    """What both solvers' profiles say of a string: that of an operation, and the one at rest."""
    return {
        "steady": lambda case: read(case, steady(case, kind, depth).profile),
        "stepper": lambda case: read(case, at_rest(case, depth)),
    }


def moved(kind: str, around: float, by: float, speed: float, **keys: Any) -> list[dict[str, Any]]:
    """A schedule: the bit moves by a distance [m] up or down, and is at the depth ``around`` [m] half way."""
    sign = 1.0 if kind == "trip_in" else -1.0
    ends = {"from_md": around - 0.5 * sign * by, "to_md": around + 0.5 * sign * by}
    return [{"kind": kind, **ends, "speed": speed, **keys}]


def ringing(case: Case, kick: Callable[[Run], None], read: Reading, duration: float, sample: float) -> Array:
    """Readings (m,) every ``sample`` seconds of a string that swings by itself, after a kick."""
    run, _ = prepare(case)
    kick(run)
    run.refresh()
    still = STILL._replace(drive=run.drive)
    found = np.empty(round(duration / sample))
    for k in range(len(found)):
        run.advance(still, sample)
        found[k] = read(run)
    return found


def tone(readings: Array, sample: float, near: float) -> float:
    """Frequency [rad/s] within a tenth of ``near`` whose sine fits readings best, under a Hann window."""
    time = sample * np.arange(len(readings))
    seen = (readings - readings.mean()) * np.hanning(len(readings))
    trial = near * np.linspace(0.9, 1.1, 4001)
    power = np.abs(np.exp(-1j * trial[:, None] * time) @ seen)
    k = int(power.argmax())
    if not 0 < k < len(trial) - 1:
        raise NoAnswerError(f"no tone within a tenth of {near:.4g} rad/s")
    before, here, after = power[k - 1 : k + 2]
    return float(trial[k] + 0.5 * (trial[1] - trial[0]) * (before - after) / (before - 2 * here + after))
