"""Rungs of depths, pressures and flows: one arc of two stations, casing pulled and pressed, free fall, tool joints."""

import numpy as np

from fctd import Case, equilibrium
from fctd.hydraulics.pressures import circulation, lay
from fctd.results.limits import LIMITS, SHARE
from validation.studies.ladder.rung import GRAVITY, MUD, NoAnswerError, Rung, Tables, case_of, steady
from validation.studies.ladder.wells import HOLE, bend, part, straight, well

ABOVE, RADIUS, WARMER = 300.0, 800.0, 0.06  # [m] of vertical hole above an arc of 90°, [K] for each metre of depth
DEEP = 1000.0  # [m]
HEAVIER, VISCOSITY = 1500.0, 1.0  # [kg/m³], [Pa s]: of a column so thick that it falls without turbulence
PSI = 6894.757293168
N_80, K_55 = 80e3 * PSI, 55e3 * PSI
FLOW = 0.02  # [m³/s]
JOINTED, EVERY = 480.0, 12.0  # [m] of whole joints
TOOL_JOINT = {"length": EVERY, "tool_joint_diameter": 0.168, "tool_joint_inner": 0.07, "tool_joint_length": 0.6}
WIDE, BORE = 9.625 * 0.0254, 8.681 * 0.0254  # [m], of 47 lb/ft casing


def warmed(cut: float) -> Tables:
    """Pipe round one arc of 90° between two stations, warmer with its true vertical depth."""
    rows = [{"tvd": 0.0, "change": 0.0}, {"tvd": 2000.0, "change": 2000.0 * WARMER}]
    tight = part(None, cut, contact_diameter=HOLE - 2e-4)
    return well(bend(ABOVE, RADIUS, 0.0, 0.0, 90.0), [tight], temperature=rows)


def warm_stretch(case: Case) -> float:
    """α·γ·∫z ds = α·γ·(A²/2 + A R π/2 + R²) [m], z = A + R sin(s/R) along the arc."""
    along = 0.5 * ABOVE**2 + 0.5 * np.pi * ABOVE * RADIUS + RADIUS**2
    return float(case.string.components[0].thermal_expansion * WARMER * along)


def longer_when_warm(case: Case) -> float:
    """By how much the bit lies deeper along the hole than in the same string of one temperature [m]."""
    cold = case_of(case.model_dump(exclude_defaults=True), {"temperature": None})
    warm, as_laid = (float(steady(one, "rotate_off_bottom").profile["md_m"].iloc[-1]) for one in (case, cold))
    return warm - as_laid


def pulled_casing(cut: float) -> Tables:
    """Empty casing N-80 of 100 m, pulled until tension leaves the strength of K-55 at its pressed lower end."""
    pipe = {"name": "casing", "pipe": "9 5/8 in 47 N-80 casing", "segment_length": cut}
    mud = {"density": MUD, "inside": [{"density": 0.0}], "outside_pressure": 2e6, "float": True}
    outside = 0.25 * np.pi * WIDE**2
    left = K_55 / N_80  # √(1 − ¾s²) − ½s, solved for s
    share = -0.5 * left + np.sqrt(1 - 0.75 * left**2)
    pull = share * N_80 * 0.25 * np.pi * (WIDE**2 - BORE**2) + (2e6 + MUD * GRAVITY * 100) * outside
    return well(straight(100.0, 0.0), [pipe], hole=0.4, mud=mud, bit={"overpull": pull})


def collapse_of_k_55(_: Case) -> float:
    """Y (A/(D/t) − B) − C of the plastic regime, A 2.991, B 0.0541, C 1206 psi (API TR 5C3, table for K-55) [Pa]."""
    slenderness = WIDE / (0.5 * (WIDE - BORE))
    return PSI * (55e3 * (2.991 / slenderness - 0.0541) - 1206)


