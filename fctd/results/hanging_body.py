"""Bending of pipe between its tool joints, which touch, while its body hangs between them.

In a bend of the hole the body turns as far as the hole does, but not evenly: in tension at the tool joints, where its
curvature is that of the hole times KL/tanh KL (Lubinski 1961), in compression in its middle, times KL/sin KL, with
K = √(|T|/EI) and L half of a joint.  Its lateral weight bends it as a beam that is clamped at both ends.  A tool joint
bends less than the body for a moment: the body between them, of half length l, has most of the turn, and factors of Kl.

A coarse string, whose contact points lie where its segments end, knows the mean curvature alone; these closed forms
correct its bending moment.  Of a body that touches the wall ``touching_body`` has the bending.

Of a string that resolves its joints (``model.joints``) the moment is computed, and a tool joint has the larger one of
its ends, where bodies begin.  A body of few segments is too soft there: under tension it turns as if its end gave way
along half of the first segment.  The moment is that of the beam which the same turn of the tool joint bends.
"""

import math
from typing import Final

import numpy as np

from fctd.mechanics.jit import entry, inlined, kernel
from fctd.model.string_rows import (
    CONTACT_RADIUS,
    EI,
    INNER,
    JOINT,
    OUTER,
    POINT,
    TOOL_JOINT,
    YIELD_STRENGTH,
)
from fctd.results.buckling import course_of, tangent_of
from fctd.results.touching_body import bend_touching

# Columns of a row: largest bending moment of the pipe there [N m]; share of the way to the wall that its body takes,
# infinite where a compressed body buckles between its tool joints; the moment with joints of ``USUAL`` length where a
# section has tool joints and does not say how far apart they are, 0 where it matters little [N m].
MOMENT, TAKEN, ASSUMED = range(3)
HANGING_COLUMNS = 3
# Length of a joint of range 2, and of its tool joint [m].
USUAL, USUAL_TOOL_JOINT = 9.5, 0.5
# Below, factors are those of their series: rounding takes more digits than these leave out.
SMALL: Final = 0.02
# Beyond this share of π a compressed body has no finite bending.
FINITE: Final = 0.98
# Below this share of the yield strength by tension and bending the assumed moment is left out, as it costs a tenth of a
# row: only torque near the pipe's own limit would bring such a place to yield.
LITTLE: Final = 0.5


@inlined
def factors_of(x, tensile):
    """Factors of a body by x = Kl: bending by the hole's curvature at the tool joint and in the middle, bending there
    by a lateral load q over q l², and how far the middle is from the chord of its ends, over θ l for a turn of the ends
    by θ, and over q l⁴/EI."""
    if x < SMALL:
        square = x * x if tensile else -x * x
        return (
            1 + square / 3,
            1 - square / 6,
            1 / 3.0 - square / 45,
            -1 / 6.0 + square * 7 / 360,
            0.5 - square / 24,
            1 / 24.0,
        )
    if tensile:
        if x > 300.0:
            return x, 0.0, (x - 1) / x**2, -1 / x**2, 1 / x, (0.5 * x - 1) / x**3
        end, middle, half = x / math.tanh(x), x / math.sinh(x), math.tanh(0.5 * x)
        return end, middle, (end - 1) / x**2, (middle - 1) / x**2, half / x, (0.5 * x - half) / x**3
    end, middle, half = x / math.tan(x), x / math.sin(x), math.tan(0.5 * x)
    return end, middle, (1 - end) / x**2, (1 - middle) / x**2, half / x, (half - 0.5 * x) / x**3


@inlined
def length_of(x, y, z):
    """Of a vector."""
    return math.sqrt(x * x + y * y + z * z)


