"""Contact methods in the hole of a case: errors at points near its wall, the contract, and what a point costs."""

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.arena.contract import DEMANDS, Demand, Trial, far_away, held, options, search
from fctd.arena.errors import Errors, errors_of
from fctd.arena.frames import Frame
from fctd.arena.method import ContactMethod
from fctd.arena.result import Cost, Quartiles, WallErrors
from fctd.arrays import Array, Contacts
from references.timing.stopwatch import Action, kernel, turn

POINTS = 2000  # near the wall, for the errors
FEW, MOST = 20, 10.0  # points that are asked first; time [s] that all of them may take
ROUNDS, FEW_ROUNDS, MANY = 15, 3, 1_000_000  # of the race; with calls of so many points
SLID = 0.5  # way of the string between two queries [m]
# [s] of a turn in the race: a slower method is asked for fewer points, a faster one several times.
LONGEST, SHORTEST = 0.1, 2e-3
LONGEST_CALL = 1.0  # [s] of a larger call than the first
KERNEL = "reference kernel"
# Demands on other holes or on other options, which take most of the time.
LONG: tuple[Demand, ...] = (far_away, options, search)


def errors(
    method: ContactMethod, near: Frame, regions: NDArray[np.str_] | None = None
) -> tuple[WallErrors, list[WallErrors]]:
    """Errors of a method at points, of a slow one at the first of them, and of the points of each region (n,).

    The method was asked before at points SLID further up, as in a string that slides: what it keeps it has from there.
    Raises whatever the method raises, and ValueError for answers that are none.
    """
    few, spent = near.part(slice(0, FEW)), 0.0
    for _ in range(2):  # what it compiles at first does not count
        began = time.process_time()
        method.query(few.places.copy(), few.radii.copy())
        spent = (time.process_time() - began) / len(few.md)
    near = near.part(slice(0, max(int(MOST / max(spent, 1e-9)), FEW)))
    method.query(near.places - SLID * near.hole.at(near.md)[1], near.radii.copy())
    found = method.query(near.places.copy(), near.radii.copy())
    hits = Contacts(*(np.asarray(part, dtype=float) for part in found))
    if hits.penetration.shape != near.md.shape or hits.normal.shape != near.places.shape:
        raise ValueError(
            f"query returns the shapes {hits.penetration.shape}, {hits.normal.shape} for {len(near.md)} points"
        )
    off = errors_of(method, near, hits)
    named = np.zeros(len(near.md), str) if regions is None else regions[: len(near.md)]
    everywhere = _wall_errors("", np.full(len(near.md), True), near, hits, off)
    return everywhere, [
        _wall_errors(region, named == region, near, hits, off) for region in dict.fromkeys(named.tolist()) if region
    ]


def _wall_errors(region: str, of: NDArray[np.bool_], near: Frame, hits: Contacts, off: Errors) -> WallErrors:
    """The errors of some points (n,)."""
    exact, found = near.exact.penetration[of], hits.penetration[of]
    touching, answered = exact > 0, off.known[of]
    missed, false = touching & ~(found > 0), ~touching & (found > 0)  # no answer counts as a miss
    depth, angle = np.abs(off.depth[of][answered]), off.angle[of]
    turned = angle[answered & touching]  # a clear point has no use for a normal
    return WallErrors(
        region=region,
        points=len(exact),
        touching=int(touching.sum()),
        no_answer=int((~answered).sum()),
        largest_penetration_m=largest(depth),
        rms_penetration_m=float(np.sqrt(np.mean(depth**2))) if len(depth) else None,
        largest_angle_deg=largest(np.degrees(turned)),
        largest_md_m=largest(np.abs(off.md[of])),
        depth_over_bound=largest(depth / off.bound[of][answered]),
        angle_over_bound=largest(turned / off.turn[of][answered & touching]),
        missed=int(missed.sum()),
        missed_beyond_m=float(np.max((exact - off.bound[of])[missed], initial=0.0)),
        false_contacts=int(false.sum()),
    )


