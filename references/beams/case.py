"""The finite-element beam of a case: one pipe lowered into one planar hole."""

from bisect import bisect_right
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import lay_out
from fctd.model.operations import schedule
from fctd.model.section import Section, section_of
from references.beams.elements import Beam, Surroundings, relaxed, statics
from references.beams.planar_hole import PlanarHole

# The end of the pipe bends towards the wall over a short length, where elements are a third as long.
END = 0.6  # [m]
END_FINER = 3
GUIDE_ELEMENT = 2.0  # [m], where the pipe hangs without contact
DAMPING_RATE = 5.0  # [1/s], of a pipe that falls from the axis to its equilibrium
SLIDING = 1.0  # [m/s], far above the creep speed of regularised friction
FRICTION_SHARES = (0.5, 1.0)  # of the friction factor, in successive equilibria


def beam_of(case: Case, element: float, fine: float, like_segments: bool = False) -> Beam:
    """The whole string of a case at its greatest depth, in elements of length ``element`` [m].

    fine [m] : length above the bit with such elements; above it elements are GUIDE_ELEMENT long.
    like_segments : no shorter elements at the bit, and contact at the ends of elements only.
    Raises InputError for a case other than a single pipe in a planar hole of one size.
    """
    section, around = pipe_and_hole(case)
    length = max(operation.end_md for operation in case.operations) - case.string.top_md
    if not END < fine < length:
        raise ValueError(f"the fine mesh has to be longer than {END} m and shorter than the string, {length:g} m")
    parted = [
        np.linspace(0.0, length - fine, _count(length - fine, GUIDE_ELEMENT), endpoint=False),
        np.linspace(length - fine, length - END, _count(fine - END, element), endpoint=False),
        np.linspace(length - END, length, _count(END, element if like_segments else element / END_FINER) + 1),
    ]
    return Beam(np.concatenate(parted), section, around, at_ends=like_segments)


class Steady(NamedTuple):
    """Loads of a string in its hole: contact force [N] at rest without friction, hook load [N] while sliding down."""

    contact_force: float
    hookload: float


def steady(case: Case, bit_depth: float, segments: int = 1) -> Steady:
    """The string of a case with the bit at ``bit_depth`` [m]; each element is as long as ``segments`` segments.

    The string falls from the axis of the hole to its equilibrium; then all of it slides down.
    Raises InputError as ``beam_of``, ConvergenceError.
    """
    section, around = pipe_and_hole(case)
    assert around.hole is not None
    string = lay_out(case, bit_depth)
    ends = np.append(0.0, np.cumsum(string.length))
    nodes = np.append(ends[:-1:segments], ends[-1])
    damping = DAMPING_RATE * section.mass
    falling = Beam(nodes, section, around._replace(friction=0.0, lateral_damping=damping, axial_damping=damping))
    along, numbers = falling.points()
    (z, x), tilt = around.hole.at(string.top_md + along)
    start, fixed = np.empty(falling.strains.N), falling.dofs(0.0)
    start[numbers] = np.stack([z, x, tilt], axis=1)
    rest = relaxed(falling, start, fixed)
    pressure = falling.wall_load(rest, np.zeros_like(rest)).pressure
    downhole = np.zeros_like(rest)
    downhole[numbers] = SLIDING * np.stack([np.cos(tilt), np.sin(tilt), 0 * tilt], axis=1)
    for share in FRICTION_SHARES:
        sliding = Beam(nodes, section, around._replace(friction=share * around.friction))
        rest = statics(sliding, rest, fixed, velocity=downhole)
    pulled = -sliding.resistance(rest, downhole)[0][numbers[0, :2]]
    along_hole = float(pulled @ [np.cos(tilt[0]), np.sin(tilt[0])])
    return Steady(float(np.abs(pressure * falling.wall.dx).sum()), along_hole)


def pipe_and_hole(case: Case) -> tuple[Section, Surroundings]:
    """The section of a case's only pipe, and its hole and mud; raises InputError as ``beam_of``."""
    parts, hole = case.string.components, case.wellbore
    if case.mud.given:
        raise InputError("one density of the mud, for planar finite elements", key="mud")
    sections = {section_of(part, case.mud.density) for part in parts}
    if len(sections) > 1 or any(part.repeat is not None for part in parts):
        raise InputError("components of one section, for planar finite elements", key="string.components")
    if len(hole.intervals) > 1:
        raise InputError("one interval, for planar finite elements", key="wellbore.intervals")
    if hole.intervals[0].friction_around != hole.intervals[0].friction:
        raise InputError(
            "that of friction, for planar finite elements", key="wellbore.intervals[0].rotational_friction"
        )
    if hole.stiffness_per_length is None:
        raise InputError("set, for planar finite elements", key="wellbore.stiffness_per_length")
    try:
        axis = PlanarHole(hole.trajectory)
    except ValueError as error:
        raise InputError(f"a planar hole, for finite elements: {error}", key="wellbore.stations") from None
    (section,), (interval,) = sections, hole.intervals
    return section, Surroundings(
        hole=axis,
        clearance=0.5 * interval.diameter - section.contact_radius,
        stiffness=hole.stiffness_per_length,
        friction=interval.friction,
        radius=section.contact_radius,
        lateral_damping=case.mud.lateral_damping or 0.0,
        axial_damping=case.mud.axial_damping or 0.0,
        weight=section.weight,
    )


def _count(length: float, element: float) -> int:
    return max(round(length / element), 1)


def top_of(case: Case) -> tuple[Callable[[float], float], float]:
    """Depth of the upper end of the string of ``beam_of`` [m] as a function of time [s]; duration of the case [s]."""
    motions = [phase.motion for phase in schedule(case.operations)]
    starts = [motion.start for motion in motions]
    depths = [case.operations[0].start_md - max(operation.end_md for operation in case.operations)]
    for motion in motions:
        depths.append(depths[-1] + _fed(motion, motion.duration))

    def depth(time: float) -> float:
        k = max(bisect_right(starts, time) - 1, 0)
        return case.string.top_md + depths[k] + _fed(motions[k], time - starts[k])

    return depth, starts[-1] + motions[-1].duration


def _fed(motion: Motion, after: float) -> float:
    """Pipe fed within ``after`` [s] of the start of a phase [m]; the speed changes by 3u² − 2u³ of its gain."""
    u = min(max(after / motion.duration, 0.0), 1.0)
    gain = motion.feed_to - motion.feed_from
    return motion.duration * (motion.feed_from * u + gain * (u**3 - 0.5 * u**4))
