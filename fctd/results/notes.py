"""Notes: warnings about the numbers of a result, each with a remedy.

A note does not change the status.  The numbers are those of the model, in a state that the model does not describe
well or that would damage the string.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final, NamedTuple

from fctd.arrays import Array
from fctd.case.limits import LimitsSpec
from fctd.case.message import Message, kept, quantity, restored, span, within
from fctd.case.rig import RigSpec
from fctd.case.systems import told
from fctd.mechanics.query import Walls
from fctd.model.drillstring import String
from fctd.model.fluids import BAR, EQUAL
from fctd.model.section import Section, bearing
from fctd.results.buckling import Buckling
from fctd.results.limits import LIMITS, Place, place_of
from fctd.results.unit_systems import System

HARDLY = 0.01  # share of a string's weight that is worth a note
FULL: Final = LimitsSpec()  # all of each capacity may be used
# Codes of notes on what string and rig bear, whose probability a sweep tells.
BORNE: Final = (*(limit.code for limit in LIMITS), "hoist", "drive", "slips")


class Meaning(NamedTuple):
    """Headline and remedy of a note's code."""

    headline: str
    remedy: str


MEANINGS: Final = {
    **{limit.code: Meaning(limit.headline, limit.remedy) for limit in LIMITS},
    "hoist": Meaning(
        "the hoist cannot lift the string", "lower friction factor or weight, or check rig.hoist_capacity"
    ),
    "drive": Meaning(
        "the drive cannot turn the string", "lower friction factor or bit torque, or check rig.largest_torque"
    ),
    "slips": Meaning(
        "slips would crush the uppermost pipe", "use longer slips, stronger pipe at the top, or check rig.slip_length"
    ),
    "buckling": Meaning(
        "the string is buckled, and its segments are too long to bend that way", "use shorter segments there"
    ),
    "homogenised": Meaning(
        "the waves of the buckled string are homogenised: mean wall force and friction of the closed forms",
        "raise solver.resolve_work where the shape itself matters, or use smaller loads",
    ),
    "several_balances": Meaning(
        "the buckled string has several balances, and rounding picks one",
        'take the hook load as a range, or use solver.buckling = "resolve", which rounding seldom moves',
    ),
    "flow_law": Meaning(
        "the pull of the mud along the string is uncertain, since most of the stress at its walls is yield stress",
        "check the readings at 6 and 3 rev/min (mud.fann), or move or pump faster",
    ),
    "falling": Meaning(
        "the fluid inside the string falls freely, since it is heavier than that outside and the end lets it out",
        "pump faster than it falls, give the fluids as they are after the fall, or close the end with a plug "
        "(mud.inside.plug)",
    ),
    "flow_lie": Meaning(
        "where the string lies in the mud that flows past it is not known: the annulus is taken as concentric",
        "give mud.eccentricity a number",
    ),
    "bent": Meaning(
        "the surface torque of a bent housing that turns is that of one toolface",
        "take the torque of wall, mud and bit, or the mean of several rows with other values of toolface",
    ),
    "tortuosity": Meaning("the segments are too long to follow the hole's tortuosity", "use shorter segments"),
    "sagitta": Meaning(
        "the segments are too long for the bend in which they lie",
        "leave out segments and segment_length there, or use shorter segments",
    ),
    "chord": Meaning(
        "the cylinders of the hole are too long for its bend",
        'use wellbore.geometry = "arcs", or a wellbore.chord_tolerance below the clearance and no cylinder_length',
    ),
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", Message(self.text))
        object.__setattr__(self, "remedy", Message(self.remedy))

    def __str__(self) -> str:
        return str(self.message)

    @property
    def message(self) -> Message:
        """Sentence and remedy."""
        return Message(f"{within(self.text)}: {within(self.remedy)}")

    def told(self, units: System) -> str:
        """The note in a system of units."""
        return told(self.message, units)


@dataclass(frozen=True)
class RowNote(Note):
    """The note of a row of a chart.  friction : label of its factors; bit_depth [m]."""

    operation: str = ""
    friction: str = ""
    bit_depth: float = math.nan


def note_of(code: str, text: str, excess: float, place: float | None = None) -> Note:
    """A note with the remedy of its code."""
    return Note(code, text, MEANINGS[code].remedy, place, excess)


def flow_law(off: float, weight: float) -> Note | None:
    """The note on a lift that may be too large by so much, beside a string of a weight [N]."""
    text = f"the pull of the mud along the string may be {quantity(off / 1e3, 'kN', '.0f')} too large"
    return note_beyond("flow_law", text, off, HARDLY * weight)


def falling(rate: float | None, flow: float, overweight: float) -> Note | None:
    """The note on fluid inside that falls freely at a rate; None without one.

    flow : of the pumps [m³/s]; overweight : pressure inside less that outside at the end, of fluids at rest [Pa].
    """
    if rate is None:
        return None
    at = "as nothing that the case gives holds it"
    if math.isfinite(rate):
        at = f"at {quantity(6e4 * rate, 'L/min', '.0f')}"
    pumped = f", where the pumps give {quantity(6e4 * flow, 'L/min', '.0f')}" if flow else ""
    text = (
        f"the fluid inside presses on the end with {quantity(overweight / BAR, 'bar', '.0f')} more than that "
        f"outside, and falls freely {at}{pumped}"
    )
    return note_of("falling", text, max(overweight / EQUAL, 1.0))


def flow_lie() -> Note:
    """The note on a string of which no steady lie was found."""
    return note_of("flow_lie", MEANINGS["flow_lie"].headline, 1.0)


def note_beyond(code: str, text: str, value: float, bound: float) -> Note | None:
    """A note where a value is beyond its bound; NaN is not."""
    return note_of(code, text, value / bound if bound else math.inf) if value > bound else None


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
    return [asdict(note) | {"sentence": kept(note.text)} for note in notes]


def from_metadata(notes: Iterable[dict[str, Any]]) -> tuple[Note, ...]:
    """Notes from the metadata of files."""
    return tuple(
        Note(
            **{name: of for name, of in note.items() if name != "sentence"}
            | {"text": restored(note.get("sentence", note["text"]))}
        )
        for note in notes
    )


def meanings_of(cells: Iterable[str]) -> dict[str, dict[str, str]]:
    """Headline and remedy of each code in cells of a table, by code."""
    used = {code for cell in set(cells) for code in cell.split(", ")}
    return {code: meaning._asdict() for code, meaning in MEANINGS.items() if code in used}


def limit_notes(worst: Array, string: String, walls: Walls, asked: LimitsSpec = FULL) -> tuple[Note, ...]:
    """Notes on a string beyond a limit of ``LIMITS``, or nearer to it than is asked for.

    worst : of ``find_shares``; walls : beside its contact points.
    """
    found = []
    for limit, (share, row, *at) in zip(LIMITS, worst.tolist(), strict=True):
        scale = limit.scale(asked)
        if scale * share > 1:
            place, section = place_of(row, walls.md, string)
            text = limit.text(share, Place(*at), string.sections[section], _where(place, string.bit_depth))
            if scale > 1:
                text += f", with limits.{limit.asked} = {getattr(asked, limit.asked):g}"
            found.append(note_of(limit.code, text, scale * share, place))
    return tuple(found)


def _where(md: float, bit_depth: float) -> str:
    """A measured depth [m] for a sentence; a string that hangs is longer than its tally [m]."""
    over = round(md) - round(bit_depth)
    tally = quantity(min(md, bit_depth), "m", ".0f")
    return f"{tally} + {quantity(over, 'm')} of stretch" if over > 0 else tally


def rig_notes(
    rig: RigSpec, limits: LimitsSpec, indicator: float, torque: float, top: Section, hanging: float
) -> tuple[Note, ...]:
    """Notes on a rig that is too weak for a reading of the weight indicator [N], or for a drive torque [N m].

    Also where slips crush the uppermost pipe, of a section ``top``, by the weight ``hanging`` in them [N].
    """
    found = []
    if rig.hoist_capacity is not None:
        text = (
            f"the weight indicator reads {quantity(indicator / 1e3, 'kN', '.0f')}, the hoist lifts "
            f"{quantity(rig.hoist_capacity / 1e3, 'kN', '.0f')}"
        )
        found.append(note_beyond("hoist", text, indicator, rig.hoist_capacity))
    if rig.largest_torque is not None:
        text = (
            f"the drive torque is {quantity(abs(torque) / 1e3, 'kN·m', '.1f')}, the drive has "
            f"{quantity(rig.largest_torque / 1e3, 'kN·m', '.1f')}"
        )
        found.append(note_beyond("drive", text, abs(torque), rig.largest_torque))
    if rig.slip_length is not None and hanging > 0:
        most = crushed_at(top, rig.slip_length)
        text = (
            f"{quantity(hanging / 1e3, 'kN', '.0f')} hang in slips, which crush the uppermost pipe at "
            f"{quantity(most / 1e3, 'kN', '.0f')} by Reinhold "
            "and Spiri (1959), tests find up to a fifth less"
        )
        if limits.design_factor > 1:
            text += f", with limits.design_factor = {limits.design_factor:g}"
        found.append(note_beyond("slips", text, hanging, most / limits.design_factor))
    return tuple(note for note in found if note is not None)


def crushed_at(top: Section, slip_length: float) -> float:
    """Weight at which slips of a length [m] crush the uppermost pipe [N]."""
    return bearing(top).tension_in_slips(slip_length)


def homogenised(buckling: Buckling) -> Note:
    """A note on a string whose waves have the wall force of the closed forms."""
    text = (
        f"buckling is {within(buckling.words)}, where the waves are homogenised: resolving takes more work or "
        "segments than a row "
        "may have, or finds no shape that slides"
    )
    return note_of("homogenised", text, 1.0, buckling.from_md)


def bent(torque: float, lost: float) -> Note | None:
    """The note on a surface torque at one toolface; None where it hardly differs from its mean over a turn [N m].

    lost : torque of wall, mud and bit [N m].  The rest holds the bend in its toolface, and does no work in a turn.
    """
    text = (
        f"the surface torque is that of one toolface: wall, mud and bit take {quantity(lost / 1e3, 'kN·m', '.3g')}, "
        f"and {quantity((torque - lost) / 1e3, 'kN·m', '.3g')} hold the bend and are nearly 0 on the mean of a turn"
    )
    return note_beyond("bent", text, abs(torque - lost), HARDLY * abs(lost))


def several_balances(hookload: float, drawn: Sequence[float], weight: float) -> Note | None:
    """A note on a string whose hook load [N] moves with rounding; None where it hardly does.

    drawn : its hook loads with noise of the size of rounding, NaN without a balance; weight : of the string [N].
    """
    loads = [hookload, *(load for load in drawn if math.isfinite(load))]
    low, high = min(loads), max(loads)
    text = (
        f"with noise of the size of rounding the hook load is {span(low / 1e3, high / 1e3, 'kN', '.4g')}, "
        f"{100 * (high - low) / weight:.2g} % of the string's weight apart"
    )
    if lost := len(drawn) + 1 - len(loads):
        text += f", and {lost} of {len(drawn)} draws have no balance"
        return note_of("several_balances", text, max(1.0, (high - low) / (HARDLY * weight)))
    return note_beyond("several_balances", text, high - low, HARDLY * weight)


def under_resolved(buckling: Buckling) -> Note | None:
    """A note where a string is buckled and its segments cannot bend that way."""
    if buckling.resolved:
        return None
    text = (
        f"buckling is {within(buckling.words)}, where segments of {quantity(buckling.longest, 'm', '.3g')} cannot "
        "bend that way; "
        f"segments of at most {quantity(buckling.segment_length, 'm')} would"
    )
    return note_of("buckling", text, buckling.longest / buckling.segment_length, buckling.from_md)
