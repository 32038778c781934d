"""Rungs of the helix: pitch, wall force and shortening, its friction and lock-up, level hole, and torque at the bit.

Where the ends of a helix are another shape than its middle it is measured in the middle, or by the difference of two
weights on bit.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import quad
from scipy.optimize import brentq

from fctd import Case
from references.buckling import helix
from references.buckling.onset import Pipe
from validation.studies.ladder.rung import GRAVITY, NoAnswerError, Rung, Tables, case_of, pipe_of, section, steady
from validation.studies.ladder.wells import part, straight, well

KIND, WEIGHT, LENGTH = "drill_sliding", 1e5, 500.0  # [N], [m]: 23 (EI w²)^⅓, and 120 m of pipe in tension
WINDOW = 40.0, 140.0  # [m] above the bit, where the helix is measured
RESOLVED: dict[str, Any] = {
    "wall": {"stiffness_per_length": 2e7}, "rig": {"block_weight": 1e8}, "solver": {"buckling": "resolve"},
    "mud": {"density": 0.0},
}  # fmt: skip
LEVEL, TIMES, SLIDING = 300.0, 2.5, 0.2  # level hole [m], push over the onset of snaking there, friction factor
# The example of Lubinski, Althouse & Logan 1962: 2⅞ in tubing in 7 in casing of 32 lb/ft, 20,000 lbf.
TUBING: dict[str, Any] = {
    "name": "tubing", "outer_diameter": 2.875 * 0.0254, "inner_diameter": 2.441 * 0.0254,
    "linear_mass": 84.83 / GRAVITY,
}  # fmt: skip
CASING, PUSHED, TUBE = 6.095 * 0.0254, 88964.4, 1200.0  # [m], [N], [m]
LIGHTER = 0.8  # share of the weight on bit whose shortening is subtracted


def vertical(cut: float, friction: float = 0.0, torque: float = 0.0) -> Tables:
    """Pipe in a vertical hole with so much weight on its bit that it winds itself into a helix."""
    bit = {"weight_on_bit": WEIGHT, "torque": torque}
    return well(straight(LENGTH, 0.0), [part(None, cut)], friction=friction, bit=bit, **RESOLVED)


def tubing(weight: float, length: float, cut: float, friction: float = 0.0, block: float = 1e8) -> Tables:
    """Tubing with its lower end held on the axis, in casing of a length [m]."""
    packer = {**TUBING, "name": "packer", "length": 0.5, "segment_length": 0.5, "contact_diameter": CASING}
    string, bit = [packer, {**TUBING, "segment_length": cut}], {"weight_on_bit": weight}
    keys = {**RESOLVED, "rig": {"block_weight": block}}
    return well(straight(length, 0.0), string, friction=friction, hole=CASING, bit=bit, **keys)


def wound(case: Case) -> pd.DataFrame:
    """The part of a profile in which the helix is measured, with the distance above the bit and the angle [rad]."""
    point = steady(case, KIND)
    if point.shape != "helix":
        raise NoAnswerError(f"{point.status}, of shape {point.shape}: {point.message}")
    profile = point.profile
    angle = np.unwrap(np.arctan2(profile["offset_right_m"], profile["offset_high_m"]))
    found = profile.assign(above_m=case.depths[1] - profile["md_m"], angle_rad=angle)
    return found[found["above_m"].between(WINDOW[0] - 5.0, WINDOW[1] + 5.0)]


def at_ends(found: pd.DataFrame, column: str) -> float:
    """Difference of a column between the lower and the upper end of the window, by a cubic through its part."""
    curve = np.polynomial.Polynomial.fit(found["above_m"], found[column], 3)
    return float(curve(WINDOW[0]) - curve(WINDOW[1]))


def over_window(case: Case, value: Callable[[Pipe, float], float]) -> float:
    """Integral over the window of a function of the compression without friction [N]."""
    pipe = pipe_of(case)
    return float(quad(lambda z: value(pipe, case.bit.weight_on_bit - pipe.weight * z), *WINDOW)[0])


def turns(case: Case) -> float:
    """Angle by which the helix turns in the window [rad]."""
    return abs(at_ends(wound(case), "angle_rad"))


def walls(case: Case) -> float:
    """Wall force in the window [N]: that of a contact point over half the distance of its neighbours, integrated."""
    found = wound(case)
    per_metre = found["contact_force_N"] / -np.gradient(found["above_m"])
    curve = np.polynomial.Polynomial.fit(found["above_m"], per_metre, 3).integ()
    return float(curve(WINDOW[1]) - curve(WINDOW[0]))


def rubbed(case: Case) -> float:
    """Drag of the helix in the window [N]."""
    return pipe_of(case).weight * (WINDOW[1] - WINDOW[0]) + at_ends(wound(case), "effective_tension_N")


def rubbing(pipe: Pipe, weight: float, friction: float) -> Callable[[float], float]:
    """Compression at a distance above the bit [N], by dF/dz = w − βF², β = μr/4EI: √(w/β) tanh √(βw)(z₀ − z)."""
    beta = friction * pipe.clearance / (4 * pipe.EI)
    rate, scale = np.sqrt(beta * pipe.weight), np.sqrt(pipe.weight / beta)
    neutral = np.arctanh(weight / scale) / rate
    return lambda above: float(scale * np.tanh(rate * (neutral - above)))


def drag(case: Case) -> float:
    """[N]."""
    pipe = pipe_of(case)
    force = rubbing(pipe, case.bit.weight_on_bit, case.wellbore.intervals[0].friction)
    return pipe.weight * (WINDOW[1] - WINDOW[0]) - (force(WINDOW[0]) - force(WINDOW[1]))


def place(case: Case) -> float:
    """How much shorter the string is than it would be straight [m]."""
    point, tube, length = steady(case, KIND), section(case, 1), case.depths[1]
    if point.shape != "helix":
        raise NoAnswerError(f"{point.status}, of shape {point.shape}: {point.message}")
    straight_length = (tube.weight * length**2 / 2 - case.bit.weight_on_bit * length) / tube.EA
    return straight_length - float(point.profile["md_m"].iloc[-1] - length)


def shorter(case: Case) -> float:
    """Shortening by the last fifth of the weight on bit [m]."""
    lighter = case_of(case.model_dump(exclude_defaults=True), {"bit.weight_on_bit": LIGHTER * case.bit.weight_on_bit})
    return place(case) - place(lighter)


def shortening(case: Case) -> float:
    """The same of r²F²/8EIw."""
    return (1 - LIGHTER**2) * helix.vertical_shortening(pipe_of(case, 1), case.bit.weight_on_bit)


def all_shortening(case: Case) -> float:
    """r²F²/8EIw [m]."""
    return helix.vertical_shortening(pipe_of(case, 1), case.bit.weight_on_bit)


def spent(case: Case) -> float:
    """The friction factor at which slack-off is spent."""
    point = steady(case, KIND)
    if not np.isfinite(point.slack_off_spent_at):
        raise NoAnswerError(f"{point.status}, no share of the friction: {point.message}")
    return point.slack_off_spent_at * case.wellbore.intervals[0].friction


def spending(case: Case) -> float:
    """The same by √(w/β) tanh √(βw) L = F: the compression ends at the top."""
    pipe, length, weight = pipe_of(case, 1), case.depths[1], case.bit.weight_on_bit
    locked = 4 * pipe.EI * pipe.weight / (pipe.clearance * weight**2)  # βF² = w
    return float(brentq(lambda factor: rubbing(pipe, weight, factor)(length), 1e-6, (1 - 1e-9) * locked))


def level(cut: float) -> Tables:
    """A helix that is pushed through a level hole."""
    tables = well(straight(LEVEL, 90.0), [part(None, cut)], friction=SLIDING, **RESOLVED)
    tables["bit"] = {"weight_on_bit": round(TIMES * pipe_of(case_of(tables)).onset)}
    return tables


def push(case: Case) -> float:
    """1/F₀ − 1/F = μ r x/4EI: what friction adds to the push at the top [N]."""
    force = case.bit.weight_on_bit
    return helix.pushed_force(pipe_of(case), force, case.wellbore.intervals[0].friction, case.depths[1]) - force


def twisted(case: Case) -> float:
    """2EIθ'² + 1.5Mθ' of the string in the window [N], θ' > 0 as a right-hand thread; 1.5Mθ' is of the bit's torque.

    The torque of the rock turns the bit anticlockwise seen downhole, so that it winds a left-hand helix up.
    """
    found = wound(case)
    # From the high side to the right as the depth grows is clockwise seen downhole, a right-hand thread.
    rate = at_ends(found, "angle_rad") / (WINDOW[1] - WINDOW[0])
    return float(2 * pipe_of(case).EI * rate**2 + 1.5 * case.bit.torque * rate)


def untwisted(case: Case) -> float:
    """Mean compression in the window [N]."""
    return over_window(case, lambda pipe, force: force) / (WINDOW[1] - WINDOW[0])


RUNGS = [
    Rung(
        "helix, turns", "θ' = √(F/2EI) (Lubinski, Althouse & Logan 1962)", vertical,
        lambda case: over_window(case, helix.turning), {"steady": turns}, "rad", (7.3, 5.0),
    ),
    Rung(
        "helix, wall force", "rF²/4EI (Mitchell 1986)", vertical, lambda case: over_window(case, helix.wall_force),
        {"steady": walls}, "N", (7.3, 5.0), bound=0.6,
    ),
    Rung(
        "helix, friction", "dF/dz = w − μrF²/4EI", partial(vertical, friction=0.2), drag, {"steady": rubbed}, "N",
        (7.3, 5.0),
    ),
    Rung(
        "helix, shortening by a fifth of the weight", "r²F²/8EIw (Lubinski, Althouse & Logan 1962)",
        partial(tubing, 4.5e4, 600.0), shortening, {"steady": shorter}, "m", (7.3, 5.0),
    ),
    Rung(
        "helix of the example of 1962, shortening", "r²F²/8EIw, 5.54 in", partial(tubing, PUSHED, TUBE),
        all_shortening, {"steady": place}, "m", (7.3, 5.0), long=True,
    ),
    Rung(
        "helix, friction at which slack-off is spent", "√(w/β) tanh √(βw) L = F, β = μr/4EI",
        partial(tubing, 4.5e4, 540.0, friction=0.1, block=0.0), spending, {"steady": spent}, "", (7.3, 5.0), long=True,
    ),
    Rung(
        "level helix, push", "1/F₀ − 1/F = μrx/4EI", level, push,
        {"steady": lambda case: -steady(case, KIND).hookload - case.bit.weight_on_bit}, "N", (7.3, 5.0),
    ),
    Rung(
        "helix with torque at the bit", "2EIθ'² − 1.5Mθ' − F = 0 (Miska & Cunha 1995)",
        partial(vertical, torque=3e3), untwisted, {"steady": twisted}, "N", (7.3, 5.0),
    ),
]  # fmt: skip
