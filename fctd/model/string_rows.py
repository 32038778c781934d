"""The segments of a string as rows of the engine's buffer: masses, arms, contact points, damping, stiffness (§5.1).

A string is given by the length [m] and the component (n,) of its segments, from the top down, and a table of
``section.Section``, a row for each component.  Sums and products are rounded as in numpy.
"""

from fctd.mechanics import state
from fctd.mechanics.jit import entry, rounded
from fctd.mechanics.topdrive import PerMetre, set_long_segment

# Columns of a table of sections: the fields of ``section.Section``.
MASS, WEIGHT, AXIAL_INERTIA, TILT_INERTIA, EA, GJ, EI, SHEAR, OUTER, INNER, CONTACT_RADIUS, YIELD_STRENGTH = range(12)
ECCENTRICITY, POINT, COMPRESSIBILITY, JOINT, TOOL_JOINT, MAKE_UP, BODY_WEIGHT, DENSITY, BODY_MASS = range(12, 21)
EXPANSION, BURST, COLLAPSE, WAVE_WEIGHT, WAVE_MASS, WAVE_STIFFNESS, WAVE_RADIUS = range(21, 28)
OWN_FRICTION, BOW_STIFFNESS, STARTING_FORCE, SWIVEL, WORN_OUTER, YIELDS_EARLIER = range(28, 34)
# What is left of the torsional stiffness of a swivel [N m/rad]: a thousand turns give it 6 N m.
RELEASED = 1e-3


@rounded
def radius_along(component, sections, k):
    """Contact radius [m] of component k along its length: a point, but where it touches, is as wide as its sleeves.

    These are the next components above and below that are no points; the point is never wider than itself.
    """
    radius = sections[k, CONTACT_RADIUS]
    if sections[k, POINT] == 0:
        return radius
    for direction in (1, -1):
        i = k + direction
        while 0 <= i <= component[0] and sections[i, POINT] != 0:
            i += direction
        if 0 <= i <= component[0]:
            radius = min(radius, sections[i, CONTACT_RADIUS])
    return radius


