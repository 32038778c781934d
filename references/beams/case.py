"""The beam of finite elements that a case describes: one pipe lowered into one planar hole."""

from bisect import bisect_right
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import Section, lay_out, section_of
from fctd.model.operations import schedule
from references.beams.elements import Beam, Surroundings, fallen, statics
from references.beams.planar_hole import PlanarHole

Array = NDArray[np.float64]

# The end of the pipe leans into the wall over a short length: elements there are a third as long.
END = 0.6  # [m]
END_FINER = 3
GUIDE_ELEMENT = 2.0  # [m], where the pipe hangs without touching
BRAKE = 5.0  # [1/s] of a pipe that falls from the axis to where it rests
SLIDING = 1.0  # [m/s], far beyond the creep of regularised friction
RUBBING = (0.5, 1.0)  # shares of the friction factor on the way to all of it


def beam_of(case: Case, element: float, fine: float, like_segments: bool = False) -> Beam:
    """The whole string of a case at its deepest, in elements of length ``element`` [m].

    fine [m] : length above the bit that has such elements; above them they are GUIDE_ELEMENT long.
    like_segments : no shorter elements at the bit, and the wall is felt at the ends of elements alone.
    Raises InputError for a case that is no single pipe in a planar hole of one size.
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
    """Of a string that lies in its hole: contact force [N] at rest without friction, hook load [N] sliding down."""

    contact_force: float
    hookload: float


def steady(case: Case, bit_depth: float, segments: int = 1) -> Steady:
    """The string of a case with the bit at a depth, in elements of so many of its ``segments``.

    It falls from the axis of the hole to where it rests; then all of it slides down.
    Raises InputError as ``beam_of``, ConvergenceError.
    """
    section, around = pipe_and_hole(case)
    assert around.hole is not None
    string = lay_out(case, bit_depth)
    ends = np.append(0.0, np.cumsum(string.length))
    nodes = np.append(ends[:-1:segments], ends[-1])
    brake = BRAKE * section.mass
    falling = Beam(nodes, section, around._replace(friction=0.0, lateral_damping=brake, axial_damping=brake))
    along, numbers = falling.points()
    (z, x), tilt = around.hole.at(string.top_md + along)
    start, held = np.empty(falling.strains.N), falling.dofs(0.0)
    start[numbers] = np.stack([z, x, tilt], axis=1)
    rest = fallen(falling, start, held)
    pressure = falling.wall_load(rest, np.zeros_like(rest)).pressure
    downhole = np.zeros_like(rest)
    downhole[numbers] = SLIDING * np.stack([np.cos(tilt), np.sin(tilt), 0 * tilt], axis=1)
    for share in RUBBING:
        sliding = Beam(nodes, section, around._replace(friction=share * around.friction))
        rest = statics(sliding, rest, held, velocity=downhole)
    pulled = -sliding.resistance(rest, downhole)[0][numbers[0, :2]]
    along_hole = float(pulled @ [np.cos(tilt[0]), np.sin(tilt[0])])
    return Steady(float(np.abs(pressure * falling.wall.dx).sum()), along_hole)


def pipe_and_hole(case: Case) -> tuple[Section, Surroundings]:
    """The section of a case's only pipe, and what surrounds it; raises InputError as ``beam_of``."""
    parts, hole = case.string.components, case.wellbore
    sections = {section_of(part, case.mud.density) for part in parts}
    if len(sections) > 1:
        raise InputError("components of one section, for planar finite elements", key="string.components")
    if len(hole.intervals) > 1:
        raise InputError("one interval, for planar finite elements", key="wellbore.intervals")
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
        lateral_damping=case.mud.lateral_damping,
        axial_damping=case.mud.axial_damping,
        weight=section.weight,
    )


def _count(length: float, element: float) -> int:
    return max(round(length / element), 1)


def top_of(case: Case) -> tuple[Callable[[float], float], float]:
    """Depth of the upper end of that string [m] as a function of time [s], and the duration of the case [s]."""
    motions = [stretch.motion for stretch in schedule(case.operations)]
    starts = [motion.start for motion in motions]
    depths = [case.operations[0].start_md - max(operation.end_md for operation in case.operations)]
    for motion in motions:
        depths.append(depths[-1] + _fed(motion, motion.duration))

    def depth(time: float) -> float:
        k = max(bisect_right(starts, time) - 1, 0)
        return case.string.top_md + depths[k] + _fed(motions[k], time - starts[k])

    return depth, starts[-1] + motions[-1].duration


def _fed(motion: Motion, after: float) -> float:
    """Pipe fed within ``after`` [s] of the start of a stretch, whose speed goes as 3u² − 2u³ [m]."""
    u = min(max(after / motion.duration, 0.0), 1.0)
    gain = motion.feed_to - motion.feed_from
    return motion.duration * (motion.feed_from * u + gain * (u**3 - 0.5 * u**4))
