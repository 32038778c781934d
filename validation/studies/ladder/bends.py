"""Rungs of bends with weight and of a straight incline: drag and torque against the soft string's exact answers."""

from functools import partial
from typing import Any

import numpy as np

from fctd import Case
from references.soft_string.closed_forms import Loads, bend_in_parts, hold, side_turn, sum_up, vertical
from references.soft_string.sliding import Motion, split_friction
from validation.studies.ladder.in_time import at_the_end, moved
from validation.studies.ladder.rung import MUD, Rung, Tables, section, steady
from validation.studies.ladder.wells import HOLE, Stations, bend, part, straight, well

RADIUS, QUARTER = 300.0, 0.5 * np.pi  # of the build [m], its angle [rad]
ABOVE, LEVEL, DEEPER = 20.0, 60.0, 3.0  # vertical and level hole [m], and hole beyond the bit
DEPTH = ABOVE + RADIUS * QUARTER + LEVEL
MEETING = RADIUS * QUARTER / 72  # [m]: joints at both ends of the bend
SPEED = 0.1  # [m/s]
# Pipe without clearance and nearly without bending stiffness is a soft string; damping across the hole keeps such pipe
# from chattering between its walls in time, and changes no steady load.
SOFT: dict[str, Any] = {"bending_stiffness": 1e5, "contact_diameter": HOLE - 2e-4}
DAMPED: dict[str, Any] = {"density": MUD, "lateral_damping": 1e3}

TILT, INCLINE, MIXED = 60.0, 610.0, 20.0  # of the straight hole [deg], [m]; rotation there [rev/min]
TANGENT, FIRST, LAST = 400.0, 20.0, 60.0  # of the catenary: wa/w [m], inclinations at its ends [deg]


def radius_of(case: Case) -> float:
    """Contact radius of the string [m]."""
    return 0.5 * case.string.components[-1].contact_diameter


def friction_of(case: Case) -> float:
    """The friction factor of the hole."""
    return case.wellbore.intervals[0].friction


def build(kind: str, cut: float) -> Tables:
    """A build of 90° between some vertical and some level hole, and what the string does in time."""
    turning = [{"kind": kind, "at_md": DEPTH, "duration": 40.0, "rpm": 20.0, "ramp_time": 5.0}]
    schedule = turning if kind == "rotate_off_bottom" else moved(kind, DEPTH, 2.0, SPEED, ramp_time=2.0)
    return well(
        bend(ABOVE, RADIUS, LEVEL + DEEPER, 0.0, 90.0), [part(None, cut, **SOFT)], friction=0.25, mud=DAMPED,
        operations=schedule, record={"interval": 0.05},
    )  # fmt: skip


def build_loads(case: Case, motion: Motion) -> Loads:
    """By Aadnøy's bend, in parts where the contact changes side."""
    weight = section(case).weight
    parts = [
        partial(hold, weight=weight, length=LEVEL, inclination=QUARTER),
        partial(bend_in_parts, weight=weight, radius=RADIUS, inclination_below=QUARTER, inclination_above=0.0),
        partial(vertical, weight=weight, length=ABOVE),
    ]
    return sum_up(parts, split_friction("coulomb", friction_of(case), motion, radius_of(case)), radius_of(case))


def free(case: Case) -> float:
    """Hook load of the build without friction [N]."""
    return section(case).weight * (RADIUS + ABOVE)


def hoisting(case: Case) -> float:
    """Drag [N]."""
    return build_loads(case, Motion(1.0, 1.0, 0.0)).hookload - free(case)


def lowering(case: Case) -> float:
    """Drag [N]."""
    return free(case) - build_loads(case, Motion(-1.0, 1.0, 0.0)).hookload


def turning_torque(case: Case) -> float:
    """Torque [N m]: ∫|1 − 2 sin I| dI from 0 to 90° is 0.9405."""
    length = LEVEL + (2 * np.sqrt(3) - 2 - np.pi / 6) * RADIUS
    return float(friction_of(case) * section(case).weight * radius_of(case) * length / np.hypot(1, friction_of(case)))


def incline(cut: float) -> Tables:
    """Pipe that is pulled and turned in straight hole."""
    back = moved("back_ream", INCLINE, 2.0, SPEED, rpm=MIXED, ramp_time=2.0)
    stations = straight(INCLINE + DEEPER, TILT)
    return well(
        stations, [part(None, cut, **SOFT)], friction=0.3, mud=DAMPED, operations=back, record={"interval": 0.05}
    )


def incline_loads(case: Case) -> Loads:
    """By the straight section of the soft string."""
    spin = MIXED * np.pi / 30
    friction = split_friction("coulomb", friction_of(case), Motion(1.0, SPEED, spin), radius_of(case))
    slope = partial(hold, weight=section(case).weight, length=INCLINE, inclination=np.radians(TILT))
    return sum_up([slope], friction, radius_of(case))


def incline_free(case: Case) -> float:
    """Hook load of the incline without friction [N]."""
    return float(section(case).weight * INCLINE * np.cos(np.radians(TILT)))


def tail(case: Case) -> float:
    """Straight hole [m] below the catenary whose string pulls, as it is picked up, with wa/sin α at its end."""
    end = np.radians(LAST)
    return float(TANGENT / np.sin(end) / (np.cos(end) + friction_of(case) * np.sin(end)))


