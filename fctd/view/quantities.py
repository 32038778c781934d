"""What a view colours the string by."""

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError, nearest
from fctd.plots.tracks import scale_of, side_force_unit
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import Shown, System, shown_if_any

Scale = Literal["magnitude", "nearness", "signed", "modes"]

# Light to dark, so that they are told apart in grey and by colour-blind readers.
_WARM: Final = ((0.0, "#c4c4c4"), (0.25, "#f0b27a"), (0.5, "#e06a2a"), (0.75, "#b43600"), (1.0, "#5c1400"))
COLOURS: Final[dict[Scale, tuple[tuple[float, str], ...]]] = {
    "magnitude": _WARM,
    "nearness": tuple((1.0 - at, colour) for at, colour in reversed(_WARM)),
    "signed": ((0.0, "#004C98"), (0.5, "#c4c4c4"), (1.0, "#B43600")),
    "modes": (
        (0.0, "#c4c4c4"), (0.34, "#c4c4c4"), (0.34, "#f08a24"), (0.67, "#f08a24"), (0.67, "#5c1400"), (1.0, "#5c1400"),
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Quantity:
    """A quantity of a string; column : of ``Snapshot.columns``; scale : how values become colours."""

    name: str
    label: str
    column: str
    scale: Scale = "magnitude"

    def shown(self, units: System) -> Shown:
        """Factor and unit in which it is shown."""
        if self.column == "side_force":
            return side_force_unit(units, "length")
        return shown_if_any(self.column, units)

    def limits(self, values: Array, lengths: Array) -> tuple[float, float]:
        """Values of the first and the last colour, in the same unit.

        values (n,) : of all strings of a view; lengths (n,) : of string that has each.
        """
        if self.scale == "modes":
            return -0.5, 2.5
        at = np.isfinite(values)
        most = (scale_of(values[at], lengths[at]) if at.any() else 0.0) or 1.0
        return (-most if self.scale == "signed" and values[at].min(initial=0.0) < 0 else 0.0), most

    def colours(self, low: float) -> tuple[tuple[float, str], ...]:
        """The colour scale; low : value of the first colour, 0 for a signed quantity that is never negative."""
        return COLOURS["magnitude" if self.scale == "signed" and low == 0 else self.scale]


QUANTITIES: Final = {
    quantity.name: quantity
    for quantity in (
        Quantity("side_force", "side force per length", "side_force"),
        Quantity("tension", COLUMNS["effective_tension_N"].label, "effective_tension_N", "signed"),
        Quantity("torque", COLUMNS["torque_N_m"].label, "torque_N_m", "signed"),
        Quantity("bending", COLUMNS["bending_moment_N_m"].label, "bending_moment_N_m"),
        Quantity("clearance", "distance to the wall", "gap_m", "nearness"),
        Quantity("buckling", "buckling", "buckling", "modes"),
        Quantity("stress", COLUMNS["von_mises_Pa"].label, "von_mises_Pa"),
    )
}


def quantity_of(name: str, key: str = "colour") -> Quantity:
    """A quantity by its name; raises InputError, which names ``key``."""
    if name not in QUANTITIES:
        raise InputError(nearest(name, QUANTITIES, "quantity"), key=key, value=name)
    return QUANTITIES[name]
