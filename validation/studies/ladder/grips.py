"""Rungs of contact that is no single place of bare pipe: a key seat with two places, and bow springs."""

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case
from fctd.arrays import Array
from validation.studies.ladder.in_time import completed
from validation.studies.ladder.rung import MUD, Quantity, Rung, Tables, section, steady
from validation.studies.ladder.trips import unexplained
from validation.studies.ladder.wells import HOLE, part, straight, well

TILT, REACH = 60.0, 180.0  # of the straight hole [deg], [m]
FROM, TO = 60.0, 132.0  # [m]: depths far from both ends, between which the rungs count what is lost
FRICTION, SPEED, RPM = 0.3, 0.4, 60.0  # [m/s], [rev/min]
DAMPING = {"density": MUD, "lateral_damping": 200.0, "rotational_damping": 0.05}
# Arms of the caliper, and cells along the hole [m]. Between arms the wall is a cubic, whose normals are 0.3° off the
# planes': hence a bound of 0.5 %.
ARMS, CELL = 64, 0.5
DEEP, FLAT = 45.0, 11.25  # [deg]: half of the angle between the normals of a key seat, beside arctan μ = 16.7°
EVERY = 12.0  # [m] from bow to bow, which the hole compresses
BOWS: dict[str, Any] = {"every": EVERY, "diameter": 0.25, "stiffness": 1e5, "starting_force": 300.0}


def turned(component: dict[str, Any]) -> Tables:
    """Pipe that turns off bottom in straight inclined hole."""
    turning = {"kind": "rotate_off_bottom", "at_md": REACH, "duration": 30.0, "rpm": RPM, "ramp_time": 3.0}
    return well(
        straight(REACH, TILT), [component], friction=FRICTION, mud=DAMPING,
        operations=[turning], record={"interval": 0.05}, rig={"block_weight": 2e4},
    )  # fmt: skip


def radii(angle: float) -> Array:
    """Of the arms [m]: round hole, and on its low side two planes, its tangents at an angle [deg] to both sides."""
    beside = np.abs(180.0 - 360.0 / ARMS * np.arange(ARMS))
    return np.asarray(0.5 * HOLE / np.cos(np.radians(np.maximum(angle - beside, 0.0))))


def key_seat(angle: float, cut: float) -> Tables:
    """Pipe in a key seat all along."""
    tables = turned(part(None, cut))
    rows = [[md, *radii(angle).tolist()] for md in (0.5, REACH - 0.5)]
    tables["wellbore"] |= {"geometry": "sampled", "cell": CELL, "caliper": {"rows": rows, "values": "radius"}}
    return tables


def centred(cut: float) -> Tables:
    """Pipe on bow springs, which does not touch the wall itself; ``cut`` : of its segments from bow to bow [m]."""
    pipe = {key: value for key, value in part(None, cut).items() if key != "segment_length"}
    return turned({**pipe, "centralisers": {**BOWS, "segments": round(EVERY / cut)}})


def across(case: Case) -> float:
    """Weight across the hole of the pipe between both depths [N]."""
    return float(section(case).weight * (TO - FROM) * np.sin(np.radians(TILT)))


def along(case: Case) -> float:
    """The same along the hole [N]."""
    return float(section(case).weight * (TO - FROM) * np.cos(np.radians(TILT)))


def lost(profile: pd.DataFrame, column: str) -> float:
    """How much less a load is at the lower depth than at the upper one."""
    above, below = np.interp([FROM, TO], profile["md_m"], profile[column])
    return float(above - below)


def torque_lost(kind: str, **rates: float) -> Quantity:
    """Of the steady string [N m]."""
    return lambda case: lost(steady(case, kind, **rates).profile, "torque_N_m")


def drag_lost(kind: str, **rates: float) -> Quantity:
    """Of the steady string [N]."""
    return lambda case: lost(steady(case, kind, **rates).profile, "effective_tension_N") - along(case)


def torque_in_time(case: Case) -> float:
    """At the end of a run, when the mud has damped what the start has made swing [N m]."""
    return lost(completed(case).profile, "torque_N_m")


def in_mud(case: Case) -> float:
    """Torque with which the mud holds the pipe between both depths [N m]."""
    damping = case.mud.rotational_damping
    assert damping is not None
    return float(damping * (TO - FROM) * RPM * np.pi / 30)


def friction_of(case: Case) -> float:
    """The friction factor of the hole."""
    return case.wellbore.intervals[0].friction


def arm(case: Case) -> float:
    """Contact radius of the pipe [m]."""
    return 0.5 * case.string.components[0].contact_diameter


