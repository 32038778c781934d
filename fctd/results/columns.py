"""The columns of charts, profiles and runs: name, label, digits, meaning and value of each.

A column's name ends in its SI unit, from which unit_systems.py derives the units of screen, pictures and field
tables.  A load that is added to ``LOADS`` appears in charts, on the screen and in the metadata of every profile.  The
guide's tables and docstrings have the meanings.
"""

from collections.abc import Callable
from functools import cache
from inspect import getdoc
from typing import Any, Final, NamedTuple, TypeVar

# Endings of names by unit; the order matters: a column that ends in `_N_m` is not a length.
ENDINGS: Final = ("_N_m", "_Pa", "_N", "_m", "_deg")
Listed = TypeVar("Listed", bound=Callable[..., Any])


@cache
def _stem(name: str) -> str:
    return next((name.removesuffix(end) for end in ENDINGS if name.endswith(end)), name)


class Column(NamedTuple):
    """A column of a result.

    name : as in tables, with its unit.  label : in pictures and on the screen; empty: the words of the name.  digits :
    after the point, where they are not those of its kind (`digits_of`).  heading : short label where a chart on the
    screen shows the column; else empty.  across : whether it is a length across the hole, shown in mm or in.  of :
    computes a load of a steady string, SI; without it the load is the attribute named ``stem``.  in_chart : whether a
    load is in charts.  meaning : of its numbers; empty: its label says it.
    """

    name: str
    label: str = ""
    digits: int | None = None
    heading: str = ""
    across: bool = False
    of: Callable[[Any], float] | None = None
    in_chart: bool = True
    meaning: str = ""

    @property
    def stem(self) -> str:
        """The name without its unit."""
        return _stem(self.name)

    def value(self, point: Any) -> float:
        """The load of a steady string, SI; point : an ``Equilibrium``."""
        return float(getattr(point, self.stem) if self.of is None else self.of(point))


# Loads of a steady string, in the order of tables.
LOADS: Final = (
    Column("hookload_N", "hook load", heading="hook load", meaning="load at the upper end of the string"),
    Column("surface_torque_N_m", "surface torque", heading="torque", meaning="torque at the upper end of the string"),
    Column(
        "weight_indicator_N",
        "weight indicator",
        meaning="what the rig reads: hook load with block weight and the friction of its sheaves",
    ),
    Column("drive_torque_N_m", "drive torque", meaning="what the rig reads: surface torque with the drive's offset"),
    Column(
        "total_contact_force_N", "contact force, all", heading="Σ Fₙ", meaning="sum of the side forces at all contacts"
    ),
    Column("sum_r_ft_N_m", "Σ rFₜ", in_chart=False, meaning="torque of wall friction, sum of r F_t"),
    Column("sum_r_mu_fn_N_m", "Σ rμFₙ", in_chart=False, meaning="the paper's torque, sum of r μ_r F_n"),
)
# The buckled part of a string, in charts and histories.
BUCKLED: Final = (
    Column(
        "buckled_from_md_m",
        "buckled from",
        digits=0,
        meaning="first contact point beyond a buckling limit; NaN where the string is not buckled",
    ),
    Column("buckled_to_md_m", "buckled to", digits=0, meaning="last such point"),
)
# Of a buckled string whose segments follow it: hook loads of its shapes, and the shares of the friction at which a
# path of rising friction ends.
SHAPES: Final = (
    Column(
        "hookload_low_N",
        "hook load, lower of both shapes",
        meaning="hook load of the shape with the lower one; NaN where both shapes agree",
    ),
    Column("hookload_high_N", "hook load, higher of both shapes", meaning="that of the other shape"),
)
SHARES: Final = (
    Column(
        "slack_off_spent_at",
        "slack-off spent at",
        meaning="share of every friction factor, weight on bit kept, at which slack-off is spent: 0.8 is 80 % of the "
        "case's friction; NaN where not found",
    ),
    Column("locked_up_at", "locked up at", meaning="the share at which no push moves the string"),
)
CYCLES: Final = Column("cycles_per_hour", "cycles per hour", digits=0)
DEPTH: Final = Column(
    "bit_depth_m", "bit depth", heading="bit", meaning="unstretched length of the string below the rotary table"
)
# What the string does in a row, beside its operation.
DOES: Final = (
    Column("speed_m_s", "speed", meaning="of the string along the hole; the operation says which way"),
    Column("rpm", "rotation", meaning="of the string, in rev/min"),
    Column("flow_m3_s", "flow", meaning="of the pumps, 0 where they stand"),
    Column("weight_on_bit_N", "weight on bit", meaning="below 0 where a stuck bit holds the string (bit.overpull)"),
)
_MODE: Final = Column("buckling", meaning="none, sinusoidal or helical; unknown without loads")
_MD: Final = Column("md_m", "measured depth", meaning="measured depth of the contact point")
_ABOVE: Final = (
    _MD,
    Column("inclination_deg", "inclination", meaning="of the hole"),
    Column("effective_tension_N", "effective tension", meaning="what the buoyed weight loads the string with"),
)
_TORQUE: Final = Column("torque_N_m", "torque", meaning="torque in the string")
_SIDE: Final = Column("contact_force_N", "side force at a contact", meaning="force of the wall on the contact point")
_BENDING: Final = Column("bending_moment_N_m", "bending moment", meaning="largest beside the contact point")
_STRESS: Final = Column("von_mises_Pa", "von Mises stress", meaning="largest in the pipe's section")
_ACROSS: Final = (
    Column("offset_high_m", "low | offset | high", across=True, meaning="from the hole's axis to its high side"),
    Column("offset_right_m", "left | offset | right", across=True, meaning="from the hole's axis to the right"),
    Column("clearance_m", "clearance", across=True, meaning="hole radius less contact radius"),
)
PROFILE: Final = (*_ABOVE, _TORQUE, _SIDE, _BENDING, _STRESS, *_ACROSS)
COLUMNS: Final = {column.name: column for column in (DEPTH, *LOADS, *BUCKLED, *SHAPES, *SHARES, *PROFILE, CYCLES)}
IN_CHART: Final = tuple(load for load in LOADS if load.in_chart)

