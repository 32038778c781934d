"""A string in its hole: whether it fits, and its rows in the engine's buffer, with the mud around it."""

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.mechanics.topdrive import GRAVITY, PerMetre
from fctd.model.drillstring import LongSegmentError, String
from fctd.model.fluids import depth_at
from fctd.model.mud import hole_radius, resistance
from fctd.model.pieces import RADIUS, TO_MD
from fctd.model.sampled_hole import narrow_cells
from fctd.model.string_rows import COMPRESSIBILITY, fill_rows
from fctd.model.wellbore import Wellbore

# A long segment hangs straight: where it lies the hole must be this close to vertical [rad].
LONG_SEGMENT_TILT = np.radians(1.0)
# Shortest segment that can be computed with [m]: the stiffness of a joint grows with the third power of 1/length, and
# below a millimetre its rounding makes stable strings unstable, or forces infinite.
SHORTEST_SEGMENT = 1e-3


def check_fit(string: String, hole: Wellbore, deepest: float) -> None:
    """Raise InputError for a string that is wider than its hole.

    Also for a long segment outside vertical hole, and for a segment that is too short to compute with.
    deepest : greatest bit depth of the run [m].
    """
    shortest = int(string.length.argmin())
    if string.length[shortest] < SHORTEST_SEGMENT:
        raise InputError(
            f"segments of at least {quantity(SHORTEST_SEGMENT, 'm')}",
            key=string.key_of(shortest),
            value=f"{quantity(string.length[shortest], 'm', '.3g')} of it in one segment",
        )
    fed = deepest - string.bit_depth if string.long_segment else 0.0
    if max(section.contact_radius for section in string.sections) > hole.narrowest:
        bottom = string.top_md + np.cumsum(string.lengthened(fed).length)
        check_clearance(string, hole, string.top_md + np.concatenate([[0.0], np.cumsum(string.length)[:-1]]), bottom)
    if string.long_segment:
        length = float(string.length[0]) + fed
        if hole.steepest_above(string.top_md + length) < LONG_SEGMENT_TILT:  # as of most wells: no need to look closer
            return
        md = np.linspace(string.top_md, string.top_md + length, 200)
        tilt = hole.inclination(md).max()
        if tilt > LONG_SEGMENT_TILT:
            raise LongSegmentError(
                "a hole within 1 deg of vertical along the top segment (a shorter trip, or more segments)",
                key=string.key_of(0),
                value=f"{quantity(length, 'm', '.4g')} at the top, in a hole of up to {np.degrees(tilt):.2f} deg",
            )


def check_end(string: String, hole: Wellbore) -> None:
    """Raise InputError for fluids that would flow through the open end of a string."""
    if string.fluids is not None:
        string.fluids.check_end(hole, string.bit_depth)


def check_clearance(string: String, hole: Wellbore, top: Array, bottom: Array) -> None:
    """Raise InputError for a string that is wider than its hole.

    top, bottom : (n,) highest and lowest measured depth that each segment reaches [m].
    """
    # Bows are pressed together; the pipe that they centre is not.
    radius = np.where(string.of("bow_stiffness") > 0, string.of("outer"), string.of("contact_radius"))
    starts = np.concatenate([[0.0], hole.intervals[:-1, TO_MD]])
    for i, (start, (to_md, wall)) in enumerate(zip(starts, hole.intervals[:, [TO_MD, RADIUS]], strict=True)):
        tight = (start < bottom) & (to_md > top) & (radius > wall)
        if tight.any():
            k = int(np.argmax(tight))
            raise InputError(
                f"at most the hole's {quantity(2e3 * wall, 'mm', '.6g')} (wellbore.intervals[{i}].diameter)",
                key=string.width_key(k),
                value=quantity(2e3 * radius[k], "mm", ".6g"),
            )
    if hole.is_round:
        return
    ends, walls = narrow_cells(hole.pieces)
    for k in range(len(radius)):
        tight = (ends[:, 0] < bottom[k]) & (ends[:, 1] > top[k]) & (radius[k] > walls)
        if tight.any():
            i = int(np.argmin(np.where(tight, walls, np.inf)))
            raise InputError(
                f"at most the {quantity(2e3 * walls[i], 'mm', '.4g')} that wellbore.caliper has at "
                f"{quantity(ends[i, 0], 'm', '.0f')}",
                key=string.width_key(k),
                value=quantity(2e3 * radius[k], "mm", ".6g"),
            )


