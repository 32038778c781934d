"""One build of any severity with straight hole above and below, in a hole of any clearance."""

import numpy as np

from fctd import Case
from validation.cases import trip
from validation.cases.wells import FOOT

HUNDRED_FEET = 100 * FOOT
MU = 0.25
ANGLE = 60.0  # [deg] of the build
# Straight hole above and below the build [m]: strings with much and with little weight below the bend.
HEAVY, LIGHT = (300.0, 600.0), (40.0, 25.0)
BESIDE = 20.0  # [m] of straight hole on either side of the bend with segments as short as in the bend
WALL = 1e7  # [N/m] per metre
# Outer and inner diameter [m].
PIPE, COLLAR = "5 in pipe", "6 3/4 in collar"
STRINGS = {PIPE: (0.1270, 0.1086), COLLAR: (0.1714, 0.0714)}
LIMIT, NARROW, ORDINARY = 30.0, 0.005, 0.05  # the paper's limit; clearances [m]


def segment(severity: float, clearance: float) -> float:
    """Length of segments in the bend [m]: an eighth of the longest straight piece that fits, 4√(Rc), 0.2 to 1 m."""
    radius = HUNDRED_FEET / np.radians(severity)
    return float(np.clip(0.5 * np.sqrt(radius * clearance), 0.2, 1.0))


def case_of(
    string: str,
    severity: float,
    clearance: float,
    straight: tuple[float, float] = HEAVY,
    piece: float | None = None,
    friction: float = MU,
    wall: float = WALL,
) -> Case:
    """Vertical, a build of that severity, hold, in a hole whose diameter follows from the clearance.

    straight [m] : vertical and hold; piece [m] : segments in the bend; wall [N/m] : stiffness per metre.  The schedule
    lowers the bit from the kick-off.
    """
    bend = ANGLE / severity * HUNDRED_FEET
    ends = np.cumsum([0.0, straight[0], bend, straight[1]])
    stations = [[float(md), inc, 0.0] for md, inc in zip(ends, (0.0, 0.0, ANGLE, ANGLE), strict=True)]
    outer, inner = STRINGS[string]
    pipe = {"outer_diameter": outer, "inner_diameter": inner}
    fine = segment(severity, clearance) if piece is None else piece
    parts = [
        pipe | {"name": "below the bend", "length": straight[1] - BESIDE, "segment_length": 1.0},
        pipe | {"name": "in the bend", "length": bend + 2 * BESIDE, "segment_length": fine},
        pipe | {"name": "above the bend", "segment_length": 1.0},
    ]
    interval = {"to_md": float(ends[-1]), "diameter": outer + 2 * clearance, "friction": friction}
    hole = {"stations": stations, "geometry": "arcs", "stiffness_per_length": wall, "intervals": [interval]}
    return Case.model_validate(
        {
            "name": string,
            "wellbore": hole,
            "string": {"components": parts},
            "mud": {"density": 1200.0, "viscosity": 0},
            "operations": trip(float(ends[1]), float(ends[-1]), speed=1.0, ramp=1.0),
        }
    )
