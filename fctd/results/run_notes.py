"""Notes on a run in time: a string that is pushed down its hole, one that flutters, and one that its damping brakes."""

import math

from fctd.results.notes import SMALL_SWING, Note, note_of

# The push of a single step counts where it exceeds what the block can give by this share of the string's weight: waves
# of starts and stops pass the top of a light string with less.
PUSH_OF_A_STEP = 0.10
# A flutter is as fast as the wall's springs throw segments about, and faster than the string's axial waves: this share
# of the lowest frequency of a segment on its wall spring, and this multiple of the slowest axial one.  Below this share
# of the string's weight it is small: the fast part of what a start leaves behind is below 1 %.
OF_THE_WALL, OF_THE_STRING, SMALL_FLUTTER = 1 / 2, 3.0, 0.02
# Share of the torque that the joints' own damping may take.
OF_THE_TORQUE = 0.01


def pushes(mean: float, least: float, block: float, weight: float) -> Note | None:
    """A note where the string is pushed down with more than the weight of the block.

    mean, least : hook load of a record, and the least of its steps; block, weight : of the block and of the string [N].
    """
    beyond = max(-mean - SMALL_SWING * weight, -least - PUSH_OF_A_STEP * weight)
    if not beyond > block:
        return None
    text = (
        f"the hook load falls to {least / 1e3:.3g} kN in a step and is {mean / 1e3:.3g} kN on the mean of a record, "
        f"where the block can push with {block / 1e3:.3g} kN"
    )
    return note_of("push", text, 1 + (beyond - block) / max(block, SMALL_SWING * weight))


def flutters(amplitude: float, frequency: float, on_wall: float, axial: float, weight: float) -> Note | None:
    """A note where the hook load flutters.

    amplitude : of its fast part, weight : of the string [N]; frequency : of the fast part, on_wall : the lowest of a
    segment on its wall spring, axial : the slowest axial one of the string [Hz].
    """
    bound = SMALL_FLUTTER * weight
    if not (amplitude > bound and frequency > max(OF_THE_WALL * on_wall, OF_THE_STRING * axial)):
        return None
    text = f"the hook load flutters for seconds by ±{amplitude / 1e3:.3g} kN at some {frequency:.2g} Hz"
    return note_of("flutter", text, amplitude / bound)


def brakes_turning(taken: float, torque: float) -> Note | None:
    """A note where the joints' own damping takes part of the torque of a turning string.

    A bent string that turns is bent to and fro in its own frame.  taken, torque : that of the damping and that at
    surface [N m].
    """
    if not taken > OF_THE_TORQUE * abs(torque):
        return None
    share = f"{100 * taken / abs(torque):.2g} %" if torque else "all"
    text = f"the joints' own damping takes {taken:.3g} N m of the torque of the turning string, {share} of it"
    return note_of("joint_damping", text, taken / (OF_THE_TORQUE * abs(torque)) if torque else math.inf)
