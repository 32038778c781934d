"""Rungs near the bit: side force of a slick assembly, of one with a stabiliser and of a bent housing; tool joints."""

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case
from references.beams.beam_column import side_force
from validation.studies.ladder.in_time import by_both
from validation.studies.ladder.rung import MUD, Rung, Tables, pipe_of, section, steady
from validation.studies.ladder.wells import HOLE, bend, part, straight, well

COLLAR: dict[str, Any] = {"name": "drill collar", "outer_diameter": 0.165, "inner_diameter": 0.0714}
SUB = 0.25  # length of bit sub and stabiliser [m], as wide as the hole
REACH, TILT = 60.0, 20.0  # of the assembly [m]; inclination [deg]
STIFF = {"stiffness": 1e9}  # of the wall [N/m]: the point of contact gives way by micrometres
HOUSING = {"below": 2.0, "above": 6.0, "span": 9.0}  # bit to bend, bend to stabiliser, on to the second one [m]
ANGLE = 1.0  # of the bent housing [deg]
BEND, SPACING, JOINT, COLLARS = 150.0, 9.4, 0.2, 40.0  # radius of the bend, tool joints and what hangs below [m]


def wide(length: float, cut: float, name: str) -> dict[str, Any]:
    """A component as wide as the hole."""
    return {**COLLAR, "name": name, "length": length, "segment_length": cut, "contact_diameter": HOLE}


def slick(cut: float, weight: float = 0.0) -> Tables:
    """A bit sub and collars in straight inclined hole."""
    collar = {**COLLAR, "segment_length": cut}
    return well(
        straight(REACH, TILT), [wide(SUB, SUB, "bit"), collar], wall=STIFF, bit={"weight_on_bit": weight},
        rig={"block_weight": 1e6},
    )  # fmt: skip


def stabilised(at: float, cut: float) -> Tables:
    """The same with a stabiliser at a distance from the bit [m]."""
    lower = {**COLLAR, "length": at - 1.5 * SUB, "segment_length": cut}
    collar = {**COLLAR, "segment_length": cut}
    return well(straight(REACH, TILT), [wide(SUB, SUB, "bit"), lower, wide(SUB, SUB, "stabiliser"), collar], wall=STIFF)


def at_the_bit(case: Case, profile: pd.DataFrame) -> float:
    """Side force at the bit [N]."""
    return float(profile["contact_force_N"].iloc[-1])


def loaded(case: Case) -> float:
    """The same while it slides with weight on it."""
    return at_the_bit(case, steady(case, "drill_sliding").profile)


def on_low_side(case: Case, supports: dict[float, float]) -> float:
    """The same of a beam-column that lies on the low side beyond its tangent point."""
    pipe, tilt = pipe_of(case, len(case.string.components) - 1), np.radians(TILT)
    return side_force(
        pipe.EI, pipe.weight * np.sin(tilt), supports, -pipe.clearance, -case.bit.weight_on_bit,
        float(pipe.weight * np.cos(tilt)),
    )  # fmt: skip


def slick_force(case: Case) -> float:
    """[N]; with neither weight on bit nor weight along the hole qL/2 with L⁴ = 24EIc/q."""
    return on_low_side(case, {})


def fulcrum_force(at: float, case: Case) -> float:
    """[N], towards the low side; the stabiliser is a point in the middle of its component, the bit its lower end."""
    return -on_low_side(case, {at: 0.0})


def housing(cut: float) -> Tables:
    """A bent motor between bit and stabiliser, and a second stabiliser; without weight, below pipe that hangs."""
    light = {**COLLAR, "density": MUD * 1.001}
    body = {**light, "segment_length": cut}
    below = {**body, "length": HOUSING["below"] - SUB, "bend": np.radians(ANGLE)}
    above = {**body, "length": HOUSING["above"] - 0.5 * SUB}
    span = {**body, "length": HOUSING["span"] - SUB}
    first, second = ({**wide(SUB, SUB, "stabiliser"), "density": MUD * 1.001} for _ in range(2))
    bit = {**wide(SUB, SUB, "bit"), "density": MUD * 1.001}
    pipe = part(None, cut, bending_stiffness=10.0, outer_diameter=0.05, inner_diameter=0.03)
    return well(straight(REACH, 0.0), [bit, below, above, first, span, second, pipe], wall=STIFF)


