"""The beam of finite elements that a case describes: one pipe lowered into one planar hole."""

from bisect import bisect_right
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from fctd.case import Case
from fctd.drillstring import section_of
from fctd.errors import InputError
from fctd.operations import schedule
from fctd.topdrive import Motion
from references.beam_fe import Beam, Surroundings
from references.planar_hole import PlanarHole

Array = NDArray[np.float64]

# The end of the pipe leans into the wall over a short length: elements there are a third as long.
END = 0.6  # [m]
END_FINER = 3
GUIDE_ELEMENT = 2.0  # [m], where the pipe hangs without touching


def beam_of(case: Case, element: float, fine: float, like_segments: bool = False) -> Beam:
    """The whole string of a case at its deepest, in elements of length ``element`` [m].

    fine [m] : length above the bit that has such elements; above them they are GUIDE_ELEMENT long.
    like_segments : no shorter elements at the bit, and the wall is felt at the ends of elements alone.
    Raises InputError for a case that is no single pipe in a planar hole of one size.
    """
    parts, hole = case.string.components, case.wellbore
    sections = {section_of(part, case.mud.density) for part in parts}
    if len(sections) > 1:
        raise InputError("components of one section, for planar finite elements", key="string.components")
    if len(hole.intervals) > 1:
        raise InputError("one interval, for planar finite elements", key="wellbore.intervals")
    if hole.stiffness_per_length is None:
        raise InputError("set, for planar finite elements", key="wellbore.stiffness_per_length")
    try:
        axis = PlanarHole(hole.read_stations())
    except ValueError as error:
        raise InputError(f"a planar hole, for finite elements: {error}", key="wellbore.stations") from None
    (section,), (interval,) = sections, hole.intervals
    length = max(operation.end_md for operation in case.operations) - case.string.top_md
    if not END < fine < length:
        raise ValueError(f"the fine mesh has to be longer than {END} m and shorter than the string, {length:g} m")
    parted = [
        np.linspace(0.0, length - fine, _count(length - fine, GUIDE_ELEMENT), endpoint=False),
        np.linspace(length - fine, length - END, _count(fine - END, element), endpoint=False),
        np.linspace(length - END, length, _count(END, element if like_segments else element / END_FINER) + 1),
    ]
    around = Surroundings(
        hole=axis,
        clearance=0.5 * interval.diameter - section.contact_radius,
        stiffness=hole.stiffness_per_length,
        friction=interval.friction,
        radius=section.contact_radius,
        lateral_damping=case.mud.lateral_damping,
        axial_damping=case.mud.axial_damping,
        weight=section.weight,
    )
    return Beam(np.concatenate(parted), section, around, at_ends=like_segments)


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