def shares(case: Case, speed: float, rpm: float) -> tuple[float, float]:
    """Friction along and around the string over the wall force: one force opposite to the sliding."""
    turning = arm(case) * rpm * np.pi / 30
    size = np.hypot(speed, turning) / friction_of(case)
    return float(speed / size), float(turning / size)


def walls(case: Case, angle: float, around: float) -> float:
    """What both walls press with together [N], or the one that the string climbs: N, and g N across it, bear W.

    Of two, (N₁ + N₂) cos β + g (N₁ − N₂) sin β = W upwards, (N₁ + N₂) g cos β = (N₁ − N₂) sin β sideways.
    """
    beta = np.radians(angle)
    one = across(case) / np.hypot(1, around)
    return float(one / np.hypot(1, around) / np.cos(beta) if np.tan(beta) >= around else one)


def seat_torque(angle: float, case: Case) -> float:
    """g r (N₁ + N₂) of a string that turns in place, whose g is μ [N m]."""
    _, around = shares(case, 0.0, RPM)
    return around * arm(case) * walls(case, angle, around) + in_mud(case)


def seat_drag(rpm: float, case: Case) -> float:
    """f (N₁ + N₂) of a string that is pulled [N]."""
    drag, around = shares(case, SPEED, rpm)
    return drag * walls(case, DEEP, around)


def bows_of(case: Case) -> tuple[float, float, float, float]:
    """Their number between both depths, starting force [N], stiffness [N/m], and the radius R on which they slide."""
    bows = case.string.components[0].centralisers
    assert bows is not None
    assert bows.stiffness is not None
    return (TO - FROM) / bows.every, bows.starting_force, bows.stiffness, 0.5 * case.wellbore.intervals[0].diameter


def bow_torque(case: Case) -> float:
    """S R + μ F (R − F/k) of each [N m]: it climbs until F and μ F bear its load, and leans towards that place."""
    count, start, stiffness, radius = bows_of(case)
    factor = friction_of(case)
    force = across(case) / count / np.hypot(1, factor)
    return float(count * (start * radius + factor * force * (radius - force / stiffness))) + in_mud(case)


def bow_drag(case: Case) -> float:
    """S + μ W of each [N]."""
    count, start, *_ = bows_of(case)
    return count * start + friction_of(case) * across(case)


SEAT = (7.3, 6.0)  # [m]: segments, with those that end at both depths
RUNGS = [
    Rung(
        "key seat, torque", "μ r W/((1 + μ²) cos β): two normals at β to the load, and a friction across each",
        partial(key_seat, DEEP), partial(seat_torque, DEEP),
        {"steady": torque_lost("rotate_off_bottom"), "stepper": torque_in_time}, "N m", SEAT, bound=0.5,
    ),
    Rung(
        "key seat, energy that no entry explains", "none: work = energy gained + losses", partial(key_seat, DEEP),
        lambda case: 0.0, {"stepper": unexplained}, "% of the work", SEAT, bound=0.1, scale=lambda case: 100.0,
    ),
    Rung(
        "key seat that is too flat, torque", "tan β < μ: it climbs to one side, μ r W/√(1 + μ²)",
        partial(key_seat, FLAT), partial(seat_torque, FLAT),
        {"steady": torque_lost("rotate_off_bottom"), "stepper": torque_in_time}, "N m", SEAT, bound=0.2,
    ),
    Rung(
        "key seat, drag", "μ W/cos β", partial(key_seat, DEEP), partial(seat_drag, 0.0),
        {"steady": drag_lost("trip_out", speed=SPEED)}, "N", SEAT, bound=0.5,
    ),
    Rung(
        "key seat, pulled and turned: drag", "f W/((1 + g²) cos β), f and g of the sliding", partial(key_seat, DEEP),
        partial(seat_drag, RPM), {"steady": drag_lost("back_ream", speed=SPEED, rpm=RPM)}, "N", SEAT, bound=0.5,
    ),
    Rung(
        "bow springs, torque", "S R + μ F (R − F/k) of each, F = W/√(1 + μ²)", centred, bow_torque,
        {"steady": torque_lost("rotate_off_bottom"), "stepper": torque_in_time}, "N m", (4.0, 2.4), bound=0.2,
    ),
    Rung(
        "bow springs, drag", "S + μ W of each", centred, bow_drag, {"steady": drag_lost("trip_out", speed=SPEED)}, "N",
        (4.0, 2.4), bound=0.2,
    ),
]  # fmt: skip
