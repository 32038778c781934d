"""The profile of a string from the top to the bit: loads, contacts, stress and buckling limits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics.query import Walls
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.drillstring import String
from fctd.model.wellbore import Wellbore, hole_frame
from fctd.results.buckling import HELICAL_LIMIT, MODE, MODES, SINUSOIDAL_LIMIT, buckling_along, pipe_of
from fctd.results.hanging_body import HANGING_COLUMNS, MOMENT, find_hanging

if TYPE_CHECKING:
    import pandas as pd

Load = float | Array


class Loads(NamedTuple):
    """Internal loads of a string, and its contact forces.

    tension (effective) [N], torque, bending [N m] : of the n joints; normal (n,) [N] : of the contact points;
    bit_tension [N], bit_torque [N m] : at the lower end.
    """

    tension: Array
    torque: Array
    bending: Array
    normal: Array
    bit_tension: float = 0.0
    bit_torque: float = 0.0


def place_in_words(md: float, bit_depth: float, factor: float = 1.0, unit: str = "m") -> str:
    """A measured depth [m] in a unit, as "3500 m + 2 m of stretch" where it is that much deeper than the pipe tally.

    bit_depth : by the tally [m].  A string that hangs is longer than its tally, so that its bit may be deeper than the
    hole.
    """
    over = round(md * factor) - round(bit_depth * factor)
    return f"{min(md, bit_depth) * factor:.0f} {unit}" + (f" + {over} {unit} of stretch" if over > 0 else "")


def at_contacts(string: String, loads: Loads) -> tuple[Array, Array]:
    """Tension [N] and torque [N m] at the top and at the n contact points, each (n + 1,).

    They are those of the joint there, or the mean of the two beside a contact in the middle of its segment.
    """
    middle = string.mid_contact()

    def along(joints: Array, end: float) -> Array:
        below = np.append(joints[1:], end)
        return np.append(joints[0], np.where(middle, 0.5 * (joints + below), below))

    return along(loads.tension, loads.bit_tension), along(loads.torque, loads.bit_torque)


def hanging_along(hole: Wellbore, string: String, loads: Loads, md: Array, in_hole: bool) -> Array:
    """Rows (n + 1, HANGING_COLUMNS) of ``find_hanging`` at the top and at the contact points, md (n,) [m]."""
    rows = np.empty((string.segments + 1, HANGING_COLUMNS))
    # Columns of tables are compiled for separately; copied, all callers share one function.
    md, tension, bending = (np.ascontiguousarray(values) for values in (md, loads.tension, loads.bending))
    find_hanging(
        hole.bends, float(string.top_md), md, in_hole, tension, float(loads.bit_tension), bending, string.length,
        string.mid_contact(), string.component, string.table, rows,
    )  # fmt: skip
    return rows


def von_mises(tension: Load, torque: Load, bending: Load, outer: Load, inner: Load) -> Any:
    """Von Mises stress at the outer fibre [Pa]; also compiled (``limits.py``).

    tension (effective) [N], torque, bending [N m]; outer and inner radius [m].  Equal pressure on all sides adds
    the same to every normal stress, and does not change it.
    """
    steel, second = np.pi * (outer**2 - inner**2), np.pi / 4 * (outer**4 - inner**4)
    axial = np.abs(tension) / steel + bending * outer / second
    shear = torque * outer / (2 * second)
    return np.sqrt(axial**2 + 3 * shear**2)


def profile_table(
    hole: Wellbore, string: String, mud_density: float, top: Array, points: Array, walls: Walls, loads: Loads,
    in_hole: bool,
) -> pd.DataFrame:  # fmt: skip
    """A row for the top and one per contact point.

    top (3,), points (n, 3) : upper end and contact points [m]; walls : beside them; in_hole : whether they touch.
    """
    import pandas as pd  # slow to import, and a chart as CSV needs none

    offset, md = walls.offset, walls.md
    _, direction = hole.at(md)
    high, right = hole_frame(direction)
    up, aside = np.sum(offset * high, axis=1), np.sum(offset * right, axis=1)
    inclination = hole.inclination(np.append(string.top_md, md))

    def of(name: str) -> Array:
        values = string.of(name)
        return np.append(values[0], values)

    outer, inner = of("outer"), of("inner")
    tension, torque = at_contacts(string, loads)
    bending = hanging_along(hole, string, loads, md, in_hole)[:, MOMENT]
    # Buoyed weight gives effective tension; the true tension of the steel follows from the pressure of equal mud
    # inside and outside.
    pressure, steel = mud_density * GRAVITY * np.append(top[2], points[:, 2]), np.pi * (outer**2 - inner**2)
    clearance = walls.radius - string.contact_radius()
    buckled, _ = buckling_along(
        hole, pipe_of(string), string.top_md, md, walls.radius, loads.tension, loads.bit_tension
    )
    return pd.DataFrame(
        {
            "md_m": np.append(string.top_md, md),
            "inclination_deg": np.degrees(inclination),
            "effective_tension_N": tension,
            "true_tension_N": tension - pressure * steel,
            "torque_N_m": torque,
            "contact_force_N": np.append(0.0, loads.normal),
            # A rounding error to the left of the high side is the high side, not 360°.
            "contact_angle_deg": np.append(0.0, np.degrees(np.arctan2(aside, up)) % 360 % 360),
            "bending_moment_N_m": bending,
            "offset_high_m": np.append(0.0, up),
            "offset_right_m": np.append(0.0, aside),
            "clearance_m": np.append(clearance[0], clearance),
            "von_mises_Pa": von_mises(tension, torque, bending, outer, inner),
            "sinusoidal_limit_N": buckled[:, SINUSOIDAL_LIMIT],
            "helical_limit_N": buckled[:, HELICAL_LIMIT],
            "buckling": np.array(MODES)[buckled[:, MODE].astype(int)],
        }
    )
