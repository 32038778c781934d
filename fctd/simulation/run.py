"""The string of a case in motion."""

from dataclasses import dataclass, field

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.case.operations import Operation
from fctd.mechanics import state
from fctd.mechanics.moving_string import STILL, MovingString
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import String
from fctd.model.string_in_hole import excess_pressure
from fctd.model.wellbore import Wellbore
from fctd.simulation.carried_mud import take_along
from fctd.simulation.flowing_mud import LIE_LASTS, is_driven, let_flow, rates_at
from fctd.simulation.upper_end import UpperEnd
from fctd.store.facts import Facts, Restorable


@dataclass(kw_only=True)
class Run(MovingString, Restorable):
    """The string of a case in motion, with the case, the hole and the string it was built from.

    upper_end : what feeds or holds it.  mud_at : bit depth [m], segments and rotation [rev/min] to which the mud that
    moves along belongs; flow_at : whole bit depth [m], segments, feed [m/s], flow [m³/s] and stretch of time to which
    the mud that flows belongs.  flow_pressures (3, k) : distances from the bit [m], and what flow adds to the pressures
    inside and outside there [Pa]; (3, 0) where none flows.
    """

    FACTS = ("top", "owner", "steps", "segments", "pipe", "mud_at", "flow_at", "flow_pressures", "upper_end")
    case: Case
    hole: Wellbore
    string: String
    upper_end: UpperEnd
    mud_at: tuple[float, int, float] | None = None
    flow_at: tuple[float, ...] = ()
    flow_pressures: Array = field(default_factory=lambda: np.zeros((3, 0)))

    @property
    def bit_depth(self) -> float:
        """Unstretched length of the string below the rotary table [m]."""
        return self.upper_end.bit_depth(self)

    def advance(self, motion: Motion, duration: float, laws: state.Laws | None = None) -> None:
        super().advance(motion if motion is STILL else self.upper_end.moved(self, motion), duration, laws)

    def refresh(self) -> None:
        super().refresh()
        self.string = self.upper_end.string(self)

    @property
    def laid_out(self) -> String:
        """The string at its present depth, with what has been fed at its top or the stands added since the start."""
        return self.upper_end.laid_out(self)

    def take_mud_along(self, operation: Operation) -> None:
        """Update what the mud does to motion that changes, by the present depth and the rotation of an operation."""
        now = self.bit_depth, self.segments, operation.rpm
        if self.case.mud.unsteady and now != self.mud_at:
            self.pipe = take_along(
                self.S, self.case, self.laid_out, self.hole, self.pipe, operation.rpm, self.laws.layer_rate,
                in_derrick=self.upper_end.in_derrick,
            )  # fmt: skip
            self.mud_at = now

    def let_mud_flow(self, motion: Motion, until: float) -> None:
        """Update what mud that is pumped, and mud that the string displaces, do to it until a time [s]."""
        if not is_driven(self.case):
            return
        feed, flow = rates_at(motion, 0.5 * (self.time + until))
        # Along a metre of the hole it hardly changes; where the string lies may change wherever it is.
        stretch = self.time // LIE_LASTS if self.case.mud.eccentricity == "string" else 0.0
        now = (float(round(self.bit_depth)), float(self.segments), feed, flow, stretch)
        if now == self.flow_at:
            return
        self.pipe, circuit = let_flow(
            self.S, self.case, self.laid_out, self.hole, self.pipe, feed, flow, in_derrick=self.upper_end.in_derrick
        )
        self.flow_at = now
        self.flow_pressures = np.stack([circuit.above, circuit.inside, circuit.outside])

    def excess_pressure(self) -> Array:
        """Pressure inside less that outside (n + 1,) [Pa], at the top of the string and at its contact points."""
        excess, friction = excess_pressure(self.string, self.hole), self.friction
        return excess if friction is None else excess + (friction[0] - friction[1])

    @property
    def friction(self) -> tuple[Array, Array] | None:
        """What flow adds to the pressures inside and outside there (n + 1,) [Pa]; None where no mud flows."""
        above, *sides = self.flow_pressures
        if not len(above):
            return None
        inside, outside = (np.interp(-self.string.contacts_above, -above, side) for side in sides)
        return inside, outside

    def facts(self) -> Facts:
        """See ``Restorable.facts``: what does not follow from the case, which is prepared anew.

        S (ROWS, k) : the first columns of the state buffer, whose others are those of a fresh one.
        """
        rows, fresh = state.columns(self.S), state.columns(state.new_state(1))[:, :1]
        used = np.flatnonzero((rows.view(np.int64) != fresh.view(np.int64)).any(axis=0))
        return super().facts() | {"step": self.step, "S": rows[:, : used.max(initial=-1) + 1]}

    def restore(self, facts: Facts) -> None:
        S = facts["S"]
        sizes = len(S), facts["top"].shape, facts["owner"].shape
        if sizes != (state.ROWS, self.top.shape, self.owner.shape) or facts["step"] != self.step:
            raise ValueError("another string or step")
        super().restore(facts)
        state.columns(self.S)[:] = state.columns(state.new_state(1))[:, :1]
        state.columns(self.S)[:, : S.shape[1]] = S
        self.string = self.upper_end.string(self)
