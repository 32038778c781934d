"""The displayed columns of results: name, label, digits and value of each.

A column's name ends in its SI unit, from which unit_systems.py derives the units of screen, pictures and field
tables.  A load that is added to ``LOADS`` appears in charts, on the screen and in the metadata of every profile.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, Final, NamedTuple

# Endings of names by unit; the order matters: a column that ends in `_N_m` is not a length.
ENDINGS: Final = ("_N_m", "_Pa", "_N", "_m", "_deg")


@cache
def _stem(name: str) -> str:
    return next((name.removesuffix(end) for end in ENDINGS if name.endswith(end)), name)


class Column(NamedTuple):
    """A column of a result.

    name : as in tables, with its unit.  label : in pictures and on the screen.  digits : after the point, where they
    are not those of its kind (`digits_of`).  heading : short label where a chart on the screen shows the column; else
    empty.  across : whether it is a length across the hole, shown in mm or in.  of : computes a load of a steady
    string, SI; without it the load is the attribute named ``stem``.  in_chart : whether a load is in charts.
    """

    name: str
    label: str
    digits: int | None = None
    heading: str = ""
    across: bool = False
    of: Callable[[Any], float] | None = None
    in_chart: bool = True

    @property
    def stem(self) -> str:
        """The name without its unit."""
        return _stem(self.name)

    def value(self, point: Any) -> float:
        """The load of a steady string, SI; point : an ``Equilibrium``."""
        return float(getattr(point, self.stem) if self.of is None else self.of(point))


# Loads of a steady string, in the order of tables.
LOADS: Final = (
    Column("hookload_N", "hook load", heading="hook load"),
    Column("surface_torque_N_m", "surface torque", heading="torque"),
    Column("weight_indicator_N", "weight indicator"),
    Column("drive_torque_N_m", "drive torque"),
    Column("total_contact_force_N", "contact force, all", heading="Σ Fₙ"),
    Column("sum_r_ft_N_m", "Σ rFₜ", in_chart=False),
    Column("sum_r_mu_fn_N_m", "Σ rμFₙ", in_chart=False),
)
# The buckled part of a string, in charts and histories.
BUCKLED: Final = (
    Column("buckled_from_md_m", "buckled from", digits=0),
    Column("buckled_to_md_m", "buckled to", digits=0),
)
# Of a buckled string whose segments follow it: hook loads of its shapes, and the shares of the friction at which a
# path of rising friction ends.
SHAPES: Final = (
    Column("hookload_low_N", "hook load, lower of both shapes"),
    Column("hookload_high_N", "hook load, higher of both shapes"),
)
SHARES: Final = (
    Column("slack_off_spent_at", "slack-off spent at"),
    Column("locked_up_at", "locked up at"),
)
CYCLES: Final = Column("cycles_per_hour", "cycles per hour", digits=0)
DEPTH: Final = Column("bit_depth_m", "bit depth", heading="bit")
PROFILE: Final = (
    Column("md_m", "measured depth"),
    Column("inclination_deg", "inclination"),
    Column("effective_tension_N", "effective tension"),
    Column("torque_N_m", "torque"),
    Column("contact_force_N", "side force at a contact"),
    Column("bending_moment_N_m", "bending moment"),
    Column("von_mises_Pa", "von Mises stress"),
    Column("offset_high_m", "low | offset | high", across=True),
    Column("offset_right_m", "left | offset | right", across=True),
    Column("clearance_m", "clearance", across=True),
)
COLUMNS: Final = {column.name: column for column in (DEPTH, *LOADS, *BUCKLED, *SHAPES, *SHARES, *PROFILE, CYCLES)}
IN_CHART: Final = tuple(load for load in LOADS if load.in_chart)


def measured_column(column: str, end: str) -> str:
    """Column of an end of a measured range, "low" or "high", beside a column such as ``hookload_N``."""
    stem = COLUMNS[column].stem
    return f"{stem}_{end}{column.removeprefix(stem)}"
