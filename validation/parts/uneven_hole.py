"""An S-shaped well whose hole is no circle: a washout, a ledge, rough hole, a key seat and an oval section."""

from typing import Any, Final

import numpy as np

from fctd import Case
from fctd.arrays import Array

DEPTH: Final = 800.0
STATIONS: Final = [[0, 0, 0], [100, 0, 0], [300, 40, 30], [500, 40, 30], [700, 10, 30], [DEPTH, 10, 30]]
SHOE, BIT, TOOL_JOINT, COLLAR = 150.0, 0.2159, 0.1683, 0.1712  # [m]
FIRST, LAST, SPACING, ARMS = 160.0, 795.0, 0.1, 32
# From and to [m].
WASHOUT, LEDGE, ROUGH, KEY_SEAT, OVAL = (320.0, 350.0), (400.0, 401.0), (430.0, 540.0), (570.0, 620.0), (640.0, 690.0)
PARTS: Final = {"washout": WASHOUT, "ledge": LEDGE, "rough": ROUGH, "key seat": KEY_SEAT, "oval": OVAL}
WIDER, STEP, DEEP, LONG_AXIS = 1.4, 0.02, 0.05, 0.27  # washout; ledge, key seat, oval [m]
ROUGHNESS, SEED = 0.003, 20261127  # standard deviation of the radius [m]
PIPE: Final = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "contact_diameter": TOOL_JOINT}
COLLARS: Final = {"name": "collars", "length": 90.0, "outer_diameter": 0.165, "inner_diameter": 0.0714,
                  "contact_diameter": COLLAR}  # fmt: skip


def radii() -> tuple[Array, Array]:
    """Measured depths (k,) [m] and radii (k, ARMS) [m] of the uneven hole, from the high side clockwise."""
    md, angle = np.arange(FIRST, LAST + 1e-9, SPACING), 2 * np.pi / ARMS * np.arange(ARMS)
    wall = np.full((len(md), ARMS), 0.5 * BIT)

    def within(part: tuple[float, float]) -> Array:
        """1 in a part, and 0 a metre beyond it."""
        shares: Array = np.clip(np.minimum(md - part[0], part[1] - md) + 1, 0, 1)
        return shares[:, None]

    wall += within(WASHOUT) * 0.5 * BIT * (WIDER - 1)
    at = (md >= LEDGE[0]) & (md <= LEDGE[1])
    wall[at] = np.where(np.cos(angle) < 0, 0.5 * BIT - STEP, 0.5 * BIT)  # on the low side
    # The groove of tool joints, above the hole: a circle of theirs that has moved up.
    up = DEEP * np.cos(angle) + np.sqrt(np.maximum((0.5 * TOOL_JOINT) ** 2 - (DEEP * np.sin(angle)) ** 2, 0.0))
    wall += within(KEY_SEAT) * np.maximum(np.where(np.cos(angle) > 0, up, 0.0) - 0.5 * BIT, 0.0)
    across = 0.25 * BIT * LONG_AXIS / np.hypot(0.5 * LONG_AXIS * np.cos(angle), 0.5 * BIT * np.sin(angle))
    wall += within(OVAL) * (across - 0.5 * BIT)
    noise = np.random.default_rng(SEED).normal(size=wall.shape)
    for axis in (0, 1):  # waves of half a metre along and a sixth of the hole around
        noise = sum(np.roll(noise, k, axis) for k in range(-2, 3)) / np.sqrt(5)
    wall += within(ROUGH) * ROUGHNESS * noise
    return md, wall


def equal_areas(wall: Array) -> Array:
    """Radii (k, 1) [m] of circles of the same area as sections (k, ARMS)."""
    found: Array = np.sqrt((wall**2).mean(axis=1, keepdims=True))
    return found


def uneven_case(segment: float, measured: Array | None, geometry: str = "sampled", **sections: Any) -> Case:
    """The well with segments of a length [m], and a caliper of these radii (k, arms) [m]; None: the bit's size."""
    sizes = [
        {"to_md": SHOE, "diameter": 0.2445, "friction": 0.2, "kind": "cased"},
        {"to_md": DEPTH, "diameter": BIT, "friction": 0.3, "kind": "open"},
    ]
    hole: dict[str, Any] = {"stations": STATIONS, "geometry": geometry, "intervals": sizes, "stiffness": 1e7}
    if measured is not None:
        md, _ = radii()
        hole["caliper"] = {"rows": np.column_stack([md, measured]).tolist(), "values": "radius"}
    parts = [COLLARS | {"segment_length": segment}, PIPE | {"segment_length": segment}]
    mud = {"density": 1200.0, "lateral_damping": 100.0}
    return Case.model_validate(
        {"name": "uneven hole", "wellbore": hole, "string": {"components": parts}, "mud": mud, **sections}
    )