@inlined
def bend_body(tension, own, stiffness, joint, tool_joint, give, room, kx, ky, kz, qx, qy, qz):
    """Bending moment of a body [N m] and the share of its room that it takes.

    own : the bending moment of the mean curvature [N m]; joint, tool_joint : lengths [m]; give : curvature of the tool
    joint over that of a body with its moment; room : by which the tool joints stand out [m]; k : curvature of the hole
    [1/m], of which the direction counts; q : lateral weight [N/m].
    """
    half, free = 0.5 * joint, 0.5 * (joint - tool_joint)
    x = math.sqrt(abs(tension) / stiffness) * free
    if tension < 0 and x > FINITE * math.pi:
        return own, np.inf
    end, middle, end_by_load, middle_by_load, turned, sagged = factors_of(x, tension >= 0)
    # The tool joint gives way by the moment of the load too.
    soft = 0.5 * tool_joint * give / free
    left = 1 / (1 + soft * end)
    end_by_load *= left
    middle_by_load -= soft * middle * end_by_load
    sagged += soft * turned * end_by_load
    # The curvature that the string has, in the plane in which the hole bends; in straight hole in that of the weight,
    # where it does most.
    curvature, bent, load = own / stiffness, length_of(kx, ky, kz), length_of(qx, qy, qz)
    ux, uy, uz = 0.0, 0.0, 0.0
    if bent > 1e-7:
        ux, uy, uz = kx / bent, ky / bent, kz / bent
    elif load > 0:
        ux, uy, uz = qx / load, qy / load, qz / load
    kx, ky, kz = curvature * ux, curvature * uy, curvature * uz
    turns = half * left  # of the body, in the hole's curvature
    by_turn, by_load = stiffness * turns / free, free * free
    at_end = length_of(
        by_turn * end * kx + by_load * end_by_load * qx, by_turn * end * ky + by_load * end_by_load * qy,
        by_turn * end * kz + by_load * end_by_load * qz,
    )  # fmt: skip
    in_middle = length_of(
        by_turn * middle * kx + by_load * middle_by_load * qx, by_turn * middle * ky + by_load * middle_by_load * qy,
        by_turn * middle * kz + by_load * middle_by_load * qz,
    )  # fmt: skip
    # The hole's arc is half² κ/2 from its chord; the tool joints lie on the side to which tension and weight press.
    of_turn, of_load = free * (0.5 * free - turns * turned), sagged * free**4 / stiffness
    dx, dy, dz = of_turn * kx + of_load * qx, of_turn * ky + of_load * qy, of_turn * kz + of_load * qz
    px, py, pz = tension * kx + qx, tension * ky + qy, tension * kz + qz
    pressed = length_of(px, py, pz)
    towards = (dx * px + dy * py + dz * pz) / pressed if pressed > 0 else 0.0
    if towards <= room:
        return max(at_end, in_middle), max(towards, 0.0) / room
    # The wall holds it back in the direction of the load; across that it bends as it would without.
    bent = (kx * px + ky * py + kz * pz) / pressed
    across = turns / free * math.sqrt(max(curvature * curvature - bent * bent, 0.0))
    at_end, in_middle, between, place = bend_touching(
        tension, stiffness, free, 0.5 * tool_joint, give, bent, pressed, room
    )
    place *= x / free
    there = middle * (math.cosh(min(place, 300.0)) if tension >= 0 else math.cos(place))
    most = max(
        length_of(bent + at_end, across * end, 0.0), length_of(bent + in_middle, across * middle, 0.0),
        length_of(bent + between, across * there, 0.0),
    )  # fmt: skip
    return stiffness * most, towards / room


@inlined
def give_of(outer, inner, tool_joint):
    """Curvature of a tool joint over that of the body with the same moment, by their radii [m]; same steel and bore."""
    return (outer**4 - inner**4) / (tool_joint**4 - inner**4)


@inlined
def may_yield(row, weight, tension, own):
    """Whether usual joints may stress pipe of a section beyond half of its yield strength, by bounds without its place.

    In tension x/tanh x is below 1 + x, and the sag below that of a beam without tension; compression up to x = 1.5
    raises bending by a half, and the sag by a fifth.
    """
    half, free = 0.5 * USUAL, 0.5 * (USUAL - USUAL_TOOL_JOINT)
    x = math.sqrt(abs(tension) / row[EI]) * free
    if tension < 0 and x > 1.5:
        return True
    raised = 1 + x if tension >= 0 else 1.6
    most = half / free * own * raised + 0.4 * abs(weight) * free * free
    outer, inner = row[OUTER] * row[OUTER], row[INNER] * row[INNER]
    normal = (abs(tension) + 4 * most * row[OUTER] / (outer + inner)) / (math.pi * (outer - inner))
    return normal > LITTLE * row[YIELD_STRENGTH]


