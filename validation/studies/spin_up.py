"""Spin-up of a string that lies in a level hole: build-up and break-off of the torque against closed forms."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd import Case, simulate
from fctd.model.operations import rad_per_s
from fctd.model.section import section_of
from validation.harness.study import Check, Context, Outcome, Study

LENGTH, RADIUS, FRICTION = 1000.0, 0.0635, 0.2  # of the string [m]; its contact radius [m]
RPM = 2.0  # so slow that inertia does not matter: ζΩ is 2 % of the torque [rev/min]
# So narrow that the pipe hardly rolls up the wall before it slides, which turns it by arctan μ (R − r)/r.
HOLE = 0.135  # [m]
PIPE = {"name": "pipe", "outer_diameter": 2 * RADIUS, "inner_diameter": 0.1086}


def level(segment: float, duration: float) -> Case:
    """A level hole, and a string in segments of one length [m] that starts to turn."""
    hole = {"to_md": LENGTH + 10, "diameter": HOLE, "friction": FRICTION}
    turning = {"kind": "rotate_off_bottom", "at_md": LENGTH, "duration": duration, "rpm": RPM, "ramp_time": 0.2}
    return Case.model_validate(
        {
            "name": "level",
            "wellbore": {"stations": [[0, 90, 0], [LENGTH + 10, 90, 0]], "intervals": [hole], "geometry": "arcs"},
            "string": {"components": [{**PIPE, "segment_length": segment}]},
            "mud": {"density": 1200.0, "lateral_damping": 50.0},
            "record": {"interval": 0.05},
            "operations": [turning],
        }
    )


def period_in(time: NDArray[np.float64], torque: NDArray[np.float64]) -> float:
    """The period [s] of the largest swing of a torque about its line of trend, in equal intervals of time."""
    swing = torque - np.polyval(np.polyfit(time, torque, 1), time)
    padded = 64 * len(swing)
    spectrum = np.abs(np.fft.rfft(swing * np.hanning(len(swing)), padded))
    return float(padded * (time[1] - time[0]) / int(spectrum.argmax()))


def run(context: Context) -> Outcome:
    """The torque at the top over time, and √(2 m GJ Ω t) up to m L."""
    case = level(10.0, 20.0 if context.quick else 40.0)
    history = simulate(case).history
    pipe = section_of(case.string.components[0], 1200.0)
    # A string that slides round climbs the wall by arctan μ, and presses less on it.
    per_metre = FRICTION * pipe.weight * RADIUS / np.sqrt(1 + FRICTION**2)
    time, torque = history["time_s"].to_numpy(float), history["surface_torque_N_m"].to_numpy(float)
    angle = rad_per_s(RPM) * np.maximum(time - 0.1 - 0.025, 0.0)  # of the top, in the middle of a record
    built = np.minimum(np.sqrt(2 * per_metre * pipe.GJ * angle), per_metre * LENGTH)
    broken = per_metre * LENGTH**2 / (2 * pipe.GJ * rad_per_s(RPM))
    rising = (time > 0.2 * broken) & (time < 0.9 * broken)
    period = 4 * LENGTH * np.sqrt(pipe.axial_inertia / pipe.GJ)
    late = (time > broken) & (time <= broken + 4 * period)
    swings = (time > broken) & (time <= broken + 8 * period)
    table = pd.DataFrame({"time_s": time, "torque_kN_m": torque / 1e3, "closed_form_kN_m": built / 1e3})
    found = np.interp(0.9 * per_metre * LENGTH, torque[: int(np.argmax(torque))], time[: int(np.argmax(torque))])
    return Outcome(
        tables={"torque": table},
        checks=[
            Check("break-off torque against μ w r L/√(1 + μ²)",
                  100 * abs(float(torque[late].mean()) / (per_metre * LENGTH) - 1), 1.0, "at_most", "%",
                  "closed form; target of this project; mean over four periods after it"),
            Check("torque while it builds up against √(2 m GJ Ω t), largest difference over the break-off torque",
                  100 * float(np.abs(torque - built)[rising].max()) / (per_metre * LENGTH), 5.0, "at_most", "%",
                  "closed form without inertia, after Aarsnes & Shor 2018; waves of ζΩ are 2 %"),
            Check("time to nine tenths of the break-off torque against m L²/(2 GJ Ω)",
                  100 * abs((found - 0.125) / (0.81 * broken) - 1), 5.0, "at_most", "%", "closed form without inertia"),
            Check("period of the swing after break-off against 4 L √(ρ/G)",
                  100 * abs(period_in(time[swings], torque[swings]) / period - 1), 0.5, "at_most", "%",
                  "friction of a string that slides everywhere is constant; of eight periods"),
        ],
        notes=[
            "The clamp at the top bears half of the first segment, so that half a segment of friction is missing.",
            "After break-off the mean torque rises further, by 0.8 % in half a minute; the study does not say why.",
        ],
        display={"torque": "Torque at the top of a string that starts to turn"},
    )  # fmt: skip


STUDY = Study("spin_up", "How does the torque of a string build up when it starts to turn?", run)
