"""Notes on a run in time: its hook load, torque and swings, its joints and walls, its bit, its ledger."""

import numpy as np

from fctd.case.message import quantity
from fctd.results.notes import Note, note_beyond, note_of

# The push of a single step counts where it exceeds what the block can give by this share of the string's weight: waves
# of starts and stops pass the top of a light string with less.
PUSH_OF_A_STEP = 0.10
# A flutter is as fast as the wall's springs throw segments about, and faster than the string's axial waves: this share
# of the lowest frequency of a segment on its wall spring, and this multiple of the slowest axial one.  Below this share
# of the string's weight it is small: the fast part of what a start leaves behind is below 1 %.
OF_THE_WALL, OF_THE_STRING, SMALL_FLUTTER = 1 / 2, 3.0, 0.02
# Share of the torque that the joints' own damping may take.
OF_THE_TORQUE = 0.01
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


def pushes(mean: float, least: float, block: float, weight: float) -> Note | None:
    """A note where the string is pushed down with more than the weight of the block.

    mean, least : hook load of a record, and the least of its steps; block, weight : of the block and of the string [N].
    """
    beyond = max(-mean - SMALL_SWING * weight, -least - PUSH_OF_A_STEP * weight)
    if not beyond > block:
        return None
    text = (
        f"the hook load falls to {quantity(least / 1e3, 'kN', '.3g')} in a step and is "
        f"{quantity(mean / 1e3, 'kN', '.3g')} on the mean of a record, "
        f"where the block can push with {quantity(block / 1e3, 'kN', '.3g')}"
    )
    return note_of("push", text, 1 + (beyond - block) / max(block, SMALL_SWING * weight))


def flutters(amplitude: float, frequency: float, on_wall: float, axial: float, weight: float) -> Note | None:
    """A note where the hook load flutters.

    amplitude : of its fast part, weight : of the string [N]; frequency : of the fast part, on_wall : the lowest of a
    segment on its wall spring, axial : the slowest axial one of the string [Hz].
    """
    fast = amplitude if frequency > max(OF_THE_WALL * on_wall, OF_THE_STRING * axial) else 0.0
    text = f"the hook load flutters for seconds by ±{quantity(amplitude / 1e3, 'kN', '.3g')} at some {frequency:.2g} Hz"
    return note_beyond("flutter", text, fast, SMALL_FLUTTER * weight)


def brakes_turning(taken: float, torque: float) -> Note | None:
    """A note where the joints' own damping takes part of the torque of a turning string.

    A bent string that turns is bent to and fro in its own frame.  taken, torque : that of the damping and that at
    surface [N m].
    """
    if not taken > OF_THE_TORQUE * abs(torque):  # in nearly every record
        return None
    share = f"{100 * taken / abs(torque):.2g} %" if torque else "all"
    text = (
        f"the joints' own damping takes {quantity(taken, 'N·m', '.3g')} of the torque of the turning string, "
        f"{share} of it"
    )
    return note_beyond("joint_damping", text, taken, OF_THE_TORQUE * abs(torque))


def too_deep(penetration: float, largest: float) -> Note | None:
    """A note where a run went deeper into the wall than its time step is stable for, both [m]."""
    text = (
        f"a contact point was {quantity(1e3 * penetration, 'mm', '.3g')} deep in the wall, the step is stable to "
        f"{quantity(1e3 * largest, 'mm', '.3g')}"
    )
    return note_beyond("wall", text, penetration, largest)


def beyond_joints(bend: float, twist: float, joint: tuple[int, int]) -> Note | None:
    """A note where two segments bend or twist against each other beyond ``MOST_BEND`` or ``MOST_TWIST``.

    bend, twist [rad]; joint : the lower segment of each.
    """
    excess = bend / MOST_BEND, twist / MOST_TWIST
    does, angle, most, j = (
        ("bends", bend, MOST_BEND, joint[0]) if excess[0] >= excess[1] else ("twists", twist, MOST_TWIST, joint[1])
    )
    text = (
        f"segment {j} {does} by {np.degrees(angle):.0f}° against the one above, where {np.degrees(most):.0f}° are "
        "within the range of the joint"
    )
    return note_beyond("joint", text, max(excess), 1.0)


