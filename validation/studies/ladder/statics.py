"""Rungs of a string at rest: stretch, true tension, penetration, deep beam, heavy elastica, loads at the bit."""

from functools import partial

import numpy as np
import pandas as pd
from scipy.integrate import solve_bvp

from fctd import Case
from fctd.arrays import Array
from validation.studies.ladder.in_time import by_both
from validation.studies.ladder.rung import GRAVITY, MUD, Rung, Tables, section, steady
from validation.studies.ladder.wells import HOLE, part, straight, well

HUNG = 3000.0  # [m] of vertical hole
LYING = 120.0  # [m] of level hole
AIR = {"density": 0.0}
HELD = 30.0  # [m] of heavy pipe that is held level at its upper end, and bends in the air
TILTED, TILT = 400.0, 45.0  # [m], [deg] of the hole that is drilled


def hung(mud: float, cut: float) -> Tables:
    """Pipe that hangs free in a vertical hole."""
    return well(straight(HUNG + 10.0, 0.0), [part(None, cut)], mud={"density": mud})


def longer(case: Case, profile: pd.DataFrame) -> float:
    """How much longer the string is than without load [m], by the place of its bit."""
    return float(profile["md_m"].iloc[-1]) - HUNG


def stretch(case: Case) -> float:
    """wL²/2EA − (1 − 2ν) ∫p/E: pressure around a pipe shortens it [m] (Lubinski, Althouse & Logan 1962)."""
    pipe, component = section(case), case.string.components[0]
    pressed = (1 - 2 * component.poisson_ratio) * case.mud.density * GRAVITY * HUNG**2 / (2 * component.youngs_modulus)
    return pipe.weight * HUNG**2 / (2 * pipe.EA) - pressed


def at_the_end(case: Case, profile: pd.DataFrame) -> float:
    """True tension of the lower end [N]."""
    return float(profile["true_tension_N"].iloc[-1])


def pressure_area(case: Case) -> float:
    """−p A: the mud presses on the free end [N]."""
    return -case.mud.density * GRAVITY * HUNG * section(case).steel


def lying(cut: float) -> Tables:
    """Pipe that lies in a level hole with a soft wall."""
    return well(straight(LYING, 90.0), [part(None, cut)], wall={"stiffness_per_length": 1e5})


def sunk(case: Case, profile: pd.DataFrame) -> float:
    """Depth of the pipe in its wall in the middle [m]."""
    offset = np.hypot(profile["offset_high_m"], profile["offset_right_m"]) - profile["clearance_m"]
    return float(offset[profile["md_m"].between(0.3 * LYING, 0.7 * LYING)].mean())


def sinking(case: Case) -> float:
    """w/k [m]."""
    stiffness = case.wellbore.stiffness_per_length
    assert stiffness is not None
    return section(case).weight / stiffness


def deep(cut: float) -> Tables:
    """A short deep beam that is held level, whose shear gives four fifths of its deflection."""
    beam = part(None, cut, bending_stiffness=2e7, shear_stiffness=1e6)
    return well(straight(4.5, 90.0), [beam], contact={"enabled": False}, mud=AIR)


def drop(case: Case, profile: pd.DataFrame) -> float:
    """How far the lower end of a string that is held level lies below its upper end [m]."""
    return -float(profile["offset_high_m"].iloc[-1])


def deep_drop(case: Case) -> float:
    """wL⁴/8EI + wL²/2κGA [m]."""
    beam, length = section(case), case.depths[1]
    return beam.weight * length**2 * (length**2 / (8 * beam.EI) + 1 / (2 * beam.shear))


def heavy(load: float, cut: float) -> Tables:
    """Pipe held level whose weight a metre times L³/EI is ``load``."""
    mass = load * 1.2e6 / HELD**3 / GRAVITY
    pipe = part(None, cut, bending_stiffness=1.2e6, linear_mass=mass)
    return well(straight(HELD, 90.0), [pipe], contact={"enabled": False}, mud=AIR)


