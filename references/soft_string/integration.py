"""The soft string: a cable without bending stiffness that follows the hole without clearance.

With md s along the hole, tangent t(s), effective tension T and buoyed weight w per metre, the load across
the hole that the wall has to carry is the vector

    q = T t′ + w (e − (e·t) t),          e straight down,

tension times the curvature of the hole plus the weight across it, in any plane.  From the bit upwards, with the
factors of `sliding.Friction`,

    −dT/ds = w e·t + drag |q|,    −dM/ds = r turning |q|,    contact force per metre N = normal |q|.

Two methods: the recursion of Johancsik, Friesen & Dawson 1984 over short elements, its side force written with
vectors, and numerical integration of the differential form of Sheppard, Wick & Burgess 1987.  Both start at the bit
with −WOB and the bit torque while drilling, and with zero tension and torque off bottom.

In a plane build in slack-off the two parts of q oppose each other and the wall force changes side, where |q|
has a kink.  With friction around the hole (law ``coulomb`` while turning) the string climbs the wall until wall
force and friction balance q; without clearance this changes only the factors.
"""

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model import survey
from fctd.model.drillstring import lay_out
from fctd.model.section import buoyed
from references.soft_string.directions import Direction, associated
from references.soft_string.sliding import Friction, loads_at_bit, motion_of, split_friction

# Tangent and its derivative (…, 3) at measured depths (…) [m] in a course between two stations.
Axis = Callable[[Array | float, int], tuple[Array, Array]]

ELEMENT = 1.0  # [m]
DOWN = np.array([0.0, 0.0, 1.0])
RELATIVE, ABSOLUTE = 1e-11, 1e-6  # tolerances of the integration; [N], [N m]
STRAIGHT = 1e-9  # [rad], a smaller turn is a rounding error
SAME_DEPTH = 1e-6  # [m]


class Profile(NamedTuple):
    """Along the string, from the top: md [m], effective tension [N], torque [N m], side force N [N/m]; (n,) each."""

    md: Array
    tension: Array
    torque: Array
    side_force: Array


class SoftString(NamedTuple):
    """Hook load [N], surface torque [N m], summed side force [N], and the profile in the middle of elements."""

    hookload: float
    surface_torque: float
    total_contact_force: float
    profile: Profile


class Piece(NamedTuple):
    """A part of the hole without an end of a course, interval or component inside.

    top, bottom [m]; course : number of the station above; weight [N/m]; radius [m] : contact radius.
    """

    top: float
    bottom: float
    course: int
    weight: float
    radius: float
    friction: Friction


def soft_string(
    case: Case,
    operation: str,
    bit_depth: float,
    *,
    speed: float | None = None,
    rpm: float | None = None,
    element: float = ELEMENT,
    direction: Direction = associated,
) -> SoftString:
    """Johancsik's recursion from the bit upwards, in elements of at most ``element`` [m]; error of second order.

    The load of an element depends on the tension in its middle, which depends on the load: a quadratic equation.
    speed [m/s] and rpm [1/min] as in `sliding.motion_of`; direction : of friction with two factors.
    Raises InputError as `motion_of` and `lay_out`, and for a depth beyond survey or intervals.
    """
    axis = _axis(case)
    tension, torque = loads_at_bit(case, operation)
    contact, rows = 0.0, []
    for piece in reversed(_pieces(case, operation, bit_depth, speed, rpm, direction)):
        ends = _divide(piece, element)
        tangents = axis(ends, piece.course)[0]
        length = float(ends[1] - ends[0])
        normal, drag, turning = piece.friction
        for k in range(len(ends) - 2, -1, -1):
            mean = 0.5 * (tangents[k] + tangents[k + 1])
            turn = tangents[k + 1] - tangents[k]
            along = piece.weight * length * float(mean[2])
            # |fixed + load·share| = load
            fixed = (tension + 0.5 * along) * turn + piece.weight * length * (DOWN - mean[2] * mean)
            share = 0.5 * drag * turn
            both, rest = float(fixed @ share), 1.0 - float(share @ share)
            load = (both + np.sqrt(both**2 + rest * float(fixed @ fixed))) / rest
            gain, twist = along + drag * load, piece.radius * turning * load
            middle = 0.5 * (ends[k] + ends[k + 1])
            rows.append((middle, tension + 0.5 * gain, torque + 0.5 * twist, normal * load / length))
            tension, torque, contact = tension + gain, torque + twist, contact + normal * load
    return SoftString(float(tension), float(torque), float(contact), Profile(*np.array(rows[::-1]).T))


