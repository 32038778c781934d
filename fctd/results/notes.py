"""Notes: warnings about the numbers of a result, each with a remedy.

A note does not change the status.  The numbers are those of the model, in a state that the model does not describe
well or that would damage the string.
"""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics.query import Walls
from fctd.model.drillstring import String
from fctd.results.buckling import Buckling
from fctd.results.limits import LIMITS, Place, shares_of
from fctd.results.profile import Loads, place_in_words

Array = NDArray[np.float64]

# Energy error of a run as a share of the work: above the first there is a note, above the second the status is
# ``inaccurate``.
DOUBTFUL, INACCURATE = 0.01, 0.10
# The torque of a turning string differs from its mean over a torsional period, and this from the mean over the period
# before, by at most this share; settled means differ by 1 %.  Below this lever [m] times the hook load, it is noise.
UNSTEADY, LEVER = 0.05, 1e-3
# The same share for the hook load, which may not swing by more either; swings below this share of the string's weight
# are small, however small the hook load is.
SMALL_SWING = 0.01
# The chord of a segment that bends by θ is shorter than its pipe by θ²/24, 1 % at the first angle.  Beyond half a turn
# of twist a joint springs back to the other side: the second angle is half of that [rad].
MOST_BEND, MOST_TWIST = float(np.radians(30.0)), float(np.radians(90.0))


# A string that rolls without sliding moves sideways at the speed of its surface, r Ω, and its friction does no work.
# It whirls where its segments move sideways at this share of that speed, and friction has less than this share of the
# torque of a string that slides: a steady string has below 0.05 and 1.
SIDEWAYS, SLIDES = 0.15, 0.9


class Meaning(NamedTuple):
    """Headline and remedy of a note's code."""

    headline: str
    remedy: str


MEANINGS: Final = {
    **{limit.code: Meaning(limit.headline, limit.remedy) for limit in LIMITS},
    "buckling": Meaning(
        "the string is buckled, and its segments are too long to bend that way", "use shorter segments there"
    ),
    "tortuosity": Meaning("the segments are too long to follow the hole's tortuosity", "use shorter segments"),
    "wall": Meaning(
        "the string was pressed deeper into the wall than the time step is stable for",
        "raise contact.largest_penetration",
    ),
    "joint": Meaning(
        "a joint bends or twists beyond the range in which a straight segment stands for its pipe",
        "use shorter segments",
    ),
    "drilling": Meaning(
        "the bit drilled nothing: its wear flats carry its weight",
        "drill for longer, put more weight on it, or lower bit.rock.wear_flat or bit.rock.contact_strength",
    ),
    "push": Meaning(
        "the string is pushed down with more than the weight of the block",
        "no rig moves the string so: turn it, lower friction factor or speed, put heavier pipe into the upper part, or "
        "give rig.block_weight what the rig can push with",
    ),
    "flutter": Meaning(
        "the hook load flutters",
        "ramp more slowly (ramp_time) where a start with a jolt sets it off, else raise contact.damping and "
        "solver.shape_damping, which end what friction and the springs of the wall set off; until then read means",
    ),
    "joint_damping": Meaning(
        "the damping of the joints brakes the turning string",
        "lower solver.joint_damping: its default takes next to nothing, and solver.shape_damping ends chatter without "
        "braking a string that turns",
    ),
    "ledger": Meaning(
        "the energy ledger is off",
        "try a smaller solver.step, shorter segments, or arcs",
    ),
    "torque": Meaning(
        "the surface torque at the end of the run is not steady",
        "read the mean of its operation, or rotate longer, with a record.interval of the torsional period",
    ),
    "hookload": Meaning(
        "the hook load at the end of the run is not steady",
        "read the mean of its operation, let the operation last longer or ramp more slowly (ramp_time), or let the mud "
        "damp the string (mud.viscosity, mud.axial_damping)",
    ),
    "whirl": Meaning(
        "the string whirls: it rolls around its hole in place of sliding",
        "let the mud damp it (mud.viscosity above 0, or mud.lateral_damping), and use shorter segments; loads of a "
        "whirling string depend on segments and step",
    ),
    "ringing": Meaning(
        "the string rings on the seams between the hole's cylinders", 'set wellbore.geometry = "arcs", without seams'
    ),
}


