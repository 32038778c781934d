"""Coulomb's law put to an engine by itself: a pipe that turns in a straight, horizontal hole.

Every point of it slides across the hole, so that friction has to be μN in size and to stand across the hole in
direction, whatever the engine makes of N and whichever way the hole heads.  FCTD takes no part but in the start.
"""

from typing import Any, NamedTuple

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.simulation.run import prepare
from references import engines
from references.engines import Window
from references.engines.run import late

SEGMENTS, LENGTH, FACTOR, CONTACT_RADIUS = 4, 100.0, 0.2, 0.051
LEAD = 6.0  # [s]


class Sliding(NamedTuple):
    """What an engine makes of sliding friction.

    share : friction over μN, 1 by Coulomb's law.  lean [rad] : of friction off the sliding, towards up the hole, 0 by
    Coulomb's law.  status, failed : of the run.
    """

    share: float
    lean: float
    status: str
    failed: str


def straight(azimuth: float) -> Case:
    """The pipe turning in its hole, azimuth [deg]."""
    pipe = {"name": "pipe", "outer_diameter": 2 * CONTACT_RADIUS, "inner_diameter": 0.06, "length": LENGTH}
    return Case.model_validate(
        {
            "name": "straight hole",
            "wellbore": {
                "stations": [[0, 90, azimuth], [200, 90, azimuth]],
                "intervals": [{"to_md": 200, "diameter": 0.3112, "friction": FACTOR}],
            },
            "string": {"top_md": 50, "components": [pipe | {"segments": SEGMENTS}]},
            "operations": [{"kind": "rotate_off_bottom", "at_md": 150, "duration": 20, "rpm": 60, "ramp_time": 2}],
            "record": {"interval": 0.1},
        }
    )


def sliding(name: str, azimuth: float, duration: float = 2.0, **options: Any) -> Sliding:
    """Friction of the pipe in an engine; azimuth of the hole [deg]."""
    run = engines.build(name, **options).run(straight(azimuth), Window(LEAD, duration))
    mean = late(run)
    # The hook load is all the friction there is along the hole: weight acts across it.
    along, across = mean["hookload_N"], mean["sum_r_ft_N_m"] / CONTACT_RADIUS
    share = np.hypot(along, across) / (FACTOR * mean["total_contact_force_N"])
    return Sliding(float(share), float(np.arctan2(along, across)), run.status, run.message)


def lean_of_two_directions(azimuth: float) -> float:
    """Lean [rad] of friction that opposes M·v, M the effective masses along north and east alone: Bullet's.

    azimuth [deg].  A body of the pipe touches at its end: it gives way to a push across the hole by its mass, by
    turning over its middle and by turning about its axis, to one along the hole by its mass alone.
    """
    S = prepare(straight(azimuth))[0].S
    mass, arm, radius, tilt, spin = (
        float(S[row + 2]) for row in (state.MASS, state.ARM_CONTACT, state.RADIUS, state.J_TRANSVERSE, state.J_AXIAL)
    )
    along, across = 1 / mass + radius**2 / tilt, 1 / mass + arm**2 / tilt + radius**2 / spin
    c, s = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
    north, east = c * c * along + s * s * across, s * s * along + c * c * across
    # Sliding across the hole is (−s, c); what comes out, taken apart along (c, s) and across (−s, c).
    first, second = -s / north, c / east
    return float(np.arctan2(first * c + second * s, second * c - first * s))