def soft_string_ode(
    case: Case, operation: str, bit_depth: float, *, speed: float | None = None, rpm: float | None = None
) -> SoftString:
    """The differential form, integrated from the bit upwards; arguments and errors as `soft_string`.

    The integration restarts at every end of a piece, and where the wall force changes side.
    """
    axis = _axis(case)
    state = np.array([*loads_at_bit(case, operation), 0.0])
    parts = []
    for piece in reversed(_pieces(case, operation, bit_depth, speed, rpm)):
        ends = _divide(piece, ELEMENT)
        middles = 0.5 * (ends[1:] + ends[:-1])
        for climb in _climb(piece, axis, state):
            state = climb.y[:, -1]
            md = middles[(middles > climb.t[-1]) & (middles <= climb.t[0])]
            if len(md):
                tension, torque, _ = climb.sol(md)
                load = np.linalg.norm(_load_across(piece, axis, md, tension), axis=-1)
                parts.append((md, tension, torque, piece.friction.normal * load))
    profile = Profile(*(np.concatenate(column) for column in zip(*reversed(parts), strict=True)))
    return SoftString(float(state[0]), float(state[1]), float(state[2]), profile)


def _climb(piece: Piece, axis: Axis, state: Array) -> Iterator[Any]:
    """Integrate tension, torque and contact force (3,) up a piece; yields a scipy result per side of the hole."""
    normal, drag, turning = piece.friction

    def slope(md: float, state: Array) -> Array:
        load = float(np.linalg.norm(_load_across(piece, axis, md, state[0])))
        along = piece.weight * float(axis(md, piece.course)[0][2])
        return -np.array([along + drag * load, piece.radius * turning * load, normal * load])

    def side(md: float, state: Array) -> float:
        """Load towards the inside of the bend; the wall force changes side at its zeros."""
        return float(_load_across(piece, axis, md, state[0]) @ axis(md, piece.course)[1])

    start, length = piece.bottom, piece.bottom - piece.top
    events = None
    if float(np.linalg.norm(axis(start, piece.course)[1])) * length > STRAIGHT:
        # The side just above the lower end, since the load may be zero at the end itself.
        offset = 1e-6 * length
        side.direction = -np.sign(side(start - offset, state - offset * slope(start, state)))  # type: ignore[attr-defined]
        side.terminal = True  # type: ignore[attr-defined]
        events = side
    while start > piece.top:
        climb = solve_ivp(
            slope, (start, piece.top), state, "DOP853", events=events, dense_output=True, rtol=RELATIVE, atol=ABSOLUTE
        )
        if not climb.success:
            raise RuntimeError(f"soft string above {start:g} m: {climb.message}")
        yield climb
        start, state = climb.t[-1], climb.y[:, -1]
        if events is not None:
            side.direction *= -1  # type: ignore[attr-defined]


def _load_across(piece: Piece, axis: Axis, md: Array | float, tension: Array | float) -> Array:
    """Load across the hole q (…, 3) [N/m] at depths (…) [m] under tensions (…) [N]."""
    tangent, bend = axis(md, piece.course)
    across = DOWN - tangent[..., 2:] * tangent
    return np.asarray(np.asarray(tension)[..., None] * bend + piece.weight * across)


def _divide(piece: Piece, element: float) -> Array:
    """Ends of equal elements of at most ``element`` [m], from the top of a piece."""
    if not element > 0:
        raise InputError("a length above 0", key="element", value=element)
    return np.linspace(piece.top, piece.bottom, int(np.ceil((piece.bottom - piece.top) / element - 1e-9)) + 1)