@dataclass(frozen=True)
class Note:
    """A warning: a code of ``MEANINGS``, a sentence with the numbers, and the remedy.

    place : measured depth [m] of the worst value, or None.  excess : the value found, divided by its bound.
    """

    code: str
    text: str
    remedy: str
    place: float | None = None
    excess: float = 1.0

    def __str__(self) -> str:
        return f"{self.text}: {self.remedy}"


def note_of(code: str, text: str, excess: float, place: float | None = None) -> Note:
    """A note with the remedy of its code."""
    return Note(code, text, MEANINGS[code].remedy, place, excess)


def worst(notes: Iterable[Note]) -> tuple[Note, ...]:
    """Each code once, where it is worst, in the order of ``MEANINGS``."""
    found: dict[str, Note] = {}
    for note in notes:
        if note.code not in found or note.excess > found[note.code].excess:
            found[note.code] = note
    return tuple(found[code] for code in MEANINGS if code in found)


def codes_of(notes: Iterable[Note]) -> str:
    """The codes in one cell of a table; "none" without any, as an empty cell is read back as a missing value."""
    return ", ".join(note.code for note in notes) or "none"


def as_metadata(notes: Iterable[Note]) -> list[dict[str, Any]]:
    """Notes as the metadata of files."""
    return [asdict(note) for note in notes]


def from_metadata(kept: Iterable[dict[str, Any]]) -> tuple[Note, ...]:
    """Notes from the metadata of files."""
    return tuple(Note(**note) for note in kept)


def meanings_of(cells: Iterable[str]) -> dict[str, dict[str, str]]:
    """Headline and remedy of each code in cells of a table, by code."""
    used = {code for cell in set(cells) for code in cell.split(", ")}
    return {code: meaning._asdict() for code, meaning in MEANINGS.items() if code in used}


def string_notes(
    string: String, loads: Loads, hookload: float, walls: Walls, radius: Array, *, in_hole: bool = True
) -> tuple[Note, ...]:
    """Notes on a string beyond a limit of ``LIMITS``.

    hookload [N]; walls : beside the n contact points; radius (n,) : of the contact points [m]; in_hole : whether
    there is a wall.
    """
    return limit_notes(shares_of(string, loads, hookload, walls, radius, in_hole), string, walls)


def limit_notes(worst: Array, string: String, walls: Walls) -> tuple[Note, ...]:
    """``string_notes`` of a string whose largest shares of the limits, ``worst``, are known."""
    found = []
    for limit, (share, row, *at) in zip(LIMITS, worst.tolist(), strict=True):
        if share > 1:
            k = int(row)
            place, section = (float(walls.md[k - 1]) if k else string.top_md), string.component[max(k - 1, 0)]
            where = place_in_words(place, string.bit_depth)
            text = limit.text(share, Place(*at), string.sections[section], where)
            found.append(note_of(limit.code, text, share, place))
    return tuple(found)


def under_resolved(buckling: Buckling) -> Note | None:
    """A note where a string is buckled and its segments cannot bend that way."""
    if buckling.resolved:
        return None
    text = (
        f"buckling is {buckling}, where segments of {buckling.longest:.3g} m cannot bend that way; "
        f"segments of at most {buckling.segment_length:g} m would"
    )
    return note_of("buckling", text, buckling.longest / buckling.segment_length, buckling.from_md)


def winds_too_much(shortfall: str, longest: float, wanted: float) -> Note | None:
    """A note where segments of up to ``longest`` [m] cannot follow a winding hole, as those of ``wanted`` [m] can."""
    return note_of("tortuosity", shortfall, longest / wanted) if shortfall else None


def too_deep(penetration: float, largest: float) -> Note | None:
    """A note where a run went deeper into the wall than its time step is stable for, both [m]."""
    if not penetration > largest:
        return None
    text = (
        f"a contact point was {1e3 * penetration:.3g} mm deep in the wall, the step is stable to {1e3 * largest:.3g} mm"
    )
    return note_of("wall", text, penetration / largest)


def beyond_joints(bend: float, twist: float, joint: tuple[int, int]) -> Note | None:
    """A note where two segments bend or twist against each other beyond ``MOST_BEND`` or ``MOST_TWIST``.

    bend, twist [rad]; joint : the lower segment of each.
    """
    excess = bend / MOST_BEND, twist / MOST_TWIST
    if max(excess) <= 1:
        return None
    does, angle, most, j = (
        ("bends", bend, MOST_BEND, joint[0]) if excess[0] >= excess[1] else ("twists", twist, MOST_TWIST, joint[1])
    )
    text = (
        f"segment {j} {does} by {np.degrees(angle):.0f}° against the one above, where {np.degrees(most):.0f}° are "
        "within the range of the joint"
    )
    return note_of("joint", text, max(excess))


