"""Paths of wells as they are planned and as they are drilled."""

import math
from random import Random

# Sections of a plan: length [m], build and turn rate [deg/30 m], each a range to draw from.
Range = tuple[float, float]
Section = tuple[Range, Range, Range]
HOLD: tuple[Range, Range] = ((0, 0), (0, 0))
PLANS: dict[str, list[Section]] = {
    "vertical": [((500, 4000), *HOLD)],
    "build and hold": [((200, 1500), *HOLD), ((200, 700), (1, 4), (0, 0)), ((300, 2500), *HOLD)],
    "turn": [
        ((200, 1000), *HOLD),
        ((300, 700), (1, 3.5), (-1, 1)),
        ((300, 1500), (-0.3, 0.3), (-3, 3)),
        ((100, 1000), *HOLD),
    ],
    "S-shape": [
        ((200, 1000), *HOLD),
        ((300, 600), (1, 3), (0, 0.5)),
        ((300, 1500), *HOLD),
        ((300, 600), (-3, -1), (-1, 1)),
        ((100, 900), *HOLD),
    ],
    "horizontal": [((500, 1800), *HOLD), ((400, 600), (4, 5.5), (-0.5, 0.5)), ((200, 1800), (-0.2, 0.2), (-0.5, 0.5))],
    "extended reach": [
        ((150, 400), *HOLD),
        ((700, 1000), (2, 3), (-0.5, 0.5)),
        ((3000, 6000), (-0.02, 0.02), (-0.1, 0.1)),
    ],
    "slant": [((500, 3000), (-0.1, 0.1), (-0.2, 0.2))],
    "upwards": [((300, 800), *HOLD), ((500, 700), (4.3, 5), (0, 1)), ((100, 800), (0, 0.3), (-0.5, 0.5))],
}


def path(rng: Random, spacing: float = 30.0, deepest: float = 9000.0) -> list[list[float]]:
    """Stations [m, deg, deg] every ``spacing`` [m] along a plan, the upper end first; azimuth from 0 to 360.

    One in three wanders about the plan by up to a degree, as a drilled well does.
    """
    name = rng.choice(list(PLANS))
    inclination = rng.uniform(5, 60) if name == "slant" else 0.0
    azimuth = rng.uniform(0, 360)
    wander = rng.uniform(0.05, 1.0) * min(spacing / 30, 1) if rng.random() < 0.33 else 0.0
    stations, md = [[0.0, inclination, azimuth]], 0.0
    for length, build, turn in PLANS[name]:
        end = md + rng.uniform(*length)
        rates = rng.uniform(*build) / 30, rng.uniform(*turn) / 30
        while md < min(end, deepest) - 1e-6:
            step = min(spacing, end - md)
            md += step
            inclination = min(max(inclination + rates[0] * step, 0.0), 120.0)
            # Near vertical an azimuth says little, and a turn of it is no bend.
            azimuth += rates[1] * step / max(math.sin(math.radians(inclination)), 0.2)
            drilled = min(max(inclination + rng.gauss(0, wander), 0.0), 180.0), azimuth + rng.gauss(0, wander)
            station = [round(md, 2), round(drilled[0], 2), round(drilled[1] % 360, 2)]
            if station[0] > stations[-1][0]:  # the last step of a stretch may be shorter than a centimetre
                stations.append(station)
    return stations