def largest(values: Array) -> float | None:
    """The largest of values (n,) that are finite; None where none is."""
    known = values[np.isfinite(values)]
    return float(known.max()) if len(known) else None


def contract_of(method: type[ContactMethod], chosen: Mapping[str, Any], *, quick: bool) -> tuple[list[str], list[str]]:
    """What a method breaks of the contract, and remarks; quick : without the demands LONG."""
    trial = Trial(method, chosen)
    found = [held(demand, trial) for demand in DEMANDS if not (quick and demand in LONG)]
    said = [(each.kept, f"{each.demand}: {each.says}") for each in found if each.says]
    return [text for kept, text in said if not kept], [text for kept, text in said if kept]


def costs(
    methods: Mapping[str, ContactMethod], near: Frame, sizes: Sequence[int], own: str = ""
) -> tuple[dict[str, list[Cost]], Quartiles]:
    """Processor time of a point of each method by its label, in calls of each size, and that of a column of the
    reference kernel [ns].

    All are asked in turns, in rounds.  near : points of a call, drawn again where a size has more.  sizes : from few
    to many; a slow method is asked for fewer points.  own : label of the method in whose points costs are given too.
    A method that fails in the race has no cost.
    """
    found: dict[str, list[Cost]] = {label: [] for label in methods}
    columns: list[float] = []
    for size in sizes:
        given = near.part(slice(0, size) if size <= len(near.md) else _drawn(len(near.md), size))
        asked = {label: part for label, method in methods.items() if (part := _call(method, given, found[label]))}
        taken = _rounds(methods, given, asked, ROUNDS if size < MANY else FEW_ROUNDS)
        columns += taken[KERNEL].tolist()
        for label, (points, _) in asked.items():
            ns = taken[label]
            found[label].append(
                Cost(
                    points=points, point_ns=Quartiles.of(ns), kernels=Quartiles.of(ns / taken[KERNEL]),
                    arcs=Quartiles.of(ns / taken[own]) if own in taken else None,
                )
            )  # fmt: skip
    return found, Quartiles.of(columns)


def _drawn(of: int, count: int) -> NDArray[np.int64]:
    return np.random.default_rng(count).integers(0, of, count)


def _call(method: ContactMethod, given: Frame, before: Sequence[Cost]) -> tuple[int, int] | None:
    """Points of a call, and calls of a turn, which takes SHORTEST to LONGEST; None where the method is not asked."""
    count = len(given.md)
    if before:  # a larger call costs no more a point
        count = min(count, int(1e9 * LONGEST_CALL / before[-1].point_ns.median))
        if count <= before[-1].points:
            return None
    given = given.part(slice(0, count))
    try:
        method.query(given.places, given.radii)
        began = time.process_time()
        method.query(given.places, given.radii)
    except Exception:  # of a method from anywhere
        return None
    spent = max(time.process_time() - began, 1e-6)
    if not before:
        count = max(min(int(count * LONGEST / spent), count), 1)
    return count, max(int(SHORTEST / spent), 1)


def _rounds(
    methods: Mapping[str, ContactMethod], given: Frame, asked: Mapping[str, tuple[int, int]], rounds: int
) -> dict[str, Array]:
    """Times of a point in each round (rounds,) [ns] of each method, and of a column of the reference kernel."""
    work, columns = kernel()
    actions: dict[str, Action] = {KERNEL: work}
    counts = {KERNEL: columns}
    for label, (points, calls) in asked.items():
        actions[label] = _asking(methods[label], given.part(slice(0, points)), calls)
        counts[label] = points * calls
    turn(actions, counts, time.process_time, False)
    taken = [turn(actions, counts, time.process_time, k % 2 == 1) for k in range(rounds)]
    return {label: np.array([each[label] for each in taken]) for label in actions}


def _asking(method: ContactMethod, near: Frame, calls: int) -> Action:
    places, radii = near.places.copy(), near.radii.copy()

    def ask() -> None:
        for _ in range(calls):
            method.query(places, radii)

    return ask
