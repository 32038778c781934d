"""Holes with calipers for tests: a bent hole, cased above, whose lower part was measured."""

from collections.abc import Callable

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model.wellbore import Wellbore, build_wellbore
from tests.cases import make_case, pipe

BEND = [[0, 0, 0], [300, 0, 0], [600, 60, 40], [1000, 95, 130]]
BORE = 0.2159
SIZES = [
    {"to_md": 500, "diameter": 0.3, "friction": 0.2, "stiffness": 2e7, "kind": "cased"},
    {"to_md": 1000, "diameter": BORE, "friction": 0.3, "kind": "open"},
]
FIRST, LAST = 520.0, 740.0  # measured [m]


def bent_case(geometry: str, **wellbore: object) -> Case:
    hole = {"geometry": geometry, "intervals": SIZES, **wellbore}
    return make_case(BEND, [pipe(1000.0, 100)], wellbore=hole)


def bent_hole(geometry: str) -> Wellbore:
    return build_wellbore(bent_case(geometry))


def sampled_case(radii: Callable[[Array], Array], spacing: float = 0.5, cell: float = 0.1) -> Case:
    """The bent hole with radii (n, arms) [m] at measured depths (n,) [m], the first on the high side."""
    md = np.arange(FIRST, LAST + 1e-9, spacing)
    rows = np.column_stack([md, radii(md)]).tolist()
    return bent_case("sampled", cell=cell, caliper={"rows": rows, "values": "radius"})


def sampled_hole(radii: Callable[[Array], Array], spacing: float = 0.5, cell: float = 0.1) -> Wellbore:
    return build_wellbore(sampled_case(radii, spacing, cell))


def rough(seed: int, arms: int = 12, size: float = 0.004) -> Callable[[Array], Array]:
    """A wall that is rough by ``size`` [m]."""

    def radii(md: Array) -> Array:
        rng = np.random.default_rng(seed)
        return np.asarray(0.5 * BORE + size * (1 + rng.normal(size=(len(md), arms))))

    return radii