@inlined
def beside(joints, end, middle, j):
    """A load of the joints at contact point j, as ``profile.at_contacts`` has it."""
    below = joints[j + 1] if j + 1 < len(joints) else end
    return 0.5 * (joints[j] + below) if middle[j] else below


@inlined
def is_tool_joint(row):
    """Whether a section is that of a tool joint which is a segment of its own."""
    return row[TOOL_JOINT] > 0 and row[JOINT] == 0


@kernel
def stiffer(tension, length, component, sections, j, up):
    """Moment of a beam at the end of the body above or below tool joint j, over that of its segments [1].

    tension [N]; length, component (n,), sections : of the string; up : 1 for the body below, −1 for that above.  Both
    are turned at their ends by the same angle, about their middle; the tool joint gives way by half of its own length.
    """
    first, n = j + up, 0
    body = component[first]
    total = 0.0
    while 0 <= first + up * n < len(length) and component[first + up * n] == body:
        total += length[first + up * n]
        n += 1
    x = 0.5 * total * math.sqrt(max(tension, 0.0) / sections[body, EI])
    if x < SMALL:
        return 1.0
    own = 0.5 * length[j] / sections[component[j], EI]
    beam = 0.5 * total * math.tanh(x) / (x * sections[body, EI])
    # From the middle outwards: what the part within turns by for a moment at its end.
    turn = 0.0 if n % 2 else 0.5 * length[first + up * (n // 2)] / sections[body, EI]
    for i in range((n - 1) // 2 if n % 2 else n // 2 - 1, -1, -1):
        h = length[first + up * i]
        if not (n % 2 and i == n // 2):  # the middle one of an odd number does not turn
            turn = turn / (1 + tension * h * turn)
        outer = length[first + up * (i - 1)] if i else 0.0
        turn += 0.5 * (h + outer) / sections[body, EI]
    return (own + turn) / (own + beam)


@entry
def find_hanging(
    bends, top_md, md, in_hole, tension, bit_tension, bending, length, middle, component, sections, body_weight, rows
):
    """Update rows (n + 1, HANGING_COLUMNS) of the top and the n contact points given hole, string and loads.

    bends : of the hole, md (n,) [m] : of the contact points; tension (effective) [N], bending [N m] : of the n joints;
    length [m], middle, component (n,), sections, body_weight (n,) [N/m] : of the string.
    """
    k = 0
    for i in range(len(md) + 1):
        j = max(i - 1, 0)
        own = beside(bending, 0.0, middle, j) if i else bending[0]
        pull = beside(tension, bit_tension, middle, j) if i else tension[0]
        rows[i, MOMENT], rows[i, TAKEN], rows[i, ASSUMED] = own, 0.0, 0.0
        row, weight = sections[component[j]], body_weight[j]  # the wall carries that of the tool joints
        joint, tool_joint, room = row[JOINT], row[TOOL_JOINT], row[CONTACT_RADIUS] - row[OUTER]
        given = joint > 0
        if is_tool_joint(row) and i and middle[j]:
            below = bending[j + 1] * stiffer(tension[j + 1], length, component, sections, j, 1)
            above = bending[j] * stiffer(tension[j], length, component, sections, j, -1) if j else 0.0
            rows[i, MOMENT] = max(above, below)
        elif i and j + 1 < len(component) and is_tool_joint(sections[component[j + 1]]) and not given and not middle[j]:
            rows[i, MOMENT] = own * stiffer(pull, length, component, sections, j + 1, -1)
        if not in_hole or room <= 0 or row[POINT] != 0 or not (given or may_yield(row, weight, pull, own)):
            continue
        s = md[j] if i else top_md
        k = course_of(bends, k, s)
        tx, ty, tz, bx, by, bz = tangent_of(bends, k, s)
        moment, taken = bend_body(
            pull, own, row[EI], joint if given else USUAL, tool_joint if given else USUAL_TOOL_JOINT,
            give_of(row[OUTER], row[INNER], row[CONTACT_RADIUS]), room,
            bx, by, bz, -weight * tz * tx, -weight * tz * ty, weight * (tx * tx + ty * ty),
        )  # fmt: skip
        if given:
            rows[i, MOMENT], rows[i, TAKEN] = max(moment, own), taken
        else:
            rows[i, ASSUMED] = moment
