"""The strings that engines are compared with: the curved chain, the paper's well, and one that set no engine."""

from typing import Any

from fctd import Case
from references.engines import Window
from validation.cases import load, rotation, trip

BIT, S_BIT = 2450.0, 480.0
SPEED = 0.2  # [m/s] of the trips
LEAD = 20.0  # [s] that FCTD's stepper runs; the engines start from its state
# The 2250 m of string in the paper's well start to move over RAMP: friction that does not depend on speed does not damp
# the axial ringing of a sliding string, so the start must not excite it.
WELL_LEAD, RAMP = 44.0, 40.0
# A hole that builds to 45°, then builds and turns to 60° at 28°/100 m.
TURNING = [[0, 0, 0], [1700, 0, 0], [1900, 45, 0], [2150, 90, 60], [2600, 90, 60]]


def chain(kind: str, window: Window, **overrides: Any) -> Case:
    """The curved chain in one operation, the bit at its depth in the middle of the window."""
    if kind == "rotate_off_bottom":
        operations = rotation(BIT, window.start + window.duration + 1, ramp=4.0)
    else:
        sign = 1 if kind == "trip_in" else -1
        travel = SPEED * (window.start - 2.0 + window.duration / 2)
        operations = trip(BIT - sign * travel, BIT + sign * (SPEED * window.duration), SPEED, ramp=4.0)
    pipe = {"length": None, "segments": None, "segment_length": 25.0} if kind != "rotate_off_bottom" else {}
    changes = {f"string__components__0__{key}": value for key, value in pipe.items()}
    return load("curved_chain", operations=operations, record__interval=0.25, **changes, **overrides)


def well(segments: int, window: Window) -> Case:
    """The paper's well tripped into to 2250 m, with 60 segments or with the 170 of its Adams model."""
    counts = (20, 40) if segments == 60 else (50, 120)
    travel = SPEED * (window.start - RAMP / 2 + window.duration / 2)
    return load(
        "paper_well",
        operations=trip(2250.0 - travel, 2250.0 + SPEED * window.duration, SPEED, ramp=RAMP),
        record__interval=0.25,
        string__components__0__segments=counts[0],
        string__components__1__segments=counts[1],
    )


def s_shape(geometry: str, window: Window) -> Case:
    """A well that was not used to set any engine, in cylinders or in arcs."""
    operations = rotation(S_BIT, window.start + window.duration + 1, ramp=1.0)
    return load("s_shape", operations=operations, record__interval=0.05, wellbore__geometry=geometry)