def elastica(load: float) -> tuple[float, float]:
    """Drop of the lower end over the length, and moment at the upper end over EI/L, for wL³/EI = load.

    EIθ'' = −w(L − s) cos θ, held level above and free below, by a boundary value problem whose load grows.
    """

    def ends(upper: Array, lower: Array) -> Array:
        return np.array([upper[0], lower[1], upper[2]])

    s, found = np.linspace(0, 1, 41), np.zeros((3, 41))
    for part_of_it in np.linspace(0.1, 1.0, 10) * load:

        def slopes(s: Array, y: Array, load: float = float(part_of_it)) -> Array:
            return np.stack([y[1], -load * (1 - s) * np.cos(y[0]), np.sin(y[0])])

        solved = solve_bvp(slopes, ends, s, found, tol=1e-8)
        s, found = solved.x, solved.y
    return float(abs(found[2, -1])), float(abs(found[1, 0]))


def elastica_drop(case: Case) -> float:
    """Drop of the lower end [m]."""
    pipe = section(case)
    return HELD * elastica(pipe.weight * HELD**3 / pipe.EI)[0]


def drilled(cut: float) -> Tables:
    """Pipe that drills in an incline with weight and torque at the bit."""
    pipe = part(None, cut, contact_diameter=HOLE - 2e-4)
    return well(
        straight(TILTED, TILT), [pipe], friction=0.2, bit={"weight_on_bit": 2e4, "torque": 6e3},
        rig={"block_weight": 1e6},
    )  # fmt: skip


def drilling_torque(case: Case) -> float:
    """M + r μ w L sin α/√(1 + μ²) [N m], as a string that hardly moves along the hole."""
    factor, bore = case.wellbore.intervals[0].friction, 0.5 * case.string.components[0].contact_diameter
    lying = section(case).weight * TILTED * np.sin(np.radians(TILT))
    return float(case.bit.torque + bore * factor * lying / np.hypot(1, factor))


RUNGS = [
    Rung(
        "stretch in air", "wL²/2EA", partial(hung, 0.0), stretch, by_both(longer, "rotate_off_bottom", HUNG), "m",
        (73.0, 50.0), bound=0.5,
    ),
    Rung(
        "stretch in mud of 1.4 sg", "wL²/2EA − (1 − 2ν)∫p/E (Lubinski, Althouse & Logan 1962)", partial(hung, 1400.0),
        stretch, by_both(longer, "rotate_off_bottom", HUNG), "m", (73.0, 50.0),
    ),
    Rung(
        "stretch in mud of 2.0 sg", "the same", partial(hung, 2000.0), stretch,
        by_both(longer, "rotate_off_bottom", HUNG), "m", (73.0, 50.0),
    ),
    Rung(
        "true tension of a free end", "−p A", partial(hung, MUD), pressure_area,
        by_both(at_the_end, "rotate_off_bottom", HUNG), "N", (73.0, 50.0), bound=0.1,
    ),
    Rung("penetration of the wall", "w/k", lying, sinking, by_both(sunk, "trip_out"), "m", (7.3, 5.0), bound=0.5),
    Rung(
        "deep beam", "wL⁴/8EI + wL²/2κGA (Timoshenko)", deep, deep_drop, by_both(drop, "trip_out"), "m", (0.37, 0.25),
        bound=0.5, refined=(0.9, 0.45, 0.225), order=(1.7, 2.3),
    ),
    *(
        Rung(
            f"heavy elastica, wL³/EI = {load:g}", "EIθ'' = −w(L − s) cos θ", partial(heavy, load), elastica_drop,
            by_both(drop, "trip_out"), "m", (1.1, 0.75), refined=(3.0, 1.5, 0.75), order=(1.7, 2.3), long=load == 2,
        )
        for load in (0.1, 2.0, 20.0)
    ),
    Rung(
        "torque while drilling an incline", "M + r μ w L sin α/√(1 + μ²)", drilled, drilling_torque,
        {"steady": lambda case: steady(case, "drill_rotating").surface_torque}, "N m", (7.3, 5.0), bound=0.4,
    ),
]  # fmt: skip
