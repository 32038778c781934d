"""What a call of a contact method costs around its query, and which settings no other one beats."""

from collections.abc import Callable
from typing import Any
from unittest import mock

import numpy as np
import pandas as pd

from fctd.arena.frames import Frame
from fctd.arrays import Contacts
from references.contact import ContactMethod
from references.contact.tube_mesh import MeshMethod, Tube
from references.timing.stopwatch import Action, race

OWN = "arcs"  # what others are compared with


def crossover(single: pd.Series, many: pd.Series, key: str) -> float:
    """Points in a call from which a method costs less than OWN's, by costs [ns] of one point and in a large batch."""
    gain = many[OWN] - many[key]
    if key == OWN or gain <= 0:
        return np.inf
    fixed = (single[key] - many[key]) - (single[OWN] - many[OWN])
    return float(max(fixed / gain, 1.0))


def wrapper_time(method: ContactMethod, near: Frame, times: int = 30) -> float:
    """Time [s] that a call spends around its query.

    Of a mesh: from the nearest points and faces that the library returns to contacts.  Of the others: a call without
    points.
    """
    if not isinstance(method, MeshMethod):
        return _least(lambda: method.query(near.places[:0], near.radii[:0]), times)
    original: Callable[..., Contacts] = Tube.contacts
    given: list[tuple[Any, ...]] = []

    def record(*arguments: Any) -> Contacts:
        given.append(arguments)
        return original(*arguments)

    with mock.patch.object(Tube, "contacts", record):
        method.query(near.places, near.radii)
    if not given:  # the library returns contacts
        return float("nan")
    return _least(lambda: original(*given[0]), times)


def _least(action: Action, times: int) -> float:
    return float(1e-9 * race({OWN: action}, {OWN: 1}, times, OWN)["ns"].iloc[0])


def pareto(cost: pd.Series, error: pd.Series) -> pd.Series:
    """Whether no other row is both cheaper and more accurate (n,)."""
    pairs = np.column_stack([cost, error])
    beaten = [
        bool(((pairs <= row).all(axis=1) & (pairs < row).any(axis=1)).any()) if np.isfinite(row).all() else True
        for row in pairs
    ]
    return ~pd.Series(beaten, index=cost.index)
