"""Short beams at rest in a straight horizontal hole without friction, against closed forms of beam theory."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, Equilibrium, equilibrium
from fctd.case.string import ComponentSpec
from fctd.model.section import section_of
from validation.harness.study import Check, Context, Outcome, Study

HOLE = 0.3  # [m] diameter
# 8 in collar; a bit or stabiliser as wide as the hole, shorter than the segments beside it, is a support.
COLLAR: dict[str, Any] = {"name": "collar", "outer_diameter": 0.2032, "inner_diameter": 0.0714}
SUPPORT = {**COLLAR, "name": "support", "contact_diameter": HOLE, "segments": 1}
SECTION = section_of(ComponentSpec.model_validate({**COLLAR, "segments": 1}), 0.0)  # in air
DEPTH = 200.0  # [m] of hole


def solve(components: list[dict[str, Any]], length: float, **sections: Any) -> Equilibrium:
    """The string whose lower ``length`` metres hang from a clamp in the middle of a horizontal hole."""
    interval = {"to_md": DEPTH, "diameter": HOLE, "friction": 0.0}
    hole = {"stations": [[0, 90, 0], [DEPTH, 90, 0]], "geometry": "arcs", "stiffness": 1e9, "intervals": [interval]}
    case = Case.model_validate(
        {
            "name": "beam", "wellbore": hole,
            "string": {"top_md": DEPTH - length, "components": components}, **sections,
        }
    )  # fmt: skip
    point = equilibrium(case, "rotate_off_bottom", DEPTH)
    if point.status not in ("converged", "locked_up"):  # a bent housing may push slightly
        raise RuntimeError(f"beam of {length:g} m: {point.status}, {point.message}")
    return point


def part(length: float, segment: float, **more: Any) -> dict[str, Any]:
    """A length of collar in segments [m]."""
    return {**COLLAR, "length": length, "segment_length": segment, **more}


def support(segment: float) -> dict[str, Any]:
    """A bit or stabiliser half as long as a segment [m] of collar."""
    return {**SUPPORT, "length": 0.5 * segment}


def cantilever(segment: float) -> tuple[float, float]:
    """Sag of the free end under its own weight [mm]: wL⁴/8EI + wL²/2κGA (Timoshenko & Gere 1972)."""
    length, s = 8.0, SECTION
    point = solve([part(length, segment)], length, contact={"enabled": False})
    exact = s.weight * length**4 / (8 * s.EI) + s.weight * length**2 / (2 * s.shear)
    return -1e3 * float(point.profile["offset_high_m"].iloc[-1]), 1e3 * exact


def stabilised(segment: float) -> tuple[float, float]:
    """Force on the bit [kN] of a beam clamped above, over a stabiliser half-way to the bit: 11/28 wL.

    Three moments, two equal spans, one end built in: M at the clamp wL²/14, at the stabiliser 3wL²/28.
    """
    span, half, s = 9.0, 0.5 * segment, SECTION
    # The stabiliser touches at its middle, the bit at its end.
    components = [
        support(segment),
        part(span - 1.5 * half, segment),
        support(segment),
        part(span - 0.5 * half, segment),
    ]
    point = solve(components, 2 * span)
    return float(point.profile["contact_force_N"].iloc[-1]) / 1e3, 11 / 28 * s.weight * span / 1e3


def pendulum(segment: float) -> tuple[float, float, float, float]:
    """Tangent length [m] and side force on the bit [kN] of a slick pendulum assembly.

    A beam simply supported at the bit that meets the low side, r below, with zero slope and moment
    (Lubinski & Woods 1953 without weight on bit): L⁴ = 24 EI r/w, H = wL/2.
    """
    s = SECTION
    clearance = 0.5 * (HOLE - COLLAR["outer_diameter"])
    length = (24 * s.EI * clearance / s.weight) ** 0.25
    profile = solve([support(segment), part(60.0 - 0.5 * segment, segment)], 60.0).profile
    touching = profile[(profile["contact_force_N"] > 0) & (profile["md_m"] < DEPTH - 1.0)]
    # Beam theory has one concentrated force at the tangent point; an elastic wall spreads it over some decimetres, so
    # the point is taken as the centre of the force in excess of the weight.
    near = touching[touching["md_m"] > float(touching["md_m"].iloc[-1]) - 2.0]
    beyond = near["contact_force_N"] - s.weight * segment
    tangent = DEPTH - float((beyond * near["md_m"]).sum() / beyond.sum())
    return tangent, length, float(profile["contact_force_N"].iloc[-1]) / 1e3, 0.5 * s.weight * length / 1e3


def bent_housing(segment: float) -> tuple[float, float]:
    """Side force on the bit [kN] of a housing bent by 0.5 deg, 2 m above the bit, built in 8 m above it.

    The bend moves the free end of the cantilever by βa; the wall moves it back: H = 3EI βa/L³. The bend points to the
    right, so that the weight does not contribute.
    """
    length, above, angle, s = 8.0, 2.0, np.radians(0.5), SECTION
    components = [
        support(segment),
        part(above - 0.5 * segment, segment, bend=angle, toolface=np.pi / 2),
        part(length - above, segment),
    ]
    bit = solve(components, length).profile.iloc[-1]
    side = float(bit["contact_force_N"] * np.sin(np.radians(bit["contact_angle_deg"]))) / 1e3
    return side, 3 * s.EI * angle * above / length**3 / 1e3


NUMBERS: list[tuple[str, str, Callable[[float], tuple[float, float]]]] = [
    ("cantilever, sag of the end", "mm", cantilever),
    ("stabilised beam, force on the bit", "kN", stabilised),
    ("pendulum, tangent length", "m", lambda segment: pendulum(segment)[:2]),
    ("pendulum, side force on the bit", "kN", lambda segment: pendulum(segment)[2:]),
    ("bent housing, side force on the bit", "kN", bent_housing),
]


def run(context: Context) -> Outcome:
    """Every beam at several segment lengths."""
    lengths = [0.1] if context.quick else [1.0, 0.5, 0.25, 0.1]
    rows = []
    for name, unit, beam in context.progress(NUMBERS, "beams"):
        for segment in lengths:
            value, exact = beam(segment)
            rows.append(
                {
                    "beam": name, "unit": unit, "segment_m": segment, "value": value, "beam_theory": exact,
                    "off_percent": 100 * (value / exact - 1),
                }
            )  # fmt: skip
    table = pd.DataFrame(rows)
    finest = table[table["segment_m"] == lengths[-1]]
    return Outcome(
        tables={"beams": table},
        checks=[
            Check(f"{name}, difference", abs(off), 1.0, "at_most", "%", "beam theory, within 1 %")
            for name, off in zip(finest["beam"], finest["off_percent"], strict=True)
        ],
        notes=[
            "Horizontal hole of 300 mm, 8 in collar in air, no friction. Bit and stabiliser are as wide as the hole, "
            "so the wall supports them on all sides.",
        ],
        display={"beams": "Short beams against beam theory"},
    )


STUDY = Study(
    "beam_in_hole",
    "Does a short stiff string bend as beam theory predicts: on supports, in a pendulum, with a bent housing?",
    run,
    reproduce=True,
)
