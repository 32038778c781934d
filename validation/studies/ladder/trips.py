"""Rungs of trips: a slow pull in time against the steady string, and the energy of a trip that ends where it began."""

from functools import partial
from typing import Any

from fctd import Case
from validation.studies.ladder.in_time import at_the_end, completed, moved
from validation.studies.ladder.rung import Rung, Tables, case_of, steady
from validation.studies.ladder.wells import Stations, part, well

# A build and a turn, of 5°/30 m and 4°/30 m, with straight hole between them.
PULLED: Stations = [[0, 0, 0], [60, 0, 0], [420, 60, 0], [480, 60, 0], [780, 60, 46], [900, 60, 46]]
DEPTH = 853.0  # [m]: no stand ends here
SPEEDS = {0.003: 0.15, 0.01: 0.25, 0.05: 0.8, 0.3: 3.0}  # [m/s]: distance pulled [m], beyond what mobilises friction
SEGMENTS = (5.0, 10.0, 20.0)  # [m]
# A build of 10°/30 m and a turn of 9°/30 m; depths between which the bit goes to and fro [m], its speed [m/s].
SHARP: Stations = [[0, 0, 0], [60, 0, 0], [330, 90, 0], [460, 90, 40]]
ENDS, SPEED = (430.0, 437.0), 0.4


def pulled(speed: float, cut: float) -> Tables:
    """5 in pipe that is pulled at a speed out of a hole with a build and a turn."""
    up = moved("trip_out", DEPTH, SPEEDS[speed], speed, ramp_time=2.0)
    return well(PULLED, [part(None, cut)], friction=0.25, operations=up, record={"interval": 0.1})


def free(case: Case) -> float:
    """Hook load without friction [N]."""
    frictionless = case_of(case.model_dump(exclude_defaults=True), {"wellbore.intervals[0].friction": 0.0})
    return steady(frictionless, "trip_out", DEPTH).hookload


def steady_drag(case: Case) -> float:
    """Drag of the steady string [N]."""
    return steady(case, "trip_out", DEPTH).hookload - free(case)


def drag_in_time(case: Case) -> float:
    """Mean drag of the last whole axial periods [N]."""
    return at_the_end(case).hookload - free(case)


def closed(geometry: str, cut: float) -> Tables:
    """Pipe that is lowered and pulled back in a hole with a sharp build and a turn, of arcs or of cylinders."""
    up, down = ENDS
    ends: list[dict[str, Any]] = [
        {"kind": "trip_in", "from_md": up, "to_md": down},
        {"kind": "trip_out", "from_md": down, "to_md": up},
    ]
    schedule = [{**end, "speed": SPEED, "ramp_time": 2.0} for end in ends]
    tables = well(SHARP, [part(None, cut)], friction=0.25, operations=schedule, record={"interval": 0.2})
    tables["wellbore"]["geometry"] = geometry
    return tables


def unexplained(case: Case) -> float:
    """Largest residual of the ledger over the work [%]."""
    return 100 * float(completed(case).run["energy_error"])


RUNGS = [
    Rung(
        f"pull at {1e3 * speed:g} mm/s, drag, segments of {cut:g} m", "the steady string of the same segments",
        partial(pulled, speed), steady_drag, {"stepper": drag_in_time}, "N", (cut + 0.3, cut),
        long=speed < 0.05 and cut < 10,
    )
    for speed in SPEEDS
    for cut in SEGMENTS
] + [
    Rung(
        f"closed trip, energy that no entry explains, {geometry}", "none: work = energy gained + losses",
        partial(closed, geometry), lambda case: 0.0, {"stepper": unexplained}, "% of the work", (7.3, 5.0), bound=0.1,
        scale=lambda case: 100.0,
    )
    for geometry in ("arcs", "cylinders")
]  # fmt: skip
