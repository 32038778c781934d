"""The upper end of a run: pipe is fed at a rotary table (``Fed``), or the string hangs from a block (hung.py)."""

from abc import ABC, abstractmethod
from typing import Any, ClassVar

from fctd.arrays import Array
from fctd.case.operations import KINDS
from fctd.mechanics import topdrive
from fctd.mechanics.moving_string import MovingString
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import String
from fctd.store.facts import Restorable


class UpperEnd(Restorable, ABC):
    """What holds the upper end of a string that moves, and what of the string is there.

    longest : string of the run, which has the slowest waves, as far as its segments are known.
    start_depth : of the bit where the records begin [m].  in_slips : whether the string hangs in them.
    """

    in_derrick: ClassVar[bool]
    """Whether the string reaches above the rotary table."""
    longest: String
    start_depth: float
    in_slips = False

    def begin(self, run: MovingString) -> None:
        """The records of a run begin now."""
        self.start_depth = self.bit_depth(run)

    @abstractmethod
    def bit_depth(self, run: MovingString) -> float:
        """Unstretched length of the string below the rotary table [m]."""

    @abstractmethod
    def laid_out(self, run: MovingString) -> String:
        """The string at its present depth, with what has been fed at its top or the stands added since the start."""

    @abstractmethod
    def at_depth(self, bit_depth: float, run: MovingString, probe: Array) -> String:
        """The string with its bit at another depth [m], whose constants are written into a state buffer."""

    def string(self, run: MovingString) -> String:
        """The string as the segments in the buffers of a run were laid out; what was fed since is no part of it."""
        return self.laid_out(run)

    def moved(self, run: MovingString, motion: Motion) -> Motion:
        """The motion of the upper end in a part of the schedule that begins now."""
        return motion

    def direction(self, kind: str) -> int:
        """Whether the block has moved down last, 1, up, -1, or neither, 0, in an operation of a kind."""
        return KINDS[kind].direction

    def columns(self, run: MovingString) -> dict[str, Any]:
        """What a record says of the upper end alone."""
        return {}

    def drills_on(self, run: MovingString, motion: Motion) -> bool | None:
        """Whether an autodriller that moves the block has some way left to the end of its stroke; None for others."""
        return None

    def delay(self, by: float) -> None:
        """What is still to come of the schedule starts later [s]."""


class Fed(UpperEnd):
    """Pipe that is fed into the top segment at the rotary table, while the top drive stands still.

    string : as it was laid out.
    """

    in_derrick = False
    FACTS = ("start_depth", "_start_length")

    def __init__(self, string: String) -> None:
        self.longest, self._laid = string, float(string.length[0]) if string.long_segment else 0.0

    def begin(self, run: MovingString) -> None:
        self._start_length = float(run.top[topdrive.TOP_LENGTH])
        self.start_depth = self.longest.bit_depth + (self._start_length - self._laid)

    def bit_depth(self, run: MovingString) -> float:
        return self.start_depth + float(run.top[topdrive.TOP_LENGTH]) - self._start_length

    def laid_out(self, run: MovingString) -> String:
        return self.longest.lengthened(float(run.top[topdrive.TOP_LENGTH]) - self._laid)

    def string(self, run: MovingString) -> String:
        return self.longest

    def at_depth(self, bit_depth: float, run: MovingString, probe: Array) -> String:
        string = self.longest.lengthened(bit_depth - self.longest.bit_depth)
        if string.long_segment:
            topdrive.put_long_segment(probe, string.length[0], run.pipe)
        return string