def housing_force(case: Case) -> float:
    """M(L₁ + L₂)/3EI = θ a/L₁, the moment at the stabiliser; M/L₁ at the bit [N]."""
    lower, upper = HOUSING["below"] + HOUSING["above"], HOUSING["span"]
    bent = case.string.components[1].bend * HOUSING["below"] / lower
    return float(3 * section(case, 1).EI * bent / (lower + upper) / lower)


def joints(cut: float) -> Tables:
    """Pipe with tool joints in a bend, pulled by collars that hang below it; the pipe weighs nothing."""
    pipe = {"density": MUD * (1 + 1e-6), "linear_mass": 27.0}
    body = part(SPACING - JOINT, cut, **pipe)
    tool = part(JOINT, JOINT, name="tool joint", contact_diameter=0.165, **pipe)
    collar = {**COLLAR, "length": COLLARS, "segment_length": 2.0}
    string = [collar, *(10 * [body, tool]), part(None, cut, **pipe)]
    return well(bend(30.0, BEND, COLLARS + 5.0, 40.0, 0.0), string, wall=STIFF, hole=0.1752)


def joint_moment(case: Case) -> float:
    """Moment [N m] at the ends of a tool joint in the middle of the bend, s = 0.1 m beside where it touches.

    EI/R KL cosh(K(L − s))/sinh(KL), K = √(T/EI), L half of the spacing, whose largest is EI/R KL/tanh KL.
    """
    pull, EI = section(case, 0).weight * COLLARS, section(case, 1).EI
    half, K = 0.5 * SPACING, np.sqrt(pull / EI)
    return float(EI / BEND * K * half * np.cosh(K * (half - 0.5 * JOINT)) / np.sinh(K * half))


def moment_beside(case: Case) -> float:
    """The same of the string, at the sixth tool joint above the collars."""
    profile, middle = steady(case, "trip_out").profile, case.depths[1] - COLLARS - 6 * SPACING + 0.5 * JOINT
    return float(profile.loc[(profile["md_m"] - middle).abs() < 1.5 * JOINT, "bending_moment_N_m"].max())


RUNGS = [
    Rung(
        "slick assembly, side force", "beam-column on the low side: qL/2, L⁴ = 24EIc/q (Woods & Lubinski 1953)", slick,
        slick_force, by_both(at_the_bit, "drill_sliding"), "N", (0.37, SUB), refined=(2.0, 1.0, 0.5), order=(1.5, 3.5),
    ),
    Rung(
        "slick assembly, side force with weight on bit", "the same with 100 kN", partial(slick, weight=1e5),
        slick_force, {"steady": loaded}, "N", (0.37, SUB),
    ),
    Rung(
        "fulcrum, stabiliser at 3 m", "beam-column with a point at the stabiliser (three moments)",
        partial(stabilised, 3.0), partial(fulcrum_force, 3.0), by_both(at_the_bit, "drill_sliding"), "N", (0.37, SUB),
        refined=(2.0, 1.0, 0.5), order=(1.5, 3.5),
    ),
    Rung(
        "fulcrum, stabiliser at 1.5 m", "the same", partial(stabilised, 1.5), partial(fulcrum_force, 1.5),
        {"steady": loaded}, "N", (0.37, SUB),
    ),
    Rung(
        "bent housing, side force", "three moments: M(L₁ + L₂)/3EI = θa/L₁", housing, housing_force,
        {"steady": loaded}, "N", (0.37, SUB), bound=0.8,
    ),
    Rung(
        "tool joints, moment", "EI/R KL/tanh KL at a joint (Paslay & Cernocky 1991), read at its ends", joints,
        joint_moment,
        {"steady": moment_beside}, "N m", (0.37, 0.2),
    ),
]  # fmt: skip