def drilled_nothing(made: float, weight: float, worn: float) -> Note | None:
    """A note where a run that drills has made no hole [m] with a bit of which the wear flats carry all its weight.

    weight : the largest on the bit; worn : what its wear flats can carry [N].
    """
    if made > 0 or weight > worn:
        return None
    text = (
        f"the bit drilled nothing: it carried at most {quantity(weight / 1e3, 'kN', '.3g')}, and its wear flats rub "
        "without cutting up "
        f"to {quantity(worn / 1e3, 'kN', '.3g')}"
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
    if bound < UNSTEADY * LEVER * abs(hookload):
        return None
    text = (
        f"the surface torque of the last record is {quantity(last / 1e3, 'kN·m', '.3g')}, its mean over the last "
        "torsional period of "
        f"{period:.3g} s {quantity(mean / 1e3, 'kN·m', '.3g')}, and over the one before "
        f"{quantity(before / 1e3, 'kN·m', '.3g')}"
    )
    return note_beyond("torque", text, max(abs(last - mean), abs(mean - before)), bound)


def turns_slowly(rpm: float, planned: float) -> Note | None:
    """A note where the top turns more slowly than planned at the end of a run.

    rpm : mean over the last torsional period; planned [rev/min].
    """
    text = (
        f"the top turns at {rpm:.3g} of {planned:g} rev/min in the last torsional period: the drive has not caught up "
        "with its plan, or stands at its torque limit"
    )
    return note_beyond("torque", text, planned - rpm, UNSTEADY * planned)


def hookload_swings(swing: float, mean: float, before: float, period: float, weight: float) -> Note | None:
    """A note where the hook load is not steady at the end of a run.

    swing : half of its range over the last two axial periods; mean, before : over the last of them and over the first;
    weight : of the string [N]; period [s].
    """
    bound = max(UNSTEADY * max(abs(mean), abs(before)), SMALL_SWING * weight)
    text = (
        f"the hook load still swings by ±{quantity(swing / 1e3, 'kN', '.3g')} at the end of the run; its mean over "
        "the last axial "
        f"period of {period:.3g} s is {quantity(mean / 1e3, 'kN', '.4g')}, and over the one before "
        f"{quantity(before / 1e3, 'kN', '.4g')}"
    )
    return note_beyond("hookload", text, max(swing, abs(mean - before)), bound)


def whirls(sideways: float, surface: float, friction_torque: float, of_sliding: float) -> Note | None:
    """A note where a turning string whirls.

    sideways : lateral speed of the segments, root of the mean square; surface : speed of the string's surface [m/s];
    friction_torque : Σ r F_t; of_sliding : the same of a string that slides [N m].
    """
    if not (sideways > SIDEWAYS * surface and friction_torque < SLIDES * of_sliding):
        return None
    text = (
        f"the string whirls: its segments move sideways at {quantity(sideways, 'm/s', '.2g')}, "
        f"{100 * sideways / surface:.0f} % of the "
        f"speed of its surface, and friction has {100 * friction_torque / of_sliding:.0f} % of the torque of a string "
        "that slides"
    )
    return note_of("whirl", text, sideways / (SIDEWAYS * surface))


def rings(swing: float, frequency: float, depth: float, bound: float) -> Note | None:
    """A note where the seams between cylinders make the hook load swing by more than a bound.

    swing, bound [N]; frequency [Hz]; depth of the bit [m].
    """
    text = (
        f"the string slides over the seams between the hole's cylinders at its natural frequency, {frequency:.2f} Hz: "
        f"near {quantity(depth, 'm', '.0f')} they make the hook load swing by about "
        f"±{quantity(swing / 1e3, 'kN', '.2g')}"
    )
    return note_beyond("ringing", text, swing, bound)


def winds_too_much(shortfall: str, longest: float, wanted: float) -> Note | None:
    """A note where segments of up to ``longest`` [m] cannot follow a winding hole, as those of ``wanted`` [m] can."""
    return note_of("tortuosity", shortfall, longest / wanted) if shortfall else None
