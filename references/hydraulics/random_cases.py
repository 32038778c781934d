"""Random laminar flows in annuli, pipe at rest and moving, for the two routes of the referee."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from references.hydraulics.flow import Annulus, Mud

KINDS = ("at rest", "closed, moving", "moving with flow", "moving, little flow")
RATIOS, INDICES, SHARES = (0.2, 0.95), (0.3, 1.0), (0.0, 0.9)  # of radii; n; yield stress over wall stress
HOLES, STRESSES = (0.05, 0.25), (0.5, 50.0)  # [m] radius; [Pa] at the wall
RATES = (1.0, 500.0)  # [1/s] that the mud would have at this stress without its yield stress


class RandomCase(NamedTuple):
    """kind : of KINDS; flow [m³/s] upwards; speed [m/s] of the pipe downwards."""

    kind: str
    annulus: Annulus
    mud: Mud
    flow: float
    speed: float


def draw(count: int, seed: int = 38) -> Iterator[RandomCase]:
    """Kinds in turn.  The yield share is that of a slot at rest; a pipe that moves has its own."""
    rng = np.random.default_rng(seed)
    for k in range(count):
        hole = rng.uniform(*HOLES)
        annulus = Annulus(hole * rng.uniform(*RATIOS), hole)
        n, share = rng.uniform(*INDICES), rng.uniform(*SHARES)
        wall, rate = np.exp(rng.uniform(*np.log(STRESSES))), np.exp(rng.uniform(*np.log(RATES)))
        mud = Mud(share * wall, wall / rate**n, n)
        mean = slot_mean(annulus.gap, mud, wall)
        kind = KINDS[k % len(KINDS)]
        speed = {"at rest": 0.0, "moving with flow": rng.uniform(-2, 2) * mean}.get(kind, rng.choice([-1, 1]) * mean)
        flow = mean * annulus.area
        if kind == "closed, moving":
            flow = annulus.displaced * speed
        elif kind == "moving, little flow":
            flow *= rng.uniform(-0.3, 0.3)
        yield RandomCase(kind, annulus, mud, float(flow), float(speed))


def slot_mean(gap: float, mud: Mud, wall: float) -> float:
    """Mean velocity [m/s] in a slot of a width [m] at rest, at a stress [Pa] at its walls, exact.

    V = ½ gap γ_w (1−s) n/(n+1) (1 − n(1−s)/(2n+1)), with γ_w the rate at the walls and s the yield share.
    """
    n, sheared = mud.index, 1 - mud.yield_stress / wall
    rate = float(mud.shear_rate(np.array(wall)))
    return 0.5 * gap * rate * sheared * n / (n + 1) * (1 - n * sheared / (2 * n + 1))