def catenary(cut: float) -> Tables:
    """A catenary of short arcs between two straight holes: pipe that is picked up hangs in it without a wall."""
    left = TANGENT / np.tan(np.radians([FIRST, LAST]))
    lowest = np.linspace(left[0], left[1], 61)
    angle = np.degrees(np.arctan2(TANGENT, lowest))
    curve = [[10.0 + float(left[0] - s), float(a), 0.0] for s, a in zip(lowest, angle, strict=True)]
    end = np.radians(LAST)
    below = TANGENT / np.sin(end) / (np.cos(end) + 0.3 * np.sin(end))
    stations: Stations = [[0.0, FIRST, 0.0], *curve, [curve[-1][0] + float(below), LAST, 0.0]]
    return well(stations, [part(None, cut, bending_stiffness=1e5)], friction=0.3)


def catenary_pull(case: Case) -> float:
    """Hook load [N]: wa/sin α at the upper end, and the straight hole above it."""
    first, weight = np.radians(FIRST), section(case).weight
    return float(weight * (TANGENT / np.sin(first) + 10.0 * (np.cos(first) + friction_of(case) * np.sin(first))))


def catenary_walls(case: Case) -> float:
    """Wall force on the catenary [N], of which there is none."""
    profile = steady(case, "trip_out").profile
    bottom = case.depths[1] - tail(case)
    return float(profile.loc[profile["md_m"].between(30.0, bottom - 30.0), "contact_force_N"].sum())


def turn(cut: float) -> Tables:
    """A level turn of 105° with hardly any clearance."""
    stations = [[0.0, 90.0, 330.0], [30.0, 90.0, 330.0], [530.0, 90.0, 75.0], [590.0, 90.0, 75.0]]
    return well(stations, [part(None, cut, bending_stiffness=1e5, contact_diameter=HOLE - 2e-5)], friction=0.25)


def turn_drag(case: Case) -> float:
    """Drag of a string that is picked up [N]; level hole, so that the hook load is all drag."""
    weight, level = section(case).weight, partial(hold, inclination=QUARTER)
    angle = np.radians(105.0)
    parts = [
        partial(level, weight=weight, length=60.0),
        partial(side_turn, weight=weight, radius=500.0 / angle, turn=angle),
        partial(level, weight=weight, length=30.0),
    ]
    friction = split_friction("coulomb", friction_of(case), Motion(1.0, 1.0, 0.0), radius_of(case))
    return sum_up(parts, friction, radius_of(case)).hookload


RUNGS = [
    Rung(
        "bend with weight, hoisting", "Aadnøy & Andersen 2001: T = C e^(−μα) + a cos α + b sin α",
        partial(build, "trip_out"), hoisting,
        {
            "steady": lambda case: steady(case, "trip_out", DEPTH).hookload - free(case),
            "stepper": lambda case: at_the_end(case).hookload - free(case),
        },
        "N", (7.3, MEETING), bound=0.8, refined=(13.0, 6.5, 3.25), order=(0.7, 1.3),
    ),
    Rung(
        "bend with weight, lowering", "the same with −μ, in parts where the contact changes side",
        partial(build, "trip_in"), lowering,
        {
            "steady": lambda case: free(case) - steady(case, "trip_in", DEPTH).hookload,
            "stepper": lambda case: free(case) - at_the_end(case).hookload,
        },
        "N", (7.3, MEETING),
    ),
    Rung(
        "torque in a bend with weight", "r μ w (L + 0.9405 R)/√(1 + μ²); the contact changes side at 30°",
        partial(build, "rotate_off_bottom"), turning_torque,
        {
            "steady": lambda case: steady(case, "rotate_off_bottom", DEPTH).surface_torque,
            "stepper": lambda case: at_the_end(case).torque,
        },
        "N m", (7.3, MEETING), bound=0.8, refined=(13.0, 6.5, 3.25), order=(0.7, 1.3),
    ),
    Rung(
        "incline, pulled and turned: drag", "μ f_a w L sin α/√(1 + μ² f_r²)", incline,
        lambda case: incline_loads(case).hookload - incline_free(case),
        {
            "steady": lambda case: steady(case, "back_ream", INCLINE).hookload - incline_free(case),
            "stepper": lambda case: at_the_end(case).hookload - incline_free(case),
        },
        "N", (7.3, 5.0), refined=(16.0, 8.0, 4.0), order=(0.8, 1.2),
    ),
    Rung(
        "incline, pulled and turned: torque", "r μ f_r w L sin α/√(1 + μ² f_r²)", incline,
        lambda case: incline_loads(case).surface_torque,
        {
            "steady": lambda case: steady(case, "back_ream", INCLINE).surface_torque,
            "stepper": lambda case: at_the_end(case).torque,
        },
        "N m", (7.3, 5.0),
    ),
    Rung(
        "catenary, hook load", "T = wa/sin α, no wall force", catenary, catenary_pull,
        {"steady": lambda case: steady(case, "trip_out").hookload}, "N", (7.3, 5.0), bound=0.2,
    ),
    Rung(
        "catenary, wall force over the pull", "none: q = T/R − w sin α = 0", catenary, lambda case: 0.0,
        {"steady": catenary_walls}, "N", (7.3, 5.0), bound=0.5, scale=catenary_pull,
    ),
    Rung(
        "level turn without clearance", "T = wR sinh(asinh(T₀/wR) + μφ)", turn, turn_drag,
        {"steady": lambda case: steady(case, "trip_out").hookload}, "N", (7.3, 5.0),
    ),
]  # fmt: skip
