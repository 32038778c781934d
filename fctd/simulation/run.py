"""The string of a case in motion."""

from dataclasses import dataclass

from fctd.case.load import Case
from fctd.case.operations import Operation
from fctd.mechanics import state, topdrive
from fctd.mechanics.moving_string import STILL, MovingString
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import String
from fctd.model.wellbore import Wellbore
from fctd.simulation.carried_mud import take_along
from fctd.simulation.hoist import Hoist


@dataclass(kw_only=True)
class Run(MovingString):
    """The string of a case in motion, with the case, the hole and the string it was built from.

    hoist : where it hangs from a block that moves.  mud_at : bit depth [m], segments and rotation [rev/min] to
    which the mud that moves along belongs.
    """

    case: Case
    hole: Wellbore
    string: String
    hoist: Hoist | None = None
    mud_at: tuple[float, int, float] | None = None

    @property
    def bit_depth(self) -> float:
        """Unstretched length of the string below the rotary table [m]."""
        if self.hoist is not None:
            return self.hoist.bit_depth(self)
        fed = float(self.top[topdrive.TOP_LENGTH] - self.string.length[0]) if self.string.long_segment else 0.0
        return self.string.bit_depth + fed

    def advance(self, motion: Motion, duration: float, laws: state.Laws | None = None) -> None:
        """See ``MovingString.advance``; where the string hangs from a block, stands are added and racked back."""
        if self.hoist is not None and motion is not STILL:
            motion = self.hoist.paced(self, motion)
        super().advance(motion, duration, laws)

    def refresh(self) -> None:
        """See ``MovingString.refresh``."""
        super().refresh()
        if self.hoist is not None:
            self.string = self.hoist.string(self)

    @property
    def laid_out(self) -> String:
        """The string at its present depth, with what has been fed at its top or the stands added since the start."""
        if self.hoist is not None:
            return self.hoist.string(self)
        if not self.string.long_segment:
            return self.string
        return self.string.lengthened(float(self.top[topdrive.TOP_LENGTH] - self.string.length[0]))

    def take_mud_along(self, operation: Operation) -> None:
        """Update what the mud does to motion that changes, by the present depth and the rotation of an operation."""
        now = self.bit_depth, self.segments, operation.rpm
        if self.case.mud.unsteady and now != self.mud_at:
            string, in_derrick = self.laid_out, self.hoist is not None
            self.pipe = take_along(
                self.S, self.case, string, self.pipe, operation.rpm, self.laws.layer_rate, in_derrick=in_derrick
            )
            self.mud_at = now
