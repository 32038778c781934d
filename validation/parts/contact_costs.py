"""What a contact method costs: to build, to ask for one point, and for a point in batches of any size."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple
from unittest import mock

import numpy as np
import pandas as pd

from fctd.arrays import Array, Contacts
from references.contact import ContactMethod
from references.contact.tube_mesh import MeshMethod, Tube
from references.timing.stopwatch import Action, race

# Points in a batch, and the largest cost [ns] of a point in the batch before with which it is measured.
BATCHES = {1: np.inf, 1_000: np.inf, 100_000: 1e4, 10_000_000: 100.0}
OWN = "arcs"  # what others are compared with


class Points(NamedTuple):
    """places (n, 3) [m] and radii (n,) [m], in random order: in the order of depth a tree finds its way too easily."""

    places: Array
    radii: Array

    def batch(self, count: int) -> "Points":
        """So many of the points; drawn again where there are not so many."""
        if count <= len(self.places):
            return Points(self.places[:count], self.radii[:count])
        drawn = np.random.default_rng(count).integers(0, len(self.places), count)
        return Points(self.places[drawn], self.radii[drawn])


def batches(methods: Mapping[str, ContactMethod], points: Points, most: int, rounds: int) -> pd.DataFrame:
    """Costs of every method by its label, in turns; the method OWN is among them.

    Columns: setting, single_us (a call with one point), wrapper_us (of that, what is not the query), and for each batch
    of at most ``most`` points ns_COUNT (of a point) and measured_COUNT, False where the cost in the batch before stands
    for it; crossover : points in a call from which the method costs less than OWN's, infinite where it never does.
    """
    frame = pd.DataFrame({"setting": list(methods)}).set_index("setting")
    frame["last"] = 0.0
    for count, dearest in BATCHES.items():
        if count > most:
            continue
        given = points.batch(count)
        asked = frame.index[frame["last"] < dearest]
        actions = {key: _asking(methods[key], given) for key in asked}
        table = race(actions, dict.fromkeys(actions, count), rounds if count < 1e6 else 1, OWN)
        measured = table.set_index("name")["ns"]
        frame.loc[measured.index, "last"] = measured
        frame[f"ns_{count}"], frame[f"measured_{count}"] = frame["last"], frame.index.isin(measured.index)
    single, many = frame["ns_1"], frame["last"]
    frame["single_us"] = 1e-3 * single
    frame["wrapper_us"] = [1e6 * wrapper_time(method, points.batch(1)) for method in methods.values()]
    frame["crossover"] = [crossover(single, many, key) for key in methods]
    return frame.drop(columns=["last", "ns_1", "measured_1"]).reset_index()


def crossover(single: pd.Series, many: pd.Series, key: str) -> float:
    """Points in a call from which a method costs less than OWN's, by costs [ns] of one point and in a large batch."""
    gain = many[OWN] - many[key]
    if key == OWN or gain <= 0:
        return np.inf
    fixed = (single[key] - many[key]) - (single[OWN] - many[OWN])
    return float(max(fixed / gain, 1.0))


def wrapper_time(method: ContactMethod, points: Points, times: int = 30) -> float:
    """Time [s] that a call spends around its query.

    Of a mesh: from the nearest points and faces that the library returns to contacts.  Of the others: a call without
    points.
    """
    empty = Points(points.places[:0], points.radii[:0])
    if not isinstance(method, MeshMethod):
        return _least(_asking(method, empty), times)
    original: Callable[..., Contacts] = Tube.contacts
    given: list[tuple[Any, ...]] = []

    def record(*arguments: Any) -> Contacts:
        given.append(arguments)
        return original(*arguments)

    with mock.patch.object(Tube, "contacts", record):
        method.query(*points)
    if not given:  # the library returns contacts
        return float("nan")
    return _least(lambda: original(*given[0]), times)


def _least(action: Action, times: int) -> float:
    return float(1e-9 * race({OWN: action}, {OWN: 1}, times, OWN)["ns"].iloc[0])


def _asking(method: ContactMethod, points: Points) -> Action:
    return lambda: method.query(*points)


def pareto(cost: pd.Series, error: pd.Series) -> pd.Series:
    """Whether no other row is both cheaper and more accurate (n,)."""
    pairs = np.column_stack([cost, error])
    beaten = [
        bool(((pairs <= row).all(axis=1) & (pairs < row).any(axis=1)).any()) if np.isfinite(row).all() else True
        for row in pairs
    ]
    return ~pd.Series(beaten, index=cost.index)