def collapse_under_tension(case: Case) -> float:
    """Pressure that the casing is said to bear [Pa]: the one on its lower end over the share that it uses."""
    point = equilibrium(case, "trip_out", 100.0)
    if not point.answered:
        raise NoAnswerError(point.message)
    share = point.shares[[limit.code for limit in LIMITS].index("collapse"), SHARE]
    return float((2e6 + MUD * GRAVITY * 100) / share)


def falling(cut: float) -> Tables:
    """A heavy and thick column above a float."""
    mud = {"density": MUD, "viscosity": VISCOSITY, "inside": [{"density": HEAVIER}], "float": True}
    return well(straight(DEEP, 0.0), [part(None, cut)], mud=mud)


def per_flow(inner: float, outer: float) -> float:
    """Pressure lost in a metre of bore and of annulus over the flow through both [Pa s/m⁴] (Bird, Stewart & Lightfoot).

    8μ/πa⁴ and 8μ/π(R⁴ − b⁴ − (R² − b²)²/ln(R/b)), of the diameters of the pipe [m].
    """
    a, b, wall = 0.5 * inner, 0.5 * outer, 0.5 * HOLE
    ring = wall**4 - b**4 - (wall**2 - b**2) ** 2 / np.log(wall / b)
    return float(8 * VISCOSITY / np.pi * (1 / a**4 + 1 / ring))


def free_fall(case: Case) -> float:
    """(ρ_i − ρ_o) g over what a metre of bore and of annulus loses per flow, both laminar [m³/s]."""
    pipe = case.string.components[0]
    return (HEAVIER - MUD) * GRAVITY / per_flow(pipe.inner_diameter, pipe.outer_diameter)


def rate_of_fall(case: Case) -> float:
    """Flow at which the column falls [m³/s]."""
    rate = lay(case, DEEP).channel.free_fall(0.0)
    if rate is None:
        raise NoAnswerError("the column does not fall")
    return rate


def jointed(cut: float) -> Tables:
    """Pipe whose tool joints narrow annulus and bore, in thick mud that is pumped."""
    pipe = {key: value for key, value in part(None, cut).items() if key != "segment_length"}
    laid = {**pipe, "joint": TOOL_JOINT, "joint_segments": round(EVERY / cut)}
    return well(
        straight(JOINTED, 0.0), [laid], mud={"density": MUD, "viscosity": VISCOSITY}, rig={"surface_length": 0.0}
    )


def lost_by_joints(case: Case) -> float:
    """Q times the loss per flow of each body and of each tool joint [Pa]."""
    pipe = case.string.components[0]
    body, joint = per_flow(pipe.inner_diameter, pipe.outer_diameter), per_flow(0.07, 0.168)
    share = 0.6 / EVERY
    return FLOW * JOINTED * ((1 - share) * body + share * joint)


def pumped(case: Case) -> float:
    """Standpipe pressure [Pa]."""
    return circulation(case, FLOW, JOINTED).standpipe


RUNGS = [
    Rung(
        "stretch by temperature round one arc", "αγ(A²/2 + A R π/2 + R²)", warmed, warm_stretch,
        {"steady": longer_when_warm}, "m", (73.0, 50.0), bound=0.2, refined=(200.0, 100.0, 50.0), order=(1.7, 2.3),
    ),
    Rung(
        "collapse of pulled casing", "N-80 with a reduced yield strength of 55 ksi collapses as K-55 (API TR 5C3)",
        pulled_casing, collapse_of_k_55, {"steady": collapse_under_tension}, "Pa", (7.3, 5.0), bound=0.1,
    ),
    Rung(
        "free fall of a heavy column", "(ρ_i − ρ_o) g over the laminar losses of bore and annulus", falling, free_fall,
        {"steady": rate_of_fall}, "m³/s", (73.0, 50.0), bound=0.5,
    ),
    Rung(
        "tool joints, standpipe pressure", "Q times the laminar losses of bodies and tool joints, bore and annulus",
        jointed, lost_by_joints, {"steady": pumped}, "Pa", (4.0, 3.0), bound=0.5,
    ),
]  # fmt: skip
