"""Facts of objects: what is put back is what was there, with its types."""

from typing import NamedTuple

import numpy as np

from fctd.store.facts import Restorable, pack, unpack


class Pair(NamedTuple):
    """A pair of an array and a number."""

    array: np.ndarray
    number: float


class Part(Restorable):
    """A part of an object."""

    FACTS = ("count",)

    def __init__(self) -> None:
        self.count = 0


class Whole(Restorable):
    """An object with fields of all kinds, of which one is not kept."""

    FACTS = ("number", "pair", "plain", "rows", "none", "part", "text")

    def __init__(self) -> None:
        self.number, self.pair, self.plain = 0.0, Pair(np.zeros(0), 0.0), (0.0, 0)
        self.rows: list[int] = []
        self.none: object = None
        self.part, self.text, self.other = Part(), "", 1


def changed() -> Whole:
    whole = Whole()
    whole.number, whole.plain = float(np.float64(0.1) + np.float64(0.2)), (float("inf"), np.int64(3))
    whole.pair = Pair(np.array([np.pi, np.nan, -0.0]), np.float64(1e-300))
    whole.rows, whole.text, whole.part.count, whole.other = [1, 2], "ä", 7, 2
    return whole


def test_every_fact_is_put_back_bit_by_bit() -> None:
    again, read = Whole(), unpack(pack(changed().facts()))
    again.restore(read)
    assert (again.number, again.plain, again.rows) == (0.1 + 0.2, (float("inf"), 3), [1, 2])
    assert type(again.pair) is Pair
    np.testing.assert_array_equal(again.pair.array.view(np.int64), np.array([np.pi, np.nan, -0.0]).view(np.int64))
    assert (again.pair.number, again.none, again.part.count, again.text) == (1e-300, None, 7, "ä")
    assert again.other == 1
