"""Wells without a case file that several studies use, each with a string to its total depth."""

from typing import Any

import numpy as np

from fctd import Case
from validation.cases import load
from validation.harness.study import Context

FOOT = 0.3048
Stations = list[list[float]]

PIPE = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "contact_diameter": 0.165}
COLLAR = {"name": "drill collar", "outer_diameter": 0.165, "inner_diameter": 0.0714}
HEAVY = {"name": "heavy-weight pipe", "outer_diameter": 0.127, "inner_diameter": 0.0762, "contact_diameter": 0.165}

# Weight on bit and bit torque with which the paper's well is drilled.
DRILLING = {"bit__weight_on_bit": "50 kN", "bit__torque": "3 kN*m"}

# 4.5°/30 m to 60°.
BUILD: Stations = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1500, 60, 0]]
# 30°/100 ft to horizontal, where a soft string fails according to the paper.
SHARP: Stations = [[0, 0, 0], [600, 0, 0], [600 + 300 * FOOT, 90, 0], [900 + 300 * FOOT, 90, 0]]
# 3°/30 m to 45°, back to 10° at 2°/30 m.
S_WELL: Stations = [[0, 0, 0], [600, 0, 0], [1050, 45, 0], [1800, 45, 0], [2325, 10, 0], [2600, 10, 0]]
# Builds to 60°, then to 85° while it turns by 70°.
TURN: Stations = [[0, 0, 30], [500, 0, 30], [1100, 60, 30], [1400, 60, 30], [2000, 85, 100], [2900, 85, 100]]


def catenary(scale: float = 800.0, first: float = 15.0, last: float = 80.0, arcs: int = 60) -> Stations:
    """Stations of a catenary of horizontal tension over weight ``scale`` [m] between two inclinations [deg].

    tan(inclination) = scale/s, s the length left to its lowest point; a build of its first curvature leads there.
    """
    start_left, end_left = (float(scale / np.tan(np.radians(angle))) for angle in (first, last))
    kick_off, curvature = 200.0, np.degrees(scale / (scale**2 + start_left**2))
    start = kick_off + first / curvature
    left = np.linspace(start_left, end_left, arcs + 1)
    curve = [[start + float(start_left - s), float(np.degrees(np.arctan2(scale, s))), 0.0] for s in left]
    return [[0.0, 0.0, 0.0], [kick_off, 0.0, 0.0], *curve]


def well(
    name: str, stations: Stations, components: list[dict[str, Any]], wellbore: dict[str, Any], friction: float = 0.25,
    law: str = "coulomb",
) -> Case:  # fmt: skip
    """8.5 in hole, one friction factor, 1200 kg/m³ mud."""
    interval = {"to_md": stations[-1][0], "diameter": 0.2159, "friction": friction}
    return Case.model_validate(
        {
            "name": name,
            "wellbore": {"stations": stations, "intervals": [interval], **wellbore},
            "string": {"components": components},
            "mud": {"density": 1200.0, "viscosity": 0},
            "contact": {"friction_law": law},
        }
    )


def real_well(context: Context, **changes: Any) -> Case:
    """K05-ENC-05-S1, 8,161 m of public survey with an assumed string, for a study that needs the data."""
    assert context.data is not None  # the runner has checked that the data are there
    return load("nlog_k05", wellbore__survey=context.data / "surveys" / "nlog_K05-ENC-05-S1.csv", **changes)


def assembly(*bottom: tuple[dict[str, Any], float]) -> list[dict[str, Any]]:
    """Components of these lengths [m] and pipe above them, in 10 m segments."""
    parts = [{**part, "length": length, "segment_length": 10.0} for part, length in bottom]
    return [*parts, {**PIPE, "segment_length": 10.0}]


def drilled_paper_well(segments: int) -> Case:
    """Paper-well drilled, its string in 61 segments, as in the paper, or in equal ones."""
    if segments == 61:
        return load("paper_well", **DRILLING)
    return load(
        "paper_well",
        string__components__0__segments=round(200 / 2450 * segments),
        string__components__1__segments=round(1500 / 2450 * segments),
        string__components__2__segments=None,
        string__components__2__segment_length=2450 / segments,
    )