def _pieces(
    case: Case,
    operation: str,
    bit_depth: float,
    speed: float | None,
    rpm: float | None,
    direction: Direction = associated,
) -> list[Piece]:
    """Pieces of hole and string from top to bit."""
    for k, part in enumerate(case.string.components):
        for key, given in ((part.repeat_key, part.fittings is not None), ("swivel", part.swivel)):
            if given:
                raise InputError("none, for the soft string", key=f"string.components[{k}].{key}")
    motion = motion_of(case, operation, speed, rpm)
    stations = case.wellbore.trajectory[:, 0]
    to_md = np.array([interval.to_md for interval in case.wellbore.intervals])
    bottom = min(stations[-1], to_md[-1])
    if not (np.isfinite(bit_depth) and bit_depth <= bottom + SAME_DEPTH):
        raise InputError(f"a depth within survey and intervals, {bottom:g} m", key="bit_depth", value=bit_depth)
    string = lay_out(case, bit_depth)
    last = np.append(np.diff(string.component) != 0, True)  # segments at the lower end of their component
    ends, components = (string.top_md + np.cumsum(string.length))[last], string.component[last]
    met = [] if string.fluids is None else [*string.fluids.inside.end, *string.fluids.outside.end]
    breaks = np.unique(np.concatenate([[string.top_md], stations, to_md, ends, bit_depth - np.array(met)]))
    breaks = breaks[(breaks >= string.top_md) & (breaks <= ends[-1])]
    breaks = breaks[np.append(np.diff(breaks) > SAME_DEPTH, True)]
    pieces = []
    for top, bottom in pairwise(breaks):
        middle = 0.5 * (top + bottom)
        section = string.sections[components[np.searchsorted(ends, middle)]]
        there = case.wellbore.intervals[int(np.searchsorted(to_md, middle))]
        friction = split_friction(
            case.contact.friction_law, there.friction, motion, section.contact_radius, there.friction_around, direction
        )
        course = int(np.searchsorted(stations, middle)) - 1
        weight = section.weight
        if string.fluids is not None:
            (inside,), (outside,) = string.fluids.densities(*np.array([[bit_depth - top], [bit_depth - bottom]]))
            weight = float(buoyed(section.mass, section.density, section.inner, outside, inside))
        pieces.append(Piece(float(top), float(bottom), course, weight, section.contact_radius, friction))
    return pieces


def _axis(case: Case) -> Axis:
    """Tangent of the hole itself, not of the cylinders that stand for it, and its derivative [1/m]."""
    stations = case.wellbore.trajectory
    if case.wellbore.survey_method == "minimum_curvature":
        try:
            courses = survey.minimum_curvature(stations)
        except ValueError as error:
            raise InputError("stations that a circular arc can join", key="wellbore", value=str(error)) from None

        def arc(md: Array | float, course: int) -> tuple[Array, Array]:
            tangent, normal, curvature = courses.tangent[course], courses.normal[course], courses.curvature[course]
            angle = curvature * (np.asarray(md) - courses.md[course])[..., None]
            sine, cosine = np.sin(angle), np.cos(angle)
            return cosine * tangent + sine * normal, curvature * (cosine * normal - sine * tangent)

        return arc

    def even(md: Array | float, course: int) -> tuple[Array, Array]:
        """Inclination I and unwrapped azimuth A linear in md."""
        start, rate = stations[course], np.diff(stations[course : course + 2], axis=0)[0]
        _, per_inc, per_azi = rate / rate[0]
        past = np.asarray(md) - start[0]
        inc, azi = start[1] + past * per_inc, start[2] + past * per_azi
        si, ci, sa, ca = np.sin(inc), np.cos(inc), np.sin(azi), np.cos(azi)
        tangent = np.stack([si * ca, si * sa, ci], axis=-1)
        bend = np.stack(
            [per_inc * ci * ca - per_azi * si * sa, per_inc * ci * sa + per_azi * si * ca, -per_inc * si], axis=-1
        )
        return tangent, bend

    return even
