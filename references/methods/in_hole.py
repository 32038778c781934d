"""Contact methods in the hole of a case: errors at points near its wall, the contract, and what a point costs."""

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from fctd.arena.contract import DEMANDS, Demand, Trial, far_away, held, options, search
from fctd.arena.errors import deviations
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import BAND, SEED, Frame, frame
from fctd.arena.method import ContactMethod
from fctd.arena.result import Cost, Quartiles, WallErrors
from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from fctd.model.frames import hole_frame
from fctd.model.wellbore import build_wellbore, find_contacts
from references.timing import reference_kernel
from references.timing.stopwatch import race

POINTS = 2000  # near the wall, for the errors
FEW, MOST = 20, 10.0  # points that are asked first; time [s] that all of them may take
ROUNDS = 15  # of the race
PASSES = 200  # of the reference kernel in a round
# [s] of a turn in the race: a slower method is asked for fewer points, a faster one several times.
LONGEST, SHORTEST = 0.1, 2e-3
KERNEL = "reference kernel"
# Demands on other holes or on other options, which take most of the time.
LONG: tuple[Demand, ...] = (far_away, options, search)
EXACT = "exact circular arcs"
SAMPLED = "the engine's sampled wall of the caliper: a wall that is no circle has no exact arcs"


class SampledHole(ExactHole):
    """The sampled wall of a case in the place of exact arcs, as the engine has it."""

    def __init__(self, case: Case) -> None:
        self.hole = build_wellbore(case)
        self.md = np.array([self.hole.md[0], self.hole.total_depth])

    def at(self, md: Array) -> tuple[Array, Array]:
        """See ``ExactHole.at``."""
        return self.hole.at(md)

    def curvatures(self, md: Array) -> Array:
        """Curvatures (n,) [1/m] of the axis at measured depths (n,) [m], between points a metre apart."""
        before, after = (self.hole.at(np.clip(md + by, *self.md))[1] for by in (-0.5, 0.5))
        return np.asarray(np.linalg.norm(after - before, axis=1))

    def radii(self, md: Array) -> Array:
        """Radii of the hole (n,) [m]: the mean of the wall around the axis at measured depths (n,) or (n, k) [m]."""
        flat = np.clip(np.ravel(md), *self.md)
        high, right = hole_frame(self.hole.at(flat)[1])
        angles = np.linspace(0, 2 * np.pi, 16, endpoint=False)
        towards = np.cos(angles)[:, None] * high[:, None] + np.sin(angles)[:, None] * right[:, None]
        return np.asarray(self.hole.radii_towards(flat, towards).mean(axis=1)).reshape(np.shape(md))

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """The contacts of a disc that rolls around the section, as the engine has them."""
        return find_contacts(self.hole, points, radii)


def hole_of(case: Case) -> tuple[ExactHole, str]:
    """What the errors of a case are measured by, and what it is."""
    if case.wellbore.geometry == "sampled":
        return SampledHole(case), SAMPLED
    return ExactHole(case.wellbore), EXACT


def points_near(hole: ExactHole, count: int, radius: float) -> Frame:
    """Points near the wall of a hole [contact radius in m]; beside a sampled one near its own wall."""
    near = frame(hole, count, radius=radius)
    if not isinstance(hole, SampledHole):
        return near
    rng = np.random.default_rng(SEED)
    outward = near.places - hole.at(near.md)[0]
    wall = near.exact
    by = rng.uniform(-BAND, BAND, count) - wall.penetration
    return Frame(hole, near.md, near.places + (by / np.linalg.norm(outward, axis=1))[:, None] * outward, near.radii)