def fill(
    S: Array, string: String, case: Case, hole: Wellbore, given: Array | None = None, squeeze: Array | None = None
) -> PerMetre:
    """Write the string into a fresh buffer; returns the pipe fed at the top.

    given (n,) : load along each segment, towards the bit [N]; squeeze (n,) : of ``squeeze_of``, by default without
    friction of the mud.  Mud that moves sideways with the string is left out;
    ``fctd.simulation.carried_mud.take_along`` adds it.
    """
    # Absurd masses and stiffnesses overflow; ``_step_limit`` refuses them, and ``not_finite`` is their steady status.
    pipe: PerMetre = fill_rows(
        S, string.length, string.component, string.table, string.weight, string.long_segment,
        damping_of(case, string, hole), squeeze_of(case, string, hole) if squeeze is None else squeeze,
        np.zeros(string.segments) if given is None else given, case.wellbore.stiffness_per_length is not None,
    )  # fmt: skip
    return pipe


def squeeze_of(case: Case, string: String, hole: Wellbore) -> Array:
    """By which share pressures and temperature shorten every segment (n,) without any effective tension.

    Steel of the area A_s has the tension T + p_i A_i − p_o A_o, and the pressures on its sides keep it from contracting
    there: its strain is T/EA + (1 − 2ν)(p_i A_i − p_o A_o)/E A_s + αΔT, with equal pressures T/EA − (1 − 2ν) p/E + αΔT.
    """
    depth = depth_at(hole, string.top_md + string.length.cumsum() - 0.5 * string.length)
    if string.fluids is None:
        squeeze = string.table[string.component, COMPRESSIBILITY] * (case.mud.density * GRAVITY * depth)
    else:
        top, bottom = string.above_bit[:-1], string.above_bit[1:]
        squeeze = squeeze_by(
            string,
            *(
                side.mean_pressure(top, bottom, depth, hole, string.bit_depth)
                for side in (string.fluids.inside, string.fluids.outside)
            ),
        )
    if case.temperature:
        rows = np.array([(row.tvd, row.change) for row in case.temperature])
        squeeze -= string.of("expansion") * np.interp(depth, rows[:, 0], rows[:, 1])
    return np.asarray(squeeze)


def squeeze_by(string: String, inside: Array, outside: Array) -> Array:
    """By which share pressures inside and outside every segment (n,) [Pa] shorten it."""
    bore, body = string.of("inner") ** 2, string.of("outer") ** 2
    pressure = outside - (inside - outside) * bore / (body - bore)
    return np.asarray(string.table[string.component, COMPRESSIBILITY] * pressure)


def excess_pressure(string: String, hole: Wellbore) -> Array:
    """Pressure inside less that outside (n + 1,) [Pa], at the top of a laid-out string and at its contact points."""
    if string.fluids is None:
        return np.zeros(string.segments + 1)
    above = string.contacts_above
    depth = depth_at(hole, string.bit_depth - above)
    inside, outside = string.fluids.pressures(above, depth, hole, string.bit_depth)
    return inside - outside


def damping_of(case: Case, string: String, hole: Wellbore) -> Array:
    """Damping by the mud per metre of every segment (n, 3): along, across [N s/m²] and about the axis [N s]."""
    mud, damping = case.mud, np.empty((string.segments, 3))
    damping[:] = mud.axial_damping or 0.0, mud.lateral_damping or 0.0, mud.rotational_damping or 0.0
    if mud.resists and mud.rotational_damping is None:
        around = hole_radius(hole, string.top_md, string.length)
        damping[:, 2] = resistance(string.of("outer"), around, mud.unsteady)
    return damping