@rounded
def contact_point(length, component, sections, long_segment, j):
    """Whether segment j touches at its middle, radius of its contact point, length whose wall force it bears [m].

    It touches at its lower end, with the larger radius of unlike neighbours, and bears half of each neighbouring
    segment, none of a long one.  A component that is a point touches with its own radius, and bears all of its wall
    force, at its middle: within a segment, or at the joint of two; the bit at its end.
    """
    last, k = len(length) - 1, component[j]
    if sections[k, POINT] != 0 and not (long_segment and j == 0):
        first, end, whole = j, j, length[j]
        while first > 0 and component[first - 1] == k:
            first -= 1
            whole += length[first]
        while end < last and component[end + 1] == k:
            end += 1
            whole += length[end]
        count = end - first + 1
        in_middle = k != 0 and count % 2 == 1
        if j == (last if k == 0 else first + (count - 1) // 2):
            return in_middle, sections[k, CONTACT_RADIUS], whole
    radius = radius_along(component, sections, k)
    if j < last:
        radius = max(radius, radius_along(component, sections, component[j + 1]))
    above = 0.0 if long_segment and j == 0 else length[j]
    return False, radius, 0.5 * (above + (length[j + 1] if j < last else 0.0))


@rounded
def joint_stiffness(length, component, sections, long_segment, column, j):
    """Stiffness of the joint above segment j for a stiffness per length (Eqs 17–19): half segments in series.

    The first joint is the clamp at the top drive, half a segment away; a long segment puts its whole length there, and
    the next joint has only the half segment below it.
    """
    compliance = 0.5 * length[j] / sections[component[j], column]
    if long_segment and j == 0:
        compliance *= 2
    above = 0.0 if j == 0 or (long_segment and j == 1) else 0.5 * length[j - 1] / sections[component[j - 1], column]
    return 1 / (above + compliance)


@rounded
def is_swivel(component, sections, j):
    """Whether the joint above segment j turns freely."""
    return j > 0 and component[j - 1] != component[j] and sections[component[j], SWIVEL] != 0


@entry
def find_contacts(length, component, sections, long_segment, middle, radius, tributary):
    """Fill ``contact_point`` of the segments: three arrays (n,)."""
    for j in range(len(length)):
        middle[j], radius[j], tributary[j] = contact_point(length, component, sections, long_segment, j)


@entry
def find_stiffness(length, component, sections, long_segment, column, stiffness):
    """Fill ``joint_stiffness`` (n,) for a column of the sections."""
    for j in range(len(length)):
        stiffness[j] = joint_stiffness(length, component, sections, long_segment, column, j)
        if column == GJ and is_swivel(component, sections, j):
            stiffness[j] = RELEASED


@rounded
def fill_segment(S, length, component, sections, weight, long_segment, damping, squeeze, given, per_metre, j):
    """Write segment j, counted from 0, into the buffer.

    Its springs carry the effective tension T.  The pressures inside and outside, and the temperature, shorten the
    unloaded segment by its share of ``squeeze``.
    """
    k, h, at = component[j], length[j], j + 1
    middle, radius, tributary = contact_point(length, component, sections, long_segment, j)
    S[state.MASS + at] = sections[k, MASS] * h
    S[state.WEIGHT + at] = weight[j] * h
    S[state.J_AXIAL + at] = sections[k, AXIAL_INERTIA] * h
    S[state.J_TRANSVERSE + at] = sections[k, MASS] * h**3.0 / 12 + sections[k, TILT_INERTIA] * h
    arm = 0.5 * h * (1.0 - squeeze[j])
    S[state.ARM_TOP + at] = S[state.ARM_BOTTOM + at] = arm
    S[state.ARM_CONTACT + at] = 0.0 if middle else arm
    S[state.RADIUS + at] = radius
    S[state.TRIBUTARY + at] = tributary if per_metre else 1.0
    S[state.MUD_AXIAL + at] = damping[j, 0] * h
    S[state.MUD_LATERAL + at] = damping[j, 1] * h
    S[state.MUD_SPIN + at] = damping[j, 2] * h
    S[state.GIVEN_FORCE + at] = given[j]
    S[state.GIVEN_TORQUE + at] = S[state.GIVEN_FRICTION + at] = 0.0
    S[state.K_AXIAL + at] = joint_stiffness(length, component, sections, long_segment, EA, j)
    S[state.K_SHEAR + at] = joint_stiffness(length, component, sections, long_segment, SHEAR, j)
    S[state.K_BEND + at] = joint_stiffness(length, component, sections, long_segment, EI, j)
    S[state.K_TWIST + at] = joint_stiffness(length, component, sections, long_segment, GJ, j)
    S[state.OWN_FRICTION + at] = sections[k, OWN_FRICTION]
    S[state.BOW_STIFFNESS + at] = sections[k, BOW_STIFFNESS]
    S[state.STARTING_FORCE + at] = sections[k, STARTING_FORCE]


@entry
def fill_rows(S, length, component, sections, weight, long_segment, damping, squeeze, given, per_metre):
    """Write a string into a fresh buffer; returns the pipe fed at the top, ``topdrive.PerMetre``.

    weight (n,) : buoyed [N/m]; damping (n, 3) : by mud along, across and about the axis, per metre; squeeze (n,) : by
    which share pressures and temperature shorten the segments; given (n,) : load along each, towards the bit [N];
    per_metre : whether the wall's stiffness is one per length.
    """
    still = 0.0
    for j in range(len(length)):
        fill_segment(S, length, component, sections, weight, long_segment, damping, squeeze, given, per_metre, j)
        if is_swivel(component, sections, j):
            S[state.K_TWIST + j + 1] = RELEASED
            still = 1.0
        S[state.STILL + j + 1] = still
    k, longest = component[0], 0.0
    if long_segment:
        for below in length[1:]:
            longest = max(longest, below)
    pipe = PerMetre(
        sections[k, MASS], weight[0] if long_segment else 0.0, sections[k, AXIAL_INERTIA], sections[k, EA],
        sections[k, GJ], sections[k, EI], sections[k, SHEAR], damping[0, 0], damping[0, 1], damping[0, 2], 0.0,
        squeeze[0], longest, given[0] / length[0] if long_segment else 0.0,
    )  # fmt: skip
    if long_segment:
        S[state.ARM_BOTTOM + 1] = S[state.ARM_CONTACT + 1] = 0.0
        set_long_segment(S, length[0], pipe)
    for at in range(1, len(length) + 1):
        S[state.INVERSE_MASS + at] = 1 / S[state.MASS + at]
        S[state.INVERSE_JT + at] = 1 / S[state.J_TRANSVERSE + at]
        S[state.INVERSE_JA + at] = 1 / S[state.J_AXIAL + at]
    return pipe
