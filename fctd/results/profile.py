"""The profile of a string from the top to the bit: loads, contacts, stress and buckling limits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics.query import Walls
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.drillstring import String
from fctd.model.frames import hole_frame
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import HELICAL_LIMIT, MODE, MODES, SINUSOIDAL_LIMIT, buckling_along, pipe_of
from fctd.results.hanging_body import HANGING_COLUMNS, MOMENT, find_hanging

if TYPE_CHECKING:
    import pandas as pd

Load = float | Array


JOINT: Final = 9.144  # [m], the 30 ft to which side forces on tool joints and casing are given


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


def place_in_words(md: float, bit_depth: float, factor: float, unit: str) -> str:
    """A measured depth [m] in a unit, as "3500 m + 2 m of stretch" where it is that much deeper than the pipe tally.

    bit_depth : by the tally [m].  A string that hangs is longer than its tally, so that its bit may be deeper than the
    hole.
    """
    over = round(md * factor) - round(bit_depth * factor)
    return f"{min(md, bit_depth) * factor:.0f} {unit}" + (f" + {over} {unit} of stretch" if over > 0 else "")


def edges_of(md: Array) -> Array:
    """Ends (n + 1,) of the string that belongs to contact points at depths (n,): half way to their neighbours."""
    return np.concatenate((md[:1], 0.5 * (md[1:] + md[:-1]), md[-1:]))


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
        string.mid_contact(), string.bodies, string.table, string.body_weight, rows,
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


def von_mises_pressed(tension: Load, torque: Load, bending: Load, outer: Load, inner: Load, excess: Load) -> Any:
    """Largest von Mises stress [Pa] of a pipe whose pressure inside exceeds that outside; also compiled.

    excess [Pa], below 0 where the one outside is larger; the others as in ``von_mises``.  The pressure outside, taken
    from all normal stresses, does not change it: along the axis they then are (T + Δp A_i)/A ± M r/I, around and across
    it those of Lamé.  The stress is largest at the inner or outer wall, on one side of the bend.
    """
    bore, body = inner * inner, outer * outer
    second, hoop = np.pi / 4 * (body * body - bore * bore), excess / (body - bore)
    axial = (tension / np.pi + excess * bore) / (body - bore)
    largest = 0.0 * axial
    for radius, around, across in ((inner, hoop * (body + bore), -excess), (outer, 2 * hoop * bore, 0.0 * excess)):
        shear = torque * radius / (2 * second)
        for side in (1.0, -1.0):
            along = axial + side * bending * radius / second
            square = (along - around) ** 2 + (around - across) ** 2 + (across - along) ** 2
            largest = np.maximum(largest, 0.5 * square + 3 * shear * shear)
    return np.sqrt(largest)


def stress_along(string: String, tension: Array, torque: Array, bending: Array, excess: Array) -> Array:
    """Von Mises stress (n + 1,) [Pa] at the top and at the contact points, of loads and pressures there."""
    outer, inner = (np.append(values[0], values) for values in (string.of("worn_outer"), string.of("inner")))
    stress = von_mises(tension, torque, bending, outer, inner)
    if not excess.any():
        return np.asarray(stress)
    pressed = von_mises_pressed(tension, torque, bending, outer, inner, excess)
    return np.asarray(np.where(excess == 0, stress, pressed))


def profile_table(
    hole: Wellbore, string: String, mud_density: float, top: Array, points: Array, walls: Walls, loads: Loads,
    in_hole: bool, friction: tuple[Array, Array] | None = None,
) -> pd.DataFrame:  # fmt: skip
    """A row for the top and one per contact point.

    top (3,), points (n, 3) : upper end and contact points [m]; walls : beside them; in_hole : whether they touch;
    friction : what flow adds to the pressures inside and outside there (n + 1,) [Pa].
    """
    import pandas as pd  # slow to import, and a chart as CSV needs none

    offset, md = walls.offset, walls.md
    _, direction = hole.at(md)
    high, right = hole_frame(direction)
    up, aside = np.sum(offset * high, axis=1), np.sum(offset * right, axis=1)
    inclination = hole.inclination(np.append(string.top_md, md))

    tension, torque = at_contacts(string, loads)
    bending = hanging_along(hole, string, loads, md, in_hole)[:, MOMENT]
    # Buoyed weight gives effective tension; the true tension of the steel follows from the pressures on both sides.
    outer, inner = (np.append(values[0], values) for values in (string.of("outer"), string.of("inner")))
    depth, steel, given = np.append(top[2], points[:, 2]), np.pi * (outer**2 - inner**2), {}
    outside, excess = mud_density * GRAVITY * depth, np.zeros(len(depth))
    true_tension = tension - outside * steel
    if string.fluids is not None or friction is not None:
        inside = outside
        if string.fluids is not None:
            inside, outside = string.fluids.pressures(string.contacts_above, depth, hole, string.bit_depth)
        if friction is not None:
            inside, outside = inside + friction[0], outside + friction[1]
        excess, given = inside - outside, {"inside_pressure_Pa": inside, "outside_pressure_Pa": outside}
        true_tension = tension - outside * steel + excess * np.pi * inner**2
    clearance = walls.radius - string.contact_radius()
    buckled, _ = buckling_along(
        hole, pipe_of(string), string.top_md, md, walls.radius, loads.tension, loads.bit_tension
    )
    return pd.DataFrame(
        {
            "md_m": np.append(string.top_md, md),
            "inclination_deg": np.degrees(inclination),
            "effective_tension_N": tension,
            "true_tension_N": true_tension,
            "torque_N_m": torque,
            "contact_force_N": np.append(0.0, loads.normal),
            # A rounding error to the left of the high side is the high side, not 360°.
            "contact_angle_deg": np.append(0.0, np.degrees(np.arctan2(aside, up)) % 360 % 360),
            "bending_moment_N_m": bending,
            "offset_high_m": np.append(0.0, up),
            "offset_right_m": np.append(0.0, aside),
            "clearance_m": np.append(clearance[0], clearance),
            "von_mises_Pa": stress_along(string, tension, torque, bending, excess),
            **given,
            "sinusoidal_limit_N": buckled[:, SINUSOIDAL_LIMIT],
            "helical_limit_N": buckled[:, HELICAL_LIMIT],
            "buckling": np.array(MODES)[buckled[:, MODE].astype(int)],
        }
    )
