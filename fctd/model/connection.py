"""Rotary-shouldered connections of tool joints: torque at which pin or box yields, and make-up torque (RP 7G, A.8)."""

import math
from functools import cache
from typing import Final, NamedTuple

from fctd.case.pipes.catalogue import INCH, Pipe, connection_of, table
from fctd.case.pipes.grades import KSI

# Friction of thread and shoulder, half the angle of the thread; yield strength of tool joints [Pa] (API Spec 7-1);
# share of the yield torque to make up to at most.
FRICTION: Final = 0.08
FLANK: Final = math.radians(30.0)
YIELD_STRENGTH: Final = 120 * KSI
MAKE_UP = 0.6


class Thread(NamedTuple):
    """A connection by its thread [m], taper as a ratio of diameter to length.

    pitch_diameter : at the gauge point, 5/8 in from the shoulder; counterbore : diameter of the box at its face;
    pitch : of the thread; height : of its profile before it is cut off, by ``truncation`` at the root.
    """

    pitch_diameter: float
    counterbore: float
    taper: float
    pitch: float
    pin_length: float
    height: float
    truncation: float


def yield_torque(thread: Thread, outer: float, inner: float) -> float:
    """Torque at which the weaker of pin and box yields [N m], of a tool joint of diameters [m].

    The shoulder's radius is that of a tool joint whose box is as strong as its pin, where the box is stronger: so do
    data sheets of makers and DS-1; the tables of RP 7G take the full diameter, which gives up to 1 % more.
    """
    pin, box = _areas(thread, outer, inner)
    widest = outer
    if box > pin:  # the box diameter at which both are alike
        bored = thread.counterbore - thread.taper * 0.375 * INCH
        widest = math.sqrt(4 / math.pi * pin + bored**2)
    mean_thread = thread.pitch_diameter - 0.5 * thread.taper * (thread.pin_length - 0.625 * INCH)
    radius_of_thread, radius_of_shoulder = 0.5 * mean_thread, 0.25 * (widest + thread.counterbore)
    arm = thread.pitch / (2 * math.pi) + FRICTION * (radius_of_thread / math.cos(FLANK) + radius_of_shoulder)
    return YIELD_STRENGTH * min(pin, box) * arm


def make_up_torque(pipe: Pipe) -> float | None:
    """Make-up torque that is recommended at most for the tool joints of a pipe [N m]: beyond it they turn on.

    It is 60 % of the torque at yield.  None where the pipe has no tool joints, or connections whose geometry no printed
    torque confirms.
    """
    joint = pipe.joint
    thread = None if joint is None else threads().get(connection_of(joint.connection))
    return None if joint is None or thread is None else MAKE_UP * yield_torque(thread, joint.outer, joint.inner)


@cache
def threads() -> dict[str, Thread]:
    """The connections of the catalogue, by their names as ``connection_of`` has them."""
    return {connection_of(row["name"]): _thread_of(row) for row in table("connections")}


def _thread_of(row: dict[str, str]) -> Thread:
    inches = {
        key: float(row[key]) * INCH for key in ("pitch_diameter", "counterbore", "pin_length", "height", "truncation")
    }
    return Thread(taper=float(row["taper_in_per_ft"]) / 12, pitch=INCH / float(row["threads_per_inch"]), **inches)


def _areas(thread: Thread, outer: float, inner: float) -> tuple[float, float]:
    """Of the pin 3/4 in from its shoulder and of the box 3/8 in from its face [m²]."""
    bored = thread.counterbore - thread.taper * 0.375 * INCH
    root = thread.pitch_diameter - (thread.height - 2 * thread.truncation) - thread.taper * 0.125 * INCH
    return math.pi / 4 * (root**2 - inner**2), math.pi / 4 * (outer**2 - bored**2)