def errors(method: ContactMethod, near: Frame) -> WallErrors:
    """Errors of a method at points, of a slow one at the first of them.

    Raises whatever the method raises, and ValueError for answers that are none.
    """
    few, spent = near.part(slice(0, FEW)), 0.0
    for _ in range(2):  # what it compiles at first does not count
        began = time.process_time()
        method.query(few.places.copy(), few.radii.copy())
        spent = (time.process_time() - began) / len(few.md)
    near = near.part(slice(0, max(int(MOST / max(spent, 1e-9)), FEW)))
    found = method.query(near.places.copy(), near.radii.copy())
    penetration, normal = (np.asarray(part, dtype=float) for part in found[:2])
    exact = near.exact
    touching = exact.penetration > 0
    if penetration.shape != exact.penetration.shape or normal.shape != exact.normal.shape:
        raise ValueError(f"query returns the shapes {penetration.shape}, {normal.shape} for {len(near.md)} points")
    known, depth, turn = deviations(near, Contacts(penetration, normal, exact.md))
    off, angle = np.abs(depth[known]), np.degrees(turn[known & touching])  # a clear point has no use for a normal
    return WallErrors(
        points=len(near.md),
        touching=int(touching.sum()),
        no_answer=int((~known).sum()),
        largest_penetration_m=float(off.max()) if known.any() else None,
        largest_angle_deg=float(np.nanmax(angle)) if np.isfinite(angle).any() else None,
        missed=int((touching & ~(penetration > 0)).sum()),
        false_contacts=int((~touching & (penetration > 0)).sum()),
    )


def contract_of(method: type[ContactMethod], chosen: Mapping[str, Any], *, quick: bool) -> tuple[list[str], list[str]]:
    """What a method breaks of the contract, and remarks; quick : without the demands LONG."""
    trial = Trial(method, chosen)
    found = [held(demand, trial) for demand in DEMANDS if not (quick and demand in LONG)]
    said = [(each.kept, f"{each.demand}: {each.says}") for each in found if each.says]
    return [text for kept, text in said if not kept], [text for kept, text in said if kept]


def costs(methods: Mapping[str, ContactMethod], near: Frame) -> tuple[dict[str, Cost], Quartiles]:
    """Processor time of a point of each method by its label, and of a column of the reference kernel [ns].

    All are asked in turns, in rounds; near : the points of a call.  A method that fails in the race has no cost.
    """
    S = reference_kernel.new_buffer()
    actions: dict[str, Callable[[], object]] = {KERNEL: lambda: reference_kernel.reference_kernel(S, PASSES)}
    counts, points = {KERNEL: PASSES * reference_kernel.COLUMNS}, dict[str, int]()
    for label, method in methods.items():
        count, calls = _points_for(method, near)
        if count:
            actions[label], counts[label] = _asking(method, near.part(slice(0, count)), calls), count * calls
            points[label] = count
    raced = race(actions, counts, ROUNDS, KERNEL, clock=time.process_time).set_index("name")

    def three(label: str, column: str) -> Quartiles:
        median, low, high = (float(raced[name][label]) for name in (column, f"{column}_low", f"{column}_high"))
        return Quartiles(median=median, low=low, high=high)

    found = {
        label: Cost(points=points[label], point_ns=three(label, "ns"), kernels=three(label, "ratio"))
        for label in methods if label in counts
    }  # fmt: skip
    return found, three(KERNEL, "ns")


def _points_for(method: ContactMethod, near: Frame) -> tuple[int, int]:
    """Points of a call, and calls of a turn, which takes SHORTEST to LONGEST; no points where the method fails."""
    try:
        method.query(near.places, near.radii)
        began = time.process_time()
        method.query(near.places, near.radii)
    except Exception:  # of a method from anywhere
        return 0, 0
    spent = max(time.process_time() - began, 1e-6)
    return max(min(int(len(near.md) * LONGEST / spent), len(near.md)), 1), max(int(SHORTEST / spent), 1)


def _asking(method: ContactMethod, near: Frame, calls: int) -> Callable[[], object]:
    places, radii = near.places.copy(), near.radii.copy()

    def ask() -> None:
        for _ in range(calls):
            method.query(places, radii)

    return ask
