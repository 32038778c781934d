"""Tables of cases that several families of rungs use."""

from typing import Any

import numpy as np

from validation.studies.ladder.rung import MUD, Tables

Stations = list[list[float]]
PIPE: dict[str, Any] = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086}
HOLE = 0.2159  # [m], diameter


def part(length: float | None, cut: float, **keys: Any) -> dict[str, Any]:
    """A component of 5 in pipe, changed by keys, in segments of a length [m]; without a length up to the top."""
    whole = {} if length is None else {"length": length}
    return {**PIPE, **whole, "segment_length": cut, **keys}


def well(
    stations: Stations, components: list[dict[str, Any]], friction: float = 0.0, hole: float = HOLE,
    wall: dict[str, Any] | None = None, **tables: Any,
) -> Tables:  # fmt: skip
    """Tables of a well of arcs with one interval, in mud of 1,200 kg/m³ that damps sideways alone."""
    interval = {"to_md": stations[-1][0], "diameter": hole, "friction": friction}
    bore = {"stations": stations, "geometry": "arcs", "intervals": [interval], **(wall or {"stiffness": 1e7})}
    # A stand is a whole number of segments: so long that it has those of the string.
    stand = 4 * components[-1].get("segment_length", 7.0)
    shared = {"mud": {"density": MUD}, "rig": {"feed": "stands", "stand_length": stand, "derrick_height": stand + 12.0}}
    return {"name": "rung", "wellbore": bore, "string": {"components": components}, **shared, **tables}


def straight(length: float, inclination: float) -> Stations:
    """A straight hole of a length [m] at an inclination [deg]."""
    return [[0.0, inclination, 0.0], [length, inclination, 0.0]]


def bend(above: float, radius: float, below: float, first: float, last: float) -> Stations:
    """Straight hole [m], an arc of a radius [m] between two inclinations [deg], straight hole [m]."""
    ends = np.cumsum([0.0, above, radius * np.radians(abs(last - first)), below])
    courses = zip(ends, (first, first, last, last), (True, above > 0, True, below > 0), strict=True)
    return [[float(md), angle, 0.0] for md, angle, there in courses if there]
