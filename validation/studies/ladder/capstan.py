"""Rungs of the capstan: pipe without weight that is pulled and turned through a bend.

All friction is one force opposite to the sliding, so that rotation takes from the drag what it gives to the torque.
With two factors, along and around the hole, it is the force of the ellipse that takes most energy.
"""

from functools import partial
from typing import Any

import numpy as np

from fctd import Case
from references.soft_string.directions import Components, associated
from validation.studies.ladder.in_time import at_the_end
from validation.studies.ladder.rung import MUD, Rung, Tables, section, steady
from validation.studies.ladder.wells import HOLE, bend, part, well

RADIUS, ANGLE = 300.0, 55.0  # of the bend [m], [deg]
HANGING, ABOVE, DEEPER = 60.0, 40.0, 2.0  # collars, inclined hole above the bend, free hole above and below them [m]
SPEED, RPM = 0.1, 15.0  # [m/s], [rev/min]
DEPTH = ABOVE + RADIUS * np.radians(ANGLE) + DEEPER + HANGING
MEETING = RADIUS * np.radians(ANGLE) / 48  # [m]: joints at both ends of the bend
SOFT: dict[str, Any] = {"bending_stiffness": 1e5, "contact_diameter": HOLE - 2e-4}


# Nearly a wire: what bends at the ends of the bend presses on the wall too, with a share that grows in short segments.
WIRE: dict[str, Any] = {"bending_stiffness": 1e3, "contact_diameter": HOLE - 2e-5}
PAIR, OTHER = (0.4, 0.2), (0.2, 0.4)  # factors along and around the hole


def tables(cut: float, factors: tuple[float, float] = (0.3, 0.3), pipe: dict[str, Any] = SOFT) -> Tables:
    """Pipe that the mud carries over a drop to vertical, pulled by collars that hang below it.

    Pipe without clearance and nearly without bending stiffness is a soft string.  The damping keeps such pipe from
    chattering between its walls, and changes no steady load.
    """
    collar = {"name": "collar", "outer_diameter": 0.165, "inner_diameter": 0.0714, "length": HANGING}
    light = part(None, cut, density=MUD * (1 + 1e-6), linear_mass=27.0, **pipe)
    back = {"kind": "back_ream", "from_md": DEPTH + 1.0, "to_md": DEPTH - 1.0, "speed": SPEED, "rpm": RPM}
    made = well(
        bend(ABOVE, RADIUS, HANGING + 2 * DEEPER, ANGLE, 0.0), [{**collar, "segment_length": cut}, light],
        friction=factors[0], operations=[{**back, "ramp_time": 2.0}], record={"interval": 0.05},
        mud={"density": MUD, "lateral_damping": 1e3},
    )  # fmt: skip
    if factors[0] != factors[1]:
        made["wellbore"]["intervals"][0]["rotational_friction"] = factors[1]
    return made


def shares(case: Case) -> tuple[float, float]:
    """Of the sliding along and around the hole, f_a and f_r."""
    about = 0.5 * case.string.components[1].contact_diameter * RPM * np.pi / 30
    return SPEED / np.hypot(SPEED, about), about / np.hypot(SPEED, about)


def friction(case: Case) -> Components:
    """Along and around the hole, over the wall force: one direction all along the string."""
    hole = case.wellbore.intervals[0]
    return associated(hole.friction, hole.friction_around, *shares(case))


def drag(case: Case) -> float:
    """[N]: the wall bears N with N² + (f_r N)² = (T dθ)², so that dT = f_a T dθ/√(1 + f_r²)."""
    along, about = friction(case)
    return float(section(case, 0).weight * HANGING * np.expm1(along * np.radians(ANGLE) / np.hypot(1, about)))


def torque(case: Case) -> float:
    """[N m]."""
    along, about = friction(case)
    return 0.5 * case.string.components[1].contact_diameter * about / along * drag(case)


def hanging(case: Case) -> float:
    """What the hook bears without friction [N]: in the bend and above it pipe weighs nothing."""
    return section(case, 0).weight * HANGING


RUNGS = [
    Rung(
        "capstan that turns, drag", "T₀ (exp(μ f_a θ/√(1 + μ² f_r²)) − 1), f_a and f_r of the sliding (Johancsik's "
        "string with Coulomb's one force)", tables, drag,
        {
            "steady": lambda case: steady(case, "back_ream", DEPTH).hookload - hanging(case),
            "stepper": lambda case: at_the_end(case).hookload - hanging(case),
        },
        "N", (7.3, MEETING),
    ),
    Rung(
        "capstan that turns, torque", "r f_r/f_a times its drag: one force along and around", tables, torque,
        {
            "steady": lambda case: steady(case, "back_ream", DEPTH).surface_torque,
            "stepper": lambda case: at_the_end(case).torque,
        },
        "N m", (7.3, MEETING),
    ),
    Rung(
        "capstan with two factors, drag", "T₀ (exp(f_a θ/√(1 + f_r²)) − 1), f_a = μ_a² V/√(μ_a² V² + μ_r² r²Ω²) and "
        "f_r alike", partial(tables, factors=PAIR), drag,
        {
            "steady": lambda case: steady(case, "back_ream", DEPTH).hookload - hanging(case),
            "stepper": lambda case: at_the_end(case).hookload - hanging(case),
        },
        "N", (7.3, MEETING),
    ),
    Rung(
        "capstan with two factors, torque", "r f_r/f_a times its drag", partial(tables, factors=PAIR), torque,
        {
            "steady": lambda case: steady(case, "back_ream", DEPTH).surface_torque,
            "stepper": lambda case: at_the_end(case).torque,
        },
        "N m", (7.3, MEETING),
    ),
    # Wanted: 0.3 %, falling with the square of the segment.  The chord of a bend turns by half of its angle against the
    # hole at its lower end, where it touches, which is an error of first order (docs/theory.md).
    Rung(
        "wire with two factors, drag", "the same", partial(tables, factors=PAIR, pipe=WIRE), drag,
        {"steady": lambda case: steady(case, "back_ream", DEPTH).hookload - hanging(case)},
        "N", (7.3, MEETING), bound=0.3,
    ),
    Rung(
        "wire with two factors, torque", "the same", partial(tables, factors=PAIR, pipe=WIRE), torque,
        {"steady": lambda case: steady(case, "back_ream", DEPTH).surface_torque}, "N m", (7.3, MEETING), bound=0.3,
        refined=(2 * MEETING, MEETING, 0.5 * MEETING), order=(1.8, 2.2),
    ),
    Rung(
        "wire with more friction around, drag", "the same", partial(tables, factors=OTHER, pipe=WIRE), drag,
        {"steady": lambda case: steady(case, "back_ream", DEPTH).hookload - hanging(case)}, "N", (7.3, MEETING),
        bound=0.3, refined=(2 * MEETING, MEETING, 0.5 * MEETING), order=(1.8, 2.2),
    ),
    Rung(
        "wire with more friction around, torque", "the same", partial(tables, factors=OTHER, pipe=WIRE), torque,
        {"steady": lambda case: steady(case, "back_ream", DEPTH).surface_torque}, "N m", (7.3, MEETING), bound=0.3,
    ),
]  # fmt: skip
