"""Test of an engine's friction by Coulomb's law: a pipe that turns in a level hole, straight or with a bend.

Every point slides across the hole, so that friction has to be μN and to act across the hole, for any N that the engine
finds and any azimuth of the hole.  FCTD computes only the initial state.
"""

from typing import Any, NamedTuple

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.simulation.preparation import prepare
from references import engines
from references.engines import EngineRun, Window
from references.engines.run import late

SEGMENT, FACTOR, CONTACT_RADIUS = 25.0, 0.2, 0.051
RPM = 60.0
LEAD = 6.0  # [s], from rest until the pipe turns steadily


class Sliding(NamedTuple):
    """Sliding friction of an engine.

    share : friction over μN, 1 by Coulomb's law.  lean [rad] : angle between friction and the direction opposite to
    sliding, positive up the hole, 0 by Coulomb's law.  status, failed : status and message of the run.
    """

    share: float
    lean: float
    status: str
    failed: str


def straight(azimuth: float) -> Case:
    """The case of a turning pipe in a straight, level hole with this azimuth [deg]."""
    return _level([[0, 90, azimuth], [200, 90, azimuth]], 4)


def with_bend(angle: float) -> Case:
    """The case of a turning pipe in a level hole, straight but for a bend of 40 m about its middle [deg]."""
    return _level([[0, 90, 0], [130, 90, 0], [170, 90, angle], [300, 90, angle]], 8, geometry="arcs")


def _level(stations: list[list[float]], segments: int, **hole: str) -> Case:
    length, end = segments * SEGMENT, stations[-1][0]
    pipe = {"name": "pipe", "outer_diameter": 2 * CONTACT_RADIUS, "inner_diameter": 0.06, "length": length}
    return Case.model_validate(
        {
            "name": "level hole",
            "wellbore": {
                "stations": stations,
                "intervals": [{"to_md": end, "diameter": 0.3112, "friction": FACTOR}],
                **hole,
            },
            "string": {"top_md": 50, "components": [pipe | {"segments": segments}]},
            "operations": [
                {"kind": "rotate_off_bottom", "at_md": 50 + length, "duration": 20, "rpm": RPM, "ramp_time": 2}
            ],
            "record": {"interval": 0.1},
        }
    )


def sliding(name: str, azimuth: float, duration: float = 2.0, **options: Any) -> Sliding:
    """Friction of the pipe in engine ``name``; azimuth of the hole [deg], duration of the window [s]."""
    return sliding_in(engines.build(name, **options).run(straight(azimuth), Window(LEAD, duration)))


def sliding_in(run: EngineRun) -> Sliding:
    """Friction of the pipe in a run of one of these cases; nan for a pipe that does not touch its wall.

    In a bend it is the sum over all points, along the hole and across it.
    """
    mean = late(run)
    # The hook load is the friction along the hole: weight acts across it.
    along, across = mean["hookload_N"], mean["sum_r_ft_N_m"] / CONTACT_RADIUS
    limit = FACTOR * mean["total_contact_force_N"]
    share = np.hypot(along, across) / limit if limit > 0 else np.nan
    return Sliding(float(share), float(np.arctan2(along, across)), run.status, run.message)


def lean_of_two_directions(azimuth: float) -> float:
    """Lean [rad] of friction that opposes M·v, M the effective masses along north and east, as Bullet solves it.

    azimuth [deg].  A body of the pipe touches at its end.  A force across the hole moves its mass, tilts it about its
    middle and turns it about its axis; a force along the hole moves its mass and tilts it.
    """
    S = prepare(straight(azimuth))[0].S
    mass, arm, radius, tilt, spin = (
        float(S[row + 2]) for row in (state.MASS, state.ARM_CONTACT, state.RADIUS, state.J_TRANSVERSE, state.J_AXIAL)
    )
    along, across = 1 / mass + radius**2 / tilt, 1 / mass + arm**2 / tilt + radius**2 / spin
    c, s = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
    north, east = c * c * along + s * s * across, s * s * along + c * c * across
    # Sliding across the hole is (−s, c); friction is resolved along the hole (c, s) and across it (−s, c).
    first, second = -s / north, c / east
    return float(np.arctan2(first * c + second * s, second * c - first * s))
