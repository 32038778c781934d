"""What is read from a steady string in balance: loads at its top, sums along it, walls, buckling, doubts."""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics.jit import entry
from fctd.mechanics.query import WALL_COLUMNS, query_sampled, query_walls
from fctd.mechanics.state import SAMPLED
from fctd.results.buckling import NEITHER, ROW_COLUMNS, find_buckling
from fctd.results.hanging_body import HANGING_COLUMNS, find_hanging
from fctd.results.limits import LIMITS, WORST, find_shares
from fctd.steady.tangent import (
    AXIAL_MOMENT,
    CONTACT_COLUMNS,
    JOINT_BENDING,
    JOINT_COLUMNS,
    JOINT_TENSION,
    JOINT_TORQUE,
    NORMAL_FORCE,
    R_FT,
    R_MU_FN,
    read_loads,
)

# Columns of the arrays of a shape, beside those of ``read_loads`` and ``query_walls``.
SHAPE_COLUMNS = JOINT_COLUMNS, CONTACT_COLUMNS, WALL_COLUMNS
# Numbers of a shape: sums of normal force [N], r F_t and r μ F_n [N m]; the first segment that is deeper in the wall
# than the hole's radius, or 0; of ``find_buckling`` mode, measured depths of the first and the last buckled row [m],
# longest segment that is too long, length needed [m], excess; whether there are notes, and the largest shares of
# limits, of ``find_shares``.
SUM_NORMAL, SUM_R_FT, SUM_R_MU_FN, OUTSIDE, MODE, FROM_MD, TO_MD, LONGEST, NEEDED, EXCESS, NOTED, SHARES = range(12)
NUMBERS = SHARES + len(LIMITS) * WORST
# Numbers of an answer: whether it is a stable balance of the first attempt, iterations, hook load [N], surface torque
# [N m], largest force out of balance [N] and its allowed value [N], the place of the string's top [m], and then those
# of its shape.
SOLVED, STEPS, HOOKLOAD, TORQUE, IMBALANCE, ALLOWED, TOP, SHAPE = 0, 1, 2, 3, 4, 5, 6, 9
ANSWER = SHAPE + NUMBERS


class Answer(NamedTuple):
    """What is read from a steady string: numbers (ANSWER,), and joints, contacts and walls (n, ...)."""

    numbers: Array
    joints: Array
    contacts: Array
    walls: Array


@entry
def read_top(S, n, P, kinks, C, owner, laws, R, pipe, top_length, axis, joints, contacts):
    """Fill joints (n + 1, ...) and contacts (n + 1, ...) of ``read_loads``; returns hook load [N], torque [N m] and the
    largest force out of balance [N].

    R : of ``assemble``; pipe : fed at the top, top_length [m] : of a long segment, else 0; axis (3,) : of the hole at
    the string's top.
    """
    read_loads(S, n, P, kinks, C, owner, laws, joints, contacts)
    # Half of a long segment is lumped at the top: the top drive carries its weight, mud load and given load.
    half = 0.5 * top_length
    hung = half * (pipe.weight - pipe.mud_axial * laws.speed + laws.given * pipe.given)
    resisted = half * pipe.mud_spin * laws.spin
    joints[1, JOINT_TENSION] += hung
    joints[1, JOINT_TORQUE] += resisted
    hookload = R[0, 0] * axis[0] + R[0, 1] * axis[1] + R[0, 2] * axis[2] + hung
    worst = 0.0
    for j in range(1, n + 1):
        force = np.sqrt(R[j, 0] ** 2 + R[j, 1] ** 2 + R[j, 2] ** 2)
        if not force <= worst:  # NaN is the largest
            worst = force
    return hookload, resisted - R[0, AXIAL_MOMENT], worst


@entry
def read_shape(
    C, geometry, in_hole, bends, top_md, pipe, radius, sections, component, body_weight, excess, bit_tension,
    bit_torque, hookload, owner, joints, contacts, walls, numbers,
):  # fmt: skip
    """Fill walls (n, WALL_COLUMNS) and numbers (NUMBERS,) of a string with loads joints (n, ...), contacts (n, ...).

    bends : of the hole; pipe : ``buckling.Pipe``; radius (n,) : at the contact points [m]; sections : a row for each
    part of the string, component (n,) : that of each segment; body_weight (n,), excess (n + 1,) : see
    ``batch.Strings``; owner (n,) : pieces of the hole near the contact points.
    """
    n = len(joints)
    if geometry == SAMPLED:
        query_sampled(C, contacts[:, :3].copy(), radius, owner.copy(), walls, np.empty((n, 3)))
    else:
        query_walls(C, geometry, contacts[:, :3].copy(), owner.copy(), walls)
    numbers[:] = 0.0
    least = bit_tension
    for j in range(n):
        numbers[SUM_NORMAL] += contacts[j, NORMAL_FORCE]
        numbers[SUM_R_FT] += contacts[j, R_FT]
        numbers[SUM_R_MU_FN] += contacts[j, R_MU_FN]
        offset = np.sqrt(walls[j, 0] ** 2 + walls[j, 1] ** 2 + walls[j, 2] ** 2)
        # The limit of a string in motion (faults.py): deeper in the wall than the hole's radius.
        if numbers[OUTSIDE] == 0 and offset + radius[j] > 2 * walls[j, 3]:
            numbers[OUTSIDE] = j + 1
        least = min(least, joints[j, JOINT_TENSION])
    rows, md, hanging = np.empty((n + 1, ROW_COLUMNS)), walls[:, 6].copy(), np.empty((n + 1, HANGING_COLUMNS))
    find_hanging(
        bends, top_md, md, in_hole, joints[:, JOINT_TENSION].copy(), bit_tension, joints[:, JOINT_BENDING].copy(),
        pipe.length, pipe.middle, component, sections, body_weight, hanging,
    )  # fmt: skip
    numbers[NOTED] = find_shares(
        joints[:, JOINT_TENSION], joints[:, JOINT_TORQUE], hanging, bit_tension, bit_torque, hookload, walls[:, :3],
        walls[:, 3], radius, in_hole, pipe.middle, component, sections, excess,
        numbers[SHARES:].reshape(-1, WORST),
    )  # fmt: skip
    if not in_hole or least >= 0:
        return
    mode, first, last, longest, needed, excess = find_buckling(
        bends, top_md, md, walls[:, 3].copy(), joints[:, JOINT_TENSION].copy(), bit_tension, pipe.EI, pipe.weight,
        pipe.radius, pipe.length, pipe.middle, rows,
    )  # fmt: skip
    if mode != NEITHER:
        numbers[MODE], numbers[LONGEST], numbers[NEEDED], numbers[EXCESS] = mode, longest, needed, excess
        numbers[FROM_MD] = md[first - 1] if first else top_md
        numbers[TO_MD] = md[last - 1] if last else top_md
