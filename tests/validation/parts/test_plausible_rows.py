"""Plausible strings: the same for a seed, and of every class, in depths and operations that they can have."""

import numpy as np

from fctd import Case
from fctd.steady.equilibrium import Solver
from validation.parts.plausible_rows import CLASSES, DEEPEST, SHALLOWEST, drawn
from validation.parts.recorded_kinds import RECORDED_KINDS

COUNT = 600


def test_a_seed_gives_the_same_strings() -> None:
    assert drawn(1, 30) == drawn(1, 30)
    assert drawn(1, 30) != drawn(2, 30)


def test_strings_are_of_all_classes_depths_and_operations() -> None:
    strings = [drawn(14, k) for k in range(COUNT)]
    assert len(CLASSES) == 12
    assert {string.kind for string in strings} == set(CLASSES)
    assert {kind for string in strings for kind in string.rates} == set(RECORDED_KINDS)
    depths = np.array([string.bit_depth for string in strings])
    assert depths.min() >= SHALLOWEST
    assert depths.max() <= DEEPEST
    assert np.percentile(depths, [5, 95]).tolist() > [100.0, 4000.0]


def test_every_string_fits_its_hole() -> None:
    for k in range(24):
        string = drawn(14, k)
        laid = Solver(Case.model_validate(string.case)).lay_out(string.bit_depth)
        assert laid.string.segments >= 3, string.kind
