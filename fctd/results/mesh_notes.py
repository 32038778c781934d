"""Notes on meshes that are too coarse for a bend: the segments of a string, and the cylinders of its hole."""

import math
from typing import Final

from fctd.arrays import Array, first_largest
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.model.chords import largest_chord, missed_by_cylinders
from fctd.model.default_layout import LEAST_CLEARANCE, largest_sagitta, sagittas
from fctd.model.drillstring import String
from fctd.results.notes import Note, note_of

# Clearances by which a segment may miss the axis of a bend: within them the study ``refine`` has torque within 1 %.
MISSES: Final = 4.0
# Cylinders of a hole may miss its axis by the clearance, or by this where that is smaller [m].
LEAST_CHORD: Final = 5e-4


def mesh_notes(case: Case, string: String) -> tuple[Note, ...]:
    """Notes where segments or cylinders are too long for a bend; none in the open."""
    if not case.contact.enabled:
        return ()
    return tuple(note for note in (sagitta(case, string), chord(case, string)) if note is not None)


def sagitta(case: Case, string: String) -> Note | None:
    """A note where a segment misses the axis of a bend by more than ``MISSES`` clearances, on the worst one."""
    if all(part.cut_by_default for part in case.string.components):
        return None  # they miss it by 1.3 clearances at most
    if largest_sagitta(case, float(string.length.max())) <= MISSES * max(_narrowest(case, string), LEAST_CLEARANCE):
        return None  # as nearly every row, at a fraction of the cost of what follows
    middle = _middles(string)
    missed, clearance = sagittas(case, middle, string.length, string.of("contact_radius"))
    room = clearance.clip(LEAST_CLEARANCE)
    k = first_largest(missed / room)
    length, miss, name = float(string.length[k]), float(missed[k]), string.parts[string.component[k]].component.name
    if miss <= MISSES * room[k]:
        return None
    text = (
        f'segments of {quantity(length, "m", ".3g")} of component "{name}" '
        f"miss the bend at {quantity(middle[k], 'm', '.0f')} by {quantity(1e3 * miss, 'mm', '.0f')}, where the "
        f"clearance is {quantity(1e3 * clearance[k], 'mm', '.3g')}; segments of at most "
        f"{quantity(length * math.sqrt(room[k] / miss), 'm', '.2g')} would follow it"
    )
    return note_of("sagitta", text, miss / (MISSES * float(room[k])), float(middle[k]))


def chord(case: Case, string: String) -> Note | None:
    """A note where cylinders of the hole miss its axis by more than the clearance of the string, on the worst one."""
    if largest_chord(case) <= max(_narrowest(case, string), LEAST_CHORD):
        return None
    middle = _middles(string)
    missed, length = missed_by_cylinders(case, middle)
    clearance = sagittas(case, middle, string.length, string.of("contact_radius"))[1]
    room = clearance.clip(LEAST_CHORD)
    k = first_largest(missed / room)
    if missed[k] <= room[k]:
        return None
    name = string.parts[string.component[k]].component.name
    text = (
        f"cylinders of {quantity(length[k], 'm', '.3g')} miss the bend at {quantity(middle[k], 'm', '.0f')} by "
        f'{quantity(1e3 * missed[k], "mm", ".2g")}, where component "{name}" '
        f"has a clearance of {quantity(1e3 * clearance[k], 'mm', '.2g')}"
    )
    return note_of("chord", text, float(missed[k] / room[k]), float(middle[k]))


def _narrowest(case: Case, string: String) -> float:
    """Clearance [m] of the string's largest part in the hole's smallest interval."""
    hole = min(interval.diameter for interval in case.wellbore.intervals)
    return 0.5 * hole - max(section.contact_radius for section in string.sections)


def _middles(string: String) -> Array:
    """Depths (n,) [m] of the middles of segments."""
    return string.bit_depth - 0.5 * (string.above_bit[1:] + string.above_bit[:-1])
