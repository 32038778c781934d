"""A string laid out at one bit depth: what its steady strings of all operations and friction factors have in common."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.hydraulics.channel import Channel, channel_of
from fctd.hydraulics.circuit import Circuit, circulate, flows
from fctd.mechanics.topdrive import PerMetre
from fctd.model.drillstring import String
from fctd.model.operations import BitLoads, SteadyRates, bit_loads
from fctd.model.string_in_hole import excess_pressure, fill, squeeze_by, squeeze_of
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import Pipe, pipe_of
from fctd.results.notes import Note, falling


@dataclass(frozen=True)
class LaidString:
    """A string in its hole, whose friction factors do not matter.

    lie : finds where it lies across its hole, for the mud that flows past it; circuit : of that mud, None where none
    flows; rests : whether mud is taken to be at rest; flow : of the pumps [m³/s].
    """

    case: Case
    hole: Wellbore
    string: String
    lie: Callable[["LaidString"], Array | None] | None = None
    circuit: Circuit | None = None
    rests: bool = False
    flow: float = 0.0

    def in_flow(self, rates: SteadyRates) -> "LaidString":
        """The string in the mud that an operation pumps and displaces; itself where mud rests or has no viscosity."""
        if self.rests or self.circuit is not None or not flows(self.case, rates.flow, rates.speed):
            return self
        # A damping along the string that the case gives replaces the drag of the mud that the string displaces.
        at = rates.flow, rates.speed if self.case.mud.axial_damping is None else 0.0
        if at not in self._in_flow:
            self._in_flow[at] = replace(self, circuit=circulate(self._channel, *at), flow=rates.flow)
        return self._in_flow[at]

    @cached_property
    def _in_flow(self) -> dict[tuple[float, float], "LaidString"]:
        return {}

    @property
    def at_rest(self) -> "LaidString":
        """The string in mud at rest."""
        return replace(self, rests=True)

    @cached_property
    def eccentricity(self) -> float | Array | None:
        """Offset of the pipe over its clearance, of each segment (n,) or of all; None where no lie was found."""
        given = self.case.mud.eccentricity
        if not isinstance(given, str):
            return given
        return None if self.lie is None else self.lie(self)

    @cached_property
    def _channel(self) -> Channel:
        beside = 0.0 if self.eccentricity is None else self.eccentricity
        return channel_of(self.case, self.string, self.hole, beside)

    @property
    def falling(self) -> Note | None:
        """The note on fluid inside that falls freely; None where the pumps hold it, or the end does."""
        fluids = self.string.fluids
        if fluids is None or fluids.overweight(self.hole, self.string.bit_depth) <= 0:
            return None
        return falling(self._channel.free_fall(self.flow), self.flow, self._channel.overweight)

    def put(self, S: Array) -> PerMetre:
        """Write the string into a buffer of the engine; returns the pipe at the top."""
        return fill(S, self.string, self.case, self.hole, self.given, self.squeeze)

    @cached_property
    def given(self) -> Array:
        """Load of the flow on each segment along it, towards the bit (n,) [N]."""
        return np.zeros(self.string.segments) if self.circuit is None else self.circuit.given

    @cached_property
    def squeeze(self) -> Array:
        """See ``squeeze_of``; with the friction of the flow."""
        squeeze = squeeze_of(self.case, self.string, self.hole)
        if self.circuit is None:
            return squeeze
        inside, outside = (0.5 * (side[:-1] + side[1:]) for side in (self.circuit.inside, self.circuit.outside))
        return squeeze + squeeze_by(self.string, inside, outside)

    @cached_property
    def excess(self) -> Array:
        """See ``excess_pressure``; with the friction of the flow."""
        excess, friction = excess_pressure(self.string, self.hole), self.friction
        return excess if friction is None else excess + (friction[0] - friction[1])

    @property
    def friction(self) -> tuple[Array, Array] | None:
        """What flow adds to the pressures inside and outside there (n + 1,) [Pa]; None where no mud flows."""
        return None if self.circuit is None else self.circuit.pressures(self.string.contacts_above)

    @cached_property
    def _packed(self) -> float:
        """Push of the fluids on an end that moves in a seal bore [N]: the area of the bore times their difference.

        Of the steel the bore leaves the ring to its inner radius open to the pressure inside, and that to its outer one
        to the pressure outside.  What is left of both in the effective tension is the bore alone.
        """
        bore = self.case.mud.packer_bore
        return 0.0 if bore is None else 0.25 * float(np.pi) * bore**2 * float(self.excess[-1])

    def bit_loads(self, case: Case, operation: str) -> BitLoads:
        """Loads at the lower end in an operation: those of a case on its bit, and what pushes on a packer."""
        own = bit_loads(case, operation)
        if case.mud.packer_bore is None:
            return own
        return own._replace(weight=own.weight + self._packed) if self._packed else own

    @cached_property
    def is_bent(self) -> bool:
        """Whether a housing in it is bent."""
        return any(part.component.bend != 0 for part in self.string.parts)

    @cached_property
    def pipe(self) -> Pipe:
        """What buckling depends on."""
        return pipe_of(self.string)

    @cached_property
    def top_axis(self) -> Array:
        """Tangent (3,) of the hole at the string's top."""
        return self._tangent(self.string.top_md)

    @cached_property
    def bit_axis(self) -> Array:
        """Tangent (3,) of the hole at the bit."""
        return self._tangent(self.string.bit_depth)

    def _tangent(self, md: float) -> Array:
        direction: Array = self.hole.at(np.array([md]))[1][0]
        return direction