def drilled_nothing(made: float, weight: float, worn: float) -> Note | None:
    """A note where a run that drills has made no hole [m] with a bit of which the wear flats carry all its weight.

    weight : the largest on the bit; worn : what its wear flats can carry [N].
    """
    if made > 0 or weight > worn:
        return None
    text = (
        f"the bit drilled nothing: it carried at most {weight / 1e3:.3g} kN, and its wear flats rub without cutting up "
        f"to {worn / 1e3:.3g} kN"
    )
    return note_of("drilling", text, worn / max(weight, 1.0))


def ledger_off(error: float) -> Note | None:
    """A note where the energy ledger is off by ``error`` of the work and more than ``DOUBTFUL``; NaN counts as off."""
    if error < DOUBTFUL:
        return None
    return note_of("ledger", f"the energy ledger is off by {100 * error:.2g} %", error / DOUBTFUL)


def torque_swings(last: float, mean: float, before: float, period: float, hookload: float) -> Note | None:
    """A note where the surface torque of a turning string is not steady at the end of a run.

    last : of the last record; mean, before : over the last torsional period and over the one before [N m]; period [s];
    hookload [N].
    """
    bound = UNSTEADY * max(abs(mean), abs(before))
    off = max(abs(last - mean), abs(mean - before))
    if bound < UNSTEADY * LEVER * abs(hookload) or not off > bound:
        return None
    text = (
        f"the surface torque of the last record is {last / 1e3:.3g} kN·m, its mean over the last torsional period of "
        f"{period:.3g} s {mean / 1e3:.3g} kN·m, and over the one before {before / 1e3:.3g} kN·m"
    )
    return note_of("torque", text, off / bound)


def turns_slowly(rpm: float, planned: float) -> Note | None:
    """A note where the top turns more slowly than planned at the end of a run.

    rpm : mean over the last torsional period; planned [rev/min].
    """
    bound = UNSTEADY * planned
    if not planned - rpm > bound:
        return None
    text = (
        f"the top turns at {rpm:.3g} of {planned:g} rev/min in the last torsional period: the drive has not caught up "
        "with its plan, or stands at its torque limit"
    )
    return note_of("torque", text, (planned - rpm) / bound)


def hookload_swings(swing: float, mean: float, before: float, period: float, weight: float) -> Note | None:
    """A note where the hook load is not steady at the end of a run.

    swing : half of its range over the last two axial periods; mean, before : over the last of them and over the first;
    weight : of the string [N]; period [s].
    """
    bound = max(UNSTEADY * max(abs(mean), abs(before)), SMALL_SWING * weight)
    off = max(swing, abs(mean - before))
    if not off > bound:
        return None
    text = (
        f"the hook load still swings by ±{swing / 1e3:.3g} kN at the end of the run; its mean over the last axial "
        f"period of {period:.3g} s is {mean / 1e3:.4g} kN, and over the one before {before / 1e3:.4g} kN"
    )
    return note_of("hookload", text, off / bound)


def whirls(sideways: float, surface: float, friction_torque: float, of_sliding: float) -> Note | None:
    """A note where a turning string whirls.

    sideways : lateral speed of the segments, root of the mean square; surface : speed of the string's surface [m/s];
    friction_torque : Σ r F_t; of_sliding : the same of a string that slides [N m].
    """
    if not (sideways > SIDEWAYS * surface and friction_torque < SLIDES * of_sliding):
        return None
    text = (
        f"the string whirls: its segments move sideways at {sideways:.2g} m/s, {100 * sideways / surface:.0f} % of the "
        f"speed of its surface, and friction has {100 * friction_torque / of_sliding:.0f} % of the torque of a string "
        "that slides"
    )
    return note_of("whirl", text, sideways / (SIDEWAYS * surface))


def rings(swing: float, frequency: float, depth: float, bound: float) -> Note | None:
    """A note where the seams between cylinders make the hook load swing by more than a bound.

    swing, bound [N]; frequency [Hz]; depth of the bit [m].
    """
    if not swing > bound:
        return None
    text = (
        f"the string slides over the seams between the hole's cylinders at its natural frequency, {frequency:.2f} Hz: "
        f"near {depth:.0f} m they make the hook load swing by about ±{swing / 1e3:.2g} kN"
    )
    return note_of("ringing", text, swing / bound)