_LARGEST: Final = "of all steps in the interval"
_ROCK: Final = "with a bit on rock"
_HUNG: Final = "of a string that hangs from the block"
# All columns of a table, by what the table is.
TABLES: Final = {
    "chart": (
        Column("operation", meaning="kind of operation"),
        Column("friction", meaning="friction factor along the hole; NaN where intervals differ"),
        Column("rotational_friction", meaning="the factor around the hole; NaN where intervals differ"),
        Column("friction_label", meaning='the factors as a text: "0.25", "0.3/0.2", "cased 0.20, open 0.30"'),
        DEPTH, *DOES, *IN_CHART, _MODE, *BUCKLED,
        Column("shape", meaning="of a string whose segments follow its buckling: none, snaking or helix"),
        *SHAPES, *SHARES,
        Column("status", meaning="how the row ended; a row without a balance has NaN in place of loads"),
        Column("iterations", meaning="steps of the solution"),
        Column("notes", meaning="codes of what is to be known of the row, or none"),
        Column("reason", meaning="of a status other than converged, or none"),
    ),
    "profile": (
        *_ABOVE,
        Column("true_tension_N", meaning="force in the steel: effective tension + p_i A_i − p_o A_o"),
        _TORQUE, _SIDE,
        Column("contact_angle_deg", meaning="of the contact around the hole: 0 high side, 90 right"),
        _BENDING, *_ACROSS, _STRESS,
        Column("inside_pressure_Pa", meaning="of the fluid in the string, where fluids or a flow are given"),
        Column("outside_pressure_Pa", meaning="of the fluid around it"),
        Column("sinusoidal_limit_N", meaning="compression at which the string begins to snake"),
        Column("helical_limit_N", meaning="compression at which it becomes a helix"),
        _MODE,
    ),
    "history": (
        Column("time_s", meaning="end of the record interval"),
        Column("operation", meaning="kind of operation"),
        DEPTH,
        Column("bit_md_m", meaning="where the bit is along the hole"),
        *LOADS[:4], *LOADS[5:],
        Column("mud_torque_N_m", meaning="torque of the mud on the string"),
        LOADS[4],
        Column("contact_count", meaning="contact points that touch the wall at the end of the interval"),
        _MODE, *BUCKLED,
        Column("hookload_min_N", meaning=f"least hook load {_LARGEST}"),
        Column("hookload_max_N", meaning=f"largest hook load {_LARGEST}"),
        Column("surface_torque_min_N_m", meaning=f"least torque {_LARGEST}"),
        Column("surface_torque_max_N_m", meaning=f"largest torque {_LARGEST}"),
        Column("top_rpm", meaning="rotation of the upper end"),
        Column("bit_rpm", meaning="rotation of the bit"),
        Column("bit_still_s", meaning="time in which the bit did not turn"),
        Column("lateral_speed_m_s", meaning="root mean square of the speeds across the hole"),
        Column("block_position_m", meaning=f"height of the upper end above the table along the tangent, {_HUNG}"),
        Column("in_slips", meaning=f"whether the slips carry it, {_HUNG}"),
        Column("weight_on_bit_N", meaning=_ROCK),
        Column("bit_torque_N_m", meaning=_ROCK),
        Column("hole_made_m", meaning=f"depth drilled {_ROCK}"),
    ),
}  # fmt: skip


def listing(table: str) -> Callable[[Listed], Listed]:
    """Put the columns of a table of ``TABLES``, with their meanings, below the docstring of a function."""

    def listed(of: Listed) -> Listed:
        lines = (f"- {column.name}: {meaning_of(column)}" for column in TABLES[table])
        of.__doc__ = "\n".join([getdoc(of) or "", "", "Columns:", "", *lines])
        return of

    return listed


def meaning_of(column: Column) -> str:
    """What the numbers of a column mean."""
    return column.meaning or column.label


def measured_column(column: str, end: str) -> str:
    """Column of an end of a measured range, "low" or "high", beside a column such as ``hookload_N``."""
    stem = COLUMNS[column].stem
    return f"{stem}_{end}{column.removeprefix(stem)}"
