"""The segments of a string as rows of the engine's buffer: masses, arms, contact points, damping, stiffness (§5.1).

A string is given by the length [m] and the component (n,) of its segments, from the top down, and a table of
``drillstring.Section``, a row for each component.  Sums and products are rounded as in numpy.
"""

from fctd.mechanics import state
from fctd.mechanics.jit import entry, rounded
from fctd.mechanics.topdrive import PerMetre, set_long_segment

# Columns of a table of sections: the fields of ``drillstring.Section``.
MASS, WEIGHT, AXIAL_INERTIA, TILT_INERTIA, EA, GJ, EI, SHEAR, OUTER, INNER, CONTACT_RADIUS, YIELD_STRENGTH = range(12)
ECCENTRICITY = 12


@rounded
def is_short(length, component, j):
    """Whether a component is one segment that is shorter than its neighbours: a stabiliser, a bit."""
    last = len(length) - 1
    alone = (j == 0 or component[j - 1] != component[j]) and (j == last or component[j + 1] != component[j])
    longer_above = j > 0 and length[j] < length[j - 1] - 1e-9
    longer_below = j == last or length[j] < length[j + 1] - 1e-9
    return alone and longer_above and longer_below


@rounded
def contact_point(length, component, sections, long_segment, j):
    """Whether segment j touches at its middle, radius of its contact point, length whose wall force it bears [m].

    A short component touches at its middle, but for the bit, which touches at its end.  The radius is the larger one of
    unlike neighbours; a short component has its own.  The length is half of each neighbouring segment, none of a long
    one; a contact in the middle has the length of its segment.
    """
    last = len(length) - 1
    radius = sections[component[j], CONTACT_RADIUS]
    if j < last and is_short(length, component, j):
        return True, radius, length[j]
    if j < last and not is_short(length, component, j + 1):
        radius = max(radius, sections[component[j + 1], CONTACT_RADIUS])
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


@rounded
def fill_segment(S, length, component, sections, long_segment, damping, per_metre, j):
    """Write segment j, counted from 0, into the buffer."""
    k, h, at = component[j], length[j], j + 1
    middle, radius, tributary = contact_point(length, component, sections, long_segment, j)
    S[state.MASS + at] = sections[k, MASS] * h
    S[state.WEIGHT + at] = sections[k, WEIGHT] * h
    S[state.J_AXIAL + at] = sections[k, AXIAL_INERTIA] * h
    S[state.J_TRANSVERSE + at] = sections[k, MASS] * h**3.0 / 12 + sections[k, TILT_INERTIA] * h
    S[state.ARM_TOP + at] = S[state.ARM_BOTTOM + at] = 0.5 * h
    S[state.ARM_CONTACT + at] = 0.0 if middle else 0.5 * h
    S[state.RADIUS + at] = radius
    S[state.TRIBUTARY + at] = tributary if per_metre else 1.0
    S[state.MUD_AXIAL + at] = damping[j, 0] * h
    S[state.MUD_LATERAL + at] = damping[j, 1] * h
    S[state.MUD_SPIN + at] = damping[j, 2] * h
    S[state.K_AXIAL + at] = joint_stiffness(length, component, sections, long_segment, EA, j)
    S[state.K_SHEAR + at] = joint_stiffness(length, component, sections, long_segment, SHEAR, j)
    S[state.K_BEND + at] = joint_stiffness(length, component, sections, long_segment, EI, j)
    S[state.K_TWIST + at] = joint_stiffness(length, component, sections, long_segment, GJ, j)


@entry
def fill_rows(S, length, component, sections, long_segment, damping, per_metre):
    """Write a string into a fresh buffer; returns the pipe fed at the top, ``topdrive.PerMetre``.

    damping (n, 3) : by mud along, across and about the axis, per metre; per_metre : whether the wall's stiffness is one
    per length.
    """
    for j in range(len(length)):
        fill_segment(S, length, component, sections, long_segment, damping, per_metre, j)
    k = component[0]
    pipe = PerMetre(
        sections[k, MASS], sections[k, WEIGHT] if long_segment else 0.0, sections[k, AXIAL_INERTIA], sections[k, EA],
        sections[k, GJ], sections[k, EI], sections[k, SHEAR], damping[0, 0], damping[0, 1], damping[0, 2], 0.0,
    )  # fmt: skip
    if long_segment:
        S[state.ARM_BOTTOM + 1] = S[state.ARM_CONTACT + 1] = 0.0
        set_long_segment(S, length[0], pipe)
    for at in range(1, len(length) + 1):
        S[state.INVERSE_MASS + at] = 1 / S[state.MASS + at]
        S[state.INVERSE_JT + at] = 1 / S[state.J_TRANSVERSE + at]
        S[state.INVERSE_JA + at] = 1 / S[state.J_AXIAL + at]
    return pipe
